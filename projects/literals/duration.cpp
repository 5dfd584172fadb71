#include "projects/literals/duration.hpp"

#include <array>
#include <limits>

#include "projects/literals/types.hpp"

namespace lockstep {
namespace {

struct TimeUnit {
  std::string_view name;
  std::int64_t nanoseconds;
};

constexpr std::int64_t kSecond = 1'000'000'000;

constexpr std::array<TimeUnit, 7> kFileUnits = {
    TimeUnit{"ns", 1},     {"us", 1000},          {"ms", 1'000'000},     {"s", kSecond},
    {"min", 60 * kSecond}, {"h", 3600 * kSecond}, {"d", 86400 * kSecond}};
/// In the order in which they follow each other.
constexpr std::array<TimeUnit, 7> kIecUnits = {TimeUnit{"D", 86400 * kSecond},
                                               {"H", 3600 * kSecond},
                                               {"M", 60 * kSecond},
                                               {"S", kSecond},
                                               {"MS", 1'000'000},
                                               {"US", 1000},
                                               {"NS", 1}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Takes decimal digits, single underscores between them, off the front of the text; none if there are none
/// or too many.
std::optional<std::string> take_digits(std::string_view& text) {
  std::string digits;
  std::size_t i = 0;
  while (i < text.size() && (is_digit(text[i]) || (text[i] == '_' && i > 0 && is_digit(text[i - 1]) &&
                                                   i + 1 < text.size() && is_digit(text[i + 1])))) {
    if (text[i] != '_') digits += text[i];
    ++i;
  }
  text.remove_prefix(i);
  constexpr std::size_t kMaximumDigits = 30;  // beyond any duration, and safe in 128 bits
  if (digits.empty() || digits.size() > kMaximumDigits) return std::nullopt;
  return digits;
}

WideInteger integer_of(std::string_view digits) {
  WideInteger value = 0;
  for (const char c : digits) value = value * 10 + (c - '0');
  return value;
}

/// A decimal number with an optional fraction.
struct Decimal {
  std::string whole;
  std::string fraction;
};

std::optional<Decimal> take_decimal(std::string_view& text) {
  const auto whole = take_digits(text);
  if (!whole) return std::nullopt;
  if (text.empty() || text.front() != '.') return Decimal{*whole, ""};
  text.remove_prefix(1);
  const auto fraction = take_digits(text);
  if (!fraction) return std::nullopt;
  return Decimal{*whole, *fraction};
}

std::string_view take_letters(std::string_view& text) {
  std::size_t i = 0;
  while (i < text.size() && is_letter(text[i])) ++i;
  const std::string_view letters = text.substr(0, i);
  text.remove_prefix(i);
  return letters;
}

constexpr WideInteger kMaximum = std::numeric_limits<std::int64_t>::max();

/// The exact number of nanoseconds; none, with a message, if it is not whole or too large.
std::optional<WideInteger> nanoseconds(Decimal number, std::int64_t unit, std::string& message) {
  while (!number.fraction.empty() && number.fraction.back() == '0') number.fraction.pop_back();
  constexpr std::size_t kMaximumDecimals = 18;  // a day has 8.64e13 ns = 2^17 · 3^3 · 5^14
  WideInteger scale = 1;
  for (std::size_t i = 0; i < number.fraction.size() && i < kMaximumDecimals; ++i) scale *= 10;
  const WideInteger part = integer_of(number.fraction.substr(0, kMaximumDecimals)) * unit;
  if (number.fraction.size() > kMaximumDecimals || part % scale != 0) {
    message = "is not a whole number of nanoseconds";
    return std::nullopt;
  }
  const WideInteger whole = integer_of(number.whole);
  if (whole > kMaximum / unit + 1 || whole * unit + part / scale > kMaximum + 1) {
    message = "is longer than 9223372036854775807 ns (about 292 years)";
    return std::nullopt;
  }
  return whole * unit + part / scale;
}

std::optional<std::int64_t> with_sign(WideInteger value, bool negative, std::string& message) {
  if (negative) value = -value;
  if (value > kMaximum) {
    message = "is longer than 9223372036854775807 ns (about 292 years)";
    return std::nullopt;
  }
  return static_cast<std::int64_t>(value);
}

bool take_sign(std::string_view& text) {
  if (text.empty() || (text.front() != '-' && text.front() != '+')) return false;
  const bool negative = text.front() == '-';
  text.remove_prefix(1);
  return negative;
}

/// Its letters in either case.
std::string in_any_case(std::string_view word) {
  std::string pattern;
  for (const char letter : word) {
    const std::string upper = upper_case({&letter, 1});
    pattern += "[" + upper + static_cast<char>(upper.front() - 'A' + 'a') + "]";
  }
  return pattern;
}

}  // namespace

std::string duration_pattern() {
  const std::string number = "[0-9][0-9_]*(\\.[0-9][0-9_]*)?";
  std::string file_units;
  for (const TimeUnit& unit : kFileUnits)
    file_units += (file_units.empty() ? "" : "|") + std::string(unit.name);
  std::string iec_units;
  for (const TimeUnit& unit : kIecUnits) iec_units += (iec_units.empty() ? "" : "|") + in_any_case(unit.name);
  return "^([+-]?" + number + "(" + file_units + ")|(" + in_any_case("T") + "|" + in_any_case("TIME") +
         ")#[+-]?(" + number + "(" + iec_units + ")_?)+)$";
}

std::optional<std::int64_t> parse_iec_duration(std::string_view text, std::string& message) {
  constexpr std::string_view kForm =
      "is not a duration; allowed are d h m s ms us ns in this order, as in T#1s500ms";
  const bool negative = take_sign(text);
  WideInteger sum = 0;
  std::size_t next_unit = 0;
  bool fraction = false;
  do {
    const auto number = take_decimal(text);
    const std::string unit = upper_case(take_letters(text));
    while (next_unit < kIecUnits.size() && kIecUnits[next_unit].name != unit) ++next_unit;
    if (!number || next_unit == kIecUnits.size() || fraction) {
      message = fraction ? "has decimals before its last unit; only the last one may have them" : kForm;
      return std::nullopt;
    }
    const auto part = nanoseconds(*number, kIecUnits[next_unit].nanoseconds, message);
    if (!part) return std::nullopt;
    sum += *part;  // at most seven parts below 2^64: far from the end of 128 bits
    fraction = !number->fraction.empty();
    ++next_unit;
    if (text.size() > 1 && text.front() == '_') text.remove_prefix(1);
  } while (!text.empty());
  return with_sign(sum, negative, message);
}

std::optional<std::int64_t> parse_duration(std::string_view text, std::string& message) {
  const auto refuse = [&](std::string_view why) {
    message = quoted(text) + " " + std::string(why);
    return std::nullopt;
  };
  constexpr std::string_view kForm =
      "is not a duration; allowed are a number with ns, us, ms, s, min, h or d, as in 1.5min, or T#1s500ms";
  std::string why;
  if (const auto hash = text.find('#'); hash != std::string_view::npos) {
    const std::string prefix = upper_case(text.substr(0, hash));
    if (prefix != "T" && prefix != "TIME") return refuse(kForm);
    const auto value = parse_iec_duration(text.substr(hash + 1), why);
    return value ? value : refuse(why);
  }
  std::string_view rest = text;
  const bool negative = take_sign(rest);
  const auto number = take_decimal(rest);
  for (const TimeUnit& unit : kFileUnits) {
    if (!number || unit.name != rest) continue;
    const auto part = nanoseconds(*number, unit.nanoseconds, why);
    const auto value = part ? with_sign(*part, negative, why) : std::nullopt;
    return value ? value : refuse(why);
  }
  return refuse(kForm);
}

}  // namespace lockstep
