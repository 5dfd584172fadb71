// The set-point where one motion takes over from another: whatever is asked for, and when, it does not step.
#include <algorithm>
#include <cmath>

#include "tests/projects/linmot/bus.hpp"
#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_continuity_test {
namespace {

constexpr double kSpeed = 0.78125;                           // [m/s] the basic setting
constexpr double kAcceleration = 30.517578125;               // [m/s²]
constexpr double kCycle = 1e-4;                              // [s] a tick of these runs is a control cycle
constexpr double kDistance = kSpeed * 1e3 * kCycle * 1.001;  // [mm] at most from one to the next

const std::string kOffset = "C.A.SetValueGeneration.SetValueConfiguration.CurvePosOffset";

Json with_curves(Json project) {
  controller_of(project)["curves"] = Json::parse(
      R"({ "1": { "end": 30.0, "time": "200ms" }, "2": { "start": 30.0, "end": 0.0, "time": "100ms" } })");
  controller_of(project).erase("motors");  // the set-point alone
  return project;
}

/// [mm] The largest step from one control cycle to the next since a time.
double largest_step(const LinMotRun& run, double from) {
  double largest = 0.0;
  for (std::size_t i = 1; i < run.samples.size(); ++i)
    if (run.samples[i].time >= from)
      largest = std::max(largest, std::abs(run.samples[i].setpoint - run.samples[i - 1].setpoint));
  return largest;
}

/// [m/s²] The largest change of velocity that three set-points in a row have.
double largest_bend(const LinMotRun& run, double from) {
  double largest = 0.0;
  for (std::size_t i = 2; i < run.samples.size(); ++i) {
    if (run.samples[i].time < from) continue;
    const double bend =
        run.samples[i].setpoint - 2.0 * run.samples[i - 1].setpoint + run.samples[i - 2].setpoint;
    largest = std::max(largest, std::abs(bend) * 1e-3 / (kCycle * kCycle));
  }
  return largest;
}

TEST(LinMotContinuity, OfACurveFromTheDemandThatBeginsInMotion) {
  for (const char* const command : {"!RA1A", "!CA1A", "!TA1A", "!CB1A"}) {
    LinMotRun run(with_curves(linmot_project()));
    run.start();
    EXPECT_EQ(run.send("!SP5120A"), "#");
    run.run(0.05);
    const double from = run.time();
    EXPECT_EQ(run.send(command), "#");
    run.run(0.01);
    run.write("t_a", 1);
    run.run(0.05);
    EXPECT_TRUE(run.motor().CurveActive) << command;
    EXPECT_LT(largest_step(run, from), kDistance) << command;
    // The offset is where the set-point was when the curve began, and no end of a motion that is over.
    EXPECT_LT(run.read(kOffset), 50.0) << command;
    EXPECT_GT(run.read(kOffset), 20.0) << command;
  }
}

TEST(LinMotContinuity, OfACurveFromTheDemandThatWaitsWhileFrozen) {
  LinMotRun run(with_curves(linmot_project()));
  run.start();
  EXPECT_EQ(run.send("!SP5120A"), "#");
  run.run(0.05);
  const double from = run.time();
  EXPECT_EQ(run.send("!SF+A"), "#");
  EXPECT_EQ(run.send("!RA1A"), "#");  // it still brakes
  run.run(0.1);
  const double stands = run.motor().SetPoint;
  EXPECT_EQ(run.send("!SF-A"), "#");
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, stands + 30.0, 1e-9);
  EXPECT_EQ(run.read(kOffset), stands);
  EXPECT_LT(largest_step(run, from), kDistance);
}

Json bus(const Json& modules) {
  Json project = with_curves(linmot_project());
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  controller_of(project)["profibus"] = {{"modules", modules}, {"preset", {{"Max. Speed", 4096}}}};
  return project;
}

TEST(LinMotContinuity, OfAnIncrementalCurveWhoseTelegramHasAnotherSpeed) {
  Bus run(bus({"Control/Status", "Set Position", "Run Curve", "Max. Speed"}));
  run.into_run();
  run.out(2, 512);
  run.run(0.2);
  ASSERT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
  const double from = run.time();
  run.out(3, 0x9001);
  run.out(4, 2048);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 40.0, 1e-9);
  EXPECT_EQ(run.read(kOffset), 10.0);
  EXPECT_LT(largest_step(run, from), kDistance);
}

TEST(LinMotContinuity, OfACurveInTheTelegramThatFreezes) {
  Bus run(bus({"Control/Status", "Set Position", "Run Curve", "Max. Speed"}));
  run.into_run();
  run.out(2, 512);
  run.run(0.2);
  run.out(1, 0x1002);
  run.out(3, 0x8001);
  run.run(0.1);
  EXPECT_TRUE(run.motor().Frozen);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9) << "a frozen motor does not move";
  run.out(1, 0x0002);  // and then it does what has been called
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 30.0, 1e-9);
}

Json trigger_curve() {
  Json project = with_curves(linmot_project());
  drive_of(project)["Set Value Generation"] = {
      {"Run Mode", "Trigger Curve"},
      {"Set Value Configuration", {{"Rise Curve Number", 1}, {"Fall Curve Number", 2}}}};
  return project;
}

/// The set-point after edges of the trigger, each at its time since the first [s].
double after_edges(std::initializer_list<double> times, double end) {
  LinMotRun run(trigger_curve());
  run.start();
  const double begin = run.time();
  int level = 0;
  for (const double time : times) {
    run.until(begin + time);
    run.write("t_a", level = 1 - level);
  }
  run.until(begin + end);
  EXPECT_LT(largest_step(run, begin), kDistance);
  return run.motor().SetPoint;
}

TEST(LinMotContinuity, OfCurvesWhoseTriggerComesWhileOneRuns) {
  // A rise while the fall curve runs: the rise curve is behind it.
  EXPECT_NEAR(after_edges({0.0, 0.25, 0.3}, 0.349), 0.0, 0.01);
  EXPECT_NEAR(after_edges({0.0, 0.25, 0.3}, 0.6), 30.0, 1e-9);
  // A pulse meanwhile is not lost: up and down once more.
  EXPECT_NEAR(after_edges({0.0, 0.25, 0.3, 0.32}, 0.549), 30.0, 0.01);
  EXPECT_NEAR(after_edges({0.0, 0.25, 0.3, 0.32}, 0.7), 0.0, 1e-9);
  // Down and up again while the rise curve runs: it ends where the trigger wants it.
  EXPECT_NEAR(after_edges({0.0, 0.05, 0.1}, 0.6), 30.0, 1e-9);
  EXPECT_NEAR(after_edges({0.0, 0.05, 0.1, 0.15}, 0.6), 0.0, 1e-9);
}

TEST(LinMotContinuity, OfAMotionThatTakesOverFromACurve) {
  for (const char* const command : {"!SP0A", "!IP512A", "!SS+1"}) {
    Json project = with_curves(linmot_project());
    drive_of(project)["Error Handling"]["Emergency Stop"]["Emergency Stop Mode"] = "Freeze";
    LinMotRun run(project);
    run.start();
    EXPECT_EQ(run.send("!RC1A"), "#");
    run.run(0.08);
    const double from = run.time();
    EXPECT_EQ(run.send(command), "#");
    run.run(0.05);
    EXPECT_LT(largest_bend(run, from), kAcceleration * 1.001) << command;
  }
}

TEST(LinMotContinuity, OfLimitsThatChangeWhileFrozen) {
  LinMotRun run(with_curves(linmot_project()));
  run.start();
  EXPECT_EQ(run.send("!SP5120A"), "#");
  run.run(0.04);
  EXPECT_EQ(run.send("!SF+A"), "#");
  run.run(0.1);
  EXPECT_EQ(run.send("!SV1024A"), "#");
  EXPECT_EQ(run.send("!SF-A"), "#");
  run.run(0.1);
  EXPECT_NEAR(run.motor().SetPointVelocity, 1024 * 50000.0 / 262144.0 * 1e-3, 1e-9);
}

}  // namespace
}  // namespace lockstep::linmot_continuity_test
