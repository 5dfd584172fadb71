#include "tech_objects/axis/arrival_orders.hpp"

#include <cmath>

namespace lockstep {

void ArrivalOrders::watch(Job& job) noexcept {
  const bool passes = single_.aim() == SingleAxisMotion::Aim::position && single_.target_velocity() != 0.0;
  if (passes) return;
  switch (job.kind) {
    case JobKind::MC_MoveVelocity:
      job.phase = JobPhase::reached;
      break;
    case JobKind::MC_MoveJog:
      if (job.as<JogJob>().direction != 0) {
        job.phase = JobPhase::reached;
      } else {
        ends_.end(kBase, JobPhase::done, ErrorId::none);
      }
      break;
    case JobKind::MC_Home:
      if (!homing_.travels()) break;
      [[fallthrough]];
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:
    case JobKind::MC_GearOut:
    case JobKind::MC_CamOut:
      watch_positioning();
      break;
    default:
      watch_standstill();
      break;
  }
}

/// Alarm 541 where a positioning misses its window.
void ArrivalOrders::watch_positioning() noexcept {
  // While a superimposed motion goes on, the axis cannot be there; its base motion has come to rest.
  const double distance =
      superimposed_.resting() ? std::abs(rounded_difference(actual_, setpoint_.position, modulo_)) : 0.0;
  const bool monitored = !(has_drive_ && forces_.position_monitoring_off(data));
  take(arrival_.watch_position(distance, data.PositioningMonitoring, monitored));
}

void ArrivalOrders::take(Arrival::Verdict verdict) noexcept {
  if (verdict == Arrival::Verdict::arrived) ends_.end(kBase, JobPhase::done, ErrorId::none);
  if (verdict == Arrival::Verdict::missed)
    reactions_.raise(alarm::kPositioning,
                     {.cause = arrival_.in_window() ? AlarmCause::left_window : AlarmCause::late_in_window,
                      .value = rounded_difference(setpoint_.position, actual_, modulo_),
                      .limit = data.PositioningMonitoring.Window});
}

/// A stop under position control is done when the actual position has settled as well. A drive whose torque
/// is limited may never get there: MC_Halt is done when the axis has stood for the dwell time.
void ArrivalOrders::watch_standstill() noexcept {
  const bool settled = !has_drive_ || !moving(actual_velocity_, data);
  const bool halts = position_controlled_ && jobs_[kBase]->kind == JobKind::MC_Halt;
  const bool limited = has_drive_ && forces_.position_monitoring_off(data);
  if (halts && !limited) {
    if (settled) watch_positioning();
    return;
  }
  take(arrival_.watch_rest(settled, halts, data.PositioningMonitoring.MinDwellTime));
}

}  // namespace lockstep
