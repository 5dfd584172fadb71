// The device of the MCO 305 in steps: units, positioning, controller, homing, limits, errors.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tech_objects/mco305/device.hpp"

namespace lockstep::mco305 {
namespace {

using Values = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// 3000 RPM, 500 PPR, 500 ms: 100 qc/ms, 0.2 qc/ms².
struct Bench {
  Device device;

  explicit Bench(const Values& values = {}, const DeviceSettings& settings = {}) {
    for (const auto& [number, value] : Values{{kEncoder, 500}, {kVelMax, 3000}, {kRampMin, 500}})
      EXPECT_EQ(device.set_parameter(number, value), 0);
    for (const auto& [number, value] : values) EXPECT_EQ(device.set_parameter(number, value), 0) << number;
    device.configure(settings, 0.001);
    device.set_velocity(100);
    device.set_acceleration(100);
    device.set_deceleration(100);
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  /// What comes up, as a program would take it.
  int step() {
    device.servo(true);
    const int error = device.take_error();
    if (error != 0) device.react(error);
    return error;
  }
  int until_error(int steps) {
    for (int i = 0; i < steps; ++i)
      if (const int error = step(); error != 0) return error;
    return 0;
  }
  int until_arrived(int maximum = 100'000) {
    for (int i = 1; i <= maximum; ++i) {
      step();
      if (device.arrived() && !device.homing()) return i;
    }
    return -1;
  }
  std::int32_t system_variable(std::int32_t index) {
    std::int32_t value = -1;
    EXPECT_TRUE(device.system_variable(index, value)) << index;
    return value;
  }
};

DeviceSettings with_drive() {
  DeviceSettings settings;
  settings.has_drive = true;
  return settings;
}

TEST(Mco305Units, AreCutOnTheWayInAndRoundedOnTheWayOut) {
  constexpr UserUnit kUnit{25, 9, 1};
  EXPECT_EQ(kUnit.counts(3600), 10'000);
  EXPECT_EQ(kUnit.counts(1), 2);
  EXPECT_EQ(kUnit.counts(-1), -2);
  EXPECT_EQ(kUnit.counts(7), 19);
  EXPECT_EQ(kUnit.counts(-7), -19);
  EXPECT_EQ(kUnit.units(3), 1);
  EXPECT_EQ(kUnit.units(19), 7);
  EXPECT_EQ(kUnit.units(-19), -7);
  EXPECT_EQ((UserUnit{2, 1, 1}.units(-3)), -2) << "half away from 0";
  EXPECT_EQ((UserUnit{1, 1, 1}.counts(INT32_MAX)), INT32_MAX);
}

TEST(Mco305Units, ShowPositionsOf31Bits) {
  EXPECT_EQ(shown_position(1'073'741'823), 1'073'741'823);
  EXPECT_EQ(shown_position(1'073'741'824), -1'073'741'824);
  EXPECT_EQ(shown_position(-1'073'741'825), 1'073'741'823);
}

TEST(Mco305Device, PositionsInTheTimeOfItsRamps) {
  Bench bench;
  ASSERT_EQ(bench.device.position_to(200'000, false), 0);
  EXPECT_NEAR(bench.until_arrived(), 2500, 2);
  EXPECT_EQ(bench.device.actual_units(), 200'000);
  ASSERT_EQ(bench.device.position_to(-1000, true), 0);
  bench.until_arrived();
  EXPECT_EQ(bench.device.actual_units(), 199'000);
}

TEST(Mco305Device, KeepsItsZeroPoints) {
  Bench bench({{kSwPosLimAct, 1}, {kPosLimit, 5000}});
  ASSERT_EQ(bench.device.position_to(2000, false), 0);
  bench.until_arrived();
  bench.device.define_origin();
  EXPECT_EQ(bench.device.actual_units(), 0);
  // The limit has stayed where it is.
  EXPECT_EQ(bench.device.position_to(3001, false), kSoftwareLimit);
  EXPECT_EQ(bench.device.position_to(3000, false), 0);
  bench.until_arrived();
  bench.device.set_origin(1000);
  EXPECT_EQ(bench.device.actual_units(), 2000);
  bench.device.reset_origin();
  EXPECT_EQ(bench.device.actual_units(), 3000);
}

TEST(Mco305Device, FollowsByItsProportionalPartAlone) {
  Bench bench({{kKProp, 100}, {kPosErr, 20'000}}, with_drive());
  bench.device.set_speed(50);
  ASSERT_EQ(bench.device.start_speed(), 0);
  bench.run(3000);
  EXPECT_NEAR(bench.device.following_error(), 5243, 60);
  EXPECT_NEAR(bench.system_variable(4111), 524'288, 6000);
}

TEST(Mco305Device, IsCarriedByItsPrecontrol) {
  Bench bench({{kKProp, 100}, {kFFVel, 10'486}}, with_drive());
  bench.device.set_speed(50);
  ASSERT_EQ(bench.device.start_speed(), 0);
  bench.run(3000);
  EXPECT_NEAR(bench.device.following_error(), 0, 55);
}

TEST(Mco305Device, TellsAFollowingErrorEveryTwentyMilliseconds) {
  int before = 0;
  for (const std::int32_t time : {0, 300}) {
    Bench bench({{kKProp, 100}, {kBandwidth, 200}, {kPosErr, 20'000}, {kPosErrTime, time}}, with_drive());
    bench.device.set_speed(50);
    ASSERT_EQ(bench.device.start_speed(), 0);
    int error = 0, steps = 0;
    for (; steps < 4000 && error == 0; ++steps) error = bench.step();
    EXPECT_EQ(error, kPositionError);
    EXPECT_FALSE(bench.device.controlled());
    EXPECT_NEAR(steps - before, time, time == 0 ? 4000 : 20);
    before = steps;
  }
}

TEST(Mco305Device, HomesInFourManners) {
  constexpr double kPlaces[] = {4000.0, 5000.0, 8000.0, 6000.0};
  for (const std::int32_t offset : {0, 500})
    for (std::int32_t type = 0; type < 4; ++type) {
      DeviceSettings settings;
      settings.drive.signals.reference_cam = PositionRange{5000.0, 6000.0};
      settings.drive.signals.zero_marks = ZeroMarks{0.0, 4000.0};
      Bench bench({{kHomeType, type}, {kHomeOffset, offset}, {3352, 1}, {kHomeVel, 10}, {kHomeRamp, 10}},
                  settings);
      ASSERT_EQ(bench.device.begin_home(false), 0);
      ASSERT_GT(bench.until_arrived(30'000), 0) << type;
      EXPECT_EQ(bench.device.homing_error(), 0);
      EXPECT_NEAR(bench.device.actual_units(), 0, 2) << type;
      EXPECT_NEAR(bench.device.machine_position(), kPlaces[type] + offset, 12.0) << type;
    }
}

TEST(Mco305Device, WantsAVelocityAndAnIndexToHome) {
  Bench still({{kHomeVel, 0}});
  EXPECT_EQ(still.device.begin_home(false), kHomeVelocityZero);
  DeviceSettings settings;
  settings.drive.signals.reference_cam = PositionRange{100.0, 200.0};
  Bench blind({{3350, 1}, {kHomeVel, 10}, {kHomeRamp, 100}, {kDfltAcc, 100}}, settings);
  ASSERT_EQ(blind.device.begin_home(false), 0);
  for (int i = 0; i < 30'000 && blind.device.homing(); ++i) blind.step();
  EXPECT_EQ(blind.device.homing_error(), kIndexNotFound);
}

TEST(Mco305Device, ForcesHomingIfItIsTold) {
  Bench bench({{kHomeForce, 1}});
  EXPECT_EQ(bench.device.position_to(100, false), kHomeNotDone);
  EXPECT_EQ(bench.device.start_speed(), kHomeNotDone);
}

TEST(Mco305Device, RaisesLimitsInMotion) {
  Bench bench({{kSwPosLimAct, 1}, {kPosLimit, 1000}});
  bench.device.set_speed(50);
  ASSERT_EQ(bench.device.start_speed(), 0);
  EXPECT_EQ(bench.until_error(1000), kSoftwareLimit);
  EXPECT_FALSE(bench.device.controlled());
  EXPECT_EQ(bench.device.pending().alarm_word(1), 1 << 6);
  bench.device.clear_error();
  EXPECT_TRUE(bench.device.controlled());
  EXPECT_EQ(bench.device.position_to(5000, false), kFurtherOut);
  EXPECT_EQ(bench.device.position_to(0, false), 0) << "it may be driven back";
}

TEST(Mco305Device, StopsAtAHardwareLimit) {
  Bench bench({{3350, 5}});
  bench.device.set_speed(50);
  ASSERT_EQ(bench.device.start_speed(), 0);
  bench.run(100);
  bench.device.io().set_input(1, true);
  EXPECT_EQ(bench.until_error(2), kHardwareLimit);
  bench.device.clear_error();
  EXPECT_EQ(bench.device.start_speed(), kFurtherOut);
}

TEST(Mco305Device, ReactsAsErrcondSays) {
  for (const std::int32_t condition : {0, 1, 2, 3, 5}) {
    Bench bench({{kErrCond, condition}, {3366, 5}});
    bench.device.set_speed(50);
    ASSERT_EQ(bench.device.start_speed(), 0);
    bench.run(1000);
    bench.device.raise(kPositionError);
    bench.step();
    const double velocity = bench.device.set_velocity_now();
    bench.step();
    EXPECT_EQ(bench.device.io().output(4), condition == 1) << condition;
    EXPECT_EQ(bench.device.controlled(), condition >= 2) << condition;
    EXPECT_EQ(bench.device.set_velocity_now() == 50.0, condition == 5) << condition << ' ' << velocity;
    bool moved_with_brake = false;
    for (int i = 0; i < 1000; ++i) {
      bench.step();
      moved_with_brake |= bench.device.io().output(4) && bench.device.set_velocity_now() != 0.0;
    }
    EXPECT_FALSE(moved_with_brake);
    EXPECT_EQ(bench.device.io().output(4), condition == 1 || condition == 3) << condition;
  }
}

TEST(Mco305Device, GoesOnWhereItWasStopped) {
  Bench bench;
  ASSERT_EQ(bench.device.position_to(200'000, false), 0);
  bench.run(1000);
  bench.device.motor_stop();
  EXPECT_EQ(bench.device.axis_end() & 8, 8);
  EXPECT_NEAR(bench.until_arrived(), 500, 2);
  EXPECT_EQ(bench.device.go_on(), 0);
  bench.until_arrived();
  EXPECT_EQ(bench.device.actual_units(), 200'000);
}

TEST(Mco305Device, DoesNotStartWhileAnErrorWaits) {
  Bench bench;
  bench.device.react(kUnknownParameter);
  EXPECT_EQ(bench.device.pending().alarm_word(2), 1 << 2);
  EXPECT_EQ(bench.device.pending().alarm_word(1), INT32_MIN);
  EXPECT_EQ(bench.device.position_to(1, false), kErrorNotReset);
  bench.device.clear_error();
  EXPECT_EQ(bench.device.position_to(1, false), 0);
}

}  // namespace
}  // namespace lockstep::mco305
