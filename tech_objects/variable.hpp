/// Declared variables of technology data blocks and the one path syntax by which they are reached.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "tech_objects/data_block.hpp"
#include "tech_objects/declaration.hpp"
#include "tech_objects/status_bits.hpp"

namespace lockstep {

/// Declaration of one variable of the technology data block.
struct Variable {
  std::string_view
      path;  ///< published path below the object; an array element is written `Sensor[].Type` here
  Type type;
  std::size_t offset;      ///< of the (first) element in AxisData [byte]
  std::size_t count = 0;   ///< elements of the array; 0: no array
  std::size_t stride = 0;  ///< distance of two elements [byte]
  Effect effect;
  Unit unit;
  Range range;
  std::string_view text;              ///< meaning
  std::span<const Choice> choices{};  ///< permitted values, where they are an enumeration
  const BitNames* bits = nullptr;     ///< names of the bits of a status word
  bool later = false;                 ///< declared and holding its start value; its function is not there yet

  /// Whether the runtime computes it, so that a project may not set it.
  bool computed() const noexcept;
};

/// The variables that a project configures, in published order.
std::span<const Variable> configuration_variables() noexcept;
/// The variables that the runtime computes, in published order.
std::span<const Variable> status_variables() noexcept;

/// A variable, an array element or a bit found by its path.
struct VariablePlace {
  const Variable* variable = nullptr;  ///< nullptr: no such path
  std::size_t offset = 0;              ///< in AxisData [byte]
  int bit = -1;                        ///< bit of a word; -1: the whole variable

  Signal signal(AxisData& data) const noexcept;
};

/// Finds `Position`, `Sensor[1].Type`, `StatusWord.X22` without regard to case; array indices count as
/// published.
VariablePlace find_variable(std::string_view path) noexcept;

}  // namespace lockstep
