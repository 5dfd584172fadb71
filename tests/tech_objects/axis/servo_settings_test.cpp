// Settings of an axis with a drive: setpoint filter, axis model, inverted directions, linear motor.
#include <gtest/gtest.h>

#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::servo_settings_test {
namespace {

using test::Rig;

/// An axis with a drive that is late by a lag of 10 ms.
struct Driven : Rig {
  using Configure = std::function<void(Axis&)>;

  explicit Driven(const Configure& configure = {}, int ratio = 1)
      : Rig(1'000'000, ratio),
        slide(axis("Slide", [](AxisData& data) { data.VirtualAxis.Mode = 0; })),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_at(block<MC_MoveVelocity>()),
        to(block<MC_MoveAbsolute>()) {
    slide.drive_settings.time_constant = 0.01;
    if (configure) configure(slide);
    power.Axis = home.Axis = run_at.Axis = to.Axis = &slide;
    power.Enable = true;
    Rig::run(10 * ratio);
    home.Execute = true;
    Rig::run(10 * ratio);
  }

  /// Runs at a velocity until everything has settled.
  void settle_at(double velocity) {
    run_at.Velocity = velocity;
    run_at.Execute = true;
    ASSERT_TRUE(run_until([&] { return run_at.InVelocity; }));
    run(4000);
  }
  /// By what the axis is behind its setpoint [s]: that of the tick before, which the servo is carrying out.
  double late() const {
    const auto& data = slide.data;
    return difference(slide.last_setpoint().position, {data.ActualModuloCycle, data.ActualPosition},
                      slide.modulo())
               .rounded() /
           data.ActualVelocity;
  }

  Axis& slide;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_at;
  MC_MoveAbsolute& to;
};

TO_Struct_DynamicFilter filter(double t1, double t2, double dead) {
  return {.Mode = 1, .T1 = t1, .T2 = t2, .Tt = dead};
}

TEST(SetpointFilter, MakesTheAxisLateByItsTimesAndLeavesNoFollowingError) {
  Driven plain;
  plain.settle_at(100.0);
  for (const bool modulo : {false, true}) {
    Driven machine([&](Axis& axis) {
      axis.data.Modulo.Enable = modulo;
      axis.data.SetpointFilter.DynamicFilter = filter(0.02, 0.005, 0.0034);
    });
    machine.settle_at(100.0);
    EXPECT_NEAR(machine.late() - plain.late(), 0.0284, 1e-9);
    EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, 0.0, 1e-9);
    EXPECT_NEAR(machine.slide.data.StatusPositioning.SetpointExecutionTime -
                    plain.slide.data.StatusPositioning.SetpointExecutionTime,
                0.0284, 1e-12);
    const double filtered = machine.slide.data.StatusServo.PositionAfterDynamicFilter;
    EXPECT_NEAR(std::remainder(machine.slide.last_setpoint().position.value - filtered, 360.0), 2.84, 1e-9);
  }
}

TEST(SetpointFilter, BringsTheAxisToItsTargetWithoutPassingIt) {
  for (const int ratio : {1, 4}) {
    Driven machine([](Axis& axis) { axis.data.SetpointFilter.DynamicFilter = filter(0.05, 0.05, 0.0); },
                   ratio);
    machine.to.Position = 200.0;
    machine.to.Execute = true;
    double highest = 0.0;
    ASSERT_TRUE(machine.run_until([&] {
      highest = std::max(highest, machine.slide.data.StatusServo.PositionAfterDynamicFilter);
      return machine.to.Done;
    }));
    machine.run(3000 * ratio);
    EXPECT_LE(highest, 200.0);
    EXPECT_NEAR(machine.slide.data.ActualPosition, 200.0, 1e-6);
    EXPECT_NEAR(machine.slide.data.StatusServo.PositionAfterDynamicFilter, 200.0, 1e-12);
  }
}

TEST(SetpointFilter, LimitsItsDeadTimeToSixteenServoCycles) {
  Driven plain;
  plain.settle_at(100.0);
  Driven machine([](Axis& axis) { axis.data.SetpointFilter.DynamicFilter = filter(0.0, 0.0, 5.0); });
  machine.settle_at(100.0);
  EXPECT_NEAR(machine.late() - plain.late(), 0.016, 1e-9);
}

TEST(SetpointFilter, IsShiftedByHoming) {
  Driven machine([](Axis& axis) { axis.data.SetpointFilter.DynamicFilter = filter(0.02, 0.01, 0.004); });
  machine.settle_at(100.0);
  const double velocity = machine.slide.data.VelocitySetpoint;
  machine.continuity[0].velocity = false;
  machine.home.Execute = false;
  machine.run(2);
  machine.home.Mode = 1;
  machine.home.Position = 500.0;
  machine.home.Execute = true;
  for (int i = 0; i < 50; ++i) {
    machine.tick();
    ASSERT_NEAR(machine.slide.data.VelocitySetpoint, velocity, 1e-6);
  }
}

TEST(SetpointFilter, IsTakenUpByAMovingAxisWithoutAJerkOfTheDrive) {
  Driven machine([](Axis& axis) { axis.data.SetpointFilter.DynamicFilter = filter(0.02, 0.01, 0.004); });
  machine.run_at.PositionControlled = false;
  machine.settle_at(100.0);
  machine.continuity[0].velocity = false;  // the setpoint begins anew, ahead by what is late
  machine.run_at.Execute = false;
  machine.run(2);
  machine.run_at.PositionControlled = true;
  machine.run_at.Execute = true;
  for (int i = 0; i < 200; ++i) {
    machine.tick();
    ASSERT_NEAR(machine.slide.data.VelocitySetpoint, 100.0, 1e-3);
    ASSERT_NEAR(machine.slide.data.StatusPositioning.FollowingError, 0.0, 1e-3);
  }
}

TEST(AxisModel, TellsTheBalancingFilterHowLateTheAxisIs) {
  Driven known;
  known.settle_at(100.0);
  const auto late_with = [](double velocity_time, double additional) {
    Driven machine([&](Axis& axis) { axis.data.DynamicAxisModel = {velocity_time, additional}; });
    machine.settle_at(100.0);
    EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, 0.0, 1e-6);
    return machine.late();
  };
  EXPECT_NEAR(late_with(0.01, 0.0), known.late(), 1e-9) << "what the drive is";
  EXPECT_NEAR(late_with(0.02, 0.0) - known.late(), 0.01, 1e-6);
  EXPECT_NEAR(late_with(0.01, 0.005) - known.late(), 0.005, 1e-6);
}

TEST(AxisModel, ThatIsWrongShowsWhileTheAxisSpeedsUp) {
  const auto largest_error = [](double velocity_time) {
    Driven machine([&](Axis& axis) { axis.data.DynamicAxisModel.VelocityTimeConstant = velocity_time; });
    machine.run_at.Velocity = 200.0;
    machine.run_at.Execute = true;
    double largest = 0.0;
    for (int i = 0; i < 400; ++i) {
      machine.tick();
      largest = std::max(largest, std::abs(machine.slide.data.StatusPositioning.FollowingError));
    }
    return largest;
  };
  EXPECT_GT(largest_error(0.03), 5.0 * largest_error(0.01));
}

TEST(FollowingErrorDelay, CountsAgainstASetpointThatIsDelayedFurther) {
  Driven machine([](Axis& axis) { axis.data.FollowingError.AdditionalSetpointDelayTime = 0.03; });
  machine.settle_at(100.0);
  EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, -3.0, 1e-6);
  EXPECT_NEAR(machine.slide.data.StatusServo.ControlDifference, 0.0, 1e-6);
  machine.slide.data.FollowingError.AdditionalSetpointDelayTime = 0.0;
  machine.run(3);
  EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, 0.0, 1e-6);
  machine.run(1000);
  machine.slide.data.FollowingError.AdditionalSetpointDelayTime = 0.03;
  machine.run(1);
  EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, 0.0, 0.2) << "from now on, not from then";
}

TEST(InverseDirection, MakesUpForADriveThatIsMountedTheOtherWayRound) {
  bool at_mark = false;
  Driven machine([&](Axis& axis) {
    axis.data.Actor.InverseDirection = true;
    axis.data.Sensor[0].InverseDirection = true;
    axis.drive_settings.inverted = true;
    axis.drive_settings.signals.zero_marks = ZeroMarks{25.0, 0.0};
    axis.drive_settings.signals.digital_inputs = {{&at_mark, {25.0 - 1e-6, 25.0 + 1e-6}}};
  });
  machine.continuity[0].homing = true;
  machine.home.Execute = false;
  machine.run(2);
  machine.home.Mode = 3;
  machine.home.Execute = true;
  ASSERT_TRUE(machine.run_until([&] { return machine.home.Done; }));
  machine.run(3000);
  EXPECT_TRUE(at_mark);
}

TEST(InverseDirection, OfBothTurnsTheMachineTheOtherWay) {
  bool backwards = false;
  Driven machine([&](Axis& axis) {
    axis.data.Actor.InverseDirection = true;
    axis.data.Sensor[0].InverseDirection = true;
    axis.drive_settings.signals.zero_marks = ZeroMarks{-25.0, 0.0};
    axis.drive_settings.signals.digital_inputs = {{&backwards, {-25.0 - 1e-6, -25.0 + 1e-6}}};
  });
  machine.continuity[0].homing = true;
  machine.home.Execute = false;
  machine.run(2);
  machine.home.Mode = 3;
  machine.home.Execute = true;
  ASSERT_TRUE(machine.run_until([&] { return machine.home.Done; }));
  machine.run(3000);
  EXPECT_TRUE(backwards);
  EXPECT_NEAR(machine.slide.data.ActualPosition, 0.0, 1e-6);
}

TEST(InverseDirection, OfOneOfThemEndsInTheFollowingError) {
  for (const bool actor : {true, false}) {
    Driven machine([&](Axis& axis) {
      axis.data.Actor.InverseDirection = actor;
      axis.data.Sensor[0].InverseDirection = !actor;
    });
    machine.continuity[0].velocity = false;
    machine.run_at.Velocity = 100.0;
    machine.run_at.Execute = true;
    EXPECT_TRUE(machine.run_until([&] { return machine.slide.pending_alarm() == 521; }, 3000));
  }
}

/// Without precontrol all of the velocity comes out of the control difference: five times the gain asks for
/// five times the velocity.
TEST(PositionControl, ChangesItsGainWithTheSmoothingTimeOfTheManipulatedVariable) {
  for (const bool in_drive : {false, true}) {
    for (const double time : {0.0, 0.05}) {
      Driven m([&](Axis& slide) {
        slide.data.PositionControl.Kpc = 0.0;
        slide.data.PositionControl.EnableDSC = in_drive;
        slide.data.PositionControl.SmoothingTimeByChangeDifference = time;
        slide.data.FollowingError.EnableMonitoring = false;
        slide.drive_settings.time_constant = 0.001;
      });
      m.settle_at(50.0);
      const auto commanded = [&] {
        const auto& data = m.slide.data;
        const double difference = data.PositionControl.Kv * data.StatusServo.ControlDifference;
        return data.VelocitySetpoint + (in_drive ? difference : 0.0);
      };
      ASSERT_NEAR(commanded(), 50.0, 0.1);
      m.slide.data.PositionControl.Kv = 50.0;
      double last = commanded() + (in_drive ? -40.0 * m.slide.data.StatusServo.ControlDifference : 0.0);
      double maximum = 0.0;
      for (int i = 0; i < 500; ++i) {
        m.tick();
        maximum = std::max(maximum, std::abs(commanded() - last));
        last = commanded();
      }
      if (time > 0.0)
        EXPECT_LT(maximum, 10.0) << (in_drive ? "DSC" : "");
      else
        EXPECT_GT(maximum, 150.0) << (in_drive ? "DSC" : "");
      EXPECT_NEAR(commanded(), 50.0, 0.1);
    }
  }
}

TEST(LinearMotor, LimitsTheSetpointToItsMaximumVelocity) {
  Driven machine([](Axis& axis) {
    axis.data.Actor.MotorType = 1;
    axis.data.Actor.LinearMotorDriveParameter.MaxVelocity = 80.0;
    axis.data.FollowingError.EnableMonitoring = false;
  });
  machine.run_at.Velocity = 100.0;
  machine.run_at.Execute = true;
  machine.run(1000);
  EXPECT_EQ(machine.slide.data.VelocitySetpoint, 80.0);
  EXPECT_TRUE(has_bit(machine.slide.data.WarningWord, WarningBit::DynamicWarning));
}

TEST(Mechanics, CountAnewAfterARestart) {
  Driven machine([](Axis& axis) {
    axis.data.Mechanics.LeadScrew = 10.0;
    axis.data.FollowingError.EnableMonitoring = false;
  });
  auto& reset = machine.block<MC_Reset>();
  reset.Axis = &machine.slide;
  reset.Restart = true;
  machine.power.Enable = false;
  machine.run_until([&] { return machine.slide.off(); });
  auto& start = *static_cast<AxisData*>(machine.slide.start_values());
  start.Mechanics.LeadScrew = 5.0;
  start.LoadGear = {2, 1};
  start.Actor.DriveParameter.MaxSpeed = 1200.0;  // 600 turns of the load: 3,000 mm a minute
  reset.Execute = true;
  machine.run(10);
  ASSERT_TRUE(reset.Done);
  machine.power.Enable = true;
  machine.run(20);
  machine.run_at.Velocity = 100.0;
  machine.run_at.Execute = true;
  machine.run(1000);
  EXPECT_EQ(machine.slide.data.VelocitySetpoint, 50.0);
  EXPECT_NEAR(machine.slide.data.ActualSpeed, 1200.0, 1e-6);
}

}  // namespace
}  // namespace lockstep::servo_settings_test
