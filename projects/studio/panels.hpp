/// Commands of pages, and how the axes stand that take them.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/studio/powers.hpp"

namespace lockstep {

struct StudioMessage;

/// Each page is a panel of the desk that all who command the run share. Thread: the server's.
class StudioPanels {
 public:
  using Clock = std::chrono::steady_clock;

  explicit StudioPanels(const StudioPowers& powers) : powers_(powers) {}

  /// A message `command`; answers it. @throws studio_api::BadRequest
  void obey(StudioClient& client, const StudioMessage& message);
  /// A page is gone: what it jogs stops.
  void leave(StudioClient& client);
  /// How the axes stand, as a page sees them; empty: none takes commands.
  studio_api::Json panels_for(StudioClient& client);
  /// Whether it is time to tell the pages, ten times a second; then the next beat begins.
  bool is_due(Clock::time_point now);

 private:
  std::int64_t sender_of(StudioClient& client);

  const StudioPowers& powers_;
  std::map<StudioClient*, std::int64_t> senders_;  // by chance, of pages that have commanded
  std::vector<SharedDesk::Panel> newest_;
  Clock::time_point next_{};
};

}  // namespace lockstep
