// The way onto a gear that ends where it is said to.
#include "tech_objects/synchronous/meeting_path.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(MeetingPath, EndsOnItsGearWithoutAStepOfVelocityOrAcceleration) {
  for (const double length : {4000.0, -4000.0, 12'345.0}) {
    MeetingPath path;
    constexpr double kBegin = 100.0, kBehind = 1500.0, kSlower = -0.75;
    path.begin(kBegin, length, kBehind, kSlower);
    EXPECT_NEAR(path.offset(kBegin), kBehind, 1e-9);
    EXPECT_NEAR(path.slope(kBegin), kSlower, 1e-12);
    EXPECT_NEAR(path.curvature(kBegin), 0.0, 1e-15);
    EXPECT_NEAR(path.offset(kBegin + length), 0.0, 1e-9);
    EXPECT_NEAR(path.slope(kBegin + length), 0.0, 1e-12);
    EXPECT_NEAR(path.curvature(kBegin + length), 0.0, 1e-12);
    EXPECT_TRUE(path.over(kBegin + length));
    EXPECT_FALSE(path.over(kBegin + 0.99 * length));
    // What it says of its slope and curvature is what it does.
    for (int i = 1; i < 20; ++i) {
      const double at = kBegin + length * i / 20.0, h = length * 1e-4;
      EXPECT_NEAR((path.offset(at + h) - path.offset(at - h)) / (2.0 * h), path.slope(at), 1e-4);
      EXPECT_NEAR((path.slope(at + h) - path.slope(at - h)) / (2.0 * h), path.curvature(at), 1e-7);
    }
  }
}

TEST(MeetingPath, KnowsWhetherItStaysWithinLimits) {
  MeetingPath path;
  // From rest onto a gear of 1:1 at 20 counts a step, over twice the way of what follows.
  const MeetingPath::Limits limits{.velocity = 40.0, .acceleration = 0.2, .leading = 20.0, .ratio = 1.0};
  path.begin(0.0, 2000.0, 1000.0, -1.0);
  EXPECT_FALSE(path.within(limits));
  path.begin(0.0, 8000.0, 4000.0, -1.0);
  EXPECT_TRUE(path.within(limits));
}

}  // namespace
}  // namespace lockstep
