// Setpoints given by the program: MC_MotionInVelocity, MC_MotionInPosition.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/target_distance.hpp"

namespace lockstep {

/// No profile leads there: the first values given count in this very cycle.
void AxisOrders::begin_motion_in(Job& job) noexcept {
  absorb_superimposed();
  leave_synchronous();
  set_position_control(job.position_controlled);
  jobs_.put(kBase, job, JobPhase::active);
  motion_ = Motion::given;
  show_motion_in_command();
}

/// The values of the last call. Without Enable they go to zero at once, and the position stays.
void AxisOrders::step_given() noexcept {
  const Job& job = *jobs_[kBase];
  const auto& asked = job.as<MotionInJob>();
  if (asked.error != ErrorId::none) {
    end_job(kBase, JobPhase::failed, asked.error);
    begin_stop(limits_.maximum(), false);
    return step_single_axis();
  }
  if (!asked.hold) {
    end_job(kBase, JobPhase::done, ErrorId::none);
    setpoint_.velocity = setpoint_.acceleration = 0.0;
    motion_ = Motion::single_axis;
    return single_.stand(setpoint_);
  }
  if (job.kind == JobKind::MC_MotionInPosition) {
    setpoint_.position = next_to(setpoint_.position, asked.position, modulo_);
  } else {
    const double way = 0.5 * (setpoint_.velocity + asked.velocity) * period_;
    setpoint_.position = advanced(setpoint_.position, way, modulo_);
  }
  setpoint_.velocity = asked.velocity;
  setpoint_.acceleration = asked.acceleration;
  set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded,
          std::abs(setpoint_.velocity) > data.DynamicLimits.MaxVelocity);
}

void AxisOrders::show_motion_in_command() noexcept {
  const Job* job = jobs_[kBase];
  DINT state = 0;
  if (job != nullptr && job->kind == JobKind::MC_MotionInVelocity) state = 1;
  if (job != nullptr && job->kind == JobKind::MC_MotionInPosition) state = 2;
  set_bit(data.StatusWord, StatusBit::MotionInCommand, state != 0);
  data.StatusMotionIn.FunctionState = state;
  if (state == 0) set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

}  // namespace lockstep
