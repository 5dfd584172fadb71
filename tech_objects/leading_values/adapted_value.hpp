/// The leading value of another controller at the times at which this one asks for it, without steps.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/leading_values/recorded_values.hpp"

namespace lockstep {

/// Goes along recorded values. What has been given is never taken back: where a value that has come later
/// shows that the path was another one, or another delay counts, the difference in position, velocity and
/// acceleration goes to zero along a polynomial of fifth degree that begins with all three and ends at rest.
/// It takes `kReturnCycles` cycles (the longer one of source and receiver), four times as long as the value
/// was extrapolated, or its source stood in ticks that it has missed, and four times the change of a delay,
/// so that a long gap is not made up for in a hurry: a leading value that goes on evenly does not turn back.
/// Where values are interpolated and none is missing there is no difference, and the recorded path is given
/// as it is, to the bit. The acceleration alone may step: where extrapolation ends to count it. Thread: the
/// cycle.
class AdaptedValue {
 public:
  static constexpr int kReturnCycles = 8;

  /// The next value begins anew, with a step.
  void clear() noexcept { begun_ = false; }
  /// @param now time of this tick [ns], later than that of the last one  @param time for which the value is
  /// asked [ns]  @param cycle the longer one of the cycles of source and receiver [ns]
  /// @param recorded not empty
  const Setpoint& step(const RecordedValues& recorded, std::int64_t now, std::int64_t time,
                       std::int64_t cycle) noexcept;
  const Setpoint& value() const noexcept { return value_; }
  bool begun() const noexcept { return begun_; }
  /// Whether it is on its way back to the recorded path.
  bool returning() const noexcept { return return_time_ != 0; }

  /// Positions have other names from now on, each by this more [u].
  void rename(double by, const Modulo& modulo) noexcept;

 private:
  struct Difference {
    double position = 0.0;      // [u]
    double velocity = 0.0;      // [u/s]
    double acceleration = 0.0;  // [u/s²]
  };
  void compare(const RecordedValues& recorded, const Setpoint& target, std::int64_t passed, std::int64_t time,
               std::int64_t stood, std::int64_t cycle) noexcept;
  void plan(const Difference& more, std::int64_t time, std::int64_t stood) noexcept;
  Setpoint path_before(const RecordedValues& recorded, const Setpoint& target, std::int64_t time,
                       std::int64_t passed) const noexcept;
  Difference difference() const noexcept;

  bool begun_ = false;
  Setpoint value_;                 // given
  Setpoint followed_;              // of the recorded path, without a difference
  std::int64_t now_ = 0;           // [ns] of the last tick
  std::int64_t time_ = 0;          // [ns] asked for then
  std::int64_t extrapolated_ = 0;  // [ns] by how much then
  std::int64_t stood_to_ = 0;      // [ns] up to which steps of the path have been made up for
  Difference start_;               // of the return
  std::int64_t return_time_ = 0;   // [ns] of the whole return; 0: there is none
  std::int64_t returned_for_ = 0;  // [ns]
};

}  // namespace lockstep
