/// The fixed stop at which an axis is clamped.
/// @source S7-1500T axis functions, fixed stop detection; alarm 542
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/axis_position.hpp"

namespace lockstep {

/// A stop that has been found, and whether the axis is still held there. The cycle's thread.
class Clamping {
 public:
  /// What has become of a clamped axis.
  enum class Outcome : std::uint8_t {
    held,       ///< it is where it was found, or goes away with its job
    turned_to,  ///< a job that has been let go away from the stop has turned towards it
    torn_away   ///< it has left the place without a job that leads away
  };

  /// The axis pushes against something on a side, 1 or -1.
  void find(int side, AxisPosition actual) noexcept {
    side_ = static_cast<std::int8_t>(side);
    place_ = actual;
    holds_ = true;
  }
  void leave() noexcept {
    side_ = 0;
    holds_ = false;
  }
  /// Homing [u].
  void shift(double by, const Modulo& modulo) noexcept { place_ = advanced(place_, by, modulo); }

  /// In which direction a stop has been found: 1, -1; 0: none.
  int side() const noexcept { return side_; }
  bool found() const noexcept { return side_ != 0; }
  /// Whether the axis is held there, within Clamping.PositionTolerance.
  bool holds() const noexcept { return holds_; }

  /// One interpolator cycle at the stop; an axis that has gone away from it has left it.
  /// @param tolerance [u]  @param velocity [u/s] of the setpoint  @param has_job whether a job moves it
  Outcome watch(AxisPosition actual, const Modulo& modulo, double tolerance, double velocity,
                bool has_job) noexcept;

 private:
  std::int8_t side_ = 0;
  bool holds_ = false;
  AxisPosition place_;  // actual position when the stop was found
};

}  // namespace lockstep
