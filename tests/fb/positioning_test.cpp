// Single-axis jobs on a virtual axis, through the blocks.
#include <gtest/gtest.h>

#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::positioning_test {
namespace {

using test::Rig;

/// One enabled and homed virtual axis with every block of a single axis.
struct OneAxis : Rig {
  explicit OneAxis(const std::function<void(AxisData&)>& configure = {})
      : a(axis("A", configure)),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        move(block<MC_MoveAbsolute>()),
        relative(block<MC_MoveRelative>()),
        velocity(block<MC_MoveVelocity>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        reset(block<MC_Reset>()) {
    power.Axis = &a;
    home.Axis = &a;
    move.Axis = &a;
    relative.Axis = &a;
    velocity.Axis = &a;
    jog.Axis = &a;
    halt.Axis = &a;
    stop.Axis = &a;
    reset.Axis = &a;
    power.Enable = true;
    run(3);
    home.Execute = true;
    run(3);
  }

  Axis& a;
  MC_Power& power;
  MC_Home& home;
  MC_MoveAbsolute& move;
  MC_MoveRelative& relative;
  MC_MoveVelocity& velocity;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_Reset& reset;
};

bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}

void use_modulo(AxisData& data) {
  data.Modulo.Enable = true;
}

TEST(Power, AVirtualAxisIsEnabledByMC_PowerAndHomedByMC_Home) {
  OneAxis rig;
  EXPECT_TRUE(rig.power.Status);
  EXPECT_TRUE(rig.home.Done);
  EXPECT_TRUE(bit(rig.a, StatusBit::Enable));
  EXPECT_TRUE(bit(rig.a, StatusBit::HomingDone));
}

TEST(Power, FallingEnableBrakesTheAxisWithTheEmergencyRampAndAbortsItsJob) {
  OneAxis rig;
  rig.continuity[0].acceleration = false;  // the emergency ramp is not jerk-limited
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  rig.power.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(rig.velocity.CommandAborted);
  ASSERT_TRUE(rig.run_until([&] { return !rig.power.Busy; }));
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
}

TEST(Power, ASecondInstanceIsRejected) {
  OneAxis rig;
  MC_Power second;
  second.Axis = &rig.a;
  second.call(0);
  EXPECT_TRUE(second.Error);
  EXPECT_EQ(second.ErrorID, static_cast<WORD>(0x800C));
}

TEST(MC_MoveAbsolute, EndsExactlyAtItsTargetAfterTheDwellTime) {
  OneAxis rig;
  rig.move.Position = 12.3;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  EXPECT_EQ(rig.a.data.Position, 12.3);
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
  EXPECT_TRUE(bit(rig.a, StatusBit::Done));
  EXPECT_TRUE(bit(rig.a, StatusBit::Standstill));
}

TEST(MC_MoveAbsolute, WithoutHomingRaisesAlarm321) {
  Rig rig;
  Axis& a = rig.axis("A");
  auto& power = rig.block<MC_Power>();
  auto& move = rig.block<MC_MoveAbsolute>();
  power.Axis = move.Axis = &a;
  power.Enable = true;
  rig.run(3);
  move.Execute = true;
  rig.run(3);
  EXPECT_TRUE(move.Error);
  EXPECT_EQ(move.ErrorID, static_cast<WORD>(0x8001));
  EXPECT_EQ(a.data.ErrorDetail.Number, 321u);
  EXPECT_TRUE(has_bit(a.data.ErrorWord, 3));
}

TEST(MC_MoveAbsolute, IsRetargetedOnTheFlyWithoutAStep) {
  OneAxis rig;
  rig.continuity[0].highest_jerk = 10000.0;  // the default jerk of the axis
  rig.continuity[0].highest_acceleration = 1000.0;
  rig.move.Position = 100.0;
  rig.move.Execute = true;
  rig.run(500);
  rig.move.Execute = false;
  rig.run(1);
  rig.move.Position = -50.0;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  EXPECT_EQ(rig.a.data.Position, -50.0);
}

struct ModuloCase {
  double from, to;
  INT direction;
  double distance;
};

class MC_MoveAbsoluteModulo : public ::testing::TestWithParam<ModuloCase> {};

TEST_P(MC_MoveAbsoluteModulo, GoesTheWayThatDirectionNames) {
  const ModuloCase c = GetParam();
  OneAxis rig(use_modulo);
  rig.home.Execute = false;
  rig.run(2);
  rig.home.Position = c.from;
  rig.home.Execute = true;
  rig.continuity[0].velocity = false;  // homing renames the position
  rig.run(3);
  rig.continuity[0].velocity = true;
  const AxisPosition start = rig.a.setpoint().position;
  rig.move.Position = c.to;
  rig.move.Direction = c.direction;
  rig.move.Velocity = 1000.0;
  rig.move.Acceleration = 10000.0;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  EXPECT_NEAR(difference(rig.a.setpoint().position, start, rig.a.modulo()).rounded(), c.distance, 1e-9);
  EXPECT_DOUBLE_EQ(rig.a.data.Position, std::fmod(std::fmod(c.to, 360.0) + 360.0, 360.0));
}

INSTANTIATE_TEST_SUITE_P(Ways, MC_MoveAbsoluteModulo,
                         ::testing::Values(ModuloCase{10, 350, 1, 340}, ModuloCase{10, 350, 2, -20},
                                           ModuloCase{10, 350, 3, -20}, ModuloCase{10, 20, 2, -350},
                                           ModuloCase{10, 20, 1, 10}, ModuloCase{10, 10, 1, 0},
                                           ModuloCase{10, 370, 3, 0}, ModuloCase{0, 180, 3, 180}));

TEST(MC_MoveAbsolute, RefusesAnUnknownDirectionOnAModuloAxisOnly) {
  OneAxis linear;
  linear.move.Direction = 7;
  linear.move.Position = 1.0;
  linear.move.Execute = true;
  linear.run(3);
  EXPECT_FALSE(linear.move.Error);
  OneAxis ring(use_modulo);
  ring.move.Direction = 7;
  ring.move.Execute = true;
  ring.run(1);
  EXPECT_EQ(ring.move.ErrorID, static_cast<WORD>(0x8007));
}

TEST(MC_MoveRelative, AddsItsDistanceToWhereTheAxisIsAtTheStart) {
  OneAxis rig;
  rig.relative.Distance = 30.0;
  rig.relative.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
  EXPECT_DOUBLE_EQ(rig.a.data.Position, 30.0);
}

TEST(MC_MoveVelocity, HoldsItsVelocityAndFollowsTheOverride) {
  OneAxis rig;
  rig.velocity.Velocity = -80.0;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  EXPECT_EQ(rig.a.data.Velocity, -80.0);
  rig.a.data.Override.Velocity = 50.0;
  rig.run(2);
  EXPECT_FALSE(rig.velocity.InVelocity);
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  EXPECT_EQ(rig.a.data.Velocity, -40.0);
  rig.a.data.Override.Velocity = 0.0;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.data.Velocity == 0.0; }));
  EXPECT_TRUE(rig.velocity.Busy);
}

TEST(MC_MoveVelocity, MovesEvenlyOverManyTurns) {
  OneAxis rig(use_modulo);
  rig.velocity.Velocity = 3600.0;
  rig.velocity.Acceleration = 36000.0;
  rig.velocity.Jerk = 0.0;
  rig.continuity[0].acceleration = false;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  const AxisPosition start = rig.a.setpoint().position;
  rig.run(20000);
  EXPECT_NEAR(difference(rig.a.setpoint().position, start, rig.a.modulo()).rounded(), 72000.0, 1e-8);
}

TEST(MC_MoveVelocity, ClipsToTheLimitAndWarns) {
  OneAxis rig([](AxisData& data) { data.DynamicLimits.MaxVelocity = 60.0; });
  rig.velocity.Velocity = 90.0;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  EXPECT_EQ(rig.a.data.Velocity, 60.0);
  EXPECT_TRUE(has_bit(rig.a.data.WarningWord, 6));
  EXPECT_FALSE(bit(rig.a, StatusBit::Error));
}

TEST(MC_MoveJog, MovesWhileAnInputIsHeldAndEndsAtStandstill) {
  OneAxis rig;
  rig.jog.Velocity = 40.0;
  rig.jog.JogBackward = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.jog.InVelocity; }));
  EXPECT_EQ(rig.a.data.Velocity, -40.0);
  rig.jog.Velocity = 20.0;
  rig.run(2);
  EXPECT_FALSE(rig.jog.InVelocity);
  ASSERT_TRUE(rig.run_until([&] { return rig.jog.InVelocity; }));
  rig.jog.JogBackward = false;
  rig.run(2);
  EXPECT_TRUE(rig.jog.Busy);
  ASSERT_TRUE(rig.run_until([&] { return !rig.jog.Busy; }));
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
}

TEST(MC_MoveJog, BrakesWithAnErrorWhenBothInputsAreTrue) {
  OneAxis rig;
  rig.jog.JogForward = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.jog.InVelocity; }));
  rig.jog.JogBackward = true;
  rig.run(2);
  EXPECT_EQ(rig.jog.ErrorID, static_cast<WORD>(0x8007));
  ASSERT_TRUE(rig.run_until([&] { return rig.a.data.Velocity == 0.0; }));
  rig.jog.JogForward = rig.jog.JogBackward = false;
  rig.run(2);
  EXPECT_FALSE(rig.jog.Error);
  rig.jog.JogForward = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.jog.InVelocity; }));
}

TEST(MC_Halt, BrakesAndIsDoneAtStandstill) {
  OneAxis rig;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  rig.halt.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.velocity.CommandAborted);
  EXPECT_TRUE(bit(rig.a, StatusBit::Decelerating));
  ASSERT_TRUE(rig.run_until([&] { return rig.halt.Done; }));
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
}

TEST(MC_Stop, LocksTheAxisWhileExecuteIsTrue) {
  OneAxis rig;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  rig.continuity[0].acceleration = false;  // Mode 0 is not jerk-limited
  rig.stop.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }));
  EXPECT_TRUE(has_bit(rig.a.data.StatusWord2, Status2Bit::StopCommand));
  rig.relative.Distance = 1.0;
  rig.relative.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.relative.ErrorID, static_cast<WORD>(0x800F));
  EXPECT_TRUE(rig.stop.Done);
  rig.stop.Execute = false;
  rig.relative.Execute = false;
  rig.run(3);
  rig.relative.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
}

TEST(MC_Home, ShiftsARunningMotionWithoutChangingIt) {
  OneAxis rig;
  rig.home.Execute = false;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  const double before = rig.a.data.Position;
  rig.continuity[0].velocity = false;  // the position is renamed
  rig.home.Position = 1000.0;
  rig.home.Mode = 1;
  rig.home.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.home.Done);
  EXPECT_NEAR(rig.a.data.Position, before + 1000.0 + 0.2, 1e-9);
  EXPECT_EQ(rig.a.data.Velocity, 100.0);
  EXPECT_TRUE(rig.velocity.InVelocity);
}

TEST(MC_MoveAbsolute, ToWhereItIsMakesNoTurnForARounding) {
  for (const INT direction : {INT{1}, INT{2}}) {
    OneAxis rig(use_modulo);
    for (const double distance : {0.1, 0.2}) {
      rig.relative.Execute = false;
      rig.run(2);
      rig.relative.Distance = distance;
      rig.relative.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
    }
    ASSERT_NE(rig.a.data.Position, 0.3) << "0.1 + 0.2";
    rig.move.Position = 0.3;
    rig.move.Direction = direction;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }, 300)) << direction;
    EXPECT_EQ(rig.a.data.Position, 0.3);
    EXPECT_EQ(rig.a.data.ModuloCycle, 0);
  }
}

TEST(MC_Home, ShiftsTheTargetThatARunningPositioningShows) {
  for (const INT mode : {INT{0}, INT{1}, INT{11}, INT{12}}) {
    OneAxis rig;
    rig.home.Execute = false;
    rig.relative.Distance = 100.0;
    rig.relative.Execute = true;
    rig.run(300);
    const auto& status = rig.a.data.StatusPositioning;
    ASSERT_NEAR(status.TargetPosition - rig.a.data.Position, status.Distance, 1e-9);
    rig.continuity[0].velocity = false;  // the position is renamed
    rig.home.Position = 1000.0;
    rig.home.Mode = mode;
    rig.home.Execute = true;
    rig.run(2);
    ASSERT_TRUE(rig.home.Done);
    EXPECT_GT(status.TargetPosition, 1000.0);
    EXPECT_NEAR(status.TargetPosition - rig.a.data.Position, status.Distance, 1e-9) << "mode " << mode;
    ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
    EXPECT_EQ(rig.a.data.Position, status.TargetPosition);
  }
}

TEST(ExecuteBlock, ShowsItsEndForOneCallWhenExecuteFellBefore) {
  OneAxis rig;
  rig.relative.Distance = 1.0;
  rig.relative.Execute = true;
  rig.run(1);
  rig.relative.Execute = false;
  int calls = 0;
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    if (rig.relative.Done) ++calls;
  }
  EXPECT_EQ(calls, 1);
}

TEST(ExecuteBlock, ARejectedJobLeavesTheRunningOneAlone) {
  OneAxis rig;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  rig.relative.Velocity = 0.0;
  rig.relative.Execute = true;
  rig.run(1);
  EXPECT_EQ(rig.relative.ErrorID, static_cast<WORD>(0x8003));
  rig.run(10);
  EXPECT_TRUE(rig.velocity.InVelocity);
  EXPECT_EQ(rig.a.data.Velocity, 100.0);
}

TEST(MC_Reset, AcknowledgesAnAlarm) {
  OneAxis rig;
  rig.continuity[0].acceleration = false;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InVelocity; }));
  rig.a.raise(alarm::kSynchronizing);
  rig.run(2);
  EXPECT_EQ(rig.velocity.ErrorID, static_cast<WORD>(0x8001));
  ASSERT_TRUE(rig.run_until([&] { return rig.a.data.Velocity == 0.0; }));
  rig.relative.Distance = 1.0;
  rig.relative.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.relative.ErrorID, static_cast<WORD>(0x8001));
  rig.reset.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.reset.Done);
  EXPECT_FALSE(bit(rig.a, StatusBit::Error));
  rig.relative.Execute = false;
  rig.run(1);
  rig.relative.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.relative.Done; }));
}

}  // namespace
}  // namespace lockstep::positioning_test
