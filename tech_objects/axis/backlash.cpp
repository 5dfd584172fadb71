// Backlash between the motor, on which the encoder sits, and the load.
// @source S7-1500T axis functions, backlash compensation; synchronous operation V7, 13.1.12 (Sensor.Backlash)
#include <algorithm>
#include <cmath>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// Each servo cycle under position control, while the compensation is on: when the setpoint turns round, the
/// motor passes the play before the load follows. Meanwhile the actual position stands.
/// @return velocity that is added for that [u/s]
double Axis::pass_backlash() noexcept {
  const auto& settings = data.Sensor[0].Backlash;
  if (setpoint_.velocity != 0.0) backlash_.direction = setpoint_.velocity > 0.0 ? 1 : -1;
  // With no play passed the load is carried in the direction to which the position refers.
  const bool refers_to_positive = settings.DirectionAbsoluteHoming == 0;
  const double turned = refers_to_positive ? -settings.Size : settings.Size;
  const bool refers = backlash_.direction == 0 || (backlash_.direction > 0) == refers_to_positive;
  const double missing = (refers ? 0.0 : turned) - backlash_.passed;
  set_bit(data.StatusWord2, Status2Bit::PassingBacklash, missing != 0.0);
  if (missing == 0.0) return 0.0;
  const double most = settings.Velocity * servo_period_;
  const double step = settings.Velocity > 0.0 ? std::clamp(missing, -most, most) : missing;
  backlash_.passed += step;
  if (std::abs(step) == std::abs(missing)) backlash_.passed = refers ? 0.0 : turned;
  return settings.Velocity > 0.0 ? step / servo_period_ : 0.0;
}

}  // namespace lockstep
