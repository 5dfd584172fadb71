/// Durations of the project file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Reads a duration: a decimal number with one of the units ns us ms s min h d ("1.5min"), or the IEC form
/// ("T#1s500ms", "TIME#-10ms"). Exact: a duration that is not a whole number of nanoseconds is refused.
/// A sign is allowed; whether a negative duration makes sense is for the caller to say.
/// @returns the duration [ns]; none for anything else, with what is wrong and what is allowed in `message`.
std::optional<std::int64_t> parse_duration(std::string_view text, std::string& message);

/// A regular expression (ECMA 262) for editors that refuses nothing that `parse_duration` takes; the order of
/// the units of the IEC form, and what is too long or no whole number, it does not know.
std::string duration_pattern();

/// Reads what follows `T#`: days d, hours h, minutes m, seconds s, ms, us, ns in this order, each at most
/// once, the last one with decimals if need be, underscores between them, a sign before all.
/// @source IEC 61131-3:2013, 6.3.5
std::optional<std::int64_t> parse_iec_duration(std::string_view text, std::string& message);

}  // namespace lockstep
