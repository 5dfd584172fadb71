/// Reading the type STRING[n] and constant texts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"

namespace lockstep {

/// Whether a text says that it is the type of a text.
bool is_string_type(std::string_view text) noexcept;

/// n of "STRING[20]", 1 to kLongestText; what is wrong is reported.
std::optional<std::size_t> read_string_type(const JsonValue& json, Problems& problems);

/// A regular expression (ECMA 262) that refuses nothing that is such a type.
std::string string_type_pattern();

/// A text of up to `capacity` printable characters of ISO 8859-1, one byte each; what is wrong is reported.
std::optional<std::string> read_text_constant(const JsonValue& json, std::size_t capacity,
                                              Problems& problems);

}  // namespace lockstep
