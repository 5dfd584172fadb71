/// Synchronizing over a leading value distance: how a following axis joins its synchronous function.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/arithmetic/remainder.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// Whether an axis with modulo may turn either way while it is being synchronized (pin SyncDirection).
/// @source S7-1500T synchronous operation V7, 6.2.3.2
enum class SyncDirection : std::int8_t {
  kPositive = 1,     ///< the following axis moves in positive direction only
  kNegative = 2,     ///< the following axis moves in negative direction only
  kShortestPath = 3  ///< shortest distance from where it is to where it gets synchronous; it may reverse
};

/// How close to its synchronous value an axis with modulo is there: part of its ring. One that is there turns
/// nowhere for SyncDirection, although nothing is exactly nothing behind a motion.
inline constexpr double kOnSynchronousValue = 1e-9;

/// Where the axes are at the first cycle of the profile. `…_velocity` and `…_acceleration` of the leading
/// axis are those of the effective leading value, with their sign.
struct SyncStart {
  AxisPosition leading;
  double leading_velocity = 0.0;      ///< [leading u/s] 0: the profile starts with slope 0
  double leading_acceleration = 0.0;  ///< [leading u/s²]
  AxisPosition following;
  double velocity = 0.0;      ///< [u/s] of the following axis
  double acceleration = 0.0;  ///< [u/s²] of the following axis
};

/// A start from where both axes are.
inline SyncStart start_from(const Setpoint& leading, const Setpoint& following) noexcept {
  return {.leading = leading.position,
          .leading_velocity = leading.velocity,
          .leading_acceleration = leading.acceleration,
          .following = following.position,
          .velocity = following.velocity,
          .acceleration = following.acceleration};
}

/// The synchronous function that the profile joins: straight over the distance, or a parabola.
struct SyncTarget {
  AxisPosition at_start;  ///< function value at the leading position where the profile starts
  double slope = 1.0;  ///< [u / leading u] ratio of a gear, not 0; of a cam that at the end of the distance
  double curvature = 0.0;  ///< [u / leading u²] of a cam, there: then the profile joins the parabola that
                           ///< touches the cam at the end of the distance, and `at_start` is its value
};

enum class SyncPlan : std::uint8_t {
  kReady,
  kAxisMovesInOppositeDirection,     ///< the following axis runs or speeds up against SyncDirection, or so
                                     ///< nearly does that it would shoot ahead before the end
  kFunctionRunsInOppositeDirection,  ///< the synchronous function runs against SyncDirection
};

/// A quintic over the leading distance λ, in the direction in which the leading axis moves: from position,
/// velocity and acceleration of the following axis into the synchronous function with its slope and without
/// curvature. It is held as y(λ) = x - F, with the factor (D - λ)³, so that it ends on the function to the
/// last bit: x = F(L) + y(λ).
///
/// A start between two cycles begins at the last cycle before the crossing and spans the rest: `SyncStart` is
/// that cycle, `distance` the distance from its leading position to the end.
/// @source S7-1500T synchronous operation V7, 6.2.3.4, 6.2.3.5
class SyncProfile {
 public:
  /// Plans the profile. `distance` [leading u] > 0; `backward`: the leading axis moves in negative direction.
  /// The whole turns that the distance of a modulo following axis needs are chosen by `direction`: for
  /// synchronizing in one direction the smallest number with which the axis never reverses, but for
  /// `kOnSynchronousValue`; none if the axis moves on the function already. They are not in the function
  /// passed: see `turns`. A linear following axis goes to the function as it is, whatever `direction`.
  /// Velocity and acceleration of the following axis count with a moving leading axis only; with one that
  /// stands or moves against `backward` the profile starts with slope 0 (published step if the axis moves). A
  /// rejected plan leaves the profile as it was. Bounded time; the cycle's thread.
  SyncPlan plan(const SyncStart& start, const SyncTarget& target, double distance, bool backward,
                SyncDirection direction, const Modulo& leading, const Modulo& following) noexcept;

  /// Turns by which the synchronous function has to be moved (S0.turns += turns) to be the one that is
  /// joined.
  std::int64_t turns() const noexcept { return turns_; }

  double distance() const noexcept { return remainder_.distance(); }  ///< [leading u] D
  bool backward() const noexcept { return backward_; }

  /// λ [leading u]: distance of the leading axis from the start, positive in the direction of the profile.
  /// Any thread.
  double covered(AxisPosition leading) const noexcept;
  bool complete(double distance) const noexcept { return remainder_.complete(distance); }

  /// y and its derivatives; exactly 0 from λ = D on. λ < 0 (leading axis turned back before the start, within
  /// its tolerance) continues the quintic. Any thread.
  SyncOffset value(double distance) const noexcept { return remainder_.value(distance); }

 private:
  AxisPosition leading_start_;
  Modulo leading_;
  Remainder remainder_;
  std::int64_t turns_ = 0;
  bool backward_ = false;
};

/// The smallest distance [u] over the distance D with which the quintic x from slope `start_slope`, curvature
/// `start_curvature` to slope `end_slope` > 0, curvature 0 never runs backward. All slopes are times D and
/// the curvature times D², so in [u]. Infinite if there is none. Any thread.
double minimum_monotone_distance(double start_slope, double start_curvature, double end_slope) noexcept;

/// `minimum_monotone_distance` of a quintic that ends with a slope ≥ 0 and a curvature (times D²); searched
/// for, so about right to 1.0E-9.
double minimum_monotone_distance(double start_slope, double start_curvature, double end_slope,
                                 double end_curvature) noexcept;

}  // namespace lockstep
