#include "tech_objects/axis/turning_back.hpp"

#include "tech_objects/axis/stopping_distance.hpp"

namespace lockstep {

bool turns_in_time(int side, double distance, double jerk, AxisMotion motion, const Setpoint& setpoint,
                   const SingleAxisMotion& single, const SuperimposedMotion& superimposed) noexcept {
  if (motion == AxisMotion::single_axis) {
    const double added = superimposed.in_use() ? superimposed.distance_left(side) : 0.0;
    return single.distance_left(side) + added <= distance;
  }
  return Heading{setpoint, side}.turning_back_within(distance, jerk);
}

}  // namespace lockstep
