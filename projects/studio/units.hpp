/// Units of everything in a project, found before the run begins: what they depend on belongs to the cycle
/// then.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "hmi_bridge/traces/columns.hpp"
#include "projects/loader/project.hpp"

namespace lockstep {

/// Any thread, once it is made.
class StudioUnits {
 public:
  /// Before the run.
  explicit StudioUnits(const Project& project);
  /// As the project has it, such as "mm/s"; empty for none.
  std::string of(const NamedSignal& signal) const;

 private:
  std::map<std::pair<const void*, Unit>, std::string> texts_;  // by object or instance
};

}  // namespace lockstep
