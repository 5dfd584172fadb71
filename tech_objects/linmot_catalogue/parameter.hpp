/// What a LinMot controller and its motors are set by, and how a parameter is declared.
/// @source LinMot release 1.3 addendum, 6.1 to 6.9, 7.9
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::linmot {

/// Parameters of a controller that have an effect, with their start values.
struct SystemParameters {
  BOOL error_mask_dclv_power_too_low = true;
  BOOL error_mask_dclv_power_too_high = true;
  BOOL error_mask_dclv_signal_too_low = true;
  BOOL error_mask_dclv_signal_too_high = true;
  BOOL error_mask_electronic_fault = true;
  BOOL warn_mask_dclv_power_low = true;
  BOOL warn_mask_dclv_power_high = true;
  BOOL warn_mask_dclv_signal_low = true;
  BOOL warn_mask_dclv_signal_high = true;
  BOOL warn_mask_electronic_fault = true;
  BOOL msg_mask_dclv_power_too_low = false;
  BOOL msg_mask_dclv_power_too_high = false;
  BOOL msg_mask_dclv_signal_too_low = false;
  BOOL msg_mask_dclv_signal_too_high = false;
  BOOL msg_mask_electronic_fault = false;
  BOOL msg_mask_drive_type_mismatch = false;
  BOOL msg_mask_curve_error = false;
  BOOL msg_mask_slider_missing = false;
  BOOL msg_mask_init_failed = false;
  BOOL msg_mask_drive_following_error = false;
  BOOL msg_mask_drive_too_hot_calculated = false;
  BOOL msg_mask_drive_too_hot_sensor = false;
  BOOL msg_mask_in_position = false;
  BOOL auto_start = false;
  BOOL init_together = true;
  BOOL run_input = false;
  BOOL init_input = false;
  BOOL freeze_input = false;
  BOOL emerg_stop_input = false;
  BOOL analog_trig_drive_a = true;
  BOOL analog_trig_drive_b = true;
  BOOL analog_trig_drive_c = true;
  BOOL analog_trig_drive_d = true;
  BOOL error_output = true;
  BOOL warn_output = true;
  BOOL pos_error_output = true;
  BOOL msg_output = true;
  DINT command_interface = 0;
  LREAL jitter_time = 5.0;
  LREAL acknowledge_time = 20.0;
  DINT mt_output_3 = 0;
  DINT mt_output_4 = 0;
  BOOL bytes_reversed = false;
};

/// Parameters of one motor that have an effect, with the start values of a linear motor.
struct MotorParameters {
  DINT type = 0;
  DINT init_mode = 0;
  BOOL init_once = false;
  LREAL init_speed = 0.05;
  LREAL maximal_init_current = 10.0;
  LREAL home_position = 0.0;
  LREAL check_init_position = 0.0;
  LREAL initial_position = 0.0;
  DINT run_mode = 0;
  LREAL minimal_position = -630.0;
  LREAL maximal_position = 630.0;
  LREAL position_0v = 0.0;
  LREAL position_10v = 100.0;
  LREAL position_0 = 0.0;
  LREAL position_1 = 100.0;
  DINT curve_number = 0;
  DINT rise_curve_number = 0;
  DINT fall_curve_number = 0;
  LREAL curve_pos_offset = 0.0;
  LREAL curve_amplitude = 100.0;
  LREAL curve_speed = 100.0;
  LREAL max_speed = 0.78125;
  LREAL max_acceleration = 30.517578125;
  LREAL pos_range_min = -630.0;
  LREAL pos_range_max = 630.0;
  LREAL in_position_minus = 1.0;
  LREAL in_position_plus = 1.0;
  LREAL following_error_minus = 50.0;
  LREAL following_error_plus = 50.0;
  LREAL maximal_current = 3.0;
  LREAL current_offset = 0.0;
  LREAL proportional = 1.0;
  LREAL derivative = 4.0;
  LREAL integral = 0.0;
  LREAL ff_friction = 0.0;
  LREAL ff_acceleration = 0.0;
  LREAL ff_deceleration = 0.0;
  BOOL range_3a = false;
  BOOL error_mask_drive_type_mismatch = true;
  BOOL error_mask_curve_error = true;
  BOOL error_mask_slider_missing = true;
  BOOL error_mask_init_failed = true;
  BOOL error_mask_drive_following_error = true;
  BOOL error_mask_drive_too_hot_calculated = true;
  BOOL error_mask_drive_too_hot_sensor = true;
  BOOL warn_mask_slider_missing = true;
  BOOL warn_mask_drive_init_not_done = true;
  BOOL warn_mask_pos_range_indicator = true;
  BOOL warn_mask_drive_following_error = true;
  BOOL warn_mask_drive_too_hot_calculated = true;
  BOOL warn_mask_drive_hot_sensor = true;
  BOOL warn_mask_in_position = false;
  DINT emergency_stop_mode = 0;
  LREAL stop_position = 0.0;
  LREAL emergency_max_speed = 0.78125;
  LREAL emergency_max_acceleration = 30.517578125;

  bool operator==(const MotorParameters&) const = default;
};

/// Of what a parameter is one.
enum class Scope : std::uint8_t { system, motor, linear_motor, stepper, magnet, position_sensor };
/// What stands there.
enum class Kind : std::uint8_t {
  value,
  whole,  ///< a whole number
  on_off,
  choice,  ///< one of its options
  shown    ///< the controller tells it
};

inline constexpr std::uint8_t kLive = 1;      ///< may be changed at run time
inline constexpr std::uint8_t kReadOnly = 2;  ///< nobody sets it
inline constexpr std::uint8_t kPrinted = 4;  ///< its start value is printed; else it is this program's choice
inline constexpr std::size_t kNowhere = ~std::size_t{0};

struct Parameter {
  std::string_view path;  ///< as printed; that of a motor begins behind its drive
  Scope scope;
  Kind kind;
  std::string_view unit;
  Range range;  ///< of a value or whole number
  std::span<const std::string_view> options;
  std::uint8_t flags;
  std::size_t offset;  ///< in `SystemParameters` or `MotorParameters` [byte]; kNowhere: it has no effect
  std::string_view text;

  bool live() const noexcept { return (flags & kLive) != 0; }
  bool read_only() const noexcept { return (flags & kReadOnly) != 0; }
  bool printed() const noexcept { return (flags & kPrinted) != 0; }
  bool effective() const noexcept { return offset != kNowhere; }
};

}  // namespace lockstep::linmot
