// A speed axis: moved by its velocity alone.
#include <gtest/gtest.h>

#include "fb/jog.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/torque.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::speed_axis_test {
namespace {

using test::Rig;

struct Fan : Rig {
  explicit Fan(bool driven = true, const std::function<void(AxisData&)>& set = {})
      : fan(static_cast<Axis&>(controller.add_object(ObjectKind::TO_SpeedAxis, "Fan"))),
        power(block<MC_Power>()),
        move(block<MC_MoveVelocity>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        given(block<MC_MotionInVelocity>()),
        reset(block<MC_Reset>()) {
    continuity.emplace_back();
    fan.data.VirtualAxis.Mode = driven ? 0 : 1;
    if (set) set(fan.data);
    power.Axis = move.Axis = jog.Axis = halt.Axis = stop.Axis = given.Axis = &fan;
    reset.Axis = &fan;
    power.Enable = true;
    run(20);
  }
  Axis& fan;
  MC_Power& power;
  MC_MoveVelocity& move;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_MotionInVelocity& given;
  MC_Reset& reset;
};

TEST(SpeedAxis, RunsAtAVelocityAndHasNoPositionControl) {
  for (const bool driven : {true, false}) {
    Fan rig(driven);
    EXPECT_TRUE(rig.power.Status);
    EXPECT_FALSE(rig.fan.position_controlled());
    rig.move.Velocity = 1500.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.InVelocity; }));
    rig.run(10);
    EXPECT_EQ(rig.fan.data.Velocity, 1500.0);
    EXPECT_EQ(rig.fan.data.VelocitySetpoint, 1500.0);
    EXPECT_TRUE(has_bit(rig.fan.data.StatusWord, StatusBit::VelocityCommand));
    EXPECT_FALSE(has_bit(rig.fan.data.StatusWord, StatusBit::NonPositionControlled)) << "reserved";
    rig.halt.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.halt.Done; }));
    EXPECT_TRUE(rig.move.CommandAborted);
    EXPECT_EQ(rig.fan.data.Velocity, 0.0);
    EXPECT_FALSE(has_bit(rig.fan.data.StatusWord, StatusBit::Standstill)) << "reserved";
  }
}

// A gear of 3 turns of the motor to 2 of the load.
TEST(SpeedAxis, ShowsTheSpeedOfItsMotorInEachUnit) {
  for (const auto& [unit, per_minute] : {std::pair{1082u, 60.0}, {1083u, 1.0}, {1528u, 1.0 / 60.0}}) {
    Fan rig(true, [unit = unit](AxisData& data) {
      data.Units.VelocityUnit = unit;
      data.LoadGear = {3, 2};
    });
    rig.move.Velocity = 20.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.InVelocity; }));
    rig.run(20);
    EXPECT_NEAR(rig.fan.data.ActualSpeed, 20.0 * per_minute * 1.5, 1e-9);
  }
}

TEST(SpeedAxis, KeepsToTheSpeedOfItsMotor) {
  Fan rig(true, [](AxisData& data) { data.Actor.DriveParameter.MaxSpeed = 1000.0; });
  rig.move.Velocity = 1200.0;
  rig.move.Direction = 2;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.InVelocity; }));
  rig.run(10);
  EXPECT_NEAR(rig.fan.data.VelocitySetpoint, -1000.0, 1e-9);
  EXPECT_TRUE(has_bit(rig.fan.data.WarningWord, 6));
}

TEST(SpeedAxis, JogsTakesGivenVelocitiesStopsAndIsAcknowledged) {
  Fan rig;
  rig.jog.Velocity = 300.0;
  rig.jog.JogBackward = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.jog.InVelocity; }));
  EXPECT_EQ(rig.fan.data.Velocity, -300.0);
  rig.jog.JogBackward = false;
  ASSERT_TRUE(rig.run_until([&] { return !rig.jog.Busy; }));
  rig.continuity[0].velocity = false;
  rig.given.Velocity = 40.0;
  rig.given.Enable = true;
  rig.run(5);
  EXPECT_EQ(rig.fan.data.Velocity, 40.0);
  EXPECT_EQ(rig.fan.data.StatusMotionIn.FunctionState, 1);
  EXPECT_FALSE(rig.fan.position_controlled());
  rig.stop.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop.Done; }));
  EXPECT_TRUE(rig.given.CommandAborted);
  rig.fan.raise(alarm::kVelocityLimitZero);
  rig.run(2);
  EXPECT_EQ(rig.fan.data.ErrorDetail.Number, 304u);
  rig.reset.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.reset.Done);
  EXPECT_EQ(rig.fan.data.ErrorDetail.Number, 0u);
}

// It has no following error by which a fixed stop could be found.
TEST(SpeedAxis, IsLimitedInItsTorqueButFindsNoFixedStop) {
  Fan rig(true);
  auto& limiting = rig.block<MC_TorqueLimiting>();
  limiting.Axis = &rig.fan;
  limiting.Limit = 0.5;
  limiting.Mode = 1;
  limiting.Enable = true;
  rig.run(5);
  EXPECT_TRUE(limiting.Error && !limiting.Busy);
  EXPECT_EQ(limiting.ErrorID, static_cast<WORD>(ErrorId::mode));
  limiting.Enable = false;
  limiting.Mode = 0;
  rig.run(2);
  limiting.Enable = true;
  rig.run(5);
  EXPECT_TRUE(limiting.Busy && !limiting.Error);
  limiting.Mode = 1;
  rig.run(5);
  EXPECT_EQ(limiting.ErrorID, static_cast<WORD>(ErrorId::mode)) << "in every call";
  EXPECT_EQ(rig.fan.forces().limiting.mode, TorqueLimitingMode::limiting) << "the last permitted one goes on";
}

TEST(SpeedAxis, StopsWhenItIsDisabledWhateverTheStopMode) {
  for (const INT mode : {INT{0}, INT{1}, INT{2}, INT{3}}) {
    Fan rig;
    rig.continuity[0].velocity = false;
    rig.move.Velocity = 500.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.InVelocity; }));
    rig.power.StopMode = mode;
    rig.power.Enable = false;
    ASSERT_TRUE(rig.run_until([&] { return !rig.power.Busy; }));
    EXPECT_TRUE(rig.move.CommandAborted);
    rig.run(2000);
    EXPECT_EQ(rig.fan.data.Velocity, 0.0);
  }
}

}  // namespace
}  // namespace lockstep::speed_axis_test
