// Homing that fails, is given up, or is found by a trigger, and what comes behind it.
#include <algorithm>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_homing_test {
namespace {

using linmot::Motor;
using linmot::State;

/// Against a stop at 35 mm, which is called 20; then to -20 and to 0.
Json against_a_stop() {
  Json project = linmot_project("1ms");
  controller_of(project)["motors"]["A"]["fixed_stops"] = Json::parse(
      R"([ { "position": 35.0, "direction": "positive", "stiffness": 1e6, "damping": 1500.0 } ])");
  drive_of(project)["Initialization"] = {{"Init Mode", "Auto Move Out"},
                                         {"Init Config",
                                          {{"Init Speed", 0.05},
                                           {"Maximal Init Current", 10.0},
                                           {"Home Position", 20.0},
                                           {"Check Init Position", -20.0},
                                           {"Initial Position", 0.0}}}};
  return project;
}

Json by_trigger(const char* mode) {
  Json project = linmot_project("1ms");
  drive_of(project)["Initialization"] = {{"Init Mode", mode},
                                         {"Init Config",
                                          {{"Init Speed", 0.05},
                                           {"Maximal Init Current", 50.0},
                                           {"Home Position", 5.0},
                                           {"Check Init Position", 5.0},
                                           {"Initial Position", 5.0}}}};
  return project;
}

const Motor& motor_of(LinMotRun& run) {
  return run.controller().motor(0);
}
/// [mm] Where the slider is on the scale of the machine.
double place_of(LinMotRun& run) {
  return motor_of(run).actual() + motor_of(run).shift();
}

void begin(LinMotRun& run) {
  run.send("!SR-1");
  run.send("!SI-1");
  run.step();
  EXPECT_EQ(run.send("!SI+1"), "#");
}
bool come_to(LinMotRun& run, Motor::Homing homing) {
  for (int i = 0; i < 20'000 && motor_of(run).homing() != homing; ++i) run.step();
  return motor_of(run).homing() == homing;
}
void leave(LinMotRun& run) {
  run.send("!SS-1");
  run.send("!SI-1");
  run.step();
  EXPECT_EQ(run.state(), State::disable);
}

TEST(LinMotHoming, IsTriedAgainAfterItHasFailed) {
  LinMotRun run(against_a_stop());
  begin(run);
  ASSERT_TRUE(come_to(run, Motor::Homing::check));
  run.write("force", 400.0);  // nothing that 0.5 A could overcome
  while (run.state() != State::error && run.time() < 20.0) run.step();
  EXPECT_EQ(run.send("!GS1"), "#E6A");
  run.write("force", 0.0);
  leave(run);
  EXPECT_FALSE(run.motor().InitDone);
  begin(run);
  ASSERT_TRUE(come_to(run, Motor::Homing::done));
  EXPECT_EQ(run.state(), State::init);
  EXPECT_NEAR(motor_of(run).shift(), 15.0, 0.1);
}

TEST(LinMotHoming, FailsTwoSecondsAfterTheTimeOfItsTravel) {
  Json project = against_a_stop();
  drive_of(project)["Position Monitoring"] = {{"Following Error-", 500.0}, {"Following Error+", 500.0}};
  LinMotRun run(project);
  begin(run);
  ASSERT_TRUE(come_to(run, Motor::Homing::check));
  const double begun = run.time();
  run.write("force", 400.0);
  while (run.state() != State::error && run.time() < 20.0) run.step();
  constexpr double kSpeed = 262.0 * 50000.0 / 262144.0;  // [mm/s], in whole increments
  EXPECT_NEAR(run.time() - begun, 40.0 / kSpeed + kSpeed / 30517.578125 + 2.0, 0.003);
  EXPECT_EQ(run.send("!EEA"), "#32");
}

TEST(LinMotHoming, FailsByItsFollowingError) {
  Json project = against_a_stop();
  drive_of(project)["Position Monitoring"] = {{"Following Error-", 5.0}, {"Following Error+", 5.0}};
  LinMotRun run(project);
  begin(run);
  ASSERT_TRUE(come_to(run, Motor::Homing::check));
  const double begun = run.time();
  run.write("force", 400.0);
  while (run.state() != State::error && run.time() < 20.0) run.step();
  EXPECT_LT(run.time() - begun, 0.2);
  EXPECT_EQ(run.send("!GS1"), "#E6A");  // a following error by itself would be E3A
}

// A stop is a stop, also for what homing had still to do.
TEST(LinMotHoming, EndsWithAnEmergencyStop) {
  for (const char* const mode : {"Off", "Freeze", "Goto Position"}) {
    for (const Motor::Homing at : {Motor::Homing::search, Motor::Homing::check, Motor::Homing::initial}) {
      Json project = against_a_stop();
      drive_of(project)["Error Handling"]["Emergency Stop"] = {
          {"Emergency Stop Mode", mode}, {"Emergency Configuration", {{"Stop Position", -50.0}}}};
      LinMotRun run(project);
      begin(run);
      ASSERT_TRUE(come_to(run, at)) << mode;
      run.run(0.2);
      EXPECT_EQ(run.send("!SS+1"), "#");
      run.run(0.1);
      const double stood = place_of(run);
      run.samples.clear();
      run.run(3.0);
      EXPECT_EQ(run.state(), State::stop);
      EXPECT_NEAR(place_of(run), stood, 0.01) << mode;
      for (const auto& one : run.samples) {
        ASSERT_EQ(one.velocity, 0.0) << mode;
        ASSERT_LE(std::abs(one.current), 0.5) << mode;  // as much as homing may take
      }
      EXPECT_FALSE(run.motor().InitDone);
      leave(run);
      begin(run);
      ASSERT_TRUE(come_to(run, Motor::Homing::done)) << mode;
      EXPECT_NEAR(motor_of(run).shift(), 15.0, 0.1);
    }
  }
}

TEST(LinMotHoming, GivesTheMotorItsWholeCurrentWhenItIsDone) {
  LinMotRun run(against_a_stop());
  run.start();
  run.write("force", -100.0);
  run.run(0.2);
  EXPECT_NEAR(run.motor().DemandCurrent, 100.0 / 40.0, 0.3);  // 10 N of it by the friction
}

TEST(LinMotHoming, FindsNoTriggerAnyMoreOnceAnErrorHasEndedIt) {
  LinMotRun run(by_trigger("Trig Move Out"));
  begin(run);
  run.run(0.1);
  run.write("missing", 1);
  run.step();
  EXPECT_EQ(run.state(), State::error);
  run.write("missing", 0);
  leave(run);
  const double shift = motor_of(run).shift();
  run.write("t_a", 1);
  run.run(0.2);
  EXPECT_FALSE(run.motor().InitDone);
  EXPECT_EQ(motor_of(run).shift(), shift);
  EXPECT_EQ(motor_of(run).homing(), Motor::Homing::none);
}

// The trigger of a motor on PROFIBUS is a bit of the control word.
TEST(LinMotHoming, FindsTheTriggerOfTheControlWord) {
  for (const bool wired : {false, true}) {
    Json project = by_trigger("Trig Move In");
    project.erase("ascii");
    controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
    controller_of(project)["profibus"] = {{"modules", {"Control/Status", "Get Position"}}};
    LinMotRun run(project);
    run.step();
    while (!run.motor().InitDone && run.time() < 5.0) {
      const bool found = place_of(run) <= -3.0;
      run.write("C.ProfibusOut[1]", 0x0008 | (found && !wired ? 0x0100 : 0) | 0x0E00);  // B to D do not count
      if (wired) run.write("t_a", found ? 1 : 0);
      run.step();
    }
    ASSERT_TRUE(run.motor().InitDone) << wired;
    EXPECT_NEAR(motor_of(run).shift(), -8.0, 0.2) << wired;
    EXPECT_NEAR(static_cast<int>(run.controller().data.ProfibusIn[1]), 256, 13) << wired;  // 5 mm
  }
}

TEST(LinMotInputs, AreReadWhereIoConfigurationSaysSo) {
  for (const bool reads : {true, false}) {
    Json project = linmot_project("1ms");
    controller_of(project)["config"]["System"]["IO Configuration"]["Analog / Trig Drive A"] = reads;
    LinMotRun armed(project);
    armed.start();
    EXPECT_EQ(armed.send("!TP2560A"), "#");
    armed.write("t_a", 1);
    armed.run(0.3);
    EXPECT_NEAR(armed.motor().SetPoint, reads ? 50.0 : 0.0, 1e-9);
    drive_of(project)["Set Value Generation"] = {
        {"Run Mode", "Analog"},
        {"Set Value Configuration", {{"0V Position", -10.0}, {"10V Position", 30.0}}}};
    LinMotRun analog(project);
    analog.write("volts", 5.0);
    analog.start();
    analog.run(0.3);
    EXPECT_NEAR(analog.motor().SetPoint, reads ? 10.0 : -10.0, 1e-9);
  }
}

}  // namespace
}  // namespace lockstep::linmot_homing_test
