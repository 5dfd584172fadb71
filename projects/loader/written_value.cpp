#include "projects/loader/written_value.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "hmi_bridge/traces/csv_number.hpp"
#include "projects/expressions/constant.hpp"

namespace lockstep {
namespace {

constexpr double kExact = 9007199254740992.0;  // up to here a double is each whole number

std::string text_of(GivenNumber number) {
  std::array<char, kNumberLength> text{};
  Value value{};
  Type type = Type::LREAL;
  if (const auto* const real = std::get_if<double>(&number)) value.r = *real;
  if (const auto* const whole = std::get_if<std::int64_t>(&number)) {
    value.i = *whole;
    type = Type::LINT;
  }
  if (const auto* const whole = std::get_if<std::uint64_t>(&number)) {
    value.u = *whole;
    type = Type::ULINT;
  }
  return {text.data(), print_value(text.data(), value, type)};
}

double real_of(GivenNumber number) {
  return std::visit([](auto given) { return static_cast<double>(given); }, number);
}

/// A whole number in the range of a type; none if it is not.
std::optional<Value> whole_of(GivenNumber number, Type type) {
  Value value{};
  if (const auto* const natural = std::get_if<std::uint64_t>(&number)) {
    value.u = *natural;
    if (*natural <= highest(type)) return value;
  } else if (const auto* const whole = std::get_if<std::int64_t>(&number)) {
    value.i = *whole;
    if (*whole < 0 ? *whole >= lowest(type) : value.u <= highest(type)) return value;
  } else {
    const double real = std::get<double>(number);
    if (real == std::floor(real) && std::abs(real) <= kExact)
      return whole_of(static_cast<std::int64_t>(real), type);
  }
  return std::nullopt;
}

std::optional<Value> converted(GivenNumber number, Type type) {
  Value value{};
  if (is_real(type)) {
    value.r = real_of(number);
    if (!std::isfinite(value.r)) return std::nullopt;
    const bool fits =
        type == Type::LREAL || std::abs(value.r) <= static_cast<double>(std::numeric_limits<float>::max());
    return fits ? std::optional(value) : std::nullopt;
  }
  const auto* const seconds = std::get_if<double>(&number);
  if (type != Type::TIME || seconds == nullptr) return whole_of(number, type);
  const double nanoseconds = std::round(*seconds * 1e9);
  if (!(std::abs(nanoseconds) < 9.2e18)) return std::nullopt;
  value.i = static_cast<std::int64_t>(nanoseconds);
  return value;
}

std::string allowed_of(Type type) {
  if (type == Type::BOOL) return "FALSE and TRUE, as 0 and 1";
  if (is_real(type)) return "finite numbers";
  if (type == Type::TIME) return "about 292 years either way";
  return "whole numbers from " + std::to_string(lowest(type)) + " to " + std::to_string(highest(type));
}

}  // namespace

WrittenValue written_value(const Operand& place, GivenNumber number) {
  if (std::string reason = why_not_writable(place); !reason.empty())
    return {{}, WriteProblem::not_writable, std::move(reason)};
  const Type type = place.signal.value_type();
  const std::optional<Value> value = converted(number, type);
  if (!value)
    return {{},
            WriteProblem::wrong_type,
            text_of(number) + " does not fit a value of type " + std::string(type_name(type)) +
                "; allowed: " + allowed_of(type)};
  // A bit of a word has no range of its own.
  if (place.variable == nullptr || place.signal.bit >= 0) return {*value, WriteProblem::none, ""};
  std::string problem = range_problem(*value, type, place.variable->range, place.variable->choices);
  if (problem.empty()) return {*value, WriteProblem::none, ""};
  return {{}, WriteProblem::out_of_range, std::move(problem)};
}

}  // namespace lockstep
