/// Counts and user units.
/// @source MCO 305 Design Guide, user units
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/arithmetic/nearest.hpp"

namespace lockstep::mco305 {

inline constexpr double kMillisecondsPerSecond = 1000.0;

/// Bounds of what is computed, far beyond any machine: with parameters of any value nothing overflows.
inline constexpr double kFastest = 1'073'741'824.0;               ///< [qc/ms]
inline constexpr std::int64_t kFarthest = std::int64_t{1} << 60;  ///< [qc]

constexpr std::int64_t within_reach(std::int64_t counts) noexcept {
  if (counts > kFarthest || counts < -kFarthest) [[unlikely]]
    return counts > 0 ? kFarthest : -kFarthest;
  return counts;
}
/// The count at or below a position.
inline std::int64_t counts_of(double position) noexcept {
  constexpr auto kFar = static_cast<double>(kFarthest);
  if (!(std::abs(position) < kFar)) return position > 0.0 ? kFarthest : -kFarthest;
  const auto cut = static_cast<std::int64_t>(position);
  return static_cast<double>(cut) > position ? cut - 1 : cut;
}
inline std::int64_t nearest_count(double position) noexcept {
  return counts_of(position + 0.5);
}
/// `nearest_count` as a double: quicker where the position is not in the middle between two counts.
inline double nearest_whole(double position) noexcept {
  constexpr double kFar = 2251799813685248.0, kEdge = 0.49;  // kFar: 2⁵¹
  const double whole = nearest(position);
  if (std::abs(position - whole) < kEdge && std::abs(position) < kFar) [[likely]]
    return whole;
  return static_cast<double>(nearest_count(position));
}
/// The floor, without the call that it takes where the processor has no instruction for it.
inline double whole_below(double value) noexcept {
  constexpr double kWhole = 4503599627370496.0;  // 2^52: from here on there is nothing behind the point
  if (!(std::abs(value) < kWhole)) return value;
  const auto cut = static_cast<double>(static_cast<std::int64_t>(value));
  return cut > value ? cut - 1.0 : cut;
}

/// ENCODERTYPE, MENCODERTYPE of two digits: the first one is the encoder input, 1: X56, 2: X55; 0: none is
/// named.
constexpr std::int32_t encoder_input_of(std::int32_t type) noexcept {
  return type >= 10 && type < 30 ? type / 10 : 0;
}

/// SYNCMTYPM, SYNCMTYPS: the later edition has two more digits, which name an input.
struct MarkerType {
  std::int32_t type = 0;   ///< 0, 1: zero pulse; 2: rising edge, 3: falling edge
  std::int32_t input = 0;  ///< 0: none is named
};
constexpr MarkerType marker_type_of(std::int32_t value, bool later_edition) noexcept {
  constexpr std::int32_t kTen = 10, kLastInput = 33;
  const std::int32_t input = value / kTen, type = value % kTen;
  if (!later_edition || input < 1 || input > kLastInput || (type != 2 && type != 3)) return {value, 0};
  return {type, input};
}

/// 1 user unit = numerator / denominator counts (qc); both > 0.
struct UserUnit {
  std::int64_t numerator = 1;    ///< POSFACT_Z
  std::int64_t denominator = 1;  ///< POSFACT_N
  std::int64_t sign = 1;         ///< POSDRCT 3, 4: -1

  bool operator==(const UserUnit&) const = default;
  /// Cut towards 0. Exact for 32 bits on all sides.
  constexpr std::int64_t counts(std::int64_t units) const noexcept {
    if (denominator == 1) return sign * units * numerator;
    return sign * (units * numerator / denominator);
  }
  /// Rounded, half away from 0. @param counts within ±2^32
  constexpr std::int64_t units(std::int64_t counts) const noexcept {
    if (numerator == 1 && denominator == 1) return sign * counts;  // what costs no division
    const std::int64_t scaled = sign * counts * denominator;
    const std::int64_t half = numerator / 2;
    return scaled < 0 ? -((-scaled + half) / numerator) : (scaled + half) / numerator;
  }
};

/// A position as a program sees it: -2³⁰ … 2³⁰ - 1, wrapping at 2³¹.
constexpr std::int32_t shown_position(std::int64_t position) noexcept {
  constexpr std::int64_t kHalf = std::int64_t{1} << 30;
  return static_cast<std::int32_t>(((position + kHalf) & (2 * kHalf - 1)) - kHalf);
}

}  // namespace lockstep::mco305
