/// The operators of expressions: what the parser looks up, and what is told of them.
/// @source IEC 61131-3:2013, 7.3.2
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "projects/expressions/example.hpp"
#include "scheduler/expression.hpp"

namespace lockstep {

struct ExpressionOperator {
  std::string_view text;  ///< a sign, or a word in capital letters
  int strength;           ///< the higher binds first; of equal ones the left one
  int operands;           ///< 1 stands before its operand
  Operation operation;
  std::string_view takes;  ///< types of the operands
  std::string_view gives;  ///< type of the result
  std::string_view meaning;
  std::string_view edges;  ///< what it gives where one may doubt
  std::array<Example, 6> examples;
};

inline constexpr int kStrongest = 9;  ///< of operators with one operand

/// All of them, the strongest first.
std::span<const ExpressionOperator> expression_operators() noexcept;

}  // namespace lockstep
