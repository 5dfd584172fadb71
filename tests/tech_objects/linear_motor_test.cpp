// A linear motor: the loop that asks for a current, and the machine that forces move. The figures are those
// of the source's own example: 2.029 kg at 40 N/A, P 1 A/mm, D 4 A/(m/s), friction 10 N.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/drive/linear_motor_plant.hpp"
#include "tests/support/property.hpp"

namespace lockstep::linear_motor_test {
namespace {

constexpr double kForceConstant = 40.0;         // [N/A]
constexpr double kMass = 0.829 + 1.2;           // [kg]
constexpr double kMaximumSpeed = 781.25;        // [mm/s] basic setting
constexpr double kAcceleration = 30517.578125;  // [mm/s²] basic setting

LinearMotorPlantSettings reference_plant(double friction) {
  LinearMotorPlantSettings plant;
  plant.slider_mass = 0.829;
  plant.load_mass = 1.2;
  plant.friction = friction;
  return plant;
}

CurrentLoopSettings reference_loop() {
  CurrentLoopSettings loop;
  loop.proportional = 1.0;
  loop.derivative = 4.0;
  loop.maximum_current = 5.0;
  return loop;
}

// Loop and plant at one control cycle.
struct Reference {
  LinearMotorPlant plant;
  CurrentLoop loop;
  double cycle;
  double current = 0.0;

  Reference(const LinearMotorPlantSettings& machine, const CurrentLoopSettings& gains, double control_cycle)
      : cycle(control_cycle) {
    plant.configure(machine, 0.0);
    loop.configure(gains, cycle);
    loop.reset(0.0);
  }
  // @return the following error at which the loop has looked
  double step(const LoopSetpoint& setpoint) {
    const double error = setpoint.position - plant.position();
    current = loop.step(setpoint, plant.position());
    plant.step(kForceConstant * current, cycle);
    return error;
  }
  void hold(double position, double seconds) {
    for (int i = 0; i < std::lround(seconds / cycle); ++i) step({position, 0.0, 0.0});
  }
};

// From 0 to 100 mm with the basic setting: ramps of 25.6 ms and 10 mm, 153.6 ms in all.
LoopSetpoint stroke(double time) {
  constexpr double kRamp = kMaximumSpeed / kAcceleration, kDistance = 100.0;
  constexpr double kDuration = kDistance / kMaximumSpeed + kRamp;
  if (time <= 0.0) return {};
  if (time < kRamp) return {0.5 * kAcceleration * time * time, kAcceleration * time, kAcceleration};
  if (time < kDuration - kRamp) return {kMaximumSpeed * (time - 0.5 * kRamp), kMaximumSpeed, 0.0};
  const double left = kDuration - time;
  if (left <= 0.0) return {kDistance, 0.0, 0.0};
  return {kDistance - 0.5 * kAcceleration * left * left, kAcceleration * left, -kAcceleration};
}

class ControlCycle : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(From50To200Microseconds, ControlCycle, ::testing::Values(50e-6, 100e-6, 200e-6));

// Second order: ω = √(P c_f / m), ζ = D c_f / (2 √(P c_f m)); the overshoot of a step is exp(-π ζ / √(1 -
// ζ²)) after π / (ω √(1 - ζ²)): the D part damps setpoint and actual value alike, but the setpoint of a step
// has no velocity.
TEST_P(ControlCycle, OvershootsAStepByWhatTheClosedFormSays) {
  const double stiffness = 1000.0 * kForceConstant;  // [N/m]
  const double omega = std::sqrt(stiffness / kMass);
  const double zeta = 4.0 * kForceConstant / (2.0 * std::sqrt(stiffness * kMass));
  EXPECT_NEAR(omega, 140.4, 0.05);
  EXPECT_NEAR(zeta, 0.2808, 5e-5);
  const double damped = std::sqrt(1.0 - zeta * zeta);
  const double overshoot = std::exp(-std::numbers::pi * zeta / damped);
  const double peak_time = std::numbers::pi / (omega * damped);
  EXPECT_NEAR(overshoot, 0.399, 5e-4);
  EXPECT_NEAR(peak_time, 0.0233, 5e-5);

  Reference motor(reference_plant(0.0), reference_loop(), GetParam());
  constexpr double kStep = 0.99609375;  // 51 increments
  double highest = 0.0, reached_at = 0.0, settled_at = 0.0;
  for (int i = 1; i <= std::lround(0.3 / motor.cycle); ++i) {
    motor.step({kStep, 0.0, 0.0});
    if (i == 1) {
      EXPECT_EQ(motor.current, kStep);
    }
    if (motor.plant.position() > highest) {
      highest = motor.plant.position();
      reached_at = i * motor.cycle;
    }
    if (std::abs(motor.plant.position() - kStep) > 0.02 * kStep) settled_at = i * motor.cycle;
  }
  EXPECT_NEAR(highest / kStep - 1.0, overshoot, 0.03 * overshoot);
  EXPECT_NEAR(reached_at, peak_time, 0.0012);
  EXPECT_NEAR(settled_at, 0.098, 0.004);
}

struct Followed {
  double greatest_error = 0.0;
  double at = 0.0;
  double greatest_current = 0.0;
  double at_rest = 0.0;
};
Followed follow_stroke(const CurrentLoopSettings& gains, double cycle) {
  Reference motor(reference_plant(10.0), gains, cycle);
  Followed followed;
  const auto cycles = static_cast<int>(std::lround(0.5 / cycle));
  for (int i = 0; i < cycles; ++i) {
    const double error = std::abs(motor.step(stroke(i * cycle)));
    followed.greatest_current = std::max(followed.greatest_current, std::abs(motor.current));
    if (error > followed.greatest_error) followed = {error, i * cycle, followed.greatest_current, 0.0};
    followed.at_rest = error;
  }
  return followed;
}

TEST_P(ControlCycle, FollowsAStrokeWithAnErrorOfTwoAndAHalfMillimetres) {
  const Followed followed = follow_stroke(reference_loop(), GetParam());
  EXPECT_NEAR(followed.greatest_error, 2.512, 0.02);
  EXPECT_NEAR(followed.at, 0.0233, 0.0012);
  EXPECT_NEAR(followed.greatest_current, 2.65, 0.05);
  EXPECT_LE(followed.at_rest, 0.25);  // friction / (c_f P)
}

TEST_P(ControlCycle, FollowsItWithAFiftiethOfThatErrorByFeedForward) {
  CurrentLoopSettings gains = reference_loop();
  gains.friction = 0.25;
  gains.acceleration = gains.deceleration = 50.7;
  const Followed followed = follow_stroke(gains, GetParam());
  EXPECT_LE(followed.greatest_error, 0.05);
  EXPECT_GT(followed.greatest_error, 0.0);
}

// What the figures have of the control cycle is less than a hundredth of them.
TEST(LinearMotor, HasTheSameFiguresWithHalfTheControlCycle) {
  const auto overshoot = [](double cycle) {
    Reference motor(reference_plant(0.0), reference_loop(), cycle);
    double highest = 0.0;
    for (int i = 0; i < std::lround(0.1 / cycle); ++i) {
      motor.step({1.0, 0.0, 0.0});
      highest = std::max(highest, motor.plant.position());
    }
    return highest - 1.0;
  };
  EXPECT_NEAR(overshoot(50e-6) / overshoot(100e-6), 1.0, 0.01);
  const Followed whole = follow_stroke(reference_loop(), 100e-6),
                 half = follow_stroke(reference_loop(), 50e-6);
  EXPECT_NEAR(half.greatest_error / whole.greatest_error, 1.0, 0.01);
  EXPECT_NEAR(half.at / whole.at, 1.0, 0.01);
  EXPECT_NEAR(half.greatest_current / whole.greatest_current, 1.0, 0.01);
}

TEST_P(ControlCycle, CarriesAWeightByItsErrorAnOffsetOrAnIntegralPart) {
  LinearMotorPlantSettings upright = reference_plant(0.0);
  upright.inclination = 90.0;
  const double weight = kMass * 9.81 / kForceConstant;  // [A], and at P 1 A/mm so many mm
  EXPECT_NEAR(weight, 0.49761, 1e-5);
  Reference pd(upright, reference_loop(), GetParam());
  pd.hold(0.0, 1.0);
  EXPECT_NEAR(pd.plant.position(), -weight, 5e-4);

  CurrentLoopSettings gains = reference_loop();
  gains.offset = 21 * 6.0 / 256.0;
  Reference with_offset(upright, gains, GetParam());
  with_offset.hold(0.0, 1.0);
  EXPECT_NEAR(with_offset.plant.position(), gains.offset - weight, 5e-4);

  gains = reference_loop();
  gains.integral = 20.0;
  Reference pid(upright, gains, GetParam());
  pid.hold(0.0, 0.5);
  EXPECT_LT(std::abs(pid.plant.position()), 1e-3);
}

TEST(CurrentLoop, TakesTheFeedForwardOfHowTheSpeedChanges) {
  CurrentLoop loop;
  loop.configure({.friction = 0.5, .acceleration = 100.0, .deceleration = 20.0, .maximum_current = 9.0},
                 1e-4);
  loop.reset(0.0);
  EXPECT_DOUBLE_EQ(loop.step({0.0, 0.0, 10'000.0}, 0.0), 1.0);         // from rest: the speed grows
  EXPECT_DOUBLE_EQ(loop.step({0.0, 1.0, 10'000.0}, 0.0), 0.5 + 1.0);   // faster
  EXPECT_DOUBLE_EQ(loop.step({0.0, 1.0, -10'000.0}, 0.0), 0.5 - 0.2);  // slower
  EXPECT_DOUBLE_EQ(loop.step({0.0, -1.0, -10'000.0}, 0.0), -0.5 - 1.0);
  EXPECT_DOUBLE_EQ(loop.step({0.0, -1.0, 10'000.0}, 0.0), -0.5 + 0.2);
}

TEST(CurrentLoop, KeepsToItsMaximumAndToTheBand) {
  CurrentLoop loop;
  loop.configure({.proportional = 1.0, .maximum_current = 3.0}, 1e-4);
  loop.reset(0.0);
  EXPECT_EQ(loop.step({10.0, 0.0, 0.0}, 0.0), 3.0);
  EXPECT_EQ(loop.excess(), 7.0);
  EXPECT_EQ(loop.step({-10.0, 0.0, 0.0}, 0.0), -3.0);
  EXPECT_EQ(loop.step({10.0, 0.0, 0.0}, 0.0, {-1.0, 2.0}), 2.0);
  EXPECT_EQ(loop.step({-10.0, 0.0, 0.0}, 0.0, {-1.0, 2.0}), -1.0);
  EXPECT_EQ(loop.step({0.0, 0.0, 0.0}, 0.0, {1.0, 2.0}), 1.0);
  EXPECT_EQ(loop.step({0.0, 0.0, 0.0}, 0.0, {-9.0, 9.0}), 0.0);
}

TEST(CurrentLoop, GathersNothingWhileItsLimitHoldsItBack) {
  CurrentLoop loop;
  loop.configure({.proportional = 1.0, .integral = 10.0, .maximum_current = 2.0}, 1e-3);
  loop.reset(0.0);
  for (int i = 0; i < 10'000; ++i) loop.step({5.0, 0.0, 0.0}, 0.0);
  // Had it gathered, it would have to unwind by as much.
  EXPECT_EQ(loop.step({0.0, 0.0, 0.0}, 0.0), 0.0);
  for (int i = 0; i < 100; ++i) loop.step({1.0, 0.0, 0.0}, 0.0);
  EXPECT_NEAR(loop.step({0.0, 0.0, 0.0}, 0.0), 1.0, 1e-9);
}

// ---- The machine alone

TEST(LinearMotorPlant, MovesExactlyByAConstantForce) {
  LinearMotorPlant plant;
  plant.configure(reference_plant(10.0), 5.0);
  for (int i = 0; i < 1000; ++i) plant.step(30.0, 1e-4);
  const double acceleration = (30.0 - 10.0) / kMass * 1000.0;  // [mm/s²]
  EXPECT_NEAR(plant.velocity(), acceleration * 0.1, 1e-9);
  EXPECT_NEAR(plant.position(), 5.0 + 0.5 * acceleration * 0.01, 1e-9);
}

TEST(LinearMotorPlant, SticksUntilAForceExceedsItsFriction) {
  LinearMotorPlant plant;
  plant.configure(reference_plant(10.0), 0.0);
  plant.step(10.0, 1.0);
  EXPECT_EQ(plant.position(), 0.0);
  plant.step(-10.0, 1.0);
  EXPECT_EQ(plant.position(), 0.0);
  plant.step(10.001, 1.0);
  EXPECT_GT(plant.position(), 0.0);
}

TEST(LinearMotorPlant, TurnsWithinAStepByTheFrictionOfBothDirections) {
  // Thrown forwards, pushed back with 30 N: slower by 40 N until it rests, then back by 20 N; in one step.
  LinearMotorPlant plant;
  plant.configure(reference_plant(10.0), 0.0);
  plant.step(50.0, 0.1);
  const double thrown = plant.velocity();
  const double from = plant.position();
  const double until_rest = thrown / (40.0 / kMass * 1000.0);
  const double highest = from + 0.5 * thrown * until_rest;
  const double back = 0.2 - until_rest;
  ASSERT_GT(back, 0.0);
  plant.step(-30.0, 0.2);
  EXPECT_NEAR(plant.velocity(), -20.0 / kMass * 1000.0 * back, 1e-9);
  EXPECT_NEAR(plant.position(), highest - 0.5 * 20.0 / kMass * 1000.0 * back * back, 1e-9);
}

TEST(LinearMotorPlant, RestsInAStopByItsStiffness) {
  LinearMotorPlantSettings settings = reference_plant(0.0);
  settings.stops = {{.position = 35.0, .side = 1, .stiffness = 1e6, .damping = 1500.0}};
  LinearMotorPlant plant;
  plant.configure(settings, 34.0);
  double deepest = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    plant.step(20.0, 1e-4);
    deepest = std::max(deepest, plant.position());
  }
  EXPECT_NEAR(plant.position(), 35.0 + 20.0 / 1e6 * 1000.0, 1e-9);
  EXPECT_LT(deepest, 35.3);
  plant.step(-20.0, 0.1);
  EXPECT_LT(plant.position(), 35.0);  // it pushes, and holds nothing back
}

TEST(LinearMotorPlant, SwingsOnASpringWithThePeriodOfMassAndStiffness) {
  LinearMotorPlantSettings settings = reference_plant(0.0);
  settings.spring = {.position = 10.0, .stiffness = 500.0};
  LinearMotorPlant plant;
  plant.configure(settings, 15.0);
  const double period = 2.0 * std::numbers::pi * std::sqrt(kMass / 500.0);
  const auto steps = static_cast<int>(std::lround(period / 1e-4));
  double lowest = 15.0;
  for (int i = 0; i < steps; ++i) {
    plant.step(0.0, period / steps);
    lowest = std::min(lowest, plant.position());
  }
  EXPECT_NEAR(plant.position(), 15.0, 1e-3);
  EXPECT_NEAR(lowest, 5.0, 1e-3);
}

TEST(LinearMotorPlant, TakesNoForceFromATagThatIsNoNumber) {
  LREAL force = std::nan("");
  LinearMotorPlantSettings settings = reference_plant(0.0);
  settings.external_force = &force;
  LinearMotorPlant plant;
  plant.configure(settings, 0.0);
  plant.step(0.0, 0.1);
  EXPECT_EQ(plant.position(), 0.0);
  force = HUGE_VAL;
  plant.step(0.0, 0.1);
  EXPECT_EQ(plant.position(), 0.0);
  force = kMass;
  plant.step(0.0, 1.0);
  EXPECT_NEAR(plant.position(), 500.0, 1e-9);
}

// Where nothing can be met a step is taken at once; beside a stop out of reach it is looked for.
TEST(LinearMotorPlantProperty, MovesToTheBitAsBesideAStopThatItNeverMeets) {
  int turns = 0, rests = 0;
  test::for_each_seed(1, test::cases(300, 30'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto between = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto chance = [&](double part) { return between(0.0, 1.0) < part; };
    LinearMotorPlantSettings settings;
    settings.slider_mass = between(0.05, 5.0);
    settings.friction = chance(0.8) ? between(0.0, 30.0) : 0.0;
    settings.inclination = chance(0.5) ? between(-90.0, 90.0) : 0.0;
    LREAL push = 0.0;
    if (chance(0.5)) settings.external_force = &push;
    const double start = between(-100.0, 100.0), cycle = between(20e-6, 2e-3);
    LinearMotorPlant alone, beside;
    alone.configure(settings, start);
    settings.stops.push_back({1e9, 1, 1e5, 0.0});
    beside.configure(settings, start);
    double force = 0.0;
    for (int i = 0; i < 1000; ++i) {
      if (chance(0.05)) force = chance(0.3) ? 0.0 : between(-60.0, 60.0);
      if (chance(0.02)) push = chance(0.5) ? 0.0 : between(-60.0, 60.0);
      const double before = alone.velocity();
      alone.step(force, cycle);
      beside.step(force, cycle);
      ASSERT_EQ(alone.position(), beside.position()) << i;
      ASSERT_EQ(alone.velocity(), beside.velocity()) << i;
      turns += before * alone.velocity() < 0.0 ? 1 : 0;
      rests += alone.velocity() == 0.0 ? 1 : 0;
    }
  });
  EXPECT_GT(turns, 100);
  EXPECT_GT(rests, 1000);
}

// Without current and external force nothing gives it energy, however it is thrown against stops and spring.
TEST(LinearMotorPlantProperty, GainsNoEnergyByItself) {
  test::for_each_seed(1, test::cases(300, 30'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto between = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto chance = [&] { return between(0.0, 1.0) < 0.5; };
    LinearMotorPlantSettings settings;
    settings.slider_mass = between(0.05, 5.0);
    settings.friction = chance() ? between(0.0, 30.0) : 0.0;
    settings.inclination = between(-90.0, 90.0);
    if (chance()) settings.spring = {between(-20.0, 20.0), between(1.0, 1e5)};
    for (const int side : {-1, 1})
      settings.stops.push_back(
          {side * between(1.0, 50.0), side, between(1e3, 1e6), chance() ? between(0.0, 3000.0) : 0.0});
    LREAL push = between(-500.0, 500.0);
    settings.external_force = &push;
    LinearMotorPlant plant;
    plant.configure(settings, 0.0);
    plant.step(0.0, between(0.0, 0.01));
    push = 0.0;
    const double cycle = between(20e-6, 250e-6);
    double before = plant.energy();
    const double scale = std::abs(before) + 1.0;
    for (int i = 0; i < 2000; ++i) {
      plant.step(0.0, cycle);
      const double now = plant.energy();
      ASSERT_LE(now, before + 1e-9 * scale) << i;
      before = now;
    }
  });
}

}  // namespace
}  // namespace lockstep::linear_motor_test
