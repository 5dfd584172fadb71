// Setpoints given by the program: MC_MotionInVelocity, MC_MotionInPosition.
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// No profile leads there: the first values given count in this very cycle.
void Axis::begin_motion_in(Job& job) noexcept {
  absorb_superimposed();
  leave_synchronous();
  set_position_control(job.position_controlled);
  running_[kBase] = &job;
  job.phase = JobPhase::active;
  motion_ = Motion::given;
  show_motion_in_command();
}

/// The values of the last call. Without Enable they go to zero at once, and the position stays.
void Axis::step_given() noexcept {
  const Job& job = *running_[kBase];
  if (job.input_error != ErrorId::none) {
    end_job(kBase, JobPhase::failed, job.input_error);
    begin_stop(maximum_dynamics(), false);
    return step_single_axis();
  }
  if (!job.hold) {
    end_job(kBase, JobPhase::done, ErrorId::none);
    setpoint_.velocity = setpoint_.acceleration = 0.0;
    motion_ = Motion::single_axis;
    return single_.stand(setpoint_);
  }
  if (job.kind == JobKind::MC_MotionInPosition) {
    setpoint_.position = given_position(job.position);
  } else {
    const double way = 0.5 * (setpoint_.velocity + job.velocity) * period_;
    setpoint_.position = advanced(setpoint_.position, way, modulo_);
  }
  setpoint_.velocity = job.velocity;
  setpoint_.acceleration = job.acceleration;
  set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded,
          std::abs(setpoint_.velocity) > data.DynamicLimits.MaxVelocity);
}

/// On a ring the turn is the one on which the given position is next to where the axis is.
AxisPosition Axis::given_position(double position) const noexcept {
  if (!modulo_.enabled) return {0, position};
  const double target = normalised({0, position}, modulo_).value;
  AxisPosition given =
      advanced(setpoint_.position, shortest_distance(setpoint_.position.value, target, modulo_), modulo_);
  // The way is rounded: at the end of the ring the turn may be the neighbour's.
  if (given.value - target > 0.5 * modulo_.length) ++given.turns;
  if (given.value - target < -0.5 * modulo_.length) --given.turns;
  given.value = target;
  return given;
}

void Axis::show_motion_in_command() noexcept {
  const Job* job = running_[kBase];
  DINT state = 0;
  if (job != nullptr && job->kind == JobKind::MC_MotionInVelocity) state = 1;
  if (job != nullptr && job->kind == JobKind::MC_MotionInPosition) state = 2;
  set_bit(data.StatusWord, StatusBit::MotionInCommand, state != 0);
  data.StatusMotionIn.FunctionState = state;
  if (state == 0) set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded, false);
}

}  // namespace lockstep
