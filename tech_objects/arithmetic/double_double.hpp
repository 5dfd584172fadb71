/// Numbers of twice the precision of a double: an unevaluated sum of two doubles, about 106 bits.
/// Built from error-free transformations (Dekker, Knuth) with plain additions and multiplications, so that
/// the result is the same on every processor. Arguments are finite and below 2^990 in magnitude; where a
/// product's low part falls below 2^-1022 it is lost.
#pragma once

#include <bit>
#include <cstdint>

namespace lockstep {

/// hi + lo with |lo| ≤ half an ulp of hi: hi is the value rounded to a double.
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;

  constexpr double rounded() const noexcept { return hi; }
};

/// a + b exactly.
constexpr DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a + b exactly, for |a| ≥ |b| or a = 0.
constexpr DoubleDouble quick_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a - b exactly.
constexpr DoubleDouble two_difference(double a, double b) noexcept {
  return two_sum(a, -b);
}

/// A double cut into two halves of 26 bits, whose products with another's halves are exact.
struct Halves {
  double high = 0.0;
  double low = 0.0;
};

constexpr Halves halves(double a) noexcept {
  const double scaled = 134217729.0 * a;  // 2^27 + 1
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// a * b exactly; b comes with its halves, which a caller may keep.
constexpr DoubleDouble two_product(double a, double b, Halves b_halves) noexcept {
  const double product = a * b;
  const Halves a_halves = halves(a);
  const double rest = ((a_halves.high * b_halves.high - product) + a_halves.high * b_halves.low +
                       a_halves.low * b_halves.high) +
                      a_halves.low * b_halves.low;
  return {product, rest};
}

constexpr DoubleDouble two_product(double a, double b) noexcept {
  return two_product(a, b, halves(b));
}

constexpr DoubleDouble operator-(DoubleDouble a) noexcept {
  return {-a.hi, -a.lo};
}

/// Sum, within 2^-104 of it even where the terms cancel.
constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  const DoubleDouble part = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(part.hi, part.lo + low.lo);
}

constexpr DoubleDouble operator+(DoubleDouble a, double b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b);
  return quick_two_sum(high.hi, high.lo + a.lo);
}

/// a + b rounded to a double: the same bits as (a + b).rounded(), without what is left behind them.
constexpr double rounded_sum(DoubleDouble a, double b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b);
  return high.hi + (high.lo + a.lo);
}

/// a + b as a double, within an ulp of it; as exact as the one above where b.lo is 0.
constexpr double rounded_sum(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  return high.hi + (high.lo + (a.lo + b.lo));
}

constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept {
  return a + -b;
}

constexpr DoubleDouble operator-(DoubleDouble a, double b) noexcept {
  return a + -b;
}

/// a - b as a double, within an ulp of it.
constexpr double rounded_difference(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_difference(a.hi, b.hi);
  return high.hi + (high.lo + (a.lo - b.lo));
}

constexpr DoubleDouble operator*(DoubleDouble a, double b) noexcept {
  const DoubleDouble product = two_product(a.hi, b);
  return quick_two_sum(product.hi, product.lo + a.lo * b);
}

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return quick_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Quotient, within 2^-103 of it; b is not 0.
constexpr DoubleDouble operator/(DoubleDouble a, double b) noexcept {
  const double first = a.hi / b;
  DoubleDouble rest = a - two_product(first, b);
  const double second = rest.hi / b;
  rest = rest - two_product(second, b);
  return quick_two_sum(first, second) + rest.hi / b;
}

constexpr bool operator<(DoubleDouble a, DoubleDouble b) noexcept {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

constexpr bool operator==(DoubleDouble a, DoubleDouble b) noexcept {
  return a.hi == b.hi && a.lo == b.lo;
}

/// Whether both are the same to the bit: quicker than their comparison, and stricter.
constexpr bool same_bits(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return ((bits(a.hi) ^ bits(b.hi)) | (bits(a.lo) ^ bits(b.lo))) == 0;
}

/// A 64-bit integer exactly.
constexpr DoubleDouble to_double_double(std::int64_t value) noexcept {
  const std::int64_t upper = value / 4294967296;  // 32 bits each: exact
  const double high = static_cast<double>(upper) * 4294967296.0;
  return two_sum(high, static_cast<double>(value % 4294967296));
}

constexpr DoubleDouble to_double_double(double value) noexcept {
  return {value, 0.0};
}

}  // namespace lockstep
