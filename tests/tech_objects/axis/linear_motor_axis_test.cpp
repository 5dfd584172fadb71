// An axis whose drive is a linear motor: what moves it is the force of a current.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/torque.hpp"
#include "tech_objects/drive/drive_models.hpp"
#include "tech_objects/types/published.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::linear_motor_axis_test {
namespace {

using test::Rig;

constexpr double kMass = 0.829 + 1.2;  // [kg]

const DriveModel* model() {
  for (const DriveModel& one : kDriveModels)
    if (one.name == "linear_motor") return &one;
  return nullptr;
}

struct Options {
  bool dsc = false;
  double inclination = 0.0;
  bool brake = false;
  bool stop = false;
  bool feed_forward = true;
  double friction = 10.0;
};

struct Slide : Rig {
  explicit Slide(const Options& options)
      : a(axis("Slide",
               [&](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.Actor.MotorType = MotorType::linear;
                 data.Actor.LinearMotorDriveParameter.MaxVelocity = 2000.0;
                 data.Actor.Interface.EnableTorqueData = true;
                 data.PositionControl.EnableDSC = options.dsc;
                 data.PositionControl.Kv = 20.0;
                 data.DynamicLimits.MaxVelocity = 1000.0;
                 data.DynamicLimits.Velocity = 1000.0;
                 data.DynamicLimits.MaxAcceleration = 30'000.0;
                 data.DynamicLimits.MaxDeceleration = 30'000.0;
                 data.DynamicDefaults.EmergencyDeceleration = 20'000.0;
                 data.FollowingError.MinValue = 5.0;
                 data.FollowingError.MaxValue = 5.0;
                 data.Clamping.FollowingErrorDeviation = 1.0;
                 data.Clamping.PositionTolerance = 0.5;
                 data.PositioningMonitoring.Window = 0.3;
                 data.PositioningMonitoring.MinDwellTime = 0.02;
               })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        move(block<MC_MoveAbsolute>()) {
    a.drive_model = model();
    LinearMotorSettings& motor = a.drive_settings.linear_motor;
    motor.force_constant = 40.0;
    motor.brake = options.brake;
    motor.loop = {.proportional = 1.0, .derivative = 4.0, .maximum_current = 5.0};
    if (options.feed_forward) {
      motor.loop.friction = options.friction / 40.0;
      motor.loop.acceleration = motor.loop.deceleration = 1000.0 * kMass / 40.0;
    }
    motor.plant.slider_mass = 0.829;
    motor.plant.load_mass = 1.2;
    motor.plant.friction = options.friction;
    motor.plant.inclination = options.inclination;
    if (options.stop) motor.plant.stops = {{.position = 35.0, .stiffness = 1e6, .damping = 1500.0}};
    a.drive_settings.faults.drive = &fault;
    power.Axis = move.Axis = &a;
    continuity[0].velocity = false;
  }
  void switch_on() {
    power.Enable = true;
    EXPECT_TRUE(run_until([&] { return power.Status; }));
    home.Axis = &a;
    home.Mode = 0;
    home.Execute = true;
    EXPECT_TRUE(run_until([&] { return home.Done; }));
  }
  // @return the greatest difference between setpoint and machine on the way, with the lag of a servo cycle
  double go(double position, double velocity = 500.0, double acceleration = 10'000.0) {
    move.Position = position;
    move.Velocity = velocity;
    move.Acceleration = move.Deceleration = acceleration;
    move.Jerk = 0.0;
    move.Execute = true;
    double greatest = 0.0;
    EXPECT_TRUE(run_until([&] {
      greatest = std::max(greatest, std::abs(a.data.StatusPositioning.FollowingError));
      return move.Done || move.Error || move.CommandAborted;
    }));
    move.Execute = false;
    return greatest;
  }
  const LinearMotorDrive& drive() const { return static_cast<const LinearMotorDrive&>(a.drive()); }

  Axis& a;
  MC_Power& power;
  MC_Home& home;
  MC_MoveAbsolute& move;
  BOOL fault = false;
};

class LinearMotorAxis : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutDsc, LinearMotorAxis, ::testing::Bool());

TEST_P(LinearMotorAxis, Positions) {
  Slide rig({.dsc = GetParam()});
  rig.switch_on();
  const double error = rig.go(100.0);
  EXPECT_TRUE(rig.move.Done);
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.5);
  rig.run(500);
  // Dry friction keeps it within friction / (c_f P) of its target.
  EXPECT_NEAR(rig.drive().plant().position(), 100.0, 0.25);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
}

// Without feed-forward the position loop alone makes the force of the acceleration and against the friction.
TEST_P(LinearMotorAxis, FollowsTheWorseTheLessItKnowsOfItsLoad) {
  Slide blind({.dsc = GetParam(), .feed_forward = false}), told({.dsc = GetParam()});
  blind.switch_on();
  told.switch_on();
  const double without = blind.go(100.0);
  const double with = told.go(100.0);
  EXPECT_TRUE(blind.move.Done);
  EXPECT_GT(without, 2.0 * with);
}

TEST(LinearMotorAxisForce, IsThatOfMassAccelerationAndFriction) {
  Slide rig({});
  rig.switch_on();
  rig.move.Position = 400.0;
  rig.move.Velocity = 900.0;
  rig.move.Acceleration = rig.move.Deceleration = 10'000.0;
  rig.move.Jerk = 0.0;
  rig.move.Execute = true;
  rig.run(60);  // in the middle of the ramp of 90 ms
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, kMass * 10.0 + 10.0, 0.3);
  rig.run(60);
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, 10.0, 0.3);
}

TEST(LinearMotorAxisForce, IsLimitedInNewtonsAndFindsAFixedStop) {
  Slide rig({.stop = true});
  auto& limiting = rig.block<MC_TorqueLimiting>();
  rig.switch_on();
  limiting.Axis = &rig.a;
  limiting.Limit = 60.0;
  limiting.Mode = 1;
  limiting.Enable = true;
  rig.go(80.0, 100.0);
  EXPECT_TRUE(rig.move.CommandAborted);
  ASSERT_TRUE(rig.run_until([&] { return limiting.InClamping; }));
  rig.run(300);
  EXPECT_TRUE(limiting.InLimitation);
  EXPECT_NEAR(rig.a.data.StatusTorqueData.ActualTorque, 60.0, 0.01);
  // Its friction carries a part of the force.
  EXPECT_NEAR(rig.drive().plant().position(), 35.0 + 60.0 / 1e6 * 1000.0, 0.011);
  // The target has not run away: the way back begins at once.
  rig.go(10.0, 100.0);
  EXPECT_TRUE(rig.move.Done);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
}

TEST(LinearMotorAxisFault, TakesItsCurrentUntilMC_ResetAcknowledges) {
  Slide rig({});
  auto& reset = rig.block<MC_Reset>();
  reset.Axis = &rig.a;
  rig.switch_on();
  rig.move.Position = 200.0;
  rig.move.Velocity = 500.0;
  rig.move.Acceleration = rig.move.Deceleration = 10'000.0;
  rig.move.Jerk = 0.0;
  rig.move.Execute = true;
  rig.run(100);
  ASSERT_GT(rig.drive().plant().velocity(), 100.0);
  rig.fault = true;
  rig.run(2);
  EXPECT_EQ(rig.drive().current(), 0.0);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault);
  rig.run(500);  // friction alone brings it to rest
  EXPECT_EQ(rig.drive().plant().velocity(), 0.0);
  rig.fault = false;
  rig.move.Execute = false;
  rig.run(1);
  reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return reset.Done; }));
  ASSERT_TRUE(rig.run_until([&] { return rig.a.enabled(); }));
  rig.go(0.0);
  EXPECT_TRUE(rig.move.Done);
}

// A weight without friction falls as long as there is no current, unless a brake holds it.
TEST(LinearMotorAxisWeight, FallsWithoutCurrentUnlessABrakeHoldsIt) {
  Slide held({.inclination = 90.0, .brake = true, .friction = 0.0});
  held.run(500);
  EXPECT_EQ(held.drive().plant().position(), 0.0);
  Slide loose({.inclination = 90.0, .friction = 0.0});
  loose.run(500);
  EXPECT_NEAR(loose.drive().plant().position(), -0.5 * 9810.0 * 0.25, 10.0);
}

TEST(LinearMotorAxisWeight, IsCarriedByTheOffsetOfTheCurrent) {
  Slide rig({.inclination = 90.0, .brake = true, .friction = 0.0});
  rig.a.drive_settings.linear_motor.loop.offset = kMass * 9.81 / 40.0;
  rig.switch_on();
  rig.go(50.0);
  EXPECT_TRUE(rig.move.Done);
  rig.run(500);
  EXPECT_NEAR(rig.drive().plant().position(), 50.0, 1e-3);
  rig.power.Enable = false;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.off(); }));
  rig.run(500);
  EXPECT_NEAR(rig.drive().plant().position(), 50.0, 0.05);
  EXPECT_EQ(rig.drive().current(), 0.0);
}

TEST(LinearMotorAxisStop, EndsAMotionByTheDriveItselfWhenItIsSwitchedOff) {
  Slide rig({});
  rig.switch_on();
  rig.move.Position = 400.0;
  rig.move.Velocity = 500.0;
  rig.move.Acceleration = rig.move.Deceleration = 10'000.0;
  rig.move.Jerk = 0.0;
  rig.move.Execute = true;
  rig.run(150);
  ASSERT_GT(rig.drive().plant().velocity(), 400.0);
  rig.power.StopMode = 1;
  rig.power.Enable = false;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.off(); }));
  EXPECT_NEAR(rig.drive().plant().velocity(), 0.0, 1.0);
}

}  // namespace
}  // namespace lockstep::linear_motor_axis_test
