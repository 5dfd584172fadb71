// The extrapolation of a leading actual value, against filters written down independently.
#include "tech_objects/filters/extrapolation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tech_objects/arithmetic/decay.hpp"
#include "tests/support/property.hpp"

namespace lockstep::extrapolation_test {
namespace {

constexpr double kPeriod = 0.002;  // [s]

/// A first-order lag by its closed solution for an input that runs straight, on the values themselves and in
/// higher precision.
struct ReferenceLag {
  long double time_constant = 0.0L;
  long double input = 0.0L;
  long double output = 0.0L;

  long double step(long double next, long double period = kPeriod) {
    if (time_constant == 0.0L) {
      output = next;
    } else {
      const long double lag = (next - input) / period * time_constant;
      output = next - lag + (output - input + lag) * std::exp(-period / time_constant);
    }
    input = next;
    return output;
  }
};

struct ReferencePt2 {
  ReferenceLag first;
  ReferenceLag second;

  ReferencePt2(double t1, double t2) {
    first.time_constant = t1;
    second.time_constant = t2;
  }
  long double step(long double next) { return second.step(first.step(next)); }
};

void set(double (&lags)[2], double first, double second) {
  lags[0] = first;
  lags[1] = second;
}

ExtrapolationSettings settings_of(double position_t1, double position_t2, double velocity_t1,
                                  double velocity_t2) {
  ExtrapolationSettings settings;
  set(settings.position_lags, position_t1, position_t2);
  set(settings.velocity_lags, velocity_t1, velocity_t2);
  return settings;
}

/// An extrapolation on a line that begins at 0.
struct OnLine : Extrapolation {
  explicit OnLine(double period = kPeriod) {
    configure({}, period, 0.0);
    reset({});
  }
  double position(double actual, double velocity, const ExtrapolationSettings& settings) {
    return step({0, actual}, velocity, settings).position.value;
  }
};

double seconds(int tick) {
  return tick * kPeriod;
}

// ---- Filters
// ----------------------------------------------------------------------------------------------------

TEST(FirstOrderLag, IsBehindARampByItsTimeConstantExactly) {
  for (const double time_constant : {0.0, 1e-6, 0.0003, 0.002, 0.7, 100.0}) {
    FirstOrderLag lag;
    lag.tune(time_constant, kPeriod);
    const double velocity = 3.0;
    const int settled = static_cast<int>(40.0 * time_constant / kPeriod) + 10;
    for (int i = 0; i < settled; ++i) lag.step(velocity * kPeriod);
    // What is left is the rounding of one step, as often as it takes to be forgotten.
    const double rounding = 4e-16 * (1.0 + time_constant / kPeriod);
    EXPECT_NEAR(lag.behind(), velocity * time_constant, rounding * velocity * time_constant) << time_constant;
  }
}

TEST(FirstOrderLag, ComesToRestWhereItsInputStands) {
  FirstOrderLag lag;
  lag.tune(0.05, kPeriod);
  lag.step(1000.0);
  int ticks = 0;
  while (lag.behind() != 0.0 && ticks < 5000) {
    lag.step(0.0);
    ++ticks;
  }
  EXPECT_LT(ticks, 50 * 25);
}

TEST(DecayWithin, IsThatOfTheLibraryWithinAFewUlp) {
  for (double x = 1e-18; x < 60.0; x *= 1.37) EXPECT_NEAR(decay_within(x) / -std::expm1(-x), 1.0, 2e-15) << x;
  EXPECT_EQ(decay_within(0.0), 0.0);
  EXPECT_EQ(decay_within(std::numeric_limits<double>::infinity()), 1.0);
}

TEST(ExtrapolationFilters, AgreeWithTheClosedSolutionForAnyInput) {
  test::for_each_seed(20240611, test::cases(40, 4000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> exponent(-5.0, 0.5);
    std::normal_distribution<double> noise;
    std::array<double, 4> t{};
    for (double& value : t) value = one.seed % 5 == 0 ? 0.0 : std::pow(10.0, exponent(random));
    const auto settings = settings_of(t[0], t[1], t[2], t[3]);
    OnLine extrapolation;
    ReferencePt2 position(t[0], t[1]);
    ReferencePt2 velocity(t[2], t[3]);
    double u = 0.0;
    for (int i = 0; i < 1000; ++i) {
      u += noise(random);
      const double v = 100.0 * noise(random);
      const ExtrapolatedValues& values = extrapolation.step({0, u}, v, settings);
      const long double p_ref = position.step(u);
      const long double v_ref = velocity.step(v);
      const double time = kPeriod + t[0] + t[1];
      ASSERT_NEAR(values.filtered_position.value, static_cast<double>(p_ref), 1e-11);
      ASSERT_NEAR(values.filtered_velocity, static_cast<double>(v_ref), 1e-10);
      ASSERT_NEAR(values.position.value, static_cast<double>(p_ref + v_ref * time), 1e-9);
      ASSERT_EQ(values.velocity, values.filtered_velocity);
    }
  });
}

// ---- Extrapolation
// ----------------------------------------------------------------------------------------------

TEST(Extrapolation, HasNoErrorAtConstantVelocity) {
  auto settings = settings_of(0.004, 0.003, 0.02, 0.03);
  settings.further_time = 0.0055;
  OnLine extrapolation;
  const double v = 250.0;
  const double ahead = kPeriod + 0.0055;  // the rest makes up for the filters
  EXPECT_DOUBLE_EQ(extrapolation.leading_axis_time(settings), kPeriod + 0.007);
  for (int i = 1; i < 3000; ++i) {
    const double seen = extrapolation.position(v * seconds(i), v, settings);
    if (i > 1000) {
      ASSERT_NEAR(seen, v * (seconds(i) + ahead), 2e-12 * v * seconds(i));
    }
  }
}

TEST(Extrapolation, CountsTheAgeOfTheActualValueAsLeadingAxisPart) {
  Extrapolation extrapolation;
  extrapolation.configure({}, kPeriod, 0.0007);
  extrapolation.reset({});
  const auto settings = settings_of(0.001, 0.0, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(extrapolation.leading_axis_time(settings), 0.0007 + kPeriod + 0.001);
  double seen = 0.0;
  for (int i = 1; i <= 500; ++i)
    seen = extrapolation.step({0, 10.0 * seconds(i)}, 10.0, settings).position.value;
  EXPECT_NEAR(seen, 10.0 * (seconds(500) + kPeriod + 0.0007), 1e-11);
}

TEST(Extrapolation, WithoutTheLeadingAxisPartLeavesItsLag) {
  auto settings = settings_of(0.004, 0.003, 0.0, 0.0);
  settings.makes_up_for_leading_axis = false;
  settings.further_time = 0.001;
  OnLine extrapolation;
  double seen = 0.0;
  for (int i = 1; i <= 1000; ++i) seen = extrapolation.position(100.0 * seconds(i), 100.0, settings);
  EXPECT_NEAR(seen, 100.0 * (seconds(1000) - 0.007 + 0.001), 1e-10);
  EXPECT_DOUBLE_EQ(extrapolation.leading_axis_time(settings), kPeriod + 0.007);
}

/// At constant acceleration the error comes to stand: the lags of second order, and the velocity that is
/// late.
TEST(Extrapolation, AtConstantAccelerationIsLateAsItsFiltersAre) {
  const double t1 = 0.004, t2 = 0.006, tv = 0.03;
  auto settings = settings_of(t1, t2, 0.01, 0.02);
  OnLine extrapolation;
  ReferencePt2 position(t1, t2), velocity(0.01, 0.02);
  const double a = 500.0;
  const double time = kPeriod + t1 + t2;
  for (int i = 1; i < 1000; ++i) {
    const double t = seconds(i);
    const double seen = extrapolation.position(0.5 * a * t * t, a * t, settings);
    const long double p = position.step(0.5L * a * t * t);
    const long double v = velocity.step(a * t);
    ASSERT_NEAR(seen, static_cast<double>(p + v * time), 1e-10);
    if (i < 500) continue;
    // Of the continuous filters; straight lines between ticks add a·T²/12 per lag.
    const double then = t + kPeriod;
    const double late = a * (0.5 * kPeriod * kPeriod + tv * time - (t1 * t1 + t1 * t2 + t2 * t2));
    ASSERT_NEAR(0.5 * a * then * then - seen, late, a * kPeriod * kPeriod / 6.0 + 1e-9);
  }
}

TEST(Extrapolation, WithNoiseStaysWithinBandHysteresisAndFilteredNoise) {
  std::mt19937_64 random(test::seed_of_test(77));
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  auto settings = settings_of(0.006, 0.004, 0.05, 0.03);
  settings.velocity_tolerance = 4.0;
  settings.hysteresis = 0.02;
  settings.further_time = 0.003;
  const double time = kPeriod + 0.010 + 0.003;
  for (const double v : {120.0, -35.0, 0.0}) {
    OnLine extrapolation;
    ReferencePt2 noise_of_position(0.006, 0.004), noise_of_velocity(0.05, 0.03);
    double worst = 0.0;
    for (int i = 1; i < 5000; ++i) {
      const double np = 0.01 * noise(random);
      const double nv = 10.0 * noise(random);
      const double seen = extrapolation.position(v * seconds(i) + np, v + nv, settings);
      const auto p = static_cast<double>(std::abs(noise_of_position.step(np)));
      const auto w = static_cast<double>(std::abs(noise_of_velocity.step(nv)));
      if (i < 1500) continue;
      const double error = std::abs(seen - v * (seconds(i) + kPeriod + 0.003));
      ASSERT_LE(error, 2.0 * time + 0.02 + p + w * time + 1e-9) << v << " at " << i;
      worst = std::max(worst, error);
    }
    EXPECT_GT(worst, 0.0);
  }
}

// ---- Tolerance band
// ---------------------------------------------------------------------------------------------

TEST(ExtrapolationToleranceBand, MovesOnlyWhenTheVelocityLeavesItAndStaysHalfItsWidthBehind) {
  ExtrapolationSettings settings;
  settings.velocity_tolerance = 10.0;
  OnLine extrapolation;
  const std::vector<std::array<double, 2>> steps = {
      {4.0, 0.0},    // within half the band
      {5.0, 0.0},    // its edge
      {5.5, 0.5},    // beyond it
      {8.0, 3.0},    // follows upwards
      {-1.9, 3.0},   // within
      {-2.0, 3.0},   // the other edge
      {-4.0, 1.0},   // follows downwards
      {100.0, 95.0}  //
  };
  for (const auto& [velocity, shown] : steps) {
    const ExtrapolatedValues& values = extrapolation.step({}, velocity, settings);
    EXPECT_DOUBLE_EQ(values.filtered_velocity, shown) << velocity;
    EXPECT_DOUBLE_EQ(values.velocity, shown);
    EXPECT_DOUBLE_EQ(values.position.value, shown * kPeriod);
  }
}

TEST(ExtrapolationToleranceBand, OfTheWidthOfTheNoiseHidesTheNoise) {
  std::mt19937_64 random(test::seed_of_test(5));
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  ExtrapolationSettings settings;
  settings.velocity_tolerance = 2.0;
  OnLine extrapolation;
  for (int i = 0; i < 3000; ++i) extrapolation.step({}, 50.0 + noise(random), settings);
  const double settled = extrapolation.values().filtered_velocity;
  for (int i = 0; i < 1000; ++i)
    ASSERT_NEAR(extrapolation.step({}, 50.0 + noise(random), settings).filtered_velocity, settled, 0.01);
  EXPECT_NEAR(settled, 50.0, 0.01);
}

// ---- Hysteresis
// -------------------------------------------------------------------------------------------------

TEST(ExtrapolationHysteresis, HoldsAReversalBackUntilItExceedsTheValue) {
  ExtrapolationSettings settings;
  settings.hysteresis = 1.0;
  OnLine extrapolation;
  const std::vector<std::array<double, 2>> steps = {
      {0.5, 0.5},  {3.0, 3.0},              // forward, as it is
      {2.5, 3.0},  {2.0, 3.0},              // back by less than the hysteresis: stands
      {2.8, 3.0},  {3.1, 3.1},              // forward again
      {2.0, 3.0},  {1.0, 2.0}, {0.5, 1.5},  // back by more: follows at its distance, without a step
      {0.9, 1.5},  {1.5, 1.5},              // and forward once it is used up
      {1.75, 1.75}};
  for (const auto& [position, shown] : steps)
    EXPECT_DOUBLE_EQ(extrapolation.position(position, 0.0, settings), shown) << position;
}

TEST(ExtrapolationHysteresis, TakesTheFirstMotionAsTheOneThatIsNotHeldBack) {
  ExtrapolationSettings settings;
  settings.hysteresis = 1.0;
  OnLine extrapolation;
  const std::vector<std::array<double, 2>> steps = {{-2.0, -2.0}, {-1.5, -2.0}, {0.0, -1.0}, {-3.0, -3.0}};
  for (const auto& [position, shown] : steps)
    EXPECT_DOUBLE_EQ(extrapolation.position(position, 0.0, settings), shown) << position;
}

TEST(ExtrapolationHysteresis, NeverReversesForNoiseSmallerThanItself) {
  std::mt19937_64 random(test::seed_of_test(9));
  std::uniform_real_distribution<double> noise(-0.5, 0.5);
  ExtrapolationSettings settings;
  settings.hysteresis = 1.0;
  OnLine extrapolation;
  double last = extrapolation.position(1.0, 0.0, settings);
  for (int i = 0; i < 5000; ++i) {
    const double seen = extrapolation.position(1.0 + 0.01 * i + noise(random), 0.0, settings);
    ASSERT_GE(seen, last);
    last = seen;
  }
}

TEST(ExtrapolationHysteresis, ThatBecomesSmallerDoesNotStep) {
  ExtrapolationSettings settings;
  settings.hysteresis = 1.0;
  OnLine extrapolation;
  extrapolation.position(5.0, 0.0, settings);
  EXPECT_EQ(extrapolation.position(3.0, 0.0, settings), 4.0);
  settings.hysteresis = 0.25;
  EXPECT_EQ(extrapolation.position(2.9, 0.0, settings), 3.9);
  EXPECT_EQ(extrapolation.position(3.8, 0.0, settings), 3.9);  // used up but for 0.1
  EXPECT_DOUBLE_EQ(extrapolation.position(3.5, 0.0, settings), 3.75);
}

// ---- Ahead, for whoever sees it behind a delay

TEST(ExtrapolationAhead, IsThePositionAfterTheTimeAheadAsWell) {
  ExtrapolationSettings settings;
  settings.time_ahead = 0.02;
  OnLine extrapolation;
  for (int i = 0; i < 500; ++i) {
    const double here = 3.0 * kPeriod * i;
    const double shown = extrapolation.position(here, 3.0, settings);
    if (i < 2) continue;
    ASSERT_NEAR(shown, here + 3.0 * kPeriod, 1e-12) << "who sees it without a delay sees it as before";
    ASSERT_NEAR(extrapolation.values().ahead.value, here + 3.0 * (kPeriod + 0.02), 1e-12);
  }
}

/// Noise of the velocity is extrapolated by the time ahead too; the hysteresis comes behind that, and holds
/// back what it makes of the position.
TEST(ExtrapolationAhead, NeverReversesForNoiseThatIsSmallerThanTheHysteresisOnceItIsExtrapolated) {
  std::mt19937_64 random(test::seed_of_test(10));
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  ExtrapolationSettings settings;
  settings.hysteresis = 0.5;
  settings.time_ahead = 0.2;  // 0.2 u by 1 u/s, to and fro
  OnLine extrapolation;
  double last = -1.0;
  int held = 0;
  for (int i = 0; i < 5000; ++i) {
    extrapolation.position(2.0 * kPeriod * i, 2.0 + noise(random), settings);
    const double ahead = extrapolation.values().ahead.value;
    if (i > 0) {
      ASSERT_GE(ahead, last) << i;
    }
    held += ahead == last ? 1 : 0;
    last = ahead;
  }
  EXPECT_GT(held, 1000) << "there was something to hold back";
  settings.hysteresis = 0.0;
  bool reversed = false;
  for (int i = 5000; i < 5100; ++i) {
    extrapolation.position(2.0 * kPeriod * i, 2.0 + noise(random), settings);
    reversed |= extrapolation.values().ahead.value < last;
    last = extrapolation.values().ahead.value;
  }
  EXPECT_TRUE(reversed) << "without it the noise is seen";
}

// ---- Velocity
// ---------------------------------------------------------------------------------------------------

TEST(ExtrapolatedVelocity, IsTheDifferenceOfThePositionsWhereItIsDifferentiated) {
  auto settings = settings_of(0.004, 0.003, 0.02, 0.0);
  settings.velocity_of_positions = true;
  settings.hysteresis = 0.1;
  settings.velocity_tolerance = 1.0;
  OnLine extrapolation;
  double last = 0.0;
  for (int i = 1; i < 2000; ++i) {
    const double t = seconds(i);
    const ExtrapolatedValues& values =
        extrapolation.step({0, 5.0 * std::sin(4.0 * t)}, 20.0 * std::cos(4.0 * t), settings);
    ASSERT_NEAR(values.velocity, (values.position.value - last) / kPeriod, 1e-9);
    last = values.position.value;
  }
}

// ---- Rings and large positions
// ----------------------------------------------------------------------------------

TEST(ExtrapolationOnARing, IsThatOfALineAcrossTheEndsAndAfterAnyNumberOfTurns) {
  const Modulo ring{true, 360.0, -180.0};
  auto settings = settings_of(0.004, 0.003, 0.02, 0.03);
  settings.hysteresis = 0.5;
  settings.velocity_tolerance = 2.0;
  for (const std::int64_t turns : {std::int64_t{0}, std::int64_t{1} << 40, std::int64_t{1} << 62}) {
    OnLine line;
    Extrapolation extrapolation;
    extrapolation.configure(ring, kPeriod, 0.0);
    extrapolation.reset({turns, 0.0});
    for (int i = 1; i < 3000; ++i) {
      const double t = seconds(i);
      const double position = 2000.0 * std::sin(1.5 * t);
      const double velocity = 3000.0 * std::cos(1.5 * t);
      const ExtrapolatedValues& on_line = line.step({0, position}, velocity, settings);
      const ExtrapolatedValues& values =
          extrapolation.step(advanced({turns, 0.0}, position, ring), velocity, settings);
      const auto distance = [&](AxisPosition to) { return difference(to, {turns, 0.0}, ring).rounded(); };
      ASSERT_TRUE(ring.contains(values.position.value));
      ASSERT_TRUE(ring.contains(values.filtered_position.value));
      ASSERT_NEAR(distance(values.position), on_line.position.value, 1e-10);
      ASSERT_NEAR(distance(values.filtered_position), on_line.filtered_position.value, 1e-10);
      ASSERT_EQ(values.velocity, on_line.velocity);
    }
  }
}

TEST(ExtrapolationFarOut, LosesNothingButTheLastBitOfThePosition) {
  const double far = 0x1p39;  // its last bit is 2^-13
  const double bit = 0x1p-13;
  const auto settings = settings_of(0.4, 0.3, 0.0, 0.0);
  OnLine near;
  Extrapolation extrapolation;
  extrapolation.configure({}, kPeriod, 0.0);
  extrapolation.reset({0, far});
  for (int i = 1; i < 5000; ++i) {
    const double position = i * 8.0 * bit;  // both see the same numbers
    const double velocity = 8.0 * bit / kPeriod;
    const double expected = near.position(position, velocity, settings);
    const double seen = extrapolation.step({0, far + position}, velocity, settings).position.value;
    ASSERT_NEAR(seen - far, expected, 0.5 * bit + 1e-9);
  }
}

// ---- Changes at run time
// ----------------------------------------------------------------------------------------

TEST(ExtrapolationSettingsAtRunTime, ChangingThePositionFilterAtConstantVelocityIsNotNoticed) {
  auto settings = settings_of(0.01, 0.0, 0.02, 0.01);
  OnLine extrapolation;
  const double v = 400.0;
  const std::array<std::array<double, 2>, 5> filters = {
      {{0.05, 0.0}, {0.05, 0.03}, {0.0, 0.03}, {0.0, 0.0}, {0.2, 0.1}}};
  int tick = 0;
  const auto run = [&](int ticks, bool check) {
    for (int i = 0; i < ticks; ++i) {
      ++tick;
      const double seen = extrapolation.position(v * seconds(tick), v, settings);
      if (!check) continue;
      const double shift = kPeriod + settings.position_lags[0] + settings.position_lags[1];
      ASSERT_NEAR(seen, v * (seconds(tick) + kPeriod), 1e-9);
      ASSERT_NEAR(extrapolation.values().filtered_position.value, v * (seconds(tick) + kPeriod - shift),
                  1e-9);
    }
  };
  run(1000, false);
  for (const auto& [t1, t2] : filters) {
    set(settings.position_lags, t1, t2);
    run(200, true);
  }
}

TEST(ExtrapolationSettingsAtRunTime, ChangingTheFiltersInAcceleratedMotionDoesNotStep) {
  for (const bool compensated : {false, true}) {
    auto settings = settings_of(0.02, 0.01, 0.03, 0.02);
    settings.makes_up_for_leading_axis = compensated;
    OnLine extrapolation;
    double last = 0.0;
    for (int i = 1; i < 3000; ++i) {
      const double t = seconds(i);
      if (i % 100 == 0) {
        const double more = i % 200 == 0 ? 1.0 : 1.5;
        set(settings.position_lags, 0.02 * more, 0.01 / more);
        set(settings.velocity_lags, 0.03 / more, 0.02 * more);
      }
      const double seen =
          extrapolation.position(10.0 * (1.0 - std::cos(5.0 * t)), 50.0 * std::sin(5.0 * t), settings);
      // Velocities reach 50, and extrapolation and lags overshoot them by far less than as much again.
      ASSERT_LE(std::abs(seen - last), 2.0 * 50.0 * kPeriod) << "tick " << i;
      last = seen;
    }
  }
}

TEST(ExtrapolationSettingsAtRunTime, FollowingAxisDependentTimeCountsAtOnce) {
  ExtrapolationSettings settings;
  OnLine extrapolation;
  for (int i = 1; i <= 10; ++i) extrapolation.position(100.0 * seconds(i), 100.0, settings);
  settings.further_time = 0.001;
  EXPECT_DOUBLE_EQ(extrapolation.position(100.0 * seconds(11), 100.0, settings),
                   100.0 * (seconds(11) + kPeriod + 0.001));
}

TEST(ExtrapolationSettingsAtRunTime, WhatIsNegativeOrNoNumberCountsAsZero) {
  OnLine plain;
  OnLine strange;
  const ExtrapolationSettings none;
  for (const double value : {std::nan(""), -1.0, -std::numeric_limits<double>::infinity()}) {
    auto settings = settings_of(value, value, value, value);
    settings.further_time = value;
    settings.velocity_tolerance = value;
    settings.hysteresis = value;
    for (int i = 1; i < 20; ++i)
      ASSERT_EQ(strange.position(i, 10.0 * i, settings), plain.position(i, 10.0 * i, none));
  }
}

TEST(ExtrapolationSettingsAtRunTime, TimesWithoutEndGiveFiniteValues) {
  const double infinity = std::numeric_limits<double>::infinity();
  auto settings = settings_of(infinity, 1e12, infinity, 1e12);
  settings.further_time = infinity;
  OnLine extrapolation;
  for (int i = 1; i < 100; ++i) {
    ASSERT_TRUE(std::isfinite(extrapolation.position(i, 1.0, settings)));
    settings.position_lags[0] = i % 2 == 0 ? infinity : 0.0;
  }
}

// ---- Homing
// -----------------------------------------------------------------------------------------------------

TEST(ExtrapolationShiftedByHoming, GoesOnAsIfThePositionsHadAlwaysBeenThere) {
  auto settings = settings_of(0.004, 0.003, 0.02, 0.03);
  settings.velocity_of_positions = true;
  settings.hysteresis = 0.25;
  OnLine shifted;
  OnLine plain;
  double by = 0.0;
  for (int i = 1; i < 500; ++i) {
    const double t = seconds(i);
    if (i == 250) shifted.shift(by = 64.0);
    const double position = 2.0 * std::sin(6.0 * t);
    const double velocity = 12.0 * std::cos(6.0 * t);
    const ExtrapolatedValues& expected = plain.step({0, position}, velocity, settings);
    const ExtrapolatedValues& values = shifted.step({0, position + by}, velocity, settings);
    ASSERT_NEAR(values.position.value, expected.position.value + by, 1e-12);
    ASSERT_NEAR(values.velocity, expected.velocity, 1e-10);
  }
}

}  // namespace
}  // namespace lockstep::extrapolation_test
