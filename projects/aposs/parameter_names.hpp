/// The parameters of the option by number and mnemonic, as SET and GET name them.
/// @source MCO 305 Design Guide, parameter reference; MG.33.L5.03 for those of the later edition
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockstep::aposs {

struct ParameterName {
  std::int32_t number;        ///< 32-67 as 3267
  std::string_view mnemonic;  ///< empty: it has none
  bool later_edition;
};

/// Those with a number of their own, in its order; beside them 1900 to 1999.
std::span<const ParameterName> parameter_names() noexcept;

inline constexpr std::int32_t kFirstApplicationParameter = 1900, kLastApplicationParameter = 1999;
/// What stands for an input function in place of a parameter: I_FUNCTION_9_4 is 1'000'904 (function 9, input
/// 4), an old name such as I_BREAK 1'000'900, whose value is the input.
inline constexpr std::int32_t kInputFunction = 1'000'000;

/// The number of a parameter by what a program calls it, in upper case.
std::optional<std::int32_t> parameter_number(std::string_view name);
/// Whether there is a parameter of this number.
bool is_parameter(std::int32_t number) noexcept;
/// As it is published: 32-67, 1900.
std::string parameter_text(std::int32_t number);
/// The nearest mnemonic with its number, for a message: "SYNCMPULSM 33-17"; empty if none is near.
std::string nearest_parameter(std::string_view name);

}  // namespace lockstep::aposs
