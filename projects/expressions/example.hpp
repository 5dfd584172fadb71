/// Examples of what an expression gives: shown where functions and operators are described, and held by the
/// tests against the compiler.
#pragma once

#include <string_view>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A constant expression in a place of a type, and what stands in that place afterwards.
struct Example {
  std::string_view expression;  ///< empty: there is none
  Type place = Type::BOOL;
  /// A literal; "NaN", "infinity", "-infinity"; kRefused: `lockstep check` refuses the expression.
  std::string_view result;
  bool counted = false;  ///< evaluating it counts a division by zero
};

inline constexpr std::string_view kRefused = "refused";

}  // namespace lockstep
