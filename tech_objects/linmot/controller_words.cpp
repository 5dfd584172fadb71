// PROFIBUS: words from the bus into requests and demands, states and positions into words to the bus.
#include <algorithm>

#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {

using namespace linmot;

namespace {

bool bit(std::uint16_t word, int number) noexcept {
  return (word >> number & 1) != 0;
}

std::uint16_t value_of(WORD word) noexcept {
  return static_cast<std::uint16_t>(word);
}

/// As the module has it: with a sign where its range begins below 0.
std::int32_t number_in(std::uint16_t word, std::int32_t lowest) noexcept {
  return lowest < 0 ? static_cast<std::int16_t>(word) : word;
}

}  // namespace

void LinMotController::read_words() noexcept {
  out_of_range_ = false;
  for (const ModulePlace& place : image.places) read_word(place);
}

void LinMotController::read_control(std::uint16_t word) noexcept {
  flags_.run = bit(word, 1);
  flags_.stop = bit(word, 2);
  flags_.init = bit(word, 3);
  flags_.freeze = bit(word, 4);
  constexpr int kFirstTrigger = 8, kFirstFreeze = 12;
  for (std::size_t i = 0; i < kMotors; ++i) {
    const int motor = static_cast<int>(i);
    flags_.freeze_motor[i] = bit(word, kFirstFreeze + motor);
    bus_triggers_[i] = bit(word, kFirstTrigger + motor) || is_on(wired_triggers_[i]);
  }
}

/// A value out of its range changes nothing, and leads to ERROR.
void LinMotController::read_word(const ModulePlace& place) noexcept {
  if (place.module == Module::next_drive) return;
  const ModuleRow& row = modules()[static_cast<std::size_t>(place.module)];
  if (row.out_words == 0) return;
  const std::uint16_t word = value_of(data.ProfibusOut[place.out]);
  if (place.module == Module::control_status) {
    if (place.out == 0) read_control(word);
    return;
  }
  if (place.module == Module::command) return read_command(word, value_of(data.ProfibusOut[place.out + 1u]));
  if (place.module == Module::run_curve || place.module == Module::run_incremental_curve)
    return read_run_curve(place, word);
  const std::int32_t value = number_in(word, row.lowest);
  if (value < row.lowest || value > row.highest) {
    out_of_range_ = true;
    return;
  }
  MotorParameters& parameters = data.Motors[place.motor].Parameters;
  MotorWords& words = words_[place.motor];
  Motor& motor = motors_[place.motor];
  switch (place.module) {
    case Module::max_acceleration:
      parameters.max_acceleration = value * kAccelerationIncrement;
      return;
    case Module::max_speed:
      // The published range begins below that of the parameter.
      parameters.max_speed = std::max(value, 6) * kVelocityIncrement;
      return;
    case Module::max_current:
      parameters.maximal_current = value * kCurrentIncrement;
      return;
    case Module::set_curve_speed:
      parameters.curve_speed = value * kPercentIncrement;
      return;
    case Module::set_curve_amplitude:
      parameters.curve_amplitude = value * kPercentIncrement;
      return;
    case Module::set_curve_offset:
      parameters.curve_pos_offset = value * kPositionIncrement;
      return;
    case Module::set_position: {
      if (words.locked || (words.position_known && words.position == value)) return;
      if (state_ == State::init) return;
      words.position = value;
      words.position_known = state_ == State::run;
      if (state_ != State::run) return motor.set_demand(value * kPositionIncrement);
      Order order{.position = value * kPositionIncrement, .follows_filter = true};
      order.limits = motor.filter();
      return motor.execute(order);
    }
    default:
      return;
  }
}

void LinMotController::read_run_curve(const ModulePlace& place, std::uint16_t word) noexcept {
  constexpr int kToggle = 15, kCyclic = 14, kDelayed = 13, kIncremental = 12;
  MotorWords& words = words_[place.motor];
  if (bit(word, kToggle) == words.run_curve_toggle) return;
  words.run_curve_toggle = bit(word, kToggle);
  if (state_ != State::run) return;
  Motor& motor = motors_[place.motor];
  const int number = word & 0x3F;
  const Curve* const curve = motor.curve_of(number);
  words.locked = true;
  if (number != 0 && curve == nullptr) return tell_curve_missing(place.motor);
  words.running = curves_run_ = true;
  words.done_toggle = !words.run_curve_toggle;
  Order order{.kind = Order::Kind::curve, .curve = curve, .cyclic = bit(word, kCyclic)};
  order.from_demand = bit(word, kIncremental) || place.module == Module::run_incremental_curve;
  if (bit(word, kDelayed) && motor.curve_active())
    motor.run_after_this(order);
  else
    motor.execute(order);
}

/// A command begins whenever its toggle changes; one that is not known does nothing.
void LinMotController::read_command(std::uint16_t word, std::uint16_t value) noexcept {
  constexpr int kToggle = 11, kFirstMotor = 12;
  if (bit(word, kToggle) == command_toggle_) return;
  const auto id = static_cast<std::uint8_t>(word & 0xFF);
  const auto known = std::find_if(module_commands().begin(), module_commands().end(),
                                  [id](const ModuleCommand& command) { return command.id == id; });
  if (known == module_commands().end()) {
    refused_ |= word != unknown_command_;
    unknown_command_ = word;
    return;
  }
  const std::int32_t number = number_in(value, known->lowest);
  const bool ranged = known->lowest != known->highest;
  if (ranged && (number < known->lowest || number > known->highest)) {
    out_of_range_ = true;
    return;
  }
  command_toggle_ = bit(word, kToggle);
  for (std::size_t i = 0; i < hardware->motors; ++i)
    if (bit(word, kFirstMotor + static_cast<int>(i)) && motors_[i].is_there()) command_motor(i, id, number);
  executed_toggle_ = command_toggle_;
}

void LinMotController::command_motor(std::size_t index, std::uint8_t id, std::int32_t value) noexcept {
  MotorParameters& parameters = data.Motors[index].Parameters;
  Motor& motor = motors_[index];
  switch (id) {
    case 0x01:
      words_[index].locked = true;
      refused_ |= !move_names(index, value * kPositionIncrement - motor.actual(), false);
      return;
    case 0x02:
      words_[index].locked = true;
      refused_ |= !move_names(index, -value * kPositionIncrement, false);
      return;
    case 0x03:
      words_[index].locked = false;
      words_[index].position_known = false;
      return;
    case 0x04:
      return motor.demand_to_actual();
    case 0x10:
      parameters.proportional = value * kProportionalIncrement;
      return;
    case 0x11:
      parameters.integral = value * kIntegralIncrement;
      return;
    case 0x12:
      parameters.derivative = value * kDerivativeIncrement;
      return;
    case 0x13:
      parameters.ff_friction = value * kCurrentIncrement;
      return;
    case 0x14:
      parameters.ff_acceleration = value * kFeedForwardIncrement;
      return;
    case 0x15:
      parameters.ff_deceleration = value * kFeedForwardIncrement;
      return;
    case 0x16:
      parameters.current_offset = value * kCurrentIncrement;
      return;
    default:
      return;
  }
}

/// Curve Done is what the toggle is, once the curve is over.
void LinMotController::follow_curves() noexcept {
  curves_run_ = false;
  for (std::size_t i = 0; i < hardware->motors; ++i) {
    MotorWords& words = words_[i];
    if (!words.running) continue;
    words.running = state_ == State::run && !motors_[i].curves_over();
    if (!words.running) words.done_toggle = words.run_curve_toggle;
    curves_run_ = curves_run_ || words.running;
  }
}

std::uint16_t LinMotController::status_word() const noexcept {
  const std::uint16_t bits = state_bits();
  std::uint16_t word = 0;
  const auto add = [&word](bool on, int number) {
    if (on) word |= static_cast<std::uint16_t>(1u << number);
  };
  add(all_homed(), 0);
  add(state_ == State::run, 1);
  add(state_ == State::error, 2);
  add(state_ == State::init, 3);
  add(state_ == State::disable, 4);
  add(executed_toggle_, 5);
  add(bit(bits, 4), 6);
  add(bit(bits, 5), 7);
  for (std::size_t i = 0; i < kMotors; ++i) {
    add(words_[i].done_toggle, 8 + static_cast<int>(i));
    add(data.Motors[i].InPosition, 12 + static_cast<int>(i));
  }
  return word;
}

void LinMotController::write_words() noexcept {
  for (const ModulePlace& place : image.places) {
    const Motor& motor = motors_[place.motor];
    std::uint16_t word = 0;
    if (place.module == Module::control_status) {
      word = status_word();
    } else if (place.module == Module::get_position) {
      const std::int32_t position = increments(motor.actual(), kPositionIncrement);
      const bool valid = motor.homed() && position >= -kPositionReach && position <= kPositionReach;
      word = static_cast<std::uint16_t>(valid ? position : kNoPosition);
    } else if (place.module == Module::get_current) {
      word = static_cast<std::uint16_t>(increments(motor.current(), kCurrentIncrement));
    } else {
      continue;
    }
    data.ProfibusIn[place.in] = WORD{word};
  }
  const std::size_t low = data.Parameters.bytes_reversed ? 1 : 0, high = 1 - low;
  const auto split = [low, high](WORD word, BYTE* bytes) {
    bytes[low] = BYTE{static_cast<std::uint8_t>(value_of(word) & 0xFF)};
    bytes[high] = BYTE{static_cast<std::uint8_t>(value_of(word) >> 8)};
  };
  for (std::size_t i = 0; i < image.out_words; ++i) split(data.ProfibusOut[i], &data.ProfibusOutByte[2 * i]);
  for (std::size_t i = 0; i < image.in_words; ++i) split(data.ProfibusIn[i], &data.ProfibusInByte[2 * i]);
}

}  // namespace lockstep
