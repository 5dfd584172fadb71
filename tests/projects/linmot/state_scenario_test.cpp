// The acceptance scenarios of states, homing, state table, process image, errors and bad commands.
#include <algorithm>
#include <cctype>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_state_scenario_test {
namespace {

using linmot::State;

Json two_motors(const std::string& servo_cycle = "1ms") {
  Json project = linmot_project(servo_cycle);
  drive_of(project, "B") = drive_of(project);
  controller_of(project)["motors"]["B"] = controller_of(project)["motors"]["A"];
  return project;
}

const Json kCurves = Json::parse(R"({ "1": { "type": "Minimal Jerk", "start": 0, "end": 30, "time": "400ms" },
                                      "2": { "type": "Minimal Jerk", "start": 0, "end": 10, "time": "200ms" } })");

/// Of an answer that is a number.
int number_of(const std::string& answer) {
  return answer.size() > 1 && answer[0] == '#' && answer[1] != 'E' ? std::stoi(answer.substr(1)) : -999999;
}

// ---- L08

Json homing_project() {
  const Json& setup = linmot_scenario("L08").at("setup");
  Json project = linmot_project("1ms");
  controller_of(project)["motors"]["A"]["fixed_stops"] = setup.at("plant").at("fixed_stops");
  Json init = setup.at("init");
  Json& drive = drive_of(project);
  drive["Initialization"]["Init Mode"] = init.at("Init Mode");
  init.erase("Init Mode");
  drive["Initialization"]["Init Config"] = init;
  return project;
}

TEST(LinMotScenario, L08HomesAgainstAStopAndChecksItsTravel) {
  const ScenarioList expect = expectations("L08");
  LinMotRun run(homing_project());
  run.until(0.1);
  EXPECT_EQ(run.send("!SR-1"), "#");
  EXPECT_EQ(run.send("!SI-1"), "#");
  run.step();
  EXPECT_EQ(run.send("!SI+1"), "#");
  EXPECT_EQ(run.send("!EX1"), "#1120");
  double largest = 0.0;
  std::vector<double> rests;  // places at which the set-point has come to rest
  while (!run.motor().InitDone && run.time() < 10.0) {
    run.step();
    largest = std::max(largest, std::abs(run.motor().DemandCurrent));
    const auto& samples = run.samples;
    if (samples.size() > 2 && samples.back().velocity == 0.0 && samples[samples.size() - 2].velocity != 0.0)
      rests.push_back(samples.back().setpoint);
  }
  ASSERT_TRUE(run.motor().InitDone);
  EXPECT_LE(largest, expect[0].at("max").get<double>() + 1e-9);
  EXPECT_NEAR(run.controller().motor(0).shift(), expect[1].at("value").get<double>(),
              expect[1].at("tolerance").get<double>());
  const auto order = expect[2].at("value").get<std::vector<double>>();
  ASSERT_EQ(rests.size() + 1, order.size());  // home is assigned, not gone to
  for (std::size_t i = 0; i < rests.size(); ++i) EXPECT_NEAR(rests[i], order[i + 1], 1e-9);
  EXPECT_EQ(run.motor().DemandPosition, expect[3].at("value")[1].get<double>());
  EXPECT_EQ(run.send("!EX1"), "#1024");
}

TEST(LinMotScenario, L08FailsAtAnObstacle) {
  const Json& wanted = expectations("L08")[4].at("value");
  Json project = homing_project();
  // Logical -10 mm is at 5 mm on the machine's scale, whose stop at 35 mm is called 20 mm.
  controller_of(project)["motors"]["A"]["start_position"] = 20.0;
  controller_of(project)["motors"]["A"]["fixed_stops"].push_back(
      {{"position", 5.0}, {"direction", "negative"}, {"stiffness", 1e6}, {"damping", 1500.0}});
  LinMotRun run(project);
  EXPECT_EQ(run.send("!SR-1"), "#");
  EXPECT_EQ(run.send("!SI-1"), "#");
  run.step();
  EXPECT_EQ(run.send("!SI+1"), "#");
  while (run.state() != State::error && run.time() < 20.0) run.step();
  EXPECT_EQ(run.state(), State::error);
  EXPECT_EQ(run.send("!GS1"), wanted[1].get<std::string>());
  EXPECT_EQ(run.send("!EEA"), "#" + std::to_string(1 << wanted[2].get<int>()));
  EXPECT_FALSE(run.motor().InitDone);
}

TEST(LinMotHoming, LeavesTheTriggerAndFindsItsEdge) {
  Json project = linmot_project("1ms");
  drive_of(project)["Initialization"] = {{"Init Mode", "Trig Move Out"},
                                         {"Init Config",
                                          {{"Init Speed", 0.05},
                                           {"Home Position", 5.0},
                                           {"Initial Position", 5.0},
                                           {"Check Init Position", 5.0},
                                           {"Maximal Init Current", 50.0}}}};
  LinMotRun run(project);
  run.send("!SR-1");
  run.send("!SI-1");
  run.write("t_a", 1);
  run.step();
  run.send("!SI+1");
  // The trigger covers places from -3 mm on.
  while (!run.motor().InitDone && run.time() < 5.0) {
    run.write("t_a", run.controller().motor(0).actual() + run.controller().motor(0).shift() >= -3.0 ? 1 : 0);
    run.step();
  }
  ASSERT_TRUE(run.motor().InitDone);
  EXPECT_NEAR(run.controller().motor(0).shift(), -8.0, 0.2);
}

// ---- L09

TEST(LinMotScenario, L09AnswersThePrintedSession) {
  Json project = two_motors();
  controller_of(project)["curves"] = kCurves;
  LinMotRun run(project);
  EXPECT_EQ(expectations("L09")[0].at("value"), "as in steps");
  EXPECT_EQ(expectations("L09")[1].at("basis"), "closed form");
  for (const Json& one : linmot_scenario("L09").at("steps")) {
    if (one.contains("repeat")) {
      std::string answer;
      for (int i = 0; i < 1000 && answer != one.at("until"); ++i) answer = run.send(one.at("repeat"));
      EXPECT_EQ(answer, one.at("until").get<std::string>());
      continue;
    }
    if (one.contains("after")) run.run(std::stod(one.at("after").get<std::string>()));
    const std::string answer = run.send(one.at("send"));
    if (one.contains("tolerance")) {
      EXPECT_NEAR(number_of(answer), number_of(one.at("answer")), one.at("tolerance").get<int>());
    } else {
      EXPECT_EQ(answer, one.at("answer").get<std::string>()) << one.at("send");
    }
  }
}

// ---- L10, L11

Json table_project(const std::string& servo_cycle = "1ms") {
  Json project = linmot_project(servo_cycle);
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "MT";
  controller_of(project)["config"]["System"]["IO Configuration"]["Run Input"] = true;
  controller_of(project)["io"]["RUN"] = "r";
  controller_of(project)["config"]["System"]["IO Configuration"]["Init Input"] = true;
  controller_of(project)["io"]["INIT"] = "error";
  controller_of(project)["io"].erase("OUT 2");
  controller_of(project)["curves"] = kCurves;
  return project;
}

void start_by_inputs(LinMotRun& run) {
  run.write("error", 1);  // INIT
  run.step();
  run.step();
  run.write("r", 1);
  run.write("error", 0);
  run.step();
  run.step();
  EXPECT_EQ(run.state(), State::run);
}

void set_code(LinMotRun& run, const std::string& code) {
  const char* const inputs[] = {"t_d", "t_c", "t_b", "t_a"};
  for (std::size_t i = 0; i < 4; ++i) run.write(inputs[i], code[i] == '1' ? 1 : 0);
}

TEST(LinMotScenario, L10WalksThroughTheTable) {
  const Json& scenario = linmot_scenario("L10");
  const ScenarioList expect = expectations(scenario.at("id"));
  Json project = table_project("100us");
  controller_of(project)["state_table"] = scenario.at("setup").at("state_table");
  controller_of(project)["input_table"] = scenario.at("setup").at("input_table");
  LinMotRun run(project);
  start_by_inputs(run);
  const auto codes = scenario.at("steps").at(0).at("codes").get<std::vector<std::string>>();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const double begin = run.time();
    set_code(run, codes[i]);
    run.samples.clear();
    double low_since = -1.0, low = 0.0, moves = -1.0, stands = -1.0;
    while (run.time() < begin + 0.2 - 1e-9) {
      const double before = run.motor().SetPoint;
      run.step();
      if (run.motor().SetPoint != before) {
        if (moves < 0.0) moves = run.time() - begin - 1e-4;
        stands = run.time() - begin;
      }
      if (!run.motor().InPosition && low_since < 0.0) low_since = run.time();
      if (low_since >= 0.0 && !run.motor().InPosition) low = run.time() - low_since;
    }
    EXPECT_NEAR(run.motor().SetPoint, expect[0].at("value")[i].get<double>(), 1e-6) << i;
    EXPECT_EQ(run.controller().data.StateNumber, expect[1].at("value")[i].get<int>()) << i;
    if (i == 0) {
      EXPECT_NEAR(moves, expect[2].at("value")[0].get<double>(), expect[2].at("tolerance")[0].get<double>());
      EXPECT_NEAR(stands - moves, expect[2].at("value")[1].get<double>(),
                  expect[2].at("tolerance")[1].get<double>());
    }
    if (moves >= 0.0) {
      EXPECT_GE(low, expect[3].at("value").get<double>() - 0.0011);
    }
  }
}

/// How many rows are called by bits that are not at once.
int calls_with_filter(double milliseconds) {
  Json project = table_project();
  controller_of(project)["state_table"] =
      Json::parse(R"({ "0": { "A": { "Rel. Position": [1, 0.5, 10] } } })");
  controller_of(project)["input_table"] =
      Json::parse(R"({ "0001": ["Goto state", 0], "0011": ["Goto state", 0] })");
  controller_of(project)["config"]["Multi Trigger"]["Jitter Filter"]["Time"] = milliseconds;
  LinMotRun run(project);
  start_by_inputs(run);
  set_code(run, "0001");
  run.run(0.003);
  set_code(run, "0011");
  run.run(0.3);
  return static_cast<int>(std::lround(run.motor().SetPoint));
}

TEST(LinMotScenario, L10FiltersWhatComesOneAfterTheOther) {
  const ScenarioList expect = expectations("L10");
  EXPECT_EQ(calls_with_filter(5.0), expect[4].at("value").get<int>());
  EXPECT_EQ(calls_with_filter(1.0), expect[5].at("value").get<int>());
}

/// Rows by what they do; the input codes 0 to 15 call rows 0 to 15.
Json every_row(const std::string& servo_cycle = "1ms") {
  Json project = table_project(servo_cycle);
  controller_of(project)["state_table"] = Json::parse(R"({
    "0": {}, "1": { "A": { "Abs. Position": [20, 0.5, 10] } }, "2": { "A": { "Rel. Position": [20, 0.5, 10] } },
    "3": { "A": { "Curve": [1] } }, "4": { "A": { "Stop": [10] } }, "5": { "A": { "Freeze": [] } },
    "6": { "A": { "Abs. Position": [7, 0.5, 10] } }, "7": { "A": { "Rel. Position": [7, 0.5, 10] } }, "8": { "A": { "Curve": [2] } },
    "9": { "A": { "Unfreeze": [] } }, "10": { "A": { "Rel. Position": [5, 0.5, 10] } }, "11": { "A": { "Abs. Position": [3, 0.5, 10] } },
    "12": { "A": { "Abs. Position": [8, 0.5, 10] } }, "13": { "A": { "Abs. Position": [100, 0.5, 10] } } })");
  Json table = Json::object();
  for (int code = 0; code < 14; ++code) {
    std::string bits;
    for (int bit = 3; bit >= 0; --bit) bits += (code >> bit & 1) != 0 ? '1' : '0';
    table[bits] = Json::array({"Goto state", code});
  }
  controller_of(project)["input_table"] = table;
  controller_of(project)["config"]["Multi Trigger"]["Jitter Filter"]["Time"] = 0.0;
  return project;
}

void call(LinMotRun& run, int row) {
  std::string bits;
  for (int bit = 3; bit >= 0; --bit) bits += (row >> bit & 1) != 0 ? '1' : '0';
  set_code(run, bits);
}

/// Where a motion ends that a row has begun, and another one has come to 60 ms later.
double end_of(int running, int called) {
  LinMotRun run(every_row());
  start_by_inputs(run);
  if (running == 4 || running == 5) {
    call(run, 1);
    run.run(0.02);
  }
  call(run, running);
  run.run(0.06);
  const double stood = run.motor().SetPoint;
  if (running == 4 || running == 5) run.run(0.1);
  call(run, called);
  run.run(1.0);
  (void)stood;
  return run.motor().SetPoint;
}

TEST(LinMotScenario, L11AddsUpToTheResultingMotion) {
  const std::map<std::string, int> running{
      {"Abs. Position 20", 1}, {"Rel. Position +20", 2}, {"Curve 1", 3}, {"Stop", 4}, {"Freeze", 5}};
  const std::map<std::string, int> called{
      {"No Operation", 0}, {"Abs. Position 7", 6}, {"Rel. Position +7", 7}, {"Curve 2", 8}};
  int pairs = 0;
  const double stops = end_of(4, 0), frozen = end_of(5, 0);
  EXPECT_GT(stops, 0.0);
  EXPECT_LT(stops, 20.0);
  for (std::size_t i = 0; i < 5; ++i) {
    const Json& row = expectations("L11")[i];
    for (const auto& [name, end] : row.at("end_mm").items()) {
      const double found = end_of(running.at(row.at("running")), called.at(name));
      double wanted = end.is_number() ? end.get<double>() : end == "frozen" ? frozen : stops;
      if (end == "where it stops + 7") wanted += 7.0;
      EXPECT_NEAR(found, wanted, 0.02) << row.at("running") << ", " << name;  // whole increments
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 20);
}

TEST(LinMotScenario, L11ThawsWhatHasBeenCalledMeanwhile) {
  const ScenarioList expect = expectations("L11");
  LinMotRun run(every_row());
  start_by_inputs(run);
  const auto call_all = [&run](std::initializer_list<int> rows) {
    for (const int row : rows) {
      call(run, row);
      run.run(0.05);
    }
  };
  call_all({1, 5, 10, 7, 9});
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, expect[5].at("value").get<double>(), 0.03);
  EXPECT_TRUE(run.motor().InPosition);
  call_all({1, 5, 11, 12});
  EXPECT_FALSE(run.motor().InPosition);
  call_all({9});
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, expect[6].at("value").get<double>(), 0.02);
}

TEST(LinMotScenario, L11FreezesWithTheAccelerationOfTheMotion) {
  const Json& expect = expectations("L11")[7];
  LinMotRun run(every_row("100us"));
  start_by_inputs(run);
  call(run, 13);
  run.run(0.1);
  run.samples.clear();
  call(run, 5);
  run.run(0.2);
  double end = 0.0;
  for (const auto& one : run.samples)
    if (one.velocity != 0.0) end = one.time;
  EXPECT_NEAR(end - run.samples.front().time, expect.at("value")[0].get<double>(),
              expect.at("tolerance")[0].get<double>());
  EXPECT_NEAR(run.motor().SetPoint - run.samples.front().setpoint, expect.at("value")[1].get<double>(),
              expect.at("tolerance")[1].get<double>());
  EXPECT_FALSE(run.motor().InPosition);
}

// ---- L12

std::uint16_t hex(const Json& text) {
  return static_cast<std::uint16_t>(std::stoul(text.get<std::string>(), nullptr, 16));
}

TEST(LinMotScenario, L12ExchangesWords) {
  const Json& scenario = linmot_scenario("L12");
  const Json& setup = scenario.at("setup");
  Json project = linmot_project("1ms");
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  controller_of(project)["curves"] =
      Json::parse(R"({ "1": { "parts": [ { "type": "Minimal Jerk", "start": 0, "end": 30, "time": "200ms" },
                                         { "type": "Minimal Jerk", "start": 30, "end": 0, "time": "200ms" } ] } })");
  controller_of(project)["profibus"] = {{"modules", setup.at("modules")},
                                        {"preset", {{"Max. Speed", setup.at("Max. Speed preset")}}}};
  LinMotRun run(project);
  const auto check = [&run](const Json& words, const char* when) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == "*") continue;
      const auto found = static_cast<std::uint16_t>(run.controller().data.ProfibusIn[i]);
      if (i == 0 || hex(words[i]) == 0x7FFF) {
        EXPECT_EQ(found, hex(words[i])) << when << " " << i;
      } else {
        EXPECT_NEAR(static_cast<std::int16_t>(found), static_cast<std::int16_t>(hex(words[i])), 13) << when;
      }
    }
  };
  EXPECT_EQ(expectations("L12")[0].at("value"), "as in steps");
  for (const Json& one : scenario.at("steps")) {
    for (std::size_t i = 0; i < one.at("out").size(); ++i)
      run.write("C.ProfibusOut[" + std::to_string(i + 1) + "]", hex(one.at("out")[i]));
    run.run(0.02);
    for (const char* const when : {"in_moving", "in_running"})
      if (one.contains(when)) check(one.at(when), when);
    run.run(1.0);
    for (const char* const when : {"in", "in_at_end"})
      if (one.contains(when)) check(one.at(when), when);
  }
  EXPECT_EQ(static_cast<std::uint16_t>(run.controller().data.Display),
            std::stoul(expectations("L12")[3].at("value").get<std::string>().substr(1), nullptr, 16));
}

TEST(LinMotScenario, L12TurnsBytes) {
  const Json& wanted = expectations("L12")[1].at("value");
  for (const bool reversed : {false, true}) {
    Json project = linmot_project("1ms");
    controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
    controller_of(project)["config"]["PROFIBUS-DP"]["Byte Order Datamodules"]["Reversed"] = reversed;
    controller_of(project)["profibus"] = {{"modules", {"Control/Status", "Set Position"}}};
    LinMotRun run(project);
    run.write("C.ProfibusOut[2]", 2560);
    run.step();
    const auto byte = [&run](std::size_t index) {
      char text[4];
      std::snprintf(text, sizeof text, "%02X",
                    static_cast<unsigned>(run.controller().data.ProfibusOutByte[index]));
      return std::string(text);
    };
    EXPECT_EQ(byte(2) + " " + byte(3),
              wanted.at(reversed ? "Reversed on" : "Reversed off").get<std::string>());
  }
}

// ---- L13, L14

TEST(LinMotScenario, L13WatchesItsSupply) {
  const ScenarioList expect = expectations("L13");
  Json project = linmot_project("1ms");
  controller_of(project)["hardware"] = "E400-MT";
  controller_of(project)["config"]["Drives"]["Drive A"]["Control Parameters"]["Maximal Current"] = 2.0;
  controller_of(project)["faults"]["power_voltage"] = "power";
  LinMotRun run(project);
  run.start();
  double voltage = 24.0, warned = 0.0, failed = 0.0;
  while (voltage > 17.0 && failed == 0.0) {
    voltage -= 1e-3;
    run.write("power", voltage);
    run.step();
    if (warned == 0.0 && run.read("warning") != 0.0) warned = voltage;
    if (failed == 0.0 && run.read("error") != 0.0) failed = voltage;
  }
  EXPECT_NEAR(warned, expect[0].at("value")[0].get<double>(), 0.0011);
  EXPECT_NEAR(failed, expect[0].at("value")[1].get<double>(), 0.0011);
  EXPECT_EQ(run.send("!GS1"), expect[1].at("value").get<std::string>());
  SCOPED_TRACE(expect[4].dump());
  EXPECT_EQ(run.motor().DemandCurrent, 0.0);
  // The requests are still there.
  run.write("power", 24.0);
  run.step();
  EXPECT_EQ(run.state(), State::error);
  EXPECT_EQ(run.send("!SR-1"), "#");
  run.step();
  SCOPED_TRACE(expect[6].dump());
  EXPECT_EQ(run.state(), State::disable);
  EXPECT_TRUE(run.motor().InitDone);
}

TEST(LinMotScenario, L13ToleratesAHotHeatSinkForFiveSeconds) {
  const Json& expect = expectations("L13")[2];
  LinMotRun run(linmot_project("1ms"));
  run.start();
  run.write("hot", 1);
  run.run(4.9);
  EXPECT_EQ(run.state(), State::run);
  EXPECT_EQ(run.send("!GW1"), "#32");
  run.write("hot", 0);
  run.run(0.1);
  EXPECT_EQ(run.send("!GW1"), "#0");
  run.write("hot", 1);
  run.run(5.1);
  EXPECT_EQ(run.send("!GS1"), expect.at("value")[1].get<std::string>());
}

TEST(LinMotScenario, L13TellsAFollowingError) {
  const ScenarioList expect = expectations("L13");
  Json project = linmot_project("1ms");
  drive_of(project)["Position Monitoring"] = {{"Following Error-", 2.0}, {"Following Error+", 2.0}};
  LinMotRun run(project);
  run.start();
  run.write("force", -150.0);
  while (run.state() == State::run && run.time() < 5.0) run.step();
  run.write("force", 0.0);
  const Json& told = expect[3].at("value");
  EXPECT_EQ(run.send("!GS1"), told[0].get<std::string>());
  EXPECT_EQ(run.send("!EEA"), told[1].get<std::string>());
  EXPECT_EQ(run.send("!EX1"), told[2].get<std::string>());
  EXPECT_EQ(run.motor().DemandCurrent, 0.0);
  SCOPED_TRACE(expect[5].dump());
  EXPECT_NE(static_cast<int>(run.controller().data.LoggedWarnings) & 4, 0);
  run.run(0.5);
  run.send("!SR-1");
  run.step();
  EXPECT_EQ(run.state(), State::disable);
  run.send("!SR+1");
  run.step();
  EXPECT_EQ(run.state(), State::run);
  EXPECT_EQ(static_cast<int>(run.controller().data.LoggedWarnings), 0);
}

Json emergency_project(const std::string& mode) {
  const Json& setup = linmot_scenario("L14").at("setup");
  Json project = linmot_project("100us");
  drive_of(project)["Error Handling"]["Emergency Stop"] = {
      {"Emergency Stop Mode", mode},
      {"Emergency Configuration",
       {{"Stop Position", setup.at("Stop Position")},
        {"Max Speed", setup.at("emergency").at("Max Speed")},
        {"Max Acceleration", setup.at("emergency").at("Max Acceleration")}}}};
  drive_of(project)["Set Value Generation"]["Filter Parameter"]["Max Speed"] = 0.5;
  return project;
}

TEST(LinMotScenario, L14StopsInAnEmergency) {
  const ScenarioList expect = expectations("L14");
  for (const Json& mode : linmot_scenario("L14").at("setup").at("modes")) {
    LinMotRun run(emergency_project(mode));
    run.start();
    run.send("!SP20480A");
    run.run(0.2);
    EXPECT_NEAR(run.motor().SetPointVelocity, 0.5, 1e-3);
    run.samples.clear();
    EXPECT_EQ(run.send("!SS+1"), "#");
    const double from = run.samples.front().setpoint;
    EXPECT_EQ(run.send("!GS1"), expect[3].at("value")[0].get<std::string>());
    EXPECT_EQ(run.send("!EX1"), expect[3].at("value")[1].get<std::string>());
    run.run(0.02);
    if (mode == "Off") {
      EXPECT_EQ(run.motor().DemandCurrent, expect[2].at("value").get<double>());
    }
    run.run(1.0);
    if (mode == "Freeze") {
      double end = 0.0;
      for (const auto& one : run.samples)
        if (one.velocity != 0.0) end = one.time;
      EXPECT_NEAR(end - run.samples.front().time, expect[0].at("value")[0].get<double>(),
                  expect[0].at("tolerance")[0].get<double>());
      EXPECT_NEAR(run.motor().SetPoint - from, expect[0].at("value")[1].get<double>(),
                  expect[0].at("tolerance")[1].get<double>());
    }
    if (mode == "Goto Position") {
      EXPECT_NEAR(run.motor().SetPoint, expect[1].at("value").get<double>(),
                  expect[1].at("tolerance").get<double>());
    }
    EXPECT_EQ(run.send("!SS-1"), "#");
    run.step();
    SCOPED_TRACE(expect[4].dump());
    EXPECT_EQ(run.state(), State::stop);
    EXPECT_EQ(run.send("!SR-1"), "#");
    run.step();
    SCOPED_TRACE(expect[5].dump());
    EXPECT_EQ(run.state(), State::disable);
  }
}

// ---- L15

TEST(LinMotScenario, L15AnswersWhatIsWrong) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  EXPECT_EQ(expectations("L15")[0].at("value"), "as in steps");
  const ScenarioList steps("L15", "steps");
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_EQ(run.send(steps[i].at("send")), steps[i].at("answer").get<std::string>()) << steps[i];
}

TEST(LinMotScenario, L15DependsOnStateRunModeAndOwner) {
  const ScenarioList expect = expectations("L15");
  Json project = linmot_project("1ms");
  controller_of(project)["curves"] = kCurves;
  LinMotRun disabled(project);
  disabled.send("!SR-1");
  disabled.send("!SI-1");
  disabled.step();
  EXPECT_EQ(disabled.send("!RC1A"), expect[1].at("value")[0].get<std::string>());
  EXPECT_EQ(disabled.send("!SP1A"), expect[1].at("value")[1].get<std::string>());
  drive_of(project)["Set Value Generation"]["Run Mode"] = "Analog";
  controller_of(project)["config"]["System"]["IO Configuration"]["Run Input"] = true;
  LinMotRun owned(project);
  EXPECT_EQ(owned.send("!SP1A"), expect[2].at("value").get<std::string>());
  EXPECT_EQ(owned.send("!SR+1"), expect[3].at("value").get<std::string>());
}

TEST(LinMotAscii, KeepsToTheCyclicCurve) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"] = kCurves;
  LinMotRun run(project);
  run.start();
  EXPECT_EQ(run.send("!CC1A"), "#");
  EXPECT_EQ(run.send("!SP1A"), "#E54");
  EXPECT_EQ(run.send("!GDA"), "#E54");
  EXPECT_EQ(run.send("!CS1A"), "#");
  run.run(0.5);
  EXPECT_EQ(run.send("!GDA"), "#1536");
  EXPECT_EQ(run.send("!SP1A"), "#");
}

// Every command in every state gives one answer, whatever its number and motor.
TEST(LinMotAscii, AnswersEveryCommandOnce) {
  LinMotRun run(linmot_project("1ms"));
  for (int round = 0; round < 2; ++round) {
    for (const linmot::AsciiCommand& command : linmot::ascii_commands()) {
      for (const char* const rest : {"", "1", "A", "0A", "1A", "-1A", "32767A", "99999999999999999A", "+1",
                                     "-1", "+A", "B", "E", "7"}) {
        if (command.name == "SI" || command.name == "SR" || command.name == "SS") continue;
        const std::string answer = run.send("!" + std::string(command.name) + rest);
        EXPECT_EQ(answer[0], '#') << command.name << rest;
        EXPECT_TRUE(std::isfinite(run.motor().SetPoint)) << command.name << rest;
      }
    }
    if (round == 0 && run.state() != State::run) {
      run.send("!SF-1");
      run.send("!SF-A");
      run.start();
    }
  }
}

}  // namespace
}  // namespace lockstep::linmot_state_scenario_test
