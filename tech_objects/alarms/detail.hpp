/// What is at hand when an alarm comes: which of its causes it is, at which address, and the values.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace lockstep {

/// Which of the causes of an alarm it is, or what it concerns. The numbers are what a panel reads.
enum class AlarmCause : std::uint8_t {
  none = 0,                  ///< the alarm has one cause
  positive_side = 1,         ///< limit, switch or end of a range
  negative_side = 2,         ///< limit, switch or end of a range
  approach_velocity = 3,     ///< of homing, is 0
  referencing_velocity = 4,  ///< of homing, is 0
  no_reference_switch = 5,   ///< homing finds no switch that it could look for
  no_zero_mark = 6,          ///< homing finds no zero mark that it could look for
  acceleration = 7,
  deceleration = 8,
  late_in_window = 9,   ///< of positioning
  left_window = 10,     ///< of positioning
  not_assigned = 11,    ///< the leading object
  values_invalid = 12,  ///< of the leading object
  restarted = 13,       ///< the leading object
  enabled = 14,         ///< the object, which was to restart
  in_use = 15,          ///< the cam, which was to restart
  used_by = 16          ///< another object
};

/// Made in the cycle, told outside of it. What is not known is 0, values NaN.
struct AlarmDetail {
  AlarmCause cause{};
  std::uint8_t sensor = 0;                                  ///< number of the sensor, from 1
  std::uint16_t object = 0;                                 ///< number of another object that it concerns
  double value = std::numeric_limits<double>::quiet_NaN();  ///< measured, in the unit of the alarm
  double limit = std::numeric_limits<double>::quiet_NaN();  ///< what it was held against
};

/// A cause in words, and its remedy where that is another one than that of the alarm.
struct CauseText {
  AlarmCause cause;
  std::string_view text;
  std::string_view remedy;
};
const CauseText& cause_text(AlarmCause cause) noexcept;
std::span<const CauseText> alarm_causes() noexcept;

/// The side of a limit: 1, the positive one, or -1.
constexpr AlarmCause side_of(int side) noexcept {
  return side > 0 ? AlarmCause::positive_side : AlarmCause::negative_side;
}

}  // namespace lockstep
