/// The studio's server: HTTP and WebSocket on one port, by a thread of its own.
#pragma once

#include <memory>
#include <string>

#include "hmi_bridge/network/network.hpp"
#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/server_options.hpp"

namespace lockstep {

namespace studio_net {
class Listener;
}

/// Judges requests, keeps the limits, hands on what may be answered. Knows no project.
class StudioServer : public StudioLimits {
 public:
  /// @param handler outlives this
  StudioServer(StudioServerOptions options, StudioHandler& handler);
  ~StudioServer();  ///< stops
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  /// Listens, and starts the thread. @return what is wrong; empty: nothing
  std::string start();
  /// Closes all connections and ends the thread.
  void stop();
  /// Where it listens, with the port that the system gave. After `start`.
  Endpoint endpoint() const;
  const StudioCounters& counters() const noexcept;

 private:
  std::unique_ptr<studio_net::Listener> listener_;
};

}  // namespace lockstep
