/// What has been heard on the network and not been looked at yet.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "hmi_bridge/lcm/receiver.hpp"

namespace lockstep::cli {

/// Receives on a thread of its own, so that a slow terminal loses nothing. Bounded: what comes beyond is
/// dropped and counted.
class Inbox {
 public:
  static constexpr std::size_t kMaximumMessages = 20'000;
  static constexpr std::size_t kMaximumBytes = 32u << 20;

  /// @param joined tells the network; outlives this
  /// @throws std::runtime_error where it cannot be joined or no thread begun
  explicit Inbox(LcmPublisher& joined);
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;
  ~Inbox();

  /// Readable when something waits, for poll().
  int descriptor() const noexcept { return event_; }
  /// Hands on what waits, at most so many messages.
  void take(std::size_t maximum,
            const std::function<void(const std::string& channel, std::span<const std::uint8_t>)>& handler);
  std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  struct Letter {
    std::string channel;
    std::vector<std::uint8_t> data;
  };

  void put(const LcmMessage& message);
  void listen() noexcept;
  bool pop(Letter& letter);

  std::mutex mutex_;
  std::deque<Letter> letters_;
  std::size_t bytes_ = 0;
  int event_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> dropped_{0};
  LcmReceiver receiver_;
  std::thread thread_;
};

}  // namespace lockstep::cli
