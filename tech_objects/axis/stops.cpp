#include "tech_objects/axis/stops.hpp"

namespace lockstep {

void StopOrders::begin(const Dynamics& dynamics, bool abort_acceleration) noexcept {
  absorb_superimposed();
  coupling_.leave();
  motion_ = AxisMotion::single_axis;
  cut_acceleration();
  if (single_.stop(setpoint_, dynamics, abort_acceleration) == PlanResult::ok) return;
  stand();  // no ramp can be planned from such a state
}

void StopOrders::stand() noexcept {
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  single_.stand(setpoint_);
}

void StopOrders::freeze() noexcept {
  absorb_superimposed();
  coupling_.leave();
  motion_ = AxisMotion::single_axis;
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  last_setpoint_ = setpoint_;  // the fine interpolation has nothing left to do
  single_.stand(setpoint_);
}

void StopOrders::absorb_superimposed() noexcept {
  if (!superimposed_.in_use()) return;
  if (superimposed_.advancing_base()) setpoint_ = last_setpoint_;
  superimposed_.leave_base();
  ends_.end(kSuperimposed, JobPhase::aborted, ErrorId::none);
  superimposed_.reset();
  data.StatusPositioning.SuperimposedDistance = 0.0;
}

double StopOrders::margin_to_limit() const noexcept {
  const double direction = setpoint_.acceleration < 0.0 ? -1.0 : 1.0;
  return limits_.margin(setpoint_,
                        superimposed_.advancing_base() ? superimposed_.maximum_velocity(direction) : 0.0);
}

}  // namespace lockstep
