// What an axis has been held back by, beside a target that comes to rest.
#include "tech_objects/synchronous/held_back.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep::held_back_test {
namespace {

// It is given back no faster than the mean velocity of the target, which halves every 44 ms while that
// stands: some 45 s later it were below 2⁻¹⁰²², where each operation takes a processor a hundred cycles more,
// and there it would stay.
TEST(HeldBack, GoesNoSlowerThanAProcessorComputesWithoutDelay) {
  HeldBack held;
  held.set(1e6, 10.0, 5.0);
  Pursuit axis;
  PursuitLimits limits;
  limits.velocity = 100.0;
  limits.acceleration = limits.deceleration = 1.0;
  double target = 0.0;
  axis.begin(1000.0, 0.0);
  held.step(target, 0.0, axis, true, limits);  // it waits
  for (int i = 0; i < 300; ++i) {
    target += 1.0;
    if (i > 20) axis.begin(target + held.by(), 1.0);
    held.step(target, 1.0, axis, true, limits);
  }
  ASSERT_LT(held.velocity(), 0.0) << "it gives back";
  const double before = held.by();
  ASSERT_GT(before, 100.0);
  for (int i = 0; i < 60'000; ++i) {
    axis.begin(target + held.by() - 1e-3, 1e-3);  // it goes along, so that it need not wait
    held.step(target, 0.0, axis, true, limits);
    ASSERT_NE(std::fpclassify(held.velocity()), FP_SUBNORMAL) << "ms " << i;
  }
  EXPECT_GT(held.by(), before - 100.0) << "there is more than the target went forward by";
  EXPECT_EQ(held.velocity(), 0.0);
}

}  // namespace
}  // namespace lockstep::held_back_test
