// What an axis shows in its technology data block at the end of an interpolator cycle.
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/excess.hpp"
#include "tech_objects/axis/status_words.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

using namespace status_words;

namespace {

/// What is looked at to show it. The data block is written to, and what the publisher keeps for itself.
struct Shown {
  AxisData& data;
  ShownBefore& before;
  const JobSlots& jobs;
  const AdditiveRequest& additive_request;
  const PowerRequest& power;
  const PowerState& power_state;
  const AxisMotion& motion;
  const Setpoint& setpoint;
  const Setpoint& last_setpoint;
  const AxisPosition& actual;
  const double& actual_velocity;
  const std::int64_t& counted_from;
  const SingleAxisMotion& single;
  const SuperimposedMotion& superimposed;
  const SynchronousMotion& synchronous;
  const SynchronousMotion& awaited;
  Job* const& simulated;
  const SoftwareLimits& software_limits;
  const LimitSwitches& limit_switches;
  const Modulo& modulo;
  const double& period;
  const bool& position_controlled;
  const bool& has_position;
  const bool& has_drive;
  const bool& drive_running;
  const bool& homed;
  const bool& homing;
  const BOOL& control_panel;
  const BOOL& start_values_changed;
};

/// Lives as long as one cycle takes to show; inlined, it costs nothing.
class Publisher : private Shown {
 public:
  explicit Publisher(const Shown& shown) noexcept : Shown(shown) {}

  void show_motion() const noexcept;
  void show_awaited() const noexcept;
  void show_synchronous() const noexcept;
  void show_status() const noexcept;

 private:
  void watch_deviation() const noexcept;
  void show_drive_state() const noexcept;
  std::uint32_t bits_when_on() const noexcept;
};

void Publisher::show_motion() const noexcept {
  data.Position = position_controlled ? setpoint.position.value : 0.0;
  data.Velocity = setpoint.velocity;
  data.Acceleration = setpoint.acceleration;
  data.ModuloCycle = static_cast<DINT>(setpoint.position.turns - counted_from);
  data.ActualPosition = actual.value;
  data.ActualVelocity = actual_velocity;
  data.ActualModuloCycle = static_cast<DINT>(actual.turns - counted_from);
  if (!has_drive) {
    data.ActualAcceleration = setpoint.acceleration;
    data.VelocitySetpoint = setpoint.velocity;
  }
  const bool positioning =
      motion == AxisMotion::single_axis && single.aim() == SingleAxisMotion::Aim::position;
  data.StatusPositioning.Distance =
      positioning ? rounded_difference(single.target(), superimposed.base_of(setpoint).position, modulo)
                  : 0.0;
}

/// Not coupled yet: the additive leading value, and the leading value that a waiting job looks at.
void Publisher::show_awaited() const noexcept {
  auto& status = data.StatusSynchronizedMotion;
  constexpr auto kAdditive = SynchronizedMotionBit::LeadingValueAdditiveCommand;
  status.StatusWord =
      renewed(status.StatusWord, word_of(kAdditive), when(additive_request.counts, kAdditive));
  if (jobs[kWaiting] == nullptr) return;
  show(status.EffectiveLeadingValue, awaited.effective_leading_value());
}

void Publisher::show_synchronous() const noexcept {
  auto& status = data.StatusSynchronizedMotion;
  const Setpoint& function = synchronous.function_value();
  show(status.EffectiveLeadingValue, synchronous.effective_leading_value());
  status.FunctionLeadingValue.Position = synchronous.function_leading_position();
  if (synchronous.shifted()) {
    status.PhaseShift = synchronous.phase_shift().value().rounded();
    status.Offset = synchronous.following_offset().value().rounded();
  }
  status.FunctionFollowingValue.Position = function.position.value;
  status.FunctionFollowingValue.Velocity = function.velocity;
  status.FunctionFollowingValue.Acceleration = function.acceleration;

  status.StatusWord =
      renewed(status.StatusWord, kSynchronizedMotionBits,
              Excess{setpoint, last_setpoint, data.DynamicLimits, period}.bits() |
                  when(simulated != nullptr, SynchronizedMotionBit::InSimulation) |
                  when(additive_request.counts, SynchronizedMotionBit::LeadingValueAdditiveCommand));

  if (motion != AxisMotion::synchronous) return;
  before.synchronous = true;
  watch_deviation();
}

/// How far the axis is from where the function has it. A drive follows later; there the balanced difference
/// tells.
void Publisher::watch_deviation() const noexcept {
  const AxisPosition following =
      superimposed.in_use() ? advanced(synchronous.following_position(), superimposed.value(), modulo)
                            : synchronous.following_position();
  if (!has_drive && actual == following) return;
  const double deviation = has_drive ? std::abs(data.StatusPositioning.FollowingError)
                                     : std::abs(rounded_difference(actual, following, modulo));
  if (deviation > before.largest_deviation) before.largest_deviation = deviation;
}

/// What changes seldom is asked in branches, which the processor foresees; what changes often, without.
void Publisher::show_status() const noexcept {
  const bool on = power_state == PowerState::on;
  std::uint32_t word =
      when(data.ErrorDetail.Number != 0, StatusBit::Error) | when(homed, StatusBit::HomingDone) |
      when(start_values_changed, StatusBit::OnlineStartValuesChanged) |
      when(before.standstill.watch(actual_velocity, data.StandstillSignal, period), StatusBit::Standstill);
  if (motion == AxisMotion::synchronous) word |= word_of(StatusBit::Synchronous);
  if (motion == AxisMotion::synchronizing) word |= word_of(StatusBit::Synchronizing);
  if (setpoint.acceleration != 0.0)
    word |= pace_bits(setpoint);
  else
    word |= when(on, StatusBit::ConstantVelocity);
  if (on) word |= bits_when_on();
  if (homing) word |= word_of(StatusBit::HomingCommand);
  if (control_panel) word |= word_of(StatusBit::ControlPanelActive);
  if (const int side = software_limits.side(); side != 0)
    word |= word_of(side < 0 ? StatusBit::SWLimitMinActive : StatusBit::SWLimitMaxActive);
  if (has_drive)
    word |= when(limit_switches.beyond(-1), StatusBit::HWLimitMinActive) |
            when(limit_switches.beyond(1), StatusBit::HWLimitMaxActive);

  std::uint32_t word2 = 0;
  if (const Job* const base = jobs[kBase]) {
    const CommandBits& bits = kCommandBits[static_cast<std::size_t>(base->kind)];
    word |= bits.word;
    word2 = bits.word2;
  }
  if (jobs.locked()) word2 |= word_of(Status2Bit::StopCommand);
  word2 |= shift_bits(jobs, word);

  data.StatusWord = renewed(data.StatusWord, kStatusBits, word);
  if (!has_position)
    data.StatusWord = static_cast<DWORD>(static_cast<std::uint32_t>(data.StatusWord) & kOfSpeedAxis);
  data.StatusWord2 = renewed(data.StatusWord2, kStatus2Bits, word2);
  show_drive_state();
}

/// Written when it changes: a line of memory less in every cycle.
void Publisher::show_drive_state() const noexcept {
  const bool operating = has_drive ? drive_running : power_state == PowerState::on;
  const bool disabled = power_state == PowerState::off;
  const auto shown = static_cast<std::uint8_t>(int{operating} | int{disabled} << 1);
  if (shown == before.drive) return;
  before.drive = shown;
  data.StatusDrive.InOperation = operating;
  data.StatusDrive.Disabled = disabled;
}

std::uint32_t Publisher::bits_when_on() const noexcept {
  const bool idle =
      jobs[kBase] == nullptr && jobs[kWaiting] == nullptr && jobs[kSuperimposed] == nullptr && !control_panel;
  return when(power.enable, StatusBit::Enable) | when(idle, StatusBit::Done) |
         when(!position_controlled, StatusBit::NonPositionControlled);
}

}  // namespace

/// A cam that is followed, simulated or waited for is in use.
void Axis::publish() noexcept {
  const bool follows = led() || simulating();
  const Publisher publisher({.data = data,
                             .before = shown_before_,
                             .jobs = jobs_,
                             .additive_request = additive_request,
                             .power = power,
                             .power_state = power_state_,
                             .motion = motion_,
                             .setpoint = setpoint_,
                             .last_setpoint = last_setpoint_,
                             .actual = actual_,
                             .actual_velocity = actual_velocity_,
                             .counted_from = counted_from_,
                             .single = single_,
                             .superimposed = superimposed_,
                             .synchronous = synchronous_,
                             .awaited = awaited_,
                             .simulated = simulated_,
                             .software_limits = software_limits_,
                             .limit_switches = limit_switches_,
                             .modulo = modulo_,
                             .period = period_,
                             .position_controlled = position_controlled_,
                             .has_position = has_position_,
                             .has_drive = has_drive_,
                             .drive_running = drive_running_,
                             .homed = homed_,
                             .homing = homing_now_,
                             .control_panel = control_panel,
                             .start_values_changed = start_values_changed});
  publisher.show_motion();
  if (follows) {
    publisher.show_synchronous();
    if (coupled_.cam != nullptr) coupled_.cam->show_use();
  } else {
    publisher.show_awaited();
  }
  const Job* const waiting = jobs_[kWaiting];
  if (waiting != nullptr && waiting->kind == JobKind::MC_CamIn) waiting->as<CamJob>().cam->show_use();
  publisher.show_status();
  if (leads_by_actual_value()) publish_extrapolation(data.Extrapolation, data.StatusExtrapolation);
}

}  // namespace lockstep
