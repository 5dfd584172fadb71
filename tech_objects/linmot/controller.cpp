#include "tech_objects/linmot/controller.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {

using namespace linmot;

namespace {

/// False says nothing: there may be different bytes between members, and 0 has two signs.
bool same_bytes(const MotorParameters& one, const MotorParameters& other) noexcept {
  static_assert(std::is_trivially_copyable_v<MotorParameters>);
  const void *const left = &one, *const right = &other;
  return std::memcmp(left, right, sizeof one) == 0;
}

}  // namespace

LinMotController::LinMotController(std::string object_name, DB_ANY object_number)
    : TechnologyObject(ObjectKind::LinMot_Controller, std::move(object_name), object_number) {}

void LinMotController::configure(double servo_period, int) {
  tick_ = servo_period;
  control_cycles_ =
      std::clamp(static_cast<int>(std::lround(servo_period / control_cycle)), 1, kMaximumControlCycles);
  const double cycle = servo_period / control_cycles_;
  there_count_ = 0;
  for (std::size_t i = 0; i < kMotors; ++i) {
    motors_[i].use_curves(curves.data());
    if (hardware->range_switch) motors_[i].limit_current(data.Motors[i].Parameters.range_3a ? 3.0 : 2.0);
    motors_[i].configure(settings_with_inputs(i), data.Motors[i].Parameters, cycle, servo_period);
    keep_parameters(i);
    if (has_motor(i)) there_[there_count_++] = static_cast<std::uint8_t>(i);
  }
  watches_supplies_ =
      wiring.power_voltage != nullptr || wiring.signal_voltage != nullptr || wiring.heat_sink_hot != nullptr;
  has_outputs_ = std::any_of(wiring.outputs.begin(), wiring.outputs.end(),
                             [](const bool* output) { return output != nullptr; });
  flags_.run = flags_.init = takes_ascii();
  automatic_ = data.Parameters.auto_start;
  together_.homed = all_homed();
  read_inputs();
  state_ = first_state(facts());
  if (state_ == State::init) begin_init();
  code_.begin(raw_code());
  watch();
  show();
}

/// The inputs that IO Configuration has it read; with PROFIBUS bits of the control word are triggers too.
MotorSettings LinMotController::settings_with_inputs(std::size_t index) noexcept {
  const SystemParameters& system = data.Parameters;
  const std::array<BOOL, kMotors> reads = {system.analog_trig_drive_a, system.analog_trig_drive_b,
                                           system.analog_trig_drive_c, system.analog_trig_drive_d};
  MotorSettings settings = motor_settings[index];
  if (!reads[index]) {
    settings.trigger = nullptr;
    settings.analog = nullptr;
  }
  if (command_interface() != CommandInterface::profibus) return settings;
  wired_triggers_[index] = settings.trigger;
  settings.trigger = &bus_triggers_[index];
  return settings;
}

bool LinMotController::takes_ascii() const noexcept {
  return command_interface() == CommandInterface::ascii_rs232 ||
         command_interface() == CommandInterface::ascii_rs485;
}

void LinMotController::servo(std::int64_t now) noexcept {
  for (Line* const line : lines) line->step(now);
  read_inputs();
  if (asleep_ && !wakes()) return;
  if (there_count_ != 0) take_changed_parameters();
  change_state();
  freeze_motors();
  if (state_ == State::run && command_interface() == CommandInterface::mt) read_code();
  if (there_count_ != 0) move_motors();
  if (curves_run_) follow_curves();
  watch();
  // An error switches the motors off before their next control cycle.
  if (state_ != State::error && has_error()) enter(std::exchange(state_, State::error));
  if (has_outputs_) write_outputs();
  show();
  asleep_ = there_count_ == 0 && may_sleep();
  if (asleep_) slept_ = requests_;
}

void LinMotController::move_motors() noexcept {
  if (state_ == State::init) return home_motors();
  const bool runs = state_ == State::run;
  for (const std::size_t i : motors_there()) {
    motors_[i].tick(runs);
    motors_[i].run(control_cycles_);
  }
}

/// One that waits begins in the tick in which the one before is done.
void LinMotController::home_motors() noexcept {
  for (const std::size_t i : motors_there()) motors_[i].tick(false);
  home_next();
  for (const std::size_t i : motors_there()) motors_[i].run(control_cycles_);
}

/// Without motors, and without anything to watch or to write, ticks of the same requests are alike.
bool LinMotController::may_sleep() const noexcept {
  return !watches_supplies_ && !has_outputs_ && system_causes_ == 0 && !has_warning() &&
         state_ == settled_state_ && facts() == settled_facts_;
}

bool LinMotController::wakes() const noexcept {
  const bool reads =
      command_interface() == CommandInterface::mt || command_interface() == CommandInterface::profibus;
  return reads || refused_ || shutting_down_ || requests_ != slept_;
}

// ---- Parameters

bool LinMotController::take_parameters(std::size_t index) noexcept {
  MotorParameters& wanted = data.Motors[index].Parameters;
  bool allowed = true;
  show_curve_offset(index);
  for (const Parameter& parameter : motor_parameters()) {
    if (parameter.scope > Scope::linear_motor || !parameter.effective()) continue;
    const double value = parameter_value(parameter, &wanted);
    const bool same = value == parameter_value(parameter, &taken_[index]);
    if (same || (parameter.live() && parameter.range.allows(value) && std::isfinite(value))) continue;
    set_parameter(parameter, &wanted, parameter_value(parameter, &taken_[index]));
    allowed = false;
  }
  keep_parameters(index);
  motors_[index].take(wanted);
  return allowed;
}

void LinMotController::keep_parameters(std::size_t index) noexcept {
  const MotorParameters& p = taken_[index] = data.Motors[index].Parameters;
  const MotorSettings& settings = motor_settings[index];
  const auto if_on = [](bool on, std::uint16_t bit) { return on ? bit : std::uint16_t{0}; };
  Watched& watched = watched_[index];
  watched.error_mask = if_on(p.error_mask_drive_too_hot_calculated, motor_bit::kHotCalculated) |
                       if_on(p.error_mask_drive_following_error, motor_bit::kFollowingError);
  watched.warning_mask = if_on(p.warn_mask_slider_missing, motor_bit::kSliderMissing) |
                         if_on(p.warn_mask_drive_hot_sensor, motor_bit::kHotSensor) |
                         if_on(p.warn_mask_drive_too_hot_calculated, motor_bit::kHotCalculated) |
                         if_on(p.warn_mask_drive_following_error, motor_bit::kFollowingError) |
                         if_on(p.warn_mask_pos_range_indicator, motor_bit::kPositionRange) |
                         motor_bit::kInitNotDone;  // no mask hides it
  watched.always = if_on(settings.type >= 0 && settings.type != p.type, motor_bit::kTypeMismatch);
  const ThermalSettings& thermal = settings.thermal;
  const bool heat = thermal.calculates() || thermal.warn < 0.0 || thermal.error < 0.0;
  watched.only_motion =
      watched.always == 0 && settings.slider_missing == nullptr && settings.too_hot == nullptr && !heat;
}

void LinMotController::take_changed_parameters() noexcept {
  for (const std::size_t i : motors_there()) {
    const MotorParameters &wanted = data.Motors[i].Parameters, &taken = taken_[i];
    // Nearly always they are the same byte by byte, which is quicker to see than that each is the same.
    if (!same_bytes(wanted, taken) && wanted != taken) take_parameters(i);
  }
}

// ---- Requests and states

void LinMotController::read_inputs() noexcept {
  if (command_interface() == CommandInterface::profibus) read_words();
  const SystemParameters& system = data.Parameters;
  requests_ = flags_;
  if (system.run_input) requests_.run = is_on(wiring.run);
  if (system.init_input) requests_.init = is_on(wiring.init);
  if (system.emerg_stop_input) requests_.stop = is_on(wiring.stop);
  if (system.freeze_input) requests_.freeze = is_on(wiring.freeze);
  if (shutting_down_) requests_ = {};
}

bool LinMotController::request(Request which, bool on) noexcept {
  const SystemParameters& system = data.Parameters;
  const bool owned = which == Request::run    ? system.run_input
                     : which == Request::init ? system.init_input
                                              : system.emerg_stop_input;
  if (owned || !takes_ascii()) return false;
  (which == Request::run ? flags_.run : which == Request::init ? flags_.init : flags_.stop) = on;
  return true;
}

bool LinMotController::request_freeze(int motor, bool on) noexcept {
  if (data.Parameters.freeze_input || !takes_ascii()) return false;
  if (motor < 0)
    flags_.freeze = on;
  else
    flags_.freeze_motor[static_cast<std::size_t>(motor)] = on;
  return true;
}

bool LinMotController::all_homed() const noexcept {
  for (const std::size_t i : motors_there())
    if (!motors_[i].homed()) return false;
  return true;
}

StateFacts LinMotController::facts() const noexcept {
  // Without branches: all are looked at in each tick.
  const auto if_so = [](bool so, StateFacts bit) { return static_cast<StateFacts>(so * bit); };
  return if_so(requests_.run, fact::kRun) | if_so(requests_.init, fact::kInit) |
         if_so(requests_.stop, fact::kStop) | if_so(has_error(), fact::kError) |
         if_so((system_causes_ | together_.causes) != 0, fact::kCause) |
         if_so(together_.homed, fact::kHomed) | if_so(homing_over(), fact::kHomingOver) |
         if_so(automatic_, fact::kAutomatic) | if_so(has_warning(), fact::kWarning);
}

void LinMotController::change_state() noexcept {
  if (requests_.run || requests_.init || requests_.stop || shutting_down_) automatic_ = false;
  const State before = state_;
  const StateFacts now = facts();
  if (now == settled_facts_ && before == settled_state_) return;
  state_ = next_state(before, now);
  if (state_ != before) return enter(before);
  settled_facts_ = now;
  settled_state_ = before;
}

void LinMotController::enter(State from) noexcept {
  if (state_ != State::run) frozen_by_row_ = {};
  switch (state_) {
    case State::init:
      return begin_init();
    case State::run:
      data.LoggedWarnings = {};
      row_ = -1;
      code_.begin(raw_code());
      for (const std::size_t i : motors_there()) motors_[i].enter_run();
      return;
    case State::stop:
      automatic_ = false;
      for (Motor& motor : motors_)
        if (motor.energised()) motor.emergency_stop();
      return;
    case State::error:
      automatic_ = false;
      find_first_error();
      break;
    case State::disable:
      if (from == State::error) {
        errors_ = {};
        together_.errors = 0;
        system_errors_ = 0;
        error_number_ = 0;
        error_motor_ = -1;
        curve_missing_ = {};
      }
      break;
    case State::wait_for_disable:
      break;
  }
  for (Motor& motor : motors_) {
    if (from == State::init && state_ == State::disable)
      motor.end_homing();
    else
      motor.switch_off();
    motor.disarm();
  }
  waits_for_init_ = {};
}

void LinMotController::begin_init() noexcept {
  for (std::size_t i = 0; i < kMotors; ++i) {
    waits_for_init_[i] = has_motor(i) && !(data.Motors[i].Parameters.init_once && motors_[i].homed());
    if (waits_for_init_[i]) motors_[i].lose_position();
  }
  home_next();
}

/// All at once, or the next one when the one before is done.
void LinMotController::home_next() noexcept {
  for (std::size_t i = 0; i < hardware->motors; ++i) {
    if (!waits_for_init_[i]) continue;
    Motor& motor = motors_[i];
    if (motor.homed()) {
      waits_for_init_[i] = false;
      continue;
    }
    const bool begun =
        motor.energised() && motor.homing() != Motor::Homing::none && motor.homing() != Motor::Homing::done;
    if (!begun && motor.homing() != Motor::Homing::failed) motor.begin_homing();
    if (motor.homed()) waits_for_init_[i] = false;
    if (waits_for_init_[i] && !data.Parameters.init_together) return;
  }
}

void LinMotController::freeze_motors() noexcept {
  if (state_ != State::run) return;
  const bool any = requests_.freeze || (requests_.freeze_motor | frozen_by_row_).any();
  if (!any && !freezes_) return;
  freezes_ = any;
  for (const std::size_t i : motors_there())
    motors_[i].freeze(requests_.freeze || requests_.freeze_motor[i] || frozen_by_row_[i]);
}

bool LinMotController::move_names(std::size_t index, double distance, bool needs_all) noexcept {
  for (std::size_t i = 0; i < hardware->motors; ++i) {
    if (!has_motor(i) || (i != index && !needs_all)) continue;
    if (!motors_[i].standing() || motors_[i].frozen()) return false;
  }
  motors_[index].move_names(distance);
  return true;
}

void LinMotController::shut_down() noexcept {
  shutting_down_ = true;
}

bool LinMotController::at_rest() const noexcept {
  for (const std::size_t i : motors_there())
    if (motors_[i].energised()) return false;
  return true;
}

// ---- What others see

std::uint16_t LinMotController::flags() const noexcept {
  std::uint16_t bits = 0;
  for (std::size_t i = 0; i < kMotors; ++i)
    if (requests_.freeze_motor[i] || flags_.freeze_motor[i]) bits |= static_cast<std::uint16_t>(1u << i);
  const auto add = [&bits](bool on, int bit) {
    if (on) bits |= static_cast<std::uint16_t>(1u << bit);
  };
  const SystemParameters& system = data.Parameters;
  add(system.emerg_stop_input ? requests_.stop : flags_.stop, 4);
  add(system.freeze_input ? requests_.freeze : flags_.freeze, 5);
  add(system.init_input ? requests_.init : flags_.init, 6);
  add(system.run_input ? requests_.run : flags_.run, 7);
  return bits;
}

std::uint16_t LinMotController::state_bits() const noexcept {
  std::uint16_t bits = 0;
  const auto add = [&bits](bool on, int bit) {
    if (on) bits |= static_cast<std::uint16_t>(1u << bit);
  };
  for (std::size_t i = 0; i < kMotors; ++i) add(data.Motors[i].InPosition, static_cast<int>(i));
  add(has_error(), 4);
  add(has_warning(), 5);
  add(!all_homed(), 6);
  add(state_ == State::run, 7);
  add(state_ == State::error, 8);
  add(state_ == State::disable, 9);
  add(state_ == State::init, 10);
  add(state_ == State::stop, 11);
  return bits;
}

bool LinMotController::output_function(DINT function) const noexcept {
  const auto at = [this](std::size_t i) { return !has_motor(i) || data.Motors[i].InPosition; };
  if (function >= 1 && function <= 4) return data.Motors[static_cast<std::size_t>(function - 1)].InPosition;
  if (function == 5) return at(0) && at(1);
  if (function == 6) return at(2) && at(3);
  if (function == 7) return at(0) && at(1) && at(2) && at(3);
  if (function != 8) return false;
  return std::any_of(data.Motors.begin(), data.Motors.end(),
                     [](const auto& motor) { return motor.PosRange; });
}

bool LinMotController::message() const noexcept {
  const SystemParameters& system = data.Parameters;
  const std::uint16_t of_motors = together_.errors;
  bool in_position = false;
  for (std::size_t i = 0; i < kMotors; ++i)
    in_position = in_position || (taken_[i].warn_mask_in_position && data.Motors[i].InPosition);
  const auto has = [](std::uint16_t bits, std::uint16_t bit) { return (bits & bit) != 0; };
  return (system.msg_mask_dclv_power_too_low && has(system_errors_, system_bit::kPowerLow)) ||
         (system.msg_mask_dclv_power_too_high && has(system_errors_, system_bit::kPowerHigh)) ||
         (system.msg_mask_dclv_signal_too_low && has(system_errors_, system_bit::kSignalLow)) ||
         (system.msg_mask_dclv_signal_too_high && has(system_errors_, system_bit::kSignalHigh)) ||
         (system.msg_mask_electronic_fault && has(system_errors_, system_bit::kElectronics)) ||
         (system.msg_mask_drive_type_mismatch && has(of_motors, motor_bit::kTypeMismatch)) ||
         (system.msg_mask_curve_error && has(of_motors, motor_bit::kCurve)) ||
         (system.msg_mask_slider_missing && has(of_motors, motor_bit::kSliderMissing)) ||
         (system.msg_mask_init_failed && has(of_motors, motor_bit::kInitFailed)) ||
         (system.msg_mask_drive_following_error && has(of_motors, motor_bit::kFollowingError)) ||
         (system.msg_mask_drive_too_hot_calculated && has(of_motors, motor_bit::kHotCalculated)) ||
         (system.msg_mask_drive_too_hot_sensor && has(of_motors, motor_bit::kHotSensor)) ||
         (system.msg_mask_in_position && in_position);
}

bool LinMotController::output(std::size_t index) const noexcept {
  const SystemParameters& system = data.Parameters;
  const bool by_table = command_interface() == CommandInterface::mt;
  switch (index) {
    case 0:
      return system.warn_output && has_warning();
    case 1:
      return system.error_output && has_error();
    case 2:
      return by_table ? output_function(system.mt_output_3) : system.pos_error_output && output_function(8);
    default:
      return by_table ? output_function(system.mt_output_4) : system.msg_output && message();
  }
}

/// One that is not wired costs nothing.
void LinMotController::write_outputs() noexcept {
  for (std::size_t i = 0; i < wiring.outputs.size(); ++i)
    if (wiring.outputs[i] != nullptr) *wiring.outputs[i] = output(i);
}

void LinMotController::show() noexcept {
  constexpr double kMetres = 1e-3;  // a millimetre
  data.State = static_cast<DINT>(state_);
  data.StateNumber = row_;
  data.Code = code_.code();
  data.Errors = WORD{system_errors_};
  data.Warnings = WORD{system_warnings_};
  if (state_ != State::error) data.Display = {};
  for (const std::size_t i : motors_there()) {
    const Motor& motor = motors_[i];
    LinMotMotorData& shown = data.Motors[i];
    shown.DemandPosition = motor.demand();
    shown.SetPoint = motor.setpoint().position;
    shown.SetPointVelocity = motor.setpoint().velocity * kMetres;
    shown.ActualPosition = motor.actual();
    shown.ActualVelocity = motor.actual_velocity() * kMetres;
    shown.FollowingError = motor.following_error();
    shown.DemandCurrent = motor.current();
    shown.InPosition = state_ == State::run && motor.in_position();
    shown.CurveActive = motor.curve_active();
    shown.InitDone = motor.homed();
    shown.Frozen = motor.frozen();
    shown.Errors = WORD{errors_[i]};
    shown.Warnings = WORD{warnings_[i]};
    show_curve_offset(i);
  }
  if (command_interface() == CommandInterface::profibus) write_words();
}

/// That the motor has changed; what somebody else has written since counts.
void LinMotController::show_curve_offset(std::size_t index) noexcept {
  LREAL &wanted = data.Motors[index].Parameters.curve_pos_offset, &taken = taken_[index].curve_pos_offset;
  const double offset = motors_[index].curve_offset();
  if (offset != taken && wanted == taken) wanted = taken = offset;
}

}  // namespace lockstep
