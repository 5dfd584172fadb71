/// What has become of the messages that carry telegrams, before those come to a proxy.
#pragma once

#include <atomic>
#include <cstdint>

namespace lockstep {

/// Written by the thread that receives, read by any other.
struct CarrierCounts {
  using Count = std::atomic<std::uint64_t>;

  Count accepted{0};    ///< telegrams that count
  Count malformed{0};   ///< no telegrams
  Count foreign{0};     ///< of another area, sender, address or layout
  Count not_signed{0};  ///< without the right code
  Count repeated{0};    ///< that have been accepted already, or are as old as such ones
  Count ambiguous{0};   ///< while there are two senders
  Count stale{0};       ///< older or newer than the clock allows
  Count untrusted{0};   ///< while the clock that all share is not to be trusted
  Count dropped{0};     ///< for which the cycle had no space left
};

}  // namespace lockstep
