// What an axis shows in its technology data block at the end of an interpolator cycle.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {
namespace {

/// A word of these bits.
template <class... Bit>
constexpr std::uint32_t word_of(Bit... bits) noexcept {
  return (std::uint32_t{0} | ... | (std::uint32_t{1} << static_cast<unsigned>(bits)));
}

/// A word of one bit, without a branch.
template <class Bit>
constexpr std::uint32_t when(bool value, Bit bit) noexcept {
  return static_cast<std::uint32_t>(value) << static_cast<unsigned>(bit);
}

/// Of `word`, the shown bits anew; the others keep what they are.
constexpr DWORD renewed(DWORD word, std::uint32_t shown, std::uint32_t bits) noexcept {
  return static_cast<DWORD>((static_cast<std::uint32_t>(word) & ~shown) | bits);
}

/// What the base motion's job shows in the StatusWord.
constexpr std::uint32_t command_bits(JobKind kind) noexcept {
  switch (kind) {
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:
      return word_of(StatusBit::PositioningCommand);
    case JobKind::MC_MoveJog:
      return word_of(StatusBit::JogCommand);
    case JobKind::MC_MoveVelocity:
      return word_of(StatusBit::VelocityCommand);
    default:
      return 0;
  }
}

/// Bits that publish_status shows; others are of the functions that they belong to.
constexpr std::uint32_t kStatusBits =
    word_of(StatusBit::Enable, StatusBit::Error, StatusBit::HomingDone, StatusBit::OnlineStartValuesChanged,
            StatusBit::ControlPanelActive, StatusBit::Done, StatusBit::Standstill,
            StatusBit::PositioningCommand, StatusBit::JogCommand, StatusBit::VelocityCommand,
            StatusBit::HomingCommand, StatusBit::ConstantVelocity, StatusBit::Accelerating,
            StatusBit::Decelerating, StatusBit::SWLimitMinActive, StatusBit::SWLimitMaxActive,
            StatusBit::HWLimitMinActive, StatusBit::HWLimitMaxActive, StatusBit::Synchronizing,
            StatusBit::Synchronous, StatusBit::PhasingCommand, StatusBit::NonPositionControlled);
constexpr std::uint32_t kStatus2Bits =
    word_of(Status2Bit::StopCommand, Status2Bit::DesynchronizingCommand, Status2Bit::PhasingCommandWaiting,
            Status2Bit::OffsetCommand, Status2Bit::OffsetCommandWaiting);
constexpr std::uint32_t kSynchronizedMotionBits =
    word_of(SynchronizedMotionBit::MaxVelocityExceeded, SynchronizedMotionBit::MaxAccelerationExceeded,
            SynchronizedMotionBit::MaxDecelerationExceeded, SynchronizedMotionBit::InSimulation,
            SynchronizedMotionBit::LeadingValueAdditiveCommand);

/// Share of the highest velocity by which the difference of two may be rounded up.
constexpr double kRounding = 1e-13;

/// The bits of the StatusWord that a speed axis has.
constexpr std::uint32_t kOfSpeedAxis = 0x0E00765F;

}  // namespace

/// A cam that is followed, simulated or waited for is in use.
void Axis::publish() noexcept {
  publish_motion();
  if (led() || simulating()) {
    publish_synchronous();
    if (coupled_.cam != nullptr) coupled_.cam->show_use();
  } else {
    publish_awaited();
  }
  if (running_[kWaiting] != nullptr && running_[kWaiting]->cam != nullptr)
    running_[kWaiting]->cam->show_use();
  publish_status();
  if (leads_by_actual_value()) publish_extrapolation(data.Extrapolation, data.StatusExtrapolation);
}

void Axis::publish_motion() noexcept {
  data.Position = position_controlled_ ? setpoint_.position.value : 0.0;
  data.Velocity = setpoint_.velocity;
  data.Acceleration = setpoint_.acceleration;
  data.ModuloCycle = static_cast<DINT>(setpoint_.position.turns - counted_from_);
  data.ActualPosition = actual_.value;
  data.ActualVelocity = actual_velocity_;
  data.ActualModuloCycle = static_cast<DINT>(actual_.turns - counted_from_);
  if (!has_drive_) {
    data.ActualAcceleration = setpoint_.acceleration;
    data.VelocitySetpoint = setpoint_.velocity;
  }
  const bool positioning = motion_ == Motion::single_axis && single_.aim() == SingleAxisMotion::Aim::position;
  data.StatusPositioning.Distance =
      positioning ? rounded_difference(single_.target(), base_setpoint().position, modulo_) : 0.0;
}

/// Not coupled yet: the additive leading value, and the leading value that a waiting job looks at.
void Axis::publish_awaited() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  constexpr auto kAdditive = SynchronizedMotionBit::LeadingValueAdditiveCommand;
  status.StatusWord =
      renewed(status.StatusWord, word_of(kAdditive), when(additive_request.counts, kAdditive));
  if (running_[kWaiting] == nullptr) return;
  const Setpoint& effective = awaited_.effective_leading_value();
  status.EffectiveLeadingValue.Position = effective.position.value;
  status.EffectiveLeadingValue.Velocity = effective.velocity;
  status.EffectiveLeadingValue.Acceleration = effective.acceleration;
}

void Axis::publish_synchronous() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  const Setpoint& effective = synchronous_.effective_leading_value();
  const Setpoint& function = synchronous_.function_value();
  status.EffectiveLeadingValue.Position = effective.position.value;
  status.EffectiveLeadingValue.Velocity = effective.velocity;
  status.EffectiveLeadingValue.Acceleration = effective.acceleration;
  status.FunctionLeadingValue.Position = synchronous_.function_leading_position();
  if (synchronous_.shifted()) show_shifts();
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;

  status.StatusWord =
      renewed(status.StatusWord, kSynchronizedMotionBits,
              bits_of_excess() | when(simulating(), SynchronizedMotionBit::InSimulation) |
                  when(additive_request.counts, SynchronizedMotionBit::LeadingValueAdditiveCommand));

  if (motion_ != Motion::synchronous) return;
  was_synchronous_ = true;
  watch_deviation();
}

/// Which limits the setpoint exceeds: none, most of the time.
std::uint32_t Axis::bits_of_excess() const noexcept {
  const auto& limits = data.DynamicLimits;
  const double steepest = std::min(limits.MaxAcceleration, limits.MaxDeceleration);
  const double change = setpoint_.velocity - last_setpoint_.velocity;
  const bool within = std::abs(setpoint_.velocity) <= limits.MaxVelocity &&
                      std::abs(setpoint_.acceleration) <= steepest && std::abs(change) <= steepest * period_;
  return within ? 0 : bits_beyond_limits();
}

std::uint32_t Axis::bits_beyond_limits() const noexcept {
  const auto& limits = data.DynamicLimits;
  const double push = setpoint_.velocity < 0.0 ? -setpoint_.acceleration : setpoint_.acceleration;
  // A velocity may step where the acceleration of the function does not tell: with a changed ratio, at a
  // corner of a cam.
  const double change = setpoint_.velocity - last_setpoint_.velocity;
  const double gained = sign(setpoint_.velocity) * change;
  const double lost = -sign(last_setpoint_.velocity) * change;
  const double rounding = kRounding * limits.MaxVelocity;
  const bool too_quick =
      push > limits.MaxAcceleration || gained - rounding > limits.MaxAcceleration * period_;
  const bool too_hard = -push > limits.MaxDeceleration || lost - rounding > limits.MaxDeceleration * period_;
  return when(std::abs(setpoint_.velocity) > limits.MaxVelocity, SynchronizedMotionBit::MaxVelocityExceeded) |
         when(too_quick, SynchronizedMotionBit::MaxAccelerationExceeded) |
         when(too_hard, SynchronizedMotionBit::MaxDecelerationExceeded);
}

void Axis::show_shifts() noexcept {
  const SynchronousMotion& synchronous = synchronous_;
  data.StatusSynchronizedMotion.PhaseShift = synchronous.phase_shift().value().rounded();
  data.StatusSynchronizedMotion.Offset = synchronous.following_offset().value().rounded();
}

/// How far the axis is from where the function has it. A drive follows later; there the balanced difference
/// tells.
void Axis::watch_deviation() noexcept {
  const AxisPosition following =
      superimposed_.in_use() ? advanced(synchronous_.following_position(), superimposed_.value(), modulo_)
                             : synchronous_.following_position();
  if (!has_drive_ && actual_ == following) return;
  const double deviation = has_drive_ ? std::abs(data.StatusPositioning.FollowingError)
                                      : std::abs(rounded_difference(actual_, following, modulo_));
  if (deviation > largest_deviation_) largest_deviation_ = deviation;
}

/// What changes seldom is asked in branches, which the processor foresees; what changes often, without.
void Axis::publish_status() noexcept {
  const bool on = power_state_ == PowerState::on;
  std::uint32_t word =
      when(data.ErrorDetail.Number != 0, StatusBit::Error) | when(homed_, StatusBit::HomingDone) |
      when(start_values_changed, StatusBit::OnlineStartValuesChanged) |
      when(standstill_.watch(actual_velocity_, data.StandstillSignal, period_), StatusBit::Standstill);
  if (motion_ == Motion::synchronous) word |= word_of(StatusBit::Synchronous);
  if (motion_ == Motion::synchronizing) word |= word_of(StatusBit::Synchronizing);
  if (setpoint_.acceleration != 0.0)
    word |= pace_bits();
  else
    word |= when(on, StatusBit::ConstantVelocity);
  if (on) word |= bits_when_on();
  if (homing_now_) word |= word_of(StatusBit::HomingCommand);
  if (control_panel) word |= word_of(StatusBit::ControlPanelActive);
  if (limit_side_ != 0)
    word |= word_of(limit_side_ < 0 ? StatusBit::SWLimitMinActive : StatusBit::SWLimitMaxActive);
  if (beyond_limit_switch_)
    word |= when(limit_switches_[0].beyond, StatusBit::HWLimitMinActive) |
            when(limit_switches_[1].beyond, StatusBit::HWLimitMaxActive);

  std::uint32_t word2 = 0;
  if (const Job* const base = running_[kBase]) {
    word |= command_bits(base->kind);
    word2 = when(leaves(base->kind), Status2Bit::DesynchronizingCommand);
  }
  if (locked_by_stop()) word2 |= word_of(Status2Bit::StopCommand);
  if (const Job* const phasing = running_[kPhasing]) {
    word |= when(phasing->phase == JobPhase::active, StatusBit::PhasingCommand);
    word2 |= when(phasing->phase == JobPhase::waiting, Status2Bit::PhasingCommandWaiting);
  }
  if (const Job* const offset = running_[kOffset])
    word2 |= when(offset->phase == JobPhase::active, Status2Bit::OffsetCommand) |
             when(offset->phase == JobPhase::waiting, Status2Bit::OffsetCommandWaiting);

  data.StatusWord = renewed(data.StatusWord, kStatusBits, word);
  if (!has_position())
    data.StatusWord = static_cast<DWORD>(static_cast<std::uint32_t>(data.StatusWord) & kOfSpeedAxis);
  data.StatusWord2 = renewed(data.StatusWord2, kStatus2Bits, word2);
  show_drive_state();
}

/// Written when it changes: a line of memory less in every cycle.
void Axis::show_drive_state() noexcept {
  const bool operating = has_drive_ ? drive_running_ : power_state_ == PowerState::on;
  const bool disabled = power_state_ == PowerState::off;
  const auto shown = static_cast<std::uint8_t>(int{operating} | int{disabled} << 1);
  if (shown == drive_shown_) return;
  drive_shown_ = shown;
  data.StatusDrive.InOperation = operating;
  data.StatusDrive.Disabled = disabled;
}

/// Whether the acceleration of the setpoint makes it quicker or slower.
std::uint32_t Axis::pace_bits() const noexcept {
  const double push = sign(setpoint_.velocity) * setpoint_.acceleration;  // a product of both may be none
  return when(push > 0.0 || setpoint_.velocity == 0.0, StatusBit::Accelerating) |
         when(push < 0.0, StatusBit::Decelerating);
}

std::uint32_t Axis::bits_when_on() const noexcept {
  const bool idle = running_[kBase] == nullptr && running_[kWaiting] == nullptr &&
                    running_[kSuperimposed] == nullptr && !control_panel;
  return when(power.enable, StatusBit::Enable) | when(idle, StatusBit::Done) |
         when(!position_controlled_, StatusBit::NonPositionControlled);
}

}  // namespace lockstep
