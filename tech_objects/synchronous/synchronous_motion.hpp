/// Motion led by another axis: the chain from leading value to following value, and the ways into it.
///
///   leading value → + additive → + phase shift → function (gear | cam) → + offset → + superimposed →
///   setpoint
///
/// @source S7-1500T synchronous operation V7, 4.5, 6.1, 6.2
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/cam/motion.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/objects/leading_object.hpp"
#include "tech_objects/profile/profile.hpp"
#include "tech_objects/profile/velocity_tracking.hpp"
#include "tech_objects/synchronous/gear_function.hpp"
#include "tech_objects/synchronous/shift.hpp"
#include "tech_objects/synchronous/sync_profile.hpp"

namespace lockstep {

/// What MC_LeadingValueAdditive adds to the leading value of one following axis, now and one tick ago.
struct AdditiveLeadingValue {
  double position = 0.0;      ///< [u] of the leading axis
  double velocity = 0.0;      ///< [u/s]
  double acceleration = 0.0;  ///< [u/s²]
};
struct AdditiveLeadingValues {
  bool in_use = false;  ///< whether either is other than zero
  AdditiveLeadingValue now;
  AdditiveLeadingValue last;
};

/// One synchronous job: what it follows, how it synchronizes and the function that then holds. Thread: the
/// cycle.
class SynchronousMotion {
 public:
  enum class Way : std::uint8_t {
    none,
    velocity,  ///< MC_GearIn, MC_GearInVelocity: brings velocity and acceleration to those of the function
    distance,  ///< MC_GearInPos profiles 1 and 3, MC_CamIn 1, 3, 4, 6: a function of the leading value over a
               ///< distance
    out,       ///< MC_GearOut, MC_CamOut profile 1: a function of the leading value over a distance, to rest
    time,      ///< MC_GearInPos, MC_CamIn profile 0: planned in time, then a function of the leading value
  };

  /// What becomes of a waiting job in this tick.
  enum class Start : std::uint8_t { not_yet, synchronizing, synchronous, rejected };

  /// @param tolerance leading distance by which the leading value may reverse [u]
  /// @param additive of the axis; outlives this
  void configure(const Modulo& following, double period, double tolerance,
                 const AdditiveLeadingValues& additive) noexcept;

  /// MC_GearIn, MC_GearInVelocity: from the setpoint at hand, at once.
  void begin_gear_in(const LeadingValue& leading, const Job& job, const Dynamics& dynamics) noexcept;

  /// MC_GearInPos, MC_CamIn: prepares to wait for the start condition.
  /// @return the error with which the job has to be rejected, or none
  ErrorId begin_waiting(const LeadingValue& leading, const Job& job, const Dynamics& dynamics,
                        const Setpoint& own) noexcept;
  /// Looks whether the way between the last two leading values holds the start; `own` is the setpoint of the
  /// last tick, `active` the synchronous motion that leads the axis until then; nullptr: none.
  Start watch(const Setpoint& own, const SynchronousMotion* active) noexcept;
  /// Why `watch` has rejected the job.
  ErrorId rejection() const noexcept { return rejection_; }

  /// Takes up the leading value of this tick; before all that advances.
  void look_at_leading() noexcept;

  /// The setpoint of this tick from the leading value of this tick.
  void advance(Setpoint& setpoint) noexcept;

  /// MC_GearInVelocity: another ratio, which counts once the axis is synchronous.
  void change_ratio(DINT numerator, DINT denominator) noexcept;

  // ---- Shifts of a synchronous axis

  /// Leading value offset by MC_Phasing…, following value offset by MC_Offset….
  Shift& phase_shift() noexcept {
    shifted_ = true;
    return phase_;
  }
  Shift& following_offset() noexcept {
    shifted_ = true;
    return offset_;
  }
  const Shift& phase_shift() const noexcept { return phase_; }
  const Shift& following_offset() const noexcept { return offset_; }
  /// False as long as neither has been in effect, or asked for, since the coupling.
  bool shifted() const noexcept { return shifted_; }
  /// Advances both by the leading value of this tick; before `advance`.
  Shift::Event advance_phase_shift() noexcept { return phase_.advance(leading_step()); }
  Shift::Event advance_following_offset() noexcept { return offset_.advance(leading_step()); }

  // ---- Cams

  /// The cam that is followed, or waited for; nullptr: none.
  Cam* cam() const noexcept { return cam_; }
  /// After `advance`: whether the leading value has reached an end of the cam since it was cleared.
  bool at_cam_end() const noexcept { return cam_ != nullptr && follow_.ended() != CamEnd::none; }
  void clear_cam_end() noexcept { follow_.clear_end(); }
  bool passed_once() const noexcept { return cam_use_.mode == CamMode::once; }
  /// Whether the axis comes to rest at the end that has been reached.
  bool rests_at_cam_end() const noexcept;
  /// Adds to the offset with which a cam begins [u].
  void raise_cam(DoubleDouble by) noexcept {
    begin_with_offset(offset_.value() + by);
    slave_offset_ = offset_.value().hi;
  }
  /// A cam that takes over at the end of another: phase shift and offset that still move there come to rest
  /// on this one.
  void settle_shifts(const SynchronousMotion& ended, const Dynamics& dynamics) noexcept;
  /// Offsets in effect when the job became active.
  double master_offset() const noexcept { return master_offset_; }
  double slave_offset() const noexcept { return slave_offset_; }

  // ---- Desynchronizing by MC_GearOut and MC_CamOut

  /// Whether the axis comes past the place from which it would come to rest at the given position between the
  /// last setpoint and the candidate for this tick.
  /// @param dynamics of profile 0
  bool meets_sync_out(const Job& job, const Setpoint& last, const Setpoint& candidate,
                      const Dynamics& dynamics) noexcept;
  /// After `meets_sync_out`: way to the stop position [u], and that position.
  double sync_out_way() const noexcept { return out_way_; }
  AxisPosition sync_out_position() const noexcept { return out_position_; }
  /// Profile 1: from here on over the leading distance.
  void begin_sync_out(const Setpoint& last) noexcept;
  bool desynchronized() const noexcept { return way_ == Way::out && desynchronized_; }

  /// Forgets the coupling.
  void end() noexcept {
    leading_ = nullptr;
    cam_ = nullptr;
  }

  bool synchronous() const noexcept { return synchronous_; }
  /// Whether the leading value has reversed while synchronizing by more than the tolerance.
  bool reversed() const noexcept { return reversed_; }
  LeadingObject* leading_object() const noexcept;
  /// Whether the leading value is measured: by the coupling, or as the leading axis is switched off.
  bool follows_actual_value() const noexcept;

  /// The chain's values of this tick, for the data block.
  const Setpoint& effective_leading_value() const noexcept { return leading_now_; }
  const Setpoint& function_value() const noexcept { return function_; }
  /// Position that the function and the following value offset ask for.
  AxisPosition following_position() const noexcept {
    return shifted_ && offset_.in_use() ? followed_ : function_.position;
  }
  /// Effective leading position and phase shift [u].
  double function_leading_position() const noexcept {
    return shifted_ && phase_.in_use()
               ? advanced(leading_now_.position, phase_.value(), leading_modulo_).value
               : leading_now_.position.value;
  }

  /// Shifts the following side of the function without motion, for homing [u].
  void shift_following(double by) noexcept;
  /// Counts the turns of the following side anew, without motion.
  void turn_following(std::int64_t turns) noexcept;

 private:
  /// A phase shift behind the gear; most of the time it is that of the tick before.
  class GearedPhase {
   public:
    DoubleDouble of(DoubleDouble phase, DoubleDouble ratio) noexcept {
      if (known_ && phase == phase_) return product_;
      known_ = true;
      phase_ = phase;
      return product_ = ratio * phase;
    }
    /// The gear has changed.
    void forget() noexcept { known_ = false; }

   private:
    bool known_ = false;
    DoubleDouble phase_;
    DoubleDouble product_;
  };

  void couple(const LeadingValue& leading, const Job& job, const Dynamics& dynamics) noexcept;
  void evaluate_function(Setpoint& result) noexcept;
  void evaluate_cam(Setpoint& result) noexcept;
  void look_at_led() noexcept;
  void turn_leading(std::int64_t turns) noexcept;
  bool sees_return() const noexcept;
  void add_additive(Setpoint& leading, const AdditiveLeadingValue& additive) const noexcept;
  void add_offset(Setpoint& setpoint) noexcept;
  void place_gear(AxisPosition leading, AxisPosition following) noexcept;
  void begin_with_offset(DoubleDouble value) noexcept {
    offset_.start_at(value);
    shifted_ = shifted_ || offset_.in_use();
  }
  double stopping_way(const Setpoint& from, int heading, const Dynamics& dynamics) const noexcept;
  double way_over(double distance, AxisPosition leading, int heading) const noexcept;
  void advance_in_velocity(Setpoint& setpoint) noexcept;
  static double without_turning_back(double curvature, double slope, double distance) noexcept;
  static double without_passing(double curvature, double slope, double way, double distance) noexcept;
  void advance_out(Setpoint& setpoint) noexcept;
  LeadingStep leading_step() const noexcept { return {leading_last_, leading_now_, leading_modulo_}; }
  void watch_reversal() noexcept;
  void advance_velocity(Setpoint& setpoint) noexcept;
  void advance_along_profile(Setpoint& setpoint) noexcept;
  SyncOffset offset(double way) const noexcept;
  double covered() const noexcept;

  double way_to(double place) const noexcept;
  void anchor(double way_to_sync_position, AxisPosition following) noexcept;
  bool standing_on_sync_positions(const Setpoint& own) const noexcept;
  Start watch_distance(const Setpoint& own) noexcept;
  Start watch_time(const Setpoint& own) noexcept;
  Start reject(ErrorId error) noexcept;

  // synchronous_camming.cpp
  ErrorId begin_cam(const Job& job) noexcept;
  Start watch_cam(const Setpoint& own, const SynchronousMotion* active) noexcept;
  bool stands_on_cam(const Setpoint& own) noexcept;
  Start watch_cam_distance(const Setpoint& own) noexcept;
  Start watch_cam_end(const SynchronousMotion* active) noexcept;
  Start set_on_cam(const Setpoint& own) noexcept;
  bool place_cam_here(AxisPosition leading) noexcept;
  void place_cam(AxisPosition leading) noexcept;
  SyncPlan plan_along_tangent(const SyncStart& start) noexcept;
  void aim_at_cam(double way) noexcept;
  bool stands_at(const Setpoint& own, AxisPosition joint) const noexcept;
  void take_joint(const CamPlace& place, std::int64_t turns) noexcept;
  double cam_start() const noexcept;
  Setpoint tangent(double way) const noexcept;
  AxisPosition leading_at(double way) const noexcept;
  void set_out_position(const Setpoint& last, double target) noexcept;
  bool shoots_beyond(const SyncOffset& start, double distance) const noexcept;
  Start begin_profile(Way way) noexcept;
  void watch_acceleration() noexcept;
  int forced_direction() const noexcept;
  bool on_slave_sync_position(double here) const noexcept;
  double following_way(const Setpoint& own, double synchronous_velocity) const noexcept;
  bool plan_time(const Setpoint& own, const Setpoint& leading, double way, double ahead,
                 Profile& profile) const noexcept;

  // What every cycle touches, in lines of the cache.
  alignas(kCacheLine) const LeadingValue* leading_ = nullptr;
  Cam* cam_ = nullptr;  // nullptr: gear_ is the function
  const AdditiveLeadingValues* additive_ = nullptr;
  Way way_ = Way::none;
  bool synchronous_ = false;
  bool reversed_ = false;
  bool velocity_only_ = false;  // MC_GearInVelocity
  bool shifted_ = false;        // phase_ and offset_ are of account
  Setpoint leading_now_;
  Setpoint leading_last_;
  Setpoint function_;
  GearFunction gear_;
  Shift phase_;
  Shift offset_;

  GearedPhase geared_phase_;
  AxisPosition followed_;  // function and offset
  Modulo leading_modulo_;
  Modulo following_;
  double period_ = 0.001;   // [s]
  double tolerance_ = 0.0;  // [u] of the leading axis

  // Synchronizing.
  int direction_ = 0;           // of the leading value while synchronizing: 1, -1; 0: it has not moved yet
  double progress_ = 0.0;       // leading distance since the start, in that direction [u]
  double furthest_ = 0.0;       // greatest progress [u]
  double profile_way_ = 0.0;    // leading distance of the profile [u]
  AxisPosition leading_start_;  // where the profile begins
  double time_velocity_ = 1.0;  // leading velocity for which profile 0 was planned [u/s] > 0
  double watched_acceleration_ = 0.0;  // of the leading value, by its velocity while a job waits [u/s²]
  SyncProfile distance_profile_;
  Profile time_profile_;

  // What is seen of a leading axis that has left position control.
  std::uint32_t uncontrolled_seen_ = 0;  // which time, seen by this coupling; 0: none
  std::int64_t zero_turns_ = 0;          // turn of its zero then

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

  // Desynchronizing.
  double out_way_ = 0.0;  // to the stop position [u], signed
  AxisPosition out_position_;
  double out_distance_ = 0.0;  // leading distance [u]
  bool desynchronized_ = false;
  Remainder out_remainder_;

  // Cams.
  CamFollowing follow_;
  CamUse cam_use_;
  double cam_sync_way_ = 0.0;   // MasterSyncPosition: from the start of the cam [u] of the leading axis
  double master_offset_ = 0.0;  // [u] of the leading axis
  double slave_offset_ = 0.0;   // [u]
  AxisPosition joint_;          // where profile and cam meet, with the offset
  double curvature_ = 0.0;      // of the cam there [u / leading u²]; the slope is ratio_
};

}  // namespace lockstep
