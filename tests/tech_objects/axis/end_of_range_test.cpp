// The end of the range of positions, ±1.0E12: an axis that nears it stops in time (alarm 307); what passes it
// all the same makes no step (308); targets beyond it are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::end_of_range_test {
namespace {

using test::Rig;

constexpr double kEnd = 1e12;
/// Of the positions there [u]: by so much a way from tick to tick may differ from the velocity.
constexpr double kGrain = 5e-4;

/// An axis near the end, one that it leads, and one that leads it.
struct Machine : Rig {
  explicit Machine(double side = 1.0, double before_end = 500.0, bool driven = false)
      : leading(axis("Leading")),
        a(axis("Axis",
               [driven](AxisData& data) {
                 data.VirtualAxis.Mode = driven ? 0 : 1;
                 data.Actor.DriveParameter.MaxSpeed = 12000.0;  // 2,000 u/s
                 data.FollowingError.EnableMonitoring = false;  // positions are too coarse here
                 data.DynamicLimits = {2000.0, 2000.0, 5000.0, 5000.0, 100000.0};
                 data.PositioningMonitoring.MinDwellTime = 0.0;
               })),
        follower(axis("Follower")),
        power_leading(block<MC_Power>()),
        power(block<MC_Power>()),
        power_follower(block<MC_Power>()),
        home(block<MC_Home>()),
        run_leading(block<MC_MoveVelocity>()),
        run_v(block<MC_MoveVelocity>()),
        move(block<MC_MoveRelative>()),
        absolute(block<MC_MoveAbsolute>()),
        superimposed(block<MC_MoveSuperimposed>()),
        stop(block<MC_Stop>()),
        given(block<MC_MotionInPosition>()),
        given_velocity(block<MC_MotionInVelocity>()),
        added(block<MC_MotionInSuperimposed>()),
        reset(block<MC_Reset>()),
        gear(block<MC_GearIn>()),
        gear_follower(block<MC_GearIn>()) {
    lead(a, leading);
    lead(follower, a);
    for (test::Continuity& rule : continuity) {
      rule.acceleration = false;                       // of the leading and the emergency ramp
      rule.highest_acceleration = 1e5 + kGrain * 1e6;  // per tick²
    }
    a.drive_settings.quick_stop = 5000.0;
    power_leading.Axis = run_leading.Axis = &leading;
    power_follower.Axis = &follower;
    power.Axis = run_v.Axis = move.Axis = absolute.Axis = superimposed.Axis = stop.Axis = &a;
    given.Axis = given_velocity.Axis = added.Axis = &a;
    home.Axis = &a;
    reset.Axis = &a;
    gear.Master = &leading;
    gear.Slave = &a;
    gear_follower.Master = &a;
    gear_follower.Slave = &follower;
    power_leading.Enable = power.Enable = power_follower.Enable = true;
    run(5);
    be_at(side * (kEnd - before_end));
    gear_follower.Execute = true;
    run(5);
  }

  void be_at(double position) {
    home.Execute = false;
    run(2);
    home.Position = position;
    const auto rules = continuity;
    for (test::Continuity& rule : continuity) rule.velocity = false;
    home.Execute = true;
    run(2);
    continuity = rules;
  }

  /// Runs until all stand; no setpoint passes the end meanwhile. The rig asserts that nothing steps.
  void expect_stop_in_front() {
    for (int i = 0; i < 20000 && !(i > 5 && now().standing()); ++i) {
      tick();
      ASSERT_LE(std::abs(now().position.value), kEnd) << i;
      ASSERT_FALSE(testing::Test::HasFatalFailure());
    }
    EXPECT_EQ(a.pending_alarm(), alarm::kPositionRangeReached);
    EXPECT_EQ(a.data.ErrorDetail.Reaction, 2);
    EXPECT_TRUE(has_bit(a.data.StatusWord, StatusBit::Enable)) << "it keeps its enable";
    EXPECT_TRUE(now().standing());
    EXPECT_GT(std::abs(now().position.value), kEnd - 20.0) << "and uses the range";
    run(5);
    EXPECT_EQ(follower.data.Velocity, 0.0);
  }

  const Setpoint& now() const { return a.setpoint(); }

  Axis& leading;
  Axis& a;
  Axis& follower;
  MC_Power& power_leading;
  MC_Power& power;
  MC_Power& power_follower;
  MC_Home& home;
  MC_MoveVelocity& run_leading;
  MC_MoveVelocity& run_v;
  MC_MoveRelative& move;
  MC_MoveAbsolute& absolute;
  MC_MoveSuperimposed& superimposed;
  MC_Stop& stop;
  MC_MotionInPosition& given;
  MC_MotionInVelocity& given_velocity;
  MC_MotionInSuperimposed& added;
  MC_Reset& reset;
  MC_GearIn& gear;
  MC_GearIn& gear_follower;
};

// ---- 307

TEST(EndOfRange, StopsAnEndlessMotionWithMaximumDynamicsAndAlarm307) {
  for (const double side : {1.0, -1.0})
    for (const double jerk : {20000.0, 0.0}) {
      Machine m(side);
      m.run_v.Velocity = side * 900.0;
      m.run_v.Jerk = jerk;
      m.run_v.Execute = true;
      m.expect_stop_in_front();
      EXPECT_TRUE(m.run_v.Error);
      EXPECT_EQ(m.run_v.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
    }
}

TEST(EndOfRange, IsLeftInwardsAfterTheAcknowledgement) {
  Machine m;
  m.run_v.Velocity = 900.0;
  m.run_v.Execute = true;
  m.expect_stop_in_front();
  m.reset.Execute = true;
  m.run(3);
  m.move.Distance = -100.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  EXPECT_EQ(m.a.pending_alarm(), 0);
  m.run_v.Execute = false;
  m.run(2);
  m.run_v.Execute = true;
  m.expect_stop_in_front();
}

TEST(EndOfRange, StopsAGearWithAlarm307AsSoonAsItsLeadingAxisWouldCarryItBeyond) {
  Machine m;
  m.gear.Execute = true;
  m.run(5);
  m.run_leading.Velocity = 900.0;
  m.run_leading.Execute = true;
  m.expect_stop_in_front();
  EXPECT_TRUE(m.gear.Error);
}

TEST(EndOfRange, CountsForTheSumOfABaseAndASuperimposedMotion) {
  Machine m;
  m.run_v.Velocity = 300.0;
  m.run_v.Execute = true;
  m.superimposed.Distance = 300.0;
  m.superimposed.VelocityDiff = 400.0;
  m.superimposed.Execute = true;
  m.expect_stop_in_front();
}

TEST(EndOfRange, StopsAVelocityThatIsGiven) {
  Machine m;
  m.given_velocity.Velocity = 50.0;
  m.given_velocity.Enable = true;
  m.expect_stop_in_front();
  EXPECT_TRUE(m.given_velocity.Error);
}

TEST(EndOfRange, IsNoMatterToAMotionThatEndsInFrontOfIt) {
  for (const double side : {1.0, -1.0})
    for (const double jerk : {20000.0, 0.0}) {
      Machine m(side);
      m.absolute.Position = side * kEnd;
      m.absolute.Velocity = 900.0;
      m.absolute.Acceleration = m.absolute.Deceleration = 5000.0;
      m.absolute.Jerk = jerk;
      m.absolute.Execute = true;
      ASSERT_TRUE(m.run_until([&] { return m.absolute.Done; }));
      EXPECT_EQ(m.a.data.Position, side * kEnd);
      EXPECT_EQ(m.a.pending_alarm(), 0);
    }
}

TEST(EndOfRange, IsKeptByWhateverMovesTheAxis) {
  test::for_each_seed(1, 40, [](const test::Case& with) {
    std::mt19937_64 random(with.seed);
    const auto uniform = [&random](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double side = random() % 2 == 0 ? 1.0 : -1.0;
    Machine m(side, uniform(10.0, 3000.0));
    auto& limits = m.a.data.DynamicLimits;
    limits.MaxDeceleration = uniform(500.0, 50000.0);
    limits.MaxAcceleration = uniform(500.0, 50000.0);
    limits.MaxJerk = random() % 4 == 0 ? 0.0 : uniform(5000.0, 1e6);
    const bool jerk = random() % 2 == 0 && limits.MaxJerk > 0.0;
    m.run_v.Velocity = side * uniform(1.0, 2000.0);
    m.run_v.Acceleration = uniform(500.0, 50000.0);
    m.run_v.Jerk = jerk ? uniform(5000.0, 1e6) : 0.0;
    if (random() % 3 == 0) {
      m.run_leading.Velocity = m.run_v.Velocity;
      m.run_leading.Execute = true;
      m.gear.Jerk = m.run_v.Jerk;
      m.gear.Execute = true;
    } else {
      m.run_v.Execute = true;
    }
    if (random() % 3 == 0) {
      m.superimposed.Distance = side * uniform(1.0, 50.0);
      m.superimposed.Jerk = m.run_v.Jerk;
      m.superimposed.Execute = true;
    }
    for (int i = 0; i < 60000 && m.a.pending_alarm() == 0; ++i) m.tick();
    for (int i = 0; i < 20000 && !m.now().standing(); ++i) {
      m.tick();
      ASSERT_LE(std::abs(m.now().position.value), kEnd);
    }
    EXPECT_EQ(m.a.pending_alarm(), alarm::kPositionRangeReached);
  });
}

// ---- 308: too late to stop

TEST(EndOfRange, PassedByAnAxisThatIsRenamedInMotionTakesItsEnableWithoutAStep) {
  Machine m(1.0, 1e6);
  m.run_v.Velocity = 900.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.be_at(kEnd - 5.0);  // far too near for a velocity of 900 u/s
  ASSERT_EQ(m.now().velocity > 0.0, true);
  ASSERT_TRUE(m.run_until([&] { return m.now().standing(); }));  // the rig asserts that nothing steps
  EXPECT_EQ(m.a.pending_alarm(), alarm::kPositionRangeExceeded);
  EXPECT_EQ(m.a.data.ErrorDetail.Reaction, 4);
  EXPECT_FALSE(has_bit(m.a.data.StatusWord, StatusBit::Enable));
  EXPECT_GT(m.now().position.value, kEnd);
  EXPECT_EQ(m.follower.data.Velocity, 0.0);
}

TEST(EndOfRange, PassedIsComeBackOverOnceItIsAcknowledged) {
  Machine m(1.0, 1e6);
  m.run_v.Velocity = 900.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.be_at(kEnd - 5.0);
  ASSERT_TRUE(m.run_until([&] { return m.a.off() && m.now().standing(); }));
  ASSERT_GT(m.now().position.value, kEnd + 2.0);
  m.reset.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.power.Status; }));
  m.run(100);
  ASSERT_EQ(m.a.pending_alarm(), 0);
  m.absolute.Position = kEnd - 50.0;
  m.absolute.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.absolute.Done; }));
  EXPECT_EQ(m.a.pending_alarm(), 0);
  EXPECT_EQ(m.a.data.Position, kEnd - 50.0);
}

/// The drive stops by itself, and the setpoint goes over to the actual value; who follows sees no step.
TEST(EndOfRange, PassedByADriveIsNoStepForWhoFollowsIt) {
  Machine m(1.0, 1e6, true);
  m.continuity[1].velocity = false;
  m.run_v.Velocity = 900.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
  m.be_at(kEnd - 5.0);
  ASSERT_TRUE(m.run_until([&] { return m.a.pending_alarm() == alarm::kPositionRangeExceeded; }));
  ASSERT_TRUE(m.run_until([&] { return m.follower.setpoint().standing() && m.a.off(); }));
  EXPECT_FALSE(has_bit(m.a.data.StatusWord, StatusBit::Enable));
}

/// A step of the function far beyond the range is not followed: the axis brakes where it was.
TEST(EndOfRange, IsNotPassedWithAStepOfTheFunction) {
  Machine m(1.0, 1e6);
  m.gear.RatioNumerator = 1'000'000;
  m.gear.Execute = true;
  m.run(5);
  ASSERT_TRUE(m.gear.InGear);
  const double here = m.now().position.value;
  m.a.additive_request = {&m, true, {1e12, 0.0, 0.0}};
  m.run(3);
  EXPECT_EQ(m.a.pending_alarm(), alarm::kPositionRangeExceeded);
  EXPECT_TRUE(m.gear.Error);
  EXPECT_EQ(m.now().position.value, here);
  EXPECT_TRUE(m.now().standing());
}

TEST(EndOfRange, IsPassedByAnEmergencyRampThatIsTooWeak) {
  Machine m;
  m.a.data.DynamicDefaults.EmergencyDeceleration = 500.0;
  m.run_v.Velocity = 900.0;
  m.run_v.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().position.value > kEnd - 150.0; }));
  ASSERT_EQ(m.a.pending_alarm(), 0);
  m.stop.Mode = 0;  // outranks 307
  m.stop.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.now().standing(); }));
  EXPECT_EQ(m.a.pending_alarm(), alarm::kPositionRangeExceeded);
}

// ---- Refused

struct Target {
  double position;
  bool permitted;
};

TEST(EndOfRange, RefusesTargetsBeyondIt) {
  const double places[] = {1.1e12, -1.1e12, 1e13, 1e100, -1e308, std::nextafter(1e12, 2e12)};
  for (const double place : places) {
    Machine m(1.0, 1e6);
    m.run_v.Velocity = 10.0;
    m.run_v.Execute = true;
    ASSERT_TRUE(m.run_until([&] { return m.run_v.InVelocity; }));
    m.absolute.Position = m.move.Distance = m.superimposed.Distance = place;
    m.absolute.Execute = m.move.Execute = m.superimposed.Execute = true;
    m.run(3);
    EXPECT_EQ(m.absolute.ErrorID, static_cast<WORD>(ErrorId::position)) << place;
    EXPECT_EQ(m.move.ErrorID, static_cast<WORD>(ErrorId::distance)) << place;
    EXPECT_EQ(m.superimposed.ErrorID, static_cast<WORD>(ErrorId::distance)) << place;
    EXPECT_TRUE(m.run_v.InVelocity) << "a job that is refused leaves the running one";
    m.run_v.Execute = false;
    m.given.Position = place;
    m.given.Enable = true;
    m.run(3);
    EXPECT_EQ(m.given.ErrorID, static_cast<WORD>(ErrorId::position)) << place;
    EXPECT_EQ(m.a.pending_alarm(), 0);
  }
}

TEST(EndOfRange, RefusesDistancesThatLeadBeyondIt) {
  Machine m(1.0, 100.0);
  for (const double distance : {100.5, 5000.0, -2e12 + 50.0}) {
    m.move.Distance = m.superimposed.Distance = distance;
    m.move.Execute = m.superimposed.Execute = true;
    m.run(3);
    EXPECT_EQ(m.move.ErrorID, static_cast<WORD>(ErrorId::distance)) << distance;
    EXPECT_EQ(m.superimposed.ErrorID, static_cast<WORD>(ErrorId::distance)) << distance;
    m.move.Execute = m.superimposed.Execute = false;
    m.run(3);
  }
  m.move.Distance = 100.0;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.move.Done; }));
  EXPECT_EQ(m.a.data.Position, kEnd);
  EXPECT_EQ(m.a.pending_alarm(), 0);
}

TEST(EndOfRange, RefusesADistanceThatHasWaitedOnceItIsKnownWhereItBegins) {
  Machine m(1.0, 100.0);
  m.absolute.Position = kEnd - 20.0;
  m.absolute.Execute = true;
  m.run(3);
  m.move.Distance = 50.0;
  m.move.BufferMode = 1;
  m.move.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.absolute.Done; }));
  m.run(2);
  EXPECT_EQ(m.move.ErrorID, static_cast<WORD>(ErrorId::distance));
  EXPECT_EQ(m.a.data.Position, kEnd - 20.0);
  EXPECT_EQ(m.a.pending_alarm(), 0);
}

TEST(EndOfRange, IsNoneToARing) {
  Rig rig;
  Axis& ring = rig.axis("Ring", [](AxisData& data) {
    data.Modulo = {true, 360.0, 0.0};
    data.DynamicLimits = {1e6, 1e6, 1e8, 1e8, 1e6};
  });
  rig.continuity[0].velocity = rig.continuity[0].acceleration = false;
  auto& power = rig.block<MC_Power>();
  auto& move = rig.block<MC_MoveRelative>();
  auto& absolute = rig.block<MC_MoveAbsolute>();
  power.Axis = move.Axis = absolute.Axis = &ring;
  power.Enable = true;
  rig.run(5);
  move.Distance = 1e12;
  move.Velocity = 1e6;
  move.Execute = true;
  rig.run(5000);
  EXPECT_TRUE(move.Busy);
  EXPECT_EQ(ring.pending_alarm(), 0);
}

}  // namespace
}  // namespace lockstep::end_of_range_test
