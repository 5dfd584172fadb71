/// The parameters of a LinMot controller: all that are published, declared once.
/// @source LinMot release 1.3 addendum, 6.1 to 6.9, 7.9
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tech_objects/linmot_catalogue/parameter.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::linmot {

inline constexpr std::size_t kMotors = 4;  ///< A to D

/// In published order.
std::span<const Parameter> system_parameters() noexcept;
/// Of every kind of motor; a path may be there once for each kind.
std::span<const Parameter> motor_parameters() noexcept;

/// Without regard to case; of a linear motor, or of all motors. nullptr: there is none.
const Parameter* find_system_parameter(std::string_view path) noexcept;
const Parameter* find_motor_parameter(std::string_view path) noexcept;

/// The name that a part of a path has as a signal: letters and digits, each word with a capital; "+" Plus,
/// "-" Minus, a leading digit behind the rest. Not in the cycle.
std::string signal_name(std::string_view part);
/// The name that a whole path has as a signal: `signal_name` of each part, with points. Not in the cycle.
std::string signal_path(std::string_view path);

/// As a number: an option by its index, on by 1. @param parameters the struct in which it has its place
double parameter_value(const Parameter& parameter, const void* parameters) noexcept;
void set_parameter(const Parameter& parameter, void* parameters, double value) noexcept;
/// The increment in which a protocol counts it; 1 where it has none.
double increment_of(const Parameter& parameter) noexcept;

enum class CommandInterface : std::uint8_t { at, mt, ascii_rs232, ascii_rs485, application, profibus };
enum class InitMode : std::uint8_t {
  actual_position,
  auto_move_out,
  auto_move_in,
  trig_move_out,
  trig_move_in
};
enum class RunMode : std::uint8_t { serial, analog, continuous_curve, trigger_curve, two_point };
enum class EmergencyStopMode : std::uint8_t { off, freeze, goto_position };
inline constexpr DINT kNoDrive = 0;
inline constexpr DINT kFirstOtherType = 11;  ///< types from here on are no linear motors

}  // namespace lockstep::linmot
