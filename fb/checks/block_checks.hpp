/// What can be said of the calls of a block before anything runs: the checks of its constant inputs.
#pragma once

#include <span>

#include "fb/checks/written_call.hpp"

namespace lockstep {

/// The checks of one type of block; nullptr where it has none of a kind. They run while a project is loaded.
struct BlockChecks {
  std::string_view block;  ///< published name
  /// Looks at one call, whose index is 0.
  void (*one)(const WrittenCall& call, CallWarnings& warnings) = nullptr;
  /// Looks at all calls of the type that one program has.
  void (*all)(std::span<const WrittenCall> calls, CallWarnings& warnings) = nullptr;
};

/// All checks, in the order of the blocks.
std::span<const BlockChecks> block_checks() noexcept;

/// The checks of a type; nullptr: there is nothing to look at.
const BlockChecks* checks_of(const BlockType& type) noexcept;

}  // namespace lockstep
