// The cycle of an axis at which nothing but its base motion happens: by far the most cycles of most axes. It
// is `step` and `publish` without what they would find to be absent, so it has the same results, to the bit
// (tests/tech_objects/axis/plain_cycle_test.cpp). There is one for each kind of base motion, complete in
// itself: what it finds out at its begin it need not ask again when it publishes.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/excess.hpp"
#include "tech_objects/axis/status_words.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

using namespace status_words;

void Axis::cycle() noexcept {
  if (!left_alone() || !undisturbed()) return whole_cycle();
  switch (motion_) {
    case AxisMotion::synchronous:
      return synchronous_cycle();
    case AxisMotion::single_axis:
      return jobs_[kBase] == nullptr && single_.stands() ? standing_cycle() : single_axis_cycle();
    default:
      return whole_cycle();
  }
}

[[gnu::noinline]] void Axis::whole_cycle() noexcept {
  step();
  publish();
}

/// Whether none of what others ask of the axis between two cycles has to be looked at. All flags at once:
/// they are hardly ever set, and a look at each would cost a branch.
inline bool Axis::left_alone() const noexcept {
  const bool asked = additive_request.counts | additive_.in_use | control_panel | start_values_changed |
                     data.PositionLimits_SW.Active | leads_specially_ | always_in_full_;
  return !asked && power.enable && has_position_ && simulation_request.owner == nullptr && !jobs_.lockable();
}

/// Whether the axis is on and does nothing but its base motion; a step may end that.
inline bool Axis::undisturbed() const noexcept {
  constexpr unsigned kPlainJobs = 1u << kBase | 1u << kPhasing | 1u << kOffset;
  const bool more = handing_over_ | homing_now_ | superimposed_.in_use();
  return !more && power_state_ == PowerState::on && position_controlled_ &&
         emergency_ramp_ == EmergencyRamp::none && pending_alarm() == 0 && jobs_.none_but(kPlainJobs) &&
         simulated_ == nullptr;
}

// ---- Each kind of base motion

/// The axis stands, without a job.
[[gnu::noinline]] void Axis::standing_cycle() noexcept {
  begin_cycle();
  setpoint_.velocity = 0.0;
  setpoint_.acceleration = 0.0;
  if (!far_inside()) return finish_cycle();
  show_where_it_is();
  data.StatusPositioning.Distance = 0.0;
  publish_plainly(word_of(StatusBit::Done), 0);
  publish_no_coupling();
}

/// Its end, and that of a shift, leaves the axis plain; what an alarm does is not.
[[gnu::noinline]] void Axis::single_axis_cycle() noexcept {
  begin_cycle();
  Job* const job = jobs_[kBase];
  const auto ended = [&] { return job == nullptr || jobs_[kBase] != job || pending_alarm() != 0; };
  if (job == nullptr || job->kind == JobKind::MC_MoveJog || limits_.changed()) {
    step_single_axis();
    if (ended()) return finish_cycle();
  } else {
    single_.advance(setpoint_);
    if (single_.finished()) {
      arrivals_.watch(*job);
      if (ended()) return finish_cycle();
    }
  }
  if (!within_range()) return finish_cycle();
  show_where_it_is();
  const bool positions = single_.aim() == SingleAxisMotion::Aim::position;
  data.StatusPositioning.Distance =
      positions ? rounded_difference(single_.target(), setpoint_.position, modulo_) : 0.0;
  const CommandBits& bits = kCommandBits[static_cast<std::size_t>(job->kind)];
  publish_plainly(bits.word, bits.word2);
  publish_no_coupling();
}

/// The axis follows; a job that couples has no bits of its own.
[[gnu::noinline]] void Axis::synchronous_cycle() noexcept {
  begin_cycle();
  if (jobs_[kBase]->kind == JobKind::MC_GearInVelocity) shifting_.take_ratio(*jobs_[kBase]);
  synchronous_.look_at_leading();
  if (synchronous_.shifted()) shifting_.advance();
  synchronous_.advance(setpoint_);
  if (synchronous_.at_cam_end()) {
    meet_cam_end();
    return finish_cycle();
  }
  if (!within_range()) return finish_cycle();
  show_where_it_is();
  data.StatusPositioning.Distance = 0.0;
  publish_plainly(word_of(StatusBit::Synchronous), 0);
  publish_coupling_plainly();
}

inline void Axis::begin_cycle() noexcept {
  last_setpoint_ = setpoint_;
  servo_tick_ = 0;
}

/// The base motion has been advanced by more than a new setpoint: a job may have met its end, or an alarm.
[[gnu::noinline]] void Axis::finish_cycle() noexcept {
  guard();
  if (handing_over_) hand_over_.step();
  show_where_it_is();
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

/// Where an axis that stands has no end of its range to watch.
inline bool Axis::far_inside() const noexcept {
  return std::abs(setpoint_.position.value) < 0.5 * kPositionRange;
}

/// Whether `guard` would find nothing. A comparison with what is not finite is false.
inline bool Axis::within_range() const noexcept {
  if (!modulo_.enabled) return far_from_end_of_range(setpoint_, modulo_, data.DynamicLimits);
  return far_inside() && std::isfinite(setpoint_.velocity) && std::isfinite(setpoint_.acceleration);
}

// ---- What they show

/// @param word, word2 bits of the base motion
inline void Axis::publish_plainly(std::uint32_t word, std::uint32_t word2) noexcept {
  data.ActualPosition = data.Position = setpoint_.position.value;
  data.VelocitySetpoint = data.ActualVelocity = data.Velocity = setpoint_.velocity;
  data.ActualAcceleration = data.Acceleration = setpoint_.acceleration;
  data.ActualModuloCycle = data.ModuloCycle = static_cast<DINT>(setpoint_.position.turns - counted_from_);
  const bool stands = shown_before_.standstill.watch(setpoint_.velocity, data.StandstillSignal, period_);
  word |=
      word_of(StatusBit::Enable) | when(homed_, StatusBit::HomingDone) | when(stands, StatusBit::Standstill);
  word |= setpoint_.acceleration != 0.0 ? pace_bits(setpoint_) : word_of(StatusBit::ConstantVelocity);
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

inline void Axis::publish_no_coupling() noexcept {
  auto& shown = data.StatusSynchronizedMotion.StatusWord;
  shown = renewed(shown, word_of(SynchronizedMotionBit::LeadingValueAdditiveCommand), 0);
}

/// The axis is where its function is: there is no deviation.
inline void Axis::publish_coupling_plainly() noexcept {
  const SynchronousMotion& shown = synchronous_;
  auto& status = data.StatusSynchronizedMotion;
  const Setpoint& function = shown.function_value();
  show(status.EffectiveLeadingValue, shown.effective_leading_value());
  if (shown.shifted()) {
    status.FunctionLeadingValue.Position = shown.function_leading_position();
    status.PhaseShift = shown.phase_shift().value().rounded();
    status.Offset = shown.following_offset().value().rounded();
  } else {
    status.FunctionLeadingValue.Position = shown.effective_leading_value().position.value;
  }
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;
  status.StatusWord = renewed(status.StatusWord, kSynchronizedMotionBits,
                              Excess{setpoint_, last_setpoint_, data.DynamicLimits, period_}.bits());
  shown_before_.synchronous = true;
  if (coupled_.cam != nullptr) coupled_.cam->show_use();
}

}  // namespace lockstep
