// A shift that a leading value leads on while it still moves.
#include "tech_objects/synchronous/shift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lockstep::shift_test {
namespace {

constexpr double kPeriod = 0.001;  // [s]
constexpr ProfileLimits kLimits{
    .velocity_max = 1e4, .velocity_min = -1e4, .acceleration = 5e3, .deceleration = 5e3, .jerk = 2e5};

/// A leading value that is pulled.
struct Leading {
  void tick() {
    last = now;
    const double a = now.velocity < -100.0 ? 0.0 : acceleration;
    now = {{0, last.position.value + (last.velocity + 0.5 * a * kPeriod) * kPeriod},
           last.velocity + a * kPeriod,
           a};
  }
  LeadingStep step() const { return {.now = now, .last = last, .modulo = kLine}; }

  static constexpr Modulo kLine{};
  double acceleration = 0.0;
  Setpoint last{};
  Setpoint now{};
};

/// The maximum amount of a shift from 0 to 5 whose target becomes 8 over a distance of 50 after some ticks;
/// the leading value stands until some more ticks are over, then it speeds up.
double maximum_amount(int ticks_before, int ticks_of_rest) {
  Shift shift;
  EXPECT_EQ(shift.begin({.target = {5.0, 0.0}, .rule = ShiftRule::dynamics, .limits = kLimits}, kPeriod),
            PlanResult::ok);
  Leading leading;
  for (int i = 0; i < ticks_before; ++i) shift.advance(leading.step());
  EXPECT_EQ(
      shift.begin({.target = {8.0, 0.0}, .distance = 50.0, .direction = -1, .limits = kLimits}, kPeriod),
      PlanResult::ok);
  double maximum = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (i == ticks_of_rest) {
      leading.now.velocity = -0.2;
      leading.acceleration = -400.0;
    }
    leading.tick();
    shift.advance(leading.step());
    maximum = std::max(maximum, std::abs(shift.value().rounded()));
  }
  EXPECT_EQ(shift.phase(), Shift::Phase::resting) << "it has not arrived";
  EXPECT_EQ(shift.value().rounded(), 8.0);
  return maximum;
}

/// While it brakes, its velocity passes small amounts with a large acceleration: a leading value that sets
/// out then makes little way in the time, over which that acceleration would throw the shift far beyond its
/// target.
TEST(Shift, IsNotThrownBeyondItsTargetByTheAccelerationItBrakesWith) {
  for (int before = 5; before < 90; before += 7)
    for (int rest = 0; rest < 60; ++rest)
      ASSERT_LT(maximum_amount(before, rest), 40.0) << before << " ticks, then " << rest;
}

}  // namespace
}  // namespace lockstep::shift_test
