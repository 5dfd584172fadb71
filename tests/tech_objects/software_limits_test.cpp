#include "tech_objects/axis/software_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep::software_limits_test {
namespace {

constexpr Modulo kLine{};
constexpr Modulo kRing{true, 360.0, 0.0};

TO_Struct_PositionLimitsSW limits(double minimum, double maximum) {
  TO_Struct_PositionLimitsSW settings;
  settings.Active = true;
  settings.MinPosition = minimum;
  settings.MaxPosition = maximum;
  return settings;
}

Setpoint at(double position, double velocity = 0.0) {
  return {{0, position}, velocity, 0.0};
}

TEST(SoftwareLimits, OnARingThatDoNotLieOnItHaveNoEffectTogetherAndLieAtItsBorderAlone) {
  const auto both = SoftwareLimits::in_effect(limits(-10.0, 400.0), kRing);
  EXPECT_TRUE(std::isinf(both.minimum) && std::isinf(both.maximum));
  const auto one = SoftwareLimits::in_effect(limits(-10.0, 300.0), kRing);
  EXPECT_EQ(one.minimum, 0.0);
  EXPECT_EQ(one.maximum, 300.0);
  EXPECT_EQ(SoftwareLimits::in_effect(limits(10.0, 400.0), kRing).maximum, std::nextafter(360.0, 0.0));
}

TEST(SoftwareLimits, ContradictWhereTheMinimumIsAboveTheMaximum) {
  EXPECT_TRUE(SoftwareLimits::in_effect(limits(5.0, -5.0), kLine).contradictory());
  EXPECT_FALSE(SoftwareLimits::in_effect(limits(-5.0, 5.0), kLine).contradictory());
}

TEST(SoftwareLimits, HoldASetpointOnlyOnceItComesOutOfTheLastOne) {
  const auto range = SoftwareLimits::in_effect(limits(-100.0, 100.0), kLine);
  SoftwareLimits switches;
  EXPECT_FALSE(switches.hold(range, at(1.0, 1.0), at(0.0, 1.0), true));
  EXPECT_TRUE(switches.hold(range, at(2.0, 1.0), at(1.0, 1.0), true));
  EXPECT_FALSE(switches.hold(range, at(2.0), at(2.0), true));
  EXPECT_FALSE(switches.hold(range, at(3.0, 1.0), at(2.0, 1.0), false));
}

TEST(SoftwareLimits, OfAnAxisOutsideAreWhereItStands) {
  const auto range = SoftwareLimits::in_effect(limits(-100.0, 100.0), kLine);
  SoftwareLimits switches;
  switches.hold(range, at(120.0), at(120.0), true);
  EXPECT_EQ(switches.limit(1), 120.0);
  EXPECT_EQ(switches.limit(-1), -100.0);
}

TEST(SoftwareLimits, ShowTheSideThatIsReachedOrInFrontOfWhichTheAxisBrakes) {
  const auto range = SoftwareLimits::in_effect(limits(-100.0, 100.0), kLine);
  SoftwareLimits switches;
  switches.show(range, 100.0, false);
  EXPECT_EQ(switches.side(), 1);
  switches.show(range, 0.0, false);
  EXPECT_EQ(switches.side(), 0);
  switches.approach(-1);
  switches.show(range, -50.0, true);
  EXPECT_EQ(switches.side(), -1);
  switches.release();
  EXPECT_EQ(switches.side(), 0);
}

}  // namespace
}  // namespace lockstep::software_limits_test
