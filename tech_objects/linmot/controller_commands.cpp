// The multi-trigger controller: codes call rows of the state table.
#include <algorithm>
#include <cmath>

#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {

using namespace linmot;

namespace {

/// Cells count in whole increments.
double in_position_increments(double value) noexcept {
  return in_whole_increments(value, kPositionIncrement);
}

Limits limits_of_cell(const Cell& cell) noexcept {
  constexpr double kMillimetres = 1e3;  // a metre
  return {std::max(1, increments(cell.arguments[1], kVelocityIncrement)) * kVelocityIncrement * kMillimetres,
          std::max(1, increments(cell.arguments[2], kAccelerationIncrement)) * kAccelerationIncrement *
              kMillimetres};
}

}  // namespace

std::uint8_t LinMotController::raw_code() const noexcept {
  std::uint8_t code = 0;
  for (std::size_t i = 0; i < kMotors; ++i)
    if (is_on(motor_settings[i].trigger)) code |= static_cast<std::uint8_t>(1u << i);
  return code & table.active;
}

void LinMotController::read_code() noexcept {
  constexpr double kMilliseconds = 1e-3;
  const int ticks = static_cast<int>(std::ceil(data.Parameters.jitter_time * kMilliseconds / tick_ - 1e-9));
  if (!code_.step(raw_code(), ticks)) return;
  if (((code_.code() ^ code_.before()) & table.triggers) == 0) return;
  const CodeEntry& entry = table.codes[code_.code()];
  switch (entry.command) {
    case InputCommand::no_operation:
      return;
    case InputCommand::next:
      return call_row(row_ + 1);
    case InputCommand::previous:
      return call_row(row_ - 1);
    case InputCommand::repeat:
      return call_row(row_);
    case InputCommand::go_to:
      return call_row(entry.row);
  }
}

/// All cells of a row begin in the same control cycle. A row that is not there leaves the state as it is.
void LinMotController::call_row(int row) noexcept {
  if (row < 0 || row >= kStates || !table.rows[static_cast<std::size_t>(row)].exists) {
    refused_ = true;
    return;
  }
  row_ = row;
  const int acknowledge = static_cast<int>(std::ceil(data.Parameters.acknowledge_time * 1e-3 / tick_ - 1e-9));
  for (std::size_t i = 0; i < hardware->motors; ++i) {
    const Cell& cell = table.rows[static_cast<std::size_t>(row)].cells[i];
    if (!motors_[i].is_there() || cell.command == MtCommand::no_operation) continue;
    motors_[i].acknowledge(acknowledge);
    carry_out(i, cell);
  }
}

void LinMotController::start_curve(std::size_t index, double number, bool from_demand) noexcept {
  const Curve* const curve = motors_[index].curve_of(static_cast<std::int32_t>(number));
  if (curve == nullptr && number != 0.0) return tell_curve_missing(index);
  motors_[index].execute({.kind = Order::Kind::curve, .curve = curve, .from_demand = from_demand});
}

void LinMotController::carry_out(std::size_t index, const Cell& cell) noexcept {
  Motor& motor = motors_[index];
  MotorParameters& parameters = data.Motors[index].Parameters;
  const auto& values = cell.arguments;
  switch (cell.command) {
    case MtCommand::absolute_position:
    case MtCommand::absolute_from_actual:
      return motor.execute({.position = in_position_increments(values[0]),
                            .limits = limits_of_cell(cell),
                            .from_actual = cell.command == MtCommand::absolute_from_actual});
    case MtCommand::relative_position:
      return motor.execute({.kind = Order::Kind::increment,
                            .position = in_position_increments(values[0]),
                            .limits = limits_of_cell(cell)});
    case MtCommand::curve:
      return start_curve(index, values[0], false);
    case MtCommand::curve_from_demand:
      return start_curve(index, values[0], true);
    case MtCommand::move_home_position:
      refused_ |= !move_names(index, -in_position_increments(values[0]), true);
      return;
    case MtCommand::redefine_position:
      refused_ |= !move_names(index, in_position_increments(values[0]) - motor.actual(), false);
      return;
    case MtCommand::demand_to_actual:
      return motor.demand_to_actual();
    case MtCommand::stop:
      return motor.stop(values[0]);
    case MtCommand::freeze:
      frozen_by_row_[index] = true;
      return freeze_motors();
    case MtCommand::unfreeze:
      frozen_by_row_[index] = false;
      return freeze_motors();
    case MtCommand::set_current:
      parameters.maximal_current = in_whole_increments(values[0], kCurrentIncrement);
      break;
    case MtCommand::set_current_offset:
      parameters.current_offset = in_whole_increments(values[0], kCurrentIncrement);
      break;
    case MtCommand::set_feed_forward:
      parameters.ff_friction = values[0];
      parameters.ff_acceleration = values[1];
      parameters.ff_deceleration = values[2];
      break;
    case MtCommand::set_pid:
      parameters.proportional = values[0];
      parameters.integral = values[1];
      parameters.derivative = values[2];
      break;
    case MtCommand::set_curve_parameters:
      parameters.curve_pos_offset = in_position_increments(values[0]);
      parameters.curve_amplitude = values[1];
      parameters.curve_speed = values[2];
      break;
    default:
      return;
  }
  take_parameters(index);
}

}  // namespace lockstep
