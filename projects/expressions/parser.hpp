/// The grammar of Structured Text expressions.
/// @source IEC 61131-3:2013, 7.3.2
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/literals/types.hpp"
#include "scheduler/expression.hpp"

namespace lockstep {

/// A text has at most this many bytes, and brackets, calls and signs nest at most this deep, so that no text
/// can exhaust the stack of the thread that loads it.
inline constexpr std::size_t kLongestExpression = 4096;
inline constexpr int kDeepestExpression = 64;
/// `a + b + c + …` is a tree as high as it is long.
inline constexpr int kHighestExpression = 512;

/// One node of the syntax tree, not yet typed.
struct Syntax {
  enum class Kind {
    kInteger,    ///< `integer`
    kReal,       ///< `value.r`
    kTyped,      ///< `value` of `type`
    kText,       ///< `text`: characters of a literal
    kReference,  ///< `text`: name, members and indices without blanks; "[]" stands for the index operands[0]
    kOperator,   ///< `operation` on one or two `operands`
    kCall        ///< function `text` (upper case) of `operands`
  };
  Kind kind = Kind::kInteger;
  int column = 1;
  std::string text;
  WideInteger integer = 0;
  Type type = Type::BOOL;
  Value value{};
  Operation operation = Operation::kAdd;
  int height = 1;
  std::vector<Syntax> operands;
  std::vector<std::string>
      names;  ///< of a call's inputs (upper case), as many as operands; empty: by position
};

/// Reads one expression. From weak to strong: OR, XOR, AND &, = <>, < > <= >=, + -, * / MOD, **, sign and
/// NOT; equal ones from left to right, so that -2 ** 2 is 4 and 2 ** 3 ** 2 is 64. Throws SyntaxError.
Syntax parse_expression(std::string_view text);

}  // namespace lockstep
