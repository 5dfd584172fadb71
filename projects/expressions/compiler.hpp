/// Structured Text expressions of the project: read, typed and compiled while loading.
/// @source IEC 61131-3:2013, 6.3 (literals), 6.6 (functions), 7.3.2 (expressions)
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/expressions/scope.hpp"
#include "projects/expressions/term.hpp"
#include "scheduler/expression.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct CompiledExpression {
  std::optional<Expression> expression;  ///< none if there are errors
  std::vector<ExpressionError> errors;
  std::vector<ExpressionError> warnings;
};

/// A text: a literal or a tag of type STRING.
struct CompiledText {
  std::optional<TextSource> text;  ///< none if there are errors
  std::vector<ExpressionError> errors;
};
CompiledText compile_text(std::string_view text, const Scope& scope);

/// Compiles one expression for a place of type `wanted` (a DB_ANY place takes a UDINT). Never throws on
/// account of the text, whatever it is; a text of more than 4096 bytes or nested deeper than 64 is an error.
/// Thread: any; evaluation belongs to the thread that owns the signals.
CompiledExpression compile_expression(std::string_view text, Type wanted, const Scope& scope);

}  // namespace lockstep
