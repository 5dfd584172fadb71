// What a LinMot controller does where no scenario looks: printed examples of commands, and the decisions of
// its README.
#include <algorithm>

#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_behaviour_test {
namespace {

using linmot::State;

Json four_motors() {
  Json project = linmot_project("1ms");
  for (const char* const letter : {"B", "C", "D"}) {
    drive_of(project, letter) = drive_of(project);
    controller_of(project)["motors"][letter] = controller_of(project)["motors"]["A"];
  }
  controller_of(project)["curves"] = Json::parse(
      R"({ "1": { "type": "Minimal Jerk", "end": 30.0, "time": "200ms" }, "2": { "type": "Minimal Jerk", "end": 10.0, "time": "50ms" } })");
  return project;
}

// ---- ASCII: every example that is printed with a command

TEST(LinMotAscii, AnswersEveryPrintedExample) {
  Json project = four_motors();
  drive_of(project)["Set Value Generation"]["Set Value Configuration"]["Maximal Position"] =
      11225 * 5.0 / 256.0;
  LinMotRun run(project);
  run.start();
  int examples = 0;
  for (const Json& command : linmot_document("ascii_protocol").at("commands")) {
    if (command.at("example").is_null()) continue;
    const std::string request = command.at("example").at("request"),
                      reply = command.at("example").at("reply");
    ++examples;
    // What a reply needs that is no answer of a setting.
    if (request == "!EX1") {
      run.run(0.5);
      EXPECT_EQ(std::stoi(run.send(request).substr(1)) & ~0xE,
                std::stoi(reply.substr(1)));  // B to D are there too
      continue;
    }
    if (request == "!GX1") {
      EXPECT_EQ(run.send("!SF+B"), "#");
      EXPECT_EQ(run.send("!SF+C"), "#");
    }
    if (request == "!GPA") {
      EXPECT_EQ(run.send("!SP256A"), "#");
      run.run(1.0);
      EXPECT_NEAR(std::stoi(run.send(request).substr(1)), std::stoi(reply.substr(1)), 13);
      continue;
    }
    if (request == "!REA") {
      std::size_t number = linmot::system_parameters().size();
      for (const linmot::Parameter& parameter : linmot::motor_parameters()) {
        if (parameter.path == "Set Value Generation\\Set Value Configuration\\Maximal Position") break;
        ++number;
      }
      EXPECT_EQ(run.send("!AS0A"), "#");
      EXPECT_EQ(run.send("!AO" + std::to_string(2 * number) + "A"), "#");
    }
    EXPECT_EQ(run.send(request), reply) << command;
    if (request == "!GX1") {
      run.send("!SF-B");
      run.send("!SF-C");
    }
    if (request == "!SF+A") run.send("!SF-A");
    if (request == "!SS+1") {
      run.send("!SS-1");
      run.send("!SR-1");
      run.start();
    }
    if (request == "!SI+1") run.send("!SI-1");
  }
  EXPECT_GE(examples, 18);
}

TEST(LinMotAscii, WritesParametersByTheirAddress) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  std::size_t speed = linmot::system_parameters().size();
  while (linmot::motor_parameters()[speed - linmot::system_parameters().size()].path !=
         "Set Value Generation\\Filter Parameter\\Max Speed")
    ++speed;
  EXPECT_EQ(run.send("!AO" + std::to_string(2 * speed) + "A"), "#");
  EXPECT_EQ(run.send("!RDA"), "#4096");
  EXPECT_EQ(run.send("!WR2048A"), "#");
  EXPECT_EQ(run.send("!GVA"), "#2048");
  EXPECT_EQ(run.send("!WR65000A"), "#E64");  // beyond its range
  EXPECT_EQ(run.send("!WS4096A"), "#");
  EXPECT_EQ(run.send("!RDA"), "#128");  // the next one: Max Acceleration
  EXPECT_EQ(run.send("!GVA"), "#4096");
  EXPECT_EQ(run.send("!AO1A"), "#E64");
  EXPECT_EQ(run.send("!AS1A"), "#");
  EXPECT_EQ(run.send("!RDA"), "#0");
  EXPECT_EQ(run.send("!WR1A"), "#E64");
  EXPECT_EQ(run.send("!AS0A"), "#");
  EXPECT_EQ(run.send("!AO0A"), "#");
  EXPECT_EQ(run.send("!WR1A"), "#E64");  // nobody writes what the controller tells of itself
}

TEST(LinMotAscii, ReplacesAnArmedMotionAndForgetsItWithRun) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  EXPECT_EQ(run.send("!TP2560A"), "#");
  EXPECT_EQ(run.send("!TP512A"), "#");
  run.write("t_a", 1);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
  run.write("t_a", 0);
  EXPECT_EQ(run.send("!TP2560A"), "#");
  run.send("!SR-1");
  run.step();
  run.send("!SR+1");
  run.step();
  ASSERT_EQ(run.state(), State::run);
  const double stood = run.motor().DemandPosition;
  run.write("t_a", 1);
  run.run(0.3);
  EXPECT_EQ(run.motor().DemandPosition, stood);
}

TEST(LinMotAscii, LetsADemandCountFromRunOn) {
  LinMotRun run(linmot_project("1ms"));
  EXPECT_EQ(run.send("!SR-1"), "#");
  EXPECT_EQ(run.send("!SI-1"), "#");
  run.send("!SI+1");
  run.send("!SI-1");
  run.step();
  ASSERT_EQ(run.state(), State::disable);
  EXPECT_EQ(run.send("!SP512A"), "#");
  run.run(0.1);
  EXPECT_EQ(run.motor().DemandCurrent, 0.0);
  run.send("!SR+1");
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
}

// ---- Names of positions

TEST(LinMotNames, ChangeWithoutAMotion) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  run.send("!SP512A");
  run.run(1.0);
  const double place = run.controller().motor(0).actual() + run.controller().motor(0).shift();
  run.samples.clear();
  EXPECT_EQ(run.send("!RP0A"), "#");
  run.run(0.2);
  EXPECT_EQ(run.send("!GPA"), "#0");
  EXPECT_NEAR(run.controller().motor(0).actual() + run.controller().motor(0).shift(), place, 1e-6);
  for (const auto& one : run.samples) EXPECT_EQ(one.velocity, 0.0);
  EXPECT_EQ(run.read("C.A.SetValueGeneration.SetValueConfiguration.MinimalPosition"), -630.0);
  EXPECT_EQ(run.send("!SP2560A"), "#");
  EXPECT_EQ(run.send("!RP0A"), "#E54");  // not while it moves
}

// ---- Errors, warnings, display

TEST(LinMotErrors, ShowTheCodesOfTheirVersion) {
  for (const bool second : {true, false}) {
    Json project = four_motors();
    if (second) {
      controller_of(project)["hardware"] = "E400";
      for (const char* const letter : {"A", "B", "C", "D"}) {
        drive_of(project, letter)["Control Parameters"]["Maximal Current"] = 2.0;
      }
    }
    controller_of(project)["faults"]["B"] = {{"slider_missing", "missing"}};
    controller_of(project)["faults"].erase("A");
    LinMotRun run(project);
    run.start();
    EXPECT_EQ(static_cast<int>(run.controller().data.Display), 0);
    run.write("missing", 1);
    run.step();
    EXPECT_EQ(run.state(), State::error);
    EXPECT_EQ(static_cast<int>(run.controller().data.Display), second ? 0x24 : 0x0204);
    EXPECT_EQ(run.send("!GS1"), "#E4B");
    EXPECT_EQ(run.send("!EEB"), "#8");
    // The position is lost: no RUN without another INIT.
    run.write("missing", 0);
    run.send("!SR-1");
    run.step();
    EXPECT_EQ(run.state(), State::disable);
    EXPECT_FALSE(run.motor(1).InitDone);
    EXPECT_TRUE(run.motor(0).InitDone);
    run.send("!SR+1");
    run.step();
    EXPECT_EQ(run.state(), State::disable);
  }
}

// Whoever has the error, and at once.
TEST(LinMotErrors, TakeTheCurrentOfEveryMotor) {
  LinMotRun run(four_motors());
  run.start();
  for (const char* const motor : {"A", "B", "C", "D"})
    EXPECT_EQ(run.send(std::string("!SP5120") + motor), "#");
  run.run(0.02);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NE(run.motor(i).DemandCurrent, 0.0) << i;
  run.write("hot", 1);
  run.write("missing", 1);  // that of A
  run.step();
  EXPECT_EQ(run.state(), State::error);
  run.step();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(run.motor(i).DemandCurrent, 0.0) << i;
}

TEST(LinMotErrors, CalculateATemperatureWhereOneIsDescribed) {
  Json project = linmot_project("1ms");
  controller_of(project)["motors"]["A"]["inclination"] = 90.0;
  controller_of(project)["motors"]["A"]["friction"] = 0.0;
  // It holds 0.4976 A: (0.4976 / 0.4)² = 155 % in the end.
  controller_of(project)["motors"]["A"]["thermal"] = {
      {"nominal_current", 0.4}, {"time_constant", "10s"}, {"warn", 80.0}, {"error", 120.0}};
  LinMotRun run(project);
  run.start();
  const double begin = run.time();
  double warned = 0.0;
  while (run.state() == State::run && run.time() < 60.0) {
    run.step();
    if (warned == 0.0 && (static_cast<int>(run.motor().Warnings) & 1) != 0) warned = run.time() - begin;
  }
  const double end = 100.0 * 0.49761 * 0.49761 / (0.4 * 0.4);
  EXPECT_NEAR(warned, -10.0 * std::log(1.0 - 80.0 / end), 0.15);
  EXPECT_NEAR(run.time() - begin, -10.0 * std::log(1.0 - 120.0 / end), 0.15);
  EXPECT_EQ(run.send("!GS1"), "#E1A");
  EXPECT_EQ(run.send("!EEA"), "#1");
}

TEST(LinMotErrors, GoOnWithAFollowingErrorThatAMaskHides) {
  Json project = linmot_project("1ms");
  drive_of(project)["Position Monitoring"] = {{"Following Error-", 2.0}, {"Following Error+", 2.0}};
  drive_of(project)["Error Handling"]["Error Mask"]["Drive Following Error"] = false;
  LinMotRun run(project);
  run.start();
  run.write("force", -150.0);
  run.run(0.5);
  EXPECT_EQ(run.state(), State::run);
  EXPECT_EQ(std::stoi(run.send("!EWA").substr(1)) & 4, 4);
}

TEST(LinMotErrors, FindAnotherTypeThanTheConfiguredOne) {
  Json project = linmot_project("1ms");
  controller_of(project)["motors"]["A"]["type"] = "LinMot P0x-23";
  LinMotRun run(project);
  run.step();
  EXPECT_EQ(run.state(), State::error);
  EXPECT_EQ(run.send("!GS1"), "#E7A");
}

// ---- Starting

TEST(LinMotStart, RunsByItselfWithAutoStart) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  controller_of(project)["config"]["System"] = {{"Command Interface", "AT"},
                                                {"Startup Mode", {{"Auto Start", true}}}};
  LinMotRun run(project);
  run.run(0.1);
  EXPECT_EQ(run.state(), State::run);
  // A request that comes and goes is one as any other.
  controller_of(project)["config"]["System"]["IO Configuration"]["Run Input"] = true;
  controller_of(project)["io"]["RUN"] = "r";
  LinMotRun requested(project);
  requested.run(0.1);
  requested.write("r", 1);
  requested.step();
  requested.write("r", 0);
  requested.run(0.01);
  EXPECT_EQ(requested.state(), State::disable);
}

Json homing_of(bool together) {
  Json project = four_motors();
  controller_of(project)["config"]["System"]["Startup Mode"]["Init Together"] = together;
  for (const char* const letter : {"A", "B", "C", "D"}) {
    drive_of(project, letter)["Initialization"] = {{"Init Mode", "Auto Move Out"},
                                                   {"Init Config",
                                                    {{"Init Speed", 0.05},
                                                     {"Maximal Init Current", 10.0},
                                                     {"Home Position", 0.0},
                                                     {"Check Init Position", -5.0},
                                                     {"Initial Position", -5.0}}}};
    controller_of(project)["motors"][letter]["fixed_stops"] = Json::parse(
        R"([ { "position": 10.0, "direction": "positive", "stiffness": 1e6, "damping": 1500.0 } ])");
  }
  return project;
}

/// When each motor is homed [s].
std::vector<double> homed_at(const Json& project) {
  LinMotRun run(project);
  run.send("!SR-1");
  run.send("!SI-1");
  run.step();
  run.send("!SI+1");
  std::vector<double> at(4, 0.0);
  while (run.time() < 10.0 && *std::min_element(at.begin(), at.end()) == 0.0) {
    run.step();
    for (std::size_t i = 0; i < 4; ++i)
      if (at[i] == 0.0 && run.motor(i).InitDone) at[i] = run.time();
  }
  return at;
}

TEST(LinMotStart, HomesTogetherOrOneAfterTheOther) {
  const std::vector<double> together = homed_at(homing_of(true)), in_turn = homed_at(homing_of(false));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(together[i], together[0], 1e-9);
    EXPECT_NEAR(in_turn[i], (static_cast<double>(i) + 1.0) * together[0], 0.03);
  }
}

TEST(LinMotStart, HomesOnceWhereThatIsAskedFor) {
  Json project = homing_of(true);
  drive_of(project)["Initialization"]["Init Switches"]["Init Once"] = true;
  LinMotRun run(project);
  run.start();
  run.send("!SR-1");
  run.step();
  EXPECT_EQ(run.send("!SI+1"), "#");
  run.step();
  EXPECT_EQ(run.state(), State::init);
  EXPECT_TRUE(run.motor(0).InitDone);
  EXPECT_FALSE(run.motor(1).InitDone);
}

TEST(LinMotStart, BrakesWhereHomingIsGivenUp) {
  LinMotRun run(homing_of(true));
  run.send("!SR-1");
  run.send("!SI-1");
  run.step();
  run.send("!SI+1");
  run.run(0.1);
  EXPECT_NEAR(run.motor().SetPointVelocity, 0.05, 1e-3);
  run.send("!SI-1");
  run.run(0.1);
  EXPECT_EQ(run.state(), State::disable);
  EXPECT_FALSE(run.motor().InitDone);
  EXPECT_EQ(run.motor().DemandCurrent, 0.0);
  EXPECT_NEAR(run.motor().ActualVelocity, 0.0, 1e-6);
}

// ---- Run modes and limits

TEST(LinMotRunMode, GoesToOneOfTwoPoints) {
  Json project = linmot_project("1ms");
  drive_of(project)["Set Value Generation"] = {
      {"Run Mode", "Two Point"},
      {"Set Value Configuration", {{"'0' Position", -5.0}, {"'1' Position", 20.0}}}};
  LinMotRun run(project);
  run.start();
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, -5.0, 1e-9);
  run.write("t_a", 1);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 20.0, 1e-9);
  EXPECT_EQ(run.send("!SP0A"), "#E66");
}

TEST(LinMotLimits, CutDemandAndCurve) {
  Json project = four_motors();
  drive_of(project)["Set Value Generation"]["Set Value Configuration"] = {{"Minimal Position", -3.0},
                                                                          {"Maximal Position", 12.0}};
  LinMotRun run(project);
  run.start();
  run.send("!SP2560A");
  run.run(0.5);
  EXPECT_EQ(run.motor().SetPoint, 12.0);
  run.send("!SP-2560A");
  run.run(0.5);
  EXPECT_EQ(run.motor().SetPoint, -3.0);
  run.send("!SP0A");
  run.run(0.5);
  run.samples.clear();
  run.send("!RC1A");
  run.run(0.5);
  for (const auto& one : run.samples) EXPECT_LE(one.setpoint, 12.0);
  EXPECT_EQ(run.motor().SetPoint, 12.0);
  EXPECT_EQ(run.state(), State::run);
}

TEST(LinMotLimits, HaveTheRangeOfTheHardware) {
  Json project = linmot_project("1ms");
  controller_of(project)["hardware"] = "E100";
  LinMotRun run(project);
  run.start();
  run.write("force", -150.0);
  double largest = 0.0;
  while (run.time() < 1.0) {
    run.step();
    largest = std::max(largest, run.motor().DemandCurrent);
  }
  EXPECT_EQ(largest, 2.0);  // of the 5 A that are asked for
}

TEST(LinMotCurve, FreezesAlongItself) {
  Json project = four_motors();
  LinMotRun run(project);
  run.start();
  run.send("!RC1A");
  run.run(0.09);
  const double velocity = run.motor().SetPointVelocity;
  ASSERT_GT(velocity, 0.2);
  EXPECT_EQ(run.send("!SF+A"), "#");
  run.run(0.1);
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
  EXPECT_FALSE(run.motor().InPosition);
  const double frozen = run.motor().SetPoint;
  EXPECT_GT(frozen, 1.0);
  EXPECT_LT(frozen, 29.0);
  run.run(0.2);
  EXPECT_EQ(run.motor().SetPoint, frozen);
  EXPECT_EQ(run.send("!SF-A"), "#");
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, 30.0, 1e-9);
  EXPECT_TRUE(run.motor().InPosition);
}

// ---- What is refused is logged

Json table(const std::string& rows, const std::string& codes) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  controller_of(project)["config"]["System"] = {{"Command Interface", "MT"},
                                                {"Startup Mode", {{"Auto Start", true}}}};
  controller_of(project)["config"]["Multi Trigger"]["Jitter Filter"]["Time"] = 0.0;
  controller_of(project)["state_table"] = Json::parse(rows);
  controller_of(project)["input_table"] = Json::parse(codes);
  return project;
}

constexpr int kRefused = 1 << 15;
int logged(LinMotRun& run) {
  return static_cast<int>(run.controller().data.LoggedWarnings);
}

TEST(LinMotTable, StaysAtItsEnds) {
  LinMotRun run(table(R"({ "0": { "A": { "Abs. Position": [5, 0.5, 10] } } })",
                      R"({ "0001": "Goto next state", "0010": "Goto previous state" })"));
  run.run(0.01);
  ASSERT_EQ(run.state(), State::run);
  run.write("t_a", 1);
  run.run(0.3);
  EXPECT_EQ(run.controller().data.StateNumber, 0);  // the first "next" is row 0
  EXPECT_EQ(logged(run) & kRefused, 0);
  run.write("t_a", 0);
  run.step();
  run.write("t_b", 1);
  run.step();
  EXPECT_EQ(run.controller().data.StateNumber, 0);
  EXPECT_EQ(logged(run) & kRefused, kRefused);
}

TEST(LinMotTable, RenamesPositionsAtRestAlone) {
  LinMotRun run(
      table(R"({ "0": { "A": { "Abs. Position": [50, 0.5, 10] } }, "1": { "A": { "Redefine Position": [0] } },
                           "2": { "A": { "Move Home Position": [5] } } })",
            R"({ "0001": ["Goto state", 0], "0010": ["Goto state", 1], "0100": ["Goto state", 2] })"));
  run.run(0.01);
  run.write("t_a", 1);
  run.run(0.02);
  run.write("t_a", 0);
  run.write("t_b", 1);
  run.step();
  EXPECT_EQ(logged(run) & kRefused, kRefused);
  EXPECT_NEAR(run.motor().DemandPosition, 50.0, 1e-9);
  run.run(0.5);
  run.write("t_b", 0);
  run.write("t_c", 1);
  run.run(0.01);
  EXPECT_NEAR(run.motor().SetPoint, 45.0, 1e-9);  // the zero has moved
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
}

TEST(LinMotProfibus, DoesNothingWithAnUnknownCommand) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  controller_of(project)["profibus"] = {
      {"modules", {"Control/Status", "Command", "Set Position", "Get Position"}}};
  LinMotRun run(project);
  const auto out = [&run](int word, int value) {
    run.write("C.ProfibusOut[" + std::to_string(word) + "]", value);
  };
  run.step();
  out(1, 0x0008);
  run.run(0.01);
  out(1, 0x0002);
  run.run(0.01);
  ASSERT_EQ(run.state(), State::run);
  out(2, 0x1877);  // motor A, toggle, command 77
  run.run(0.01);
  EXPECT_EQ(logged(run) & kRefused, kRefused);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[0]) & 0x20, 0);  // CMD Executed
  // Redefine locks Set Position until Unlock.
  out(3, 256);
  out(2, 0x1801);
  run.run(0.01);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[0]) & 0x20, 0x20);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[1]), 256);
  out(4, 512);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 5.0, 0.01);
  out(2, 0x1003);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[0]) & 0x20, 0);
}

TEST(LinMotProfibus, RunsCurvesOneBehindTheOtherAndAgainAndAgain) {
  Json project = four_motors();
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  controller_of(project)["curves"]["3"] = Json::parse(R"({ "start": 30.0, "end": 5.0, "time": "100ms" })");
  controller_of(project)["profibus"] = {{"modules", {"Control/Status", "Run Curve"}}};
  LinMotRun run(project);
  const auto out = [&run](int word, int value) {
    run.write("C.ProfibusOut[" + std::to_string(word) + "]", value);
  };
  run.step();
  out(1, 0x0008);
  run.run(0.01);
  out(1, 0x0002);
  run.run(0.01);
  out(2, 0x8001);  // curve 1, 200 ms
  run.run(0.05);
  out(2, 0x2003);  // delayed: curve 3 behind it
  run.run(0.149);
  EXPECT_GT(run.motor().SetPoint, 29.9);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[0]) & 0x100,
            0x100);  // not done: the toggle is 0
  run.run(0.2);
  EXPECT_NEAR(run.motor().SetPoint, 5.0, 1e-9);
  EXPECT_EQ(static_cast<int>(run.controller().data.ProfibusIn[0]) & 0x100, 0);
  out(2, 0xD002);  // cyclic and from the demand: 5 to 15 mm in 50 ms
  run.run(0.26);
  EXPECT_TRUE(run.motor().CurveActive);
  EXPECT_EQ(run.read("C.A.SetValueGeneration.SetValueConfiguration.CurvePosOffset"), 5.0);
}

TEST(LinMotProfibus, RepeatsCurvesAtAddressEE) {
  Json project = four_motors();
  project.erase("ascii");
  controller_of(project)["config"]["System"] = {{"Command Interface", "PROFIBUS"},
                                                {"Startup Mode", {{"Auto Start", true}}}};
  controller_of(project)["curves"]["1"] =
      Json::parse(R"({ "parts": [ { "end": 30.0, "time": "100ms" }, { "start": 30.0, "time": "100ms" } ] })");
  controller_of(project)["profibus"] = {{"modules", {"Control/Status"}}, {"address", "EE"}};
  drive_of(project)["Set Value Generation"]["Set Value Configuration"]["Curve Number"] = 1;
  LinMotRun run(project);
  run.run(1.0);
  double highest = 0.0, lowest = 100.0;
  run.samples.clear();
  run.run(0.4);
  for (const auto& one : run.samples) {
    highest = std::max(highest, one.setpoint);
    lowest = std::min(lowest, one.setpoint);
  }
  EXPECT_NEAR(highest, 30.0, 0.1);
  EXPECT_NEAR(lowest, 0.0, 0.1);
}

}  // namespace
}  // namespace lockstep::linmot_behaviour_test
