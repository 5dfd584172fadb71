// Axes with a simulated drive in a position loop.
#include <gtest/gtest.h>

#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::driven_axis_test {
namespace {

using test::Rig;

/// A virtual leading axis and a driven following one.
struct Driven : Rig {
  explicit Driven(int ratio = 1, double resolution = 0.0)
      : Rig(1'000'000, ratio),
        l(axis("Leading")),
        f(axis("Following",
               [](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.Modulo.Enable = true;
                 data.Properties.MotionType = 1;
               })),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        move(block<MC_MoveAbsolute>()),
        free(block<MC_MoveVelocity>()) {
    f.drive_settings = {.time_constant = 0.002, .dead_time = 0.001, .resolution = resolution};
    lead(f, l);
    power_l.Axis = run_l.Axis = &l;
    power_f.Axis = home.Axis = move.Axis = free.Axis = &f;
    gear.Master = &l;
    gear.Slave = &f;
    power_l.Enable = power_f.Enable = true;
    Rig::run(10 * ratio);
    home.Execute = true;
    Rig::run(10 * ratio);
  }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home;
  MC_MoveVelocity& run_l;
  MC_GearIn& gear;
  MC_MoveAbsolute& move;
  MC_MoveVelocity& free;
};

class DrivenAxis : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, DrivenAxis, ::testing::Values(1, 2, 4, 32));

TEST_P(DrivenAxis, ReachesItsTargetWithDriveAndEncoder) {
  Driven rig(GetParam());
  EXPECT_TRUE(rig.power_f.Status);
  rig.move.Position = 123.0;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  rig.run(500);
  EXPECT_EQ(rig.f.data.Position, 123.0);
  EXPECT_NEAR(rig.f.data.ActualPosition, 123.0, 1e-3);
}

TEST_P(DrivenAxis, FollowsAGearWithoutFollowingErrorAtConstantVelocityOverManyTurns) {
  Driven rig(GetParam());
  rig.gear.RatioNumerator = 3;
  rig.gear.Execute = true;
  rig.run_l.Velocity = 400.0;
  rig.run_l.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear && rig.run_l.InVelocity; }));
  rig.run(2000);
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.f.data.StatusPositioning.FollowingError, 0.0, 1e-6);
  }
  EXPECT_NEAR(rig.f.data.ActualVelocity, 1200.0, 1e-6);
  EXPECT_NEAR(rig.f.data.ActualSpeed, 200.0, 1e-6);
  EXPECT_GT(rig.f.data.ActualModuloCycle, 10);
}

TEST(DrivenAxisMissedTicks, MakeTheSetpointWaitAsTheDriveDoes) {
  Driven rig(4);
  rig.free.Velocity = 400.0;
  rig.free.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.free.InVelocity; }));
  rig.run(4001);
  const auto balanced = [&] { return rig.f.data.StatusServo.BalancedPosition; };
  const double before = balanced();
  const std::int64_t ticks = rig.controller.now() / 1'000'000;
  for (int i = 1; i <= 40; ++i) {
    rig.controller.skip(i % 3);
    rig.run(1);
    ASSERT_NEAR(std::remainder(balanced() - before - i * 0.4, 360.0), 0.0, 1e-9);
    ASSERT_NEAR(rig.f.data.StatusPositioning.FollowingError, 0.0, 1e-9);
    ASSERT_NEAR(rig.f.data.ActualVelocity, 400.0, 1e-6);
  }
  EXPECT_EQ(rig.controller.now() / 1'000'000 - ticks, 80);
}

TEST(DrivenAxisWithEncoder, SettlesWithinAnIncrementOfItsTarget) {
  Driven rig(1, 0.01);
  rig.move.Position = 45.0;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  rig.run(1000);
  EXPECT_NEAR(rig.f.data.ActualPosition, 45.0, 0.0101);
}

TEST(DrivenAxisPower, SwitchedOffInMotionItsSetpointFollowsTheCoastingAxis) {
  Driven rig;
  rig.free.Velocity = 500.0;
  rig.free.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.free.InVelocity; }));
  rig.continuity[1].velocity = false;
  rig.power_f.StopMode = 3;
  rig.power_f.Enable = false;
  rig.run(2);
  EXPECT_TRUE(rig.free.CommandAborted);
  EXPECT_FALSE(rig.power_f.Status);
  ASSERT_TRUE(rig.run_until([&] { return std::abs(rig.f.data.ActualVelocity) < 1e-3; }));
  rig.run(2);
  EXPECT_NEAR(rig.f.data.Position, rig.f.data.ActualPosition, 1e-6);
}

TEST(DrivenAxisPower, HomingShiftsSetpointAndActualPositionTogether) {
  Driven rig;
  rig.free.Velocity = 100.0;
  rig.free.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.free.InVelocity; }));
  rig.run(3000);
  const double error = rig.f.data.StatusPositioning.FollowingError;
  rig.home.Execute = false;
  rig.run(2);
  rig.continuity[1].velocity = false;
  rig.home.Mode = 1;
  rig.home.Position = 90.0;
  rig.home.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.home.Done);
  rig.continuity[1].velocity = true;
  rig.run(20);
  EXPECT_NEAR(rig.f.data.StatusPositioning.FollowingError, error, 1e-9);
  EXPECT_NEAR(rig.f.data.ActualVelocity, 100.0, 1e-6);
}

}  // namespace
}  // namespace lockstep::driven_axis_test
