#include "scheduler/watchdog.hpp"

#include <utility>

namespace lockstep {

Watchdog::Watchdog(Signal heartbeat, std::int64_t timeout, std::vector<Assignment> values,
                   std::optional<Signal> status)
    : heartbeat_(heartbeat), timeout_(timeout), values_(std::move(values)), status_(status) {
  remember();
}

void Watchdog::look(std::int64_t tick) noexcept {
  if (alive_ < 0 || heartbeat_.load().u != seen_) alive_ = tick;
  const bool silent = tick - alive_ >= timeout_;
  if (silent && !silent_) ++silences_;
  silent_ = silent;
  if (status_) status_->store(Value{.u = silent ? 1u : 0u});
  if (!silent) return;
  for (const Assignment& one : values_) one.place.store(one.value);
}

}  // namespace lockstep
