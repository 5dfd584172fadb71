/// Telegrams of the last moments, those sent and those that came, kept until somebody wants them.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/channel_length.hpp"

namespace lockstep {

/// A message as it went over the network.
struct KeptTelegram {
  static constexpr std::size_t kLongest = 512;  ///< [byte]
  static constexpr std::size_t kLongestChannel = kLongestLcmChannel;

  std::int64_t utime = 0;  ///< [µs since the epoch] when it was sent, or came
  std::uint16_t size = 0;
  std::uint8_t channel_size = 0;
  std::array<char, kLongestChannel> channel_bytes{};
  std::array<std::uint8_t, kLongest> bytes{};

  std::string_view channel() const noexcept { return {channel_bytes.data(), channel_size}; }
  std::span<const std::uint8_t> data() const noexcept { return {bytes.data(), size}; }
};

/// A ring of the newest ones, whose memory is there from the start. Any thread: one that adds never waits for
/// another one; what is added while somebody copies is left out.
class TelegramMemory {
 public:
  explicit TelegramMemory(std::size_t capacity) : kept_(capacity) {}

  /// Longer ones than a telegram can be are left out.
  void add(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept;
  /// Those from a time on, the oldest first.
  std::vector<KeptTelegram> since(std::int64_t utime) const;

 private:
  mutable std::mutex mutex_;  // guards those below
  std::vector<KeptTelegram> kept_;
  std::size_t next_ = 0, count_ = 0;
};

/// Writes an LCM event log, which `lcm-logplayer` replays, into a new file.
/// @throws std::system_error that names the file
void write_telegrams(const std::string& path, const std::vector<KeptTelegram>& telegrams);

}  // namespace lockstep
