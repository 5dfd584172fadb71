// What the sources say of each feature, as an observation of its own: where no scenario holds it already.
#include <algorithm>
#include <cmath>
#include <random>

#include "tech_objects/drive/count_controller.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"
#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::mco305_feature_test {
namespace {

/// 100 qc/ms at VEL 100, 0.2 qc/ms² at ACC 100.
struct Bench : DeviceRun {
  explicit Bench(bool drive = false) {
    for (const auto& [name, value] : {std::pair{"ENCODER", 500.0},
                                      {"MENCODER", 500.0},
                                      {"VELMAX", 3000.0},
                                      {"RAMPMIN", 0.5},
                                      {"SYNCTYPE", 1.0}})
      set(name, value);
    if (!drive) return;
    object.settings.has_drive = true;
    object.settings.drive.time_constant = 0.003;
    set("FFVEL", 10'486);
    set("KPROP", 300);
    set("KDER", 0);
  }
  void begin_with(const std::string& text, const std::string& subprograms = "") {
    add_program("VEL 100\nACC 100\nDEC 100\n" + text + "wait:\nGOTO wait\nSUBMAINPROG\n" + subprograms +
                "ENDPROG\n");
    begin();
  }
  mco305::Device& device() { return object.device(); }
  std::int32_t position() { return device().actual_units(); }
};

// 1
TEST(Mco305Features, APositionThatWrapsStepsNothing) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.begin_with("SETMORIGIN 1073541823\nDEF ORIGIN\nDELAY 10\nSYNCP\n");
  run.run(20);
  std::int32_t largest = 0;
  for (int i = 0; i < 3000; ++i) {
    turned += 80;
    run.step();
    if (i > 2000) largest = std::max(largest, std::abs(run.device().sync_error()));
  }
  EXPECT_LT(run.device().master().shown(), 0) << "beyond 2^30 it begins again";
  EXPECT_LE(largest, 2);
  EXPECT_EQ(run.system_variable(4218) & (2 << 8 | 4 << 8), 4 << 8) << "that of the master has overflowed";
}

TEST(Mco305Features, APositionBeyond2To30HasAFlag) {
  Bench run;
  run.set("VELMAX", 100'000);
  run.begin_with("CVEL 100\nCSTART\n");
  bool flag = false;
  for (int i = 0; i < 400'000 && !flag; ++i) {
    run.step();
    const bool before = run.device().actual_position() < (1 << 30);
    flag = (run.system_variable(4218) & 2 << 8) != 0;
    ASSERT_EQ(flag, !before) << i;
  }
  EXPECT_TRUE(flag);
  EXPECT_LT(run.device().actual_units(), 0);
  EXPECT_EQ(run.system_variable(4218) & 4 << 8, 0);
}

// 4
TEST(Mco305Features, AnIntegralPartRemovesWhatALoadLeaves) {
  const auto error = [](double integral) {
    CountControllerSettings settings;
    settings.proportional = 100;
    settings.integral = integral;
    settings.integral_limit = 1e9;
    settings.bandwidth = 1000;
    CountController controller;
    controller.set(settings);
    double actual = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const double u = controller.step(0.0, actual, 0.0, 0.0, 1.0);
      actual += u / CountController::kFullScale * 100.0 - 0.05;  // an integrator, and a load
    }
    return -actual;
  };
  EXPECT_NEAR(error(0.0), 0.05 / 100.0 * CountController::kFullScale / 100.0, 0.1);
  EXPECT_NEAR(error(1.0), 0.0, 0.01);
}

// 6
TEST(Mco305Features, AProfileGoesItsDistanceWithinItsVelocity) {
  for (const int target : {100, 5000, 60'000, 123'457}) {
    Bench run;
    run.begin_with("POSA " + std::to_string(target) + "\ndone = 1\n");
    double area = 0.0, peak = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const double before = run.device().set_position();
      run.step();
      area += run.device().set_position() - before;
      peak = std::max(peak, run.device().set_velocity_now());
    }
    EXPECT_NEAR(area, target, 1e-6);
    EXPECT_LE(peak, 100.0 + 1e-9);
    EXPECT_EQ(run.variable("done"), 1);
    // Shorter than both ramps together (50,000 qc) it does not reach its velocity.
    EXPECT_NEAR(peak, std::min(100.0, std::sqrt(target * 0.2)), 0.2);
  }
}

TEST(Mco305Features, ATouchProbeIsMetByItsInterruptAndExactlyByItsLatch) {
  for (const bool latched : {false, true}) {
    Bench run;
    run.set("SYNCMTYPS", 2);
    run.begin_with(std::string("ON INT 6 GOSUB probe\nCVEL 100\nCSTART\n"),
                   latched ? "SUBPROG probe\nDELAY 2\nPOSA (IPOS + 50000)\nRETURN\n"
                           : "SUBPROG probe\nPOSR 50000\nRETURN\n");
    run.run(1500);
    const std::int32_t before = run.position();
    run.object.device().io().set_input(6, true);
    run.step();
    const std::int32_t seen = latched ? run.device().latched_units() : before;
    run.run(4000);
    EXPECT_NEAR(run.position() - seen, 50'000, latched ? 1 : 200);
  }
}

TEST(Mco305Features, ANewTargetInMotionIsTakenWithoutAStep) {
  Bench run;
  run.begin_with("NOWAIT ON\nPOSA 100000\nDELAY 700\nPOSA 30000\nDELAY 400\nPOSA 150000\n");
  double velocity = 0.0;
  for (int i = 0; i < 6000; ++i) {
    run.step();
    const double now = run.device().set_velocity_now();
    ASSERT_LE(std::abs(now - velocity), 0.2 + 1e-9) << i;
    velocity = now;
  }
  EXPECT_EQ(run.position(), 150'000);
}

// 7
TEST(Mco305Features, ATargetWindowWaitsForTheAxis) {
  const auto ends = [](int window) {
    Bench run(true);
    run.set("FFVEL", 0);
    run.set("KPROP", 210);  // lags by some 50 ms
    run.set("POSERR", 100'000);
    run.set("TESTWIN", window);
    run.set("TESTVAL", 5);
    run.set("TESTTIM", 2);
    run.begin_with("POSA 20000\nt = TIME\nrest = APOS\n");
    run.run(5000);
    return std::pair{run.variable("t"), run.variable("rest")};
  };
  const auto [at_once, far] = ends(0);
  const auto [later, near] = ends(10);
  EXPECT_GT(20'000 - far, 10) << "the profile is over, the axis is not there";
  EXPECT_LE(std::abs(20'000 - near), 10);
  EXPECT_GT(later, at_once + 20);
}

// 8
TEST(Mco305Features, LimitsStayWhereTheyAreOnTheMachine) {
  Bench run;
  run.set("33-44", 1);
  run.set("33-42", 5000);
  run.begin_with(
      "ON ERROR GOSUB trouble\nn = 0\nPOSA 2000\nDEF ORIGIN\na = APOS\nPOSA 3000\nb = APOS\nPOSA 3001\n",
      "SUBPROG trouble\nn = ERRNO\nERRCLR\nRETURN\n");
  run.run(4000);
  EXPECT_EQ(run.variable("a"), 0);
  EXPECT_EQ(run.variable("b"), 3000);
  EXPECT_EQ(run.variable("n"), 111);
  EXPECT_EQ(run.position(), 3000) << "no motion";
  Bench other;
  other.begin_with("SET ORIGIN 2000\nPOSA 2000\na = APOS\nRST ORIGIN\nb = APOS\n");
  other.run(2000);
  EXPECT_EQ(other.variable("a"), 2000);
  EXPECT_EQ(other.variable("b"), 4000);
}

// 10
TEST(Mco305Features, SpeedModeRunsAndStopsInItsDistance) {
  Bench run;
  run.set("VELMAX", 1500);
  run.begin_with("DEC 50\nCVEL 80\nCSTART\nDELAY 2000\nv = AVEL\na = APOS\nCSTOP\nWAITAX\nb = APOS\n");
  run.run(5000);
  EXPECT_EQ(run.variable("v") * 60 / 2000, 1200) << "1/min";
  const double v = 40.0, deceleration = 0.05;  // [qc/ms], [qc/ms²]
  EXPECT_NEAR(run.variable("b") - run.variable("a"), v * v / (2.0 * deceleration), 2.0 * v);
}

// 11
TEST(Mco305Features, AFreeAxisIsTakenOverWhereItHasBeenTurned) {
  Bench run(true);
  run.begin_with(
      "POSA 1000\nMOTOR OFF\nOUTAN 0x800\nDELAY 100\nOUTAN 0\nDELAY 200\na = APOS\nMOTOR ON\ne = "
      "TRACKERR\nDELAY 200\n"
      "b = APOS\nf = TRACKERR\n");
  run.run(3000);
  EXPECT_GT(run.variable("a"), 1500);
  EXPECT_NEAR(run.variable("e"), 0, 1);
  EXPECT_NEAR(run.variable("b"), run.variable("a"), 1);
  EXPECT_NEAR(run.variable("f"), 0, 1);
}

TEST(Mco305Features, ContinueEndsAtTheFirstTarget) {
  Bench run;
  run.begin_with(
      "NOWAIT ON\nPOSA 100000\nDELAY 600\nMOTOR STOP\nWAITAX\na = APOS\nCONTINUE\nWAITAX\nb = APOS\n");
  run.run(5000);
  EXPECT_LT(run.variable("a"), 100'000);
  EXPECT_EQ(run.variable("b"), 100'000);
}

// 13
TEST(Mco305Features, AStopThatBrakesTooHardReversesOnceAndRests) {
  Bench run;
  run.set("RAMPTYPE", 2);
  run.set("JERKMIN", 200);
  // Braking with 0.2 qc/ms² at 10 qc/ms it cannot let go in time.
  run.begin_with("CVEL 30\nCSTART\nDELAY 2000\nCVEL -30\n");
  run.run(2000);
  while (run.device().set_velocity_now() > 10.0) run.step();
  run.device().motor_stop();
  int changes = 0;
  double before = run.device().set_velocity_now(), lowest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    run.step();
    const double now = run.device().set_velocity_now();
    if (now != 0.0 && before != 0.0 && (now < 0.0) != (before < 0.0)) ++changes;
    before = now != 0.0 ? now : before;
    lowest = std::min(lowest, now);
  }
  EXPECT_LE(changes, 1);
  EXPECT_EQ(run.device().set_velocity_now(), 0.0);
}

// 16
TEST(Mco305Features, WhatAFilterHoldsBackComesBackInTenTimeConstants) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.set("SYNCVFTIME", -50'000);
  run.begin_with("SYNCP\n");
  run.run(10);
  const auto lag = [&](int steps) {
    for (int i = 0; i < steps; ++i) turned += 20, run.step();
    return std::abs(run.device().master().shown() - run.device().set_units());
  };
  const std::int32_t soon = lag(150);
  EXPECT_GT(soon, 300) << "the filter is behind by its time constant";
  EXPECT_LT(lag(4000), 3) << "and no count is lost";
}

// 18
TEST(Mco305Features, AStartByAPathMeetsTheMasterAtAMarker) {
  for (const int start : {7, 1007}) {
    Bench run;
    DINT turned = 0;
    run.object.master.signal = &turned;
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMTYPS", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMPULSS", 4000.0},
                                      {"SYNCMSTART", start * 1.0}})
      run.set(name, value);
    run.begin_with("SYNCM\n");
    run.run(10);
    run.device().mark(0.0 + 700.0 - 4000.0);  // where the slave is marked: 700 behind a marker
    int next_master = 1, next_slave = 0;
    double velocity = 0.0, largest = 0.0;
    bool met = false;
    for (int i = 0; i < 4000; ++i) {
      turned += 20;
      for (; 4000 * next_master <= turned; ++next_master) run.device().master().mark(4000.0 * next_master);
      run.step();
      for (; 700 + 4000 * next_slave <= run.device().actual_position(); ++next_slave)
        run.device().mark(700.0 + 4000.0 * next_slave);
      const double now = run.device().set_velocity_now();
      ASSERT_LE(std::abs(now - velocity), 0.2 + 1e-9) << i;
      velocity = now;
      if (turned < 4000) {
        EXPECT_EQ(now, 0.0) << "it waits for a marker of the master";
      }
      if (met || now < 19.9) continue;
      met = true;
      // From here on it goes along, and its markers with those of the master.
      largest = std::abs(std::remainder(run.device().set_position() - turned - 700.0, 4000.0));
    }
    EXPECT_TRUE(met);
    EXPECT_LE(largest, 25.0) << start;
    EXPECT_NEAR(std::remainder(run.device().set_position() - turned - 700.0, 4000.0), 0.0, 1.5);
  }
}

TEST(Mco305Features, AStartByAPathIsOfTheLaterEdition) {
  Bench run;
  run.object.settings.later_edition = false;
  run.set("SYNCMSTART", 7);
  run.begin_with("SYNCM\n");
  run.run(5);
  EXPECT_EQ(run.object.machine().state(), aposs::ProgramState::kRefused);
}

// 27
TEST(Mco305Features, AnOutputFollowsEachForwardPassOfTheMaster) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.begin_with("ON +MAPOS 2500 GOSUB pulse\n", "SUBPROG pulse\nOUT 1 1\nDELAY 300\nOUT 1 0\nRETURN\n");
  run.run(5);
  int on = 0;
  const auto turn = [&](int steps, int by) {
    on = 0;
    for (int i = 0; i < steps; ++i) turned += by, run.step(), on += run.device().io().output(1) ? 1 : 0;
  };
  turn(1000, 4);
  EXPECT_NEAR(on, 300, 2);
  turn(1000, -4);
  EXPECT_EQ(on, 0) << "backwards it passes nothing";
  turn(1000, 4);
  EXPECT_NEAR(on, 300, 2);
}

// 32
TEST(Mco305Features, APeriodIsFiftyMillisecondsUnderAnyLoad) {
  Bench run;
  std::mt19937 random(32);
  run.add_program(
      "n = 0\nload = 0\nON PERIOD 50 GOSUB beat\nmain:\nLOOP (GET 1900) here\nhere:\nload = load + 1\nGOTO "
      "main\nSUBMAINPROG\n"
      "SUBPROG beat\nn = n + 1\nlast = TIME\nDELAY (GET 1901)\nRETURN\nENDPROG\n");
  run.begin();
  for (int i = 0; i < 50'025; ++i) {
    if (i % 100 == 0) {
      run.device().set_parameter(1900, static_cast<std::int32_t>(random() % 500));
      run.device().set_parameter(1901, static_cast<std::int32_t>(random() % 40));
    }
    run.step();
  }
  EXPECT_NEAR(run.variable("n"), 1000, 1) << "of 50 ms each, without a drift";
  EXPECT_NEAR(run.variable("last"), 50'000, 2);
}

// 35
TEST(Mco305Features, TheMovingOutputFollowsTheCommandAndNotTheEncoder) {
  Bench run(true);
  run.set("FFVEL", 0);
  run.set("KPROP", 210);
  run.set("POSERR", 100'000);
  run.set("O_FUNCTION_3", 1);
  run.begin_with("POSA 20000\n");
  int lag = 0;
  for (int i = 0; i < 4000; ++i) {
    run.step();
    const bool moves = run.device().moving();
    EXPECT_EQ(run.device().io().output(3), moves) << i;
    if (!moves && i > 100 && std::abs(20'000 - run.position()) > 10) ++lag;
  }
  EXPECT_GT(lag, 20) << "the axis was on its way still";
}

// 37
TEST(Mco305Features, SystemVariablesAgreeWithEachOther) {
  Bench run(true);
  run.begin_with("PULSACC 20000\nPULSVEL 4000\nSYNCP\n");
  int flags = 0;
  for (int i = 0; i < 3000; ++i) {
    run.step();
    ASSERT_EQ(run.system_variable(4101), run.system_variable(4097) - run.system_variable(4096));
    ASSERT_EQ(static_cast<std::uint32_t>(run.system_variable(4218)) & 0x7F000000U,
              static_cast<std::uint32_t>(run.device().sync_status()) << 24);
    ASSERT_EQ(run.system_variable(17), run.device().status() >> 16 & 0xFFFF);
    flags |= run.system_variable(4218);
  }
  EXPECT_NE(flags & 4 << 24, 0) << "it was accurate";
}

// Sample B3: another program knows the arrays by their order.
TEST(Mco305Samples, ArraysHaveOtherNamesInAnotherProgram) {
  Bench run;
  run.add_program(
      "DIM target1[20], target2[20], target3[20], plant_offset[50]\nDIM parameter[10]\n"
      "target1[1] = 1234\nplant_offset[50] = 99\nSET PRGPAR 1\n");
  run.add_program(
      "DIM xpos[20], ypos[20], zpos[20], offs[50]\nVEL 100\na = xpos[1]\nb = offs[50]\nxpos[1] = 10000\n"
      "xpos[2] = 20000\nxpos[3] = 30000\ni = 1\nWHILE (i<20) DO\nypos[i] = i*1000\ni = i+1\nENDWHILE\n"
      "zpos[1] = APOS\nPOSA xpos[1]\noffs[1] = (xpos[2]) % 20\nc = offs[1]\nd = ypos[19]\ne = APOS\n"
      "wait:\nGOTO wait\n",
      1, false);
  run.begin();
  run.run(3000);
  EXPECT_EQ(run.variable("a"), 1234);
  EXPECT_EQ(run.variable("b"), 99);
  EXPECT_EQ(run.variable("c"), 1000);
  EXPECT_EQ(run.variable("d"), 19'000);
  EXPECT_EQ(run.variable("e"), 10'000);
}

// Samples B5, B6: SET ORIGIN and DEF ORIGIN.
TEST(Mco305Samples, ZeroPointsAreThoseOfThePrintedOutputs) {
  Bench run;
  run.begin_with(
      "POSA 2000\na = APOS\nDEF ORIGIN\nb = APOS\nPOSA (-2000)\nDEF ORIGIN\nSET ORIGIN 2000\nPOSA 2000\nc = "
      "APOS\nd = SYSVAR[4096]\n");
  run.run(3000);
  EXPECT_EQ(run.variable("a"), 2000);
  EXPECT_EQ(run.variable("b"), 0);
  EXPECT_EQ(run.variable("c"), 2000);
  EXPECT_EQ(run.variable("d"), 4000) << "from the real one";
}

// Sample B8: a velocity that is changed on the way, and an output that shows bit 6.
TEST(Mco305Samples, AxendTellsOfAMotionAndOfTheController) {
  Bench run;
  run.begin_with(
      "NOWAIT ON\nVEL 5\nPOSA 100000\nWHILE (AXEND & 2) DO\nIF IN 2 THEN\nVEL 50\nPOSA 100000\nENDIF\n"
      "ENDWHILE\nOUT 2 1\nMOTOR OFF\n"
      "show:\nIF (AXEND & 64) THEN\nOUT 1 1\nELSE\nOUT 1 0\nENDIF\nGOTO show\n");
  run.run(1000);
  EXPECT_EQ(run.device().set_velocity_now(), 5.0);
  run.device().io().set_input(2, true);
  run.run(2);
  run.device().io().set_input(2, false);
  run.run(600);
  EXPECT_EQ(run.device().set_velocity_now(), 50.0);
  EXPECT_FALSE(run.device().io().output(2));
  run.run(2500);
  EXPECT_EQ(run.position(), 100'000);
  EXPECT_TRUE(run.device().io().output(2));
  EXPECT_TRUE(run.device().io().output(1));
}

// Sample B12: it stops behind the position that calls for it.
TEST(Mco305Samples, APositionStopsTheDrive) {
  Bench run;
  run.add_program(
      "VEL 100\nACC 100\nDEC 100\nCVEL 20\nCSTART\nON +APOS 2000 GOSUB STOP\nwait:\nGOTO wait\nSUBMAINPROG\n"
      "SUBPROG STOP\nCSTOP\nRETURN\nENDPROG\n");
  run.begin();
  run.run(3000);
  EXPECT_EQ(run.device().set_velocity_now(), 0.0);
  constexpr double kStop = 20.0 * 20.0 / (2.0 * 0.2);
  EXPECT_GE(run.position(), 2000 + kStop - 1);
  EXPECT_LE(run.position(), 2000 + kStop + 2 * 20 + 20);
}

// Sample B27: in the middle of a motion, and at an index or behind its time.
TEST(Mco305Samples, WaitsForAPositionAndForAnIndex) {
  Bench run;
  run.begin_with("NOWAIT ON\nPOSA 10000\nWAITP 5000\na = APOS\nOUT 1 1\nNOWAIT OFF\nWAITAX\n");
  while (!run.device().io().output(1) && run.now() < 2000) run.step();
  EXPECT_GE(run.variable("a"), 5000);
  EXPECT_LE(run.variable("a"), 5000 + 45);
  run.run(1000);
  EXPECT_EQ(run.position(), 10'000);
  Bench index;
  index.object.settings.drive.signals.zero_marks = ZeroMarks{.position = 3000.0, .period = 4000.0};
  index.begin_with("CVEL 1\nCSTART\nWAITNDX 10000\na = APOS\nOUT 1 1\n");
  while (!index.device().io().output(1) && index.now() < 9000) index.step();
  EXPECT_NEAR(index.variable("a"), 3000, 3);
  EXPECT_NEAR(index.device().latched_units(), 3000, 1);
}

// Samples B9, B10: a latch is where the marker was, a position read later is further on.
TEST(Mco305Samples, TheLatchesOfBothSidesAreExact) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.set("SYNCMTYPS", 2);
  run.set("SYNCMTYPM", 2);
  run.begin_with(
      "ON INT 6 GOSUB slave\nON INT 5 GOSUB leading\nCVEL 50\nCSTART\n",
      "SUBPROG slave\nDELAY 2\na = APOS\ni = IPOS\nRETURN\nSUBPROG leading\nDELAY 2\nm = MAPOS\nj = "
      "MIPOS\nRETURN\n");
  for (int i = 0; i < 1000; ++i) turned += 30, run.step();
  const std::int32_t slave = run.position(), leading = run.device().master().shown();
  run.device().io().set_input(6, true);
  run.device().io().set_input(5, true);
  for (int i = 0; i < 20; ++i) turned += 30, run.step();
  EXPECT_NEAR(run.variable("i"), slave, 1);
  EXPECT_GT(run.variable("a"), run.variable("i") + 50);
  EXPECT_LE(run.variable("a"), run.variable("i") + 250);
  EXPECT_NEAR(run.variable("j"), leading, 31) << "the edge of a sampled input";
  EXPECT_GT(run.variable("m"), run.variable("j"));
}

// Sample B15.
TEST(Mco305Samples, APositionOfTheMasterStartsSyncv) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.begin_with("at = 0\nON +MAPOS 2200 GOSUB go\n", "SUBPROG go\nat = MAPOS\nSYNCV\nRETURN\n");
  for (int i = 0; i < 1000; ++i) turned += 10, run.step();
  EXPECT_NEAR(run.variable("at"), 2200, 21);
  EXPECT_NEAR(run.device().velocity_units(), 10'000, 300);
}

// Sample B18.
TEST(Mco305Samples, AFlagOfAMissingMarkerIsClearedByItsInterrupt) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                    {"SYNCMTYPS", 2.0},
                                    {"SYNCMPULSM", 4000.0},
                                    {"SYNCMPULSS", 4000.0},
                                    {"SYNCMWINM", 200.0},
                                    {"SYNCMWINS", 200.0}})
    run.set(name, value);
  run.begin_with(
      "n = 0\nON STATBIT 30 GOSUB missed\nSYNCM\n",
      "SUBPROG missed\nn = n + 1\nbefore = SYNCSTAT & 32\nSYNCSTATCLR 32\nafter = SYNCSTAT & 32\nRETURN\n");
  run.run(5);
  run.device().master().mark(0.0);
  for (int i = 0; i < 250; ++i) turned += 20, run.step();
  EXPECT_EQ(run.variable("n"), 1);
  EXPECT_EQ(run.variable("before"), 32);
  EXPECT_EQ(run.variable("after"), 0);
}

// Sample B23: it runs already when it is told to follow.
TEST(Mco305Samples, SyncpTakesOverARunningAxis) {
  Bench run;
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.begin_with("CVEL 50\nCSTART\nWAITT 500\nSYNCP\n");
  double velocity = 0.0;
  std::int32_t largest = 0;
  for (int i = 0; i < 2000; ++i) {
    turned += 50;
    run.step();
    const double now = run.device().set_velocity_now();
    ASSERT_LE(std::abs(now - velocity), 0.2 + 1e-9);
    velocity = now;
    if (i > 520) largest = std::max(largest, std::abs(run.device().sync_error()));
  }
  EXPECT_LE(largest, 2) << "with the velocity of the master it has nothing to catch up";
}

// Each that is told as built is there, and each other one is not.
TEST(Mco305Features, EverySystemVariableIsThereOrSaysThatItIsNot) {
  Bench run;
  run.begin_with("");
  run.run(5);
  std::size_t built = 0;
  for (const mco305::SystemVariable& one : mco305::system_variables()) {
    std::int32_t value = 0;
    EXPECT_EQ(run.device().system_variable(one.index, value), one.built) << one.index;
    built += one.built ? 1 : 0;
  }
  EXPECT_GE(built, 50u);
}

// 33-60: X59/1 and X59/2 are inputs 11 and 12, or outputs 1 and 2.
TEST(Mco305Features, TwoTerminalsAreInputsOrOutputs) {
  for (const bool inputs : {false, true}) {
    Bench run;
    run.set("IOMODE", inputs ? 0 : 1);
    run.set("33-61", 3);  // negative end switch
    run.set("33-63", 1);  // moving
    run.set("33-65", 1);
    run.begin_with("ON ERROR GOSUB trouble\nn = 0\nOUT 2 1\nCVEL 10\nCSTART\n",
                   "SUBPROG trouble\nn = ERRNO\nRETURN\n");
    bool level = false;
    run.run(20);
    EXPECT_EQ(run.device().io().output(1), !inputs);
    EXPECT_EQ(run.device().io().output(2), !inputs);
    EXPECT_TRUE(run.device().io().output(3));
    level = true;
    run.device().io().set_input(11, level);
    run.device().io().set_input(12, level);
    run.run(20);
    EXPECT_EQ(run.device().io().input(11), inputs);
    EXPECT_EQ(run.device().io().input_byte(2), inputs ? 12 : 0) << "bits 2 and 3 of inputs 9 to 12";
    EXPECT_EQ(run.variable("n"), inputs ? 125 : 0);
  }
}

// 33-20 of a simulated slave: 0: a pulse each ENCODERFREQ; n2, n3: edges of input n.
TEST(Mco305Features, ASimulatedSlaveHasPulsesAndAnyInputForItsMarkers) {
  for (const bool later : {false, true}) {
    Bench run;
    run.object.settings.later_edition = later;
    run.begin_with("SET ENCODERFREQ 300\nPOSA 1000\na = IPOS\nPOSA 700\nb = IPOS\n");
    run.run(3000);
    EXPECT_EQ(run.variable("a"), later ? 750 : 0);
    EXPECT_EQ(run.variable("b"), later ? 750 : 0);
    EXPECT_EQ(run.device().latches(), later ? 4u : 0u) << "150, 450, 750, and 750 again";
  }
  for (const int type : {42, 43}) {
    Bench run;
    run.begin_with("SET SYNCMTYPS " + std::to_string(type) + "\nCVEL 100\nCSTART\n");
    run.run(100);
    run.device().io().set_input(6, true);
    run.run(2);
    EXPECT_EQ(run.device().latches(), 0u);
    run.device().io().set_input(4, true);
    run.run(1);
    const auto risen = run.device().actual_units();
    run.run(50);
    EXPECT_EQ(run.device().latches(), type == 42 ? 1u : 0u);
    run.device().io().set_input(4, false);
    run.run(1);
    const auto fallen = run.device().actual_units();
    EXPECT_GT(fallen, risen + 500);
    EXPECT_EQ(run.device().latches(), 1u);
    EXPECT_NEAR(run.device().latched_units(), type == 42 ? risen : fallen, 50) << "to a millisecond";
  }
}

// 33-19: an external marker and a second input.
TEST(Mco305Features, MarkersOfTheMasterMayWaitForAnInput) {
  for (const bool later : {false, true}) {
    Bench run;
    DINT turned = 0;
    run.object.settings.later_edition = later;
    run.object.master.signal = &turned;
    run.begin_with("SET SYNCMTYPM 32\n");
    const auto pass = [&] {
      for (int i = 0; i < 10; ++i) turned += 10, run.step();
      run.device().io().set_input(5, true);
      for (int i = 0; i < 10; ++i) turned += 10, run.step();
      run.device().io().set_input(5, false);
      return run.device().master().shown_latch();
    };
    run.run(5);
    EXPECT_EQ(pass(), 0);
    EXPECT_EQ(pass() == 0, later) << "before, 32 names no input: a falling edge";
    run.device().io().set_input(3, true);
    const auto met = pass();
    EXPECT_NE(met, 0);
    run.device().io().set_input(3, false);
    EXPECT_EQ(pass() == met, later);
  }
}

// 32-00, 32-30: two digits in place of SWAPMENC; 32-13, 32-43: what is read goes on.
TEST(Mco305Features, EncodersChangePlacesByTheirTypesHardOrSoft) {
  for (const int soft : {0, 1, 3}) {
    for (const bool by_master : {false, true}) {
      Bench run;
      const std::string first = by_master ? "SET MENCODERTYPE 21\n" : "SET ENCODERTYPE 11\n";
      const std::string second = by_master ? "SET MENCODERTYPE 11\n" : "SET ENCODERTYPE 21\n";
      run.begin_with("SET ENCCONTROL " + std::to_string(soft) + "\nSET MENCCONTROL " + std::to_string(soft) +
                     "\nPOSA 3000\nMOTOR OFF\n" + first +
                     "a = APOS\nb = MAPOS\nMOTOR ON\nPOSA 10000\nMOTOR OFF\n" + second +
                     "c = APOS\nd = MAPOS\n");
      run.run(3000);
      EXPECT_EQ(run.variable("a"), soft != 0 ? 3000 : 0);
      EXPECT_EQ(run.variable("b"), soft != 0 ? 0 : 3000);
      EXPECT_EQ(run.variable("c"), soft != 0 ? 10'000 : 3000);
      EXPECT_EQ(run.variable("d"), soft != 0 ? 0 : 10'000);
    }
  }
  Bench run;  // in motion: neither the axis nor what is read of it steps
  run.begin_with("SET ENCCONTROL 1\nCVEL 50\nCSTART\nDELAY 1000\nSET ENCODERTYPE 11\n");
  std::int32_t last = 0;
  for (int i = 0; i < 2000; ++i) {
    run.step();
    const std::int32_t now = run.device().actual_units();
    if (i > 500) {
      ASSERT_EQ(now - last, 50) << i;
    }
    last = now;
  }
}

}  // namespace
}  // namespace lockstep::mco305_feature_test
