/// The parameters of the option as SET and GET name them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::aposs {

/// What stands for an input function in place of a parameter: I_FUNCTION_9_4 is 1'000'904 (function 9, input
/// 4), an old name such as I_BREAK 1'000'900, whose value is the input.
inline constexpr std::int32_t kInputFunction = 1'000'000;

/// The number of a parameter by what a program calls it, in upper case.
std::optional<std::int32_t> parameter_number(std::string_view name);
/// The number of a parameter by what a project or a command line calls it, in any case: "SYNCMPULSM",
/// "33-17", "1900".
std::optional<std::int32_t> parameter_of(std::string_view name);
/// Whether there is a parameter of this number.
bool is_parameter(std::int32_t number) noexcept;
/// Whether firmware 5.00 alone has it.
bool is_later_parameter(std::int32_t number) noexcept;
/// As it is published: 32-67, 1900.
std::string parameter_text(std::int32_t number);
/// The nearest mnemonic with its number, for a message: "SYNCMPULSM 33-17"; empty if none is near.
std::string nearest_parameter(std::string_view name);

}  // namespace lockstep::aposs
