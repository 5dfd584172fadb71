#include "tech_objects/axis/backlash.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/types/published.hpp"

namespace lockstep {

double Backlash::pass(const TO_Struct_Backlash& settings, double velocity, double cycle) noexcept {
  if (velocity != 0.0) direction_ = velocity > 0.0 ? 1 : -1;
  // With no play passed the load is carried in the direction to which the position refers.
  const bool refers_to_positive = settings.DirectionAbsoluteHoming == BacklashDirection::positive;
  const double turned = refers_to_positive ? -settings.Size : settings.Size;
  const bool refers = direction_ == 0 || (direction_ > 0) == refers_to_positive;
  const double missing = (refers ? 0.0 : turned) - passed_;
  passing_ = missing != 0.0;
  if (!passing_) return 0.0;
  const double maximum = settings.Velocity * cycle;
  const double step = settings.Velocity > 0.0 ? std::clamp(missing, -maximum, maximum) : missing;
  passed_ += step;
  if (std::abs(step) == std::abs(missing)) passed_ = refers ? 0.0 : turned;
  return settings.Velocity > 0.0 ? step / cycle : 0.0;
}

}  // namespace lockstep
