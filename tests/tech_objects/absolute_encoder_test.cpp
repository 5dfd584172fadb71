// Absolute encoders of the MCO 305: where they are at power-up, what their filter bridges, what is not there
// with them.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tech_objects/mco305/device.hpp"

namespace lockstep::mco305::absolute_encoder_test {
namespace {

using Values = std::vector<std::pair<std::int32_t, std::int32_t>>;

TEST(AbsoluteEncoder, IsOnALineThroughTheEndsOfItsRange) {
  AbsoluteEncoder encoder;
  encoder.configure(4, 10, 3 * 1024 + 1000);
  EXPECT_EQ(encoder.position(), 1000);
  for (std::int64_t place = 4072; place <= 8000; place += 100) EXPECT_TRUE(encoder.read(place, 0, 256));
  EXPECT_EQ(encoder.position(), 7972 - 3 * 1024);
  EXPECT_EQ(encoder.turns(100), (7972 - 4 * 1024) / 100) << "since it left its range";
  for (std::int64_t place = 7900; place >= -500; place -= 100) EXPECT_TRUE(encoder.read(place, 0, 256));
  EXPECT_EQ(encoder.position(), -500 - 3 * 1024);
  EXPECT_EQ(encoder.turns(100), -(500 + 3 * 1024) / 100);
  encoder.configure(0, 10, 1000);
  EXPECT_FALSE(encoder.present());
  EXPECT_EQ(encoder.turns(100), 0);
}

TEST(AbsoluteEncoder, BridgesAHundredReadOutsWithItsLastVelocity) {
  AbsoluteEncoder encoder;
  encoder.configure(5, 25, 0);
  std::int64_t place = 0;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(encoder.read(place += 7, 0, 8192));
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(encoder.read(place += 7, 6554, 8192)) << i;
    EXPECT_EQ(encoder.position(), place);
  }
  EXPECT_EQ(encoder.errors(), 100);
  EXPECT_FALSE(encoder.read(place += 7, 6554, 8192)) << "the next one is taken";
  EXPECT_EQ(encoder.position(), place + 6554);
  EXPECT_EQ(encoder.errors(), 101);
}

TEST(AbsoluteEncoder, TakesHalfATurnForAMotion) {
  AbsoluteEncoder encoder;
  encoder.configure(5, 25, 0);
  EXPECT_TRUE(encoder.read(4096, 0, 8192));
  EXPECT_EQ(encoder.position(), 4096);
  EXPECT_EQ(encoder.errors(), 0);
  EXPECT_TRUE(encoder.read(0, -1, 8192));
  EXPECT_EQ(encoder.position(), 8192) << "a count more is none";
  EXPECT_EQ(encoder.errors(), 1);
}

/// 409.6 qc/ms at 3000 1/min, carried by its precontrol.
struct Bench {
  std::int32_t disturbed = 0;
  Device device;

  explicit Bench(std::int32_t type, const Values& more = {}, double start = 12'345.0) {
    Values values{{kEncoderAbsType, type}, {kVelMax, 3000}, {kRampMin, 500}, {kFFVel, 2560}, {kKProp, 100}};
    values.insert(values.end(), more.begin(), more.end());
    for (const auto& [number, value] : values) EXPECT_EQ(device.set_parameter(number, value), 0) << number;
    DeviceSettings settings;
    settings.has_drive = true;
    settings.drive.signals.start_position = start;
    settings.faults.encoder_counts = &disturbed;
    device.configure(settings, 0.001);
    device.set_velocity(25);
    device.set_acceleration(100);
    device.set_deceleration(100);
  }
  int run(int steps) {
    int first = 0;
    for (int i = 0; i < steps; ++i) {
      device.servo(true);
      const int error = device.take_error();
      if (error == 0) continue;
      device.react(error);
      first = first == 0 ? error : first;
    }
    return first;
  }
  std::int32_t system_variable(std::int32_t index) {
    std::int32_t value = -1;
    EXPECT_TRUE(device.system_variable(index, value)) << index;
    return value;
  }
};

TEST(AbsoluteEncoder, HasItsPositionAtPowerUp) {
  Bench bench(4);
  EXPECT_EQ(bench.run(100), 0);
  EXPECT_EQ(bench.device.actual_units(), 12'345);
  EXPECT_EQ(bench.device.position_to(50'000, false), 0);
  EXPECT_EQ(bench.run(3000), 0);
  EXPECT_NEAR(bench.device.actual_units(), 50'000, 20);
  EXPECT_NEAR(bench.device.machine_position(), 50'000.0, 20.0) << "a position is a count";
  Bench beyond(4, {}, 1024.0 * 1024.0 * 32.0 + 5.0);
  beyond.run(10);
  EXPECT_EQ(beyond.device.actual_units(), 5) << "of 25 bits";
}

TEST(AbsoluteEncoder, GoesAsFastAsItsResolutionSays) {
  Bench bench(4);
  bench.device.set_speed(50);
  EXPECT_EQ(bench.device.start_speed(), 0);
  EXPECT_EQ(bench.run(2000), 0);
  EXPECT_NEAR(bench.device.set_velocity_now(), 8192.0 * 1500.0 / 60'000.0, 1e-9);
}

TEST(AbsoluteEncoder, GoesOnSmoothlyThroughAReadOutThatCannotBe) {
  for (const std::int32_t type : {4, 5}) {
    Bench bench(type, {{kPosErr, 1'000'000}});
    bench.device.set_speed(25);
    ASSERT_EQ(bench.device.start_speed(), 0);
    ASSERT_EQ(bench.run(1000), 0);
    std::int32_t last = bench.device.actual_units(), farthest = 0;
    for (int i = 0; i < 20; ++i) {
      bench.disturbed = i == 10 ? 6554 : 0;
      bench.run(1);
      farthest = std::max(farthest, std::abs(bench.device.actual_units() - last - 102));
      last = bench.device.actual_units();
    }
    EXPECT_EQ(bench.system_variable(16), type == 5 ? 1 : 0);
    if (type == 5)
      EXPECT_LE(farthest, 2);
    else
      EXPECT_GE(farthest, 6000) << "without filter it is what it is";
  }
}

TEST(AbsoluteEncoder, IsAPositionErrorBehindAHundredReadOuts) {
  Bench bench(5, {{kPosErr, 1'000'000}});
  bench.run(200);
  bench.disturbed = 6554;
  EXPECT_EQ(bench.run(100), 0);
  EXPECT_NEAR(bench.device.actual_units(), 12'345, 1);
  EXPECT_EQ(bench.run(1), kPositionError);
  EXPECT_EQ(bench.system_variable(16), 101);
}

TEST(AbsoluteEncoder, CountsTurnsBeyondItsRange) {
  Bench bench(4, {{kEncoderDatLen, 13}, {kEncoder, 1000}, {kVelMax, 300}, {kFFVel, 25'600}}, 8000.0);
  bench.device.set_velocity(100);
  bench.run(10);
  EXPECT_EQ(bench.device.actual_units(), 8000);
  EXPECT_EQ(bench.system_variable(4102), 0);
  ASSERT_EQ(bench.device.position_to(28'000, false), 0);
  EXPECT_EQ(bench.run(3000), 0);
  EXPECT_NEAR(bench.device.actual_units(), 28'000, 20);
  EXPECT_EQ(bench.system_variable(4102), 19) << "8192, and 19 turns of 1000";
}

TEST(AbsoluteEncoder, HasNoOriginNoHomeAndNoIndex) {
  Bench bench(5);
  bench.run(10);
  EXPECT_EQ(bench.device.define_origin(), kUnknownCommand);
  EXPECT_EQ(bench.device.begin_home(false), kUnknownCommand);
  EXPECT_EQ(bench.device.begin_home(true), kUnknownCommand);
  EXPECT_FALSE(bench.device.swap_encoders(true));
  EXPECT_EQ(bench.device.actual_units(), 12'345);
  bench.device.set_origin(1000);
  EXPECT_EQ(bench.device.actual_units(), 11'345) << "a temporary one it has";
}

// IPOS is that of an external marker, in the counts of the encoder.
TEST(AbsoluteEncoder, LatchesExternalMarkersAlone) {
  for (const std::int32_t markers : {0, 2}) {
    Device device;
    for (const auto& [number, value] : Values{{kEncoderAbsType, 4},
                                              {kVelMax, 3000},
                                              {kRampMin, 500},
                                              {kFFVel, 2560},
                                              {kMarkerTypeSlave, markers}})
      EXPECT_EQ(device.set_parameter(number, value), 0);
    DeviceSettings settings;
    settings.has_drive = true;
    settings.drive.signals.start_position = 12'345.0;
    settings.drive.signals.zero_marks = ZeroMarks{.position = 0.0, .period = 1000.0};
    settings.markers = {.position = 20'000.0, .period = 100'000.0};
    device.configure(settings, 0.001);
    device.set_velocity(25);
    device.servo(true);
    ASSERT_EQ(device.position_to(30'000, false), 0);
    for (int i = 0; i < 2000; ++i) device.servo(true);
    EXPECT_EQ(device.latches(), markers == 0 ? 0u : 1u);
    if (markers != 0) {
      EXPECT_NEAR(device.latched_units(), 20'000, 1);
    }
  }
}

}  // namespace
}  // namespace lockstep::mco305::absolute_encoder_test
