/// The variables and arrays of a device's programs, for whoever looks from outside: `Var.name`,
/// `Arr.name[n]`.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "scheduler/aposs/image.hpp"
#include "scheduler/aposs/machine.hpp"
#include "tech_objects/data_blocks/own_variable.hpp"

namespace lockstep {

/// While loading. What it gives is where the machine keeps it, so that nothing is copied.
class ProgramValues {
 public:
  /// @param programs whose variables stand in the same cells, each in all of them
  void declare(std::span<const aposs::Image* const> programs, aposs::Machine& machine, aposs::Arrays& arrays);
  std::span<const OwnVariable> all() const noexcept { return all_; }

 private:
  void add(std::string path, void* address, std::size_t count, const char* text);
  void add_arrays(std::span<const aposs::Image* const> programs, aposs::Arrays& arrays);

  std::deque<std::string> names_;
  std::vector<OwnVariable> all_;
};

}  // namespace lockstep
