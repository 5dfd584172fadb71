/// Constant values of the project file: start values, configuration, stimuli.
#pragma once

#include <optional>

#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Reads a value of an elementary type: a JSON boolean for BOOL; a number without fraction for any numeric
/// type and bit string, one with a fraction for REAL and LREAL; a string with a duration for TIME, or with a
/// constant expression such as "16#FF" for any type. What does not fit is reported.
std::optional<Value> read_constant(const JsonValue& value, Type type, Problems& problems);

/// Reads a value of an elementary type from a JSON boolean or number alone; anything else is reported with
/// what is allowed.
std::optional<Value> read_plain_constant(const JsonValue& value, Type type, Problems& problems);

/// What is wrong with a value by a range and a list of choices, and what is allowed; empty if nothing is.
std::string range_problem(Value value, Type type, const Range& range, std::span<const Choice> choices);

/// A value for a message.
std::string value_text(Value value, Type type);

}  // namespace lockstep
