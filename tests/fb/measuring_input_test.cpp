// Measuring inputs through their blocks: where edges are, more finely than a servo cycle.
#include "fb/measuring_input.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::measuring_input_test {
namespace {

using test::Rig;

/// A conveyor with print marks, and an input that sees them: from 20 on over 8, every 100.
struct Marks : Rig {
  explicit Marks(const std::function<void(AxisData&)>& conveyor = {},
                 const std::function<void(MeasuringInput&)>& set = {})
      : c(axis("Conveyor", conveyor)),
        input(static_cast<MeasuringInput&>(controller.add_object(ObjectKind::TO_MeasuringInput, "Input"))),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_c(block<MC_MoveVelocity>()),
        once(block<MC_MeasuringInput>()),
        other(block<MC_MeasuringInput>()),
        cyclic(block<MC_MeasuringInputCyclic>()),
        abort(block<MC_AbortMeasuringInput>()),
        reset(block<MC_Reset>()) {
    input.measured = &c;
    input.marks = PrintMarks{.period = 100.0, .offset = 20.0, .width = 8.0};
    if (set) set(input);
    power.Axis = home.Axis = run_c.Axis = &c;
    once.MeasuringInput = other.MeasuringInput = cyclic.MeasuringInput = abort.MeasuringInput = &input;
    reset.Axis = &input;
    power.Enable = true;
    run(5);
    home.Execute = true;
    run(3);
  }
  void go(double speed) {
    run_c.Velocity = std::abs(speed);
    run_c.Direction = speed < 0.0 ? 2 : 1;
    run_c.Execute = true;
    tick();
  }

  Axis& c;
  MeasuringInput& input;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_c;
  MC_MeasuringInput &once, &other;
  MC_MeasuringInputCyclic& cyclic;
  MC_AbortMeasuringInput& abort;
  MC_Reset& reset;
};

void ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.Modulo.Length = 360.0;
}

struct Mode {
  DINT mode;
  double first, second;  // forwards, from 0 on
  double first_back, second_back;
};

class MeasuringOnce : public ::testing::TestWithParam<Mode> {};
INSTANTIATE_TEST_SUITE_P(Modes, MeasuringOnce,
                         ::testing::Values(Mode{0, 20, 0, -72, 0}, Mode{1, 28, 0, -80, 0},
                                           Mode{2, 20, 28, -72, -80}, Mode{3, 20, 28, -72, -80},
                                           Mode{4, 28, 120, -80, -172}),
                         [](const auto& mode) { return "Mode" + std::to_string(mode.param.mode); });

/// While the axis accelerates, ticks lie anywhere beside the marks.
TEST_P(MeasuringOnce, GivesThePositionsOfTheEdgesWhicheverWayTheyPass) {
  const Mode& mode = GetParam();
  for (const double speed : {77.7, -77.7, 900.0, -900.0}) {
    Marks rig;
    rig.once.Mode = mode.mode;
    rig.once.Execute = true;
    rig.run(3);
    EXPECT_TRUE(rig.once.Busy);
    EXPECT_EQ(rig.input.data.Status, 1);
    rig.go(speed);
    ASSERT_TRUE(rig.run_until([&] { return rig.once.Done; }));
    EXPECT_EQ(rig.input.data.Status, 2);
    EXPECT_NEAR(rig.once.MeasuredValue1, speed > 0 ? mode.first : mode.first_back, 1e-9) << speed;
    EXPECT_NEAR(rig.once.MeasuredValue2, speed > 0 ? mode.second : mode.second_back, 1e-9) << speed;
    EXPECT_EQ(rig.input.data.MeasuredValues.MeasuredValue1, rig.once.MeasuredValue1);
    EXPECT_EQ(rig.input.data.MeasuredValues.LostEdgeCounter1, 0u);
  }
}

TEST(MeasuringRange, LimitsMeasuringOnALineInEitherOrder) {
  for (const auto& [start, end] : {std::pair{100.0, 150.0}, {150.0, 100.0}}) {
    Marks rig;
    rig.once.MeasuringRange = true;
    rig.once.StartPosition = start;
    rig.once.EndPosition = end;
    rig.once.Execute = true;
    rig.run(3);
    rig.go(300.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.once.Done; }));
    EXPECT_NEAR(rig.once.MeasuredValue1, 120.0, 1e-9);
  }
}

TEST(MeasuringRange, PassedWithoutAnEdgeEndsWithAlarm752) {
  for (const double speed : {300.0, -300.0}) {
    Marks rig;
    rig.once.MeasuringRange = true;
    rig.once.StartPosition = speed > 0 ? 40.0 : -40.0;
    rig.once.EndPosition = speed > 0 ? 90.0 : -20.0;
    rig.once.Execute = true;
    rig.run(3);
    rig.go(speed);
    ASSERT_TRUE(rig.run_until([&] { return rig.once.Error; }));
    EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::measuring_range));
    EXPECT_EQ(rig.input.data.ErrorDetail.Number, 752u);
    EXPECT_EQ(rig.input.data.ErrorDetail.Reaction, 0);
    EXPECT_EQ(rig.input.data.Status, 3);
    EXPECT_NEAR(rig.c.data.Position, speed > 0 ? 90.0 : -40.0, 1.0);
    rig.reset.Execute = true;
    rig.run(3);
    EXPECT_EQ(rig.input.data.ErrorDetail.Number, 0u);
    EXPECT_TRUE(rig.reset.Done);
  }
}

TEST(MeasuringRange, RunsOverTheEndOfARing) {
  Marks rig(ring, [](MeasuringInput& input) {
    input.marks = PrintMarks{.period = 360.0, .offset = 10.0, .width = 5.0};
  });
  rig.once.MeasuringRange = true;
  rig.once.StartPosition = 350.0;
  rig.once.EndPosition = 30.0;
  rig.go(500.0);
  rig.run(150);
  rig.once.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.once.Done || rig.once.Error; }));
  EXPECT_TRUE(rig.once.Done);
  EXPECT_NEAR(rig.once.MeasuredValue1, 10.0, 1e-9);
}

TEST(MeasuringRange, OfTheWholeRingHoldsEveryPosition) {
  for (const double start : {0.0, 77.0}) {
    for (const double side : {1.0, -1.0}) {
      Marks rig(ring);
      rig.once.MeasuringRange = true;
      rig.once.StartPosition = start;
      rig.once.EndPosition = start + side * rig.c.data.Modulo.Length;
      rig.once.Execute = true;
      rig.run(3);
      rig.go(200.0 * side);
      ASSERT_TRUE(rig.run_until([&] { return rig.once.Done || rig.once.Error; }));
      EXPECT_TRUE(rig.once.Done) << start << ", " << side;
    }
  }
}

TEST(MeasuringRange, LongerThanTheRingIsRefused) {
  Marks rig(ring);
  rig.once.MeasuringRange = true;
  rig.once.StartPosition = 0.0;
  rig.once.EndPosition = 400.0;
  rig.once.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::measuring_range));
}

TEST(MeasuringRange, DropsAnEdgeOfTheTimeByWhichMeasuringBeginsAhead) {
  for (const double ahead : {0.0, 100.0}) {  // [ms]; 30 u at 300 u/s
    Marks rig({}, [&](MeasuringInput& input) {
      input.data.Parameter.MeasuringRangeAdditionalActivationTime = ahead;
    });
    rig.once.MeasuringRange = true;
    rig.once.StartPosition = 125.0;
    rig.once.EndPosition = 250.0;
    rig.once.Execute = true;
    rig.run(3);
    rig.go(300.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.once.Done || rig.once.Error; }));
    if (ahead == 0.0) {
      EXPECT_NEAR(rig.once.MeasuredValue1, 220.0, 1e-9);
    } else {
      EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::outside_measuring_range));
    }
  }
}

TEST(MeasuringTime, IsCorrectedByTheCorrectionTime) {
  Marks rig({}, [](MeasuringInput& input) { input.data.Parameter.CorrectionTime = 12.3; });
  rig.go(200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_c.InVelocity; }));
  rig.run(50);
  rig.once.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.once.Done; }));
  const double mark = 20.0 + 100.0 * std::floor(rig.c.data.Position / 100.0);
  EXPECT_NEAR(rig.once.MeasuredValue1, mark - 200.0 * 0.0123, 1e-9);
}

/// An edge counts at the place that is 20 before the one at which it is seen.
TEST(MeasuringTime, BelongsToARangeInWhichTheCorrectedPlaceLies) {
  for (const double speed : {200.0, -200.0}) {
    const double side = speed > 0.0 ? 1.0 : -1.0;
    const double edge = speed > 0.0 ? 120.0 : -72.0;
    for (const bool inside : {true, false}) {
      Marks rig({}, [](MeasuringInput& input) { input.data.Parameter.CorrectionTime = 100.0; });
      rig.once.MeasuringRange = true;
      // It ends in front of the edge, or begins behind the corrected place.
      rig.once.StartPosition = edge - side * (inside ? 60.0 : 15.0);
      rig.once.EndPosition = edge - side * (inside ? 5.0 : -15.0);
      rig.go(speed);
      ASSERT_TRUE(rig.run_until([&] { return rig.c.data.Position * side > edge * side - 85.0; }));
      rig.once.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return rig.once.Done || rig.once.Error; }));
      if (inside) {
        EXPECT_TRUE(rig.once.Done) << speed;
        EXPECT_NEAR(rig.once.MeasuredValue1, edge - side * 20.0, 1e-9);
      } else {
        EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::measuring_range)) << speed;
        EXPECT_EQ(rig.input.data.ErrorDetail.Number, 752u);
        EXPECT_NEAR(rig.c.data.Position, edge + side * (15.0 + 20.0), 1.0) << "once no edge can belong to it";
      }
    }
  }
}

// ---- Cyclic measuring
// -------------------------------------------------------------------------------------------

TEST(MeasuringCyclically, CountsTheEdgesOfOneKindAndNoneIsMissing) {
  Marks rig;
  rig.cyclic.Mode = 0;
  rig.cyclic.Execute = true;
  rig.run(3);
  rig.go(777.0);
  double last = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const UDINT before = rig.cyclic.MeasuredValue1Counter;
    rig.tick();
    if (rig.cyclic.MeasuredValue1Counter == before) continue;
    ASSERT_EQ(rig.cyclic.MeasuredValue1Counter, before + 1);
    ASSERT_NEAR(rig.cyclic.MeasuredValue1, 20.0 + 100.0 * before, 1e-9);
    last = rig.cyclic.MeasuredValue1;
  }
  EXPECT_GT(last, 1000.0);
  EXPECT_EQ(rig.cyclic.MeasuredValue2Counter, 0u);
  EXPECT_EQ(rig.input.data.MeasuredValues.MeasuredValue1Counter, rig.cyclic.MeasuredValue1Counter);
  EXPECT_TRUE(rig.cyclic.Busy);
}

TEST(MeasuringCyclically, TakesTheFirstOfEachKindInMode2AndCountsWhatIsLost) {
  Marks rig({}, [](MeasuringInput& input) {
    input.marks = PrintMarks{.period = 0.25, .offset = 0.1, .width = 0.05};
  });
  rig.cyclic.Mode = 2;
  rig.go(1000.0);  // 1 u in a servo cycle: four marks
  ASSERT_TRUE(rig.run_until([&] { return rig.run_c.InVelocity; }));
  rig.cyclic.Execute = true;
  rig.run(20);
  const auto& values = rig.input.data.MeasuredValues;
  EXPECT_EQ(rig.cyclic.LostEdgeCounter1, 6u);
  EXPECT_EQ(rig.cyclic.LostEdgeCounter2, 6u);
  EXPECT_EQ(values.LostEdgeCounter1, 6u);
  EXPECT_NEAR(std::remainder(rig.cyclic.MeasuredValue1 - 0.1, 0.25), 0.0, 1e-9);
  EXPECT_NEAR(std::remainder(rig.cyclic.MeasuredValue2 - 0.15, 0.25), 0.0, 1e-9);
  rig.abort.Execute = true;
  rig.run(3);
  rig.cyclic.Execute = false;
  rig.run(2);
  rig.run_c.Execute = false;
  rig.power.StopMode = 2;
  rig.power.Enable = false;  // so that no further edge comes
  rig.run(3000);
  rig.cyclic.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.cyclic.Busy);
  EXPECT_EQ(rig.cyclic.LostEdgeCounter1, 0u);
  EXPECT_EQ(values.LostEdgeCounter1, 6u) << "those of the object go on";
}

TEST(MeasuringCyclically, LosesAtMostSevenThatItTellsOf) {
  Marks rig({}, [](MeasuringInput& input) {
    input.marks = PrintMarks{.period = 0.01, .offset = 0.0, .width = 0.005};
  });
  rig.cyclic.Execute = true;
  rig.go(1000.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.run_c.InVelocity; }));
  EXPECT_EQ(rig.cyclic.LostEdgeCounter1, 7u);
}

TEST(MeasuringCyclically, KeepsTheCountersOfTheObjectAndBeginsThoseOfTheJobAnew) {
  Marks rig;
  rig.cyclic.Execute = true;
  rig.go(500.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.cyclic.MeasuredValue1Counter == 3; }));
  rig.cyclic.Execute = false;
  rig.tick();
  rig.cyclic.Execute = true;
  rig.tick();
  EXPECT_EQ(rig.cyclic.MeasuredValue1Counter, 0u);
  ASSERT_TRUE(rig.run_until([&] { return rig.cyclic.MeasuredValue1Counter == 2; }));
  EXPECT_EQ(rig.input.data.MeasuredValues.MeasuredValue1Counter, 5u);
}

// ---- Jobs
// -------------------------------------------------------------------------------------------------------

TEST(MeasuringJobs, EndOneAnother) {
  Marks rig;
  rig.once.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.once.Busy);
  rig.cyclic.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.once.CommandAborted);
  EXPECT_TRUE(rig.cyclic.Busy);
  rig.other.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.cyclic.CommandAborted);
  EXPECT_FALSE(rig.cyclic.Busy);
  rig.abort.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.other.CommandAborted);
  EXPECT_TRUE(rig.abort.Done);
  EXPECT_EQ(rig.input.data.Status, 0);
  EXPECT_FALSE(has_bit(rig.input.data.StatusWord, 0));
}

TEST(MeasuringJobs, OutliveTheEnableOfTheAxis) {
  Marks rig;
  rig.once.Execute = true;
  rig.run(3);
  rig.power.Enable = false;
  rig.run(50);
  EXPECT_TRUE(rig.once.Busy);
}

TEST(MeasuringJobs, EndWith16_800DWhenTheAxisIsRestarted) {
  Marks rig;
  auto& restart = rig.block<MC_Reset>();
  restart.Axis = &rig.c;
  restart.Restart = true;
  rig.once.Execute = true;
  rig.power.Enable = false;
  rig.run(50);
  restart.Execute = true;
  rig.run(4);
  EXPECT_TRUE(rig.once.Error);
  EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::restarting));
}

TEST(MeasuringJobs, MeasureAtTheEdgeOfATagWhereItIsSeen) {
  bool sensor = false;
  Marks rig({}, [&](MeasuringInput& input) {
    input.marks.reset();
    input.data.Interface.Address = &sensor;
  });
  rig.once.Execute = true;
  rig.go(200.0);
  rig.run(500);
  EXPECT_FALSE(rig.input.data.InputState);
  sensor = true;
  const double before = rig.c.data.Position;  // what a servo cycle sees of a virtual axis
  rig.tick();
  EXPECT_TRUE(rig.input.data.InputState);
  EXPECT_TRUE(rig.once.Done);
  EXPECT_NEAR(rig.once.MeasuredValue1, before, 1e-9);
}

TEST(MeasuringAMovedName, GivesThePositionAsItIsCalledNowAndLeavesTheMarksWhereTheyAre) {
  Marks rig;
  rig.continuity[0].velocity = false;  // homing is a step
  rig.home.Execute = false;
  rig.tick();
  rig.home.Mode = 1;
  rig.home.Position = 1000.0;
  rig.home.Execute = true;
  rig.run(3);
  rig.once.Execute = true;
  rig.run(3);
  rig.go(300.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.once.Done; }));
  EXPECT_NEAR(rig.once.MeasuredValue1, 1020.0, 1e-9);
}

TEST(MeasuringAndHoming, AHomingEndsOnlyWhatMeasuresWhenItBegins) {
  Marks rig;
  rig.home.Execute = false;
  rig.once.Execute = true;
  rig.run(3);
  rig.go(300.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.once.Done; }));
  rig.run_c.Execute = false;
  rig.home.Mode = 9;
  rig.home.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.home.Done);
  EXPECT_TRUE(rig.once.Done) << "it measured no more";
  EXPECT_EQ(rig.input.data.Status, 2) << "its value stays";
  rig.cyclic.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.cyclic.Busy) << "the homing came before";
}

TEST(MeasuringAndHoming, AHomingThatIsRejectedEndsNothing) {
  Marks rig;
  rig.power.Enable = false;
  rig.home.Execute = false;
  rig.once.Execute = true;
  rig.run(20);
  ASSERT_TRUE(rig.once.Busy);
  rig.home.Mode = 8;
  rig.home.Execute = true;
  rig.run(3);
  ASSERT_EQ(rig.home.ErrorID, static_cast<WORD>(ErrorId::locked));
  EXPECT_TRUE(rig.once.Busy);
}

TEST(MeasuringWithAnEncoder, TellsWhereTheEncoderSawTheMark) {
  struct WithEncoder : Rig {
    WithEncoder()
        : c(axis("Conveyor", [](AxisData& data) { data.VirtualAxis.Mode = 0; })),
          e(static_cast<ExternalEncoder&>(controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"))),
          input(static_cast<MeasuringInput&>(controller.add_object(ObjectKind::TO_MeasuringInput, "Input"))),
          power(block<MC_Power>()),
          run_c(block<MC_MoveVelocity>()),
          cyclic(block<MC_MeasuringInputCyclic>()) {
      e.source_settings.follows = &c;
      e.source_settings.ratio = 2.0;
      e.source_settings.resolution = 0.01;
      e.source_settings.noise = 0.02;
      input.measured = &e;
      input.marks = PrintMarks{.period = 50.0, .offset = 10.0, .width = 5.0};
      power.Axis = run_c.Axis = &c;
      power.Enable = true;
      cyclic.MeasuringInput = &input;
      cyclic.Execute = true;
      run_c.Velocity = 200.0;
    }
    Axis& c;
    ExternalEncoder& e;
    MeasuringInput& input;
    MC_Power& power;
    MC_MoveVelocity& run_c;
    MC_MeasuringInputCyclic& cyclic;
  } line;
  line.run(10);
  line.run_c.Execute = true;
  for (int i = 0; i < 3000; ++i) {
    const UDINT before = line.cyclic.MeasuredValue1Counter;
    line.tick();
    if (line.cyclic.MeasuredValue1Counter == before) continue;
    ASSERT_EQ(line.cyclic.MeasuredValue1Counter, before + 1) << "noise makes no edges";
    ASSERT_NEAR(line.cyclic.MeasuredValue1, 10.0 + 50.0 * before, 0.02 + 0.005 + 1e-9);
  }
  EXPECT_GT(line.cyclic.MeasuredValue1Counter, 10u);
}

// ---- Measuring by the telegram of a drive or encoder
// --------------------------------------------------------------------------------------

/// An axis with a drive, and two inputs at its encoder.
struct Telegram : Rig {
  explicit Telegram(bool driven = true)
      : c(axis("Slide",
               [driven](AxisData& data) {
                 data.VirtualAxis.Mode = driven ? 0 : 1;
                 data.Sensor[0].PassiveHoming.Direction = 2;
               })),
        input(add("Input")),
        second(add("Second")),
        power(block<MC_Power>()),
        once(block<MC_MeasuringInput>()),
        at_second(block<MC_MeasuringInput>()),
        cyclic(block<MC_MeasuringInputCyclic>()),
        passive(block<MC_Home>()),
        reset(block<MC_Reset>()) {
    c.drive_settings.signals.zero_marks = ZeroMarks{1e6, 0.0};
    c.drive_settings.faults.encoder = &encoder_fails;
    power.Axis = passive.Axis = &c;
    once.MeasuringInput = cyclic.MeasuringInput = &input;
    at_second.MeasuringInput = &second;
    reset.Axis = &input;
    passive.Mode = 8;
    power.Enable = true;
    run(10);
  }
  MeasuringInput& add(const std::string& name) {
    auto& made = static_cast<MeasuringInput&>(controller.add_object(ObjectKind::TO_MeasuringInput, name));
    made.measured = &c;
    made.data.Interface.Address = &level;
    made.data.Parameter.MeasuringInputType = 1;
    return made;
  }
  /// Servo cycles from the start of a job until it is done.
  int cycles_of(DINT mode, int edges) {
    once.Mode = mode;
    once.Execute = true;
    int cycles = 0;
    for (; cycles < 40 && !once.Done; ++cycles) {
      tick();
      if (cycles >= 2 && edges > 0 && cycles % 2 == 0) {
        level = !level;
        --edges;
      }
    }
    return cycles;
  }

  bool level = false;
  bool encoder_fails = false;
  Axis& c;
  MeasuringInput& input;
  MeasuringInput& second;
  MC_Power& power;
  MC_MeasuringInput& once;
  MC_MeasuringInput& at_second;
  MC_MeasuringInputCyclic& cyclic;
  MC_Home& passive;
  MC_Reset& reset;
};

TEST(MeasuringByTelegram, TakesSevenServoCyclesForOneEdgeAndThirteenForTwo) {
  Telegram one;
  one.run(5);
  EXPECT_GE(one.cycles_of(0, 1), 7);
  EXPECT_TRUE(one.once.Done);
  Telegram two;
  two.run(5);
  EXPECT_GE(two.cycles_of(3, 2), 13);
  EXPECT_TRUE(two.once.Done);
  Telegram by_time;
  by_time.input.data.Parameter.MeasuringInputType = 0;
  by_time.run(5);
  EXPECT_LT(by_time.cycles_of(0, 1), 7) << "a time stamp is there at once";
}

TEST(MeasuringByTelegram, IsOneJobAtATimeForAnEncoder) {
  Telegram rig;
  rig.at_second.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.at_second.Busy);
  rig.once.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.input.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kProbeInUse));
  EXPECT_EQ(rig.input.data.ErrorDetail.Reaction, 8);
  EXPECT_TRUE(rig.at_second.Busy);
  rig.level = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.at_second.Done; }, 20));
  rig.reset.Execute = true;
  rig.run(3);
  rig.once.Execute = false;
  rig.level = false;
  rig.run(3);
  rig.once.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.once.Busy) << "the telegram is free again";
}

TEST(MeasuringByTelegram, EndsWhenAHomingBeginsAndDoesNotBeginWhileOneLooksForItsMark) {
  Telegram rig;
  rig.once.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.once.Busy);
  rig.passive.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.passive.Busy);
  EXPECT_TRUE(rig.once.CommandAborted);
  EXPECT_EQ(rig.input.data.Status, 0);
  EXPECT_EQ(rig.input.data.ErrorDetail.Number, 0u);
  rig.at_second.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.at_second.ErrorID, static_cast<WORD>(ErrorId::measuring_while_homing));
  EXPECT_EQ(rig.second.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kMeasuringWhileHoming));
}

/// Mode 9 begins no homing, and ends what measures all the same.
TEST(MeasuringByTelegram, EndsByTheModeThatEndsPassiveHoming) {
  Telegram rig;
  rig.once.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.once.Busy);
  rig.passive.Mode = 9;
  rig.passive.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.passive.Done);
  EXPECT_TRUE(rig.once.CommandAborted);
  rig.at_second.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.at_second.Busy) << "the words of the telegram are free";
}

TEST(MeasuringByTelegram, EndsWithAlarm702WhenThePositionIsLost) {
  Telegram rig;
  rig.once.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.once.Busy);
  rig.encoder_fails = true;
  rig.run(3);
  EXPECT_EQ(rig.input.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kPositionInvalid));
  EXPECT_EQ(rig.once.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  rig.at_second.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.at_second.ErrorID, static_cast<WORD>(ErrorId::actual_values_invalid));
}

TEST(MeasuringByTelegram, IsNeitherCyclicNorPossibleWithoutADrive) {
  Telegram rig;
  rig.cyclic.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.cyclic.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.input.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kMeasuringNotPossible));
  Telegram virtual_axis(false);
  virtual_axis.once.Execute = true;
  virtual_axis.run(3);
  EXPECT_EQ(virtual_axis.input.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kProbeConfiguration));
}

}  // namespace
}  // namespace lockstep::measuring_input_test
