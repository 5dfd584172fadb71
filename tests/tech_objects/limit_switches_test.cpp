// The hardware limit switches of an axis, without the axis.
#include "tech_objects/axis/limit_switches.hpp"

#include <gtest/gtest.h>

namespace lockstep::limit_switches_test {
namespace {

constexpr TO_Struct_PositionLimitsHW kNotOverrun{.Active = true};
constexpr TO_Struct_PositionLimitsHW kOverrun{.Active = true, .Mode = 1};
constexpr TO_Struct_PositionLimitsHW kKeepsEnable{.Active = true, .ApproachBehavior = 1};

LimitSwitches::Approach towards(double place, double velocity) {
  return {.place = place, .velocity = velocity, .controlled = true, .moving = true};
}

TEST(LimitSwitches, MeetAnAxisThatMovesTowardsThem) {
  LimitSwitches switches;
  EXPECT_FALSE(switches.watch(1, false, towards(9.0, 10.0), kNotOverrun));
  EXPECT_TRUE(switches.watch(1, true, towards(10.0, 10.0), kNotOverrun));
  EXPECT_FALSE(switches.watch(1, true, towards(10.1, 10.0), kNotOverrun)) << "once";
  EXPECT_TRUE(switches.beyond(1));
  EXPECT_FALSE(switches.beyond(-1));
  EXPECT_TRUE(switches.forbid(1.0));
  EXPECT_FALSE(switches.forbid(-1.0)) << "back is permitted";
  EXPECT_FALSE(switches.watch(1, false, towards(9.9, -10.0), kNotOverrun));
  EXPECT_FALSE(switches.beyond_any());
}

TEST(LimitSwitches, ThatCanBeOverrunAreLeftOnlyBackOverThem) {
  LimitSwitches switches;
  EXPECT_TRUE(switches.watch(-1, true, towards(-10.0, -10.0), kOverrun));
  EXPECT_FALSE(switches.watch(-1, false, towards(-12.0, -10.0), kOverrun));
  EXPECT_TRUE(switches.beyond(-1)) << "behind it";
  EXPECT_FALSE(switches.watch(-1, true, towards(-10.5, 10.0), kOverrun));
  EXPECT_FALSE(switches.watch(-1, false, towards(-9.0, 10.0), kOverrun));
  EXPECT_FALSE(switches.beyond_any());
}

TEST(LimitSwitches, MetFromTheWrongSidePermitNeitherDirection) {
  LimitSwitches switches;
  EXPECT_TRUE(switches.watch(1, true, towards(0.0, -10.0), kKeepsEnable));
  EXPECT_TRUE(switches.forbid(1.0));
  EXPECT_TRUE(switches.forbid(-1.0));
  EXPECT_FALSE(switches.forbid(0.0));
  EXPECT_EQ(switches.reaction(kKeepsEnable), AlarmReaction::remove_enable)
      << "whatever ApproachBehavior says";
}

TEST(LimitSwitches, KeepTheEnableWhereApproachBehaviorSaysSo) {
  LimitSwitches switches;
  EXPECT_TRUE(switches.watch(1, true, towards(0.0, 10.0), kKeepsEnable));
  EXPECT_EQ(switches.reaction(kKeepsEnable), AlarmReaction::stop_emergency);
  EXPECT_EQ(switches.reaction(kNotOverrun), AlarmReaction::remove_enable);
}

TEST(LimitSwitches, TurnAHomingRoundWithoutAnAlarm) {
  LimitSwitches switches;
  LimitSwitches::Approach homing = towards(10.0, 10.0);
  homing.reverses = true;
  EXPECT_FALSE(switches.watch(1, true, homing, kNotOverrun));
  EXPECT_TRUE(switches.pressed(1));
}

TEST(LimitSwitches, AreReadFromTheirTagAtItsLevelElseFromTheMachine) {
  bool tag = false;
  TO_Struct_PositionLimitsHW settings{.MinSwitchLevel = false, .MinSwitchAddress = &tag};
  EXPECT_TRUE(LimitSwitches::pressed_at(-1, settings, false)) << "low active";
  tag = true;
  EXPECT_FALSE(LimitSwitches::pressed_at(-1, settings, true));
  EXPECT_TRUE(LimitSwitches::pressed_at(1, settings, true)) << "has no tag";
}

}  // namespace
}  // namespace lockstep::limit_switches_test
