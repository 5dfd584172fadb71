// An axis with several encoders: what they show, MC_SetSensor, homing of each, their faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/parameter.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/simulated_drive.hpp"

namespace lockstep::sensors_test {
namespace {

using test::Rig;

/// A slide with the encoder of its motor and two others, of which one slips by a hundredth.
struct Slide : Rig {
  explicit Slide(const std::function<void(Axis&)>& change = {})
      : a(axis("Slide",
               [](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.Sensor[1].Existent = data.Sensor[2].Existent = true;
                 data.PositioningMonitoring.MinDwellTime = 0.02;
                 data.Homing.ApproachVelocity = 100.0;
                 data.Homing.ReferencingVelocity = 20.0;
               })),
        power(block<MC_Power>()),
        reset(block<MC_Reset>()),
        home(block<MC_Home>()),
        sensor(block<MC_SetSensor>()),
        move(block<MC_MoveAbsolute>()) {
    a.drive_settings.time_constant = 0.002;
    a.drive_settings.sensors[0] = {.exists = true, .ratio = 1.01, .fault = &fault};
    a.drive_settings.sensors[1] = {.exists = true, .resolution = 0.5, .inverted = true};
    a.data.Sensor[2].InverseDirection = true;
    if (change) change(a);
    power.Axis = home.Axis = sensor.Axis = move.Axis = &a;
    reset.Axis = &a;
    continuity[0].velocity = false;
    power.Enable = true;
    run(10);
    EXPECT_EQ(homed(0, 0.0), ErrorId::none);
  }

  template <class B>
  ErrorId answer(B& block) {
    block.Execute = false;
    run(2);
    block.Execute = true;
    EXPECT_TRUE(run_until([&] { return block.Done || block.Error; }));
    return static_cast<ErrorId>(block.ErrorID);
  }
  ErrorId homed(INT mode, double position, DINT number = 0) {
    home.Mode = mode;
    home.Position = position;
    home.Sensor = number;
    return answer(home);
  }
  ErrorId set(INT number, DINT mode, INT reference = 1) {
    sensor.Sensor = number;
    sensor.Mode = mode;
    sensor.ReferenceSensor = reference;
    return answer(sensor);
  }
  void go(double position) {
    move.Position = position;
    move.Velocity = 200.0;
    EXPECT_EQ(answer(move), ErrorId::none);
    run(3000);  // position control comes to its end
  }
  double machine() const { return test::simulated_drive(a).machine_position().rounded(); }
  const TO_Struct_StatusSensor& status(int number) const { return a.data.StatusSensor[number - 1]; }

  bool fault = false;
  Axis& a;
  MC_Power& power;
  MC_Reset& reset;
  MC_Home& home;
  MC_SetSensor& sensor;
  MC_MoveAbsolute& move;
};

TEST(Sensors, AllShowWhatTheyTellAndOneIsOperative) {
  Slide slide;
  slide.go(100.25);
  EXPECT_EQ(slide.a.data.OperativeSensor, 1u);
  EXPECT_NEAR(slide.status(1).Position, 100.25, 1e-6);
  EXPECT_NEAR(slide.status(2).Position, 101.2525, 1e-6);
  EXPECT_NEAR(slide.status(3).Position, 100.25, 0.2501);
  EXPECT_EQ(std::fmod(slide.status(3).Position, 0.5), 0.0);
  for (const int number : {1, 2, 3}) EXPECT_EQ(slide.status(number).State, 2);
  EXPECT_TRUE(slide.status(1).Control);
  EXPECT_FALSE(slide.status(2).Control);
  EXPECT_EQ(slide.set(4, 0), ErrorId::sensor);
}

TEST(SetSensorMode0, TakesThePositionAlongAndControlsWithTheOtherEncoder) {
  Slide slide;
  slide.go(100.0);
  const double before = slide.machine();
  EXPECT_EQ(slide.set(2, 0), ErrorId::none);
  EXPECT_EQ(slide.a.data.OperativeSensor, 2u);
  EXPECT_TRUE(slide.status(2).Control);
  EXPECT_FALSE(slide.status(1).Control);
  slide.run(500);
  EXPECT_NEAR(slide.a.data.ActualPosition, 100.0, 1e-6);
  EXPECT_NEAR(slide.machine(), before, 1e-6) << "nothing has moved";
  slide.go(201.0);
  EXPECT_NEAR(slide.machine() - before, 100.0, 1e-6) << "101 of this encoder";
  EXPECT_NEAR(slide.status(1).Position, 200.0, 1e-6);
  EXPECT_EQ(slide.set(1, 0), ErrorId::none);
  EXPECT_NEAR(slide.a.data.ActualPosition, 201.0, 1e-6);
  EXPECT_EQ(slide.set(1, 0), ErrorId::none) << "it is operative already";
}

TEST(SetSensorMode1, MakesTheDifferenceAControlDeviation) {
  Slide slide;
  slide.go(100.0);
  const double before = slide.machine();
  EXPECT_EQ(slide.set(2, 1), ErrorId::none);
  slide.run(2);
  EXPECT_LT(slide.a.data.StatusPositioning.FollowingError, -0.5);
  slide.run(3000);
  EXPECT_NEAR(slide.a.data.ActualPosition, 100.0, 1e-6);
  EXPECT_NEAR(slide.machine(), before - 1.0 / 1.01, 1e-5);
}

/// Maximum velocity setpoint in the first servo cycle after a switch, and in all.
std::pair<double, double> velocities_after_a_switch(double smoothing) {
  Slide slide([&](Axis& axis) { axis.data.PositionControl.SmoothingTimeByChangeDifference = smoothing; });
  slide.go(100.0);
  slide.sensor.Sensor = 2;
  slide.sensor.Mode = 1;
  slide.sensor.Execute = true;
  slide.tick();
  EXPECT_EQ(slide.a.data.OperativeSensor, 2u);
  slide.tick();
  const double first = std::abs(slide.a.data.VelocitySetpoint);
  double maximum = first;
  for (int i = 0; i < 3000; ++i) {
    slide.tick();
    maximum = std::max(maximum, std::abs(slide.a.data.VelocitySetpoint));
  }
  EXPECT_NEAR(slide.a.data.ActualPosition, 100.0, 1e-6);
  return {first, maximum};
}

TEST(SetSensorMode1, IsSmoothedWithTheTimeOfTheManipulatedVariable) {
  const auto [hard_first, hard_maximum] = velocities_after_a_switch(0.0);
  EXPECT_NEAR(hard_first, 10.0, 0.2) << "Kv times the difference, at once";
  const auto [soft_first, soft_maximum] = velocities_after_a_switch(0.2);
  EXPECT_LT(soft_first, 0.2);
  EXPECT_LT(soft_maximum, 0.5 * hard_maximum);
}

TEST(SetSensorModes2And3, CopyAPositionWithoutSwitchingOver) {
  Slide slide;
  slide.go(100.0);
  EXPECT_EQ(slide.set(2, 2), ErrorId::none);
  slide.run(2);
  EXPECT_NEAR(slide.status(2).Position, 100.0, 1e-6);
  EXPECT_EQ(slide.a.data.OperativeSensor, 1u);
  slide.go(200.0);
  EXPECT_NEAR(slide.status(2).Position, 201.0, 1e-6);
  EXPECT_EQ(slide.set(3, 3, 2), ErrorId::none);
  slide.run(2);
  EXPECT_NEAR(slide.status(3).Position, 201.0, 1e-6);
  EXPECT_NEAR(slide.a.data.ActualPosition, 200.0, 1e-6);
  EXPECT_EQ(slide.set(3, 3, 3), ErrorId::reference_sensor);
}

TEST(SetSensor, IsRefusedWhileAHomingWaitsForItsMarkOrTheEncoderFails) {
  Slide slide([](Axis& axis) { axis.drive_settings.signals.zero_marks = ZeroMarks{500.0, 0.0}; });
  slide.home.Mode = 8;
  slide.home.Execute = false;
  slide.run(2);
  slide.home.Execute = true;
  slide.run(3);
  ASSERT_TRUE(slide.home.Busy);
  EXPECT_EQ(slide.set(2, 0), ErrorId::homing_active);
  EXPECT_EQ(slide.homed(9, 0.0), ErrorId::none);
  slide.fault = true;
  slide.run(3);
  EXPECT_EQ(slide.a.pending_alarm(), 0) << "it is not operative";
  EXPECT_EQ(slide.status(2).State, 0);
  EXPECT_TRUE(slide.status(2).Error);
  EXPECT_EQ(slide.set(2, 0), ErrorId::actual_values_invalid);
  slide.fault = false;
  slide.run(3);
  EXPECT_EQ(slide.set(2, 0), ErrorId::none);
}

TEST(SensorFault, OfTheOperativeEncoderIsAlarm411OfAnotherOneItIsNot) {
  Slide slide;
  EXPECT_EQ(slide.set(2, 0), ErrorId::none);
  slide.go(50.0);
  slide.fault = true;
  slide.run(3);
  EXPECT_EQ(slide.a.pending_alarm(), alarm::kEncoder);
  EXPECT_FALSE(slide.a.actual_values_valid());
  EXPECT_EQ(slide.status(2).State, 0);
  EXPECT_EQ(slide.status(1).State, 2);
  slide.fault = false;
  slide.run(50);
  EXPECT_EQ(slide.answer(slide.reset), ErrorId::none);
  EXPECT_EQ(slide.a.pending_alarm(), 0);
  slide.run(200);
  EXPECT_TRUE(slide.power.Status);
  EXPECT_NEAR(slide.a.data.ActualPosition, 50.0, 0.1) << "from where it was seen last";
}

TEST(OperativeSensor, AtTheStartAndAfterARestartIsTheConfiguredOne) {
  Slide slide([](Axis& axis) { axis.data.PositionControl.InitialOperativeSensor = 2; });
  EXPECT_EQ(slide.a.data.OperativeSensor, 2u);
  slide.go(101.0);
  EXPECT_NEAR(slide.machine(), 100.0, 1e-6);
  EXPECT_EQ(slide.set(1, 0), ErrorId::none);
  slide.power.Enable = false;
  slide.run(500);
  slide.reset.Restart = true;
  EXPECT_EQ(slide.answer(slide.reset), ErrorId::none);
  slide.run(5);
  EXPECT_EQ(slide.a.data.OperativeSensor, 2u);
  EXPECT_NEAR(slide.a.data.ActualPosition, 101.0, 1e-6);
  EXPECT_NEAR(slide.status(1).Position, 101.0, 1e-6) << "all begin where the axis is";
}

TEST(HomingOfSensors, ShiftsAllAlikeOrTheOneThatIsAdjusted) {
  Slide slide;
  slide.go(100.0);
  EXPECT_EQ(slide.homed(1, 1000.0), ErrorId::none);
  slide.run(2);
  EXPECT_NEAR(slide.status(1).Position, 1100.0, 1e-6);
  EXPECT_NEAR(slide.status(2).Position, 1101.0, 1e-6);
  EXPECT_EQ(slide.homed(13, 7.0, 2), ErrorId::none);
  slide.run(2);
  EXPECT_NEAR(slide.status(2).Position, 7.0, 1e-6);
  EXPECT_EQ(slide.status(2).Adjusted, 1);
  EXPECT_NEAR(slide.a.data.ActualPosition, 1100.0, 1e-6);
  EXPECT_EQ(slide.homed(13, 20.0), ErrorId::none) << "0: the operative one";
  slide.run(2);
  EXPECT_NEAR(slide.a.data.ActualPosition, 20.0, 1e-6);
  EXPECT_NEAR(slide.status(2).Position, 7.0, 1e-6);
  EXPECT_EQ(slide.homed(7, 20.0, 2), ErrorId::homing_mode_incremental);
}

TEST(HomingOfSensors, FindsTheMarkWithTheOperativeEncoder) {
  Slide slide([](Axis& axis) {
    axis.data.PositionControl.InitialOperativeSensor = 2;
    axis.drive_settings.signals.zero_marks = ZeroMarks{30.0, 0.0};
  });
  EXPECT_EQ(slide.homed(3, 500.0), ErrorId::none);
  slide.run(1000);
  EXPECT_NEAR(slide.a.data.ActualPosition, 500.0, 1e-6);
  EXPECT_NEAR(slide.machine(), 30.0, 1e-5);
  EXPECT_EQ(slide.status(2).Adjusted, 1);
  EXPECT_EQ(slide.status(1).Adjusted, 0);
}

TEST(AbsoluteSensor, KeepsItsOwnOffsetAndGivesBackWhatASwitchHasAdded) {
  Slide slide([](Axis& axis) {
    axis.data.Sensor[1].Type = 1;
    axis.drive_settings.sensors[0].start_position = 500.0;
  });
  EXPECT_NEAR(slide.status(2).Position, 500.0, 1e-6);
  slide.go(100.0);
  EXPECT_EQ(slide.homed(7, 300.0, 2), ErrorId::none);
  EXPECT_TRUE(slide.a.encoder_adjustments[1].adjusted);
  EXPECT_NEAR(slide.a.encoder_adjustments[1].offset, 300.0 - 601.0, 1e-6);
  EXPECT_FALSE(slide.a.encoder_adjustments[0].adjusted);
  EXPECT_EQ(slide.set(2, 0), ErrorId::none);
  EXPECT_NEAR(slide.a.data.ActualPosition, 100.0, 1e-6);
  EXPECT_EQ(slide.set(1, 0), ErrorId::none);
  slide.run(2);
  EXPECT_NEAR(slide.status(2).Position, 300.0, 1e-6);
  EXPECT_NEAR(slide.a.data.ActualPosition, 100.0, 1e-6);
}

}  // namespace
}  // namespace lockstep::sensors_test
