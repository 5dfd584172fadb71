#include "projects/assembly/placeholders.hpp"

#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

#include "projects/expressions/compiler.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

/// The parameters as names of expressions.
class ParameterScope final : public Scope {
 public:
  explicit ParameterScope(const TemplateParameters& parameters) : parameters_(parameters) {}

  Reference resolve(std::string_view name, std::string_view path) const override {
    const auto found = parameters_.find(fold(name));
    if (found == parameters_.end()) return {.signal = {}, .error = unknown(name)};
    if (!path.empty()) return {.signal = {}, .error = "the parameter " + quote(name) + " has no parts"};
    const JsonValue& value = *found->second;
    Value& memory = values_.emplace_back();
    Type type = Type::LREAL;
    if (value.kind == JsonKind::boolean) {
      type = Type::BOOL;
      memory.u = value.boolean ? 1 : 0;
    } else if (value.kind != JsonKind::number) {
      return {.signal = {},
              .error = "the parameter " + quote(name) + " is a text, which stands alone: ${" +
                       std::string(name) + "}"};
    } else if (value.whole && !value.fraction &&
               std::abs(value.number) <= std::numeric_limits<std::int32_t>::max()) {
      type = Type::DINT;
      Signal{&memory, type}.store({.i = static_cast<std::int64_t>(value.number)});
    } else {
      memory.r = value.number;
    }
    return {.signal = Signal{&memory, type}, .error = ""};
  }

  std::string unknown(std::string_view name) const {
    if (parameters_.empty()) return "there is no parameter " + quote(name) + " here, and no other one";
    std::string allowed;
    for (const auto& [parameter, value] : parameters_) allowed += (allowed.empty() ? "" : ", ") + parameter;
    return "there is no parameter " + quote(name) + "; there are: " + allowed;
  }

 private:
  const TemplateParameters& parameters_;
  mutable std::deque<Value> values_;
};

void become(JsonValue& value, std::int64_t whole) {
  value.kind = JsonKind::number;
  value.negative = whole < 0;
  value.fraction = false;
  value.whole = true;
  value.magnitude = whole < 0 ? 0 - static_cast<std::uint64_t>(whole) : static_cast<std::uint64_t>(whole);
  value.number = static_cast<double>(whole);
  value.text = std::to_string(whole);
}

void become(JsonValue& value, double number) {
  value.kind = JsonKind::number;
  value.negative = std::signbit(number);
  value.fraction = true;
  value.whole = false;
  value.number = number;
  value.text = decimal_text(number);
  if (value.text.find_first_of(".e") == value.text.npos) value.text += ".0";
}

void become(JsonValue& value, bool truth) {
  value.kind = JsonKind::boolean;
  value.boolean = truth;
  value.text = truth ? "TRUE" : "FALSE";
}

/// Gives a value what another one has, but not its place.
void become(JsonValue& value, const JsonValue& other) {
  value.kind = other.kind;
  value.boolean = other.boolean;
  value.negative = other.negative;
  value.fraction = other.fraction;
  value.whole = other.whole;
  value.magnitude = other.magnitude;
  value.number = other.number;
  value.text = other.text;
  if (other.kind == JsonKind::boolean) value.text = other.boolean ? "TRUE" : "FALSE";
}

/// A whole number, else a number, else a truth value.
std::string compute(std::string_view expression, const ParameterScope& scope, JsonValue& result) {
  std::string problem;
  for (const Type type : {Type::LINT, Type::LREAL, Type::BOOL}) {
    const CompiledExpression compiled = compile_expression(expression, type, scope);
    if (!compiled.expression) {
      if (type != Type::BOOL) problem = compiled.errors.front().message;
      continue;
    }
    EvaluationCounters counters;
    const Value value = compiled.expression->evaluate(counters);
    if (counters.integer_divisions_by_zero != 0) return "it divides by zero";
    if (type == Type::LREAL && !std::isfinite(value.r)) return "its value is no finite number";
    if (type == Type::LINT) become(result, value.i);
    if (type == Type::LREAL) become(result, value.r);
    if (type == Type::BOOL) become(result, value.u != 0);
    return "";
  }
  return problem;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

/// @param written between the braces
std::string evaluate(std::string_view written, const TemplateParameters& parameters, JsonValue& result) {
  const std::string_view text = trimmed(written);
  if (const auto found = parameters.find(fold(text)); found != parameters.end()) {
    become(result, *found->second);
    return "";
  }
  const std::string problem = compute(text, ParameterScope(parameters), result);
  return problem.empty() ? "" : quote("${" + std::string(written) + "}") + ": " + problem;
}

/// The next placeholder of a text: from "${" to its "}".
struct Placeholder {
  std::size_t begin = std::string_view::npos;  // none
  std::size_t end = std::string_view::npos;    // of the closing brace; none
};

Placeholder next_placeholder(std::string_view text, std::size_t from) {
  for (std::size_t at = from; (at = text.find('$', at)) != text.npos; ++at) {
    if (text.substr(at).starts_with("${")) return {at, text.find('}', at)};
    if (text.substr(at).starts_with("$$")) ++at;
  }
  return {};
}

std::string unclosed(std::string_view text) {
  return "in " + quote(text) +
         " a '${' has no '}'; allowed: ${parameter}, ${expression}, and '$$' for a '$' alone";
}

}  // namespace

std::string filled_text(std::string_view text, const TemplateParameters& parameters, std::string& problem) {
  constexpr std::size_t kLongest = 1u << 16;
  std::string result;
  std::size_t from = 0;
  while (problem.empty()) {
    const Placeholder placeholder = next_placeholder(text, from);
    result += text.substr(from, placeholder.begin == text.npos ? text.npos : placeholder.begin - from);
    if (placeholder.begin == text.npos) break;
    if (placeholder.end == text.npos) {
      problem = unclosed(text);
      break;
    }
    JsonValue value;
    problem = evaluate(text.substr(placeholder.begin + 2, placeholder.end - placeholder.begin - 2),
                       parameters, value);
    result += value.text;
    if (result.size() > kLongest)
      problem = "the text is longer than " + std::to_string(kLongest) + " characters";
    from = placeholder.end + 1;
  }
  return result;
}

std::string fill_placeholders(JsonValue& value, const TemplateParameters& parameters) {
  if (value.kind != JsonKind::string) return "";
  const std::string text = value.text;
  const Placeholder only = next_placeholder(text, 0);
  if (only.begin == text.npos) return "";
  if (only.begin == 0 && only.end == text.size() - 1)
    return evaluate(std::string_view(text).substr(2, text.size() - 3), parameters, value);
  std::string problem;
  value.text = filled_text(text, parameters, problem);
  return problem;
}

}  // namespace lockstep
