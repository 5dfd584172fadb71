/// How numbers stand in a CSV trace.
#pragma once

#include <cstdint>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Longest text of a number [byte].
inline constexpr int kNumberLength = 32;

/// A duration [ns] in seconds as an exact decimal number without trailing zeros: 2000000 is "0.002".
/// @param out space for `kNumberLength` characters
/// @return end of the text
char* print_seconds(char* out, std::int64_t nanoseconds) noexcept;

/// A value so that reading it back gives the same value: BOOL 0 or 1; integers and bit strings in decimal;
/// REAL and LREAL as the shortest text of the double ("nan", "inf" and "-inf" are possible); TIME in seconds,
/// exact.
/// @param out space for `kNumberLength` characters
/// @return end of the text
char* print_value(char* out, Value value, Type type) noexcept;

/// A value as `print_value` has it, for a column of a trace: a real number of a whole value gets ".0", so
/// that a reader of the file knows its type.
/// @param out space for `kNumberLength` characters
/// @return end of the text
char* print_column_value(char* out, Value value, Type type) noexcept;

}  // namespace lockstep
