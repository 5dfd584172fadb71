/// A call of a block as a project has it, for what checks it at the desk.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fb/block.hpp"

namespace lockstep {

/// An input that a call is given.
struct GivenInput {
  std::string_view pin;  ///< published name
  bool constant;         ///< its value stands in the instance; else the program computes it
  std::string shown;     ///< as the project has it, for messages
};

/// A call of a block. What is constant or not given stands in its instance.
struct WrittenCall {
  const BlockType* type;
  Block* block;
  std::vector<GivenInput> inputs;

  /// The input of a pin; nullptr: it is not given and has its default.
  const GivenInput* given(std::string_view pin) const noexcept;
  /// Whether the program computes the input of a pin, so that nobody knows its value yet.
  bool computed(std::string_view pin) const noexcept;
  /// The technology object that a pin has; nullptr: none. It may be one that is looked at and never runs, so
  /// its data block is all that may be asked of it.
  TechnologyObject* object(std::string_view pin) const noexcept;
};

/// Something that is legal and looks like a mistake.
struct CallWarning {
  std::size_t call;      ///< index of the call among those that were looked at
  std::string_view pin;  ///< of an input that it is given
  std::string text;
};
using CallWarnings = std::vector<CallWarning>;

}  // namespace lockstep
