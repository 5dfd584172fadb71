/// The variables of the technology data block as the nested objects by which a project sets them.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep {

/// A structure, the elements of an array, or a variable.
struct ConfigurationNode {
  std::string_view name;               ///< as published, without index
  std::size_t count = 0;               ///< elements of the array; 0: no array
  const Variable* variable = nullptr;  ///< nullptr: a structure
  std::vector<std::unique_ptr<ConfigurationNode>> children;

  const ConfigurationNode* find(std::string_view child) const noexcept;
  /// Whether all there is in it is computed by the runtime.
  bool computed() const noexcept;
};

/// The tree of all variables of a kind of object, in published order. Built at the first call; any thread.
const ConfigurationNode& configuration_tree(ObjectKind kind);

}  // namespace lockstep
