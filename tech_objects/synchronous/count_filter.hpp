/// Velocity of a counter, smoothed; what the smoothing holds back is given back in the course of time, so
/// that no count is lost. Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-26 velocity filter
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lockstep {

class CountFilter {
 public:
  /// Time constant by the printed table, linear in between, its ends beyond [ms].
  /// @param resolution of the encoder [lines per turn]
  static double published_time(double resolution) noexcept {
    struct Row {
      double lines, time;
    };
    constexpr Row kRows[] = {{250, 39.5}, {256, 38.6}, {500, 19.5}, {512, 19.0}, {1000, 9.5}, {1024, 9.3},
                             {2000, 4.5}, {2048, 4.4}, {2500, 3.5}, {4096, 1.9}, {5000, 1.4}};
    const Row* last = kRows;
    if (resolution <= last->lines) return last->time;
    for (const Row& row : kRows) {
      if (resolution <= row.lines) {
        const double part = (resolution - last->lines) / (row.lines - last->lines);
        return last->time + part * (row.time - last->time);
      }
      last = &row;
    }
    return last->time;
  }

  /// @param velocity at the start [counts/ms]
  void begin(double velocity) noexcept {
    velocity_ = velocity;
    lag_ = 0.0;
  }
  /// The smoothed velocity alone. @param time [ms]; up to 1: as it is
  double step(double counts, double time) noexcept {
    velocity_ = settled(velocity_ + (time > 1.0 ? (counts - velocity_) / time : counts - velocity_));
    return velocity_;
  }
  /// The smoothed motion of this millisecond: what has been held back comes back in ten time constants.
  double step_and_return(double counts, double time) noexcept {
    constexpr double kTimes = 10.0;
    step(counts, time);
    const double returned = time > 1.0 ? lag_ / (kTimes * time) : lag_;
    lag_ = settled(lag_ + (counts - velocity_ - returned));
    return velocity_ + returned;
  }
  double velocity() const noexcept { return velocity_; }  ///< [counts/ms]
  double lag() const noexcept { return lag_; }            ///< by how much what is given is behind [counts]

 private:
  /// Behind a counter that stands, both halve without end, and a processor takes several times as long for
  /// numbers below 2⁻¹⁰²² as for others: what is far below anything that is ever added is nothing.
  static double settled(double value) noexcept {
    if (std::abs(value) >= 1e-300) [[likely]]
      return value;
    return 0.0;
  }

  double velocity_ = 0.0, lag_ = 0.0;
};

/// Takes the time constant of a filter back where what it holds back becomes too much, and gives it back
/// where that has become little: by 1 ms in a millisecond, and never below 5 ms.
/// @source MG.33.L5.03, 33-33 synchronization error window
class FadingTime {
 public:
  /// @param time constant [ms]
  void begin(double velocity, double time) noexcept {
    whole_.begin(velocity);
    time_ = time;
    fades_ = false;
  }
  /// @param limit of what the filter may hold back with its whole time constant [counts] > 0
  /// @param time its whole time constant [ms]  @return the one of this millisecond [ms]
  double step(double counts, double time, double limit) noexcept {
    constexpr double kMinimum = 5.0, kAgain = 0.2;
    whole_.step_and_return(counts, time);
    const double held = std::abs(whole_.lag());
    fades_ = fades_ ? held >= kAgain * limit : held >= limit;
    time_ = fades_ ? std::max(time_ - 1.0, kMinimum) : time_ + 1.0;
    return time_ = std::min(time_, time);
  }

 private:
  CountFilter whole_;
  double time_ = 0.0;
  bool fades_ = false;
};

}  // namespace lockstep
