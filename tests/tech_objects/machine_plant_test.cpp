// What a simulated drive moves: torque, friction, load and a fixed stop.
#include "tech_objects/drive/machine_plant.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tech_objects/drive/simulated_drive.hpp"

namespace lockstep::machine_plant_test {
namespace {

constexpr double kCycle = 0.001;

DriveSettings machine(double inertia) {
  DriveSettings settings;
  settings.time_constant = 0.002;
  settings.plant.inertia = inertia;
  return settings;
}

/// A drive that is on.
struct Machine {
  SimulatedDrive drive;
  DriveActual actual;

  explicit Machine(const DriveSettings& settings) {
    drive.configure(settings, kCycle, 1.0);
    drive.enable(true);
  }
  void run(double velocity, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      drive.write(velocity);
      actual = drive.read();
    }
  }
};

TEST(MachinePlant, LeavesADriveWithoutLimitsAndDisturbancesToTheBitAsItIs) {
  DriveSettings without = machine(0.0);
  DriveSettings with = machine(0.25);
  Machine a(without), b(with);
  for (int i = 0; i < 2000; ++i) {
    const double setpoint = i % 300 < 150 ? 0.37 * i : -0.11 * i;
    a.run(setpoint, 1);
    b.run(setpoint, 1);
    ASSERT_EQ(a.actual.position.hi, b.actual.position.hi) << i;
    ASSERT_EQ(a.actual.position.lo, b.actual.position.lo) << i;
    ASSERT_EQ(a.actual.velocity, b.actual.velocity) << i;
  }
}

TEST(MachinePlant, UndisturbedItIsToTheBitOneWhoseStopIsFarAway) {
  DriveSettings near = machine(0.25);
  near.plant.maximum_torque = 30.0;
  DriveSettings far = near;
  far.plant.has_stop = true;
  far.plant.stop = {1e9, 1, 10.0};
  Machine a(near), b(far);
  int limited = 0;
  for (int i = 0; i < 3000; ++i) {
    // Ramps, leaps that take more torque than there is, and rests.
    const double setpoint = i % 900 < 150 ? 0.1 * (i % 900) : i % 900 < 300 ? 40.0 : 0.0;
    a.run(setpoint, 1);
    b.run(setpoint, 1);
    limited += std::abs(a.actual.torque) == 30.0;
    ASSERT_EQ(a.actual.position, b.actual.position) << i;
    ASSERT_EQ(a.actual.velocity, b.actual.velocity) << i;
    ASSERT_EQ(a.actual.torque, b.actual.torque) << i;
  }
  EXPECT_GT(limited, 20);
}

TEST(MachinePlant, AtRestItIsMovedByATorqueThatIsAdded) {
  Machine held(machine(0.5));
  held.run(1.0, 100);
  held.run(0.0, 5000);
  ASSERT_TRUE(held.drive.rests());
  const double before = held.actual.position.rounded();
  held.drive.command_torque({.additive = 1.0});
  held.run(0.0, 10);
  EXPECT_GT(held.actual.position.rounded(), before + 1e-6);
}

TEST(MachinePlant, TakesTheTorqueThatInertiaAndAccelerationAsk) {
  Machine machine_1(machine(0.5));
  // Behind a ramp the lag has the same acceleration.
  for (int i = 1; i <= 100; ++i) machine_1.run(0.4 * i, 1);
  EXPECT_NEAR(machine_1.actual.torque, 0.5 * 400.0, 1e-6);
}

TEST(MachinePlant, AcceleratesWithWhatTheMotorMayMake) {
  DriveSettings settings = machine(0.5);
  settings.plant.maximum_torque = 10.0;
  Machine limited(settings);
  limited.run(1000.0, 500);
  EXPECT_EQ(limited.actual.torque, 10.0);
  EXPECT_NEAR(limited.actual.velocity, 10.0 / 0.5 * 0.5, 1e-9);
  EXPECT_NEAR(limited.actual.position.rounded(), 0.5 * 20.0 * 0.5 * 0.5, 0.02);
}

TEST(MachinePlant, KeepsToTheBandThatIsCommanded) {
  Machine limited(machine(0.5));
  limited.drive.command_torque({{-3.0, 5.0}, 0.0});
  limited.run(1000.0, 10);
  EXPECT_EQ(limited.actual.torque, 5.0);
  limited.run(-1000.0, 10);
  EXPECT_EQ(limited.actual.torque, -3.0);
}

TEST(MachinePlant, HoldsALoadAndFrictionOnceTheDriveHasLearnedThem) {
  DriveSettings settings = machine(0.1);
  settings.plant.friction = 2.0;
  settings.plant.load_torque = -5.0;
  Machine lifting(settings);
  lifting.run(50.0, 2000);
  EXPECT_NEAR(lifting.actual.velocity, 50.0, 1e-9);
  EXPECT_NEAR(lifting.actual.torque, 7.0, 1e-6);
  lifting.run(-50.0, 2000);
  EXPECT_NEAR(lifting.actual.velocity, -50.0, 1e-9);
  EXPECT_NEAR(lifting.actual.torque, 3.0, 1e-6);
}

TEST(MachinePlant, AnAdditiveTorqueThatFitsSavesTheDriveFromLearning) {
  DriveSettings settings = machine(0.1);
  settings.plant.load_torque = -5.0;
  Machine plain(settings), helped(settings);
  helped.drive.command_torque({{}, 5.0});
  plain.run(0.0, 5);
  helped.run(0.0, 5);
  EXPECT_LT(plain.actual.velocity, -0.01);
  EXPECT_NEAR(helped.actual.velocity, 0.0, 1e-12);
  EXPECT_NEAR(helped.actual.torque, 5.0, 1e-12);
}

TEST(MachinePlant, AFixedStopTakesWhatTheMotorMayMake) {
  for (const int side : {1, -1})
    for (const double stiffness : {50.0, 1e4, 1e8}) {
      DriveSettings settings = machine(0.02);
      settings.plant.has_stop = true;
      settings.plant.stop = {side * 10.0, side, stiffness};
      Machine pressing(settings);
      pressing.drive.command_torque({{-25.0, 25.0}, 0.0});
      pressing.run(side * 40.0, 2000);
      EXPECT_NEAR(pressing.actual.torque, side * 25.0, 1e-9) << stiffness;
      EXPECT_NEAR(side * pressing.actual.position.rounded(), 10.0 + 25.0 / stiffness, 1e-6) << stiffness;
      EXPECT_NEAR(pressing.actual.velocity, 0.0, 1e-6) << stiffness;
      pressing.run(side * -40.0, 500);
      EXPECT_NEAR(pressing.actual.velocity, side * -40.0, 1e-3) << "it lets go of what is drawn back";
    }
}

TEST(MachinePlant, WithoutPulsesFrictionStopsTheMachineAndABrakeHoldsIt) {
  DriveSettings settings = machine(0.1);
  settings.plant.friction = 2.0;
  Machine coasting(settings);
  coasting.run(50.0, 2000);
  coasting.drive.control(kControlCoast, 0);
  coasting.run(0.0, 1000);
  EXPECT_NEAR(coasting.actual.velocity, 50.0 - 20.0, 1e-6) << "2 Nm brake 0.1 Nm s² with 20 u/s²";
  EXPECT_EQ(coasting.actual.torque, 0.0);
  coasting.run(0.0, 3000);
  EXPECT_EQ(coasting.actual.velocity, 0.0);
  settings.plant.load_torque = -5.0;
  Machine hanging(settings);
  hanging.drive.control(kControlCoast, 0);
  hanging.run(0.0, 1000);
  EXPECT_EQ(hanging.actual.position.rounded(), 0.0);
}

TEST(MachinePlant, AQuickStopBrakesWithItsDecelerationAndTakesThePulsesAway) {
  DriveSettings settings = machine(0.1);
  settings.quick_stop = 500.0;
  Machine stopping(settings);
  stopping.run(50.0, 200);
  stopping.drive.control(kControlQuickStop, 0);
  stopping.run(50.0, 51);
  EXPECT_NEAR(stopping.actual.velocity, 25.0, 1.0);
  EXPECT_FALSE(stopping.actual.enabled);
  EXPECT_FALSE(stopping.actual.inhibited);
  stopping.run(50.0, 200);
  EXPECT_TRUE(stopping.actual.inhibited);
  EXPECT_NEAR(stopping.actual.velocity, 0.0, 0.06);
}

TEST(MachinePlant, ABlockedMachineStandsWhateverIsAsked) {
  bool blocked = false;
  DriveSettings settings = machine(0.0);
  settings.faults.blocked = &blocked;
  Machine machine_1(settings);
  machine_1.run(50.0, 100);
  blocked = true;
  machine_1.run(50.0, 1);
  const double place = machine_1.actual.position.rounded();
  machine_1.run(50.0, 100);
  EXPECT_EQ(machine_1.actual.position.rounded(), place);
  EXPECT_EQ(machine_1.actual.velocity, 0.0);
  blocked = false;
  machine_1.run(50.0, 100);
  EXPECT_NEAR(machine_1.actual.velocity, 50.0, 1e-9);
}

TEST(SimulatedFaults, OfTheDriveTakeItsPulsesUntilTheyAreAcknowledged) {
  bool failed = false;
  DriveSettings settings = machine(0.0);
  settings.faults.drive = &failed;
  Machine machine_1(settings);
  machine_1.run(10.0, 50);
  failed = true;
  machine_1.run(10.0, 1);
  EXPECT_TRUE(machine_1.actual.fault);
  EXPECT_TRUE(machine_1.actual.trouble);
  EXPECT_FALSE(machine_1.actual.enabled);
  failed = false;
  machine_1.run(10.0, 1);
  EXPECT_TRUE(machine_1.actual.fault);
  machine_1.drive.control(kControlOff | bit_mask(stw1::kAcknowledgeFault), 0);
  machine_1.run(10.0, 1);
  EXPECT_FALSE(machine_1.actual.trouble);
}

TEST(SimulatedFaults, WithoutCommunicationNothingChangesButTheDriveStopsByItself) {
  bool silent = false;
  DriveSettings settings = machine(0.0);
  settings.faults.communication = &silent;
  Machine machine_1(settings);
  machine_1.run(10.0, 50);
  const double place = machine_1.actual.position.rounded();
  silent = true;
  machine_1.run(10.0, 100);
  EXPECT_TRUE(machine_1.actual.silent);
  EXPECT_EQ(machine_1.actual.position.rounded(), place);
  machine_1.drive.control(kControlOn, 0);
  silent = false;
  machine_1.run(10.0, 1);
  EXPECT_TRUE(machine_1.actual.fault);
  EXPECT_NEAR(machine_1.actual.velocity, 0.0, 0.011);
  EXPECT_GT(machine_1.actual.position.rounded(), place);
}

}  // namespace
}  // namespace lockstep::machine_plant_test
