// Expectations: what lockstep test looks at in a simulated run.
#include <algorithm>

#include "projects/expressions/compiler.hpp"
#include "projects/expressions/parser.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMaximumShown = 8;  // values of an expectation

/// The names in an expression whose values tell why it is what it is.
void add_seen(const Syntax& syntax, const Loading& loading, std::vector<SeenValue>& seen) {
  for (const Syntax& operand : syntax.operands) add_seen(operand, loading, seen);
  if (syntax.kind != Syntax::Kind::kReference || !syntax.operands.empty() || seen.size() == kMaximumShown)
    return;
  if (std::ranges::find(seen, syntax.text, &SeenValue::name) != seen.end()) return;
  if (const StringTag* const text = loading.names().find_string(syntax.text))
    seen.push_back({syntax.text, std::nullopt, text->text});
  else if (const FoundOperand found = loading.names().find(syntax.text); found.place)
    seen.push_back({syntax.text, found.place->signal, {}});
}

/// A number of any type, the narrowest last; of none the errors of the first are told.
CompiledExpression compile_number(std::string_view text, const Scope& scope) {
  CompiledExpression first = compile_expression(text, Type::LREAL, scope);
  if (first.expression) return first;
  for (const Type type : {Type::LINT, Type::ULINT})
    if (CompiledExpression other = compile_expression(text, type, scope); other.expression) return other;
  return first;
}

std::optional<Expression> compile(const JsonValue& json, bool is_number, const Loading& loading) {
  CompiledExpression compiled = is_number ? compile_number(json.text, loading.names())
                                          : compile_expression(json.text, Type::BOOL, loading.names());
  const std::string hint = is_number ? "; with 'value' it has to be a number" : "";
  for (const ExpressionError& error : compiled.errors)
    if (error.message.find(Names::kKnownProblem) == std::string::npos)
      loading.problems.report_within(json, static_cast<std::size_t>(error.column), error.message + hint);
  return std::move(compiled.expression);
}

void load_expectation(const JsonValue& json, const Loading& loading) {
  const Fields fields(json, keys::kExpectation, loading.problems);
  if (!fields.usable()) return;
  Expectation expectation;
  if (const auto at = read_value(fields, keys::kExpectation["at"], loading)) expectation.at = at->integer;
  const auto value = read_value(fields, keys::kExpectation["value"], loading);
  const auto tolerance = read_value(fields, keys::kExpectation["tolerance"], loading);
  if (value) expectation.value = value->number;
  if (tolerance) expectation.tolerance = tolerance->number;
  if (tolerance && fields["value"] == nullptr)
    loading.problems.report_key(*fields["tolerance"],
                                "there is no 'value' to which a tolerance could belong");
  if (const auto text = read_value(fields, keys::kExpectation["text"], loading))
    expectation.text = text->text;
  const JsonValue* const expect = fields["expect"];
  if (!read_string(expect, loading.problems)) return;
  expectation.written = expect->text;
  expectation.line = expect->position().line;
  if (expect->source() != nullptr) expectation.file = expect->source()->file();
  auto expression = compile(*expect, fields["value"] != nullptr, loading);
  if (!expression) return;
  expectation.expression = std::move(*expression);
  add_seen(parse_expression(expect->text), loading, expectation.seen);
  loading.project.expectations.list.push_back(std::move(expectation));
}

}  // namespace

void load_expectations(const JsonValue* json, const JsonValue* duration, const Loading& loading) {
  Expectations& expectations = loading.project.expectations;
  const auto given = read_value(duration, keys::kProject["duration"], loading);
  const JsonValue* const list = read_array(json, loading.problems);
  if (list != nullptr)
    for (const JsonValue* const one : list->elements) load_expectation(*one, loading);
  for (const Expectation& one : expectations.list)
    expectations.duration = std::max(expectations.duration, one.at.value_or(0));
  const auto is_timed = [](const JsonValue* one) { return one->find("at") != nullptr; };
  if (list != nullptr && !expectations.list.empty() && duration == nullptr &&
      std::ranges::none_of(list->elements, is_timed))
    loading.problems.report(*json,
                            "nothing tells how long to simulate; allowed: 'duration' of the project, or an "
                            "expectation with 'at'");
  if (!given) return;
  if (expectations.duration > given->integer)
    loading.problems.report(*duration, duration->shown() + " is over before the last expectation, at " +
                                           duration_text(expectations.duration) +
                                           "; allowed: that or longer");
  expectations.duration = given->integer;
}

}  // namespace lockstep
