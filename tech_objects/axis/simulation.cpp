#include "tech_objects/axis/simulation.hpp"

#include <cmath>

#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {
namespace {

/// Turns by which a position has to be moved to lie next to a place.
std::int64_t turns_between(AxisPosition position, AxisPosition place, const Modulo& modulo) noexcept {
  if (!modulo.enabled) return 0;
  const double apart = position.value - place.value;
  const std::int64_t over_the_end = apart > 0.5 * modulo.length ? -1 : apart < -0.5 * modulo.length ? 1 : 0;
  return place.turns - position.turns + over_the_end;
}

}  // namespace

void SimulationOrders::watch() noexcept {
  SimulationRequest& request = simulation_request;
  request.error = ErrorId::none;
  if (request.enable && simulated_ == nullptr) begin();
  if (!request.enable && simulated_ != nullptr) end();
  if (simulated_ != nullptr) {
    shifting_.look_at_coupling(*simulated_);
    synchronous_.advance(ghost_);
    show_passes();
  }
  if (!request.enable && simulated_ == nullptr) request.owner = nullptr;
}

/// A cam that is passed again and again shows its ends in simulation as well.
void SimulationOrders::show_passes() noexcept {
  if (!synchronous_.at_cam_end() || synchronous_.passed_once()) return;
  ++simulated_->as<CamJob>().ends;
  synchronous_.clear_cam_end();
}

/// Whether a setpoint of the coupling stands; one that follows measured values does within the standstill
/// signal.
bool SimulationOrders::coupling_stands(const Setpoint& setpoint) const noexcept {
  return setpoint.standing() || (synchronous_.follows_actual_value() && !moving(setpoint.velocity, data));
}

/// The gear goes on without the axis: only while it is synchronous and the leading axis stands. The axis has
/// to stand as well: it may still brake with the last tick, or be shifted by an offset.
void SimulationOrders::begin() noexcept {
  const bool leading_stands = led(motion_) && coupled_.leading->leading_value_stands();
  if (motion_ != AxisMotion::synchronous || !leading_stands ||
      !coupling_stands(superimposed_.base_of(setpoint_))) {
    simulation_request.error = ErrorId::no_synchronous_operation;
    return;
  }
  simulated_ = jobs_[kBase];
  jobs_.take(kBase);
  ghost_ = superimposed_.base_of(setpoint_);
  motion_ = AxisMotion::single_axis;
  single_.stand(superimposed_.base_of(setpoint_));
}

/// What forbids that the setpoints of the coupling count again. They have to agree with those of the axis:
/// both stand, at the same place. On a ring the turns that one of them has made meanwhile do not count, and a
/// velocity gear has no place.
ErrorId SimulationOrders::refusal_of_end() const noexcept {
  if (power_state_ != PowerState::on || jobs_.locked()) return ErrorId::locked;
  const Setpoint own = superimposed_.base_of(setpoint_);
  if (!own.standing() || !coupling_stands(ghost_)) return ErrorId::position;
  if (simulated_->kind == JobKind::MC_GearInVelocity) return ErrorId::none;
  // Position control is taken up where the axis is.
  const double place = has_drive_ && !position_controlled_ ? actual_.value : own.position.value;
  const double away = std::abs(shortest_distance(place, ghost_.position.value, modulo_));
  return away <= data.PositioningMonitoring.Window ? ErrorId::none : ErrorId::position;
}

/// The setpoints of the coupling count again, with its position control.
void SimulationOrders::end() noexcept {
  simulation_request.error = refusal_of_end();
  if (simulation_request.error != ErrorId::none) return;
  ends_.end(kBase, JobPhase::aborted, ErrorId::none);
  position_control_.set(simulated_->position_controlled);
  synchronous_.turn_following(
      turns_between(ghost_.position, superimposed_.base_of(setpoint_).position, modulo_));
  jobs_.put_back(kBase, *simulated_);
  simulated_ = nullptr;
  motion_ = AxisMotion::synchronous;
}

}  // namespace lockstep
