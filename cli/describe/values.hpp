/// Values, ranges and choices of declarations as texts and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::cli {

/// A REAL or LREAL as a literal of IEC 61131-3, such as "200.0" or "1.0E12".
std::string real_literal(double value);

/// A value as a literal of its type: "TRUE", "-1", "16#8026", "T#0.5s", "200.0"; empty for a reference.
std::string literal(Value value, Type type);

/// An identifier of an error, such as "16#8026".
std::string error_literal(unsigned id);

/// The permitted values in words, such as "not 0" or "0.0 to 1.0E12"; empty if the type alone says it.
std::string range_text(Type type, const Range& range);

/// A line for each choice, such as "1: in advance"; of a BOOL "FALSE: …".
std::vector<std::string> choice_lines(Type type, std::span<const Choice> choices);

/// A value for programs: numbers and BOOL as such, TIME as a literal, a reference as null.
nlohmann::ordered_json json_value(Value value, Type type);

/// A document as it is printed. What a terminal would obey stands there as \uXXXX, which says the same to a
/// program.
std::string json_text(const nlohmann::ordered_json& json);

/// Adds `unit`, `range` and `choices`, each if there is something to say.
void add_declaration(nlohmann::ordered_json& json, Type type, Unit unit, const Range& range,
                     std::span<const Choice> choices);

}  // namespace lockstep::cli
