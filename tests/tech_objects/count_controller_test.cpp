// The position controller of an axis that counts, against its formula.
#include "tech_objects/drive/count_controller.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <random>

namespace lockstep {
namespace {

double step(CountController& controller, const CountControllerSettings& settings, double setpoint,
            double actual, double velocity, double acceleration, double period) {
  controller.set(settings);
  return controller.step(setpoint, actual, velocity, acceleration, period);
}

TEST(CountController, WeighsTheFollowingError) {
  CountController controller;
  CountControllerSettings settings;
  settings.proportional = 100.0;
  EXPECT_EQ(step(controller, settings, 5243.0, 0.0, 0.0, 0.0, 1.0), 524'300.0);
  EXPECT_EQ(step(controller, settings, 20'000.0, 0.0, 0.0, 0.0, 1.0), CountController::kFullScale);
}

TEST(CountController, DampsByTheActualVelocityAndCarriesTheSetpointBeforehand) {
  CountController controller;
  CountControllerSettings settings;
  settings.derivative = 20.0;
  settings.velocity_precontrol = 20.0;  // equal to KDER: together KDER·(v_set - v)
  settings.acceleration_precontrol = 3.0;
  step(controller, settings, 0.0, 0.0, 0.0, 0.0, 1.0);
  EXPECT_EQ(step(controller, settings, 50.0, 40.0, 50.0, 0.0, 1.0), 200.0);
  EXPECT_EQ(step(controller, settings, 90.0, 90.0, 50.0, 2.0, 1.0), 6.0);
}

TEST(CountController, LimitsItsSumAndThenWeighsIt) {
  CountController controller;
  CountControllerSettings settings;
  settings.integral = 2.0;
  settings.integral_limit = 25.0;
  EXPECT_EQ(step(controller, settings, 10.0, 0.0, 0.0, 0.0, 1.0), 20.0);
  EXPECT_EQ(step(controller, settings, 10.0, 0.0, 0.0, 0.0, 1.0), 40.0);
  EXPECT_EQ(step(controller, settings, 10.0, 0.0, 0.0, 0.0, 1.0), 50.0);
  settings.integral_limit = 0.0;
  EXPECT_EQ(step(controller, settings, 10.0, 0.0, 0.0, 0.0, 1.0), 0.0);
}

TEST(CountController, LimitsItsPartsToTheBandwidthButNotThePrecontrol) {
  CountController controller;
  CountControllerSettings settings;
  settings.proportional = 100.0;
  settings.bandwidth = 200.0;
  settings.velocity_precontrol = 100.0;
  EXPECT_DOUBLE_EQ(step(controller, settings, 20'000.0, 0.0, 0.0, 0.0, 1.0), 209'715.0);
  EXPECT_DOUBLE_EQ(step(controller, settings, 20'000.0, 0.0, 50.0, 0.0, 1.0), 214'715.0);
}

TEST(CountController, RestsWithinItsWindow) {
  CountController controller;
  CountControllerSettings settings;
  settings.proportional = 1.0;
  settings.idle_below = 5;
  settings.active_above = 20;
  EXPECT_EQ(step(controller, settings, 10.0, 0.0, 0.0, 0.0, 1.0), 10.0);
  EXPECT_EQ(step(controller, settings, 4.0, 0.0, 0.0, 0.0, 1.0), 0.0);
  EXPECT_TRUE(controller.idle());
  EXPECT_EQ(step(controller, settings, 20.0, 0.0, 0.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(step(controller, settings, 21.0, 0.0, 0.0, 0.0, 1.0), 21.0);
  EXPECT_FALSE(controller.idle());
}

TEST(CountController, FadesItsSumInMotionOrAtStandstill) {
  CountController controller;
  CountControllerSettings settings;
  settings.integral = 1.0;
  settings.integral_limit = 100.0;
  settings.integral_time = 10;  // in motion only
  EXPECT_EQ(step(controller, settings, 1000.0, 0.0, 0.0, 0.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(step(controller, settings, 1000.0, 0.0, 5.0, 0.0, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(step(controller, settings, 1000.0, 0.0, 5.0, 0.0, 1.0), 20.0);
  settings.integral_time = -10;
  EXPECT_DOUBLE_EQ(step(controller, settings, 1000.0, 0.0, 5.0, 0.0, 1.0), 10.0);
}

// What it does not compute again at rest it would have computed: the same as one that is told its settings
// anew in each step, and so computes everything.
TEST(CountController, GivesAtRestWhatItWouldCompute) {
  constexpr std::array kTimes = {0, 0, 20, -20};
  constexpr std::array kWindows = {0, 0, 3, 50};
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const auto chosen = [&random](int count) { return static_cast<int>(random() % count); };
    CountControllerSettings settings;
    settings.proportional = 30.0;
    settings.derivative = 10.0 * chosen(3);
    settings.integral = 0.5 * chosen(3);
    settings.integral_limit = 20.0 * chosen(3);
    settings.velocity_precontrol = 20.0;
    settings.acceleration_precontrol = 3.0;
    settings.active_above = kWindows[chosen(4)];
    settings.idle_below = settings.active_above / 2;
    settings.integral_time = kTimes[chosen(4)];
    CountController one, other;
    one.set(settings);
    double setpoint = 0.0, actual = 0.0, velocity = 0.0;
    for (int i = 0; i < 300; ++i) {
      if (chosen(20) == 0) setpoint = chosen(100) - 50.0;
      if (chosen(20) == 0) actual = setpoint + chosen(9) - 4.0;
      if (chosen(20) == 0) velocity = chosen(2) == 0 ? 0.0 : 2.5;
      if (chosen(60) == 0) velocity = -0.0;
      if (chosen(100) == 0) {
        one.reset();
        other.reset();
      }
      const double acceleration = chosen(40) == 0 ? 0.25 : 0.0;
      const double reference = one.step(setpoint, actual, velocity, acceleration, 1.0);
      const double computed = step(other, settings, setpoint, actual, velocity, acceleration, 1.0);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(reference), std::bit_cast<std::uint64_t>(computed))
          << "seed " << seed << ", step " << i;
      ASSERT_EQ(one.idle(), other.idle()) << "seed " << seed << ", step " << i;
    }
  }
}

}  // namespace
}  // namespace lockstep
