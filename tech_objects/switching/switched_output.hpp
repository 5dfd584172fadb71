/// Outputs that cams switch.
#pragma once

#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Where a cam shows when its output has changed, more finely than in servo cycles.
struct SwitchingTimes {
  double* on = nullptr;   ///< of the last edge on [s] since the start of the run; nullptr: nobody asks
  double* off = nullptr;  ///< of the last edge off
};

/// One output and the states of all cams that switch it. Thread: the cycle.
struct SwitchedOutput {
  bool* address = nullptr;
  bool all = false;  ///< AND, else OR
  std::vector<const BOOL*> states;

  void write() const noexcept {
    bool result = all;
    for (const BOOL* const state : states) result = all ? result && *state : result || *state;
    *address = result;
  }
};

}  // namespace lockstep
