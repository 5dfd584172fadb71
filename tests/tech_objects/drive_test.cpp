#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tech_objects/drive/position_controller.hpp"
#include "tech_objects/drive/simulated_drive.hpp"

namespace lockstep::drive_test {
namespace {

constexpr double kCycle = 0.001;
constexpr Modulo kRing{true, 360.0, 0.0};
constexpr Modulo kLine{};

/// An axis with its drive, one servo cycle at a time.
struct Loop {
  SimulatedDrive drive;
  PositionController controller;
  Modulo modulo;
  AxisPosition origin{};
  AxisPosition actual{};
  DriveActual reported{};
  PositionControlled last{};

  Loop(const DriveSettings& settings, double kv, const Modulo& ring, double kpc = 100.0) : modulo(ring) {
    const DriveProperties properties = drive.configure(settings, kCycle, 1.0);
    drive.enable(true);
    controller.configure({kv, kpc, properties.known_delay}, kCycle);
    controller.reset(origin);
  }

  void cycle(AxisPosition setpoint, double velocity) {
    reported = drive.read();
    actual = advanced(origin, reported.position, modulo);
    last = controller.step(setpoint, velocity, actual, modulo);
    drive.write(last.velocity);
  }

  /// Largest control difference while the axis runs up with `acceleration` to `velocity` and holds it.
  double run_up(double acceleration, double velocity, int cycles) {
    double largest = 0.0;
    for (int i = 0; i < cycles; ++i) {
      const double time = i * kCycle;
      const double ramp = velocity / acceleration;
      const double distance = time < ramp ? 0.5 * acceleration * time * time : velocity * (time - 0.5 * ramp);
      cycle(advanced(origin, distance, modulo), std::min(acceleration * time, velocity));
      largest = std::max(largest, std::abs(last.control_difference));
    }
    return largest;
  }
};

TEST(SimulatedDrive, FollowsAVelocityStepAsAFirstOrderLag) {
  SimulatedDrive drive;
  drive.configure({0.002, 0.0, 0.0}, kCycle, 1.0);
  drive.enable(true);
  for (int i = 1; i <= 20; ++i) {
    drive.write(100.0);
    const DriveActual actual = drive.read();
    const double time = i * kCycle;
    EXPECT_NEAR(actual.velocity, 100.0 * (1.0 - std::exp(-time / 0.002)), 1e-12);
    EXPECT_NEAR(actual.position.rounded(), 100.0 * (time - 0.002 * (1.0 - std::exp(-time / 0.002))), 1e-13);
  }
}

TEST(SimulatedDrive, DeadTimeShiftsTheResponseByPartsOfACycleToo) {
  for (const double dead : {0.0, 0.0004, 0.001, 0.0027, 0.1, 0.254}) {
    SimulatedDrive drive;
    drive.configure({0.003, dead, 0.0}, kCycle, 1.0);
    drive.enable(true);
    for (int i = 1; i <= 300; ++i) {
      drive.write(50.0);
      const double time = std::max(0.0, i * kCycle - dead);
      const double lag = 0.003 * (1.0 - std::exp(-time / 0.003));
      ASSERT_NEAR(drive.read().position.rounded(), 50.0 * (time - lag), 1e-12) << dead << " cycle " << i;
    }
  }
}

TEST(SimulatedDrive, WithoutLagItMovesByWhatIsWritten) {
  SimulatedDrive drive;
  drive.configure({}, kCycle, 1.0);
  drive.enable(true);
  for (int i = 0; i < 1000; ++i) drive.write(8.0);
  EXPECT_EQ(drive.read().velocity, 8.0);
  EXPECT_NEAR(drive.read().position.rounded(), 8.0, 1e-15);
}

TEST(SimulatedDrive, TheEncoderReportsWholeIncrements) {
  SimulatedDrive drive;
  drive.configure({0.0, 0.0, 0.25}, kCycle, 1.0);
  drive.enable(true);
  for (int i = 1; i <= 2000; ++i) {
    drive.write(-33.0);
    const double reported = drive.read().position.rounded();
    EXPECT_EQ(reported * 4.0, std::floor(reported * 4.0));
    EXPECT_LE(std::abs(reported + 0.033 * i), 0.125 + 1e-9);
  }
}

// A drive whose position loop runs without gain, once in a servo cycle, computes the same in every cycle.
TEST(SimulatedDrive, AtRestItIsToTheBitWhereOneIsThatGoesOnComputing) {
  DriveSettings settings{0.002, 0.003, 0.0};
  settings.position_cycle = kCycle;
  SimulatedDrive resting, computing;
  for (SimulatedDrive* const drive : {&resting, &computing}) {
    drive->configure(settings, kCycle, 1.0);
    drive->enable(true);
  }
  for (int i = 0; i < 48'000; ++i) {
    // From its start it rests, then it moves five times; each rest is long enough to lose all digits.
    const double velocity = i % 8000 < 50 ? 100.0 * (i / 8000) : 0.0;
    resting.write(velocity);
    computing.write_position({.velocity = velocity});
    const DriveActual a = resting.read(), b = computing.read();
    ASSERT_TRUE(same_bits(a.position, b.position)) << "cycle " << i;
    ASSERT_TRUE(same_bits({a.velocity, 0.0}, {b.velocity, 0.0})) << "cycle " << i;
  }
}

TEST(SimulatedDrive, SwitchedOffItCoastsToRestAndTakesNoSetpoint) {
  SimulatedDrive drive;
  drive.configure({0.002, 0.001, 0.0}, kCycle, 1.0);
  drive.write(100.0);
  EXPECT_EQ(drive.read().velocity, 0.0);
  drive.enable(true);
  for (int i = 0; i < 100; ++i) drive.write(100.0);
  drive.enable(false);
  double before = drive.read().velocity;
  for (int i = 0; i < 200; ++i) {
    drive.write(100.0);
    EXPECT_LE(drive.read().velocity, before);
    before = drive.read().velocity;
  }
  EXPECT_LT(before, 1e-12);
  EXPECT_FALSE(drive.read().enabled);
}

TEST(SimulatedDrive, StopsAMachineThatWasHeldBackWithoutSpeedingItUpFirst) {
  bool blocked = false;
  DriveSettings settings;
  settings.time_constant = 0.005;
  settings.quick_stop = 1000.0;
  settings.faults.blocked = &blocked;
  SimulatedDrive drive;
  drive.configure(settings, kCycle, 1.0);
  drive.enable(true);
  double fastest = 0.0;
  const auto run = [&](int cycles) {
    fastest = 0.0;
    for (int i = 0; i < cycles; ++i) {
      fastest = std::max(fastest, std::abs(drive.read().velocity));
      drive.write(400.0);
    }
  };
  run(200);
  ASSERT_NEAR(fastest, 400.0, 1e-3);
  blocked = true;
  run(50);
  drive.control(kControlQuickStop, 0);
  run(2);
  blocked = false;
  run(400);
  EXPECT_LT(fastest, 1.0);
}

TEST(PositionController, ConstantVelocityLeavesNoControlDifference) {
  for (const double kv : {10.0, 30.0, 100.0}) {
    Loop loop({0.002, 0.001, 0.0}, kv, kRing);
    const double largest = loop.run_up(5000.0, 500.0, 3000);
    // The delay stands for the lag up to its second order: acceleration · (τ² + …) / 2 is left.
    EXPECT_LE(largest, 5000.0 * 0.002 * 0.002) << kv;
    EXPECT_NEAR(loop.last.control_difference, 0.0, 1e-9) << kv;
    EXPECT_NEAR(loop.last.velocity, 500.0, 1e-7);
    EXPECT_GE(loop.actual.turns, 3) << "has not crossed the ends of the ring";
  }
}

TEST(PositionController, WithoutPrecontrolTheDifferenceIsVelocityOverKv) {
  Loop loop({0.002, 0.001, 0.0}, 50.0, kLine, 0.0);
  loop.run_up(1000.0, 100.0, 3000);
  EXPECT_NEAR(loop.last.control_difference, 100.0 / 50.0, 1e-9);
}

TEST(PositionController, AStepOfTheSetpointSettlesWithoutMuchOvershoot) {
  for (const double kv : {10.0, 50.0, 100.0}) {
    Loop loop({0.002, 0.001, 0.0}, kv, kLine);
    double highest = 0.0;
    for (int i = 0; i < static_cast<int>(20.0 / kv / kCycle); ++i) {
      loop.cycle({0, 10.0}, 0.0);
      highest = std::max(highest, loop.actual.value);
    }
    EXPECT_LE(highest, 10.0 * 1.05) << kv;
    EXPECT_NEAR(loop.actual.value, 10.0, 1e-4) << kv;
  }
}

TEST(PositionController, TheVelocitySetpointStaysWithinTheDrivesSpeed) {
  PositionController controller;
  controller.configure({100.0, 100.0, 0.0, 50.0}, kCycle);
  controller.reset({});
  PositionControlled out = controller.step({0, 10.0}, 0.0, {}, kLine);
  EXPECT_EQ(out.velocity, 50.0);
  EXPECT_TRUE(out.limited);
  out = controller.step({0, 0.1}, 0.0, {}, kLine);
  EXPECT_EQ(out.velocity, 10.0);
  EXPECT_FALSE(out.limited);
}

TEST(PositionController, BalancingDelaysTheSetpointByPartsOfACycleAcrossTheRing) {
  PositionController controller;
  controller.configure({10.0, 100.0, 0.0025}, kCycle);
  AxisPosition setpoint{4, 350.0};
  controller.reset(setpoint);
  for (int i = 1; i <= 40; ++i) {
    setpoint = advanced(setpoint, 1.0, kRing);
    const PositionControlled out = controller.step(setpoint, 1000.0, setpoint, kRing);
    ASSERT_NEAR(out.control_difference, -std::min(2.5, i * 1.0), i < 3 ? 0.6 : 1e-12);
    ASSERT_TRUE(kRing.contains(out.balanced.value));
  }
  EXPECT_EQ(setpoint.turns, 5);
}

TEST(PositionController, ACoarseEncoderKeepsTheAxisWithinAnIncrement) {
  Loop loop({0.002, 0.001, 0.1}, 50.0, kRing);
  loop.run_up(1000.0, 100.0, 4000);
  for (int i = 0; i < 1000; ++i) {
    loop.cycle(advanced(loop.origin, 100.0 * ((4000 + i) * kCycle - 0.05), kRing), 100.0);
    ASSERT_LE(std::abs(loop.last.control_difference), 0.2);
  }
}

TEST(PositionController, TwoRunsAreIdenticalToTheBit) {
  const auto run = [] {
    Loop loop({0.0021, 0.0013, 0.01}, 77.0, kRing);
    std::vector<double> velocities;
    for (int i = 0; i < 2000; ++i) {
      loop.cycle(advanced(loop.origin, 0.0001 * i * i, kRing), 0.2 * i);
      velocities.push_back(loop.last.velocity);
    }
    return velocities;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace lockstep::drive_test
