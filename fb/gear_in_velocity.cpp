#include "fb/gear_in_velocity.hpp"

namespace lockstep {

void MC_GearInVelocity::request(Job& job) const noexcept {
  job.kind = JobKind::MC_GearInVelocity;
  job.asks = GearJob{.master = Master,
                     .numerator = RatioNumerator,
                     .denominator = RatioDenominator,
                     .update = ContinuousUpdate};
  job.acceleration = Acceleration;
  job.deceleration = Deceleration;
  job.jerk = Jerk;
  job.position_controlled = PositionControlled;
}

void MC_GearInVelocity::show(JobPhase phase) noexcept {
  if (Error && phase != JobPhase::failed) set_phase(phase, ErrorId::none);  // of a ratio in the last call
  StartSync = phase == JobPhase::active;
  InSync = phase == JobPhase::reached;
  if (Busy) update_ratio();
  ContinuousUpdateActive =
      (Busy || Error) && job() != nullptr && job()->running() && job()->as<GearJob>().update;
}

/// Resetting ContinuousUpdate freezes the ratio until the next start. A ratio that is not permitted shows an
/// error, and the last permitted one goes on.
void MC_GearInVelocity::update_ratio() noexcept {
  auto& running = job()->as<GearJob>();
  if (!ContinuousUpdate) running.update = false;
  if (!running.update) return;
  if (RatioNumerator != 0 && RatioDenominator > 0) {
    running.numerator = RatioNumerator;
    running.denominator = RatioDenominator;
    return;
  }
  Error = true;
  ErrorID = static_cast<WORD>(RatioNumerator == 0 ? ErrorId::ratio_numerator : ErrorId::ratio_denominator);
  Busy = StartSync = InSync = false;
}

}  // namespace lockstep
