/// What is done when somebody outside falls silent.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A value for an address.
struct Assignment {
  Signal place;
  Value value{};
};

/// Watches a heartbeat: a variable that somebody outside of the cycle changes again and again. When it has
/// not changed for the timeout, the fail-safe values are written in every tick, until it changes. What
/// programs do to the heartbeat is no sign of life. Nothing allocates after construction. Thread: the cycle.
class Watchdog {
 public:
  /// @param timeout of the grid of ticks, ≥ 1  @param values in the ranges of their addresses
  /// @param status a BOOL: TRUE while there is silence
  Watchdog(Signal heartbeat, std::int64_t timeout, std::vector<Assignment> values,
           std::optional<Signal> status);

  /// Takes the heartbeat as it is for seen: at the end of loading, and at the end of each tick.
  void remember() noexcept { seen_ = heartbeat_.load().u; }

  /// Looks for a sign of life, when all that comes from outside is in the variables; without one for the
  /// timeout it writes the values. The time begins with the first tick.
  /// @param tick number on the grid; those left out count as time
  void look(std::int64_t tick) noexcept;

  bool silent() const noexcept { return silent_; }
  /// How often silence has begun.
  std::uint64_t silences() const noexcept { return silences_; }

 private:
  Signal heartbeat_;
  std::int64_t timeout_;
  std::vector<Assignment> values_;
  std::optional<Signal> status_;
  std::uint64_t seen_ = 0;   // bits of the heartbeat
  std::int64_t alive_ = -1;  // tick of the last sign of life, or the first tick; negative: none yet
  std::uint64_t silences_ = 0;
  bool silent_ = false;
};

}  // namespace lockstep
