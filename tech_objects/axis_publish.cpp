// What an axis shows in its technology data block at the end of an interpolator cycle.
#include <cmath>

#include "tech_objects/axis.hpp"

namespace lockstep {

void Axis::publish() noexcept {
  shown_actual_ = actual_;
  publish_motion();
  if (led() || simulating()) publish_synchronous();
  publish_status();
}

void Axis::publish_motion() noexcept {
  data.Position = position_controlled_ ? setpoint_.position.value : 0.0;
  data.Velocity = setpoint_.velocity;
  data.Acceleration = setpoint_.acceleration;
  data.ModuloCycle = static_cast<DINT>(setpoint_.position.turns);
  data.ActualPosition = actual_.value;
  data.ActualVelocity = actual_velocity_;
  data.ActualModuloCycle = static_cast<DINT>(actual_.turns);
  if (!has_drive_) {
    data.ActualAcceleration = setpoint_.acceleration;
    data.VelocitySetpoint = setpoint_.velocity;
  }
  const bool positioning = motion_ == Motion::single_axis && single_.aim() == SingleAxisMotion::Aim::position;
  data.StatusPositioning.Distance =
      positioning ? difference(single_.target(), setpoint_.position, modulo_).rounded() : 0.0;
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
  DWORD word = status.StatusWord;
  set_bit(word, SynchronizedMotionBit::MaxVelocityExceeded, speed > data.DynamicLimits.MaxVelocity);
  set_bit(word, SynchronizedMotionBit::MaxAccelerationExceeded, push > data.DynamicLimits.MaxAcceleration);
  set_bit(word, SynchronizedMotionBit::MaxDecelerationExceeded, -push > data.DynamicLimits.MaxDeceleration);
  set_bit(word, SynchronizedMotionBit::InSimulation, simulating());
  set_bit(word, SynchronizedMotionBit::LeadingValueAdditiveCommand, additive_request.owner != nullptr);
  status.StatusWord = word;

  if (motion_ != Motion::synchronous) return;
  was_synchronous_ = true;
  // A drive follows later; there the balanced difference tells how far the axis is from where it should be.
  const double deviation =
      has_drive_ ? std::abs(data.StatusPositioning.FollowingError)
                 : std::abs(difference(actual_, synchronous_.following_position(), modulo_).rounded());
  if (deviation > largest_deviation_) largest_deviation_ = deviation;
}

void Axis::publish_status() noexcept {
  standstill_ticks_ = moving(actual_velocity_) ? 0 : standstill_ticks_ + 1;
  const Job* base = running_[kBase];
  const bool on = power_state_ == PowerState::on;
  const double push = setpoint_.velocity * setpoint_.acceleration;
  const bool standing = setpoint_.velocity == 0.0;
  const auto runs = [base](JobKind kind) { return base != nullptr && base->kind == kind; };

  DWORD word = data.StatusWord;
  set_bit(word, StatusBit::Enable, on && power.enable);
  set_bit(word, StatusBit::Error, data.ErrorDetail.Number != 0);
  set_bit(word, StatusBit::HomingDone, homed_);
  set_bit(word, StatusBit::Done, on && base == nullptr && running_[kWaiting] == nullptr);
  set_bit(word, StatusBit::Standstill, standstill_ticks_ > standstill_dwell_);
  set_bit(word, StatusBit::PositioningCommand,
          runs(JobKind::MC_MoveAbsolute) || runs(JobKind::MC_MoveRelative));
  set_bit(word, StatusBit::JogCommand, runs(JobKind::MC_MoveJog));
  set_bit(word, StatusBit::VelocityCommand, runs(JobKind::MC_MoveVelocity));
  set_bit(word, StatusBit::ConstantVelocity, on && setpoint_.acceleration == 0.0);
  set_bit(word, StatusBit::Accelerating, push > 0.0 || (standing && setpoint_.acceleration != 0.0));
  set_bit(word, StatusBit::Decelerating, push < 0.0);
  set_bit(word, StatusBit::Synchronizing, motion_ == Motion::synchronizing);
  set_bit(word, StatusBit::Synchronous, motion_ == Motion::synchronous);
  set_bit(word, StatusBit::PhasingCommand,
          running_[kPhasing] != nullptr && running_[kPhasing]->phase == JobPhase::active);
  set_bit(word, StatusBit::NonPositionControlled, on && !position_controlled_);
  data.StatusWord = word;

  const auto in_phase = [](const Job* job, JobPhase phase) { return job != nullptr && job->phase == phase; };
  DWORD word2 = data.StatusWord2;
  set_bit(word2, Status2Bit::StopCommand, locked_by_stop());
  set_bit(word2, Status2Bit::DesynchronizingCommand, runs(JobKind::MC_GearOut));
  set_bit(word2, Status2Bit::PhasingCommandWaiting, in_phase(running_[kPhasing], JobPhase::waiting));
  set_bit(word2, Status2Bit::OffsetCommand, in_phase(running_[kOffset], JobPhase::active));
  set_bit(word2, Status2Bit::OffsetCommandWaiting, in_phase(running_[kOffset], JobPhase::waiting));
  data.StatusWord2 = word2;
  data.StatusDrive.InOperation = has_drive_ ? drive_running_ : on;
  data.StatusDrive.Disabled = power_state_ == PowerState::off;
}

}  // namespace lockstep
