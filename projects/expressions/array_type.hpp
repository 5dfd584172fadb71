/// Reading the types of arrays and the values at their start.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"
#include "tech_objects/data_blocks/array.hpp"

namespace lockstep {

/// Whether a text says that it is the type of an array.
bool is_array_type(std::string_view text) noexcept;

/// Reads "ARRAY[1..100] OF LREAL": bounds are DINT, the elements of a type that a tag may have or a structure
/// of cams. Up to 100,000 elements. What is wrong is reported; the array has no memory yet.
std::optional<Array> read_array_type(const JsonValue& json, Problems& problems);

/// A regular expression (ECMA 262) that refuses nothing that is such a type.
std::string array_type_pattern();

/// Writes the values of `init` into an array: [element, …] from the first one on, no more than it has; the
/// others stay 0. A structure is { member: value, … }, or [value, …] in the order of its members.
void read_array_values(const JsonValue& json, const Array& array, Problems& problems);

}  // namespace lockstep
