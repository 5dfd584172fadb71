/// The whole number that is nearest, in two additions.
#pragma once

namespace lockstep {

/// In half the time that a conversion to an integer and back takes, for which all that is computed with it
/// has to wait. Of two that are as near the even one. @param value within ±2⁵¹; beyond that the result is
/// some number
constexpr double nearest(double value) noexcept {
  constexpr double kNothingBehind = 6755399441055744.0;  // 3 · 2⁵¹: what is added to it becomes whole
  return (value + kNothingBehind) - kNothingBehind;
}

}  // namespace lockstep
