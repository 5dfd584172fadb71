// What stands around a LinMot controller: programs in the same tick, an axis that follows one of its motors,
// large projects.
#include <algorithm>
#include <chrono>

#include "projects/loader/project.hpp"
#include "tests/projects/linmot/linmot_run.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::linmot_surroundings_test {
namespace {

using linmot::State;

TEST(LinMotProject, TakesThePublishedFormOfEveryPart) {
  const test::Directory directory;
  directory.write("press.csv", "0;0\n20;1\n40;0\n");
  Json project = linmot_project("1ms");
  project.erase("ascii");
  for (const char* const name : {"run", "init", "t1", "t2", "in_position", "m1"})
    project["tags"][name] = {{"type", "BOOL"}};
  project["technology_objects"]["C"] = Json::parse(R"({
      "type": "LinMot_Controller", "hardware": "E400-MT", "control_cycle": "100us",
      "config": {
        "System": { "Command Interface": "MT", "Startup Mode": { "Auto Start": false, "Init Together": true },
                    "IO Configuration": { "Run Input": true, "Init Input": true, "Analog / Trig Drive A": true } },
        "Drives": { "Drive A": {
          "Type": "LinMot P0x-37",
          "Initialization": { "Init Mode": "Auto Move Out",
            "Init Config": { "Init Speed": 0.05, "Maximal Init Current": 10, "Home Position": 20, "Check Init Position": -20, "Initial Position": 0 } },
          "Set Value Generation": { "Run Mode": "Serial", "Filter Parameter": { "Max Speed": 0.78125, "Max Acceleration": 30.517578125 } },
          "Control Parameters": { "Maximal Current": 5, "P": 1, "D": 4, "I": 0, "FF Friction": 0.25, "FF Acceleration": 50.7, "FF Deceleration": 50.7 } } },
        "Multi Trigger": { "Jitter Filter": { "Time": "5ms" }, "Acknowledge": { "Time": "20ms" }, "Output Configuration": { "Output 3": "In Pos A*B" } } },
      "motors": { "A": { "force_constant": 40, "slider_mass": 0.829, "load_mass": 1.2, "friction": 10, "inclination": 0,
                         "fixed_stops": [ { "position": 35, "direction": "positive", "stiffness": 1e6, "damping": 1500 } ] } },
      "curves": { "1": { "type": "Minimal Jerk", "start": 0, "end": 30, "time": "200ms" }, "2": { "type": "Manual", "points": [[0,0],[50,4.2],[100,10]] }, "3": { "file": "press.csv" } },
      "state_table": { "0": { "A": { "Curve": [1] } }, "1": { "A": { "Abs. Position": [0, 1.0, 50.068] } } },
      "input_table": { "active_inputs": "AB", "active_triggers": "AB",
                       "0000": "No operation", "0001": "Goto next state", "0010": ["Goto state", 0] },
      "io": { "RUN": "run", "INIT": "init", "TRIG A": "t1", "TRIG B": "t2", "ANALOG C": "volts", "OUT 1": "warning", "OUT 3": "in_position" },
      "faults": { "power_voltage": "power", "heat_sink_hot": "hot", "A": { "slider_missing": "m1" } },
      "profibus": { "modules": [ "Control/Status", "Get Position", "Set Position", "Next Drive", "Set Position" ], "preset": { } } })");
  const LoadedProject loaded = load_project_file(directory.write("project.json", project.dump()));
  std::string text;
  for (const Problem& problem : loaded.problems) text += problem.place + ": " + problem.text + "\n";
  EXPECT_EQ(text, "");
  ASSERT_TRUE(loaded.project.has_value());
  for (const auto& object : loaded.project->controller->objects) {
    if (object->kind != ObjectKind::LinMot_Controller) continue;
    const LinMotData& data = static_cast<LinMotController&>(*object).data;
    EXPECT_EQ(data.Parameters.jitter_time, 5.0);
    EXPECT_EQ(data.Parameters.acknowledge_time, 20.0);
    // Gains, positions and curves are as they are written, whatever increments there are.
    EXPECT_EQ(data.Motors[0].Parameters.ff_acceleration, 50.7);
    EXPECT_EQ(data.Motors[0].Parameters.ff_friction, 0.25);
    EXPECT_EQ(data.Motors[0].Parameters.home_position, 20.0);
  }
}

TEST(LinMotProject, TakesTimesAsNumbersAndAsDurations) {
  const auto problems_with = [](const Json& time) {
    Json project = linmot_project("1ms");
    controller_of(project)["config"]["Multi Trigger"]["Acknowledge"]["Time"] = time;
    std::string text;
    for (const Problem& problem : load_project(project.dump()).problems) text += problem.text + "\n";
    return text;
  };
  EXPECT_EQ(problems_with(12.5), "");
  EXPECT_EQ(problems_with("12500us"), "");
  EXPECT_NE(problems_with("2s"), "");  // more than 1000 ms
  EXPECT_NE(problems_with(1001.0), "");
  EXPECT_NE(problems_with("soon"), "");
}

// Programs of MC_PreServo run before the controller, Main behind it: each sees what there is in its tick.
TEST(LinMotController, StandsBetweenTheProgramsOfItsTick) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  Json& c = controller_of(project);
  c["config"]["System"] = {{"Command Interface", "PROFIBUS"}};
  c["profibus"] = {{"modules", {"Control/Status", "Set Position", "Get Position"}}};
  project["tags"]["step"] = {{"type", "DINT"}};
  project["tags"]["seen_state"] = {{"type", "DINT"}};
  project["tags"]["seen_word"] = {{"type", "WORD"}};
  project["tags"]["seen_warning"] = {{"type", "BOOL"}};
  project["programs"] = Json::parse(R"([
    { "name": "Before", "ob": "MC_PreServo", "calls": [
        { "set": "step", "to": "step + 1" },
        { "if": "step = 10", "then": [ { "set": "C.ProfibusOut[1]", "to": "16#0008" } ] },
        { "if": "step = 20", "then": [ { "set": "C.ProfibusOut[1]", "to": "16#0002" } ] },
        { "if": "step = 30", "then": [ { "set": "C.ProfibusOut[2]", "to": "16#0A00" } ] } ] },
    { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
        { "set": "seen_state", "to": "C.State" }, { "set": "seen_word", "to": "C.ProfibusIn[1]" }, { "set": "seen_warning", "to": "warning" } ] } ])");
  LinMotRun run(project);
  for (int i = 1; i < 400; ++i) {
    run.step();
    ASSERT_EQ(run.read("seen_state"), run.read("C.State")) << i;
    ASSERT_EQ(run.read("seen_word"), run.read("C.ProfibusIn[1]")) << i;
    ASSERT_EQ(run.read("seen_warning"), run.read("warning")) << i;
    if (i == 10) {
      EXPECT_EQ(run.read("seen_word"), 0x0009);  // homed by its actual position, in that tick
    }
    if (i == 20) {
      EXPECT_EQ(run.state(), State::run);
    }
  }
  EXPECT_NEAR(run.motor().SetPoint, 50.0, 1e-9);
}

// A motor without a description takes no current; one with it has an axis follow its slider.
TEST(LinMotController, LeadsAnAxisByTheActualPositionOfAMotor) {
  for (const bool described : {true, false}) {
    Json project = linmot_project("1ms");
    if (!described) controller_of(project).erase("motors");
    project["technology_objects"]["Encoder"] = Json::parse(
        R"({ "type": "TO_ExternalEncoder", "encoder": { "model": "simulated", "signal": "C.A.ActualPosition" } })");
    project["technology_objects"]["Belt"] = Json::parse(
        R"({ "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } }, "leading_values": [ { "to": "Encoder", "coupling": "actual" } ] })");
    project["programs"] = Json::parse(R"([ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
        { "fb": "MC_Power", "name": "enable", "in": { "Axis": "Belt", "Enable": true } },
        { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Encoder", "Slave": "Belt", "Execute": "enable.Status", "RatioNumerator": 2 } } ] } ])");
    LinMotRun run(project);
    run.start();
    run.run(0.1);
    ASSERT_EQ(run.read("gear.InGear"), 1.0);
    const double from = run.read("Belt.Position"), slider = run.motor().ActualPosition;
    run.send("!SP2560A");
    double current = 0.0;
    for (int i = 0; i < 2000; ++i) {
      run.step();
      current = std::max(current, std::abs(run.motor().DemandCurrent));
    }
    EXPECT_NEAR(run.read("Belt.Position") - from, 2.0 * (run.motor().ActualPosition - slider), 0.01);
    EXPECT_NEAR(run.motor().ActualPosition, 50.0, described ? 0.25 : 1e-9);
    if (described)
      EXPECT_GT(current, 1.0);
    else
      EXPECT_EQ(current, 0.0);
    EXPECT_EQ(run.read("Belt.ErrorDetail.Number"), 0.0);
  }
}

/// 100,000 points, 62 more curves, and 64 rows of four motors.
Json large() {
  Json project = linmot_project("1ms");
  Json& c = controller_of(project);
  for (const char* const letter : {"B", "C", "D"}) {
    drive_of(project, letter) = drive_of(project);
    c["motors"][letter] = c["motors"]["A"];
  }
  Json& points = c["curves"]["1"]["points"] = Json::array();
  for (int i = 0; i < 100'000; ++i) points.push_back({i, 10.0 * std::sin(1e-3 * i)});
  for (int number = 2; number < 64; ++number)
    c["curves"][std::to_string(number)] = {{"end", 0.1 * number}, {"time", "200ms"}};
  for (int row = 0; row < 64; ++row)
    for (const char* const letter : {"A", "B", "C", "D"})
      c["state_table"][std::to_string(row)][letter] = {{"Curve", {1 + row % 63}}};
  return project;
}

TEST(LinMotProject, HoldsAsManyPointsRowsAndCurvesAsThereMayBe) {
  const std::string text = large().dump();
  const auto begun = std::chrono::steady_clock::now();
  const LoadedProject loaded = load_project(text);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  std::cout << "loaded in " << took.count() << " s\n";  // of what is aimed at, 1 s; nothing is judged by it
  ASSERT_TRUE(loaded.project.has_value());
  for (const auto& object : loaded.project->controller->objects) {
    if (object->kind != ObjectKind::LinMot_Controller) continue;
    const auto& controller = static_cast<LinMotController&>(*object);
    for (std::size_t number = 1; number < controller.curves.size(); ++number)
      EXPECT_TRUE(controller.curves[number].exists()) << number;
    EXPECT_NEAR(controller.curves[1].duration(), 99.999, 1e-9);
    for (const linmot::StateRow& row : controller.table.rows) EXPECT_TRUE(row.exists);
  }
  Json more = large();
  controller_of(more)["curves"]["1"]["points"].push_back({100'000, 0.0});
  const LoadedProject refused = load_project(more.dump());
  ASSERT_FALSE(refused.problems.empty());
  EXPECT_EQ(refused.problems[0].text, "there are more than 100000 points");
}

}  // namespace
}  // namespace lockstep::linmot_surroundings_test
