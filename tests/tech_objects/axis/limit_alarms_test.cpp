// Alarms and warnings for what no motion can keep: limits of zero, values beyond them.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::limit_alarms_test {
namespace {

using test::Rig;
using Change = std::function<void(AxisData&)>;

/// An axis, and one that may lead it.
struct Machine : Rig {
  explicit Machine(const Change& change = {})
      : leading(axis("Leading")),
        a(axis("Axis", change)),
        power_leading(block<MC_Power>()),
        power(block<MC_Power>()),
        run_leading(block<MC_MoveVelocity>()),
        run_v(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()) {
    lead(a, leading);
    power_leading.Axis = run_leading.Axis = &leading;
    power.Axis = run_v.Axis = &a;
    gear.Master = &leading;
    gear.Slave = &a;
    power_leading.Enable = power.Enable = true;
    run(10);
  }

  bool noted(int number) {
    a.alarm_notes.take([this](const AlarmNote& note) { notes_.push_back(note.number); });
    return std::find(notes_.begin(), notes_.end(), number) != notes_.end();
  }

  Axis& leading;
  Axis& a;
  MC_Power& power_leading;
  MC_Power& power;
  MC_MoveVelocity& run_leading;
  MC_MoveVelocity& run_v;
  MC_GearIn& gear;

 private:
  std::vector<int> notes_;
};

TEST(LimitOfZero, RaisesItsAlarmWithTheFirstJob) {
  struct Case {
    Change change;
    int number;
    AlarmCause cause;
    double value, limit;
  };
  const auto limits = [](const TO_Struct_DynamicLimits& all) {
    return [all](AxisData& data) { data.DynamicLimits = all; };
  };
  const Case cases[] = {
      {limits({300.0, 0.0, 1e3, 2e3, 3e3}), alarm::kVelocityLimitZero, AlarmCause::none, 300.0, 0.0},
      {limits({0.0, 200.0, 1e3, 2e3, 3e3}), alarm::kVelocityLimitZero, AlarmCause::none, 0.0, 200.0},
      {limits({300.0, 200.0, 0.0, 2e3, 3e3}), alarm::kAccelerationLimitZero, AlarmCause::acceleration, 0.0,
       0.0},
      {limits({300.0, 200.0, 1e3, 0.0, 3e3}), alarm::kAccelerationLimitZero, AlarmCause::deceleration, 0.0,
       0.0},
      {[&](AxisData& data) {
         limits({300.0, 200.0, 1e3, 2e3, 3e3})(data);
         data.DynamicDefaults.Acceleration = 0.0;
       },
       alarm::kAccelerationLimitZero, AlarmCause::acceleration, 0.0, 1e3},
      {[&](AxisData& data) {
         limits({300.0, 200.0, 1e3, 2e3, 0.0})(data);
         data.DynamicDefaults.Jerk = 400.0;
       },
       alarm::kJerkLimitZero, AlarmCause::none, 400.0, 0.0}};
  for (const Case& zero : cases) {
    Machine m(zero.change);
    EXPECT_EQ(m.a.pending_alarm(), 0);
    m.run_v.Velocity = 10.0;
    m.run_v.Execute = true;
    m.run(3);
    EXPECT_EQ(m.a.pending_alarm(), zero.number);
    EXPECT_EQ(m.a.data.ErrorDetail.Reaction, 3);
    EXPECT_EQ(m.run_v.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
    EXPECT_TRUE(m.a.setpoint().standing());
    AlarmDetail told;
    m.a.alarm_notes.take([&](const AlarmNote& note) {
      if (note.number == zero.number) told = note.detail;
    });
    EXPECT_EQ(told.cause, zero.cause) << zero.number;
    EXPECT_EQ(told.value, zero.value) << zero.number;
    EXPECT_EQ(told.limit, zero.limit) << zero.number;
  }
}

TEST(DynamicValues, BeyondTheLimitsAreCutWithTheWarningOfTheirOwn) {
  const int numbers[] = {alarm::kVelocityLimited, alarm::kAccelerationLimited, alarm::kAccelerationLimited,
                         alarm::kJerkLimited};
  for (std::size_t pin = 0; pin < std::size(numbers); ++pin) {
    Machine m([](AxisData& data) { data.DynamicLimits = {100.0, 100.0, 1000.0, 1000.0, 10000.0}; });
    m.run_v.Velocity = 50.0;
    m.run_v.Acceleration = m.run_v.Deceleration = 500.0;
    m.run_v.Jerk = 5000.0;
    LREAL* const pins[] = {&m.run_v.Velocity, &m.run_v.Acceleration, &m.run_v.Deceleration, &m.run_v.Jerk};
    *pins[pin] *= 100.0;
    m.run_v.Execute = true;
    m.run(3);
    for (const int number : numbers) EXPECT_EQ(m.noted(number), number == numbers[pin]) << number;
    EXPECT_TRUE(m.run_v.Busy);
    EXPECT_EQ(m.a.pending_alarm(), 0);
  }
}

TEST(SpeedOfAMotor, BeyondItsMaximumIsCutWithWarning504) {
  Machine m([](AxisData& data) {
    data.VirtualAxis.Mode = 0;
    data.Actor.DriveParameter.MaxSpeed = 600.0;  // 100 u/s
    data.FollowingError.EnableMonitoring = false;
  });
  m.run_v.Velocity = 99.0;
  m.run_v.Execute = true;
  m.run(2000);
  EXPECT_FALSE(m.noted(alarm::kSpeedSetpointLimited));
  m.run_v.Execute = false;
  m.run(2);
  m.run_v.Velocity = 200.0;
  m.run_v.Execute = true;
  m.run(2000);
  EXPECT_TRUE(m.noted(alarm::kSpeedSetpointLimited));
  EXPECT_NEAR(m.a.data.ActualVelocity, 100.0, 1.0);
}

TEST(SpeedOfAMotor, BelowTheMaximumVelocityOfTheAxisIsToldByWarning551) {
  const auto told = [](double max_velocity, DINT simulated) {
    Machine m([&](AxisData& data) {
      data.VirtualAxis.Mode = 0;
      data.Simulation.Mode = simulated;
      data.Actor.DriveParameter.MaxSpeed = 600.0;  // 100 u/s
      data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = max_velocity;
    });
    EXPECT_EQ(m.a.pending_alarm(), 0);
    EXPECT_EQ(has_bit(m.a.data.WarningWord, WarningBit::DynamicWarning),
              m.noted(alarm::kVelocityNotReachable));
    return m.noted(alarm::kVelocityNotReachable);
  };
  EXPECT_FALSE(told(100.0, 0));
  EXPECT_TRUE(told(100.1, 0));
  EXPECT_FALSE(told(100.1, 1)) << "simulated, it has no drive";
}

TEST(LeadingAxis, WithoutPositionControlIsRefusedWithAlarm603) {
  Machine m;
  m.run_leading.PositionControlled = false;
  m.run_leading.Velocity = 10.0;
  m.run_leading.Execute = true;
  m.run(10);
  m.gear.Execute = true;
  m.run(3);
  EXPECT_EQ(m.a.pending_alarm(), alarm::kLeadingAxisNotPositionControlled);
  EXPECT_EQ(m.gear.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
}

/// No block lets such a value in; what would come out of an error inside is held back all the same.
TEST(Setpoint, ThatIsNoNumberIsHeldBackWithAlarm203) {
  Machine m;
  m.continuity[1].velocity = m.continuity[1].acceleration = false;
  m.gear.Execute = true;
  ASSERT_TRUE(m.run_until([&] { return m.gear.InGear; }));
  const double here = m.a.data.Position;
  m.a.additive_request = {&m, true, {std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  m.run(3);  // the rig looks for setpoints that are not finite
  EXPECT_EQ(m.a.pending_alarm(), alarm::kInternal);
  EXPECT_EQ(m.a.data.Position, here);
  EXPECT_TRUE(m.gear.Error);
}

}  // namespace
}  // namespace lockstep::limit_alarms_test
