// What an axis watches over, through the blocks: software limit switches, following error, standstill.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <tuple>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep {
namespace {

using test::Rig;
using Configure = std::function<void(AxisData&)>;

constexpr double kRounding = 1e-9;  // [u] what a position may be off by rounding

void use_limits(AxisData& data, double least, double greatest) {
  data.PositionLimits_SW.Active = true;
  data.PositionLimits_SW.MinPosition = least;
  data.PositionLimits_SW.MaxPosition = greatest;
}

void within_a_hundred(AxisData& data) {
  use_limits(data, -100.0, 100.0);
}

bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}

/// A leading axis without and a following axis with limits, both enabled and homed at 0.
struct Limited : Rig {
  explicit Limited(int ratio = 1, bool driven = false, const Configure& configure = within_a_hundred)
      : Rig(1'000'000, ratio),
        l(axis("Leading")),
        a(axis("Limited",
               [&](AxisData& data) {
                 if (driven) drive(data);
                 configure(data);
               })),
        power_l(block<MC_Power>()),
        run_l(block<MC_MoveVelocity>()),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        move(block<MC_MoveAbsolute>()),
        relative(block<MC_MoveRelative>()),
        run_a(block<MC_MoveVelocity>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        gear(block<MC_GearIn>()),
        reset(block<MC_Reset>()) {
    a.drive_settings = {.time_constant = 0.002, .dead_time = 0.001, .resolution = 0.0};
    lead(a, l);
    power_l.Axis = run_l.Axis = &l;
    power.Axis = home.Axis = &a;
    reset.Axis = &a;
    move.Axis = relative.Axis = run_a.Axis = jog.Axis = halt.Axis = &a;
    gear.Master = &l;
    gear.Slave = &a;
    power_l.Enable = power.Enable = true;
    run(10 * ratio);
    home.Execute = true;
    run(10 * ratio);
  }

  static void drive(AxisData& data) {
    data.VirtualAxis.Mode = 0;
    data.PositionControl.Kv = 40.0;
  }

  double position() const { return a.setpoint().position.value; }

  /// Asserts over a time that the setpoint stays on its side of both limits.
  void run_within(int ticks, double least = -100.0, double greatest = 100.0) {
    for (int i = 0; i < ticks; ++i) {
      tick();
      ASSERT_LE(position(), greatest + kRounding) << "at " << controller.now();
      ASSERT_GE(position(), least - kRounding) << "at " << controller.now();
    }
  }

  void acknowledge() {
    reset.Execute = false;
    run(40);
    reset.Execute = true;
    run(40);
    ASSERT_TRUE(reset.Done);
  }

  Axis& l;
  Axis& a;
  MC_Power& power_l;
  MC_MoveVelocity& run_l;
  MC_Power& power;
  MC_Home& home;
  MC_MoveAbsolute& move;
  MC_MoveRelative& relative;
  MC_MoveVelocity& run_a;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_GearIn& gear;
  MC_Reset& reset;
};

// ---- Software limit switches
// ----------------------------------------------------------------------------------

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

/// Greatest deceleration on the way to the limit.
double deceleration_at_limit(int behavior) {
  Limited rig(1, false, [&](AxisData& data) {
    within_a_hundred(data);
    data.PositionLimits_SW.LimitReachedBehavior = behavior;
    data.DynamicLimits.MaxDeceleration = 4000.0;
  });
  rig.run_a.Velocity = 200.0;
  rig.run_a.Deceleration = 500.0;
  rig.run_a.Execute = true;
  double greatest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    greatest = std::max(greatest, -rig.a.setpoint().acceleration);
  }
  EXPECT_EQ(rig.position(), 100.0);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, behavior == 1 ? 1 : 2);
  return greatest;
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
  const auto ring = [](double least, double greatest) {
    return [=](AxisData& data) {
      data.Modulo.Enable = true;
      use_limits(data, least, greatest);
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

// ---- Following error
// ----------------------------------------------------------------------------------------------

TEST(FollowingErrorMonitoring, RemovesTheEnableWhenADriveDoesNotFollow) {
  Limited rig(1, true, [](AxisData& data) {
    data.Actor.DriveParameter.MaxSpeed = 3000.0;  // 500 mm/s
    data.FollowingError = {.MinValue = 2.0, .MaxValue = 20.0, .MinVelocity = 100.0};
    data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = 1000.0;
  });
  rig.run_a.Velocity = 700.0;
  rig.run_a.Execute = true;
  rig.continuity[1].velocity = false;  // the setpoint follows the drive that runs out
  bool warned = false;
  double greatest = 0.0;
  double velocity = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    warned = warned || (rig.a.pending_alarm() == 0 &&
                        has_bit(rig.a.data.WarningWord, WarningBit::FollowingErrorWarning));
    greatest = std::max(greatest, std::abs(rig.a.data.StatusPositioning.FollowingError));
    if (rig.a.pending_alarm() != 0) return true;
    velocity = rig.a.data.Velocity;
    return false;
  }));
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 521u);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 4);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::FollowingErrorFault));
  EXPECT_TRUE(warned);
  // 2 mm up to 100 mm/s, 20 mm at 1000 mm/s.
  EXPECT_NEAR(greatest, 2.0 + 18.0 * (velocity - 100.0) / 900.0, 0.2);
  EXPECT_GT(velocity, 550.0);
  rig.run(100);
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(rig.run_a.Error);
  EXPECT_EQ(rig.a.data.StatusPositioning.FollowingError, 0.0);
}

TEST(FollowingErrorMonitoring, HoldsMinValueBelowMinVelocity) {
  Limited rig(1, true, [](AxisData& data) {
    data.Actor.DriveParameter.MaxSpeed = 60.0;  // 10 mm/s
    data.FollowingError = {.MinValue = 1.0, .MaxValue = 100.0, .MinVelocity = 50.0, .WarningLevel = 50.0};
  });
  rig.run_a.Velocity = 20.0;
  rig.run_a.Execute = true;
  rig.continuity[1].velocity = false;
  double at_warning = 0.0;
  double greatest = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    const double error = rig.a.data.StatusPositioning.FollowingError;
    greatest = std::max(greatest, error);
    if (at_warning == 0.0 && has_bit(rig.a.data.WarningWord, WarningBit::FollowingErrorWarning))
      at_warning = error;
    return rig.a.pending_alarm() != 0;
  }));
  EXPECT_EQ(rig.a.pending_alarm(), 521);
  EXPECT_NEAR(greatest, 1.0, 0.03);
  EXPECT_NEAR(at_warning, 0.5, 0.03);
}

TEST(FollowingErrorMonitoring, IsSilentWhenItIsOffOrTheDriveFollows) {
  for (const bool monitored : {false, true}) {
    Limited rig(1, true, [&](AxisData& data) {
      data.FollowingError = {
          .EnableMonitoring = monitored, .MinValue = 0.5, .MaxValue = 1.0, .MinVelocity = 10.0};
      if (!monitored) data.Actor.DriveParameter.MaxSpeed = 600.0;  // 100 mm/s
    });
    rig.run_a.Velocity = 300.0;
    rig.run_a.Execute = true;
    rig.run(2000);
    EXPECT_EQ(rig.a.pending_alarm(), 0);
    EXPECT_FALSE(has_bit(rig.a.data.WarningWord, WarningBit::FollowingErrorWarning));
    EXPECT_TRUE(rig.power.Status);
  }
}

TEST(FollowingErrorMonitoring, PausesWithoutPositionControlAndBeginsAnewWithIt) {
  Limited rig(4, true, [](AxisData& data) {
    data.FollowingError = {.MinValue = 2.0, .MaxValue = 4.0, .MinVelocity = 10.0};
    data.PositionControl.Kpc = 90.0;  // without position control the axis lags more and more
  });
  rig.continuity[1].velocity = false;  // the setpoint begins anew where the axis is
  rig.run_a.Velocity = 200.0;
  rig.run_a.PositionControlled = false;
  rig.run_a.Execute = true;
  rig.run(8000);
  ASSERT_TRUE(bit(rig.a, StatusBit::NonPositionControlled));
  EXPECT_EQ(rig.a.data.StatusPositioning.FollowingError, 0.0);
  rig.run_a.Execute = false;
  rig.tick();
  rig.run_a.PositionControlled = true;
  rig.run_a.Execute = true;
  rig.run(2000);
  EXPECT_FALSE(bit(rig.a, StatusBit::NonPositionControlled));
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_NEAR(rig.a.data.ActualVelocity, 200.0, 1.0);
}

// ---- Standstill and positioning
// ----------------------------------------------------------------------------------

TEST(Standstill, IsLeftOnlySomewhatAboveItsThreshold) {
  Limited rig(1, false, [](AxisData& data) {
    data.StandstillSignal = {.VelocityThreshold = 10.0, .MinDwellTime = 0.05};
  });
  const auto settle_at = [&](double velocity) {
    rig.run_a.Velocity = velocity;
    rig.run_a.Execute = false;
    rig.tick();
    rig.run_a.Execute = true;
    EXPECT_TRUE(rig.run_until([&] { return rig.run_a.InVelocity; }));
    rig.run(200);
  };
  rig.run(100);
  ASSERT_TRUE(bit(rig.a, StatusBit::Standstill));
  settle_at(10.2);
  EXPECT_TRUE(bit(rig.a, StatusBit::Standstill));
  settle_at(11.0);
  EXPECT_FALSE(bit(rig.a, StatusBit::Standstill));
  settle_at(10.2);
  EXPECT_FALSE(bit(rig.a, StatusBit::Standstill));
  settle_at(9.9);
  EXPECT_TRUE(bit(rig.a, StatusBit::Standstill));
}

TEST(Standstill, TakesItsDwellTimeAsWrittenInTheCycle) {
  Limited rig(1, false, [](AxisData&) {});
  rig.a.data.StandstillSignal.MinDwellTime = 0.25;
  rig.run_a.Velocity = 100.0;
  rig.run_a.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.run_a.InVelocity; }));
  rig.halt.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return std::abs(rig.a.data.ActualVelocity) <= 5.0; }));
  int ticks = 0;
  ASSERT_TRUE(rig.run_until([&] { return ++ticks, bit(rig.a, StatusBit::Standstill); }));
  EXPECT_EQ(ticks, 250);
}

TEST(PositioningMonitoring, RaisesAlarm541WhenTheAxisLeavesTheWindowWithinTheDwellTime) {
  Limited rig(1, true, [](AxisData& data) {
    data.PositionControl = {.Kv = 5.0, .Kpc = 0.0};  // creeps to its target
    data.PositioningMonitoring = {.ToleranceTime = 10.0, .MinDwellTime = 5.0, .Window = 2.0};
    data.FollowingError.EnableMonitoring = false;
  });
  rig.move.Position = 20.0;
  rig.move.Execute = true;
  const auto away = [&] { return std::abs(rig.a.data.ActualPosition - 20.0); };
  ASSERT_TRUE(rig.run_until([&] { return rig.a.setpoint().standing() && away() < 1.5; }));
  EXPECT_TRUE(rig.move.Busy);
  rig.continuity[1].velocity = false;  // switched off, the setpoint is where the axis is
  rig.a.data.PositioningMonitoring.Window = 0.5 * away();
  rig.run(2);
  EXPECT_TRUE(rig.move.Error);
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 541u);
}

// ---- Random jobs
// ------------------------------------------------------------------------------------------------

/// Random jobs, gears included, on an axis with limits.
class RandomJobs {
 public:
  explicit RandomJobs(std::uint64_t seed)
      : random_(seed), rig_(chance(0.5) ? 1 : 4, chance(0.3), [this](AxisData& data) { configure(data); }) {
    rig_.continuity[1].acceleration = false;
    rig_.continuity[1].highest_acceleration = 1e6;
    rig_.continuity[0].acceleration = false;
  }

  /// How far the setpoint has been outside at most [u].
  double run() {
    for (int i = 0; i < 12; ++i) {
      act();
      for (int ticks = pick(600); ticks > 0; --ticks) tick();
      if (rig_.a.pending_alarm() != 0 && chance(0.7)) reset();
      if (chance(0.8)) rig_.power.Enable = true;
    }
    return furthest_;
  }
  bool passed() const { return passed_; }
  bool alarmed() const { return alarmed_; }

 private:
  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void configure(AxisData& data) {
    least_ = uniform(-200.0, -5.0);
    greatest_ = uniform(5.0, 200.0);
    lowest_ = least_;
    highest_ = greatest_;
    use_limits(data, least_, greatest_);
    data.PositionLimits_SW.LimitReachedBehavior = pick(2);
    data.PositionLimits_SW.LimitExceededBehavior = pick(2);
    data.DynamicLimits.MaxDeceleration = uniform(1500.0, 20000.0);
    data.DynamicLimits.MaxAcceleration = uniform(1500.0, 20000.0);
    data.DynamicLimits.MaxJerk = uniform(20000.0, 1e6);
    data.DynamicDefaults.EmergencyDeceleration = uniform(1000.0, 50000.0);
  }

  void tick() {
    const double last = rig_.position();
    const bool before = controlled_;
    rig_.tick();
    controlled_ = rig_.a.enabled() || (controlled_ && !rig_.a.off());
    alarmed_ = alarmed_ || rig_.a.pending_alarm() == 533;
    passed_ = passed_ || rig_.a.pending_alarm() == 534;
    if (!before || !controlled_) {
      // Switched off it goes where the drive runs out to; from there it may only come back.
      highest_ = std::max(greatest_, rig_.position());
      lowest_ = std::min(least_, rig_.position());
      return;
    }
    furthest_ = std::max({furthest_, rig_.position() - highest_, lowest_ - rig_.position()});
    if (last <= greatest_) highest_ = greatest_;
    if (last >= least_) lowest_ = least_;
  }

  template <class B>
  void start(B& block) {
    block.Execute = false;
    tick();
    block.Execute = true;
  }
  template <class B>
  void set_dynamics(B& block) {
    if constexpr (requires { block.Acceleration; }) block.Acceleration = uniform(200.0, 10000.0);
    block.Deceleration = uniform(200.0, 10000.0);
    block.Jerk = chance(0.3) ? 0.0 : uniform(2000.0, 500000.0);
  }

  void act() {
    switch (pick(10)) {
      case 0:
        rig_.move.Position = chance(0.3) ? greatest_ : uniform(-300.0, 300.0);
        rig_.move.Velocity = uniform(5.0, 800.0);
        set_dynamics(rig_.move);
        return start(rig_.move);
      case 1:
        rig_.relative.Distance = uniform(-300.0, 300.0);
        rig_.relative.Velocity = uniform(5.0, 800.0);
        set_dynamics(rig_.relative);
        return start(rig_.relative);
      case 2:
      case 3:
        rig_.run_a.Velocity = uniform(-800.0, 800.0);
        set_dynamics(rig_.run_a);
        return start(rig_.run_a);
      case 4:
        rig_.jog.Velocity = uniform(0.0, 500.0);
        rig_.jog.JogForward = chance(0.5);
        rig_.jog.JogBackward = !rig_.jog.JogForward && chance(0.5);
        return;
      case 5:
        set_dynamics(rig_.halt);
        return start(rig_.halt);
      case 6:
        rig_.run_l.Velocity = uniform(-300.0, 300.0);
        start(rig_.run_l);
        rig_.gear.RatioNumerator = pick(2) * 2 - 1;
        set_dynamics(rig_.gear);
        return start(rig_.gear);
      case 7:
        rig_.run_l.Velocity = uniform(-300.0, 300.0);
        set_dynamics(rig_.run_l);
        return start(rig_.run_l);
      case 8:
        rig_.a.data.Override.Velocity = uniform(0.0, 200.0);
        return;
      default:
        rig_.power.StopMode = chance(0.5) ? INT{0} : INT{2};
        rig_.power.Enable = !rig_.power.Enable || chance(0.3);
        return;
    }
  }

  void reset() {
    start(rig_.reset);
    rig_.jog.JogForward = rig_.jog.JogBackward = false;
  }

  std::mt19937_64 random_;
  double least_ = 0.0;
  double greatest_ = 0.0;
  double lowest_ = 0.0;  // what is permitted now
  double highest_ = 0.0;
  double furthest_ = 0.0;
  bool controlled_ = true;
  bool alarmed_ = false;
  bool passed_ = false;
  Limited rig_;
};

TEST(SoftwareLimits, AreNeverLeftByRandomJobs) {
  constexpr std::uint64_t kFirstSeed = 533;
  const bool soak = std::getenv("LOCKSTEP_SOAK") != nullptr;
  const int count = soak ? 100000 : 1000;
  int alarmed = 0;
  double furthest = 0.0;
  for (int i = 0; i < count && !HasFatalFailure(); ++i) {
    const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(i);
    RandomJobs jobs(seed);
    const double outside = jobs.run();
    furthest = std::max(furthest, outside);
    ASSERT_LE(outside, kRounding) << "seed " << seed;
    EXPECT_FALSE(jobs.passed()) << "seed " << seed;
    if (jobs.alarmed()) ++alarmed;
  }
  EXPECT_GT(alarmed, count / 2);
  std::printf("%d runs from seed %llu on, %d of them to a limit, at most %g outside\n", count,
              static_cast<unsigned long long>(kFirstSeed), alarmed, furthest);
}

}  // namespace
}  // namespace lockstep
