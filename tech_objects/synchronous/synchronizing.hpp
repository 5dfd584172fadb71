/// The way into a synchronous function: waiting for its start, and what leads the axis until it is there.
/// @source S7-1500T synchronous operation V7, 6.2.2, 6.2.3
#pragma once

#include "tech_objects/profile/profile.hpp"
#include "tech_objects/synchronous/chain.hpp"
#include "tech_objects/synchronous/request.hpp"
#include "tech_objects/synchronous/sync_profile.hpp"

namespace lockstep {

/// Thread: the cycle.
class Synchronizing {
 public:
  /// What becomes of a waiting request in this tick.
  enum class Start : std::uint8_t { not_yet, synchronizing, synchronous, rejected };

  /// A new request; nothing leads the axis yet.
  void couple(const CouplingRequest& request, double ratio) noexcept;
  /// The request is to bring velocity and acceleration to those of the function, at once.
  void begin_tracking() noexcept { method_ = Method::velocity; }
  /// The request is to wait for its start: takes the synchronous positions over.
  SyncRefusal begin_waiting(const CouplingRequest& request, const Chain& chain, const Setpoint& own) noexcept;

  /// Looks whether the distance between the last two leading values holds the start; `own` is the setpoint of
  /// the last tick, `active` what leads the axis until then; nullptr: no synchronous motion.
  Start watch(const Chain& chain, const Setpoint& own, const ChainView* active) noexcept;
  /// Why `watch` has rejected the request.
  SyncRefusal refusal() const noexcept { return refusal_; }

  /// Each tick on the way in, before what advances.
  void watch_reversal(const LeadingStep& leading, double tolerance) noexcept {
    progress_.watch(leading, tolerance, method_ == Method::velocity);
  }
  bool reversed() const noexcept { return progress_.reversed(); }
  bool tracks_velocity() const noexcept { return method_ == Method::velocity; }
  /// The setpoint of this tick; true once it is that of the function.
  bool track(const Chain& chain, Setpoint& setpoint) noexcept;
  /// The function of this tick plus what the axis is ahead of it; false, and no setpoint, once that is over.
  bool follow_profile(const Chain& chain, Setpoint& setpoint) const noexcept;

  /// The axis has another name for every position [u]; the leading axis counts other turns.
  void shift_following(double by, const Modulo& following) noexcept {
    joint_ = advanced(joint_, by, following);
  }
  void turn_leading(std::int64_t turns) noexcept { progress_.turn_leading(turns); }

 private:
  enum class Method : std::uint8_t {
    none,
    velocity,  ///< towards velocity and acceleration of the function
    distance,  ///< a function of the leading value over a distance
    time       ///< planned in time, then a function of the leading value
  };

  /// Over how many ticks the change of the leading velocity is watched.
  static constexpr double kWatchedTicks = 16.0;

  // synchronizing.cpp: what gear and cam share, and the gear
  Start reject(SyncRefusal why) noexcept;
  Start begin_profile(Method method, AxisPosition start) noexcept;
  void watch_acceleration(const Chain& chain) noexcept;
  bool standing_on_sync_positions(const Chain& chain, const Setpoint& own) const noexcept;
  bool on_following_sync_position(double here, const Modulo& following) const noexcept;
  double distance_to(const Chain& chain, double place) const noexcept;
  AxisPosition leading_at(const Chain& chain, double distance) const noexcept;
  void anchor(const Chain& chain, double distance, AxisPosition following) noexcept;
  Start watch_gear(const Chain& chain, const Setpoint& own) noexcept;
  Start watch_distance(const Chain& chain, const Setpoint& own) noexcept;
  bool shoots_beyond(const SyncOffset& start, double distance, const Modulo& following) const noexcept;
  SyncOffset ahead(double distance) const noexcept;

  // synchronizing_in_time.cpp
  Start watch_time(const Chain& chain, const Setpoint& own) noexcept;
  bool carries_too_far(const Chain& chain, double distance) const noexcept;
  int forced_direction(const Modulo& following) const noexcept;
  double following_distance(const Chain& chain, const Setpoint& own,
                            double synchronous_velocity) const noexcept;
  bool plan_time(const Chain& chain, const Setpoint& own, const Setpoint& leading, double distance,
                 double ahead, Profile& profile) const noexcept;

  // synchronizing_cam.cpp
  Start watch_cam(const Chain& chain, const Setpoint& own, const ChainView* active) noexcept;
  bool stands_on_cam(const Chain& chain, const Setpoint& own) noexcept;
  void take_joint(const Chain& chain, const CamFollowingValue& place, std::int64_t turns) noexcept;
  Start watch_cam_distance(const Chain& chain, const Setpoint& own) noexcept;
  SyncRefusal place_for_distance(const Chain& chain, double distance, AxisPosition& end) noexcept;
  SyncPlan plan_along_tangent(const Chain& chain, const SyncStart& start) noexcept;
  void aim_at_cam(const Chain& chain, double distance) noexcept;
  bool stands_at(const Setpoint& own, AxisPosition joint, const Modulo& following) const noexcept;
  Setpoint tangent(const Chain& chain, double distance) const noexcept;
  Start set_on_cam(const Chain& chain, const Setpoint& own) noexcept;
  Start watch_cam_end(const Chain& chain, const ChainView* active) noexcept;

  // What every tick of the way in touches.
  Method method_ = Method::none;
  LeadingProgress progress_;
  double distance_ = 0.0;       // leading distance of the profile [u]
  double time_velocity_ = 1.0;  // leading velocity for which a profile in time was planned [u/s] > 0
  SyncProfile distance_profile_;
  Profile time_profile_;
  AxisPosition joint_;      // where profile and cam meet, with the offset
  double slope_ = 1.0;      // of the function there [u / leading u]
  double curvature_ = 0.0;  // of a cam there [u / leading u²]

  // What is asked for.
  SyncStartRule rule_{};
  SyncDirection direction_ = SyncDirection::kShortestPath;
  double leading_sync_position_ = 0.0;    // on the ring of the leading axis [u]
  double following_sync_position_ = 0.0;  // on the ring of the following axis [u]
  double start_distance_ = 0.0;           // [u] of the leading axis
  Dynamics dynamics_;
  double watched_acceleration_ = 0.0;  // of the leading value, by its velocity while the request waits [u/s²]
  SyncRefusal refusal_ = SyncRefusal::none;
};

}  // namespace lockstep
