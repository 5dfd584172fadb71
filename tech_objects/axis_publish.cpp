// What an axis shows in its technology data block at the end of an interpolator cycle.
#include <cmath>

#include "tech_objects/axis.hpp"
#include "tech_objects/cam.hpp"

namespace lockstep {
namespace {

/// Puts a word together without a branch per bit. Bits that are not shown here keep what they are.
class Bits {
 public:
  template <class Bit>
  constexpr void show(Bit bit, bool value) noexcept {
    shown_ |= std::uint32_t{1} << static_cast<unsigned>(bit);
    if (value) bits_ |= std::uint32_t{1} << static_cast<unsigned>(bit);
  }
  constexpr DWORD in(DWORD word) const noexcept {
    return static_cast<DWORD>((static_cast<std::uint32_t>(word) & ~shown_) | bits_);
  }

 private:
  std::uint32_t shown_ = 0;
  std::uint32_t bits_ = 0;
};

/// The bits of the StatusWord that a speed axis has.
constexpr std::uint32_t kOfSpeedAxis = 0x0E00765F;

}  // namespace

void Axis::publish() noexcept {
  publish_motion();
  if (led() || simulating())
    publish_synchronous();
  else
    publish_awaited();
  show_cam_use();
  publish_status();
  if (leads_by_actual_value()) publish_extrapolation(data.Extrapolation, data.StatusExtrapolation);
}

/// A cam that is followed, simulated or waited for is in use.
void Axis::show_cam_use() const noexcept {
  if (led() || simulating())
    if (Cam* const cam = synchronous_.cam()) cam->show_use();
  if (running_[kWaiting] != nullptr && running_[kWaiting]->cam != nullptr)
    running_[kWaiting]->cam->show_use();
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
  Bits word;
  word.show(SynchronizedMotionBit::LeadingValueAdditiveCommand, additive_request.owner != nullptr);
  status.StatusWord = word.in(status.StatusWord);
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
  status.PhaseShift = synchronous_.phase_shift().value().rounded();
  status.Offset = synchronous_.following_offset().value().rounded();
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;

  const double speed = std::abs(setpoint_.velocity);
  const double push = setpoint_.velocity < 0.0 ? -setpoint_.acceleration : setpoint_.acceleration;
  Bits word;
  word.show(SynchronizedMotionBit::MaxVelocityExceeded, speed > data.DynamicLimits.MaxVelocity);
  word.show(SynchronizedMotionBit::MaxAccelerationExceeded, push > data.DynamicLimits.MaxAcceleration);
  word.show(SynchronizedMotionBit::MaxDecelerationExceeded, -push > data.DynamicLimits.MaxDeceleration);
  word.show(SynchronizedMotionBit::InSimulation, simulating());
  word.show(SynchronizedMotionBit::LeadingValueAdditiveCommand, additive_request.owner != nullptr);
  status.StatusWord = word.in(status.StatusWord);

  if (motion_ != Motion::synchronous) return;
  was_synchronous_ = true;
  // A drive follows later; there the balanced difference tells how far the axis is from where it should be.
  const AxisPosition following =
      superimposed_.in_use() ? advanced(synchronous_.following_position(), superimposed_.value(), modulo_)
                             : synchronous_.following_position();
  const double deviation = has_drive_ ? std::abs(data.StatusPositioning.FollowingError)
                                      : std::abs(rounded_difference(actual_, following, modulo_));
  if (deviation > largest_deviation_) largest_deviation_ = deviation;
}

void Axis::publish_status() noexcept {
  const Job* base = running_[kBase];
  const bool idle = base == nullptr && running_[kWaiting] == nullptr && running_[kSuperimposed] == nullptr;
  const JobKind kind = base != nullptr ? base->kind : JobKind::MC_Halt;  // neither shows at a bit
  const bool on = power_state_ == PowerState::on;
  bool accelerating = false;
  bool decelerating = false;
  if (setpoint_.acceleration != 0.0) {
    const double push = setpoint_.velocity * setpoint_.acceleration;
    accelerating = push > 0.0 || setpoint_.velocity == 0.0;
    decelerating = push < 0.0;
  }

  const auto in_phase = [](const Job* job, JobPhase phase) { return job != nullptr && job->phase == phase; };

  Bits word;
  word.show(StatusBit::Enable, on && power.enable);
  word.show(StatusBit::Error, data.ErrorDetail.Number != 0);
  word.show(StatusBit::HomingDone, homed_);
  word.show(StatusBit::OnlineStartValuesChanged, start_values_changed);
  word.show(StatusBit::Done, on && idle);
  word.show(StatusBit::Standstill, standstill_.watch(actual_velocity_, data.StandstillSignal, period_));
  word.show(StatusBit::PositioningCommand,
            kind == JobKind::MC_MoveAbsolute || kind == JobKind::MC_MoveRelative);
  word.show(StatusBit::JogCommand, kind == JobKind::MC_MoveJog);
  word.show(StatusBit::VelocityCommand, kind == JobKind::MC_MoveVelocity);
  word.show(StatusBit::HomingCommand, homing_now_);
  word.show(StatusBit::ConstantVelocity, on && setpoint_.acceleration == 0.0);
  word.show(StatusBit::Accelerating, accelerating);
  word.show(StatusBit::Decelerating, decelerating);
  word.show(StatusBit::SWLimitMinActive, limit_side_ < 0);
  word.show(StatusBit::SWLimitMaxActive, limit_side_ > 0);
  word.show(StatusBit::HWLimitMinActive, limit_switches_[0].beyond);
  word.show(StatusBit::HWLimitMaxActive, limit_switches_[1].beyond);
  word.show(StatusBit::Synchronizing, motion_ == Motion::synchronizing);
  word.show(StatusBit::Synchronous, motion_ == Motion::synchronous);
  word.show(StatusBit::PhasingCommand, in_phase(running_[kPhasing], JobPhase::active));
  word.show(StatusBit::NonPositionControlled, on && !position_controlled_);
  data.StatusWord = word.in(data.StatusWord);
  if (!has_position())
    data.StatusWord = static_cast<DWORD>(static_cast<std::uint32_t>(data.StatusWord) & kOfSpeedAxis);

  Bits word2;
  word2.show(Status2Bit::StopCommand, locked_by_stop());
  word2.show(Status2Bit::DesynchronizingCommand, leaves(kind));
  word2.show(Status2Bit::PhasingCommandWaiting, in_phase(running_[kPhasing], JobPhase::waiting));
  word2.show(Status2Bit::OffsetCommand, in_phase(running_[kOffset], JobPhase::active));
  word2.show(Status2Bit::OffsetCommandWaiting, in_phase(running_[kOffset], JobPhase::waiting));
  data.StatusWord2 = word2.in(data.StatusWord2);
  data.StatusDrive.InOperation = has_drive_ ? drive_running_ : on;
  data.StatusDrive.Disabled = power_state_ == PowerState::off;
}

}  // namespace lockstep
