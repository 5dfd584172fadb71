// What an axis shows in its technology data block at the end of an interpolator cycle.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/status_words.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

using namespace status_words;

/// A cam that is followed, simulated or waited for is in use.
void Axis::publish() noexcept {
  publish_motion();
  if (led() || simulating()) {
    publish_synchronous();
    if (coupled_.cam != nullptr) coupled_.cam->show_use();
  } else {
    publish_awaited();
  }
  if (jobs_[kWaiting] != nullptr && jobs_[kWaiting]->cam != nullptr) jobs_[kWaiting]->cam->show_use();
  publish_status();
  if (leads_by_actual_value()) publish_extrapolation(data.Extrapolation, data.StatusExtrapolation);
}

void AxisOrders::publish_motion() noexcept {
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
void AxisOrders::publish_awaited() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  constexpr auto kAdditive = SynchronizedMotionBit::LeadingValueAdditiveCommand;
  status.StatusWord =
      renewed(status.StatusWord, word_of(kAdditive), when(additive_request.counts, kAdditive));
  if (jobs_[kWaiting] == nullptr) return;
  show(status.EffectiveLeadingValue, awaited_.effective_leading_value());
}

void AxisOrders::publish_synchronous() noexcept {
  auto& status = data.StatusSynchronizedMotion;
  const Setpoint& function = synchronous_.function_value();
  show(status.EffectiveLeadingValue, synchronous_.effective_leading_value());
  status.FunctionLeadingValue.Position = synchronous_.function_leading_position();
  if (synchronous_.shifted()) {
    status.PhaseShift = synchronous_.phase_shift().value().rounded();
    status.Offset = synchronous_.following_offset().value().rounded();
  }
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;

  status.StatusWord =
      renewed(status.StatusWord, kSynchronizedMotionBits,
              Excess{setpoint_, last_setpoint_, data.DynamicLimits, period_}.bits() |
                  when(simulating(), SynchronizedMotionBit::InSimulation) |
                  when(additive_request.counts, SynchronizedMotionBit::LeadingValueAdditiveCommand));

  if (motion_ != Motion::synchronous) return;
  was_synchronous_ = true;
  watch_deviation();
}

/// How far the axis is from where the function has it. A drive follows later; there the balanced difference
/// tells.
void AxisOrders::watch_deviation() noexcept {
  const AxisPosition following =
      superimposed_.in_use() ? advanced(synchronous_.following_position(), superimposed_.value(), modulo_)
                             : synchronous_.following_position();
  if (!has_drive_ && actual_ == following) return;
  const double deviation = has_drive_ ? std::abs(data.StatusPositioning.FollowingError)
                                      : std::abs(rounded_difference(actual_, following, modulo_));
  if (deviation > largest_deviation_) largest_deviation_ = deviation;
}

/// What changes seldom is asked in branches, which the processor foresees; what changes often, without.
void AxisOrders::publish_status() noexcept {
  const bool on = power_state_ == PowerState::on;
  std::uint32_t word =
      when(data.ErrorDetail.Number != 0, StatusBit::Error) | when(homed_, StatusBit::HomingDone) |
      when(start_values_changed, StatusBit::OnlineStartValuesChanged) |
      when(standstill_.watch(actual_velocity_, data.StandstillSignal, period_), StatusBit::Standstill);
  if (motion_ == Motion::synchronous) word |= word_of(StatusBit::Synchronous);
  if (motion_ == Motion::synchronizing) word |= word_of(StatusBit::Synchronizing);
  if (setpoint_.acceleration != 0.0)
    word |= pace_bits(setpoint_);
  else
    word |= when(on, StatusBit::ConstantVelocity);
  if (on) word |= bits_when_on();
  if (homing_now_) word |= word_of(StatusBit::HomingCommand);
  if (control_panel) word |= word_of(StatusBit::ControlPanelActive);
  if (const int side = software_limits_.side(); side != 0)
    word |= word_of(side < 0 ? StatusBit::SWLimitMinActive : StatusBit::SWLimitMaxActive);
  if (has_drive_)
    word |= when(limit_switches_.beyond(-1), StatusBit::HWLimitMinActive) |
            when(limit_switches_.beyond(1), StatusBit::HWLimitMaxActive);

  std::uint32_t word2 = 0;
  if (const Job* const base = jobs_[kBase]) {
    word |= command_bits(base->kind);
    word2 = when(leaves(base->kind), Status2Bit::DesynchronizingCommand);
  }
  if (jobs_.locked()) word2 |= word_of(Status2Bit::StopCommand);
  word2 |= shift_bits(jobs_, word);

  data.StatusWord = renewed(data.StatusWord, kStatusBits, word);
  if (!has_position())
    data.StatusWord = static_cast<DWORD>(static_cast<std::uint32_t>(data.StatusWord) & kOfSpeedAxis);
  data.StatusWord2 = renewed(data.StatusWord2, kStatus2Bits, word2);
  show_drive_state();
}

/// Written when it changes: a line of memory less in every cycle.
void AxisOrders::show_drive_state() noexcept {
  const bool operating = has_drive_ ? drive_running_ : power_state_ == PowerState::on;
  const bool disabled = power_state_ == PowerState::off;
  const auto shown = static_cast<std::uint8_t>(int{operating} | int{disabled} << 1);
  if (shown == drive_shown_) return;
  drive_shown_ = shown;
  data.StatusDrive.InOperation = operating;
  data.StatusDrive.Disabled = disabled;
}

std::uint32_t AxisOrders::bits_when_on() const noexcept {
  const bool idle = jobs_[kBase] == nullptr && jobs_[kWaiting] == nullptr &&
                    jobs_[kSuperimposed] == nullptr && !control_panel;
  return when(power.enable, StatusBit::Enable) | when(idle, StatusBit::Done) |
         when(!position_controlled_, StatusBit::NonPositionControlled);
}

}  // namespace lockstep
