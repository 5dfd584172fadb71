// The sum of a base motion of the axis' own and what is superimposed on it keeps the limits of acceleration
// and velocity, also where one of them has taken over more than its own values permit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/property.hpp"
#include "tests/support/superimposing.hpp"

namespace lockstep::superimposed_sum_test {
namespace {

// Limits of the axis.
constexpr double kMaximum = 5000.0;  // [u/s²]
constexpr double kFastest = 500.0;   // [u/s]

struct Machine : test::Superimposing {
  Machine() { continuity[1].acceleration = false; }

  double acceleration() const { return axis_.data.Acceleration; }

  /// The maximum acceleration of some ticks.
  double maximum(int ticks) {
    double maximum = 0.0;
    for (int i = 0; i < ticks; ++i) {
      tick();
      maximum = std::max(maximum, std::abs(acceleration()));
    }
    return maximum;
  }

  /// The maximum velocity of some ticks.
  double fastest(int ticks) {
    double maximum = 0.0;
    for (int i = 0; i < ticks; ++i) {
      tick();
      maximum = std::max(maximum, std::abs(velocity()));
    }
    return maximum;
  }

  /// The first superimposed motion, without jerk limit, or a further one.
  void superimpose(double velocity, double acceleration, double jerk = 0.0) {
    move.Execute = false;
    tick();
    move.Distance = 1000.0;
    move.VelocityDiff = velocity;
    move.Acceleration = move.Deceleration = acceleration;
    move.Jerk = jerk;
    move.Execute = true;
  }

  /// Jogs forward; also with other inputs while it does.
  void jog_at(double velocity, double acceleration, double jerk) {
    jog.Velocity = velocity;
    jog.Acceleration = jog.Deceleration = acceleration;
    jog.Jerk = jerk;
    jog.JogForward = true;
  }
};

TEST(SumOfAccelerations, CountsWhatTheBaseMotionRunsDownYet) {
  Machine m;
  m.relative.Distance = -300.0;
  m.relative.Velocity = 450.0;
  m.relative.Acceleration = 4000.0;
  m.relative.Jerk = 100000.0;
  m.relative.Execute = true;
  m.run(42);
  ASSERT_EQ(m.acceleration(), -4000.0);
  m.halt.Deceleration = 300.0;
  m.halt.Jerk = 50000.0;
  m.halt.Execute = true;
  m.run(5);
  ASSERT_LT(m.acceleration(), -3500.0);
  m.move.Distance = -20.0;
  m.move.VelocityDiff = 200.0;
  m.move.Acceleration = 5000.0;
  m.move.Jerk = 0.0;
  m.move.Execute = true;
  EXPECT_LE(m.maximum(60), kMaximum);
  EXPECT_TRUE(m.move.Busy);
  EXPECT_GT(m.maximum(100), 4500.0) << "all but the 300 that the halt has later";
}

TEST(SumOfAccelerations, CountsWhatTheSuperimposedMotionRunsDownYet) {
  Machine m;
  m.run_velocity.Acceleration = m.run_velocity.Deceleration = 4800.0;
  m.run_velocity.Jerk = 0.0;
  m.run_at(100.0);
  m.superimpose(250.0, 2500.0);
  m.run(40);
  ASSERT_EQ(m.acceleration(), 2500.0);
  m.superimpose(100.0, 100.0, 50000.0);  // runs down the 2500 in 48 ms
  m.run(2);
  m.axis_.data.Override.Velocity = 250.0;  // so that the base motion is planned anew
  EXPECT_LE(m.maximum(45), kMaximum * (1 + 1e-12));
  EXPECT_NEAR(m.maximum(10), 4900.0, 1e-6) << "it has got back what was only run down";
}

TEST(SumOfAccelerations, CountsTheLastTickOfWhatIsSuperimposed) {
  Machine m;
  m.run_velocity.Acceleration = m.run_velocity.Deceleration = 5000.0;
  m.run_velocity.Jerk = 0.0;
  m.run_at(100.0);
  m.superimpose(50.0, 300.0);
  m.run(220);
  m.halt_superimposed.Deceleration = 300.0;
  m.halt_superimposed.Jerk = 0.0;
  m.halt_superimposed.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.velocity() < 100.25; }));
  ASSERT_TRUE(m.halt_superimposed.Busy);
  m.axis_.data.Override.Velocity = 50.0;
  const double before = m.velocity();
  m.tick();
  EXPECT_GE(m.velocity(), before - 0.001 * kMaximum * (1 + 1e-9));
}

TEST(SumOfAccelerations, CutsWhatWasGivenToWhatTheBaseMotionLeaves) {
  Machine m;
  m.run_at(400.0);
  m.continuity[1] = {false, false, 5000.0, 100000.0};
  m.halt.Deceleration = 4000.0;
  m.halt.Jerk = 0.0;
  m.halt.Execute = true;
  m.given.Enable = true;
  m.given.VelocityDiff = 40.0;
  m.given.AccelerationDiff = -3000.0;
  m.run(5);
  m.halt_superimposed.Deceleration = 500.0;
  m.halt_superimposed.Jerk = 5000.0;
  m.halt_superimposed.Execute = true;
  m.run(1);
  const double maximum = m.maximum(60);
  EXPECT_LE(maximum, kMaximum);
  EXPECT_GT(maximum, kMaximum - 10.0);
  EXPECT_TRUE(m.halt_superimposed.Busy);
}

TEST(SumOfAccelerations, IsKeptWhereHomingHasFoundItsMark) {
  test::Rig rig;
  Axis& axis = rig.axis("Axis", [](AxisData& data) {
    data.VirtualAxis.Mode = 0;
    test::Superimposing::limit(data);
    data.DynamicDefaults.Acceleration = data.DynamicDefaults.Deceleration = kMaximum;
    data.DynamicDefaults.Jerk = 100000.0;
    data.Homing.ApproachVelocity = 200.0;
    data.Homing.ReferencingVelocity = 100.0;
    data.Sensor[0].ActiveHoming.HomePositionOffset = -100.0;
  });
  axis.drive_settings.signals.zero_marks = ZeroMarks{30.0, 1000.0};
  rig.continuity[0] = {.homing = true};
  auto& power = rig.block<MC_Power>();
  auto& home = rig.block<MC_Home>();
  auto& move = rig.block<MC_MoveSuperimposed>();
  power.Axis = home.Axis = move.Axis = &axis;
  power.Enable = true;
  rig.run(10);
  home.Mode = 3;
  home.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return axis.data.Velocity == 100.0 && axis.data.Position > 5.0; }));
  move.Distance = -300.0;
  move.VelocityDiff = 90.0;
  move.Acceleration = move.Deceleration = 200.0;
  move.Jerk = 2000.0;
  move.Execute = true;
  double maximum = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    maximum = std::max(maximum, std::abs(axis.data.Acceleration));
    return home.Done;
  }));
  EXPECT_LE(maximum, kMaximum * (1 + 1e-12));
  EXPECT_GT(maximum, 4500.0);
}

// ---- Velocities
// -------------------------------------------------------------------------------------------------

TEST(SumOfVelocities, CountsMoreThanTheJerkThatIsSuperimposed) {
  Machine m;
  m.jog_at(450.0, 3800.0, 0.0);
  m.move.Distance = -20.0;
  m.move.VelocityDiff = 40.0;
  m.move.Acceleration = m.move.Deceleration = 1000.0;
  m.move.Jerk = 90000.0;
  m.move.Execute = true;
  m.run(80);
  ASSERT_TRUE(m.move.Busy);
  m.jog_at(450.0, 3800.0, 10000.0);  // would need 722 u/s for what it runs down
  EXPECT_LE(m.fastest(300), kFastest * (1 + 1e-12));
}

TEST(SumOfVelocities, IsKeptByAJogThatHasAJerkLimitFromNowOn) {
  Machine m;
  m.jog_at(kFastest, kMaximum, 0.0);
  m.run(90);
  ASSERT_GT(m.velocity(), 430.0);
  m.jog_at(kFastest, kMaximum, 50000.0);
  EXPECT_LE(m.fastest(300), kFastest * (1 + 1e-12));
  EXPECT_EQ(m.velocity(), kFastest);
}

TEST(SumOfVelocities, CountsTheSuperimposedOneUntilThatHasSlowedDown) {
  Machine m;
  m.run_velocity.Acceleration = m.run_velocity.Deceleration = 3000.0;
  m.run_velocity.Jerk = 0.0;
  m.run_at(300.0);
  m.superimpose(190.0, 2000.0);
  m.run(120);
  ASSERT_EQ(m.velocity(), 490.0);
  m.superimpose(80.0, 300.0);
  m.run(10);
  m.axis_.data.Override.Velocity = 200.0;
  EXPECT_LE(m.fastest(600), kFastest * (1 + 1e-12));
  EXPECT_NEAR(m.velocity(), kFastest, 1e-9) << "the base motion has all that is left then";
}

TEST(SumOfVelocities, IsKeptByABaseMotionThatRunsItsAccelerationDownBesideAnother) {
  Machine m;
  m.jog_at(400.0, 2000.0, 0.0);
  m.tick();
  m.superimpose(95.0, 2000.0, 50000.0);
  m.move.Deceleration = 200.0;
  ASSERT_TRUE(m.run_until([&] { return m.velocity() > 445.0; }));
  m.jog_at(100.0, 2000.0, 1000.0);
  m.move.Execute = false;
  EXPECT_LE(m.fastest(600), kFastest * (1 + 1e-12));
}

TEST(SumOfVelocities, CountsWhereTheSuperimposedOneIsStillComingTo) {
  Machine m;
  m.jog_at(300.0, 2500.0, 90000.0);
  ASSERT_TRUE(m.run_until([&] { return m.velocity() == 300.0; }));
  m.superimpose(150.0, 1600.0);
  m.run(60);
  m.jog_at(350.0, 2500.0, 90000.0);
  m.run(17);
  m.halt_superimposed.Deceleration = 2500.0;
  m.halt_superimposed.Jerk = 50000.0;  // of which the base motion is left the other half
  m.halt_superimposed.Execute = true;
  m.run(17);
  m.jog_at(350.0, 2400.0, 90000.0);
  EXPECT_LE(m.fastest(60), kFastest * (1 + 1e-12));
}

// ---- At random
// -------------------------------------------------------------------------------------------------

/// Jobs that take each other over in full motion, with dynamic values of all sizes, and no jerk limit now and
/// then.
class TakingOver {
 public:
  explicit TakingOver(std::uint64_t seed) : random_(seed) {
    for (test::Continuity& rule : m_.continuity) rule.acceleration = false;
    m_.axis_.data.DynamicDefaults.Acceleration = m_.axis_.data.DynamicDefaults.Deceleration = 3000.0;
  }

  /// The maximum acceleration that has come up [u/s²].
  double run() {
    for (int action = 0; action < 40 && kept_; ++action) {
      act();
      for (int i = pick(chance(0.2) ? 150 : 25); i >= 0 && kept_; --i) tick();
    }
    return maximum_;
  }

 private:
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double acceleration() { return chance(0.3) ? uniform(50.0, 500.0) : uniform(500.0, 6000.0); }
  double jerk() { return chance(0.3) ? 0.0 : uniform(500.0, 150000.0); }

  void tick() {
    m_.tick();
    maximum_ = std::max(maximum_, std::abs(m_.acceleration()));
    kept_ = maximum_ <= kMaximum * (1 + 1e-9) && std::abs(m_.velocity()) <= kFastest * (1 + 1e-9);
    EXPECT_TRUE(kept_) << "acceleration " << m_.acceleration() << ", velocity " << m_.velocity() << " at "
                       << m_.controller.now();
  }

  void begin(auto& block) {
    block.Execute = false;
    tick();
    block.Deceleration = acceleration();
    block.Jerk = jerk();
    block.Execute = true;
  }

  void move(auto& block) {
    block.Acceleration = acceleration();
    begin(block);
  }

  void act() {
    switch (pick(9)) {
      case 0:
        m_.relative.Distance = uniform(-200.0, 200.0);
        m_.relative.Velocity = uniform(10.0, 600.0);
        return move(m_.relative);
      case 1:
        m_.run_velocity.Velocity = uniform(-600.0, 600.0);
        return move(m_.run_velocity);
      case 2:
        m_.halt.BufferMode = chance(0.5) ? 1 : 0;
        return begin(m_.halt);
      case 3:
        return jog();
      case 4:
        m_.axis_.data.Override.Velocity = uniform(0.0, 200.0);
        return;
      case 5:
        m_.halt_superimposed.AbortAcceleration = chance(0.5);
        return begin(m_.halt_superimposed);
      default:
        m_.move.Distance = uniform(-100.0, 100.0);
        m_.move.VelocityDiff = uniform(10.0, 600.0);
        return move(m_.move);
    }
  }

  /// Begins, changes or ends.
  void jog() {
    m_.jog.JogForward = chance(0.6);
    m_.jog.JogBackward = !m_.jog.JogForward && chance(0.5);
    m_.jog.Velocity = uniform(10.0, 600.0);
    m_.jog.Acceleration = acceleration();
    m_.jog.Deceleration = acceleration();
    m_.jog.Jerk = jerk();
  }

  std::mt19937_64 random_;
  Machine m_;
  double maximum_ = 0.0;
  bool kept_ = true;
};

TEST(SumOfAccelerations, IsKeptByJobsThatTakeOverAtRandom) {
  double maximum = 0.0;
  const test::Cases ran = test::for_each_seed(1, test::cases(300, 100000), [&](const test::Case& one) {
    maximum = std::max(maximum, TakingOver(one.seed).run());
  });
  if (ran.alone) return;
  EXPECT_GT(maximum, 4990.0);
}

}  // namespace
}  // namespace lockstep::superimposed_sum_test
