// What is changed at run time: free bits of the control words, parameters, encoders; and the velocity
// override.
#include <gtest/gtest.h>

#include "fb/drive_words.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/parameter.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::axis_parameter_test {
namespace {

using test::Rig;

struct Driven : Rig {
  Driven()
      : a(axis("Driven",
               [](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.Sensor[1].Existent = true;
               })),
        virtual_axis(axis("Virtual")),
        power(block<MC_Power>()),
        reset(block<MC_Reset>()),
        home(block<MC_Home>()),
        words(block<MC_SetAxisSTW>()),
        parameter(block<MC_WriteParameter>()),
        sensor(block<MC_SetSensor>()),
        move(block<MC_MoveVelocity>()) {
    a.drive_settings.signals.limit_max = 50.0;
    power.Axis = home.Axis = words.Axis = sensor.Axis = move.Axis = &a;
    parameter.Axis = &a;
    reset.Axis = &a;
    continuity[0].velocity = false;
    power.Enable = true;
    run(10);
  }

  template <class B>
  ErrorId answer(B& block) {
    block.Execute = false;
    run(2);
    block.Execute = true;
    run(2);
    EXPECT_NE(block.Done, block.Error);
    return static_cast<ErrorId>(block.ErrorID);
  }

  Axis& a;
  Axis& virtual_axis;
  MC_Power& power;
  MC_Reset& reset;
  MC_Home& home;
  MC_SetAxisSTW& words;
  MC_WriteParameter& parameter;
  MC_SetSensor& sensor;
  MC_MoveVelocity& move;
};

TEST(FreeControlBits, StayUntilTheyAreResetOrTheAxisIsRestarted) {
  Driven rig;
  rig.words.STW1 = rig.words.STW1BitMask = WORD{0x0900};
  rig.words.STW2 = WORD{0x0FFF};
  rig.words.STW2BitMask = WORD{0x0021};
  EXPECT_EQ(rig.answer(rig.words), ErrorId::none);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn | 0x0900);
  EXPECT_EQ(rig.a.drive().words().stw2, 0x0021);
  EXPECT_TRUE(rig.power.Status);
  rig.words.STW1 = WORD{0};
  rig.words.STW1BitMask = WORD{0x0100};
  rig.words.STW2BitMask = WORD{0};
  EXPECT_EQ(rig.answer(rig.words), ErrorId::none);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn | 0x0800);
  EXPECT_EQ(rig.a.drive().words().stw2, 0x0021);
  rig.power.Enable = false;
  rig.run(100);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOff | 0x0800);
  rig.reset.Restart = true;
  EXPECT_EQ(rig.answer(rig.reset), ErrorId::none);
  rig.power.Enable = true;
  rig.run(10);
  EXPECT_EQ(rig.a.drive().words().stw1, kControlOn);
}

TEST(FreeControlBits, AreOnlyThoseThatTheAxisDoesNotUse) {
  Driven rig;
  for (unsigned bit = 0; bit < 16; ++bit) {
    const WORD mask{static_cast<std::uint16_t>(1u << bit)};
    rig.words.STW2BitMask = WORD{0};
    rig.words.STW1BitMask = mask;
    const bool free1 = bit == 8 || bit == 9 || bit >= 11;
    EXPECT_EQ(rig.answer(rig.words), free1 ? ErrorId::none : ErrorId::control_bits) << bit;
    rig.words.STW1BitMask = WORD{0};
    rig.words.STW2BitMask = mask;
    EXPECT_EQ(rig.answer(rig.words), bit <= 11 ? ErrorId::none : ErrorId::control_bits) << bit;
  }
}

TEST(FreeControlBits, AreNotTakenWhileTheAxisIsBeingDisabledOrHasNoDrive) {
  Driven rig;
  rig.move.Velocity = 100.0;
  rig.move.Execute = true;
  rig.run(500);
  rig.a.data.DynamicDefaults.EmergencyDeceleration = 200.0;
  rig.power.Enable = false;
  rig.run(2);
  rig.words.Execute = true;
  rig.run(1);
  EXPECT_TRUE(rig.words.CommandAborted);
  rig.run(1000);
  rig.words.Axis = &rig.virtual_axis;
  EXPECT_EQ(rig.answer(rig.words), ErrorId::unspecified);
}

TEST(Parameters, HardwareLimitSwitchesAreSwitchedOnAndOff) {
  Driven rig;
  rig.parameter.ParameterNumber = 1000;
  rig.parameter.Value = 1.0;
  EXPECT_EQ(rig.answer(rig.parameter), ErrorId::none);
  EXPECT_TRUE(rig.a.data.PositionLimits_HW.Active);
  rig.move.Velocity = 100.0;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.a.pending_alarm() != 0; }, 2000));
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kHardwareLimitSwitch);
  rig.run(500);
  rig.parameter.Value = 0.0;
  EXPECT_EQ(rig.answer(rig.parameter), ErrorId::none);
  EXPECT_FALSE(has_bit(rig.a.data.StatusWord, StatusBit::HWLimitMaxActive));
  EXPECT_EQ(rig.answer(rig.reset), ErrorId::none);
  rig.move.Execute = false;
  rig.run(10);
  rig.move.Execute = true;
  rig.run(100);
  EXPECT_EQ(rig.a.pending_alarm(), 0) << "the switch does not count any more";
  EXPECT_GT(rig.a.data.ActualVelocity, 40.0);
}

TEST(Parameters, ThatCannotBeWrittenAreRefused) {
  Driven rig;
  rig.parameter.ParameterNumber = 999;
  EXPECT_EQ(rig.answer(rig.parameter), ErrorId::parameter_number);
  for (const DINT number : {1010, 1011, 1012}) {
    rig.parameter.ParameterNumber = number;
    EXPECT_EQ(rig.answer(rig.parameter), ErrorId::communication_times);
  }
  rig.parameter.ParameterNumber = 1000;
  rig.parameter.Value = 0.5;
  EXPECT_EQ(rig.answer(rig.parameter), ErrorId::parameter_type);
  rig.parameter.Value = 1.0;
  rig.parameter.Axis = &rig.virtual_axis;
  EXPECT_EQ(rig.answer(rig.parameter), ErrorId::limit_switches_missing);
}

TEST(Sensors, OfTheFourThereIsOneThatHasValues) {
  Driven rig;
  for (const DINT mode : {0, 1, 2}) {
    rig.sensor.Mode = mode;
    rig.sensor.Sensor = 1;
    EXPECT_EQ(rig.answer(rig.sensor), ErrorId::none);
    rig.sensor.Sensor = 2;
    EXPECT_EQ(rig.answer(rig.sensor), ErrorId::actual_values_invalid) << "configured, but not simulated";
    rig.sensor.Sensor = 3;
    EXPECT_EQ(rig.answer(rig.sensor), ErrorId::sensor);
  }
  EXPECT_EQ(rig.a.data.OperativeSensor, 1u);
  EXPECT_TRUE(rig.a.data.StatusSensor[0].Control);
  EXPECT_FALSE(rig.a.data.StatusSensor[1].Control);
  rig.sensor.Mode = 3;
  rig.sensor.Sensor = 1;
  rig.sensor.ReferenceSensor = 1;
  EXPECT_EQ(rig.answer(rig.sensor), ErrorId::reference_sensor);
  rig.sensor.Mode = 0;
  rig.sensor.ReferenceSensor = 7;
  EXPECT_EQ(rig.answer(rig.sensor), ErrorId::none) << "it counts in Mode 3 only";
}

TEST(VelocityOverride, CountsFrom0To200PercentUpToTheLimit) {
  Driven rig;
  rig.a.data.DynamicLimits.Velocity = 150.0;
  rig.move.Velocity = 100.0;
  rig.move.Execute = true;
  for (const double override : {100.0, 50.0, 0.0, 120.0, 150.0, 200.0, 10.0}) {
    rig.a.data.Override.Velocity = override;
    rig.run(2000);
    EXPECT_NEAR(rig.a.data.Velocity, std::min(override, 150.0), 1e-9);
    EXPECT_TRUE(rig.move.InVelocity);
    EXPECT_EQ(has_bit(rig.a.data.WarningWord, WarningBit::DynamicWarning),
              override >= 200.0 || override == 10.0)
        << "the limit is told, until it is acknowledged";
  }
}

}  // namespace
}  // namespace lockstep::axis_parameter_test
