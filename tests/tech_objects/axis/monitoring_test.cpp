// What an axis with a drive watches over, through the blocks: following error, standstill, positioning.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/limited_axis.hpp"

namespace lockstep::monitoring_test {
namespace {

using test::bit;
using test::Limited;

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
  EXPECT_EQ(find_alarm(alarm::kFollowingErrorWarning)->warning_bit,
            static_cast<int>(WarningBit::FollowingErrorWarning));
  bool warned = false;
  double maximum = 0.0;
  double velocity = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    warned = warned || (rig.a.pending_alarm() == 0 &&
                        has_bit(rig.a.data.WarningWord, WarningBit::FollowingErrorWarning));
    maximum = std::max(maximum, std::abs(rig.a.data.StatusPositioning.FollowingError));
    if (rig.a.pending_alarm() != 0) return true;
    velocity = rig.a.data.Velocity;
    return false;
  }));
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 521u);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 4);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::FollowingErrorFault));
  EXPECT_TRUE(warned);
  // 2 mm up to 100 mm/s, 20 mm at 1000 mm/s.
  EXPECT_NEAR(maximum, 2.0 + 18.0 * (velocity - 100.0) / 900.0, 0.2);
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
  double maximum = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    const double error = rig.a.data.StatusPositioning.FollowingError;
    maximum = std::max(maximum, error);
    if (at_warning == 0.0 && has_bit(rig.a.data.WarningWord, WarningBit::FollowingErrorWarning))
      at_warning = error;
    return rig.a.pending_alarm() != 0;
  }));
  EXPECT_EQ(rig.a.pending_alarm(), 521);
  EXPECT_NEAR(maximum, 1.0, 0.03);
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

}  // namespace
}  // namespace lockstep::monitoring_test
