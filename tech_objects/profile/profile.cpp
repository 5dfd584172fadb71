#include "tech_objects/profile/profile.hpp"

namespace lockstep {

MotionState Profile::at(double t) const noexcept {
  if (!(t > 0.0)) return start_;
  if (t >= duration_)
    return {
        target_.velocity == 0.0 ? target_.position : target_.position + target_.velocity * (t - duration_),
        target_.velocity, 0.0};
  // Counted rather than searched for: where a search ends no processor foresees.
  int passed = 0;
  for (int i = 1; i < count_; ++i) passed += t >= phases_[static_cast<std::size_t>(i)].begin ? 1 : 0;
  return phases_[static_cast<std::size_t>(passed)].at(t);
}

}  // namespace lockstep
