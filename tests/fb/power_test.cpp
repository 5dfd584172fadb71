// MC_Power: what its inputs do while the axis moves.
#include "fb/power.hpp"

#include <gtest/gtest.h>

#include "fb/move.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::power_test {
namespace {

using test::Rig;

struct Machine : Rig {
  Machine()
      : a(axis("Axis")), power(block<MC_Power>()), reset(block<MC_Reset>()), run_v(block<MC_MoveVelocity>()) {
    power.Axis = run_v.Axis = &a;
    reset.Axis = &a;
    power.StopMode = 2;
    run_v.Velocity = 50.0;
  }

  /// @return whether the axis runs at its velocity
  bool start() {
    power.Enable = run_v.Execute = true;
    run(2);
    run_v.Execute = false;
    run(2);
    run_v.Execute = true;
    return static_cast<bool>(run_until([this] { return run_v.InVelocity; }));
  }

  Axis& a;
  MC_Power& power;
  MC_Reset& reset;
  MC_MoveVelocity& run_v;
};

TEST(ModesOfMC_Power, ThatAreNotPermittedLeaveTheAxisEnabledWithTheLastOnes) {
  Machine m;
  ASSERT_TRUE(m.start());
  m.power.StopMode = 7;
  m.tick();
  EXPECT_TRUE(m.power.Error);
  EXPECT_EQ(m.power.ErrorID, static_cast<WORD>(ErrorId::stop_mode));
  EXPECT_TRUE(m.power.Status && m.power.Busy);
  m.power.StopMode = 2;
  m.power.StartMode = 5;
  m.tick();
  EXPECT_EQ(m.power.ErrorID, static_cast<WORD>(ErrorId::mode));
  EXPECT_TRUE(m.power.Status && m.power.Busy && m.run_v.InVelocity);
  m.power.StartMode = 1;
  m.tick();
  EXPECT_FALSE(m.power.Error);
}

TEST(ModesOfMC_Power, ThatAreNotPermittedDoNotKeepTheAxisFromBeingStopped) {
  Machine m;
  ASSERT_TRUE(m.start());
  m.power.StopMode = 7;
  m.run(3);
  m.power.Enable = false;
  m.tick();
  EXPECT_FALSE(m.power.Status);
  EXPECT_TRUE(m.power.Busy);
  m.run(2);
  EXPECT_TRUE(m.run_v.CommandAborted);
  EXPECT_GT(m.a.setpoint().acceleration, -100000.0) << "the ramp of StopMode 2, which has a jerk limit";
  EXPECT_LT(m.a.setpoint().acceleration, 0.0);
  ASSERT_TRUE(m.run_until([&] { return !m.power.Busy; }));
  EXPECT_TRUE(m.a.setpoint().standing());
  EXPECT_TRUE(m.power.Error);
}

TEST(ModesOfMC_Power, ThatAreNotPermittedEnableNothing) {
  Machine m;
  m.run(2);
  m.power.StopMode = 7;
  m.power.Enable = true;
  m.run(5);
  EXPECT_TRUE(m.power.Error);
  EXPECT_FALSE(m.power.Status || m.power.Busy);
  EXPECT_FALSE(m.a.enabled());
  m.power.StopMode = 0;
  m.run(3);
  EXPECT_TRUE(m.power.Status);
  EXPECT_FALSE(m.power.Error);
}

/// Published precondition of a restart: Status and Busy of MC_Power are FALSE.
TEST(Restart, OfAnAxisWhoseEnableAnAlarmHasRemovedWaitsForTheFallOfEnable) {
  Machine m;
  ASSERT_TRUE(m.start());
  m.continuity[0].acceleration = false;
  m.a.raise(alarm::kFollowingError);
  ASSERT_TRUE(m.run_until([&] { return m.a.off(); }));
  ASSERT_TRUE(m.power.Busy);
  m.reset.Restart = true;
  m.reset.Execute = true;
  m.run(3);
  EXPECT_EQ(m.reset.ErrorID, static_cast<WORD>(ErrorId::restart_refused));
  EXPECT_TRUE(has_bit(m.a.data.WarningWord, WarningBit::CommandNotAccepted));
  int told = 0;
  m.a.alarm_notes.take([&](const AlarmNote& note) { told += note.number == alarm::kRestartNotCarriedOut; });
  EXPECT_EQ(told, 1);
  EXPECT_EQ(m.a.pending_alarm(), alarm::kFollowingError);
  m.power.Enable = m.reset.Execute = false;
  m.run(3);
  m.reset.Execute = true;
  m.run(3);
  EXPECT_TRUE(m.reset.Done);
  EXPECT_EQ(m.a.pending_alarm(), 0);
  EXPECT_EQ(m.a.data.WarningWord, DWORD{});
}

}  // namespace
}  // namespace lockstep::power_test
