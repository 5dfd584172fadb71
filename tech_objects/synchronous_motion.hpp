/// Motion led by another axis: the chain from leading value to following value, and the ways into it.
///
///   leading value → + additive → + phase shift → function (gear) → + offset → + superimposed → setpoint
///
/// @source S7-1500T synchronous operation V7, 4.5, 6.1, 6.2
#pragma once

#include "tech_objects/alarms.hpp"
#include "tech_objects/gear_function.hpp"
#include "tech_objects/job.hpp"
#include "tech_objects/profile.hpp"
#include "tech_objects/setpoint.hpp"
#include "tech_objects/sync_profile.hpp"
#include "tech_objects/velocity_tracking.hpp"

namespace lockstep {

struct LeadingValue;

/// One synchronous job: what it follows, how it synchronizes and the function that then holds. Thread: the
/// cycle.
class SynchronousMotion {
 public:
  enum class Way : std::uint8_t {
    none,
    velocity,  ///< MC_GearIn: brings velocity and acceleration to those of the function
    distance,  ///< MC_GearInPos profiles 1 and 3: a function of the leading value over a distance
    time,      ///< MC_GearInPos profile 0: planned in time, then a function of the leading value
  };

  /// What becomes of a waiting job in this tick.
  enum class Start : std::uint8_t { not_yet, synchronizing, synchronous, rejected };

  /// @param tolerance leading distance by which the leading value may reverse [u]
  void configure(const Modulo& following, double period, double tolerance) noexcept;

  /// MC_GearIn: from the setpoint at hand, at once.
  void begin_gear_in(const LeadingValue& leading, const Job& job, const Dynamics& dynamics) noexcept;

  /// MC_GearInPos: prepares to wait for the start condition.
  /// @return the error with which the job has to be rejected, or none
  ErrorId begin_waiting(const LeadingValue& leading, const Job& job, const Dynamics& dynamics,
                        const Setpoint& own) noexcept;
  /// Looks whether the way between the last two leading values holds the start; `own` is the setpoint of the
  /// last tick.
  Start watch(const Setpoint& own) noexcept;
  /// Why `watch` has rejected the job.
  ErrorId rejection() const noexcept { return rejection_; }

  /// The setpoint of this tick from the leading value of this tick.
  void advance(Setpoint& setpoint) noexcept;

  /// Forgets the coupling.
  void end() noexcept { leading_ = nullptr; }

  bool synchronous() const noexcept { return synchronous_; }
  /// Whether the leading value has reversed while synchronizing by more than the tolerance.
  bool reversed() const noexcept { return reversed_; }
  Axis* leading_axis() const noexcept;

  /// The chain's values of this tick, for the data block.
  const Setpoint& effective_leading_value() const noexcept { return leading_now_; }
  const Setpoint& function_value() const noexcept { return function_; }

  /// Shifts the following side of the function without motion, for homing [u].
  void shift_following(double by) noexcept;

 private:
  void couple(const LeadingValue& leading, const Job& job, const Dynamics& dynamics) noexcept;
  void look_at_leading() noexcept;
  void evaluate_function(Setpoint& result) noexcept;
  void watch_reversal() noexcept;
  void advance_velocity(Setpoint& setpoint) noexcept;
  void advance_along_profile(Setpoint& setpoint) noexcept;
  SyncOffset offset(double way) const noexcept;

  double way_to(double place) const noexcept;
  void anchor(double way_to_sync_position, AxisPosition following) noexcept;
  bool standing_on_sync_positions(const Setpoint& own) const noexcept;
  Start watch_distance(const Setpoint& own) noexcept;
  Start watch_time(const Setpoint& own) noexcept;
  Start reject(ErrorId error) noexcept;
  Start begin_profile(Way way) noexcept;
  double following_way(double here) const noexcept;
  bool plan_time(const Setpoint& own, const Setpoint& leading, double way, double ahead,
                 Profile& profile) const noexcept;

  const LeadingValue* leading_ = nullptr;
  Way way_ = Way::none;
  bool synchronous_ = false;
  bool reversed_ = false;
  Modulo leading_modulo_;
  Modulo following_;
  double period_ = 0.001;   // [s]
  double tolerance_ = 0.0;  // [u] of the leading axis

  Setpoint leading_now_;
  Setpoint leading_last_;
  Setpoint function_;
  GearFunction gear_;

  // Synchronizing.
  int direction_ = 0;           // of the leading value while synchronizing: 1, -1; 0: it has not moved yet
  double progress_ = 0.0;       // leading distance since the start, in that direction [u]
  double furthest_ = 0.0;       // greatest progress [u]
  double profile_way_ = 0.0;    // leading distance of the profile [u]
  AxisPosition leading_start_;  // where the profile begins
  double time_velocity_ = 1.0;  // leading velocity for which profile 0 was planned [u/s] > 0
  SyncProfile distance_profile_;
  Profile time_profile_;

  // What the job asks for.
  DINT numerator_ = 1;
  DINT denominator_ = 1;
  DINT profile_reference_ = 0;
  DINT sync_direction_ = 3;
  double ratio_ = 1.0;
  double master_sync_position_ = 0.0;  // on the ring of the leading axis [u]
  double slave_sync_position_ = 0.0;   // on the ring of the following axis [u]
  double start_distance_ = 0.0;        // [u] of the leading axis
  Dynamics dynamics_;
  ErrorId rejection_ = ErrorId::none;
};

}  // namespace lockstep
