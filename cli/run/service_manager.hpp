/// Tells systemd how a run goes: that its cycle runs, that ticks advance, that it ends.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace lockstep::cli {

/// The protocol of sd_notify(3): one datagram for each message to the socket that $NOTIFY_SOCKET names, a
/// path or an abstract address ("@…"). Does nothing where nobody asked for it. Nothing here waits: a message
/// that is not taken now is sent at the next look. Used by one thread, never the cycle's.
class ServiceManager {
 public:
  /// @param servo_cycle [ns]: as long as two of it may pass without a tick
  explicit ServiceManager(std::int64_t servo_cycle);
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// How long to wait from one look to the next at most, if it would be `usual` otherwise.
  std::chrono::milliseconds interval(std::chrono::milliseconds usual) const noexcept;

  /// A look at a run that has executed so many ticks: READY=1 with the first of them, and WATCHDOG=1 as often
  /// as $WATCHDOG_USEC asks for as long as they advance. A run whose ticks stand falls silent.
  void look(std::uint64_t ticks) noexcept;
  /// STOPPING=1, once.
  void stopping() noexcept;

 private:
  using Time = std::chrono::steady_clock::time_point;

  bool send(std::string_view message) const noexcept;

  sockaddr_un address_{};
  socklen_t size_ = 0;
  int socket_ = -1;                         // negative: nobody asks
  std::chrono::microseconds period_{0};     // of the watchdog's messages; 0: none
  const std::chrono::nanoseconds timeout_;  // with ticks that do not advance
  std::uint64_t ticks_ = 0;                 // at the last look
  Time advanced_;                           // when they were seen to advance
  bool advances_ = false;                   // since the last message
  Time sent_;                               // the last message of the watchdog
  bool ready_ = false;
  bool stopping_ = false;
};

}  // namespace lockstep::cli
