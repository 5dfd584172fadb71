#include "tech_objects/axis/software_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {

SoftwareLimits::Range SoftwareLimits::in_effect(const TO_Struct_PositionLimitsSW& settings,
                                                const Modulo& modulo) noexcept {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Range range{settings.MinPosition, settings.MaxPosition};
  if (!modulo.enabled) return range;
  const bool minimum_counts = modulo.contains(range.minimum);
  const bool maximum_counts = modulo.contains(range.maximum);
  if (!minimum_counts && !maximum_counts) return {-kNone, kNone};
  if (!minimum_counts) range.minimum = modulo.start;
  if (!maximum_counts) range.maximum = std::nextafter(modulo.end(), modulo.start);
  return range;
}

/// An axis outside has its limit where it stands; in motion, where it has been furthest outside since. (A
/// limit that came along with every cycle could not be kept by an axis that turns around.)
bool SoftwareLimits::hold(const Range& range, const Setpoint& now, const Setpoint& last,
                          bool controlled) noexcept {
  // A setpoint that has just been taken up does not come out of the last one.
  const bool generated = controlled && was_controlled_;
  was_controlled_ = controlled;
  const bool rests = !generated || (now.standing() && now.position == last.position);
  const double here = rests ? now.position.value : last.position.value;
  const double highest = !rests && side_ > 0 ? std::max(held_.maximum, here) : here;
  const double lowest = !rests && side_ < 0 ? std::min(held_.minimum, here) : here;
  held_.maximum = here > range.maximum ? highest : range.maximum;
  held_.minimum = here < range.minimum ? lowest : range.minimum;
  return !rests;
}

void SoftwareLimits::show(const Range& range, double position, bool arriving) noexcept {
  side_ = 0;
  if (position >= range.maximum) side_ = 1;
  if (position <= range.minimum) side_ = -1;
  if (approached_ == 0) return;
  if (!arriving) approached_ = 0;
  if (side_ == 0) side_ = approached_;
}

}  // namespace lockstep
