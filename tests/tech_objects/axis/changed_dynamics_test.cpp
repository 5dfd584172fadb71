// Dynamic limits and defaults that a program writes while the axis moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::changed_dynamics_test {
namespace {

using test::Rig;

struct Machine : Rig {
  Machine()
      : a(axis("Axis",
               [](AxisData& data) {
                 data.DynamicLimits = {500.0, 500.0, 5000.0, 5000.0, 100000.0};
                 data.PositioningMonitoring.MinDwellTime = 0.0;
               })),
        power(block<MC_Power>()),
        move(block<MC_MoveRelative>()),
        next(block<MC_MoveRelative>()),
        run_v(block<MC_MoveVelocity>()) {
    power.Axis = move.Axis = next.Axis = run_v.Axis = &a;
    power.Enable = true;
    run(10);
  }

  const Setpoint& now() const { return a.setpoint(); }

  Axis& a;
  MC_Power& power;
  MC_MoveRelative& move;
  MC_MoveRelative& next;
  MC_MoveVelocity& run_v;
};

// ---- Limits: they count from the next cycle on (13.1.1: DIR; 13.1.16)

TEST(DynamicLimits, OfTheAccelerationThatAreLoweredInMotionCountAtOnce) {
  Machine m;
  m.run_v.Velocity = 400.0;
  m.run_v.Acceleration = 4000.0;
  m.run_v.Jerk = 100000.0;
  m.run_v.Execute = true;
  m.run(60);
  ASSERT_EQ(m.now().acceleration, 4000.0);
  m.a.data.DynamicLimits.MaxAcceleration = 1000.0;
  m.run(31);  // the present acceleration is run down by the jerk
  EXPECT_NEAR(m.now().acceleration, 1000.0, 1e-9);
  m.a.data.DynamicLimits.MaxAcceleration = 5000.0;
  m.run(31);
  EXPECT_NEAR(m.now().acceleration, 4000.0, 1e-9) << "it may have all again";
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  EXPECT_EQ(m.a.data.Velocity, 400.0);
}

TEST(DynamicLimits, OfTheVelocityAndTheAccelerationThatAreLoweredInOneTickCountBoth) {
  Machine m;
  m.a.data.DynamicLimits = {2000.0, 2000.0, 2000.0, 2000.0, 100000.0};
  m.run_v.Velocity = 1500.0;
  m.run_v.Acceleration = m.run_v.Deceleration = 2000.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.a.data.DynamicLimits.Velocity = 21.0;  // both have been told by one number that stayed the same
  m.a.data.DynamicLimits.MaxAcceleration = 90.0;
  ASSERT_TRUE(m.run_until([&] { return m.now().velocity == 21.0; }));
}

TEST(DynamicLimits, ThatChangeInAnyWayAreFollowed) {
  constexpr double kSteps[] = {2000.0, 1999.0, 1000.0, 512.0, 90.0, 64.0, 21.0, 8.0, 1.0};
  for (const double acceleration : kSteps)
    for (const double velocity : kSteps) {
      Machine m;
      m.a.data.DynamicLimits = {2000.0, 2000.0, 2000.0, 2000.0, 100000.0};
      m.run_v.Velocity = 2000.0;
      m.run_v.Acceleration = m.run_v.Deceleration = 2000.0;
      m.run_v.Execute = true;
      m.run(1500);
      m.a.data.DynamicLimits.Velocity = velocity;
      m.a.data.DynamicLimits.MaxAcceleration = acceleration;
      ASSERT_TRUE(m.run_until([&] { return m.now().velocity <= velocity; }))
          << velocity << " u/s, " << acceleration << " u/s²: " << m.now().velocity;
    }
}

TEST(DynamicLimits, OfTheDecelerationThatAreLoweredInMotionLeaveAPositioningItsTarget) {
  Machine m;
  m.move.Distance = 60.0;
  m.move.Velocity = 300.0;
  m.move.Acceleration = m.move.Deceleration = 4000.0;
  m.move.Jerk = 100000.0;
  m.move.Execute = true;
  m.run(100);
  ASSERT_GT(m.now().velocity, 100.0);
  m.a.data.DynamicLimits.MaxDeceleration = 1000.0;
  double hardest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    const bool slows_down = m.now().velocity * m.now().acceleration < 0.0;
    if (slows_down) hardest = std::max(hardest, std::abs(m.now().acceleration));
    return m.move.Done;
  }));
  EXPECT_NEAR(hardest, 1000.0, 1e-9);
  EXPECT_EQ(m.a.data.Position, 60.0);
}

TEST(DynamicLimits, OfTheJerkThatAreLoweredInMotionCountAtOnce) {
  Machine m;
  m.move.Distance = 60.0;
  m.move.Velocity = 200.0;
  m.move.Jerk = 100000.0;
  m.move.Execute = true;
  m.run(100);
  m.a.data.DynamicLimits.MaxJerk = 10000.0;
  double before = m.now().acceleration, maximum = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    maximum = std::max(maximum, std::abs(m.now().acceleration - before));
    before = m.now().acceleration;
    return m.move.Done;
  }));
  EXPECT_NEAR(maximum, 10000.0 * m.period(), 1e-9);
  EXPECT_EQ(m.a.data.Position, 60.0);
}

/// The acceleration of the moment is run down by the jerk that this needs: the limit of the velocity counts
/// more.
TEST(DynamicLimits, OfTheJerkThatAreLoweredDoNotCarryTheVelocityBeyondItsLimit) {
  Machine m;
  m.a.data.DynamicLimits.Velocity = 100.0;
  m.continuity[0].highest_jerk = 100000.0;
  m.run_v.Velocity = 100.0;
  m.run_v.Acceleration = 3000.0;
  m.run_v.Jerk = 100000.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().velocity > 40.0; }));
  ASSERT_GT(m.now().acceleration, 2500.0);
  m.a.data.DynamicLimits.MaxJerk = 1000.0;
  for (int i = 0; i < 2000; ++i) {
    m.tick();
    ASSERT_LE(m.now().velocity, 100.0 * (1 + 1e-12)) << i;
  }
  EXPECT_TRUE(m.run_v.InVelocity);
}

/// Without a limit of the jerk before, what is too much of an acceleration is dropped.
TEST(DynamicLimits, OfTheJerkOfAJogThatHadNoneDoNotCarryTheVelocityBeyondItsLimit) {
  Machine m;
  auto& jog = m.block<MC_MoveJog>();
  jog.Axis = &m.a;
  m.a.data.DynamicLimits.Velocity = 100.0;
  m.a.data.DynamicDefaults.Jerk = 0.0;
  m.continuity[0].acceleration = false;
  jog.Velocity = 100.0;
  jog.Acceleration = 3000.0;
  jog.JogForward = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().velocity > 40.0; }));
  ASSERT_GT(m.now().acceleration, 2500.0);
  m.a.data.DynamicDefaults.Jerk = 100000.0;
  m.a.data.DynamicLimits.MaxJerk = 1000.0;
  for (int i = 0; i < 2000; ++i) {
    m.tick();
    ASSERT_LE(m.now().velocity, 100.0 * (1 + 1e-12)) << i;
  }
  EXPECT_TRUE(jog.InVelocity);
}

// ---- Defaults: they count from the next rising edge on (13.1.17)

TEST(DynamicDefaults, ThatAreChangedInMotionDoNotCountForIt) {
  Machine m;
  m.move.Distance = 100.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().velocity == 100.0; }));
  m.a.data.DynamicDefaults.Velocity = 20.0;
  m.a.data.DynamicDefaults.Deceleration = 100.0;
  m.a.data.Override.Velocity = 99.0;  // the motion is planned anew
  m.run(100);
  EXPECT_NEAR(m.now().velocity, 99.0, 1e-9);
  double hardest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    hardest = std::min(hardest, m.now().acceleration);
    return m.move.Done;
  }));
  EXPECT_NEAR(hardest, -1000.0, 10.0);
  m.move.Execute = false;
  m.run(2);
  m.a.data.Override.Velocity = 100.0;
  m.move.Execute = true;
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, m.now().velocity);
    return m.move.Done;
  }));
  EXPECT_NEAR(fastest, 20.0, 1e-9);
}

TEST(DynamicDefaults, OfAJobThatWaitsAreThoseOfItsEdge) {
  Machine m;
  m.move.Distance = 20.0;
  m.next.Distance = 50.0;
  m.next.BufferMode = static_cast<INT>(BufferMode::mcBuffered);
  m.move.Execute = m.next.Execute = true;
  m.run(20);
  m.a.data.DynamicDefaults.Velocity = 20.0;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  double fastest = 0.0;
  ASSERT_TRUE(m.run_until([&] {
    fastest = std::max(fastest, m.now().velocity);
    return m.next.Done;
  }));
  EXPECT_NEAR(fastest, 100.0, 1e-9);
}

// ---- Override

TEST(VelocityOverride, OfAVelocityThatIsHeldCountsFromTheOneInEffect) {
  Machine m;
  m.a.data.Override.Velocity = 50.0;
  m.run_v.Velocity = 100.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.run_v.Execute = false;
  m.run(2);
  m.run_v.Current = true;
  m.run_v.Execute = true;
  m.run(5);
  EXPECT_TRUE(m.run_v.InVelocity);
  EXPECT_EQ(m.a.data.Velocity, 50.0);
  for (const double percent : {60.0, 200.0, 0.0, 50.0}) {
    m.a.data.Override.Velocity = percent;
    m.run(3);
    EXPECT_FALSE(m.run_v.InVelocity);
    ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
    EXPECT_NEAR(m.a.data.Velocity, percent, 1e-9);
  }
}

TEST(VelocityOverride, OfZeroStopsAVelocityThatIsToBeHeld) {
  Machine m;
  m.run_v.Velocity = 100.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.run_v.Execute = false;
  m.a.data.Override.Velocity = 0.0;
  m.run(50);
  const double held = m.a.data.Velocity;
  ASSERT_GT(held, 50.0);
  m.run_v.Current = true;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().standing(); }));
  m.run(5);
  EXPECT_TRUE(m.run_v.InVelocity);
  m.a.data.Override.Velocity = 100.0;
  m.run(1000);
  EXPECT_TRUE(m.run_v.InVelocity);
  EXPECT_NEAR(m.a.data.Velocity, held, 5.0) << "as it was when the job began";
}

}  // namespace
}  // namespace lockstep::changed_dynamics_test
