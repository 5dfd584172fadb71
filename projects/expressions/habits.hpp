/// What other languages write, and what is written here in its place: for those who come from S7-SCL or C.
#pragma once

#include <span>
#include <string_view>

#include "projects/expressions/example.hpp"

namespace lockstep {

struct Habit {
  std::string_view written;  ///< a sign, or the name of a function in capital letters
  std::string_view here;     ///< what it is in an expression of a project
  Example example;           ///< of what is written here; without an expression where there is none
};

/// All of them: signs, then functions.
std::span<const Habit> habits() noexcept;

/// The sign at the beginning of a text, the longest that fits; nullptr: none.
const Habit* habit_sign(std::string_view text) noexcept;
/// @param name in capital letters  @return nullptr: there is none
const Habit* habit_of(std::string_view name) noexcept;

}  // namespace lockstep
