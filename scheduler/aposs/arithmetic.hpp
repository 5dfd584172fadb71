/// Integer arithmetic of APOSS: 32 bits, wrapping. The compiler folds constants with the same functions.
/// @source MCO 305 Design Guide, elements of the programming language; arithmetic, operators
#pragma once

#include <cstdint>

namespace lockstep::aposs {

/// The low 32 bits as a signed number.
constexpr std::int32_t wrapped(std::int64_t value) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

/// What a position or a time shows: −2³⁰ … 2³⁰−1, wrapping at 2³¹.
constexpr std::int32_t wrapped_position(std::int64_t value) noexcept {
  constexpr std::int64_t kHalf = std::int64_t{1} << 30;
  return static_cast<std::int32_t>(((value + kHalf) & (2 * kHalf - 1)) - kHalf);
}

constexpr std::int32_t sum(std::int32_t a, std::int32_t b) noexcept {
  return wrapped(std::int64_t{a} + b);
}
constexpr std::int32_t difference(std::int32_t a, std::int32_t b) noexcept {
  return wrapped(std::int64_t{a} - b);
}
constexpr std::int32_t product(std::int32_t a, std::int32_t b) noexcept {
  return wrapped(std::int64_t{a} * b);
}
constexpr std::int32_t negative(std::int32_t a) noexcept {
  return wrapped(-std::int64_t{a});
}
constexpr std::int32_t absolute(std::int32_t a) noexcept {
  return a < 0 ? negative(a) : a;
}

/// `a % b`: the quotient, cut towards 0; 0 where b is 0, which the caller counts.
constexpr std::int32_t quotient(std::int32_t a, std::int32_t b) noexcept {
  return b == 0 ? 0 : wrapped(std::int64_t{a} / b);
}
/// `a mod b`: what that division leaves, with the sign of a; 0 where b is 0.
constexpr std::int32_t remainder(std::int32_t a, std::int32_t b) noexcept {
  return b == 0 ? 0 : wrapped(std::int64_t{a} % b);
}
/// `a rnd b`: the quotient, rounded, half away from 0; 0 where b is 0.
constexpr std::int32_t rounded_quotient(std::int32_t a, std::int32_t b) noexcept {
  if (b == 0) return 0;
  const std::int64_t above = a < 0 ? -std::int64_t{a} : a;
  const std::int64_t below = b < 0 ? -std::int64_t{b} : b;
  const std::int64_t size = (2 * above + below) / (2 * below);
  return wrapped((a < 0) == (b < 0) ? size : -size);
}

/// Shifts by 0 to 31; any other number of places shifts everything out.
constexpr std::int32_t shifted_left(std::int32_t a, std::int32_t places) noexcept {
  return places < 0 || places > 31
             ? 0
             : wrapped(static_cast<std::int64_t>(static_cast<std::uint32_t>(a)) << places);
}
/// The sign comes in from the left.
constexpr std::int32_t shifted_right(std::int32_t a, std::int32_t places) noexcept {
  return a >> (places < 0 || places > 31 ? 31 : places);
}

/// A part of a number: its bits (1 to 32), bytes (1 to 4) or words (1, 2), counted from the lowest.
template <int width>
struct Part {
  static constexpr int kParts = 32 / width;
  static constexpr std::uint32_t kMask = (std::uint64_t{1} << width) - 1;

  static constexpr bool exists(std::int32_t number) noexcept { return number >= 1 && number <= kParts; }
  /// Without a sign; 0 where there is no such part.
  static constexpr std::int32_t of(std::int32_t value, std::int32_t number) noexcept {
    if (!exists(number)) return 0;
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(value) >> ((number - 1) * width)) & kMask);
  }
  /// The value with the low bits of `part` there; unchanged where there is no such part.
  static constexpr std::int32_t with(std::int32_t value, std::int32_t number, std::int32_t part) noexcept {
    if (!exists(number)) return value;
    const int shift = (number - 1) * width;
    const std::uint32_t rest = static_cast<std::uint32_t>(value) & ~(kMask << shift);
    return static_cast<std::int32_t>(rest | ((static_cast<std::uint32_t>(part) & kMask) << shift));
  }
};
using BitOf = Part<1>;
using ByteOf = Part<8>;
using WordOf = Part<16>;

}  // namespace lockstep::aposs
