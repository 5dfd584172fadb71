// The fixed stop and the play of an axis, without the axis.
#include "tech_objects/axis/clamping.hpp"

#include <gtest/gtest.h>

#include "tech_objects/axis/backlash.hpp"

namespace lockstep::clamping_test {
namespace {

constexpr double kTolerance = 0.5;

TEST(Clamping, HoldsAnAxisThatStaysWhereItWasFound) {
  Clamping clamping;
  clamping.find(1, {0, 10.0});
  EXPECT_EQ(clamping.side(), 1);
  EXPECT_EQ(clamping.watch({0, 10.4}, {}, kTolerance, 0.0, false), Clamping::Outcome::held);
  EXPECT_TRUE(clamping.holds());
}

TEST(Clamping, LetsAJobGoAwayButNotBack) {
  Clamping clamping;
  clamping.find(-1, {0, 10.0});
  EXPECT_EQ(clamping.watch({0, 10.0}, {}, kTolerance, 5.0, true), Clamping::Outcome::held);
  EXPECT_EQ(clamping.watch({0, 10.0}, {}, kTolerance, -5.0, true), Clamping::Outcome::turned_to);
  EXPECT_EQ(clamping.watch({0, 11.0}, {}, kTolerance, 5.0, true), Clamping::Outcome::held);
  EXPECT_FALSE(clamping.found()) << "it has gone away";
}

TEST(Clamping, TellsOfAnAxisThatIsTornAway) {
  Clamping clamping;
  clamping.find(1, {0, 10.0});
  EXPECT_EQ(clamping.watch({0, 11.0}, {}, kTolerance, 0.0, true), Clamping::Outcome::torn_away)
      << "through the stop";
  clamping.find(1, {0, 10.0});
  EXPECT_EQ(clamping.watch({0, 9.0}, {}, kTolerance, 0.0, false), Clamping::Outcome::torn_away)
      << "back, without a job";
}

TEST(Clamping, IsRenamedByHoming) {
  Clamping clamping;
  clamping.find(1, {0, 10.0});
  clamping.shift(100.0, {});
  EXPECT_EQ(clamping.watch({0, 110.0}, {}, kTolerance, 0.0, false), Clamping::Outcome::held);
}

TEST(Backlash, IsPassedWithItsVelocityWhenTheSetpointTurnsRound) {
  const TO_Struct_Backlash settings{.Enable = true, .Size = 1.0, .Velocity = 250.0};
  Backlash backlash;
  EXPECT_EQ(backlash.pass(settings, 10.0, 0.001), 0.0);
  double passed = 0.0;
  int cycles = 0;
  for (; cycles < 100; ++cycles) {
    const double velocity = backlash.pass(settings, -10.0, 0.001);
    if (!backlash.passing()) break;
    EXPECT_NEAR(velocity, -250.0, 1e-9);
    passed += velocity * 0.001;
  }
  EXPECT_EQ(cycles, 4);
  EXPECT_NEAR(passed, -1.0, 1e-12);
  EXPECT_EQ(backlash.passed(settings), -1.0);
  EXPECT_EQ(backlash.passed({.Enable = false}), 0.0);
}

}  // namespace
}  // namespace lockstep::clamping_test
