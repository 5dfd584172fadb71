// What the scenarios do not say of synchronizing: commands in their order, a drive, markers with all that
// goes wrong with them.
#include <algorithm>
#include <cmath>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::following_test {
namespace {

/// A device with a virtual master of 500 lines a turn, and the usual 100 qc/ms.
struct Following : DeviceRun {
  Following() {
    for (const auto& [name, value] : {std::pair{"ENCODER", 500.0},
                                      {"MENCODER", 500.0},
                                      {"VELMAX", 3000.0},
                                      {"RAMPMIN", 0.5},
                                      {"SYNCTYPE", 1.0}})
      set(name, value);
  }
  void begin_with(const std::string& text) {
    add_program("VEL 100\nACC 100\nDEC 100\n" + text + "wait:\nGOTO wait\nSUBMAINPROG\nENDPROG\n");
    begin();
  }
  mco305::Device& device() { return object.device(); }
};

TEST(Mco305Following, BeginsAtAnOriginThatHasBeenDefined) {
  Following run;
  run.begin_with(
      "PULSACC 1000000\nDEF SYNCORIGIN 2000 4000\nPULSVEL 5000\nSYNCP\nWHILE (MAPOS < 20000) DO\nENDWHILE\n"
      "PULSVEL 0\n");
  run.run(5000);
  EXPECT_EQ(run.device().actual_units() - run.device().master().shown(), 2000);
  EXPECT_GT(run.device().master().shown(), 19'999);
}

// DEF SYNCORIGIN: "it is guaranteed, that master and slave will be synchronized at the above position"; a
// position offset is part of that, and what it is changed by later counts.
TEST(Mco305Following, IsSynchronousAtItsOriginWhateverTheOffsetIs) {
  for (const auto& [master, slave] : {std::pair{1, 1}, std::pair{1, -2}}) {
    Following run;
    run.set("SYNCFACTM", master);
    run.set("SYNCFACTS", slave);
    run.set("SYNCPOSOFFS", 900);
    run.begin_with(
        "PULSACC 1000000\nDEF SYNCORIGIN 2000 4000\nPULSVEL 5000\nSYNCP\nWHILE (MAPOS < 20000) DO\nENDWHILE\n"
        "PULSVEL 0\nDELAY 2000\na = APOS\nSET SYNCPOSOFFS 1000\nDELAY 2000\nb = APOS\n");
    run.run(9000);
    const int moved = (run.device().master().shown() - 2000) * slave / master;
    EXPECT_EQ(run.variable("a"), 4000 + moved);
    EXPECT_EQ(run.variable("b"), run.variable("a") + 100 * slave / master);
  }
}

// DE 33-13: a new window counts from the next SYNC command on.
TEST(Mco305Following, TakesANewAccuracyWithTheNextStart) {
  Following run;
  run.set("SYNCACCURACY", 20);
  run.begin_with(
      "SYNCP\nDELAY 200\nVEL 1\nSET SYNCPOSOFFS 300\nDELAY 2\nSET SYNCACCURACY 500\nDELAY 2\na = SYNCSTAT & "
      "4\n"
      "DELAY 3000\nSYNCP\nDELAY 2\nb = SYNCSTAT & 4\n");
  run.run(5000);
  EXPECT_EQ(run.variable("a"), 0);
  EXPECT_EQ(run.variable("b"), 4);
}

// Axes that follow a device see its user units: another unit is another scale from there on, and no step.
TEST(Mco305Following, LeadsOnWhereItIsWhenItsUnitChanges) {
  for (const bool drive : {false, true}) {
    Following run;
    run.set("FFVEL", 10'486);
    run.object.settings.has_drive = drive;
    run.object.leads = true;
    run.object.lead_by_actual_value();
    run.set("POSFACT_Z", 40);
    run.begin_with(
        "CVEL 20\nCSTART\nDELAY 2000\nSET POSFACT_Z 41\nDELAY 500\nSET POSFACT_Z 7\nSET POSDRCT 3\nDELAY "
        "500\nSET POSFACT_Z 40000\n");
    for (int i = 0; i < 4000; ++i) {
      const double set = run.object.setpoint().position.value, actual = run.object.actual_position().value;
      run.step();
      run.object.before_axes();
      EXPECT_NEAR(run.object.setpoint().position.value - set, run.object.setpoint().velocity * 1e-3, 1.0)
          << i;
      EXPECT_LT(std::abs(run.object.actual_position().value - actual), 20.0) << i;
    }
    EXPECT_NEAR(std::abs(run.object.setpoint().velocity), 20.0 * 1000.0 / 40'000.0, 1e-6);
  }
}

/// The largest step of the set position beside its velocity, and of that of the axis, in so many
/// milliseconds.
struct Steps {
  double set = 0.0, actual = 0.0;
};
Steps steps_of(Following& run, int milliseconds) {
  Steps worst;
  double set = run.device().set_position(), velocity = 0.0, before = run.device().machine_position();
  for (int i = 0; i < milliseconds; ++i) {
    run.step();
    const double now = run.device().machine_position();
    worst.set =
        std::max(worst.set, std::abs(run.device().set_position() - set - run.device().set_velocity_now()));
    if (i > 0) worst.actual = std::max(worst.actual, std::abs(now - before - velocity));
    set = run.device().set_position();
    velocity = now - before;
    before = now;
  }
  return worst;
}

// A drive that follows a velocity gets its error from where the axis is, whatever it has done before.
TEST(Mco305Following, SyncvBeginsInMotionAsAnyOtherMode) {
  for (const char* const before : {"POSA 20000\n", "VEL 40\nCVEL 40\nCSTART\nDELAY 1500\n",
                                   "SYNCP\nDELAY 1500\n", "SYNCV\nDELAY 500\nPOSA 30000\n"}) {
    Following run;
    run.set("FFVEL", 10'486);
    run.object.settings.has_drive = true;
    run.object.settings.drive.time_constant = 0.003;
    run.begin_with("PULSACC 20000\nPULSVEL 5000\nDELAY 500\n" + std::string(before) + "WAITI 1 ON\nSYNCV\n");
    run.run(6000);
    run.device().io().set_input(1, true);
    const Steps worst = steps_of(run, 3000);
    EXPECT_LT(worst.set, 4.0) << before << "what the axis is behind its set position by, and counts";
    EXPECT_LT(worst.actual, 0.6) << before << "ACC is 0.2 qc/ms², and a count of the controller";
    EXPECT_NEAR(run.device().set_velocity_now(), 20.0, 0.5) << before;
  }
}

TEST(Mco305Following, AddsWhatMovesItsOriginAndForgetsItWithTheNextStart) {
  Following run;
  run.begin_with(
      "SYNCP\nDELAY 100\nMOVESYNCORIGIN 300\nDELAY 1000\nMOVESYNCORIGIN 200\nDELAY 1000\nSET SYNCPOSOFFS "
      "(-100)\n"
      "DELAY 1000\na = APOS\nSYNCP\nDELAY 1000\nb = APOS\n");
  run.run(6000);
  EXPECT_EQ(run.variable("a"), 400);
  EXPECT_EQ(run.variable("b"), 300) << "the offset again, from where it stood";
}

TEST(Mco305Following, GoesOnWithAPositionAndNeverContinuesByItself) {
  Following run;
  run.begin_with(
      "PULSACC 1000000\nPULSVEL 5000\nSYNCP\nDELAY 1000\na = AXEND\nPOSA 100000\nb = APOS\nSYNCP\nDELAY "
      "1000\n"
      "MOTOR STOP\nc = APOS\nCONTINUE\nDELAY 200\nd = APOS\n");
  run.run(8000);
  EXPECT_EQ(run.variable("a") & 1, 0) << "not at rest";
  EXPECT_EQ(run.variable("b"), 100'000);
  EXPECT_GT(run.variable("c"), 110'000);
  EXPECT_EQ(run.variable("d"), run.variable("c"));
}

TEST(Mco305Following, InterruptsComeFromItsFlagsAndItsMaster) {
  Following run;
  run.add_program(
      "n = 0\nm = 0\nON STATBIT 27 GOSUB accurate\nON +MAPOS 30000 GOSUB passed\nSET SYNCACCURACY 100\nVEL "
      "100\nACC 100\n"
      "DEC 100\nPULSACC 1000000\nPULSVEL 5000\nDELAY 100\nSYNCP\nwait:\nGOTO wait\nSUBMAINPROG\n"
      "SUBPROG accurate\nn = n + 1\ne = SYNCERR\nRETURN\nSUBPROG passed\nm = MAPOS\nRETURN\nENDPROG\n");
  run.begin();
  run.run(3000);
  EXPECT_GE(run.variable("n"), 1);
  EXPECT_LE(std::abs(run.variable("e")), 100);
  EXPECT_NEAR(run.variable("m"), 30'000, 40);
}

TEST(Mco305Following, SystemVariablesTellOfTheMaster) {
  Following run;
  run.set("MENCODERTYPE", 1);
  run.begin_with(
      "PULSACC 1000\nPULSVEL 10000\nDELAY 500\na = SYSVAR[4117]\nb = SYSVAR[4118]\nc = SYSVAR[4110]\nPULSACC "
      "0\n"
      "PULSVEL 0\nSET MENCODERTYPE 5\nSYSVAR[4105] = 1234\nd = MAPOS\nDEFMORIGIN\ne = MAPOS\nSETMORIGIN 7\nf "
      "= MAPOS\n"
      "g = SYSVAR[33]\n");
  run.run(700);
  EXPECT_EQ(run.variable("a"), 1'000'000);
  EXPECT_EQ(run.variable("b"), 10'000'000);
  EXPECT_EQ(run.variable("c"), 1);
  EXPECT_EQ(run.variable("d"), 1234);
  EXPECT_EQ(run.variable("e"), 0);
  EXPECT_EQ(run.variable("f"), 7);
  EXPECT_EQ(run.variable("g"), 19) << "its own line";
}

TEST(Mco305Following, FollowsByVelocityWithADrive) {
  Following run;
  run.object.settings.has_drive = true;
  run.object.settings.drive.time_constant = 0.003;
  run.set("FFVEL", 10'486);
  run.set("KPROP", 300);
  run.begin_with("PULSACC 20000\nPULSVEL 10000\nSYNCV\n");
  run.run(4000);
  EXPECT_NEAR(run.device().velocity_units(), 40'000, 100);
  EXPECT_EQ(run.object.machine().error(), 0);
  // Nothing is made up for: what the master has gone before the start of the ramp is lost.
  EXPECT_LT(std::abs(run.device().following_error()), 50);
}

/// What REVERS has held back of 4000 qc, and what is done about it when the master goes forward again.
struct HeldBackRun : Following {
  DINT turned = 0;
  double slowest = 1e9, fastest = 0.0;
  int steps = 0;  ///< of 20 qc until the axis is where its master is

  HeldBackRun(bool later, int time, int reversal = 2) {
    object.settings.later_edition = later;
    object.master.signal = &turned;
    for (const auto& [name, value] : {std::pair{"REVERS", reversal * 1.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCACCURACY", -1000.0},
                                      {"SYNCOFFTIME", time * 1.0}})
      set(name, value);
    begin_with("SYNCP\n");
    turn(0, 20);
    turn(20, 400);
    turn(-20, 200);
  }
  void turn(int by, int times) {
    for (int i = 0; i < times; ++i) turned += by, step();
  }
  /// Forward until nothing is ahead any more.
  void go_on(int settled) {
    for (steps = 0; steps < 5000 && std::abs(device().sync_error()) > 2; ++steps) {
      turn(20, 1);
      if (steps < settled) continue;
      slowest = std::min(slowest, device().set_velocity_now());
      fastest = std::max(fastest, device().set_velocity_now());
    }
  }
};

// 33-27 of the later edition: what REVERS has held back is given back as the trapezoid that takes SYNCOFFTIME
// for one SYNCMPULSM: at most 4000 / (0.8 · 1000 ms) = 5 qc/ms, beside the 20 qc/ms of the master.
TEST(Mco305Following, GivesBackWhatReversHasHeldBackInTheTimeOfAnOffset) {
  HeldBackRun run(true, 1000);
  EXPECT_EQ(run.device().set_velocity_now(), 0.0);
  const int ahead = -run.device().sync_error();
  EXPECT_GT(ahead, 3900);
  constexpr int kUpToSpeed = 120;  // 20 qc/ms by 0.2 qc/ms², in which the master comes up by 1000 qc
  run.go_on(kUpToSpeed);
  EXPECT_NEAR(run.slowest, 15.0, 0.3);
  EXPECT_LE(run.fastest, 20.5);
  const double given = ahead - 1000.0;  // a trapezoid of the same slopes, which is shorter at its top
  EXPECT_NEAR(run.steps, 100 + given / 5.0 + 200.0, 25.0);
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    run.turn(20, 1);
    largest = std::max(largest, std::abs(run.device().set_position() - run.turned));
  }
  EXPECT_LE(largest, 2.0) << "and then it goes along";
}

TEST(Mco305Following, WaitsForItsMasterWhereNothingIsGivenBack) {
  for (const auto& [later, time] : {std::pair{false, 1000}, {true, 0}}) {
    HeldBackRun run(later, time);
    run.go_on(0);
    EXPECT_EQ(run.slowest, 0.0);
    EXPECT_LE(run.steps, 320) << "4000 qc of 20 qc/ms, and the way up to them";
  }
}

// A master that only shakes carries nobody forward, and one that goes back again leaves the axis where it is.
TEST(Mco305Following, StandsWhereItsMasterShakesOrGoesBackAgain) {
  HeldBackRun run(true, 1000);
  const double stood = run.device().set_position();
  for (int i = 0; i < 3000; ++i) run.turn(i % 2 == 0 ? 1 : -1, 1);
  EXPECT_EQ(run.device().set_position(), stood);
  run.turn(20, 300);
  const double further = run.device().set_position();
  EXPECT_GT(further, stood + 2000.0);
  double last = further;
  for (int i = 0; i < 500; ++i) {
    run.turn(-20, 1);
    ASSERT_GE(run.device().set_position(), last);
    last = run.device().set_position();
  }
  run.go_on(0);
  EXPECT_LT(run.steps, 5000) << "all of it is given back";
}

// REVERS 1: an offset that is taken up backwards is no reversing master.
TEST(Mco305Following, AnOffsetDoesNotReverseBesideAMasterThatStands) {
  Following run;
  run.set("REVERS", 1);
  run.set("SYNCMPULSM", 4000);
  run.set("SYNCOFFTIME", 1000);
  run.object.master.signal = nullptr;
  run.begin_with(
      "PULSACC 100000\nPULSVEL 5000\nSYNCP\nDELAY 500\nPULSVEL 0\nDELAY 500\nSET SYNCPOSOFFS (-4000)\n");
  double last = -1e9;
  for (int i = 0; i < 4000; ++i) {
    run.step();
    ASSERT_GE(run.device().set_position(), last) << i;
    last = run.device().set_position();
  }
}

/// A device that follows a master of 20 qc/ms by markers; those of its own can be moved.
struct MarkersThatMove : Following {
  std::int64_t moved = 0;  ///< beside multiples of 4000 [qc]

  explicit MarkersThatMove(int start) {
    object.master.signal = &turned_;
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMTYPS", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMPULSS", 4000.0},
                                      {"SYNCMWINM", 200.0},
                                      {"SYNCMWINS", 200.0},
                                      {"SYNCMSTART", start * 1.0}})
      set(name, value);
  }
  void turn(int steps) {
    for (int i = 0; i < steps; ++i) {
      turned_ += 20;
      if (turned_ % 4000 == 0) device().master().mark(turned_);
      const std::int64_t before = number();
      step();
      if (number() > before) device().mark(static_cast<double>(4000 * number() + moved));
    }
  }
  double apart() { return device().set_position() - turned_; }

 private:
  std::int64_t number() {
    return static_cast<std::int64_t>(
        std::floor(static_cast<double>(device().actual_position() - moved) / 4000.0));
  }
  DINT turned_ = 0;
};

TEST(Mco305Following, SyncmarkerstartTakesTheNextMarkersWhereverTheyLie) {
  for (const int whole : {0, 1}) {
    MarkersThatMove run(4);
    run.begin_with("SYNCM\nWAITI 1 ON\na = SYNCSTAT\nSYNCMARKERSTART " + std::to_string(whole) +
                   "\nb = SYNCSTAT\n");
    run.run(5);
    run.turn(4000);
    EXPECT_NEAR(std::remainder(run.apart(), 4000.0), 0.0, 1.0);
    const double before = run.apart();
    run.moved = 1000;
    run.turn(3000);
    EXPECT_NEAR(run.apart(), before, 1.0) << "they lie outside of the window";
    run.device().io().set_input(1, true);
    double velocity = run.device().set_velocity_now();
    for (int i = 0; i < 4000; ++i) {
      run.turn(1);
      ASSERT_LE(std::abs(run.device().set_velocity_now() - velocity), 0.2 + 1e-9) << i;
      velocity = run.device().set_velocity_now();
    }
    // From the first pair on SYNCMSTART 4 corrects backwards; the pairs behind that go the shorter distance.
    EXPECT_NEAR(run.apart(), before + (whole == 0 ? 1000.0 : -3000.0), 1.0);
    EXPECT_NE(run.variable("a") & 64, 0);
    EXPECT_EQ(run.variable("b") & (8 | 16 | 32 | 64),
              whole == 0 ? run.variable("a") & (8 | 16 | 32 | 64) : 0);
  }
}

TEST(Mco305Following, SyncmarkerstartIsNothingBesideSyncmAndErrorOfOtherValues) {
  Following run;
  run.begin_with("SYNCMARKERSTART 1\nSYNCP\nSYNCMARKERSTART 0\na = ERRNO\nSYNCMARKERSTART 2\n");
  run.run(10);
  EXPECT_EQ(run.variable("a"), 0);
  EXPECT_EQ(run.object.device().pending().first(), 112);
}

// An alignment may be set by SYNCPOSOFFS, and markers keep it; so is what MOVESYNCORIGIN adds.
TEST(Mco305Following, MarkersKeepTheOffset) {
  for (const int start : {0, 5, 1000, 1005})
    for (const int offset : {0, 300, -700, 1990, 3000, -3000, 5000, -9000, 12'100}) {
      MarkersThatMove run(start);
      run.moved = 700;
      run.set("SYNCPOSOFFS", offset);
      run.begin_with("SYNCM\nWAITI 1 ON\nMOVESYNCORIGIN 200\nWAITI 2 ON\nSET SYNCPOSOFFS (-400)\n");
      run.run(5);
      run.turn(8000);
      const double first = run.apart() - offset;
      EXPECT_NEAR(std::remainder(first - 700.0, 4000.0), 0.0, 2.0) << start << " " << offset;
      run.device().io().set_input(1, true);
      run.turn(3000);
      EXPECT_NEAR(run.apart() - first, offset + 200.0, 2.0) << start << " " << offset;
      run.device().io().set_input(2, true);
      run.turn(5000);
      EXPECT_NEAR(run.apart() - first, -200.0, 2.0) << start << " " << offset;
      // Markers still correct.
      run.moved = 750;
      run.turn(3000);
      EXPECT_NEAR(run.apart() - first, -150.0, 2.0) << start << " " << offset;
    }
}

// Below 5.00 SYNCERR is as it was when the mode was left.
TEST(Mco305Following, SyncerrStandsBehindTheModeBefore500) {
  for (const bool later : {false, true}) {
    Following run;
    run.object.settings.later_edition = later;
    DINT turned = 0;
    run.object.master.signal = &turned;
    run.begin_with("SYNCP\nDELAY 1000\na = SYNCERR\nMOTOR STOP\nDELAY 500\nb = SYNCERR\n");
    for (int i = 0; i < 3000; ++i) turned += 10, run.step();
    EXPECT_NEAR(run.variable("a"), 0, 10);
    if (later)
      EXPECT_GT(run.variable("b"), 3000);
    else
      EXPECT_EQ(run.variable("b"), run.variable("a"));
  }
}

// SYNCVELREL is of the master, and SYNCOFFTIME may want to be faster.
TEST(Mco305Following, KeepsItsBandWhileAnOffsetIsSpread) {
  for (const int type : {0, 1})
    for (const int offset : {2000, -2000}) {
      Following run;
      DINT turned = 0;
      run.object.master.signal = &turned;
      run.set("SYNCTYPE", type);
      run.set("SYNCVELREL", 5);
      run.set("SYNCMPULSM", 4000);
      run.set("SYNCOFFTIME", 100);  // alone it would be 50 qc/ms
      run.begin_with("SYNCP\nWAITI 1 ON\nSET SYNCPOSOFFS (" + std::to_string(offset) + ")\n");
      run.run(5);
      const auto turn = [&](int steps) {
        for (int i = 0; i < steps; ++i) turned += 10, run.step();
      };
      turn(6000);
      const double before = run.device().set_position() - turned;
      run.device().io().set_input(1, true);
      double lowest = 10.0, highest = 10.0;
      int steps = 0;
      for (; steps < 6000 && std::abs(run.device().set_position() - turned - before - offset) > 0.5;
           ++steps) {
        turn(1);
        lowest = std::min(lowest, run.device().set_velocity_now());
        highest = std::max(highest, run.device().set_velocity_now());
      }
      EXPECT_GE(lowest, 9.5 - 1e-9) << offset;
      EXPECT_LE(highest, 10.5 + 1e-9) << offset;
      EXPECT_NEAR(steps, 4000, 60) << "2000 at 0.5 qc/ms";
      turn(1000);
      EXPECT_NEAR(run.device().set_position() - turned, before + offset, 1e-6);
    }
}

TEST(Mco305Following, SystemVariablesTellOfTheFirstCorrectionAndOfTheTrim) {
  for (const double time : {0.0, 1000.0}) {
    Following run;
    DINT turned = 0;
    run.object.master.signal = &turned;
    run.object.settings.master_marks = {.period = 4040.0};
    run.object.settings.markers = {.position = 700.0, .period = 4040.0};
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMTYPS", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMPULSS", 4000.0},
                                      {"SYNCMSTART", 5.0},
                                      {"SYNCMFTIME", time}})
      run.set(name, value);
    run.begin_with("SYNCM\n");
    run.run(5);
    int first = 0;
    for (int i = 0; i < 60'000; ++i) {
      turned += 20;
      run.step();
      if (first == 0) first = run.system_variable(4240);
      ASSERT_EQ(run.system_variable(4240), first) << "that of the start stays";
    }
    EXPECT_NE(first, 0);
    EXPECT_LE(std::abs(first), 2000) << "the nearer one";
    EXPECT_EQ(run.system_variable(4243), 4040);
    // (4000 - 4040) / 4040 of the gear, which its mean of at least 100 markers comes near.
    EXPECT_NEAR(run.system_variable(4244), time == 0.0 ? 0.0 : -65'536.0 / 101.0, 40.0);
  }
}

TEST(Mco305Following, AnAbsoluteMasterIsWhereItIsAndIsBridged) {
  Following run;
  DINT turned = 700;
  std::int32_t disturbed = 0;
  run.object.master.signal = &turned;
  run.object.settings.faults.master_encoder_counts = &disturbed;
  run.object.settings.master_marks = {.position = 21'000.0, .period = 100'000.0};
  run.set("MENCODERABSTYPE", 5);
  run.set("MENCODERDATLEN", 14);
  run.set("SYNCMTYPM", 2);
  run.set("MENCODER", 1000);
  run.begin_with("DELAY 5\na = MAPOS\nDEFMORIGIN\nb = ERRNO\nSYNCP\n");
  run.run(20);
  EXPECT_EQ(run.variable("a"), 700);
  EXPECT_EQ(run.object.device().pending().first(), 110);
  run.device().clear_all_errors();
  EXPECT_EQ(run.device().follow(mco305::SyncMode::kPosition), 0);
  std::int32_t last = run.device().master().shown();
  for (int i = 0; i < 2000; ++i) {
    turned += 20;
    disturbed = i >= 500 && i < 550 ? 8000 : 0;
    run.step();
    ASSERT_EQ(run.device().master().shown() - last, 20) << i;
    last = run.device().master().shown();
  }
  EXPECT_EQ(last, turned) << "beyond its 14 bits";
  EXPECT_EQ(run.device().master().shown_latch(), 21'000);
  EXPECT_EQ(run.system_variable(16), 50);
  EXPECT_EQ(run.system_variable(4103), (40'700 - 16'384) / 1000);
  EXPECT_EQ(run.device().master_velocity(), 20'000);
}

TEST(Mco305Following, AMasterWithoutEncoderIsMovedByItsAbsoluteTypeToo) {
  Following run;
  run.set("MENCODERABSTYPE", 5);
  run.begin_with("SYSVAR[4105] = 1234\na = MAPOS\n");
  run.run(5);
  EXPECT_EQ(run.variable("a"), 1234);
}

// SYNCVFLIMIT: behind a master that speeds up the filter would hold back 10,000 counts.
TEST(Mco305Following, FadesItsFilterWhereItHoldsBackTooMuch) {
  std::int32_t farthest[2];
  double smooth[2];
  for (const int limits : {0, 1}) {
    Following run;
    DINT turned = 0;
    run.object.master.signal = &turned;
    run.set("SYNCVFTIME", -200'000);
    run.set("SYNCVFLIMIT", limits * 500);
    run.begin_with("SYNCP\n");
    double velocity = 0.0, place = 0.0;
    farthest[limits] = 0;
    const auto turn = [&](int steps, double to) {
      double changes = 0.0;
      for (int i = 0; i < steps; ++i) {
        velocity = std::min(velocity + 0.1, to);
        turned = static_cast<DINT>(place += velocity);
        const double before = run.device().set_velocity_now();
        run.step();
        changes = std::max(changes, std::abs(run.device().set_velocity_now() - before));
        farthest[limits] =
            std::max(farthest[limits], std::abs(run.device().master().shown() - run.device().set_units()));
      }
      return changes;
    };
    turn(1000, 50.0);
    turn(40'000, 50.0);
    turned += 20;
    place += 20.0;
    smooth[limits] = turn(50, 50.0);
  }
  EXPECT_GT(farthest[0], 3000);
  EXPECT_LT(farthest[1], farthest[0] / 2);
  EXPECT_LT(smooth[0], 0.6) << "a leap of the master is smoothed";
  EXPECT_NEAR(smooth[1], smooth[0], 0.05) << "later on with the whole filter again";
}

// SYNCMFPAR 64: what markers are apart is known when SYNCM begins.
TEST(Mco305Following, AveragesMarkersWhileItDoesNotFollow) {
  for (const int bits : {0, 64}) {
    Following run;
    DINT turned = 0;
    run.object.master.signal = &turned;
    run.object.settings.master_marks = {.period = 4040.0};
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMFTIME", 1000.0},
                                      {"SYNCMFPAR", bits * 1.0}})
      run.set(name, value);
    run.begin_with("WAITI 1 ON\nSYNCM\n");
    const auto turn = [&](int steps) {
      for (int i = 0; i < steps; ++i) turned += 20, run.step();
    };
    turn(100'000);  // some 495 markers
    EXPECT_NEAR(run.system_variable(4238), bits == 0 ? 0 : 4040, 3) << "what is averaged is told";
    run.device().io().set_input(1, true);
    turn(1000);
    EXPECT_NEAR(run.system_variable(4238), bits == 0 ? 4000 : 4040, 3);
    EXPECT_NEAR(run.system_variable(4244), bits == 0 ? 0 : -649, 30);
  }
}

// EN 33-28: "Marker averaging and marker check are also executed when SYNCM is inactive."
TEST(Mco305Following, ChecksMarkersWhileItDoesNotFollow) {
  constexpr std::int32_t kMissed = 32;
  for (const int bits : {0, 64}) {
    Following run;
    DINT turned = 0;
    bool missing = false;
    run.object.master.signal = &turned;
    run.object.settings.master_marks = {.period = 4000.0, .missing = &missing};
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMWINM", 200.0},
                                      {"SYNCMFTIME", 1000.0},
                                      {"SYNCMFPAR", bits * 1.0}})
      run.set(name, value);
    run.begin_with("");
    const auto turn = [&](int markers) {
      for (int i = 0; i < markers * 200; ++i) turned += 20, run.step();
    };
    for (const int gap : {1, 3, 100}) {
      turn(10);
      EXPECT_EQ(run.device().sync_status() & kMissed, 0) << gap;
      missing = true;
      turn(gap);
      missing = false;
      turn(1);
      EXPECT_EQ(run.device().sync_status() & kMissed, bits == 0 ? 0 : kMissed) << gap;
      turn(1);
      EXPECT_EQ(run.device().sync_status() & kMissed, 0) << gap;
    }
  }
}

// SYNCMARKM, SYNCMARKS: each marker of the master with every third of the slave, and the other way round.
TEST(Mco305Following, PairsMarkersByTheirNumbers) {
  for (const bool more_of_the_slave : {true, false}) {
    Following run;
    DINT turned = 0;
    run.object.master.signal = &turned;
    const double many = 1500.0, few = 4500.0;
    run.object.settings.master_marks = {.period = more_of_the_slave ? few : many};
    run.object.settings.markers = {.position = 400.0, .period = more_of_the_slave ? many : few};
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMTYPS", 2.0},
                                      {"SYNCMPULSM", more_of_the_slave ? few : many},
                                      {"SYNCMPULSS", more_of_the_slave ? many : few},
                                      {"SYNCMWINM", 100.0},
                                      {"SYNCMWINS", 100.0},
                                      {"SYNCMARKM", more_of_the_slave ? 1.0 : 3.0},
                                      {"SYNCMARKS", more_of_the_slave ? 3.0 : 1.0},
                                      {"SYNCMSTART", 5.0}})
      run.set(name, value);
    run.begin_with("SYNCM\n");
    run.run(5);
    const auto turn = [&](int steps) {
      for (int i = 0; i < steps; ++i) turned += 20, run.step();
      return run.device().set_position() - turned;
    };
    const double apart = turn(8000);
    EXPECT_NEAR(std::remainder(apart - 400.0, many), 0.0, 1.0) << "a marker beside a marker";
    EXPECT_NEAR(turn(4000), apart, 1.0) << "and it stays";
    EXPECT_EQ(run.device().sync_status() & (mco305::kMasterMissed | mco305::kSlaveMissed), 0);
  }
}

/// Mean, over the last markers, of how far the slave's are from where the master's say.
double mean_deviation(Following& run, int steps) {
  double sum = 0.0;
  int pairs = 0;
  std::uint32_t seen = run.device().latches();
  for (int i = 0; i < steps; ++i) {
    run.step();
    if (run.device().latches() == seen) continue;
    seen = run.device().latches();
    // Of the markers, as they lie without noise.
    const double apart = run.device().set_position() - static_cast<double>(run.device().master().position());
    sum += apart;
    ++pairs;
  }
  return sum / pairs;
}

TEST(Mco305Following, KeepsTheMeanUnderNoiseAndLosses) {
  bool missing = false, spurious = false, twice = false;
  Following run;
  run.object.settings.master_marks = {.period = 4000.0,
                                      .noise = 40.0,
                                      .seed = 5,
                                      .missing = &missing,
                                      .spurious = &spurious,
                                      .twice = &twice};
  run.object.settings.markers = {.position = 700.0, .period = 4000.0, .noise = 40.0, .seed = 9};
  for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                    {"SYNCMTYPS", 2.0},
                                    {"SYNCMPULSM", 4000.0},
                                    {"SYNCMPULSS", 4000.0},
                                    {"SYNCMWINM", 400.0},
                                    {"SYNCMWINS", 400.0},
                                    {"SYNCMSTART", 5.0}})
    run.set(name, value);
  run.begin_with("PULSACC 20000\nPULSVEL 10000\nSYNCM\n");
  run.run(5000);
  EXPECT_NEAR(mean_deviation(run, 20'000), 700.0, 12.0);
  spurious = twice = true;
  EXPECT_NEAR(mean_deviation(run, 20'000), 700.0, 12.0) << "what lies outside of the window is noise";
  spurious = twice = false;
  missing = true;
  run.run(350);
  EXPECT_NE(run.device().sync_status() & mco305::kMasterMissed, 0);
  missing = false;
  EXPECT_NEAR(mean_deviation(run, 20'000), 700.0, 12.0);
  EXPECT_EQ(run.device().sync_status() & mco305::kMasterMissed, 0);
  EXPECT_EQ(run.device().sync_status() & mco305::kSlaveMissed, 0);
}

TEST(Mco305Following, CalmsDownWhatMarkersDoToItsVelocity) {
  const auto restlessness = [](double filter, double marker_filter) {
    Following run;
    run.object.settings.master_marks = {.period = 4000.0, .noise = 100.0, .seed = 5};
    run.object.settings.markers = {.period = 4000.0};
    for (const auto& [name, value] : {std::pair{"SYNCMTYPM", 2.0},
                                      {"SYNCMTYPS", 2.0},
                                      {"SYNCMPULSM", 4000.0},
                                      {"SYNCMPULSS", 4000.0},
                                      {"SYNCMSTART", 6.0},
                                      {"SYNCVFTIME", filter},
                                      {"SYNCMFTIME", marker_filter}})
      run.set(name, value);
    run.begin_with("PULSACC 20000\nPULSVEL 5000\nSYNCM\n");
    run.run(20'000);
    double sum = 0.0, squares = 0.0;
    constexpr int kSteps = 40'000;
    for (int i = 0; i < kSteps; ++i) {
      run.step();
      const double v = run.device().set_velocity_now();
      sum += v;
      squares += v * v;
    }
    const double mean = sum / kSteps;
    EXPECT_NEAR(mean, 20.0, 0.02);
    return std::sqrt(squares / kSteps - mean * mean);
  };
  const double hard = restlessness(0, 0), soft = restlessness(-50'000, 2000);
  EXPECT_GT(hard, 0.5);
  EXPECT_LT(soft, 0.2 * hard);
}

}  // namespace
}  // namespace lockstep::following_test
