/// The leading values of one source at the times to which they belong, and what lies between and behind them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// Longest delay of a leading value, in application cycles of its source: so many values are recorded, less
/// some for the time of the transfer.
inline constexpr int kLongestLeadingDelay = 4000;

/// A ring of values in the order of their times. Thread: the cycle, but for `reserve`.
///
/// Between two of them: the polynomial of fifth degree that has position, velocity and acceleration of both.
/// At a recorded time it is the recorded value, to the bit. With a jerk of at most J it is within
/// J · h³ / 160 of the true path between values h apart, its velocity within J · h² / 45, its acceleration
/// within J · h / 4.8.
///
/// Behind the newest: its acceleration goes on for four of its cycles, then its velocity. That is within
/// J · t³ / 6 of the true path for t up to those four cycles.
///
/// A source that misses ticks stands still in them, whatever its velocity. Up to the value behind them the
/// path goes on as behind the newest, so that it does not turn back, and there it steps.
class RecordedValues {
 public:
  /// Load time: memory for all that `kLongestLeadingDelay` asks for.
  void reserve();

  void clear() noexcept {
    count_ = 0;
    newest_step_ = INT64_MIN;
    changed_from_ = INT64_MIN;
  }
  /// @param cycle of the source [ns] > 0
  void set_source(const Modulo& modulo, std::int64_t cycle) noexcept;
  const Modulo& modulo() const noexcept { return modulo_; }

  /// Takes a value over, in its place by its time. The oldest one gives way where there is no space left.
  /// @param grid its time less a cycle for each tick of the source so far [ns]: more than that of the value
  /// before by as long as the source has stood between them
  /// @return false: there is one of that time already, or only newer ones and no space
  bool add(std::int64_t time, const Setpoint& value, std::int64_t grid = 0) noexcept;

  bool empty() const noexcept { return count_ == 0; }
  /// Whether `time` does not lie ahead of all that is known.
  bool reaches_back_to(std::int64_t time) const noexcept { return count_ != 0 && time >= entry(0).time; }
  /// Time of the newest value [ns]; only if there is one.
  std::int64_t newest_time() const noexcept { return entry(count_ - 1).time; }
  /// The value at a time [ns]; ahead of the oldest one that stands. Only if there is one.
  Setpoint at(std::int64_t time) const noexcept;

  /// For how long the source has stood at those steps of the path that lie behind `from`, up to `to` [ns].
  std::int64_t stood_between(std::int64_t from, std::int64_t to) const noexcept {
    return newest_step_ <= from ? 0 : sum_of_steps(from, to);
  }

  /// The time up to which the path is as it was at the last `mark_unchanged` [ns].
  std::int64_t changed_from() const noexcept { return changed_from_; }
  void mark_unchanged() noexcept { changed_from_ = INT64_MAX; }

  /// Positions have other names from now on, each by this more [u].
  void rename(double by) noexcept;

 private:
  /// Values beside those of the longest delay are for what is under way and for lost ones.
  static constexpr std::size_t kCapacity = 4096;
  static_assert(kCapacity >= kLongestLeadingDelay + 96 && (kCapacity & (kCapacity - 1)) == 0);

  struct Entry {
    std::int64_t time = 0;
    Setpoint value;
    std::int64_t grid = 0;
  };
  const Entry& entry(std::size_t index) const noexcept {
    return entries_[(first_ + index) & (kCapacity - 1)];
  }
  Entry& entry(std::size_t index) noexcept { return entries_[(first_ + index) & (kCapacity - 1)]; }
  std::size_t index_before(std::int64_t time) const noexcept;
  std::int64_t stood(const Entry& from, const Entry& to) const noexcept;
  std::int64_t sum_of_steps(std::int64_t from, std::int64_t to) const noexcept;
  Setpoint between(const Entry& from, const Entry& to, std::int64_t time) const noexcept;
  Setpoint behind(const Entry& newest, std::int64_t time) const noexcept;

  std::vector<Entry> entries_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  Modulo modulo_;
  std::int64_t cycle_ = 1;                // of the source [ns]
  std::int64_t newest_step_ = INT64_MIN;  // time of the last value behind which the source had stood [ns]
  std::int64_t changed_from_ = INT64_MIN;
};

}  // namespace lockstep
