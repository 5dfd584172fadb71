// Software limit switches, through the blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/support/limited_axis.hpp"

namespace lockstep::software_limits_test {
namespace {

using test::bit;
using test::Limited;
using test::use_limits;
using test::within_a_hundred;

class SoftwareLimit : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  int ratio() const { return std::get<0>(GetParam()); }
  bool driven() const { return std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(RatiosAndDrives, SoftwareLimit,
                         ::testing::Combine(::testing::Values(1, 4), ::testing::Bool()));

TEST_P(SoftwareLimit, EndsAPositioningBeyondItAtTheLimitWithAlarm533) {
  Limited rig(ratio(), driven());
  rig.move.Position = 250.0;
  rig.move.Velocity = 80.0;
  rig.move.Execute = true;
  rig.run_within(5000);
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_TRUE(rig.move.Error);
  EXPECT_EQ(static_cast<int>(rig.move.ErrorID), static_cast<int>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 533u);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 2);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::SWLimit));
  EXPECT_TRUE(has_bit(rig.a.data.WarningWord, WarningBit::SWLimitMax));
  EXPECT_TRUE(bit(rig.a, StatusBit::SWLimitMaxActive));
  EXPECT_FALSE(bit(rig.a, StatusBit::SWLimitMinActive));
  EXPECT_TRUE(rig.power.Status);
}

TEST_P(SoftwareLimit, EndsAnEndlessMotionAtTheNegativeLimit) {
  Limited rig(ratio(), driven());
  rig.run_a.Velocity = -300.0;
  rig.run_a.Execute = true;
  rig.run_within(5000);
  EXPECT_EQ(rig.position(), -100.0);
  EXPECT_TRUE(rig.run_a.Error);
  EXPECT_TRUE(bit(rig.a, StatusBit::SWLimitMinActive));
  EXPECT_TRUE(has_bit(rig.a.data.WarningWord, WarningBit::SWLimitMin));
}

TEST_P(SoftwareLimit, IsLeftAfterAcknowledgingAndRefusesToBePassed) {
  Limited rig(ratio(), driven());
  rig.jog.Velocity = 150.0;
  rig.jog.JogForward = true;
  rig.run_within(5000);
  ASSERT_EQ(rig.position(), 100.0);
  rig.jog.JogForward = false;
  rig.run(10);
  rig.acknowledge();
  EXPECT_TRUE(bit(rig.a, StatusBit::SWLimitMaxActive));
  EXPECT_EQ(rig.a.pending_alarm(), 0);

  rig.jog.JogForward = true;
  rig.run_within(100);
  EXPECT_EQ(rig.a.pending_alarm(), 533);
  EXPECT_EQ(rig.position(), 100.0);
  rig.jog.JogForward = false;
  rig.run(10);
  rig.acknowledge();

  rig.jog.JogBackward = true;
  rig.run_within(200);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_LT(rig.position(), 100.0);
  EXPECT_FALSE(bit(rig.a, StatusBit::SWLimitMaxActive));
}

TEST_P(SoftwareLimit, StopsASynchronousAxisAtTheLimitWithMaximumDynamics) {
  Limited rig(ratio(), driven(), [](AxisData& data) {
    within_a_hundred(data);
    data.PositionLimits_SW.LimitReachedBehavior = 1;  // counts for motion of its own only
    data.DynamicLimits.MaxDeceleration = 2000.0;
    data.DynamicLimits.MaxJerk = 20000.0;
  });
  rig.run_l.Velocity = 120.0;
  rig.run_l.Execute = true;
  rig.gear.RatioNumerator = 2;
  rig.gear.Execute = true;
  rig.run_within(4000);
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_TRUE(rig.gear.Error);
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 533u);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 2);
  EXPECT_EQ(rig.a.data.StatusSynchronizedMotion.FunctionState, 0);
  EXPECT_FALSE(bit(rig.a, StatusBit::Synchronous));
}

TEST_P(SoftwareLimit, IsReachedByAPositioningToItWithoutAlarm) {
  Limited rig(ratio(), driven());
  for (const double jerk : {10000.0, 0.0}) {
    for (const double target : {100.0, -100.0}) {
      rig.continuity[1].acceleration = jerk != 0.0;
      rig.move.Position = target;
      rig.move.Jerk = jerk;
      rig.move.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return rig.move.Done || rig.move.Error; }));
      EXPECT_TRUE(rig.move.Done);
      EXPECT_EQ(rig.position(), target);
      EXPECT_EQ(rig.a.pending_alarm(), 0);
      rig.move.Execute = false;
      rig.run(10);
    }
  }
}

TEST_P(SoftwareLimit, DoesNotCountBeforeHomingOrWhileInactive) {
  Limited rig(ratio(), driven());
  rig.a.data.PositionLimits_SW.Active = false;
  rig.relative.Distance = 300.0;
  rig.relative.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
  EXPECT_FALSE(bit(rig.a, StatusBit::SWLimitMaxActive));

  rig.power.Enable = false;
  rig.run(200);
  rig.reset.Restart = true;
  rig.reset.Execute = true;  // no longer homed, limits active as configured
  rig.run(200);
  rig.power.Enable = true;
  rig.run(100);
  ASSERT_FALSE(bit(rig.a, StatusBit::HomingDone));
  rig.relative.Execute = false;
  rig.run(10);
  rig.relative.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
}

/// Maximum deceleration on the way to the limit.
double deceleration_at_limit(int behavior) {
  Limited rig(1, false, [&](AxisData& data) {
    within_a_hundred(data);
    data.PositionLimits_SW.LimitReachedBehavior = behavior;
    data.DynamicLimits.MaxDeceleration = 4000.0;
  });
  rig.run_a.Velocity = 200.0;
  rig.run_a.Deceleration = 500.0;
  rig.run_a.Execute = true;
  double maximum = 0.0;
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    maximum = std::max(maximum, -rig.a.setpoint().acceleration);
  }
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, behavior == 1 ? 1 : 2);
  return maximum;
}

TEST(SoftwareLimits, AreApproachedWithMaximumOrCurrentDynamicsAsConfigured) {
  EXPECT_NEAR(deceleration_at_limit(0), 4000.0, 50.0);
  EXPECT_NEAR(deceleration_at_limit(1), 500.0, 5.0);
}

TEST(SoftwareLimits, OfAnAxisThatStandsOutsideAreWhereItStandsUntilItIsBackInside) {
  Limited rig;
  rig.home.Execute = false;
  rig.home.Position = 130.0;
  rig.tick();
  rig.home.Execute = true;
  rig.continuity[1].velocity = false;  // homing shifts the position
  rig.run(10);
  rig.continuity[1].velocity = true;
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_TRUE(bit(rig.a, StatusBit::SWLimitMaxActive));

  rig.jog.Velocity = 50.0;
  rig.jog.JogBackward = true;
  rig.run(200);
  const double turned_at = rig.position();
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  ASSERT_GT(turned_at, 110.0);
  rig.jog.JogBackward = false;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.setpoint().standing(); }));
  const double here = rig.position();
  rig.jog.JogForward = true;
  rig.run_within(100, -100.0, here);
  EXPECT_EQ(rig.a.pending_alarm(), 533);
  rig.jog.JogForward = false;
  rig.run(10);
  rig.acknowledge();

  rig.jog.JogBackward = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.position() < 80.0; }));
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  rig.jog.JogBackward = false;
  rig.jog.JogForward = true;
  rig.run_within(4000);
  EXPECT_EQ(rig.position(), 100.0);
}

/// A program may write them in any order, or wrongly.
TEST(SoftwareLimits, ThatContradictEachOtherStopTheAxisWithAlarm104) {
  for (const bool homed : {true, false}) {
    Limited rig;
    if (!homed) {
      rig.reset.Restart = true;
      rig.power.Enable = false;
      rig.run(50);
      rig.acknowledge();
      rig.power.Enable = true;
      rig.run(10);
    }
    rig.run_a.Velocity = 20.0;
    rig.run_a.Execute = true;
    rig.run(100);
    rig.a.data.PositionLimits_SW.MinPosition = 50.0;
    rig.a.data.PositionLimits_SW.MaxPosition = 50.0;
    rig.run(1);
    EXPECT_EQ(rig.a.pending_alarm(), 0) << "no way is left, but nothing contradicts";
    rig.a.data.PositionLimits_SW.MinPosition = 60.0;
    rig.run(200);
    EXPECT_EQ(rig.a.pending_alarm(), alarm::kSoftwareLimits);
    EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 2);
    EXPECT_TRUE(rig.run_a.Error);
    EXPECT_TRUE(rig.a.setpoint().standing());
    rig.reset.Restart = false;
    rig.acknowledge();
    EXPECT_EQ(rig.a.pending_alarm(), alarm::kSoftwareLimits) << "its cause is still there";
    rig.a.data.PositionLimits_SW.MinPosition = -100.0;
    rig.a.data.PositionLimits_SW.MaxPosition = 100.0;
    rig.acknowledge();
    EXPECT_EQ(rig.a.pending_alarm(), 0);
    rig.jog.Velocity = 10.0;
    rig.jog.JogForward = true;
    rig.run(100);
    EXPECT_FALSE(rig.a.setpoint().standing());
  }
}

struct Passed {
  DINT behavior;
  DINT reaction;
  bool enabled;
};

TEST(SoftwareLimits, ThatAreMovedInFrontOfAFastAxisArePassedWithAlarm534) {
  for (const Passed& expected : {Passed{0, 4, false}, Passed{1, 3, true}}) {
    Limited rig(1, false, [&](AxisData& data) {
      within_a_hundred(data);
      data.PositionLimits_SW.LimitExceededBehavior = expected.behavior;
      data.DynamicLimits.MaxDeceleration = 2000.0;
      data.DynamicDefaults.EmergencyDeceleration = 5000.0;
    });
    rig.continuity[1].acceleration = false;  // the emergency ramp
    rig.run_a.Velocity = 200.0;
    rig.run_a.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.position() > 60.0; }));
    rig.a.data.PositionLimits_SW.MaxPosition = rig.position() + 1.0;
    rig.run(1000);
    EXPECT_EQ(rig.a.data.ErrorDetail.Number, 534u);
    EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, expected.reaction);
    EXPECT_EQ(rig.power.Status, expected.enabled);
    EXPECT_TRUE(rig.run_a.Error);
    EXPECT_TRUE(bit(rig.a, StatusBit::SWLimitMaxActive));
    EXPECT_TRUE(rig.a.setpoint().standing());
    EXPECT_LT(rig.position(), 75.0);
    // Back inside.
    rig.acknowledge();
    rig.run(20);
    rig.jog.Velocity = 100.0;
    rig.jog.JogBackward = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.position() < 0.0; }));
    EXPECT_EQ(rig.a.pending_alarm(), 0);
    EXPECT_FALSE(bit(rig.a, StatusBit::SWLimitMaxActive));
  }
}

TEST(SoftwareLimits, HoldWhenAWeakerJobTakesOverShortlyBeforeThem) {
  Limited rig(1, false, [](AxisData& data) {
    within_a_hundred(data);
    data.PositionLimits_SW.LimitReachedBehavior = 1;
  });
  rig.run_a.Velocity = 300.0;
  rig.run_a.Deceleration = 20000.0;
  rig.run_a.Jerk = 1000000.0;
  rig.run_a.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.position() > 90.0; }));
  rig.halt.Deceleration = 100.0;
  rig.halt.Execute = true;
  rig.run_within(1000);
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_TRUE(rig.halt.Error);
}

/// Where the way that is left is longer than the axis needs, by less than a cycle's, it does not hurry.
TEST(SoftwareLimits, AreNotApproachedFasterThanTheAxisMovesAnyway) {
  for (const double jerk : {0.0, 1e6}) {
    for (int place = 0; place < 50; ++place) {
      SCOPED_TRACE(place);
      Limited rig(1, false, [=](AxisData& data) {
        within_a_hundred(data);
        data.PositionLimits_SW.MaxPosition = 30.0 + place * 0.001;
        data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = 1e5;
        data.DynamicLimits.MaxJerk = jerk > 0.0 ? 4.6e6 : 0.0;
      });
      rig.continuity[1].acceleration = jerk > 0.0;
      rig.run_a.Velocity = 50.0;
      rig.run_a.Acceleration = 2000.0;
      rig.run_a.Jerk = jerk;
      rig.run_a.Execute = true;
      for (int i = 0; i < 2000; ++i) {
        rig.tick();
        ASSERT_LE(rig.a.setpoint().velocity, 50.0 * (1.0 + 1e-12)) << i;
      }
      EXPECT_EQ(rig.position(), 30.0 + place * 0.001);
      EXPECT_EQ(rig.a.pending_alarm(), 533);
    }
  }
}

TEST(SoftwareLimits, HoldForAHaltThatEndsWithinOneCycleBehindThem) {
  Limited rig(32, false, [](AxisData& data) {
    within_a_hundred(data);
    data.PositionLimits_SW.LimitReachedBehavior = 1;
  });
  rig.continuity[1].acceleration = false;
  rig.run_a.Velocity = 10.0;
  rig.run_a.Deceleration = 50000.0;
  rig.run_a.Jerk = 0.0;
  rig.run_a.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.position() > 50.0; }));
  rig.a.data.PositionLimits_SW.MaxPosition = rig.position() + 0.1;  // the halt takes 0.125 u and 25 ms
  rig.halt.Deceleration = 400.0;
  rig.halt.Jerk = 0.0;
  rig.halt.Execute = true;
  rig.run_within(1000, -100.0, rig.a.data.PositionLimits_SW.MaxPosition);
  EXPECT_EQ(rig.position(), rig.a.data.PositionLimits_SW.MaxPosition);
  EXPECT_EQ(rig.a.pending_alarm(), 533);
}

TEST(SoftwareLimits, HoldForTheRampOfMC_Power) {
  Limited rig(1, false, [](AxisData& data) {
    within_a_hundred(data);
    data.DynamicDefaults.EmergencyDeceleration = 200.0;
  });
  rig.continuity[1].acceleration = false;
  rig.run_a.Velocity = 300.0;
  rig.run_a.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.position() > 50.0; }));
  rig.power.Enable = false;
  rig.run_within(2000);
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_TRUE(rig.a.off());
  EXPECT_EQ(rig.a.pending_alarm(), 533);
}

TEST(SoftwareLimits, OnARingLetTheOtherSideEndAtItsBorder) {
  const auto ring = [](double minimum, double maximum) {
    return [=](AxisData& data) {
      data.Modulo.Enable = true;
      use_limits(data, minimum, maximum);
    };
  };
  Limited both(1, false, ring(0.0, 270.0));
  both.run_a.Velocity = 100.0;
  both.run_a.Execute = true;
  both.run(5000);
  EXPECT_EQ(both.position(), 270.0);
  EXPECT_EQ(both.a.pending_alarm(), 533);

  Limited upper(1, false, ring(-5.0, 270.0));
  upper.run_a.Velocity = -100.0;
  upper.run_a.Execute = true;
  upper.run(1000);
  EXPECT_EQ(upper.position(), 0.0);
  EXPECT_TRUE(bit(upper.a, StatusBit::SWLimitMinActive));

  Limited lower(1, false, ring(0.0, 400.0));
  lower.run_a.Velocity = 100.0;
  lower.run_a.Execute = true;
  lower.run(6000);
  EXPECT_NEAR(lower.position(), 360.0, 1e-9);
  EXPECT_EQ(lower.a.setpoint().position.turns, 0);
  EXPECT_TRUE(bit(lower.a, StatusBit::SWLimitMaxActive));

  Limited none(1, false, ring(-5.0, 400.0));
  none.run_a.Velocity = 100.0;
  none.run_a.Execute = true;
  none.run(6000);
  EXPECT_EQ(none.a.pending_alarm(), 0);
  EXPECT_GT(none.a.setpoint().position.turns, 0);
}

}  // namespace
}  // namespace lockstep::software_limits_test
