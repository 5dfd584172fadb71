/// What one declaration of a pin or a data-block variable says: units, ranges and effect classes.
/// A declaration feeds wiring, expressions, `describe`, traces, Modbus and the schema alike.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Unit of a number. Leading and following quantities are in the user units of the axis they belong to.
enum class Unit : std::uint8_t {
  kNone,          ///< no unit, or a flag
  kPosition,      ///< [u] user unit of the axis: mm or °
  kVelocity,      ///< [u/s]
  kAcceleration,  ///< [u/s²]
  kJerk,          ///< [u/s³]
  kLeading,       ///< [u] of the leading axis
  kSeconds,       ///< [s]
  kPercent,       ///< [%]
  kSpeed,         ///< [1/min]
  kTorque,        ///< [Nm]
  kForce,         ///< [N]
  kPerSecond,     ///< [1/s]
  kMilliseconds   ///< [ms]
};

/// Text of a unit, such as "u/s²"; empty for none.
constexpr std::string_view unit_text(Unit unit) noexcept {
  constexpr std::string_view texts[] = {"",  "u",     "u/s", "u/s²", "u/s³", "u (leading)", "s",
                                        "%", "1/min", "Nm",  "N",    "1/s",  "ms"};
  return texts[static_cast<std::size_t>(unit)];
}

/// Range of permitted values. For an integer or LREAL: lowest ≤ value ≤ highest, less `excluded` where that
/// is a number.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  double excluded = std::numeric_limits<double>::quiet_NaN();

  constexpr bool allows(double value) const noexcept {
    return value >= lowest && value <= highest && value != excluded;  // NaN fails the first comparison
  }
  constexpr bool unbounded() const noexcept {
    return lowest == -std::numeric_limits<double>::infinity() &&
           highest == std::numeric_limits<double>::infinity() && excluded != excluded;
  }
};

/// Any value of the type; a REAL or LREAL has to be finite wherever it is used.
inline constexpr Range kAny{};
/// A dynamic value: > 0 is used, < 0 means the default of the technology object, 0 is not permitted.
inline constexpr Range kNotZero{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), 0.0};
inline constexpr Range kFinite{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
/// Greater than 0.
inline constexpr Range kPositive{std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::max()};

/// One value of an enumeration and what it means.
struct Choice {
  std::int64_t value;
  std::string_view text;
};

/// When a change of a data-block variable takes effect.
/// @source S7-1500T synchronous operation V7, 13.1.1
enum class Effect : std::uint8_t {
  DIR,  ///< by direct assignment, from the next MC_Servo
  CAL,  ///< by direct assignment, from the next call of the instruction concerned
  RES,  ///< only with a restart of the technology object
  RON   ///< read-only at run time
};

}  // namespace lockstep
