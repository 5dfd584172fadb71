/// What may be written to a place of a run, whoever writes: a program that embeds it, a page of the studio.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "projects/expressions/names.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A number as somebody has given it: whole ones exactly.
using GivenNumber = std::variant<double, std::int64_t, std::uint64_t>;

enum class WriteProblem : std::uint8_t { none, not_writable, wrong_type, out_of_range };

/// A value as the place holds it, or why it may not be written there.
struct WrittenValue {
  Value value{};
  WriteProblem problem = WriteProblem::none;
  std::string text{};  ///< what is wrong and what is allowed; empty if nothing is
};

/// Converts and checks: TIME is in seconds as a `double`, else in nanoseconds; BOOL takes 0 and 1; real
/// values are finite; a variable keeps to its declared range.
WrittenValue written_value(const Operand& place, GivenNumber number);

}  // namespace lockstep
