/// Tells of constant arguments that are not what they may be.
#pragma once

#include <span>
#include <string>

#include "projects/aposs/expression.hpp"
#include "projects/aposs/message.hpp"
#include "scheduler/aposs/argument_ranges.hpp"

namespace lockstep::aposs {

/// What the ranges of a program depend on.
struct RangesOfProgram {
  bool later_edition = true;
  std::span<const ArrayDeclaration> arrays;
};

/// @param arguments all of the command, in their order
void check_arguments(Command command, std::span<const Expression* const> arguments,
                     const RangesOfProgram& program, Messages& messages);

/// What is allowed, in words: "0, 20 and more", "a system variable".
std::string allowed_text(const ArgumentRange& range);

}  // namespace lockstep::aposs
