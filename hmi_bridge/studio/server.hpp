/// The studio's server: HTTP and WebSocket on one port, by a thread of its own.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hmi_bridge/network/network.hpp"
#include "hmi_bridge/studio/guard.hpp"
#include "hmi_bridge/studio/handler.hpp"

namespace lockstep {

namespace studio_net {
class Listener;
}

struct StudioServerOptions {
  Endpoint listen{"127.0.0.1", 8780};              ///< an address; port 0: any that is free
  std::vector<std::string> names;                  ///< see StudioGuard
  std::string token;                               ///< the same
  std::vector<IpNetwork> allow;                    ///< from which clients may come; none: from everywhere
  std::string upload_folder = "/tmp";              ///< for files that are sent, until they are read
  std::chrono::milliseconds request_time{10'000};  ///< for a request to be there whole
};

/// What has come. Any thread may read.
struct StudioCounters {
  std::atomic<std::uint64_t> requests{0};  ///< answered by the handler
  std::atomic<std::uint64_t> refused{0};   ///< by the guard, or beyond a limit
  std::atomic<std::uint64_t> faults{0};    ///< internal ones that were survived
  std::atomic<std::uint64_t> pages{0};     ///< connected now
};

/// Judges requests, keeps the limits, hands on what may be answered. Knows no project.
class StudioServer {
 public:
  static constexpr std::size_t kConnections = 32;
  static constexpr std::size_t kPages = 8;
  static constexpr std::uint32_t kHeaderBytes = 8 << 10;
  static constexpr std::size_t kBodyBytes = std::size_t{16} << 20;
  static constexpr std::uint64_t kUploadBytes = std::uint64_t{2} << 30;  ///< of a file that is sent
  static constexpr std::size_t kMessageBytes = std::size_t{1} << 20;
  static constexpr int kChangesPerSecond = 50;  ///< requests that are not GET
  static constexpr std::chrono::milliseconds kLook{16};

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
