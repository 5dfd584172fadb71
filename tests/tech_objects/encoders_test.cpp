// The encoders of an axis, without the axis.
#include "tech_objects/axis/encoders.hpp"

#include <gtest/gtest.h>

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
    actual = encoders.position_at(now.position);
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

}  // namespace
}  // namespace lockstep::encoders_test
