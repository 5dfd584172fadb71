#include "tech_objects/axis/motion_in.hpp"

#include <cmath>

#include "tech_objects/axis/target_distance.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep {

void GivenOrders::begin(Job& job) noexcept {
  stops_.absorb_superimposed();
  coupling_.leave();
  position_control_.set(job.position_controlled);
  jobs_.put(kBase, job, JobPhase::active);
  motion_ = AxisMotion::given;
  ends_.show_motion_in_command();
}

bool GivenOrders::step() noexcept {
  const Job& job = *jobs_[kBase];
  const auto& asked = job.as<MotionInJob>();
  if (asked.error != ErrorId::none) {
    ends_.end(kBase, JobPhase::failed, asked.error);
    stops_.begin(limits_.maximum(), false);
    return true;
  }
  if (!asked.hold) {
    ends_.end(kBase, JobPhase::done, ErrorId::none);
    setpoint_.velocity = setpoint_.acceleration = 0.0;
    motion_ = AxisMotion::single_axis;
    single_.stand(setpoint_);
    return false;
  }
  if (job.kind == JobKind::MC_MotionInPosition) {
    setpoint_.position = next_to(setpoint_.position, asked.position, modulo_);
  } else {
    const double distance = 0.5 * (setpoint_.velocity + asked.velocity) * period_;
    setpoint_.position = advanced(setpoint_.position, distance, modulo_);
  }
  setpoint_.velocity = asked.velocity;
  setpoint_.acceleration = asked.acceleration;
  set_bit(data.StatusMotionIn.StatusWord, MotionInBit::MaxVelocityExceeded,
          std::abs(setpoint_.velocity) > data.DynamicLimits.MaxVelocity);
  return false;
}

}  // namespace lockstep
