/// What one page has been sent of a trace that goes on, and what it gets next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "hmi_bridge/traces/store.hpp"

namespace lockstep {

/// Reads a store for one page, each subscription from where it stands. A page that is slow holds nothing up
/// and costs no memory: what it has not fetched stays in the store, and comes as points of several rows when
/// it is back, with every peak that the store still has. Thread: the server's.
class StudioStream {
 public:
  static constexpr std::size_t kFrames = 8;                    ///< without an answer at most
  static constexpr std::size_t kBytes = std::size_t{4} << 20;  ///< the same
  static constexpr std::uint64_t kRows = 512;         ///< of a frame; beyond, several come to a point
  static constexpr std::uint64_t kPoints = 256;       ///< of a frame of points, about
  static constexpr std::uint64_t kSparsest = 10'000;  ///< every so manieth row at least

  /// Begins a subscription with the next row; one with this id is replaced.
  /// @param every only rows whose number it divides are sent, 1 to `kSparsest`
  void subscribe(std::uint32_t id, std::vector<std::size_t> signals, const TraceStore& store,
                 std::uint64_t every = 1);
  void unsubscribe(std::uint32_t id);
  /// The page has drawn all frames up to this one. Numbers that were not sent mean nothing.
  void acknowledge(std::uint32_t frame) noexcept;
  /// The next frame; none: there is nothing new, or the page has not answered.
  std::optional<std::vector<std::uint8_t>> next(const TraceStore& store);

  std::size_t unanswered_frames() const noexcept { return sent_.size(); }

 private:
  struct Subscription {
    std::uint32_t id;
    std::vector<std::size_t> signals;
    std::uint64_t row;          // that comes next
    std::uint64_t dropped = 0;  // rows missing before it
    std::uint64_t counted;      // gaps before this row are in `dropped`
    std::uint64_t every;
  };
  struct Sent {
    std::uint32_t frame;
    std::size_t bytes;
  };

  static void count_gaps(Subscription& subscription, const TraceStore& store);
  std::vector<std::uint8_t> frame_of(Subscription& subscription, const TraceStore& store);

  std::vector<Subscription> subscriptions_;
  std::size_t turn_ = 0;
  std::deque<Sent> sent_;
  std::size_t bytes_ = 0;
  std::uint32_t frame_ = 0;
};

}  // namespace lockstep
