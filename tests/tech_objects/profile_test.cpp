#include "tech_objects/profile/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace lockstep::profile_test {
namespace {

constexpr ProfileLimits kLimits{10.0, -10.0, 100.0, 100.0, 1000.0};
constexpr ProfileLimits kUnequal{10.0, -4.0, 100.0, 30.0, 1000.0};
constexpr ProfileLimits kTrapezoid{10.0, -10.0, 100.0, 50.0, 0.0};

static_assert(std::is_trivially_copyable_v<Profile>);

TEST(Profile, StandsAtZeroUntilItIsPlanned) {
  const Profile profile;
  EXPECT_EQ(profile.duration(), 0.0);
  EXPECT_EQ(profile.at(1.0).position, 0.0);
  EXPECT_TRUE(profile.phases().empty());
}

TEST(Profile, TrapezoidFromRestToRestHasTheDurationOfItsFormula) {
  Profile profile;
  ASSERT_EQ(plan_position({2.0, 0.0, 0.0}, 12.0, 0.0, kTrapezoid, profile), PlanResult::ok);
  // 0.1 s up over 0.5 u, 0.2 s down over 1 u, the rest of 10 u at 10 u/s.
  EXPECT_DOUBLE_EQ(profile.duration(), 0.1 + 0.2 + 0.85);
  EXPECT_DOUBLE_EQ(profile.at(0.05).acceleration, 100.0);
  EXPECT_DOUBLE_EQ(profile.at(0.5).velocity, 10.0);
  EXPECT_DOUBLE_EQ(profile.at(1.0).acceleration, -50.0);
}

TEST(Profile, MotionWithJerkFromRestToRestHasTheDurationOfItsFormula) {
  Profile profile;
  ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, 10.0, 0.0, kLimits, profile), PlanResult::ok);
  // Way / velocity + velocity / acceleration + acceleration / jerk.
  EXPECT_DOUBLE_EQ(profile.duration(), 1.0 + 0.1 + 0.1);
  EXPECT_EQ(profile.phases().size(), 7u - 2u) << "the acceleration limit is just met: no phase along it";
}

TEST(Profile, StartsWithExactlyTheStartAndEndsWithExactlyTheTarget) {
  const MotionState start{0.1, -3.3, 17.7};
  Profile profile;
  ASSERT_EQ(plan_position(start, 0.7, 1.1, kUnequal, profile), PlanResult::ok);
  for (const double t : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(profile.at(t).position, start.position);
    EXPECT_EQ(profile.at(t).velocity, start.velocity);
    EXPECT_EQ(profile.at(t).acceleration, start.acceleration);
  }
  const MotionState end = profile.at(profile.duration());
  EXPECT_EQ(end.position, 0.7);
  EXPECT_EQ(end.velocity, 1.1);
  EXPECT_EQ(end.acceleration, 0.0);
  EXPECT_DOUBLE_EQ(profile.at(profile.duration() + 2.0).position, 0.7 + 2.2);
}

TEST(Profile, AtRestItHoldsTheTargetForEver) {
  Profile profile;
  ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, 0.3, 0.0, kLimits, profile), PlanResult::ok);
  EXPECT_EQ(profile.at(1e6).position, 0.3);
  EXPECT_EQ(profile.at(std::numeric_limits<double>::infinity()).position, 0.3);
}

TEST(Profile, NeedsNoTimeWhereNothingIsToBeDone) {
  Profile profile;
  ASSERT_EQ(plan_position({5.0, 0.0, 0.0}, 5.0, 0.0, kLimits, profile), PlanResult::ok);
  EXPECT_EQ(profile.duration(), 0.0);
  ASSERT_EQ(plan_position({5.0, 3.0, 0.0}, 5.0, 3.0, kUnequal, profile), PlanResult::ok);
  EXPECT_EQ(profile.duration(), 0.0);
  ASSERT_EQ(plan_velocity({5.0, 3.0, 0.0}, 3.0, kTrapezoid, profile), PlanResult::ok);
  EXPECT_EQ(profile.duration(), 0.0);
  EXPECT_EQ(profile.at(1.0).position, 8.0);
}

TEST(Profile, ComesBackToATargetItStartsFromInMotion) {
  for (const ProfileLimits& limits : {kLimits, kUnequal, kTrapezoid}) {
    Profile profile;
    ASSERT_EQ(plan_position({5.0, 3.0, 0.0}, 5.0, 0.0, limits, profile), PlanResult::ok);
    EXPECT_GT(profile.at(0.5 * profile.duration()).position, 5.0);
    EXPECT_NEAR(profile.at(std::nextafter(profile.duration(), 0.0)).position, 5.0, 1e-14);
  }
}

TEST(Profile, CoversDistancesFromAPicometreToAMillionKilometres) {
  for (const ProfileLimits& limits : {kLimits, kUnequal, kTrapezoid})
    for (const double distance : {1e-12, -1e-12, 1e-6, -1e-3, 1.0, -1e6, 1e12, -1e12}) {
      Profile profile;
      ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, distance, 0.0, limits, profile), PlanResult::ok);
      const double before = std::nextafter(profile.duration(), 0.0);
      EXPECT_NEAR(profile.at(before).position / distance, 1.0, 1e-12) << distance;
      if (limits.acceleration == limits.deceleration) {
        EXPECT_NEAR(profile.at(0.5 * profile.duration()).position / distance, 0.5, 1e-9) << distance;
      }
    }
}

TEST(Profile, SpeedsUpWithTheAccelerationAndSlowsDownWithTheDecelerationThroughStandstill) {
  Profile profile;
  ASSERT_EQ(plan_velocity({0.0, -4.0, 0.0}, 10.0, kUnequal, profile), PlanResult::ok);
  double slowing = 0.0, speeding = 0.0, at_standstill = 0.0;
  for (int i = 0; i <= 10000; ++i) {
    const MotionState s = profile.at(profile.duration() * i / 10000);
    (s.velocity < 0.0 ? slowing : speeding) =
        std::max(s.velocity < 0.0 ? slowing : speeding, std::abs(s.acceleration));
    if (std::abs(s.velocity) < 0.01) at_standstill = std::max(at_standstill, s.acceleration);
  }
  EXPECT_NEAR(slowing, 30.0, 1e-9);
  EXPECT_NEAR(speeding, 100.0, 1e-9);
  EXPECT_NEAR(at_standstill, 30.0, 1.0);
}

TEST(Profile, BringsTheAccelerationToTheLimitOfTheOtherSideBeforeTheVelocityChangesSign) {
  const ProfileLimits limits{10.0, -10.0, 20.0, 80.0, 1000.0};
  Profile profile;
  ASSERT_EQ(plan_velocity({0.0, -10.0, 0.0}, 10.0, limits, profile), PlanResult::ok);
  double slowing = 0.0;
  for (int i = 0; i <= 10000; ++i) {
    const MotionState s = profile.at(profile.duration() * i / 10000);
    if (s.velocity < 0.0) slowing = std::max(slowing, s.acceleration);
    if (s.velocity >= 0.0) {
      ASSERT_LE(s.acceleration, 20.0 * (1.0 + 1e-12));
    }
  }
  EXPECT_NEAR(slowing, 80.0, 1e-9);
}

TEST(Profile, KeepsToTheVelocityLimitOfEachDirection) {
  Profile profile;
  ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, 100.0, 0.0, kUnequal, profile), PlanResult::ok);
  EXPECT_EQ(profile.at(0.5 * profile.duration()).velocity, 10.0);
  ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, -100.0, 0.0, kUnequal, profile), PlanResult::ok);
  EXPECT_EQ(profile.at(0.5 * profile.duration()).velocity, -4.0);
}

TEST(Profile, ComesDownToALoweredVelocityLimitWithoutFallingShortOfIt) {
  for (const ProfileLimits& limits : {kLimits, kUnequal, kTrapezoid}) {
    Profile profile;
    ASSERT_EQ(plan_position({0.0, 20.0, 0.0}, 500.0, 0.0, limits, profile), PlanResult::ok);
    double last = 20.0;
    for (int i = 0; i <= 1000; ++i) {
      const double v = profile.at(profile.duration() * i / 1000).velocity;
      ASSERT_LE(v, last);
      last = v;
    }
    EXPECT_EQ(profile.at(0.5 * profile.duration()).velocity, 10.0);
  }
}

TEST(Profile, BringsAnAccelerationBeyondItsLimitInsideWithFullJerk) {
  Profile profile;
  ASSERT_EQ(plan_velocity({0.0, 0.0, 150.0}, 100.0, {100.0, -100.0, 100.0, 100.0, 1000.0}, profile),
            PlanResult::ok);
  EXPECT_EQ(profile.phases()[0].jerk, -1000.0);
  EXPECT_DOUBLE_EQ(profile.phases()[1].begin, 0.05);
  EXPECT_EQ(profile.phases()[1].state.acceleration, 100.0);
}

// Slowing down from the wrong side of standstill, less way is won by easing for a short while; the way grows
// again if one eases for longer, and less than the quickest change's way is left only by far longer motions.
TEST(Profile, FindsTheShortEasingWhereALongOneWouldAlsoMeetTheTarget) {
  struct Case {
    MotionState start;
    double target, velocity;
    ProfileLimits limits;
    double known;  // duration of a motion that keeps the limits
  };
  const Case cases[] = {
      {{0.0, -0.020798175152715381, 1.2917953203185637},
       0.03885355326447134,
       0.29130357219100356,
       {0.83261724610215637, -2.1889699719614373, 1.2803614645696664, 3.1662292401727306, 31.205212395051468},
       0.275234608},
      {{0.0, 0.22987575122828652, -0.31788764715004447},
       -15.655513976658121,
       -3.5920806264182179,
       {6.675035221842017, -5.1605761644184565, 0.56261815033427565, 0.31788764715004447,
        0.23036301261343828},
       8.59650147},
      {{0.0, -0.0097376243963910019, 0.86728386573399852},
       0.011861693459781927,
       0.1311421250312288,
       {0.41133732049376054, -1.1534373440852717, 1.6204719392680127, 0.93844903926251966,
        14.577982700083973},
       0.15681438},
      {{0.0, -0.19078428002388392, 1.2562361272649236},
       131.02158112394306,
       19.762562548067592,
       {100.0, -100.0, 1.5687615176202987, 1.4431501902174992, 2.3538259482847752},
       13.0984106}};
  for (const Case& c : cases) {
    Profile profile;
    ASSERT_EQ(plan_position(c.start, c.target, c.velocity, c.limits, profile), PlanResult::ok);
    EXPECT_LE(profile.duration(), c.known * (1.0 + 1e-7));
  }
}

TEST(Profile, MeetsATargetThatTheReleaseOfTheAccelerationSplitsExactly) {
  const ProfileLimits limits{0.071436173436526612, -0.010305574015149331, 0.013568147838015798,
                             0.060254942552606751, 0.0021653581266949085};
  Profile profile;
  ASSERT_EQ(plan_position({0.67047738487409902, 0.06085839686193284, -0.0044106800421103622},
                          1.0759251372103746, 0.0, limits, profile),
            PlanResult::ok);
  EXPECT_NEAR(profile.at(std::nextafter(profile.duration(), 0.0)).position, 1.0759251372103746, 1e-14);
}

TEST(Profile, AStopKeepsOrDropsAnAccelerationThatIsPresent) {
  const MotionState speeding_up{0.0, 5.0, 100.0};
  Profile kept, dropped;
  ASSERT_EQ(plan_stop(speeding_up, kLimits, PresentAcceleration::keep, kept), PlanResult::ok);
  ASSERT_EQ(plan_stop(speeding_up, kLimits, PresentAcceleration::abort, dropped), PlanResult::ok);
  EXPECT_EQ(kept.at(0.0).acceleration, 100.0);
  EXPECT_EQ(dropped.at(0.0).acceleration, 0.0);
  EXPECT_EQ(kept.target().velocity, 0.0);
  EXPECT_EQ(dropped.target().velocity, 0.0);
  EXPECT_LT(dropped.duration(), kept.duration());
  EXPECT_LT(dropped.target().position, kept.target().position);
}

TEST(Profile, AStopKeepsADecelerationThatIsPresent) {
  const MotionState slowing_down{0.0, -5.0, 50.0};
  Profile kept, aborted;
  ASSERT_EQ(plan_stop(slowing_down, kLimits, PresentAcceleration::keep, kept), PlanResult::ok);
  ASSERT_EQ(plan_stop(slowing_down, kLimits, PresentAcceleration::abort, aborted), PlanResult::ok);
  EXPECT_EQ(kept.duration(), aborted.duration());
}

TEST(Profile, RefusesWhatIsNotFiniteAndLeavesTheProfileAsItWas) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Profile profile;
  ASSERT_EQ(plan_position({0.0, 0.0, 0.0}, 1.0, 0.0, kLimits, profile), PlanResult::ok);
  const double duration = profile.duration();
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(plan_position({bad, 0.0, 0.0}, 1.0, 0.0, kLimits, profile), PlanResult::not_finite);
    EXPECT_EQ(plan_position({0.0, bad, 0.0}, 1.0, 0.0, kLimits, profile), PlanResult::not_finite);
    EXPECT_EQ(plan_position({0.0, 0.0, bad}, 1.0, 0.0, kLimits, profile), PlanResult::not_finite);
    EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, bad, 0.0, kLimits, profile), PlanResult::not_finite);
    EXPECT_EQ(plan_velocity({0.0, 0.0, 0.0}, bad, kLimits, profile), PlanResult::not_finite);
  }
  EXPECT_EQ(profile.duration(), duration);
  EXPECT_EQ(profile.target().position, 1.0);
}

TEST(Profile, RefusesLimitsThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Profile profile;
  for (const ProfileLimits& limits :
       {ProfileLimits{0.0, -1.0, 1.0, 1.0, 1.0}, ProfileLimits{1.0, 0.0, 1.0, 1.0, 1.0},
        ProfileLimits{1.0, 1.0, 1.0, 1.0, 1.0}, ProfileLimits{1.0, -1.0, 0.0, 1.0, 1.0},
        ProfileLimits{1.0, -1.0, 1.0, -1.0, 1.0}, ProfileLimits{1.0, -1.0, 1.0, 1.0, -1.0},
        ProfileLimits{kInfinity, -1.0, 1.0, 1.0, 1.0}, ProfileLimits{1.0, -1.0, 1.0, 1.0, kNan}})
    EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, 1.0, 0.0, limits, profile), PlanResult::limits_invalid);
  EXPECT_EQ(plan_velocity({0.0, 0.0, 0.0}, 10.1, kLimits, profile), PlanResult::beyond_limits);
  EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, 1.0, -4.1, kUnequal, profile), PlanResult::beyond_limits);
}

TEST(Profile, RefusesNumbersWhoseSquaresLeaveTheRangeOfDouble) {
  Profile profile;
  EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, 1.0, 0.0, {1e200, -1.0, 1.0, 1.0, 1.0}, profile),
            PlanResult::not_representable);
  EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, 1.0, 0.0, {1.0, -1.0, 1.0, 1e-200, 1.0}, profile),
            PlanResult::not_representable);
  EXPECT_EQ(plan_position({0.0, 0.0, 0.0}, 1e300, 0.0, kLimits, profile), PlanResult::not_representable);
  EXPECT_EQ(plan_velocity({0.0, 1e100, 0.0}, 0.0, {1.0, -1.0, 1.0, 1e-99, 1e-99}, profile), PlanResult::ok);
}

}  // namespace
}  // namespace lockstep::profile_test
