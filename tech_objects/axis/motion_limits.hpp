/// The dynamic limits of an axis: what a motion may use of them, and whether they have changed since it was
/// planned.
/// @source S7-1500T synchronous operation V7, 13.1.16, 13.1.17
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tech_objects/alarms/detail.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/jobs/job.hpp"

namespace lockstep {

/// Which of the values that a job asks for are beyond the limits, and are cut to them with a warning.
struct ExceededLimits {
  bool velocity = false;
  bool acceleration = false;  // or deceleration
  bool jerk = false;

  bool any() const noexcept { return velocity || acceleration || jerk; }
};

/// The alarm for a limit of zero, with the limits and what the motion would have of them.
struct ZeroLimit {
  int alarm = 0;  ///< number; 0: no limit is zero
  AlarmDetail detail{};
};

/// Reads DynamicLimits, DynamicDefaults and Override of the data block, as they are at the time of the call;
/// it writes nothing there. Thread: the cycle.
class MotionLimits {
 public:
  explicit MotionLimits(const AxisData& data) noexcept : data_(data) {}

  // ---- What is planned

  /// The motion at hand is planned with the limits as they are now.
  void remember() noexcept {
    const TO_Struct_DynamicLimits& limits = data_.DynamicLimits;
    planned_ = {data_.Override.Velocity, limits.Velocity, limits.MaxAcceleration, limits.MaxDeceleration,
                limits.MaxJerk};
  }
  /// Whatever the limits are, the motion at hand has to be planned anew.
  void forget() noexcept { planned_.override_velocity = std::numeric_limits<double>::quiet_NaN(); }
  bool forgotten() const noexcept { return std::isnan(planned_.override_velocity); }
  /// Whether they are others than those that the motion at hand has been planned with.
  bool changed() const noexcept {
    return data_.Override.Velocity != planned_.override_velocity || (!same_limits_in_bits() && differ());
  }

  // ---- Dynamic values

  /// Velocity limit in effect [u/s].
  double velocity() const noexcept {
    return std::min(data_.DynamicLimits.MaxVelocity, data_.DynamicLimits.Velocity);
  }
  double override_velocity() const noexcept { return data_.Override.Velocity; }  ///< [%]
  /// Of a job whose override is a matter of its own [u/s].
  double velocity_or_default(const Job& job) const noexcept {
    return job.velocity < 0.0 ? data_.DynamicDefaults.Velocity : job.velocity;
  }
  /// The highest dynamic values, with which an axis also stops if no limit is configured.
  Dynamics maximum() const noexcept;
  /// Those of the emergency ramp.
  Dynamics emergency() const noexcept;

  /// Negative dynamic values of a job stand for the defaults as they are when the job is handed over; changed
  /// later, those count for the next one. The inputs of a jogging block are read in every call, and so are
  /// its defaults.
  void take_defaults(Job& job) const noexcept;
  /// Dynamic values of a job: defaults for negative ones, cut to the limits. A MaxJerk of 0.0 is an alarm
  /// where it would count (`zero_limit`); it takes no job its jerk.
  Dynamics effective(const Job& job) const noexcept;
  /// Dynamic values of a job as it asks for them, with defaults for negative ones, not cut.
  Dynamics asked(const Job& job) const noexcept;
  const TO_Struct_DynamicLimits& configured() const noexcept { return data_.DynamicLimits; }
  /// Where the job asks for more.
  ExceededLimits exceeded(const Job& job) const noexcept;
  /// Whether a limit is zero, which no motion can keep. That of the jerk counts for a motion that limits its
  /// jerk.
  ZeroLimit zero_limit(const Dynamics& dynamics) const noexcept;

  // ---- Up to the velocity limit

  /// Velocity that is left, in the direction of the acceleration of a state, up to the limit [u/s] ≥ 0.
  /// @param beside velocity in that direction that does not count to `from` [u/s]
  double margin(const Setpoint& from, double beside = 0.0) const noexcept {
    const double direction = from.acceleration < 0.0 ? -1.0 : 1.0;
    return std::max(velocity() - (direction * from.velocity + beside), 0.0);
  }
  /// A synchronous motion, or one without jerk limit, may leave an acceleration that not even MaxJerk can run
  /// down within the margin to the velocity limit: what is too much is dropped [u/s²].
  double tolerable_acceleration(double acceleration, double margin) const noexcept {
    const double maximum = std::sqrt(2.0 * data_.DynamicLimits.MaxJerk * margin);
    return std::abs(acceleration) > maximum ? std::copysign(maximum, acceleration) : acceleration;
  }
  /// The velocity limit counts more than the jerk that a job asks for: with too low a one, the velocity would
  /// pass the limit while a present acceleration is run down.
  void keep_below(Dynamics& dynamics, double acceleration, double margin) const noexcept;
  /// With a MaxJerk that has been lowered the velocity could pass its limit while a present acceleration is
  /// run down: of the jerk before as much stays as that needs.
  static double sufficient_jerk(double jerk, double before, double acceleration, double margin) noexcept;

 private:
  double wanted_velocity(const Job& job) const noexcept;
  [[gnu::noinline]] bool differ() const noexcept {
    const TO_Struct_DynamicLimits& now = data_.DynamicLimits;
    return now.Velocity != planned_.velocity || now.MaxAcceleration != planned_.acceleration ||
           now.MaxDeceleration != planned_.deceleration || now.MaxJerk != planned_.jerk;
  }
  /// As they are in most cycles: told by one branch, where comparing numbers takes eight.
  bool same_limits_in_bits() const noexcept {
    const TO_Struct_DynamicLimits& now = data_.DynamicLimits;
    const auto differing = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b);
    };
    return (differing(now.Velocity, planned_.velocity) |
            differing(now.MaxAcceleration, planned_.acceleration) |
            differing(now.MaxDeceleration, planned_.deceleration) | differing(now.MaxJerk, planned_.jerk)) ==
           0;
  }

  /// MaxVelocity changes with a restart only.
  struct Planned {
    double override_velocity = 100.0;  // [%]
    double velocity = 0.0;             // [u/s]
    double acceleration = 0.0;         // [u/s²]
    double deceleration = 0.0;         // [u/s²]
    double jerk = 0.0;                 // [u/s³]
  };
  const AxisData& data_;
  Planned planned_;
};

}  // namespace lockstep
