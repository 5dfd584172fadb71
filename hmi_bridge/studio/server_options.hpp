/// How the studio's server is set up, what it counts and what it allows.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hmi_bridge/network/network.hpp"
#include "hmi_bridge/studio/guard.hpp"

namespace lockstep {

struct StudioServerOptions {
  Endpoint listen{"127.0.0.1", 8780};              ///< an address; port 0: any that is free
  std::vector<std::string> names;                  ///< see StudioGuard
  std::string token;                               ///< the same
  std::vector<IpNetwork> allow;                    ///< from which clients may come; none: from everywhere
  std::string upload_folder = "/tmp";              ///< for files that are sent, until they are read
  std::chrono::milliseconds request_time{10'000};  ///< for a request to be there whole
  /// After which a page is asked whether it is there; after the same time once more it is closed.
  std::chrono::milliseconds silence{30'000};
};

/// What has come. Any thread may read.
struct StudioCounters {
  std::atomic<std::uint64_t> requests{0};  ///< answered by the handler
  std::atomic<std::uint64_t> refused{0};   ///< by the guard, or beyond a limit
  std::atomic<std::uint64_t> faults{0};    ///< internal ones that were survived
  std::atomic<std::uint64_t> pages{0};     ///< connected now
};

/// What is allowed at most.
struct StudioLimits {
  static constexpr std::size_t kConnections = 32;
  static constexpr std::size_t kPages = 8;
  static constexpr std::uint32_t kHeaderBytes = 8 << 10;
  static constexpr std::size_t kBodyBytes = std::size_t{16} << 20;
  static constexpr std::uint64_t kUploadBytes = std::uint64_t{2} << 30;  ///< of a file that is sent
  static constexpr std::size_t kMessageBytes = std::size_t{1} << 20;
  static constexpr int kChangesPerSecond = 50;  ///< requests that are not GET
  static constexpr std::chrono::milliseconds kLook{16};
};

}  // namespace lockstep
