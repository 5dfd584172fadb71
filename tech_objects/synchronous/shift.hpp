/// An offset that is brought into a running synchronous motion: leading value offset (phasing) and following
/// value offset.
/// @source S7-1500T synchronous operation V7, 6.2.4, 6.2.5
#pragma once

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/arithmetic/remainder.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep {

/// The effective leading value of this tick and one tick ago, on the ring of the leading axis.
struct LeadingStep {
  Setpoint now;
  Setpoint last;
  Modulo modulo;

  double distance() const noexcept { return rounded_difference(now.position, last.position, modulo); }
};

/// How a shift changes.
enum class ShiftRule : std::uint8_t {
  dynamics,       ///< planned in time
  from_here,      ///< over a leading distance from here on
  from_position,  ///< over a leading distance from a leading position on
};

/// What is asked of a shift.
struct ShiftRequest {
  DoubleDouble target;  ///< total shift at the end [u]
  ShiftRule rule = ShiftRule::from_here;
  double distance = 0.0;        ///< leading distance [u] > 0; not in time
  double start_position = 0.0;  ///< of the leading value [u]; `from_position`
  int direction = 0;            ///< of the leading value: 1, -1; 0: either
  ProfileLimits limits;         ///< of the shift: in time, and where it has to rest before it waits
};

/// The shift in effect and how it changes. The sum of many shifts carries its rounding error along. Thread:
/// the cycle.
class Shift {
 public:
  enum class Phase : std::uint8_t { resting, waiting, running };
  /// What has happened in a tick.
  enum class Event : std::uint8_t { none, done, reversed };

  /// Back to zero.
  void reset() noexcept { *this = Shift{}; }

  /// In effect from the beginning, at rest.
  void start_at(DoubleDouble value) noexcept {
    reset();
    value_ = value;
    in_use_ = value.hi != 0.0;
  }

  /// At a value in the next tick, with the motion of a shift that ends there; then it comes to rest, without
  /// a job.
  void settle_at(DoubleDouble value, const Shift& moving, const ProfileLimits& limits,
                 double period) noexcept;

  /// As much more, wherever it is and goes, without motion.
  void shift(double by) noexcept {
    value_ = value_ + by;
    base_ = base_ + by;
    request_.target = request_.target + by;
    in_use_ = true;
  }

  /// Begins to wait or to run. A shift that is running goes on from its value, velocity and acceleration.
  /// @return why no profile can be planned
  PlanResult begin(const ShiftRequest& request, double period) noexcept;

  /// Leaves the shift where it is.
  void halt() noexcept;

  /// Waits no more; a shift that moves still comes to rest.
  void cancel() noexcept { phase_ = Phase::resting; }

  /// One tick.
  Event advance(const LeadingStep& step) noexcept {
    const bool led = phase_ == Phase::running && !settling_ && request_.rule != ShiftRule::dynamics;
    return led ? follow_leading(step) : wait_or_follow_time(step);
  }

  Phase phase() const noexcept { return phase_; }
  /// Whether it is coming to rest, also without a job.
  bool settling() const noexcept { return settling_; }
  /// Whether there is any shift, or one is coming.
  bool in_use() const noexcept { return in_use_; }

  const DoubleDouble& value() const noexcept { return value_; }  ///< [u]
  bool moves() const noexcept { return velocity_ != 0.0 || acceleration_ != 0.0; }
  double velocity() const noexcept { return velocity_; }          ///< [u/s]
  double acceleration() const noexcept { return acceleration_; }  ///< [u/s²]

 private:
  bool may_start(const LeadingStep& step) noexcept;
  bool can_lead_on(const LeadingStep& step) const noexcept;
  SyncOffset remainder_at_start(const LeadingStep& step) const noexcept;
  bool start_over_distance(const LeadingStep& step) noexcept;
  Event wait_or_follow_time(const LeadingStep& step) noexcept;
  Event follow_leading(const LeadingStep& step) noexcept;
  Event follow_time() noexcept;
  bool follow_profile() noexcept;
  Event reverse() noexcept;
  Event arrive() noexcept;

  Phase phase_ = Phase::resting;
  bool in_use_ = false;
  bool settling_ = false;  // a shift that was moving comes to rest while the next one waits
  DoubleDouble value_;
  double velocity_ = 0.0;
  double acceleration_ = 0.0;

  ShiftRequest request_;
  double to_start_ = 0.0;  // leading distance from the last tick to the start [u]
  double heading_ = 0.0;   // of the leading value while running: 1, -1; 0: it has not moved yet
  double covered_ = 0.0;   // leading distance since the start [u]
  Remainder remainder_;    // target - value over the leading distance, negative
  bool planned_ = false;
  Profile profile_;  // profile 0, and coming to rest: value from `base_`
  DoubleDouble base_;
  double period_ = 0.001;
  std::int64_t ticks_ = 0;
};

inline Shift::Event Shift::follow_leading(const LeadingStep& step) noexcept {
  const double distance = step.distance();
  if (!planned_ && !start_over_distance(step)) return Event::none;
  const double progress = heading_ * distance;
  if (progress < 0.0) return reverse();
  covered_ += progress;
  if (remainder_.complete(covered_)) return arrive();
  const SyncOffset left = remainder_.value(covered_);
  value_ = request_.target + left.position;
  velocity_ = left.velocity(heading_ * step.now.velocity);
  acceleration_ = left.acceleration(heading_ * step.now.velocity, heading_ * step.now.acceleration);
  return Event::none;
}

}  // namespace lockstep
