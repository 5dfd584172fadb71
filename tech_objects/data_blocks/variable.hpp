/// Declared variables of technology data blocks and the one path syntax by which they are reached.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/object_kind.hpp"

namespace lockstep {

/// Declaration of one variable of the technology data block.
struct Variable {
  std::string_view path;  ///< published path below the object; an array element is written `Sensor[].Type` or
                          ///< `ValidPoint[]`
  Type type;
  std::size_t offset;      ///< of the (first) element in the data block [byte]
  std::size_t count = 0;   ///< elements of the array; 0: no array
  std::size_t stride = 0;  ///< distance of two elements [byte]
  Effect effect;
  bool computed = false;  ///< by the runtime, so that a project may not set it
  Unit unit;
  Range range;
  std::string_view text;              ///< meaning
  std::span<const Choice> choices{};  ///< permitted values, where they are an enumeration
  const BitNames* bits = nullptr;     ///< names of the bits of a status word
  bool later = false;                 ///< declared and holding its start value; its function is not there yet
  Value (*start)(const Variable&, std::size_t element) = nullptr;

  /// Value in a data block that has just been made; of the element counted from 0. While loading.
  Value start_value(std::size_t element = 0) const { return start(*this, element); }
};

/// The declared variables of one kind of technology object.
struct DataBlock {
  std::span<const Variable> configuration;  ///< that a project configures, in published order
  std::span<const Variable> status;         ///< that the runtime computes, in published order
  /// Both lists, one after the other.
  std::array<std::span<const Variable>, 2> lists() const noexcept { return {configuration, status}; }
};
const DataBlock& data_block_of(ObjectKind kind) noexcept;

/// A variable, an array element or a bit found by its path.
struct VariableAddress {
  const Variable* variable = nullptr;  ///< nullptr: no such path
  std::size_t offset = 0;              ///< in the data block [byte]
  int bit = -1;                        ///< bit of a word; -1: the whole variable

  /// @param data_block of an object of the kind that the place was found for
  Signal signal(void* data_block) const noexcept;
};

/// Finds `Position`, `Sensor[1].Type`, `ValidPoint[7]`, `StatusWord.X22` without regard to case; array
/// indices count as published.
VariableAddress find_variable(ObjectKind kind, std::string_view path) noexcept;

}  // namespace lockstep
