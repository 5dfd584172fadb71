// One cycle of an axis: who makes its setpoint, and who looks at it.
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

void Axis::servo(std::int64_t /*now*/) noexcept {
  if (has_drive_)
    servo_.step();
  else
    servo_.idle();
}

void Axis::watch_leading_object() noexcept {
  const Job* const waiting = jobs_[kWaiting];
  const auto lost = [](const LeadingObject& leading) {
    return leading.restarted || !leading.actual_values_valid();
  };
  const bool led_by_lost = (led() || simulating()) && lost(*coupled_.leading);
  if (!led_by_lost && (waiting == nullptr || !lost(*master_of(*waiting)))) return;
  const LeadingObject& leading = led_by_lost ? *coupled_.leading : *master_of(*waiting);
  reactions_.raise(alarm::kLeadingAxis,
                   {.cause = leading.restarted ? AlarmCause::restarted : AlarmCause::values_invalid,
                    .object = static_cast<std::uint16_t>(leading.number)});
}

void Axis::step() noexcept {
  last_setpoint_ = setpoint_;
  servo_tick_ = 0;
  if (has_drive_) torque_.step();
  if (power_state_ != PowerState::on || !power.enable) power_.step();
  if (additive_request.counts || additive_.in_use) take_additive();
  if (simulation_request.owner != nullptr) simulation_.watch();
  if (jobs_[kWaiting] != nullptr) following_.watch_waiting();
  if (emergency_ramp_ != EmergencyRamp::none) emergency_.step();
  if (superimposed_.in_use())
    step_superimposed();
  else
    step_base();
  if (data.PositionLimits_SW.Active) {
    limit_orders_.watch();
  } else {
    software_limits_.release();
  }
  if (has_drive_ && limit_switches_.beyond_any()) limit_orders_.hold_limit_switches();
  guard();
  if (handing_over_) hand_over_.step();
  control_switched_ = false;
  if (!has_drive_) {
    // A virtual axis is where its setpoint is, in the same tick. Written part by part, as they have just been
    // computed: copied as a whole they would have to reach memory first.
    actual_.turns = setpoint_.position.turns;
    actual_.value = setpoint_.position.value;
    actual_velocity_ = setpoint_.velocity;
  }
  if (leads_by_actual_value()) extrapolate(actual_, actual_velocity_, data.Extrapolation);
  if (provides_) provide(led_setpoint(), enabled() && position_controlled_, data.StatusProvidedLeadingValue);
}

/// MC_LeadingValueAdditive: what counts from this tick on.
void Axis::take_additive() noexcept {
  additive_.last = additive_.now;
  additive_.now = additive_request.counts ? additive_request.value : AdditiveLeadingValue{};
  const auto zero = [](const AdditiveLeadingValue& value) {
    return value.position == 0.0 && value.velocity == 0.0 && value.acceleration == 0.0;
  };
  additive_.in_use = !zero(additive_.now) || !zero(additive_.last);
}

// ---- The setpoint

/// The base motion goes on by itself; then what is superimposed is added.
void Axis::step_superimposed() noexcept {
  superimposed_orders_.advance();
  if (!superimposed_.in_use()) return step_base();
  setpoint_ = superimposed_.begin_base();
  if (limits_.forgotten()) superimposed_orders_.replan_stop();
  step_base();
  if (superimposed_.advancing_base()) setpoint_ = superimposed_.add_to(setpoint_, modulo_);
  if (superimposed_.in_use()) superimposed_orders_.finish();
}

/// The base motion: of the axis' own, or led by another axis.
void Axis::step_base() noexcept {
  if (homing_now_) homing_orders_.step();
  switch (motion_) {
    case AxisMotion::none:
      power_.follow_actual();
      break;
    case AxisMotion::single_axis:
      step_single_axis();
      break;
    case AxisMotion::given:
      if (given_.step()) step_single_axis();
      break;
    case AxisMotion::synchronizing:
    case AxisMotion::synchronous:
    case AxisMotion::desynchronizing:
      step_synchronous();
      break;
  }
}

void Axis::step_single_axis() noexcept {
  Job* job = jobs_[kBase];
  if (job != nullptr && (limits_.changed() || job->kind == JobKind::MC_MoveJog))
    motion_orders_.follow_changes(*job);
  single_.advance(setpoint_);
  if (superimposed_.advancing_base()) setpoint_ = superimposed_.add_to(setpoint_, modulo_);
  if (jobs_[kBase] != nullptr && single_.finished()) arrivals_.watch(*jobs_[kBase]);
  if (jobs_[kBuffered] != nullptr) buffer_.watch();
}

void Axis::step_synchronous() noexcept {
  Job* job = jobs_[kBase];
  shifting_.look_at_coupling(*job);
  if (motion_ == AxisMotion::synchronous && jobs_[kWaitingOut] == nullptr) {
    synchronous_.advance(setpoint_);
    if (synchronous_.at_cam_end()) meet_cam_end();
    return;
  }
  Setpoint next = setpoint_;
  synchronous_.advance(next);
  if (motion_ == AxisMotion::synchronous) return step_waiting_to_leave(next);
  if (synchronous_.reversed()) {
    reactions_.raise(alarm::kSynchronizing);  // the stop begins at the last setpoint that followed
    return step_single_axis();
  }
  setpoint_ = next;
  if (motion_ == AxisMotion::desynchronizing) {
    if (synchronous_.left()) leaving_.end();
    return;
  }
  if (!synchronous_.synchronous()) return;
  motion_ = AxisMotion::synchronous;
  job->phase = JobPhase::reached;
  if (synchronous_.at_cam_end()) meet_cam_end();
}

/// @param candidate setpoint of the coupling for this tick
void Axis::step_waiting_to_leave(const Setpoint& candidate) noexcept {
  const bool beside = superimposed_.advancing_base();
  switch (leaving_.watch(beside ? superimposed_.with(candidate, modulo_) : candidate)) {
    case LeavingOrders::Next::coupling:
      setpoint_ = candidate;
      if (synchronous_.at_cam_end()) meet_cam_end();
      break;
    case LeavingOrders::Next::own_motion:
      step_single_axis();
      break;
    case LeavingOrders::Next::distance_out:
      step_synchronous();
      break;
    case LeavingOrders::Next::nothing:
      break;
  }
}

void Axis::meet_cam_end() noexcept {
  if (following_.meet_cam_end()) step_single_axis();
}

/// Last look at the setpoint before anyone sees it: finite, and within the range of positions.
void Axis::guard() noexcept {
  const bool finite = std::isfinite(setpoint_.position.value) && std::isfinite(setpoint_.velocity) &&
                      std::isfinite(setpoint_.acceleration);
  if (finite && far_from_end_of_range(setpoint_, modulo_, data.DynamicLimits)) return;
  if (finite) return range_.watch();
  stops_.absorb_superimposed();
  setpoint_ = {last_setpoint_.position, 0.0, 0.0};
  single_.stand(setpoint_);
  reactions_.raise(alarm::kInternal);
}

}  // namespace lockstep
