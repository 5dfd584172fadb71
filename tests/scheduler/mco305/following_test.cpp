// What the scenarios do not say of synchronizing: commands in their order, a drive, markers with all that
// goes wrong with them.
#include <cmath>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep {
namespace following_test {
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
}  // namespace following_test
}  // namespace lockstep
