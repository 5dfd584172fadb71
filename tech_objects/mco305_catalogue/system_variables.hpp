/// The system variables that a program reads by SYSVAR.
/// @source MCO 305 Design Guide, SYSVAR
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::mco305 {

struct SystemVariable {
  std::int32_t index;
  std::string_view name;  ///< as a path beside its index; published where it is in capitals
  std::string_view text;
  std::string_view unit;
  bool built;  ///< else reading it is error 112
};

inline constexpr std::size_t kSystemVariableCount = 76;

/// By their indices.
std::span<const SystemVariable> system_variables() noexcept;
/// nullptr: there is none.
const SystemVariable* find_system_variable(std::int32_t index) noexcept;

}  // namespace lockstep::mco305
