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
class RecordedValues {
 public:
  /// Load time: memory for all that `kLongestLeadingDelay` asks for.
  void reserve();

  void clear() noexcept { count_ = 0; }
  /// @param cycle of the source [ns] > 0
  void set_source(const Modulo& modulo, std::int64_t cycle) noexcept;
  const Modulo& modulo() const noexcept { return modulo_; }

  /// Takes a value over, in its place by its time. The oldest one gives way where there is no space left.
  /// @return false: there is one of that time already, or only newer ones and no space
  bool add(std::int64_t time, const Setpoint& value) noexcept;

  bool empty() const noexcept { return count_ == 0; }
  /// Whether `time` does not lie ahead of all that is known.
  bool reaches_back_to(std::int64_t time) const noexcept { return count_ != 0 && time >= entry(0).time; }
  /// Time of the newest value [ns]; only if there is one.
  std::int64_t newest_time() const noexcept { return entry(count_ - 1).time; }
  /// The value at a time [ns]; ahead of the oldest one that stands. Only if there is one.
  Setpoint at(std::int64_t time) const noexcept;

  /// Positions have other names from now on, each by this more [u].
  void rename(double by) noexcept;

 private:
  struct Entry {
    std::int64_t time = 0;
    Setpoint value;
  };
  const Entry& entry(std::size_t index) const noexcept {
    return entries_[(first_ + index) % entries_.size()];
  }
  Entry& entry(std::size_t index) noexcept { return entries_[(first_ + index) % entries_.size()]; }
  Setpoint between(const Entry& from, const Entry& to, std::int64_t time) const noexcept;
  Setpoint behind(const Entry& newest, std::int64_t time) const noexcept;

  std::vector<Entry> entries_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  Modulo modulo_;
  std::int64_t cycle_ = 1;  // of the source [ns]
};

}  // namespace lockstep
