/// Out of a synchronous motion to rest at a position.
/// @source S7-1500T synchronous operation V7, 6.2.6
#pragma once

#include "tech_objects/arithmetic/remainder.hpp"
#include "tech_objects/synchronous/chain.hpp"

namespace lockstep {

/// Waits until the axis can come to rest at the position, and leads it there over a leading distance. Thread:
/// the cycle.
class Desynchronizing {
 public:
  /// Whether the axis comes past the place from which it would come to rest at the position between the last
  /// setpoint and the candidate for this tick. @param dynamics where it is planned in time
  bool meets(const Chain& chain, const LeavingRequest& request, const Setpoint& last,
             const Setpoint& candidate, const Dynamics& dynamics) noexcept;
  /// After `meets`: distance to the stop position [u], and that position.
  double stop_distance() const noexcept { return stop_distance_; }
  AxisPosition position() const noexcept { return position_; }

  /// From here on over the leading distance.
  void begin(const LeadingStep& leading, const Setpoint& last) noexcept;
  /// The setpoint of this tick: what is left of the distance to the stop position.
  void advance(const LeadingStep& leading, const Modulo& following, Setpoint& setpoint) noexcept;
  void watch_reversal(const LeadingStep& leading, double tolerance) noexcept {
    progress_.watch(leading, tolerance, false);
  }
  bool reversed() const noexcept { return progress_.reversed(); }
  bool complete() const noexcept { return complete_; }

  /// The axis has another name for every position [u]; the leading axis counts other turns.
  void shift_following(double by, const Modulo& following) noexcept {
    position_ = advanced(position_, by, following);
  }
  void turn_leading(std::int64_t turns) noexcept { progress_.turn_leading(turns); }

 private:
  void set_position(const Setpoint& last, double target, const Modulo& following) noexcept;

  LeadingProgress progress_;
  double stop_distance_ = 0.0;  // to the stop position [u], signed
  AxisPosition position_;
  double distance_ = 0.0;  // leading distance [u]
  bool complete_ = false;
  Remainder remainder_;
};

}  // namespace lockstep
