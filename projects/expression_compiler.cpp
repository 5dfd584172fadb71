#include "projects/expression_compiler.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "projects/expression_lexer.hpp"
#include "projects/expression_parser.hpp"
#include "projects/expression_typing.hpp"

namespace lockstep {
namespace {

void emit(const Term& term, ExpressionBuilder& code) {
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
    case Term::Form::kRounding:  // has become an operation
      break;
  }
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
  ExpressionBuilder code;
  emit(term, code);
  if (code.fits())
    result.expression = std::move(code).finish(wanted);
  else
    result.errors.push_back({1, "the expression needs more than " +
                                    std::to_string(ExpressionBuilder::kMostValues) +
                                    " intermediate values at a time"});
  return result;
}

}  // namespace

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
