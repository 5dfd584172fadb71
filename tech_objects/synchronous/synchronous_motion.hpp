/// Motion led by another axis: an order of calls over the parts of the chain, each the owner of its state.
///
///   LeadingCoupling         leading value → + additive →
///   SynchronousFunction     + phase shift → function (gear | cam) →
///   Shifts                  + offset → setpoint
///   Synchronizing           the way in
///   Desynchronizing         the way out
///
/// @source S7-1500T synchronous operation V7, 4.5, 6.1, 6.2
#pragma once

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/synchronous/request.hpp"
#include "tech_objects/synchronous/synchronous_parts.hpp"

namespace lockstep {

/// One coupling: what it follows, how it synchronizes and the function that then holds. Thread: the cycle.
class SynchronousMotion : private SynchronousParts {
 public:
  using Start = Synchronizing::Start;

  /// @param tolerance leading distance by which the leading value may reverse [u]
  /// @param additive of the axis; outlives this
  void configure(const Modulo& following, double period, double tolerance,
                 const AdditiveLeadingValues& additive) noexcept;

  /// From the setpoint at hand, at once, towards the velocity of the function.
  void begin_at_velocity(const CouplingRequest& request) noexcept;
  /// Prepares to wait for the start at positions of both axes. @return why that cannot be
  SyncRefusal begin_waiting(const CouplingRequest& request, const Setpoint& own) noexcept;
  /// Looks whether the distance between the last two leading values holds the start; `own` is the setpoint of
  /// the last tick, `active` the synchronous motion that leads the axis until then; nullptr: none.
  Start watch(const Setpoint& own, const SynchronousMotion* active) noexcept;
  /// Why `watch` has rejected the request.
  SyncRefusal refusal() const noexcept { return synchronizing_.refusal(); }
  /// Forgets the coupling.
  void end() noexcept;

  // ---- Every tick

  /// Takes up the leading value of this tick; before all that advances.
  void look_at_leading() noexcept {
    if (!leading_.look_at_plain(!synchronous_ || shifted_)) look_closely();
  }
  /// The setpoint of this tick from the leading value of this tick.
  void advance(Setpoint& setpoint) noexcept {
    if (!synchronous_ || leading_.velocity_only())
      advance_otherwise(setpoint);
    else if (shifted_)
      advance_shifted(setpoint);
    else
      function_.evaluate(leading_.now(), setpoint);
  }
  /// Another ratio, which counts once an axis that follows the velocity alone is synchronous.
  void change_ratio(const GearRatio& ratio) noexcept;

  bool synchronous() const noexcept { return synchronous_; }
  /// Whether the leading value has reversed on the way in or out by more than the tolerance.
  bool reversed() const noexcept {
    return leaving_ ? desynchronizing_.reversed() : !synchronous_ && synchronizing_.reversed();
  }
  bool follows_actual_value() const noexcept { return leading_.follows_actual_value(); }

  const Setpoint& effective_leading_value() const noexcept { return leading_.now(); }
  const Setpoint& function_value() const noexcept { return function_.value(); }
  /// Position that the function and the following value offset ask for.
  AxisPosition following_position() const noexcept {
    return shifted_ && shifts_.offset().in_use() ? shifts_.followed() : function_.value().position;
  }
  /// Effective leading position and phase shift [u].
  double function_leading_position() const noexcept {
    return phase_in_use() != nullptr
               ? advanced(leading_.now().position, shifts_.phase().value(), leading_.modulo()).value
               : leading_.now().position.value;
  }

  // ---- Shifts of a synchronous axis

  /// Leading value offset (phasing), following value offset.
  Shift& phase_shift() noexcept {
    shifted_ = true;
    return shifts_.phase();
  }
  Shift& following_offset() noexcept {
    shifted_ = true;
    return shifts_.offset();
  }
  const Shift& phase_shift() const noexcept { return shifts_.phase(); }
  const Shift& following_offset() const noexcept { return shifts_.offset(); }
  /// False as long as neither has been in effect, or asked for, since the coupling.
  bool shifted() const noexcept { return shifted_; }
  /// Advances both by the leading value of this tick; before `advance`.
  Shift::Event advance_phase_shift() noexcept { return shifts_.phase().advance(leading_.step()); }
  Shift::Event advance_following_offset() noexcept { return shifts_.offset().advance(leading_.step()); }

  // ---- Cams

  /// After `advance`: whether the leading value has reached an end of the cam since it was cleared.
  bool at_cam_end() const noexcept { return function_.is_cam() && function_.cam().ended() != CamEnd::none; }
  void clear_cam_end() noexcept { function_.cam().clear_end(); }
  bool passed_once() const noexcept { return function_.cam().passed_once(); }
  /// Whether the axis comes to rest at the end that has been reached.
  bool rests_at_cam_end() const noexcept;
  /// Adds to the offset with which a cam begins [u].
  void raise_cam(DoubleDouble by) noexcept;
  /// A cam that takes over at the end of another: phase shift and offset that still move there come to rest
  /// on this one.
  void settle_shifts(const SynchronousMotion& ended, const Dynamics& dynamics) noexcept;
  /// Offsets in effect when the coupling became active [leading u], [u].
  double leading_offset() const noexcept { return function_.cam().leading_offset(); }
  double following_offset_at_start() const noexcept { return function_.cam().following_offset(); }

  // ---- Out of it, to rest at a position

  /// Whether the axis comes past the place from which it would come to rest at the position between the last
  /// setpoint and the candidate for this tick. @param dynamics where that is planned in time
  bool meets_start_of_leaving(const LeavingRequest& request, const Setpoint& last, const Setpoint& candidate,
                              const Dynamics& dynamics) noexcept;
  /// What it has met: distance to the stop position [u], and that position.
  const Desynchronizing& leaving() const noexcept { return desynchronizing_; }
  /// Over the leading distance, from here on.
  void begin_leaving(const Setpoint& last) noexcept;
  bool left() const noexcept { return leaving_ && desynchronizing_.complete(); }

  // ---- Names of positions

  /// Shifts the following side of the function without motion, for homing [u].
  void shift_following(double by) noexcept;
  /// Counts the turns of the following side anew, without motion.
  void turn_following(std::int64_t turns) noexcept { function_.turn_following(turns); }

 private:
  void couple(const CouplingRequest& request) noexcept;
  void look_closely() noexcept;
  void advance_shifted(Setpoint& setpoint) noexcept;
  void advance_otherwise(Setpoint& setpoint) noexcept;
  void evaluate() noexcept;
  void advance_in_velocity(Setpoint& setpoint) noexcept;
  void advance_in(Setpoint& setpoint) noexcept;
  void advance_out(Setpoint& setpoint) noexcept;
};

}  // namespace lockstep
