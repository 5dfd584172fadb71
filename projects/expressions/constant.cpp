#include "projects/expressions/constant.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "projects/expressions/compiler.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

/// A constant expression has no names.
class NoNames final : public Scope {
 public:
  Reference resolve(std::string_view name, std::string_view /*path*/) const override {
    return {std::nullopt, quote(name) + " is a name, and only constants can stand here"};
  }
};

std::string allowed_values(Type type) {
  if (type == Type::BOOL) return "true, false";
  if (type == Type::TIME) return "a duration such as \"T#10ms\"";
  const std::string name(type_name(type));
  if (type == Type::LREAL) return "a number (" + name + ")";
  if (type == Type::REAL) return "a number from -3.4028235e+38 to 3.4028235e+38 (" + name + ")";
  return "a number without fraction from " + std::to_string(lowest(type)) + " to " +
         std::to_string(highest(type)) + " (" + name + ")";
}

std::optional<Value> whole_value(const JsonValue& number, Type type) {
  if (!number.whole) return std::nullopt;
  Value value{};
  if (number.negative && number.magnitude != 0) {
    const std::uint64_t maximum =
        0 - static_cast<std::uint64_t>(lowest(type));  // amount of the minimum number
    if (number.magnitude > maximum) return std::nullopt;
    value.u = 0 - number.magnitude;
    return value;
  }
  if (number.magnitude > highest(type)) return std::nullopt;
  value.u = number.magnitude;
  return value;
}

std::optional<Value> real_value(double number, Type type) {
  Value value{};
  value.r = type == Type::REAL ? static_cast<double>(static_cast<float>(number)) : number;
  if (!std::isfinite(value.r)) return std::nullopt;
  return value;
}

std::optional<Value> plain_value(const JsonValue& json, Type type) {
  if (type == Type::BOOL) {
    Value value{};
    value.u = json.boolean ? 1 : 0;
    return json.kind == JsonKind::boolean ? std::optional(value) : std::nullopt;
  }
  if (json.kind != JsonKind::number) return std::nullopt;
  if (is_real(type)) return real_value(json.number, type);
  if (is_integer(type) || is_bit_string(type)) return whole_value(json, type);
  return std::nullopt;
}

std::optional<Value> constant_expression(const JsonValue& json, Type type, Problems& problems) {
  const CompiledExpression compiled = compile_expression(json.text, type, NoNames{});
  for (const ExpressionError& error : compiled.errors)
    problems.report(json, error.message + "; allowed: " + allowed_values(type));
  if (!compiled.expression) return std::nullopt;
  EvaluationCounters counters;
  const Value value = compiled.expression->evaluate(counters);
  if (compiled.expression->constant() && (!is_real(type) || std::isfinite(value.r))) return value;
  problems.report(json, json.shown() + " has no finite constant value; allowed: " + allowed_values(type));
  return std::nullopt;
}

}  // namespace

std::optional<Value> read_plain_constant(const JsonValue& json, Type type, Problems& problems) {
  const auto value = plain_value(json, type);
  if (!value) report_kind(json, allowed_values(type), problems);
  return value;
}

std::optional<Value> read_constant(const JsonValue& json, Type type, Problems& problems) {
  if (json.kind != JsonKind::string) return read_plain_constant(json, type, problems);
  if (type != Type::TIME) return constant_expression(json, type, problems);
  const auto duration = read_duration(&json, INT64_MIN, INT64_MAX, problems);
  if (!duration) return std::nullopt;
  Value value{};
  value.i = *duration;
  return value;
}

std::string value_text(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (is_real(type)) return decimal_text(value.r);
  if (is_signed_integer(type)) return std::to_string(value.i);
  if (type == Type::TIME) return std::to_string(value.i) + "ns";
  return std::to_string(value.u);
}

std::string range_problem(Value value, Type type, const Range& range, std::span<const Choice> choices) {
  const double number = as_double(value, type);
  if (type == Type::BOOL) return "";
  const bool chosen =
      choices.empty() || std::any_of(choices.begin(), choices.end(), [&](const Choice& choice) {
        return static_cast<double>(choice.value) == number;
      });
  if (chosen && range.allows(number)) return "";
  std::string text = value_text(value, type) + " is not permitted; allowed: ";
  if (!choices.empty()) {
    for (const Choice& choice : choices) {
      if (&choice != &choices.front()) text += ", ";
      text += std::to_string(choice.value);
    }
    return text;
  }
  text += "from " + decimal_text(range.lowest) + " to " + decimal_text(range.highest);
  if (std::isfinite(range.excluded)) text += ", without " + decimal_text(range.excluded);
  return text;
}

}  // namespace lockstep
