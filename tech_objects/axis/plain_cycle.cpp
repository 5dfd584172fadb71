// The cycle of an axis at which nothing but its base motion happens: by far the most cycles of most axes. It
// is `step` and `publish` without what they would find to be absent, so it has the same results, to the bit
// (tests/scheduler/plain_cycle_test.cpp).
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/status_words.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

using namespace status_words;

namespace {

/// Whether a job that couples asks for another ratio.
bool asks_for_ratio(const Job& job) noexcept {
  return job.kind == JobKind::MC_GearInVelocity && job.as<GearJob>().update;
}

}  // namespace

void Axis::cycle() noexcept {
  if (!left_alone() || !plain()) {
    step();
    return publish();
  }
  last_setpoint_ = setpoint_;
  servo_tick_ = 0;
  if (!advance_plainly()) return finish_cycle();
  show_where_it_is();
  publish_plainly();
}

/// Whether none of what others ask of the axis between two cycles has to be looked at. All flags at once:
/// they are hardly ever set, and a look at each would cost a branch.
inline bool Axis::left_alone() const noexcept {
  const bool asked = additive_request.counts | additive_.in_use | control_panel | start_values_changed |
                     data.PositionLimits_SW.Active | has_drive_ | leads_by_actual_value_ | provides_ |
                     never_plain;
  return !asked && power.enable && has_position_ && simulation_request.owner == nullptr && !jobs_.lockable();
}

/// Whether the axis is on and does nothing but its base motion; a step may end that.
inline bool Axis::plain() const noexcept {
  constexpr unsigned kPlainJobs = 1u << kBase | 1u << kPhasing | 1u << kOffset;
  const bool more = handing_over_ | homing_now_ | superimposed_.in_use();
  return !more && power_state_ == PowerState::on && position_controlled_ &&
         (motion_ == AxisMotion::synchronous || motion_ == AxisMotion::single_axis) &&
         emergency_ramp_ == EmergencyRamp::none && pending_alarm() == 0 && jobs_.none_but(kPlainJobs) &&
         simulated_ == nullptr;
}

/// The base motion has been advanced by more than a new setpoint: a job may have met its end, or an alarm.
[[gnu::noinline]] void Axis::finish_cycle() noexcept {
  guard();
  if (handing_over_) hand_over_.step();
  show_where_it_is();
  if (plain())
    publish_plainly();
  else
    publish();
}

/// As the end of `step`: a virtual axis is where its setpoint is.
inline void Axis::show_where_it_is() noexcept {
  software_limits_.release();
  control_switched_ = false;
  actual_.turns = setpoint_.position.turns;
  actual_.value = setpoint_.position.value;
  actual_velocity_ = setpoint_.velocity;
}

/// The base motion. @return whether the axis still is plain, with a setpoint at which `guard` finds nothing.
/// The ends of a shift and of a motion of its own leave it plain; what an alarm does is not.
inline bool Axis::advance_plainly() noexcept {
  if (motion_ == AxisMotion::synchronous) return follow_plainly() && within_range();
  if (jobs_[kBase] == nullptr && single_.stands()) {
    setpoint_.velocity = 0.0;
    setpoint_.acceleration = 0.0;
    return far_inside();
  }
  step_single_axis();
  return pending_alarm() == 0 && within_range();
}

inline bool Axis::follow_plainly() noexcept {
  if (asks_for_ratio(*jobs_[kBase]) || synchronous_.shifted()) return follow_shifted();
  synchronous_.look_at_leading();
  synchronous_.advance(setpoint_);
  if (!synchronous_.at_cam_end()) return true;
  meet_cam_end();
  return false;
}

/// With shifts, or with a ratio that may change.
[[gnu::noinline]] bool Axis::follow_shifted() noexcept {
  shifting_.look_at_coupling(*jobs_[kBase]);
  synchronous_.advance(setpoint_);
  if (!synchronous_.at_cam_end()) return true;
  meet_cam_end();
  return false;
}

/// Where an axis that stands has no end of its range to watch.
inline bool Axis::far_inside() const noexcept {
  return std::abs(setpoint_.position.value) < 0.5 * kPositionRange;
}

/// Whether `guard` would find nothing. A comparison with what is not finite is false.
inline bool Axis::within_range() const noexcept {
  if (!modulo_.enabled) return far_from_end_of_range(setpoint_, modulo_, data.DynamicLimits);
  return far_inside() && std::isfinite(setpoint_.velocity) && std::isfinite(setpoint_.acceleration);
}

void Axis::publish_plainly() noexcept {
  data.ActualPosition = data.Position = setpoint_.position.value;
  data.VelocitySetpoint = data.ActualVelocity = data.Velocity = setpoint_.velocity;
  data.ActualAcceleration = data.Acceleration = setpoint_.acceleration;
  data.ActualModuloCycle = data.ModuloCycle = static_cast<DINT>(setpoint_.position.turns - counted_from_);
  data.StatusPositioning.Distance = 0.0;
  const bool stands = shown_before_.standstill.watch(setpoint_.velocity, data.StandstillSignal, period_);
  std::uint32_t word =
      word_of(StatusBit::Enable) | when(homed_, StatusBit::HomingDone) | when(stands, StatusBit::Standstill);
  word |= setpoint_.acceleration != 0.0 ? pace_bits(setpoint_) : word_of(StatusBit::ConstantVelocity);
  std::uint32_t word2 = 0;
  if (motion_ == AxisMotion::synchronous) {  // by a job that couples, which has no bits of its own
    word |= word_of(StatusBit::Synchronous);
    publish_coupling_plainly();
  } else {
    if (const Job* const base = jobs_[kBase]) {
      word |= command_bits(base->kind);
      word2 = when(leaves(base->kind), Status2Bit::DesynchronizingCommand);
    } else {
      word |= word_of(StatusBit::Done);
    }
    auto& shown = data.StatusSynchronizedMotion.StatusWord;
    shown = renewed(shown, word_of(SynchronizedMotionBit::LeadingValueAdditiveCommand), 0);
    if (single_.aim() == SingleAxisMotion::Aim::position)
      data.StatusPositioning.Distance = rounded_difference(single_.target(), setpoint_.position, modulo_);
  }
  if (!jobs_.none_but(1u << kBase)) word2 |= shift_bits(jobs_, word);
  data.StatusWord = renewed(data.StatusWord, kStatusBits, word);
  data.StatusWord2 = renewed(data.StatusWord2, kStatus2Bits, word2);
  if (shown_before_.drive != ShownBefore::kOperating) show_operation();
}

[[gnu::noinline]] void Axis::show_operation() noexcept {
  shown_before_.drive = ShownBefore::kOperating;
  data.StatusDrive.InOperation = true;
  data.StatusDrive.Disabled = false;
}

[[gnu::noinline]] void Axis::publish_shifts() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionLeadingValue.Position = synchronous_.function_leading_position();
  status.PhaseShift = synchronous_.phase_shift().value().rounded();
  status.Offset = synchronous_.following_offset().value().rounded();
}

/// The axis is where its function is: there is no deviation.
inline void Axis::publish_coupling_plainly() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  const Setpoint& function = synchronous_.function_value();
  show(status.EffectiveLeadingValue, synchronous_.effective_leading_value());
  status.FunctionLeadingValue.Position = synchronous_.effective_leading_value().position.value;
  if (synchronous_.shifted()) publish_shifts();
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;
  status.StatusWord = renewed(status.StatusWord, kSynchronizedMotionBits,
                              Excess{setpoint_, last_setpoint_, data.DynamicLimits, period_}.bits());
  shown_before_.synchronous = true;
  if (coupled_.cam != nullptr) coupled_.cam->show_use();
}

}  // namespace lockstep
