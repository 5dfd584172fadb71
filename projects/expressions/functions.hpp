/// The standard functions of expressions: what the compiler looks up, and what is told of them.
/// @source IEC 61131-3:2013, 6.6.2.5; TRUNC, ROUND, CEIL and FLOOR as in S7-SCL
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "projects/expressions/example.hpp"
#include "scheduler/expression.hpp"

namespace lockstep {

/// How the compiler types a call.
enum class FunctionKind : std::uint8_t {
  real,
  arithmetic,
  extremum,
  limit,
  select,
  multiplex,
  shift,
  rounding,
  absolute,
  move
};

struct StandardFunction {
  std::string_view name;
  FunctionKind kind;
  Operation operation;
  std::string_view inputs;  ///< their names; the last one ends in a number where more may follow
  bool more;                ///< any number of further inputs, up to kMaximumInputs in all
  std::string_view takes;   ///< types of the inputs
  std::string_view gives;   ///< type of the result
  std::string_view meaning;
  std::string_view edges;  ///< what it gives where one may doubt
  std::array<Example, 6> examples;
};

inline constexpr std::size_t kMaximumInputs = 32;  ///< of functions with any number of them

/// All of them, in the order in which they are told.
std::span<const StandardFunction> standard_functions() noexcept;

/// @param name in capital letters  @return nullptr: there is none
const StandardFunction* find_function(std::string_view name) noexcept;

/// "LIMIT(MN, IN, MX)", "ADD(IN1, IN2, …)".
std::string signature(const StandardFunction& function);

/// The types of a conversion's name, "TO_INT" or "REAL_TO_INT".
struct Conversion {
  std::optional<Type> from;  ///< none: of any type
  Type to;
};
/// @param name in capital letters  @return none if it names no conversion
std::optional<Conversion> conversion_named(std::string_view name) noexcept;

/// What the conversions give where one may doubt; the names of the types stand in the expressions.
std::span<const Example> conversion_examples() noexcept;
/// The rules of which they are examples, one a line.
std::span<const std::string_view> conversion_rules() noexcept;

}  // namespace lockstep
