/// The software limit switches of an axis.
/// @source S7-1500T axis functions, traversing range limitation
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// Where the axis has to be at rest at the latest, and which side shows as approached or passed. Thread: the
/// cycle.
class SoftwareLimits {
 public:
  struct Range {
    double minimum = 0.0;  // [u]
    double maximum = 0.0;  // [u]
    /// A program may have written them so.
    bool contradictory() const noexcept { return minimum > maximum; }
  };

  /// The limit switches in effect, infinite where there is none. On a ring they count when they lie on it;
  /// one that does not is put at the border of the ring, and two have no effect.
  static Range in_effect(const TO_Struct_PositionLimitsSW& settings, const Modulo& modulo) noexcept;

  /// Nothing is approached or passed: they are not active, or nobody knows where the axis is.
  void release() noexcept { side_ = 0; }

  /// Each cycle, once the setpoint is made. @param controlled whether the setpoint leads the axis
  /// @return whether the axis moves by a setpoint that comes out of the last one, and so has to be held
  bool hold(const Range& range, const Setpoint& now, const Setpoint& last, bool controlled) noexcept;

  /// What counts for the present motion [u] of the negative side, -1, or the positive one, 1.
  double limit(int side) const noexcept { return side > 0 ? held_.maximum : held_.minimum; }

  /// From now on the axis brakes in front of a limit switch.
  void approach(int side) noexcept { approached_ = static_cast<std::int8_t>(side); }
  /// At the end of the cycle. @param arriving whether the axis still brakes in front of a limit switch
  void show(const Range& range, double position, bool arriving) noexcept;

  /// The side that is approached or passed: 1, -1; 0: none.
  int side() const noexcept { return side_; }

 private:
  std::int8_t side_ = 0;
  std::int8_t approached_ = 0;   // while the axis brakes in front of a limit switch
  bool was_controlled_ = false;  // in the last cycle
  Range held_;                   // for the present motion
};

}  // namespace lockstep
