// The encoders of an axis, without the axis.
#include "tech_objects/axis/encoders.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "tech_objects/drive/simulated_drive.hpp"

namespace lockstep::encoders_test {
namespace {

constexpr double kCycle = 0.001;

/// A machine with the encoder of its motor, and another that tells a tenth more.
struct Machine {
  AxisData data;
  DriveSettings settings;
  SimulatedDrive drive;
  Encoders encoders;
  AxisPosition actual;

  explicit Machine(DINT type = 0) {
    data.Sensor[1].Existent = true;
    data.Sensor[1].Type = type;
    settings.sensors[0] = {.exists = true, .ratio = 1.1};
    drive.configure(settings, kCycle, 1.0);
    drive.enable(true);
    encoders.configure(data, settings, true, {}, kCycle);
    encoders.begin(encoders.origin_at(0, {}, 0.0));
    encoders.begin_beside(1, encoders.origin_at(1, {}, 0.0), 0.0);
    cycle(0.0);
  }

  void cycle(double velocity) {
    DriveActual now = drive.read();
    encoders.count(now.position);
    encoders.read(now, drive);
    encoders.orient(now);
    for (std::size_t i = 0; i < Encoders::kCount; ++i)
      if (encoders.beside(i)) encoders.watch(i, 0.0, data.StatusSensor[i]);
    actual = encoders.read_position(now.position);
    drive.write(velocity);
  }
  void go(double distance) {
    for (int i = 0; i < 1000; ++i) cycle(distance);
    cycle(0.0);
  }
};

TEST(Encoders, TellTheirOwnDistanceOfTheSameMotion) {
  Machine machine;
  machine.go(100.0);
  EXPECT_NEAR(machine.actual.value, 100.0, 1e-9);
  EXPECT_NEAR(machine.encoders.position(1, machine.actual).value, 110.0, 1e-9);
  EXPECT_TRUE(machine.encoders.several());
  EXPECT_FALSE(machine.encoders.exists(2));
}

TEST(Encoders, AreSwitchedToWithTheirOwnPosition) {
  Machine machine;
  machine.go(100.0);
  machine.encoders.switch_to(1, machine.actual);
  machine.cycle(0.0);
  EXPECT_EQ(machine.encoders.operative(), 1u);
  EXPECT_NEAR(machine.actual.value, 110.0, 1e-9);
  EXPECT_DOUBLE_EQ(machine.encoders.ratio(), 1.1);
}

TEST(Encoders, GiveBackWhatAnAbsoluteOneHasBeenLentWhenItIsLeft) {
  Machine machine(1);
  machine.go(100.0);
  machine.encoders.place(1, machine.actual, machine.actual, 0.0);  // aligned
  machine.encoders.switch_to(1, machine.actual);
  machine.cycle(0.0);
  EXPECT_NEAR(machine.actual.value, 100.0, 1e-9);
  machine.encoders.switch_to(0, machine.actual);
  EXPECT_NEAR(machine.encoders.position(1, machine.actual).value, 110.0, 1e-9);
}

TEST(Encoders, HaveAnOffsetByWhichAnAbsoluteOneFindsItsPlaceAgain) {
  Machine machine(1);
  machine.go(100.0);
  machine.encoders.rename(1, 25.0);
  const double offset = machine.encoders.offset(1, 0);
  EXPECT_NEAR(offset, 25.0, 1e-9);
  EXPECT_NEAR(machine.encoders.adjusted_origin(1, offset).value, 25.0, 1e-9);
}

TEST(Encoders, GoOnFromWhereTheyWereSeenLastOnceTheyAreBack) {
  bool fault = false;
  Machine machine;
  machine.settings.sensors[0].fault = &fault;
  machine.drive.configure(machine.settings, kCycle, 1.0);
  machine.drive.enable(true);
  machine.go(10.0);
  const double seen = machine.encoders.position(1, machine.actual).value;
  fault = true;
  machine.go(10.0);
  EXPECT_FALSE(machine.encoders.valid(1));
  EXPECT_TRUE(machine.data.StatusSensor[1].Error);
  fault = false;
  machine.cycle(0.0);
  EXPECT_TRUE(machine.encoders.valid(1));
  EXPECT_NEAR(machine.encoders.position(1, machine.actual).value, seen, 1e-9);
}

// Over millions of turns it is where it would be if each cycle began anew, to the bit.
TEST(Encoders, AreOnTheRingWithoutBringingThemThereInEachCycle) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    const auto of = [&random](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const Modulo ring{
        .enabled = true, .length = seed % 3 == 0 ? 360.0 : of(0.01, 5000.0), .start = of(-500.0, 500.0)};
    Encoders encoders;
    encoders.configure({}, {}, true, ring, kCycle);
    encoders.begin(normalised({0, of(-1e4, 1e4)}, ring));
    DoubleDouble distance;
    double velocity = 0.0;
    for (int i = 0; i < 5000; ++i) {
      if (random() % 50 == 0) velocity = of(-1.0, 1.0) * ring.length * (random() % 10 == 0 ? 1e5 : 0.3);
      if (random() % 700 == 0) encoders.shift(of(-1.0, 1.0) * ring.length);
      distance = distance + velocity;
      ASSERT_EQ(encoders.read_position(distance), encoders.position_at(distance))
          << "seed " << seed << ", cycle " << i;
    }
  }
}

}  // namespace
}  // namespace lockstep::encoders_test
