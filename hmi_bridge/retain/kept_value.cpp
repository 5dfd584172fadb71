#include "hmi_bridge/retain/kept_value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <system_error>

#include "hmi_bridge/traces/text_literal.hpp"
#include "scheduler/text.hpp"

namespace lockstep {
namespace {

template <class Number>
std::string number_text(Number number) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end.ptr};
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number{};
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

bool is_signed(Type type) {
  return is_signed_integer(type) || type == Type::TIME;
}

}  // namespace

std::string kept_text(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (is_real(type) && value.r != value.r) return "nan";  // its sign depends on the processor
  if (type == Type::REAL) return number_text(static_cast<float>(value.r));
  if (type == Type::LREAL) return number_text(value.r);
  return is_signed(type) ? number_text(value.i) : number_text(value.u);
}

std::optional<Value> kept_value(std::string_view text, Type type) {
  Value value{};
  if (type == Type::BOOL) {
    value.u = text == "TRUE" ? 1 : 0;
    return text == "TRUE" || text == "FALSE" ? std::optional(value) : std::nullopt;
  }
  if (type == Type::REAL) {
    const auto number = number_of<float>(text);
    value.r = number.value_or(0.0F);
    return number ? std::optional(value) : std::nullopt;
  }
  if (type == Type::LREAL) {
    const auto number = number_of<double>(text);
    value.r = number.value_or(0.0);
    return number ? std::optional(value) : std::nullopt;
  }
  if (is_signed(type)) {
    const auto number = number_of<std::int64_t>(text);
    value.i = number.value_or(0);
    const bool fits = type == Type::TIME ||
                      (value.i >= lowest(type) && value.i <= static_cast<std::int64_t>(highest(type)));
    return number && fits ? std::optional(value) : std::nullopt;
  }
  const auto number = number_of<std::uint64_t>(text);
  value.u = number.value_or(0);
  return number && value.u <= highest(type) ? std::optional(value) : std::nullopt;
}

std::string KeptValue::type() const {
  return elements.empty() ? std::string(type_name(signal.value_type())) : array_type;
}

std::string KeptValue::text(std::span<const Value> values) const {
  return capacity > 0 ? text_literal(text_of(values, capacity)) : kept_texts(values, signals());
}

std::optional<std::vector<Value>> KeptValue::values(std::string_view text) const {
  if (capacity == 0) return kept_values(text, signals());
  std::string problem;
  const auto characters = read_text_literal(text, problem);
  if (!characters || characters->size() > capacity) return std::nullopt;
  return text_values(*characters, capacity);
}

std::string kept_texts(std::span<const Value> values, std::span<const Signal> signals) {
  std::string text;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (i > 0) text += ',';
    text += kept_text(values[i], signals[i].value_type());
  }
  return text;
}

std::optional<std::vector<Value>> kept_values(std::string_view text, std::span<const Signal> signals) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const std::size_t end = i + 1 < signals.size() ? text.find(',') : text.size();
    if (end == text.npos) return std::nullopt;
    const auto value = kept_value(text.substr(0, end), signals[i].value_type());
    if (!value) return std::nullopt;
    values.push_back(*value);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return values;
}

}  // namespace lockstep
