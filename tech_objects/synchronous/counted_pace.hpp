/// How fast a target goes that is counted: single counts are no motion that could be braked for.
/// Nothing here allocates or throws.
#pragma once

#include <algorithm>
#include <cmath>

namespace lockstep {

class CountedPace {
 public:
  void begin() noexcept { steps_ = 0.0; }
  /// What is known of it beforehand. @param velocity its mean [u/step]  @param steps over which
  void expect(double velocity, double steps) noexcept {
    pace_ = velocity;
    steps_ = steps;
    share_ = 1.0 / std::max(steps, 1.0);
  }
  /// One step. Of its counts the mean since they have been those of one velocity, over as long as the own
  /// velocity takes some times to change by one of them; counts that stay the same are its velocity.
  /// @param counts in this step [u/step]  @param uncertainty of one count [u/step]  @param change of the own
  /// velocity [u/step²] > 0  @return its velocity [u/step]
  double step(double counts, double uncertainty, double change) noexcept {
    constexpr double kTimes = 8.0;
    constexpr int kSame = 64;
    same_ = counts == last_ ? std::min(same_ + 1, kSame) : 0;
    last_ = counts;
    if (same_ == kSame) return pace_ = counts;
    const double apart = counts - pace_;
    if (steps_ == 0.0 || !(std::abs(apart) <= uncertainty)) {
      pace_ = steps_ == 0.0 ? counts : counts - std::copysign(uncertainty, apart);
      steps_ = share_ = 1.0;
      return pace_;
    }
    if (steps_ * change < kTimes * uncertainty) share_ = 1.0 / ++steps_;  // else it stays as it is
    return pace_ += apart * share_;
  }

 private:
  double pace_ = 0.0, steps_ = 0.0, share_ = 1.0;  // steps_: of its mean
  double last_ = 0.0;
  int same_ = 0;  // steps of the same counts
};

}  // namespace lockstep
