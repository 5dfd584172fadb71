/// Datagrams of an LCM network put together to messages. What comes from a network is not believed: each
/// length and offset is checked, and what is incomplete is bounded in number, size and time.
/// @source LCM, UDP multicast protocol, "LC02" and "LC03"
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/channel_length.hpp"

namespace lockstep {

/// A message as it came. Its memory is that of the datagram or of the reassembly, until the next datagram.
struct LcmMessage {
  std::string_view channel;  ///< 1 to 63 characters, any but 0
  std::span<const std::uint8_t> data;
  std::string_view sender{};  ///< address and port of the last datagram; empty: this process
  sockaddr_in address{};      ///< of the sender of the last datagram
};

/// What the reassembly keeps at most. The defaults bear the header of a trace of 60,000 signals.
struct LcmBounds {
  std::size_t message = 8u << 20;  ///< of one message in fragments [byte]; 0: fragments are refused
  std::size_t memory = 16u << 20;  ///< of all fragments that wait, with what it costs to keep them [byte]
  std::size_t incomplete = 16;     ///< messages at a time
  std::chrono::milliseconds timeout{1000};  ///< from the first fragment of a message to its last
};

/// What has become of the datagrams.
struct LcmDatagramCounters {
  std::uint64_t messages = 0;   ///< complete
  std::uint64_t malformed = 0;  ///< datagrams that are none of LCM, or contradict themselves or others
  std::uint64_t refused = 0;    ///< datagrams beyond the bounds
  std::uint64_t given_up = 0;   ///< messages of which parts are missing
};

/// Any one thread.
class LcmReassembly {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kLongestChannel = kLongestLcmChannel;

  explicit LcmReassembly(LcmBounds bounds = {}) : bounds_(bounds) {}

  /// Takes a datagram. @param sender tells senders apart, such as address and port
  /// @return the message that it is, or completes
  std::optional<LcmMessage> accept(std::span<const std::uint8_t> datagram, std::uint64_t sender,
                                   Clock::time_point now);

  const LcmDatagramCounters& counters() const noexcept { return counters_; }
  /// Memory of what waits [byte], at most that of the bounds. Only what has come counts, not what is
  /// announced.
  std::size_t memory() const noexcept { return memory_; }
  std::size_t incomplete() const noexcept { return partial_.size(); }

 private:
  struct Fragment {
    std::uint32_t sequence, message_size, offset;
    std::uint16_t number, count;
    std::span<const std::uint8_t> rest;  // channel and data, or data
  };
  struct Piece {
    std::uint32_t offset;
    std::vector<std::uint8_t> data;
  };
  struct Partial {
    std::uint64_t sender;
    std::uint32_t sequence, size;
    std::uint16_t count;  // of its fragments
    Clock::time_point begun;
    std::string channel;
    std::map<std::uint16_t, Piece> pieces;  // by number of the fragment
  };
  using Partials = std::list<Partial>;

  std::optional<LcmMessage> malformed() noexcept;
  std::optional<LcmMessage> refused() noexcept;
  std::optional<LcmMessage> accept_short(std::span<const std::uint8_t> rest);
  std::optional<LcmMessage> accept_fragment(const Fragment& fragment, std::uint64_t sender,
                                            Clock::time_point now);
  Partials::iterator partial_of(const Fragment& fragment, std::uint64_t sender, Clock::time_point now);
  bool make_capacity(std::size_t bytes, Partials::iterator partial) noexcept;
  std::optional<LcmMessage> complete(Partials::iterator partial);
  void forget(Partials::iterator partial) noexcept;
  void give_up_late(Clock::time_point now) noexcept;

  const LcmBounds bounds_;
  LcmDatagramCounters counters_;
  Partials partial_;  // the oldest first
  std::size_t memory_ = 0;
  std::string channel_;  // of the last message that has been completed
  std::vector<std::uint8_t> data_;
};

}  // namespace lockstep
