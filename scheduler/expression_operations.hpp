/// What the operators and conversions of IEC 61131-3 compute, for each type that computes: the C++ integers,
/// REAL and LREAL. Bit strings and TIME compute as integers of their width. Total functions: no value is
/// undefined.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "scheduler/instruction.hpp"

namespace lockstep::expression_steps {

using Word = std::uint64_t;

template <class T>
concept Integer = std::integral<T> && !std::same_as<T, bool>;
template <class T>
concept Number = Integer<T> || std::floating_point<T>;

// Unsigned arithmetic wraps; the conversion back to T keeps the low bits.
struct Add {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    if constexpr (Integer<T>)
      return static_cast<T>(static_cast<Word>(a) + static_cast<Word>(b));
    else
      return a + b;
  }
};
struct Subtract {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    if constexpr (Integer<T>)
      return static_cast<T>(static_cast<Word>(a) - static_cast<Word>(b));
    else
      return a - b;
  }
};
struct Multiply {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    if constexpr (Integer<T>)
      return static_cast<T>(static_cast<Word>(a) * static_cast<Word>(b));
    else
      return a * b;
  }
};
struct Divide {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters& counters) noexcept {
    if constexpr (Integer<T>) {
      if (b == 0) {
        ++counters.integer_divisions_by_zero;
        return 0;
      }
      if constexpr (std::signed_integral<T>)
        if (b == -1) return static_cast<T>(Word{0} - static_cast<Word>(a));  // the minimum number wraps
      return static_cast<T>(a / b);
    } else {
      return a / b;
    }
  }
};
struct Modulo {
  template <Integer T>
  static T apply(T a, T b, EvaluationCounters& counters) noexcept {
    if (b == 0) {
      ++counters.integer_divisions_by_zero;
      return 0;
    }
    if constexpr (std::signed_integral<T>)
      if (b == -1) return 0;
    return static_cast<T>(a % b);
  }
};
struct Power {
  template <std::floating_point T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return static_cast<T>(std::pow(static_cast<double>(a), static_cast<double>(b)));
  }
};
struct Atan2 {
  template <std::floating_point T>
  static T apply(T y, T x, EvaluationCounters&) noexcept {
    return static_cast<T>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
  }
};
struct Less {
  template <Number T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a < b;
  }
};
struct LessEqual {
  template <Number T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a <= b;
  }
};
struct Greater {
  template <Number T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a > b;
  }
};
struct GreaterEqual {
  template <Number T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a >= b;
  }
};
struct Equal {
  template <class T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a == b;
  }
};
struct Unequal {
  template <class T>
  static bool apply(T a, T b, EvaluationCounters&) noexcept {
    return a != b;
  }
};
struct And {
  template <std::unsigned_integral T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return static_cast<T>(a & b);
  }
};
struct Or {
  template <std::unsigned_integral T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return static_cast<T>(a | b);
  }
};
struct Xor {
  template <std::unsigned_integral T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return static_cast<T>(a ^ b);
  }
};
struct Minimum {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return a < b || a != a ? a : b;  // a NaN on either side is the result
  }
};
struct Maximum {
  template <Number T>
  static T apply(T a, T b, EvaluationCounters&) noexcept {
    return a > b || a != a ? a : b;
  }
};

/// The bits of a bit string moved by a count, which is a LINT.
template <Operation operation, class T>
T moved(T bits, std::int64_t count) noexcept {
  constexpr int width = std::numeric_limits<T>::digits;
  if (count <= 0) return bits;
  if constexpr (operation == Operation::kRotateLeft) return std::rotl(bits, static_cast<int>(count % width));
  if constexpr (operation == Operation::kRotateRight) return std::rotr(bits, static_cast<int>(count % width));
  if (count >= width) return 0;
  return static_cast<T>(operation == Operation::kShiftLeft ? static_cast<Word>(bits) << count
                                                           : static_cast<Word>(bits) >> count);
}

/// From one representation to another: a real is rounded to the nearest integer, and
/// brought into its range.
template <class From, class To>
To converted(From value) noexcept {
  if constexpr (std::same_as<To, bool>) {
    return value != From{};
  } else if constexpr (std::floating_point<From> && Integer<To>) {
    if (value != value) return 0;
    const double nearest = std::nearbyint(static_cast<double>(value));
    constexpr auto lowest = static_cast<double>(std::numeric_limits<To>::min());
    constexpr double above = 2.0 * static_cast<double>(Word{1} << (std::numeric_limits<To>::digits - 1));
    if (nearest < lowest) return std::numeric_limits<To>::min();
    if (nearest >= above) return std::numeric_limits<To>::max();
    return static_cast<To>(nearest);
  } else {
    return static_cast<To>(value);
  }
}

}  // namespace lockstep::expression_steps
