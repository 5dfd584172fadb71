#include "projects/expressions/compiler.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "projects/expressions/lexer.hpp"
#include "projects/expressions/parser.hpp"
#include "projects/expressions/typing.hpp"
#include "scheduler/text_choice.hpp"

namespace lockstep {
namespace {

/// Thrown where more values would have to rest than there is space for.
struct TooManyValues {};

void emit(const Term& term, ExpressionBuilder& code);

Expression finished(const Term& term, Type type) {
  ExpressionBuilder code;
  emit(term, code);
  if (!code.fits()) throw TooManyValues();
  return std::move(code).finish(type);
}

TextSource text_of(const Term& term) {
  if (term.form != Term::Form::kTextChoice) return term.text;
  std::vector<TextSource> inputs;
  for (std::size_t i = 0; i + 1 < term.operands.size(); ++i) inputs.push_back(text_of(term.operands[i]));
  const Term& chooser = term.operands.back();
  return {.tag = std::nullopt,
          .literal = "",
          .choice = std::make_shared<const TextChoice>(
              TextChoice{finished(chooser, chooser.type), std::move(inputs)})};
}

void emit(const Term& term, ExpressionBuilder& code) {
  if (term.form == Term::Form::kTextComparison)
    return code.compare_texts(
        {text_of(term.operands[0]), text_of(term.operands[1]), term.operation == Operation::kEqual});
  for (std::size_t i = 0; i < term.operands.size(); ++i) {
    emit(term.operands[i], code);
    // MIN, MAX with many inputs: one after the other. An operation takes the type of its first operand.
    if (term.form == Term::Form::kOperation && (i > 0 || operands_of(term.operation) == 1) &&
        !code.apply(term.operation, term.operands.front().type))
      throw std::logic_error("an operation of an expression was typed that does not exist");
  }
  switch (term.form) {
    case Term::Form::kLiteral:
      code.constant(term.value);
      if (term.divisions_by_zero > 0) code.count_divisions_by_zero(term.divisions_by_zero);
      break;
    case Term::Form::kSignal:
      code.signal(term.signal);
      break;
    case Term::Form::kElement:
      code.element(term.signal, term.elements);
      break;
    case Term::Form::kConversion:
      code.convert(term.from, term.to);
      break;
    case Term::Form::kSelection:
      code.select();
      break;
    case Term::Form::kMultiplexer:
      code.multiplex(static_cast<int>(term.operands.size()) - 1);
      break;
    case Term::Form::kOperation:
    case Term::Form::kRounding:        // has become an operation
    case Term::Form::kText:            // stands in comparisons and choices only
    case Term::Form::kTextChoice:      // stands in comparisons and choices only
    case Term::Form::kTextComparison:  // is compiled where it is met, as a whole
      break;
  }
}

ExpressionError too_many_values() {
  return {1, "the expression needs more than " + std::to_string(ExpressionBuilder::kMaximumValues) +
                 " intermediate values at a time"};
}

CompiledExpression compile(std::string_view text, Type wanted, const Scope& scope) {
  CompiledExpression result;
  Typing typing(scope);
  Term term = typing.type(parse_expression(text));
  Settling& settling = typing.settling();
  if (wanted > Type::DB_ANY)
    settling.error(1, "an expression is no " + std::string(type_name(wanted)) + "; a name is expected");
  else
    settling.settle(term, wanted == Type::DB_ANY ? Type::UDINT : wanted);
  result.errors = std::move(settling.errors);
  result.warnings = std::move(settling.warnings);
  if (!result.errors.empty()) return result;
  try {
    result.expression = finished(term, wanted);
  } catch (const TooManyValues&) {
    result.errors.push_back(too_many_values());
  }
  return result;
}

}  // namespace

CompiledText compile_text(std::string_view text, const Scope& scope) {
  CompiledText result;
  try {
    Typing typing(scope);
    Term term = typing.type(parse_expression(text));
    if (!term.faulty && term.shape == Shape::kText)
      result.text = text_of(term);
    else if (!term.faulty)
      typing.settling().error(
          1, describe(term) + " is no text; allowed: a text such as 'ale', or a tag of type STRING");
    result.errors = std::move(typing.settling().errors);
  } catch (const SyntaxError& error) {
    result.errors.push_back({error.column, error.message});
  } catch (const TooManyValues&) {
    result.errors.push_back(too_many_values());
  }
  return result;
}

CompiledExpression compile_expression(std::string_view text, Type wanted, const Scope& scope) {
  CompiledExpression result;
  try {
    result = compile(text, wanted, scope);
  } catch (const SyntaxError& error) {
    result.errors.push_back({error.column, error.message});
  }
  const auto by_column = [](const ExpressionError& a, const ExpressionError& b) {
    return a.column < b.column;
  };
  std::ranges::stable_sort(result.errors, by_column);
  std::ranges::stable_sort(result.warnings, by_column);
  return result;
}

}  // namespace lockstep
