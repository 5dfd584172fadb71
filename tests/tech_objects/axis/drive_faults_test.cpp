// Faults of drive, encoder and communication: alarms, reactions, acknowledgement; and how a drive stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::drive_faults_test {
namespace {

using test::Rig;

/// An axis whose drive can fail, and one that follows it.
struct Failing : Rig {
  explicit Failing(const std::function<void(Axis&)>& change = {}, Coupling coupling = Coupling::setpoint)
      : Rig(1'000'000, 1),
        a(axis("Driven", [](AxisData& data) { data.VirtualAxis.Mode = 0; })),
        follower(axis("Follower")),
        power(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        run_v(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()) {
    a.drive_settings.time_constant = 0.002;
    a.drive_settings.faults = {&drive, &encoder, &communication, &blocked};
    if (change) change(a);
    follower.leading_values.push_back({&a, coupling});
    power.Axis = home.Axis = run_v.Axis = &a;
    reset.Axis = &a;
    power_f.Axis = &follower;
    gear.Master = &a;
    gear.Slave = &follower;
    continuity[0].velocity = continuity[1].velocity = false;
    power.Enable = power_f.Enable = true;
    run(10);
    home.Execute = true;
    run_v.Velocity = 100.0;
    run_v.Execute = true;
    run(1000);
  }

  void acknowledge() {
    reset.Execute = false;
    run(1);
    reset.Execute = true;
    run(3);
  }

  bool drive = false, encoder = false, communication = false, blocked = false;
  Axis& a;
  Axis& follower;
  MC_Power& power;
  MC_Power& power_f;
  MC_Home& home;
  MC_Reset& reset;
  MC_MoveVelocity& run_v;
  MC_GearIn& gear;
};

TEST(DriveFault, RemovesTheEnableAndIsAcknowledgedOnceItsCauseIsGone) {
  Failing rig;
  ASSERT_TRUE(rig.run_v.InVelocity);
  rig.drive = true;
  rig.run(3);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault);
  EXPECT_EQ(rig.a.data.ErrorDetail.Reaction, 4);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::DriveFault));
  EXPECT_TRUE(rig.a.data.StatusDrive.Error);
  EXPECT_FALSE(rig.a.data.StatusDrive.CommunicationOK) << "ZSW1.X3 counts, too";
  EXPECT_FALSE(rig.a.data.StatusDrive.InOperation);
  EXPECT_TRUE(rig.a.data.StatusSensor[0].CommunicationOK);
  EXPECT_TRUE(rig.run_v.Error);
  EXPECT_EQ(rig.run_v.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(rig.power.Error);
  EXPECT_TRUE(has_bit(rig.a.data.StatusWord, StatusBit::HomingDone));
  rig.acknowledge();
  EXPECT_TRUE(rig.reset.Done);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault) << "its cause is still there";
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::DriveFault));
  rig.drive = false;
  rig.run(5);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault) << "it waits to be acknowledged";
  rig.acknowledge();
  rig.run(100);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_FALSE(rig.a.data.StatusDrive.Error);
  EXPECT_TRUE(rig.a.data.StatusDrive.CommunicationOK);
  EXPECT_TRUE(rig.power.Status) << "Enable has stayed TRUE";
}

TEST(DriveFault, OfADisabledAxisIsShownAndAcknowledgedWithoutAnAlarm) {
  Failing rig;
  rig.power.Enable = false;
  rig.run(500);
  rig.drive = true;
  rig.run(3);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_TRUE(rig.a.data.StatusDrive.Error);
  rig.power.Enable = true;
  rig.run(5);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault);
  EXPECT_FALSE(rig.power.Status);
  rig.power.Enable = false;
  rig.drive = false;
  rig.run(5);
  rig.acknowledge();
  EXPECT_FALSE(rig.a.data.StatusDrive.Error);
}

TEST(EncoderFault, StopsTheAxisForgetsItsHomeAndGoesOnFromWhereItWasSeenLast) {
  Failing rig;
  rig.encoder = true;
  rig.run(3);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kEncoder);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::SensorFault));
  EXPECT_TRUE(rig.a.data.StatusSensor[0].Error);
  EXPECT_EQ(rig.a.data.StatusSensor[0].State, 0);
  EXPECT_FALSE(has_bit(rig.a.data.StatusWord, StatusBit::HomingDone));
  const double seen = rig.a.data.ActualPosition;
  rig.run(100);
  EXPECT_EQ(rig.a.data.ActualPosition, seen);
  rig.encoder = false;
  rig.run(10);
  EXPECT_EQ(rig.a.data.ActualPosition, seen);
  EXPECT_EQ(rig.a.data.StatusSensor[0].State, 0);
  rig.acknowledge();
  rig.run(50);
  EXPECT_EQ(rig.a.data.StatusSensor[0].State, 2);
  EXPECT_FALSE(rig.a.data.StatusSensor[0].Error);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_NEAR(rig.a.data.ActualPosition, seen, 1e-6);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
}

TEST(EncoderFault, OfAnAbsoluteEncoderLeavesItHomed) {
  Failing rig([](Axis& a) { a.data.Sensor[0].Type = 1; });
  rig.encoder = true;
  rig.run(200);
  rig.encoder = false;
  rig.acknowledge();
  rig.run(50);
  EXPECT_TRUE(has_bit(rig.a.data.StatusWord, StatusBit::HomingDone));
  EXPECT_TRUE(rig.power.Status);
}

TEST(LostCommunication, FreezesTheActualValuesAndStopsTheDriveByItself) {
  Failing rig;
  rig.communication = true;
  rig.run(3);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kCommunication);
  EXPECT_TRUE(has_bit(rig.a.data.ErrorWord, ErrorBit::CommunicationFault));
  EXPECT_FALSE(rig.a.data.StatusDrive.CommunicationOK);
  EXPECT_FALSE(rig.a.data.StatusDrive.InOperation);
  EXPECT_FALSE(rig.a.data.StatusSensor[0].CommunicationOK);
  EXPECT_EQ(rig.a.data.StatusSensor[0].State, 0);
  rig.run(200);
  rig.communication = false;
  rig.run(5);
  EXPECT_EQ(rig.a.data.ActualVelocity, 0.0);
  rig.acknowledge();
  rig.run(100);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_TRUE(rig.a.data.StatusDrive.CommunicationOK);
}

TEST(LostCommunication, IsToldAgainIfItIsStillLost) {
  Failing rig;
  rig.communication = true;
  rig.run(10);
  rig.acknowledge();
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kCommunication);
  EXPECT_FALSE(rig.power.Status);
}

TEST(FollowingErrorFault, OfABlockedMachineRaisesAlarm521) {
  Failing rig;
  rig.blocked = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.pending_alarm() != 0; }, 3000));
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kFollowingError);
  EXPECT_EQ(rig.a.data.ActualVelocity, 0.0);
  rig.blocked = false;
  rig.acknowledge();
  rig.run(50);
  EXPECT_TRUE(rig.power.Status);
}

TEST(SensorLost, StopsWhatFollowsTheAxis) {
  for (const Coupling coupling : {Coupling::setpoint, Coupling::actual}) {
    Failing rig({}, coupling);
    rig.gear.Execute = true;
    rig.run(1000);
    ASSERT_TRUE(rig.gear.InGear);
    rig.encoder = true;
    rig.run(4);
    EXPECT_EQ(rig.follower.pending_alarm(), alarm::kLeadingAxis);
    EXPECT_TRUE(rig.gear.Error);
  }
}

// ---- How a drive stops
// -------------------------------------------------------------------------------------------

void brake_by(Failing& rig, INT stop_mode) {
  rig.power.StopMode = stop_mode;
  rig.power.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.power.Status);
}

TEST(StopMode, Mode1IsAQuickStopAndBusyUntilTheDriveStands) {
  Failing rig([](Axis& a) { a.drive_settings.quick_stop = 1000.0; });
  brake_by(rig, 1);
  rig.run(48);
  EXPECT_TRUE(rig.power.Busy);
  EXPECT_NEAR(rig.a.data.ActualVelocity, 52.0, 4.0) << "behind its ramp by the lag of the drive";
  EXPECT_FALSE(rig.a.data.StatusDrive.Disabled);
  EXPECT_NEAR(rig.a.data.Position, rig.a.data.ActualPosition, 0.2) << "the setpoint follows";
  rig.run(200);
  EXPECT_FALSE(rig.power.Busy);
  EXPECT_TRUE(rig.a.data.StatusDrive.Disabled);
  EXPECT_NEAR(rig.a.data.ActualVelocity, 0.0, 0.2);
  rig.power.Enable = true;
  rig.run(5);
  EXPECT_TRUE(rig.power.Status);
}

TEST(StopMode, Mode1CannotBeRevokedBeforeTheDriveStands) {
  Failing rig([](Axis& a) { a.drive_settings.quick_stop = 1000.0; });
  brake_by(rig, 1);
  rig.power.Enable = true;
  rig.run(50);
  EXPECT_FALSE(rig.power.Status);
  rig.run(200);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_NEAR(rig.a.data.ActualVelocity, 0.0, 0.2);
}

TEST(StopMode, Mode3InhibitsThePulsesAtOnce) {
  Failing rig([](Axis& a) {
    a.drive_settings.plant.inertia = 0.01;
    a.drive_settings.plant.friction = 1.0;
  });
  brake_by(rig, 3);
  EXPECT_FALSE(rig.power.Busy);
  EXPECT_TRUE(rig.a.data.StatusDrive.Disabled);
  EXPECT_GT(rig.a.data.ActualVelocity, 90.0);
  rig.run(5000);
  EXPECT_EQ(rig.a.data.ActualVelocity, 0.0);
}

TEST(StopMode, Modes0And2BrakeWithTheirOwnRamps) {
  for (const INT mode : {INT{0}, INT{2}}) {
    Failing rig([](Axis& a) {
      a.data.DynamicDefaults.EmergencyDeceleration = 2000.0;
      a.data.DynamicLimits.MaxDeceleration = 500.0;
      a.data.DynamicLimits.MaxJerk = 10000.0;
    });
    brake_by(rig, mode);
    int ticks = 2;
    for (; rig.power.Busy && ticks < 1000; ++ticks) rig.tick();
    // 100 u/s with 2000 u/s²; with 500 u/s² and a jerk of 10000 u/s³.
    EXPECT_NEAR(ticks, mode == 0 ? 50 : 250, 3) << mode;
  }
}

TEST(EnablingInMotion, BrakesOnARampOrAtOnce) {
  for (const bool ramp : {true, false}) {
    Failing rig([&](Axis& a) {
      a.drive_settings.plant.inertia = 0.01;
      a.data.DynamicLimits.MaxDeceleration = 500.0;
      a.data.PositionControl.VelocityModePowerOn = ramp ? 0 : 1;
    });
    brake_by(rig, 3);
    rig.power.Enable = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.power.Status; }, 5));
    EXPECT_EQ(rig.a.data.Velocity > 90.0, ramp);
    EXPECT_EQ(rig.a.data.Velocity == 0.0, !ramp);
  }
}

TEST(EnablingInMotion, ReturnsToWhereItWasEnabled) {
  Failing rig([](Axis& a) {
    a.drive_settings.plant.inertia = 0.01;
    a.data.DynamicLimits.MaxDeceleration = 500.0;
    a.data.DynamicLimits.MaxJerk = 0.0;  // of the reaction
    a.data.DynamicDefaults.Jerk = 0.0;   // of the jobs
  });
  brake_by(rig, 3);
  rig.power.Enable = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.power.Status; }, 5));
  const double enabled_at = rig.a.data.ActualPosition;
  double furthest = enabled_at;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    furthest = std::max(furthest, rig.a.data.Position);
  }
  EXPECT_NEAR(furthest, enabled_at + 10.0, 1.0) << "100 u/s braked by 500 u/s²";
  EXPECT_NEAR(rig.a.data.Position, enabled_at, 0.25) << "within the way of a tick or two";
  EXPECT_NEAR(rig.a.data.ActualPosition, rig.a.data.Position, 0.01);
  EXPECT_EQ(rig.a.data.Velocity, 0.0);
  EXPECT_EQ(rig.a.data.ErrorDetail.Number, 0u);
}

// ---- Control words
// -----------------------------------------------------------------------------------------------

TEST(ControlWords, AreThoseOfTheStateOfTheAxis) {
  Failing rig;
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn);
  brake_by(rig, 3);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlCoast);
  rig.power.Enable = true;
  rig.run(5);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn);
  rig.power.StopMode = 0;
  rig.power.Enable = false;
  rig.run(2000);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOff);
}

// ---- Backlash
// ---------------------------------------------------------------------------------------------------

TEST(Backlash, IsPassedByTheMotorWhenTheAxisTurnsRound) {
  Failing rig([](Axis& a) { a.data.Sensor[0].Backlash = {true, 2.0, 40.0, 0}; });
  const double motor_ahead = rig.a.measured_line().rounded() - rig.a.data.ActualPosition;
  rig.run_v.Execute = false;
  rig.run(2);
  rig.run_v.Velocity = -100.0;
  rig.run_v.Execute = true;
  ASSERT_TRUE(
      rig.run_until([&] { return has_bit(rig.a.data.StatusWord2, Status2Bit::PassingBacklash); }, 2000));
  int passing = 1;
  while (has_bit(rig.a.data.StatusWord2, Status2Bit::PassingBacklash) && passing < 1000) {
    rig.tick();
    ++passing;
  }
  EXPECT_NEAR(passing, 50, 3) << "2 u at 40 u/s";
  rig.run(1000);
  EXPECT_NEAR(rig.a.measured_line().rounded() - rig.a.data.ActualPosition, motor_ahead - 2.0, 1e-9);
  EXPECT_NEAR(rig.a.data.StatusPositioning.FollowingError, 0.0, 1e-5);
}

// ---- Simulation.Mode
// ---------------------------------------------------------------------------------------------

TEST(SimulatedAxis, MovesWithoutItsDriveAsAVirtualOneDoes) {
  Failing rig([](Axis& a) { a.data.Simulation.Mode = 1; });
  EXPECT_TRUE(has_bit(rig.a.data.StatusWord, StatusBit::AxisSimulation));
  EXPECT_TRUE(rig.power.Status);
  EXPECT_TRUE(rig.run_v.InVelocity);
  EXPECT_EQ(rig.a.data.ActualPosition, rig.a.data.Position);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOff);
  rig.drive = rig.encoder = rig.communication = true;
  rig.run(10);
  EXPECT_EQ(rig.a.pending_alarm(), 0) << "the drive does not matter";
}

TEST(SimulatedAxis, TakesItsDriveUpWithARestart) {
  Failing rig([](Axis& a) { a.data.Simulation.Mode = 1; });
  rig.power.StopMode = 2;
  rig.power.Enable = false;
  rig.run(500);
  const double here = rig.a.data.Position;
  static_cast<AxisData*>(rig.a.start_values())->Simulation.Mode = 0;
  rig.reset.Restart = true;
  rig.acknowledge();
  EXPECT_TRUE(rig.reset.Done);
  EXPECT_FALSE(has_bit(rig.a.data.StatusWord, StatusBit::AxisSimulation));
  rig.power.Enable = true;
  rig.run(20);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn);
  EXPECT_NEAR(rig.a.data.ActualPosition, here, 1e-9);
}

}  // namespace
}  // namespace lockstep::drive_faults_test
