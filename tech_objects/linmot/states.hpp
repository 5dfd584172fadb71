/// The operating states of a LinMot controller, and what leads from one to another.
/// @source LinMot release 1.3 addendum, 1.9, 3.8, 8.6
#pragma once

#include <cstdint>

namespace lockstep::linmot {

enum class State : std::uint8_t { wait_for_disable, disable, init, run, stop, error };

/// What the transitions depend on.
struct StateFacts {
  bool run = false, init = false, stop = false;  ///< requests
  bool error = false;                            ///< one that is pending
  bool cause = false;                            ///< of an error, still there
  bool homed = false;                            ///< all motors
  bool homing_over = false;                      ///< nothing of INIT is left to do
  bool automatic = false;                        ///< Auto Start, and no request so far
  bool warning = false;

  bool none_requested() const noexcept { return !run && !init && !stop; }
};

/// Of power-up.
State first_state(const StateFacts& facts) noexcept;
/// One step: the first transition of the table that holds, or the state itself.
State next_state(State state, const StateFacts& facts) noexcept;

}  // namespace lockstep::linmot
