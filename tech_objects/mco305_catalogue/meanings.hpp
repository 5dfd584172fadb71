/// What the parameters of the option are for, in a sentence each.
/// @source MCO 305 Design Guide, parameter reference
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep::mco305 {

/// Meaning of a parameter, with its options; empty if there is no such number.
std::string_view meaning_of(std::int32_t number) noexcept;

}  // namespace lockstep::mco305
