/// The clock that several controllers share, and whether it can be trusted.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace lockstep {

/// Which clock that is.
enum class SharedClockKind : std::uint8_t {
  monotonic,  ///< CLOCK_MONOTONIC: processes of one machine
  tai         ///< CLOCK_TAI, disciplined by PTP: across machines
};

/// What a look at a shared clock tells.
struct SharedClockReading {
  std::int64_t offset = 0;  ///< what it shows more than CLOCK_MONOTONIC, by which a cycle waits [ns]
  bool locked = true;       ///< whether what disciplines it does so
};

/// Any thread but the cycle's. Nothing here allocates or waits.
class SharedClock {
 public:
  virtual ~SharedClock() = default;
  virtual SharedClockReading read() noexcept = 0;
};

/// The clock of a kind.
/// @param largest_error that the kernel may know of it [ns]; above, it is not locked. Of CLOCK_TAI alone:
///   whoever disciplines it says so to the kernel, as phc2sys and ptp4l of linuxptp do (adjtimex, STA_UNSYNC
///   and maxerror, which grows by 500 µs for each second in which nobody does)
std::unique_ptr<SharedClock> make_shared_clock(SharedClockKind kind, std::int64_t largest_error);

/// Watches over a shared clock: a jump, or the loss of what disciplines it, and nothing counts that is told
/// of its time; once it goes on evenly for `kSettled`, it counts again, with another offset after a jump.
/// What disciplines a clock changes its frequency, and with it that of CLOCK_MONOTONIC, so that the offset
/// stays the same to the noise of reading. `look` is for one thread, the rest for any.
class ClockWatch {
 public:
  static constexpr std::int64_t kJump = 50'000;            ///< [ns]
  static constexpr std::int64_t kSettled = 2'000'000'000;  ///< [ns]
  static constexpr std::int64_t kBetween = 100'000'000;    ///< from look to look [ns]

  /// Looks for the first time: the clock counts from then on if it is locked.
  explicit ClockWatch(SharedClock& clock) noexcept;

  /// @param now CLOCK_MONOTONIC [ns]; looks closer to each other than `kBetween` are none
  void look(std::int64_t now) noexcept;

  std::int64_t offset() const noexcept { return offset_.load(std::memory_order_relaxed); }
  bool trusted() const noexcept { return trusted_.load(std::memory_order_relaxed); }
  /// Times at which it has been found to have jumped, or not to be locked any more.
  std::uint64_t losses() const noexcept { return losses_.load(std::memory_order_relaxed); }
  const std::atomic<std::uint64_t>& loss_count() const noexcept { return losses_; }

 private:
  void lose(std::int64_t now, std::int64_t offset) noexcept;

  SharedClock& clock_;
  std::atomic<std::int64_t> offset_;
  std::atomic<bool> trusted_;
  std::atomic<std::uint64_t> losses_{0};
  std::int64_t looked_ = INT64_MIN;  // [ns]
  std::int64_t settling_ = 0;        // [ns] since when it goes on evenly, while it does not count
  std::int64_t candidate_ = 0;       // its offset meanwhile [ns]
};

}  // namespace lockstep
