// Homing of a driven axis with the marks and switches of its simulated machine.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/simulated_drive.hpp"

namespace lockstep::homing_test {
namespace {

using test::Rig;

/// A linear axis with a drive; its machine stands at 40 at the beginning. Zero marks at 3 + 10 k, the
/// reference cam from 100 to 120, limit switches at -200 and 400.
struct Machine : Rig {
  using Configure = std::function<void(Axis&)>;

  explicit Machine(const Configure& configure = {}, int ratio = 1)
      : Rig(1'000'000, ratio),
        slide(make(configure)),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        passive(block<MC_Home>()),
        run_at(block<MC_MoveVelocity>()),
        halt(block<MC_Halt>()),
        reset(block<MC_Reset>()) {
    power.Axis = home.Axis = passive.Axis = &slide;
    reset.Axis = &slide;
    run_at.Axis = halt.Axis = &slide;
    power.Enable = true;
    Rig::run(10 * ratio);
  }

  void start(MC_Home& block, INT mode, LREAL position = 0.0) {
    block.Execute = false;
    run(2 * controller.clock.interpolator_ratio);
    block.Mode = mode;
    block.Position = position;
    block.Execute = true;
    run(2 * controller.clock.interpolator_ratio);
  }

  /// Homes and lets the axis settle.
  ::testing::AssertionResult home_with(INT mode, LREAL position = 0.0, int maximum = 60000) {
    start(home, mode, position);
    highest_velocity = 0.0;
    const auto ended = run_until(
        [&] {
          highest_velocity = std::max(highest_velocity, std::abs(slide.setpoint().velocity));
          return home.Done || home.Error || home.CommandAborted;
        },
        maximum);
    if (!ended) return ended;
    if (!home.Done) return ::testing::AssertionFailure() << "alarm " << slide.pending_alarm();
    run(3000);
    return ::testing::AssertionSuccess();
  }

  /// Moves at a velocity until the machine has come as far as a place on its scale.
  void pass(double velocity, double distance) {
    run_at.Execute = false;
    run(2);
    run_at.Velocity = velocity;
    run_at.Execute = true;
    run(static_cast<int>(std::abs(distance / velocity) * 1e3));
  }
  void stop() {
    halt.Execute = false;
    run(2);
    halt.Execute = true;
    EXPECT_TRUE(run_until([&] { return halt.Done; }));
    run(2000);
  }
  void acknowledge() {
    reset.Execute = false;
    run(2);
    reset.Execute = true;
    run(3);
  }

  bool bit(StatusBit which) const { return has_bit(slide.data.StatusWord, which); }

  /// Whether the machine stands at a place on its own scale, which the axis does not know.
  bool stands_at(double place, double within = 1e-6) {
    run(2);
    const DoubleDouble machine = test::simulated_drive(slide).machine_position();
    const Modulo ring = slide.modulo();
    const PositionRange there{place - within, place + within};
    return there.contains((machine + slide.drive_settings.signals.start_position).rounded(),
                          ring.enabled ? ring.length : 0.0);
  }

  Axis& slide;
  MC_Power& power;
  MC_Home& home;
  MC_Home& passive;
  MC_MoveVelocity& run_at;
  MC_Halt& halt;
  MC_Reset& reset;
  double highest_velocity = 0.0;

 private:
  Axis& make(const Configure& configure) {
    Axis& made = Rig::axis("Slide", [](AxisData& data) {
      data.VirtualAxis.Mode = 0;
      data.Homing.ApproachVelocity = 100.0;
      data.Homing.ReferencingVelocity = 20.0;
      data.PositioningMonitoring.MinDwellTime = 0.02;
    });
    continuity[0].homing = true;
    made.drive_settings.time_constant = 0.002;
    made.drive_settings.signals = {.start_position = 40.0,
                                   .zero_marks = ZeroMarks{3.0, 10.0},
                                   .reference_cam = PositionRange{100.0, 120.0},
                                   .limit_min = -200.0,
                                   .limit_max = 400.0,
                                   .digital_inputs = {}};
    if (configure) configure(made);
    return made;
  }
};

auto& active(Axis& axis) {
  return axis.data.Sensor[0].ActiveHoming;
}
auto& passive(Axis& axis) {
  return axis.data.Sensor[0].PassiveHoming;
}

class ActiveHoming : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, ActiveHoming, ::testing::Values(1, 4));

TEST_P(ActiveHoming, FindsTheNextZeroMarkWithTheHomingVelocityAndReturnsToIt) {
  Machine machine({}, GetParam());
  ASSERT_TRUE(machine.home_with(3, 500.0));
  EXPECT_NEAR(machine.slide.data.ActualPosition, 500.0, 1e-6);
  EXPECT_EQ(machine.slide.data.Position, 500.0);
  EXPECT_TRUE(machine.stands_at(43.0));
  EXPECT_EQ(machine.home.ReferenceMarkPosition, 500.0);
  EXPECT_TRUE(machine.bit(StatusBit::HomingDone));
  EXPECT_FALSE(machine.bit(StatusBit::HomingCommand));
  EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 1);
}

TEST(ActiveHomingOnZeroMarks, TakesTheNextOneInTheNegativeDirectionToo) {
  Machine machine([](Axis& axis) { active(axis).Direction = 1; });
  ASSERT_TRUE(machine.home_with(3, -7.0));
  EXPECT_TRUE(machine.stands_at(33.0));
  EXPECT_NEAR(machine.slide.data.ActualPosition, -7.0, 1e-6);
}

TEST(ActiveHomingOnZeroMarks, SearchesSlowlyAndTravelsWithTheApproachVelocity) {
  Machine machine([](Axis& axis) { active(axis).HomePositionOffset = -100.0; });
  machine.start(machine.home, 3, 12.0);
  EXPECT_TRUE(machine.bit(StatusBit::HomingCommand));
  while (!machine.bit(StatusBit::HomingDone)) {
    machine.tick();
    ASSERT_LE(std::abs(machine.slide.setpoint().velocity), 20.0 + 1e-9);
    ASSERT_FALSE(machine.home.Done);
  }
  double fastest = 0.0;
  ASSERT_TRUE(machine.run_until([&] {
    fastest = std::max(fastest, std::abs(machine.slide.setpoint().velocity));
    return machine.home.Done;
  }));
  EXPECT_NEAR(fastest, 100.0, 1e-9);
  EXPECT_EQ(machine.home.ReferenceMarkPosition, 112.0);
  machine.run(3000);
  EXPECT_TRUE(machine.stands_at(-57.0)) << "the home position lies 100 in front of the mark";
}

TEST(ActiveHomingWithConfiguredHomePosition, IgnoresThePin) {
  Machine machine([](Axis& axis) { axis.data.Homing.HomePosition = 77.0; });
  ASSERT_TRUE(machine.home_with(5, 500.0));
  EXPECT_NEAR(machine.slide.data.ActualPosition, 77.0, 1e-6);
  EXPECT_EQ(machine.home.ReferenceMarkPosition, 77.0);
}

TEST(ActiveHomingWithCam, TakesTheZeroMarkBehindTheCamInTheHomingDirection) {
  for (const bool negative : {false, true}) {
    SCOPED_TRACE(negative);
    Machine machine([&](Axis& axis) {
      active(axis).Mode = 1;
      active(axis).Direction = negative ? 1 : 0;
    });
    ASSERT_TRUE(machine.home_with(3, 0.0));
    EXPECT_NEAR(machine.highest_velocity, 100.0, 1e-9);
    EXPECT_TRUE(machine.stands_at(negative ? 93.0 : 123.0));
  }
}

/// From in front of the switch, from behind it and standing on it; the edge is found within what the axis
/// moves in a servo cycle.
TEST(ActiveHomingWithSwitch, FindsTheConfiguredEdgeFromEverywhere) {
  for (const double from : {40.0, 300.0, 110.0})
    for (const bool negative : {false, true})
      for (const bool positive_side : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << "from " << from << (negative ? ", negative" : ", positive") << " direction, "
                     << (positive_side ? "positive" : "negative") << " side");
        Machine machine([&](Axis& axis) {
          active(axis).Mode = 2;
          active(axis).Direction = negative ? 1 : 0;
          active(axis).SideInput = positive_side;
          axis.data.Homing.ApproachDirection = from > 200.0;
          axis.drive_settings.signals.start_position = from;
        });
        ASSERT_TRUE(machine.home_with(3, 10.0));
        EXPECT_TRUE(machine.stands_at(positive_side ? 120.0 : 100.0, 0.11));
        EXPECT_NEAR(machine.slide.data.ActualPosition, 10.0, 1e-6);
      }
}

TEST(ActiveHomingWithSwitch, KeepsToTheSettingsOfItsBegin) {
  Machine machine([&](Axis& axis) {
    active(axis).Mode = 2;
    active(axis).SideInput = true;
  });
  machine.start(machine.home, 3, 10.0);
  machine.run(100);
  ASSERT_TRUE(machine.home.Busy);
  active(machine.slide).SideInput = false;
  active(machine.slide).Direction = 1;
  machine.slide.data.Homing.ApproachVelocity = 1.0;
  machine.slide.data.Homing.ReferencingVelocity = 0.0;
  ASSERT_TRUE(machine.run_until([&] { return !machine.home.Busy; }));
  EXPECT_TRUE(machine.home.Done);
  machine.run(3000);
  EXPECT_TRUE(machine.stands_at(120.0, 0.11));
}

TEST(ActiveHomingWithSwitch, ReadsATagWithItsLevelBeforeTheCamOfTheDrive) {
  bool input = true;  // low active
  Machine machine([&](Axis& axis) {
    active(axis).Mode = 2;
    active(axis).SideInput = true;
    active(axis).DigitalInputAddress = &input;
  });
  machine.start(machine.home, 3, 0.0);
  machine.run(1000);  // beyond 120
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
  input = false;
  machine.run(200);
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
  input = true;
  machine.run(2);
  EXPECT_TRUE(machine.bit(StatusBit::HomingDone)) << "left on its positive side";
}

TEST(ActiveHomingWithAutoReversal, TurnsAtTheLimitSwitchAndFindsTheCam) {
  Machine machine([](Axis& axis) {
    active(axis).Mode = 1;
    axis.data.Homing.ApproachDirection = true;  // away from the cam
    axis.data.Homing.AutoReversal = true;
    axis.data.PositionLimits_HW.Active = true;
  });
  ASSERT_TRUE(machine.home_with(3, 0.0));
  EXPECT_TRUE(machine.stands_at(123.0));
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMinActive));
}

TEST(ActiveHomingWithAutoReversal, GoesBackBeyondAZeroMarkToMeetItInTheHomingDirection) {
  Machine machine([](Axis& axis) {
    axis.drive_settings.signals.zero_marks = ZeroMarks{20.0, 0.0};  // behind the axis
    axis.data.Homing.AutoReversal = true;
    axis.data.PositionLimits_HW.Active = true;
  });
  ASSERT_TRUE(machine.home_with(3, 0.0));
  EXPECT_TRUE(machine.stands_at(20.0));
}

/// Whatever the limit switches would do to other motions.
TEST(ActiveHomingWithAutoReversal, EndsInAlarm342BetweenBothLimitSwitches) {
  for (const DINT behavior : {0, 1}) {
    Machine machine([&](Axis& axis) {
      active(axis).Mode = 2;
      axis.drive_settings.signals.reference_cam = PositionRange{900.0, 910.0};
      axis.data.Homing.AutoReversal = true;
      axis.data.PositionLimits_HW.Active = true;
      axis.data.PositionLimits_HW.ApproachBehavior = behavior;
      axis.data.DynamicDefaults.EmergencyDeceleration = 1000.0;
    });
    EXPECT_FALSE(machine.home_with(3));
    EXPECT_EQ(machine.home.ErrorID, WORD{0x8001});
    EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
    ASSERT_TRUE(machine.run_until([&] { return machine.slide.setpoint().standing(); }));
    machine.run(100);
    EXPECT_EQ(machine.slide.pending_alarm(), 342) << "the cause, not that the axis still brakes";
    EXPECT_FALSE(has_bit(machine.slide.data.ErrorWord, ErrorBit::HWLimit));
    EXPECT_TRUE(machine.power.Status);
    machine.acknowledge();
    machine.pass(-10.0, 1.0);  // further out
    EXPECT_EQ(machine.slide.pending_alarm(), 531);
  }
}

TEST(ActiveHomingWithoutAutoReversal, EndsAtTheLimitSwitchWithItsAlarm) {
  Machine machine([](Axis& axis) {
    active(axis).Mode = 1;
    axis.data.Homing.ApproachDirection = true;
    axis.data.PositionLimits_HW.Active = true;
  });
  machine.continuity[0].velocity = false;  // without enable the setpoint follows the coasting drive
  EXPECT_FALSE(machine.home_with(3));
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
}

/// Of the same tick are all positions of the data block, also those that MC_Servo has shown before.
TEST(Homing, RenamesWhateverTheDataBlockShowsAtOnce) {
  for (const bool ring : {false, true}) {
    for (const INT mode : std::initializer_list<INT>{0, 1, 3, 11, 12}) {
      Machine machine([&](Axis& axis) {
        axis.data.Modulo.Enable = ring;
        axis.data.SetpointFilter.DynamicFilter.Mode = 1;
        axis.data.SetpointFilter.DynamicFilter.T1 = 0.01;
        axis.data.Sensor[1].Existent = true;
        axis.drive_settings.sensors[0].exists = true;
      });
      const AxisData& data = machine.slide.data;
      if (mode != 3) machine.pass(30.0, 10.0);
      machine.home.Mode = mode;
      machine.home.Position = 200.0;
      machine.home.Execute = true;
      double last = data.ActualPosition;
      int steps = 0;
      for (int i = 0; i < 5000 && steps == 0; ++i) {
        machine.tick();
        if (std::abs(data.ActualPosition - last) > 1.0) ++steps;
        last = data.ActualPosition;
        ASSERT_EQ(data.StatusSensor[0].Position, last) << int(mode);
        ASSERT_EQ(data.StatusSensor[0].ModuloCycle, data.ActualModuloCycle);
        ASSERT_NEAR(data.StatusSensor[1].Position, last, 1e-9) << int(mode);
        ASSERT_NEAR(data.StatusServo.BalancedPosition, last + data.StatusServo.ControlDifference, 1e-9);
        ASSERT_NEAR(data.StatusServo.PositionAfterDynamicFilter, data.Position, 1.0) << int(mode);
      }
      EXPECT_EQ(steps, 1) << int(mode);
    }
  }
}

TEST(ActiveHomingPreconditions, AreToldByTheirAlarms) {
  const auto alarm_with = [](const Machine::Configure& configure) {
    Machine machine(configure);
    machine.start(machine.home, 3);
    EXPECT_EQ(machine.home.ErrorID, WORD{0x8001});
    EXPECT_FALSE(machine.home.Busy);
    return machine.slide.pending_alarm();
  };
  EXPECT_EQ(alarm_with([](Axis& axis) { axis.data.Homing.ApproachVelocity = 0.0; }), 341);
  EXPECT_EQ(alarm_with([](Axis& axis) { axis.data.Homing.ReferencingVelocity = 0.0; }), 341);
  EXPECT_EQ(alarm_with([](Axis& axis) { axis.drive_settings.signals.zero_marks.reset(); }), 343);
  EXPECT_EQ(alarm_with([](Axis& axis) {
              active(axis).Mode = 2;
              axis.drive_settings.signals.reference_cam.reset();
            }),
            343);
}

TEST(ActiveHomingPreconditions, AskForAnEnabledAxis) {
  Machine machine;
  machine.power.Enable = false;
  machine.run(200);
  for (const INT mode : std::initializer_list<INT>{2, 3, 5, 8, 10}) {
    machine.start(machine.home, mode);
    EXPECT_EQ(machine.home.ErrorID, WORD{0x800F}) << int(mode);
  }
}

TEST(ActiveHomingOverride, CountsAtOnceAndStandsStillAtZero) {
  Machine machine([](Axis& axis) { active(axis).Mode = 1; });
  machine.start(machine.home, 3);
  machine.run(300);
  machine.slide.data.Override.Velocity = 0.0;
  machine.run(400);
  EXPECT_TRUE(machine.slide.setpoint().standing());
  EXPECT_TRUE(machine.home.Busy);
  machine.slide.data.Override.Velocity = 50.0;
  machine.run(300);
  EXPECT_NEAR(machine.slide.setpoint().velocity, 50.0, 1e-9);
  ASSERT_TRUE(machine.run_until([&] { return machine.home.Done; }));
  machine.run(3000);
  EXPECT_TRUE(machine.stands_at(123.0));
}

TEST(ActiveHomingOfAMovingAxis, TakesOverWithoutAStepAndEndsTheMotion) {
  Machine machine;
  machine.pass(80.0, 100.0);
  ASSERT_TRUE(machine.home_with(3, 0.0));
  EXPECT_TRUE(machine.run_at.CommandAborted);
  EXPECT_NEAR(machine.slide.data.ActualPosition, 0.0, 1e-6);
}

TEST(ActiveHomingOfAVirtualAxis, TakesItsPlaceForTheMark) {
  Machine machine([](Axis& axis) {
    axis.data.VirtualAxis.Mode = 1;
    axis.data.Homing.HomePosition = 30.0;
    active(axis).HomePositionOffset = 5.0;
  });
  ASSERT_TRUE(machine.home_with(5));
  EXPECT_EQ(machine.slide.data.Position, 30.0);
  EXPECT_EQ(machine.home.ReferenceMarkPosition, 25.0);
  machine.continuity[0].velocity = false;
  machine.start(machine.passive, 8, 9.0);
  EXPECT_TRUE(machine.passive.Done);
  EXPECT_EQ(machine.slide.data.Position, 9.0);
}

// ---- Passive homing

TEST(PassiveHoming, GivesTheMarkItsPositionInPassingWithoutAnyStepOfVelocity) {
  Machine machine;
  machine.pass(80.0, 10.0);
  machine.start(machine.passive, 8, 1000.0);
  EXPECT_TRUE(machine.bit(StatusBit::HomingCommand));
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
  ASSERT_TRUE(machine.run_until([&] { return machine.passive.Done; }, 2000));
  EXPECT_EQ(machine.passive.ReferenceMarkPosition, 1000.0);
  EXPECT_TRUE(machine.run_at.InVelocity);
  EXPECT_FALSE(machine.bit(StatusBit::HomingCommand));
  machine.stop();
  // The marks lie at 3 + 10 k: the position of one of them is now 1000.
  const double place = 1000.0 + std::floor((machine.slide.data.ActualPosition - 1000.0) / 10.0) * 10.0;
  machine.slide.data.Override.Velocity = 100.0;
  auto& to = machine.block<MC_MoveAbsolute>();
  to.Axis = &machine.slide;
  to.Position = place;
  to.Execute = true;
  ASSERT_TRUE(machine.run_until([&] { return to.Done; }));
  machine.run(3000);
  bool on_a_mark = false;
  for (int k = 0; k < 30; ++k) on_a_mark |= machine.stands_at(3.0 + 10.0 * k);
  EXPECT_TRUE(on_a_mark);
}

TEST(PassiveHoming, KeepsHomingDoneWithModeTwoOnly) {
  for (const INT mode : std::initializer_list<INT>{2, 8, 10}) {
    Machine machine;
    ASSERT_TRUE(machine.home_with(3));
    machine.continuity[0].velocity = mode != 2;  // with mode 2 no rising HomingDone tells of the shift
    machine.start(machine.passive, mode, 5.0);
    EXPECT_EQ(machine.bit(StatusBit::HomingDone), mode == 2) << int(mode);
    machine.slide.data.Homing.HomePosition = 5.0;
    machine.pass(50.0, 30.0);
    EXPECT_TRUE(machine.passive.Done);
    EXPECT_TRUE(machine.bit(StatusBit::HomingDone));
  }
}

TEST(PassiveHoming, TakesHomePositionFromTheConfigurationWithModeTen) {
  Machine machine([](Axis& axis) { axis.data.Homing.HomePosition = 700.0; });
  machine.start(machine.passive, 10, 5.0);
  machine.pass(50.0, 10.0);
  EXPECT_TRUE(machine.passive.Done);
  EXPECT_EQ(machine.passive.ReferenceMarkPosition, 700.0);
  EXPECT_NEAR(machine.slide.data.ActualPosition, 705.0, 5.0);
}

TEST(PassiveHoming, CountsInItsDirectionOnly) {
  Machine machine([](Axis& axis) { passive(axis).Direction = 1; });
  machine.start(machine.passive, 8);
  machine.pass(80.0, 50.0);
  EXPECT_TRUE(machine.passive.Busy);
  machine.pass(-80.0, 50.0);
  EXPECT_TRUE(machine.passive.Done);
}

TEST(PassiveHoming, AsksForTheCamAgainWhenTheAxisTurnsBehindIt) {
  Machine machine([](Axis& axis) {
    passive(axis).Mode = 1;
    axis.drive_settings.signals.zero_marks = ZeroMarks{150.0, 0.0};
  });
  machine.start(machine.passive, 8);
  machine.pass(100.0, 95.0);  // 135: the cam is left, the mark not yet met
  machine.pass(-50.0, 8.0);
  machine.pass(100.0, 60.0);
  EXPECT_TRUE(machine.passive.Busy) << "turned back in between";
  machine.pass(-100.0, 100.0);
  machine.pass(100.0, 120.0);
  EXPECT_TRUE(machine.passive.Done);
}

TEST(PassiveHoming, FindsTheEdgeOfTheConfiguredSide) {
  for (const bool positive_side : {false, true}) {
    Machine machine([&](Axis& axis) {
      passive(axis).Mode = 2;
      passive(axis).SideInput = positive_side;
    });
    machine.start(machine.passive, 8, positive_side ? 120.0 : 100.0);
    machine.pass(100.0, 100.0);
    EXPECT_TRUE(machine.passive.Done);
    machine.stop();
    // The position is that of the machine, but for what the axis moved between two servo cycles.
    EXPECT_TRUE(machine.stands_at(machine.slide.data.ActualPosition, 0.11));
  }
}

TEST(PassiveHoming, OfAMarkBehindWhichNoPositionIsLeftEndsWithAlarm323) {
  Machine machine;
  machine.continuity[0].velocity = false;   // without enable the setpoint follows the coasting drive
  machine.start(machine.passive, 8, 1e12);  // where the mark is; the axis is beyond it when it is known
  EXPECT_TRUE(machine.passive.Busy);
  machine.run_at.Velocity = 100.0;
  machine.run_at.Execute = true;
  ASSERT_TRUE(machine.run_until([&] { return !machine.passive.Busy; }, 2000));
  EXPECT_EQ(machine.slide.pending_alarm(), alarm::kHomingNotPossible);
  EXPECT_EQ(machine.passive.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
}

TEST(PassiveHoming, IsEndedByModeNineAndReplacedByAnother) {
  Machine machine;
  machine.start(machine.passive, 8);
  machine.start(machine.home, 8);
  EXPECT_TRUE(machine.passive.CommandAborted);
  EXPECT_TRUE(machine.home.Busy);
  machine.start(machine.passive, 9);
  EXPECT_TRUE(machine.passive.Done);
  EXPECT_TRUE(machine.home.CommandAborted);
  EXPECT_FALSE(machine.bit(StatusBit::HomingCommand));
  machine.pass(50.0, 30.0);
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
}

TEST(PassiveHoming, IsRefusedWhileActiveHomingRuns) {
  Machine machine;
  machine.start(machine.home, 3);
  machine.start(machine.passive, 8);
  EXPECT_EQ(machine.passive.ErrorID, WORD{0x800F});
  EXPECT_TRUE(machine.home.Busy);
}

TEST(PassiveHoming, EndsWithTheEnable) {
  Machine machine;
  machine.start(machine.passive, 8);
  machine.power.Enable = false;
  machine.run(5);
  EXPECT_TRUE(machine.passive.CommandAborted);
}

// ---- Setpoint, encoder adjustment

TEST(HomingOfTheSetpoint, KeepsTheFollowingErrorOfAMovingAxis) {
  for (const INT mode : std::initializer_list<INT>{11, 12}) {
    Machine machine([](Axis& axis) { axis.data.PositionControl.Kpc = 0.0; });  // a lasting following error
    machine.pass(50.0, 100.0);
    const double error = machine.slide.data.StatusPositioning.FollowingError;
    ASSERT_GT(error, 1.0);
    const double before = machine.slide.data.Position;
    machine.start(machine.home, mode, 1000.0);
    EXPECT_TRUE(machine.home.Done);
    EXPECT_NEAR(machine.slide.data.StatusPositioning.FollowingError, error, 1e-6);
    EXPECT_NEAR(machine.slide.data.Position, mode == 11 ? 1000.05 : before + 1000.2, 0.06);
    EXPECT_TRUE(machine.bit(StatusBit::HomingDone));
    EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 0);
  }
}

TEST(EncoderAdjustment, FitsTheTypeOfTheEncoder) {
  for (const DINT type : {0, 1, 2}) {
    Machine machine([&](Axis& axis) { axis.data.Sensor[0].Type = type; });
    const auto error = [&](INT mode, DINT sensor) {
      machine.home.Sensor = sensor;
      machine.start(machine.home, mode, 5.0);
      return static_cast<int>(machine.home.ErrorID);
    };
    machine.continuity[0].velocity = false;
    EXPECT_EQ(error(6, 0), type == 0 ? 0x8010 : 0);
    EXPECT_EQ(error(7, 1), type == 0 ? 0x8010 : 0);
    EXPECT_EQ(error(13, 0), type == 0 ? 0 : 0x8011);
    EXPECT_EQ(error(7, 2), 0x8050) << "there is no such encoder";
    EXPECT_EQ(error(7, 5), 0x8050);
    EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 1);
  }
}

TEST(EncoderAdjustment, OfAnEncoderWithoutValuesIsRefused) {
  Machine machine([](Axis& axis) { axis.data.Sensor[1].Existent = true; });
  machine.home.Sensor = 2;
  machine.start(machine.home, 13);
  EXPECT_EQ(machine.home.ErrorID, WORD{0x8016});
}

struct Absolute : Machine {
  explicit Absolute(EncoderAdjustment kept = {})
      : Machine([&](Axis& axis) {
          axis.data.Sensor[0].Type = 1;
          axis.encoder_adjustments[0] = kept;
        }) {}
  void restart() {
    power.Enable = false;
    run(300);
    reset.Restart = true;
    acknowledge();
    EXPECT_TRUE(reset.Done);
    power.Enable = true;
    run(20);
  }
};

TEST(AbsoluteEncoder, ShowsItsValueUntilItIsAdjusted) {
  Absolute machine;
  EXPECT_EQ(machine.slide.data.ActualPosition, 40.0);
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
  EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 0);
}

TEST(AbsoluteEncoder, KeepsItsAdjustmentOverARestartOfTheObject) {
  Absolute machine;
  machine.start(machine.home, 7, 1000.0);
  EXPECT_TRUE(machine.home.Done);
  EXPECT_EQ(machine.slide.data.StatusSensor[0].AbsEncoderOffset, 960.0);
  machine.pass(50.0, 20.0);
  machine.stop();
  machine.continuity[0].velocity = false;
  machine.start(machine.home, 1, 5.0);  // a shift that is not kept
  const double shifted = machine.slide.data.ActualPosition;
  machine.restart();
  EXPECT_NEAR(machine.slide.data.ActualPosition, shifted - 5.0, 1e-9);
  EXPECT_TRUE(machine.bit(StatusBit::HomingDone));
  EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 1);
  EXPECT_EQ(machine.slide.data.StatusSensor[0].AbsEncoderOffset, 960.0);
}

TEST(AbsoluteEncoder, BeginsWithAnAdjustmentThatWasKept) {
  Absolute machine({true, 960.0});
  EXPECT_EQ(machine.slide.data.ActualPosition, 1000.0);
  EXPECT_TRUE(machine.bit(StatusBit::HomingDone));
  machine.continuity[0].velocity = false;
  machine.start(machine.home, 6, -1.0);
  EXPECT_EQ(machine.slide.encoder_adjustments[0].offset, 959.0);
}

TEST(AbsoluteEncoder, KeepsAStoredOffsetWhenItIsHomedWithAMark) {
  Absolute fresh;
  ASSERT_TRUE(fresh.home_with(3, 0.0));
  EXPECT_NEAR(fresh.slide.encoder_adjustments[0].offset, -43.0, 1e-9) << "none was stored";
  Absolute adjusted({true, 960.0});
  ASSERT_TRUE(adjusted.home_with(3, 0.0));
  EXPECT_EQ(adjusted.slide.encoder_adjustments[0].offset, 960.0);
  EXPECT_NEAR(adjusted.slide.data.ActualPosition, 0.0, 1e-6);
}

TEST(AbsoluteEncoder, DropsAnOffsetThatIsNoNumber) {
  Absolute machine({true, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(machine.slide.data.ActualPosition, 40.0);
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
}

TEST(IncrementalEncoder, LosesItsHomingWithARestart) {
  Machine machine;
  ASSERT_TRUE(machine.home_with(3));
  machine.power.Enable = false;
  machine.run(300);
  machine.reset.Restart = true;
  machine.acknowledge();
  EXPECT_FALSE(machine.bit(StatusBit::HomingDone));
  EXPECT_EQ(machine.slide.data.StatusSensor[0].Adjusted, 0);
}

// ---- Turns of a modulo axis

TEST(TurnsOfAModuloAxis, AreCountedAnewFromTheHomePosition) {
  for (const double position : {100.0, 180.0, 270.0}) {
    Machine machine([](Axis& axis) {
      axis.data.Modulo.Enable = true;
      axis.data.Properties.MotionType = 1;
    });
    machine.pass(400.0, 2000.0);
    machine.stop();
    ASSERT_GT(machine.slide.data.ModuloCycle, 3);
    ASSERT_TRUE(machine.home_with(3, position));
    EXPECT_EQ(machine.slide.data.ModuloCycle, position <= 180.0 ? 0 : -1) << position;
    EXPECT_EQ(machine.slide.data.ActualModuloCycle, machine.slide.data.ModuloCycle);
    EXPECT_EQ(machine.slide.data.Position, position);
  }
}

TEST(TurnsOfAModuloAxis, OfALeadingAxisStayWhatTheyAreForItsFollowers) {
  Machine machine([](Axis& axis) {
    axis.data.Modulo.Enable = true;
    axis.data.Properties.MotionType = 1;
  });
  machine.pass(400.0, 2000.0);
  const std::int64_t turns = machine.slide.setpoint().position.turns;
  ASSERT_GT(turns, 3);
  machine.start(machine.passive, 8, 100.0);
  ASSERT_TRUE(machine.run_until([&] { return machine.passive.Done; }));
  EXPECT_NEAR(static_cast<double>(machine.slide.setpoint().position.turns - turns), 0.0, 1.0);
  EXPECT_NEAR(machine.slide.data.ModuloCycle, 0, 1);
}

TEST(ActiveHomingOfAModuloAxis, FindsACamThatComesByOnEveryTurn) {
  Machine machine([](Axis& axis) {
    axis.data.Modulo.Enable = true;
    axis.data.Properties.MotionType = 1;
    active(axis).Mode = 2;
    active(axis).SideInput = true;
    axis.drive_settings.signals.start_position = 1130.0;  // the cam has gone by three times
  });
  ASSERT_TRUE(machine.home_with(3, 0.0));
  EXPECT_TRUE(machine.stands_at(120.0, 0.11));
}

// ---- Hardware limit switches

struct Limited : Machine {
  explicit Limited(const Configure& configure = {})
      : Machine([&](Axis& axis) {
          axis.data.PositionLimits_HW.Active = true;
          axis.data.PositionLimits_HW.ApproachBehavior = 1;
          axis.data.DynamicDefaults.EmergencyDeceleration = 4000.0;
          if (configure) configure(axis);
        }) {}

  /// Runs into the positive switch and stops.
  void run_into(double velocity = 200.0) {
    run_at.Execute = false;
    run(2);
    run_at.Velocity = velocity;
    run_at.Execute = true;
    ASSERT_TRUE(run_until([&] { return slide.pending_alarm() != 0; }));
    ASSERT_TRUE(run_until([&] { return std::abs(slide.data.ActualVelocity) < 1e-3; }));
    run(10);
  }
};

TEST(HardwareLimitSwitch, StopsTheAxisWithTheEmergencyRampAndKeepsItsEnable) {
  Limited machine;
  machine.run_into();
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
  EXPECT_EQ(machine.slide.data.ErrorDetail.Reaction, 3);
  EXPECT_TRUE(has_bit(machine.slide.data.ErrorWord, ErrorBit::HWLimit));
  EXPECT_TRUE(machine.bit(StatusBit::HWLimitMaxActive));
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMinActive));
  EXPECT_EQ(machine.run_at.ErrorID, WORD{0x8001});
  EXPECT_TRUE(machine.power.Status);
  // 200²/(2·4000) = 5, and what the drive is late.
  EXPECT_TRUE(machine.stands_at(405.3, 0.7));
}

TEST(HardwareLimitSwitch, RemovesTheEnableByDefaultAndWhereItCanBeOverrun) {
  for (const DINT mode : {0, 1}) {
    Limited machine([&](Axis& axis) {
      axis.data.PositionLimits_HW.Mode = mode;
      axis.data.PositionLimits_HW.ApproachBehavior = mode;  // 1 counts only where it cannot be overrun
    });
    machine.continuity[0].velocity = false;  // switched off, the setpoint follows the drive
    machine.run_into();
    EXPECT_EQ(machine.slide.data.ErrorDetail.Reaction, 4);
    EXPECT_FALSE(machine.power.Status);
  }
}

TEST(HardwareLimitSwitch, IsLeftOnlyInThePermittedDirection) {
  Limited machine;
  machine.run_into();
  machine.acknowledge();
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_TRUE(machine.bit(StatusBit::HWLimitMaxActive));
  const double here = machine.slide.data.Position;
  machine.pass(50.0, 5.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
  EXPECT_EQ(machine.slide.data.ErrorDetail.Reaction, 3);
  EXPECT_EQ(machine.slide.data.Position, here) << "not a step outwards";
  machine.acknowledge();
  machine.pass(-50.0, 20.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMaxActive));
  EXPECT_TRUE(machine.run_at.InVelocity);
  machine.run_into();
  EXPECT_EQ(machine.slide.pending_alarm(), 531) << "and is met anew";
}

TEST(HardwareLimitSwitch, AcknowledgedInMotionStopsAllTheSame) {
  Limited machine([](Axis& axis) { axis.data.DynamicDefaults.EmergencyDeceleration = 500.0; });
  machine.pass(200.0, 1.0);
  ASSERT_TRUE(machine.run_until([&] { return machine.slide.pending_alarm() == 531; }));
  machine.acknowledge();
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
  ASSERT_TRUE(machine.run_until([&] { return machine.slide.setpoint().standing(); }));
}

TEST(HardwareLimitSwitch, OverrunIsLeftOnlyBackOverIt) {
  bool pressed = false;
  Limited machine([&](Axis& axis) {
    auto& limits = axis.data.PositionLimits_HW;
    limits.Mode = 1;
    limits.MaxSwitchAddress = &pressed;
    limits.MaxSwitchLevel = true;
    axis.drive_settings.time_constant = 0.05;  // it coasts far
    axis.data.FollowingError.EnableMonitoring = false;
    axis.drive_settings.signals.digital_inputs.push_back({&pressed, {100.0, 102.0}});
  });
  machine.continuity[0].velocity = false;
  machine.run_into();
  EXPECT_FALSE(pressed) << "the switch has been overrun";
  EXPECT_TRUE(machine.bit(StatusBit::HWLimitMaxActive));
  machine.acknowledge();
  machine.run(20);
  EXPECT_TRUE(machine.power.Status);
  machine.pass(20.0, 0.1);
  EXPECT_EQ(machine.slide.pending_alarm(), 531) << "no way further out";
  machine.run(500);
  machine.acknowledge();
  machine.run(20);
  machine.pass(-20.0, 30.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMaxActive)) << "passed again, inwards";
}

TEST(HardwareLimitSwitch, ReadsATagWithItsLevel) {
  bool released = true;  // low active: TRUE while it is not pressed
  Limited machine([&](Axis& axis) { axis.data.PositionLimits_HW.MinSwitchAddress = &released; });
  machine.pass(-50.0, 10.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  released = false;
  machine.run(2);
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
  EXPECT_TRUE(machine.bit(StatusBit::HWLimitMinActive));
}

TEST(HardwareLimitSwitch, OfTheOtherSideMetInMotionLocksTheAxisUntilARestart) {
  bool pressed = false;
  Limited machine([&](Axis& axis) {
    axis.data.PositionLimits_HW.MinSwitchAddress = &pressed;
    axis.data.PositionLimits_HW.MinSwitchLevel = true;
  });
  machine.continuity[0].velocity = false;
  machine.pass(100.0, 20.0);
  pressed = true;  // the negative one, while moving in the positive direction
  machine.run(300);
  EXPECT_EQ(machine.slide.data.ErrorDetail.Reaction, 4);
  for (const double velocity : {50.0, -50.0}) {
    machine.acknowledge();
    machine.run(20);
    machine.pass(velocity, 1.0);
    EXPECT_EQ(machine.slide.pending_alarm(), 531) << velocity;
    machine.run(100);
  }
  machine.power.Enable = false;
  machine.run(100);
  machine.reset.Restart = true;
  machine.acknowledge();
  machine.power.Enable = true;
  machine.run(20);
  machine.pass(50.0, 5.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
}

TEST(HardwareLimitSwitch, BothPressedForbidEveryMotion) {
  bool both = false;
  Limited machine([&](Axis& axis) {
    auto& limits = axis.data.PositionLimits_HW;
    limits.MinSwitchAddress = limits.MaxSwitchAddress = &both;
    limits.MinSwitchLevel = limits.MaxSwitchLevel = true;
  });
  machine.continuity[0].velocity = false;
  both = true;
  machine.run(5);
  EXPECT_EQ(machine.slide.pending_alarm(), 531);
  for (const double velocity : {50.0, -50.0}) {
    machine.acknowledge();
    machine.run(20);
    machine.pass(velocity, 1.0);
    EXPECT_EQ(machine.slide.pending_alarm(), 531) << velocity;
    EXPECT_EQ(machine.slide.data.ErrorDetail.Reaction, 4);
  }
}

TEST(HardwareLimitSwitch, PressedFromTheBeginningOnlyForbidsTheWayOut) {
  Limited machine([](Axis& axis) { axis.drive_settings.signals.start_position = 401.0; });
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_TRUE(machine.bit(StatusBit::HWLimitMaxActive));
  machine.pass(-50.0, 10.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMaxActive));
}

TEST(HardwareLimitSwitch, WithoutMonitoringIsNothing) {
  Limited machine([](Axis& axis) { axis.data.PositionLimits_HW.Active = false; });
  machine.pass(200.0, 400.0);
  EXPECT_EQ(machine.slide.pending_alarm(), 0);
  EXPECT_FALSE(machine.bit(StatusBit::HWLimitMaxActive));
}

}  // namespace
}  // namespace lockstep::homing_test
