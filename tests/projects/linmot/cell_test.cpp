// Cells of the state table, one command after the other; In Position and the outputs that tell of it.
#include <algorithm>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_cell_test {
namespace {

using linmot::State;

constexpr double kCurrent = 6.0 / 256.0;  // [A] an increment

/// Called by rows that are their codes; RUN and INIT are inputs.
Json rows(const std::string& table) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  Json& c = controller_of(project);
  c["config"]["System"] = {{"Command Interface", "MT"},
                           {"IO Configuration", {{"Run Input", true}, {"Init Input", true}}}};
  c["config"]["Multi Trigger"]["Jitter Filter"]["Time"] = "0ms";
  c["io"]["RUN"] = "r";
  c["io"]["INIT"] = "hot";
  c["faults"].erase("heat_sink_hot");
  c["curves"] = Json::parse(R"({ "1": { "end": 30.0, "time": "200ms" } })");
  c["state_table"] = Json::parse(table);
  Json codes = Json::object();
  for (int code = 1; code < 16; ++code) {
    std::string bits;
    for (int bit = 3; bit >= 0; --bit) bits += (code >> bit & 1) != 0 ? '1' : '0';
    if (c["state_table"].contains(std::to_string(code))) codes[bits] = Json::array({"Goto state", code});
  }
  c["input_table"] = codes;
  return project;
}

void start(LinMotRun& run) {
  run.write("hot", 1);  // INIT
  run.run(0.002);
  run.write("r", 1);
  run.write("hot", 0);
  run.run(0.002);
  ASSERT_EQ(run.state(), State::run);
}
void set_code(LinMotRun& run, int code) {
  const char* const inputs[] = {"t_a", "t_b", "t_c", "t_d"};
  for (int i = 0; i < 4; ++i) run.write(inputs[i], code >> i & 1);
}
void call(LinMotRun& run, int row) {
  set_code(run, row);
  run.step();
}

TEST(LinMotCell, SetsWhatItsCommandSays) {
  LinMotRun run(
      rows(R"({ "1": { "A": { "Abs. Position": [50, 0.5, 10] } }, "2": { "A": { "Set Current": [2.0] } },
                          "3": { "A": { "Set Cur. Offset": [-0.5] } }, "4": { "A": { "Set FF": [0.25, 50.7, 40.0] } },
                          "5": { "A": { "Set PID": [2.0, 20.0, 6.0] } }, "6": { "A": { "Set CP": [10.0, 50.0, 25.0] } } })"));
  start(run);
  call(run, 1);
  run.run(0.05);
  ASSERT_NE(run.motor().SetPointVelocity, 0.0);
  // At once, and the motion goes on.
  const auto of = [&run](const char* name) { return run.read(std::string("C.A.") + name); };
  call(run, 2);
  EXPECT_EQ(of("ControlParameters.MaximalCurrent"), 85 * kCurrent);
  call(run, 3);
  EXPECT_EQ(of("ControlParameters.CurrentOffset"), -21 * kCurrent);
  call(run, 4);
  EXPECT_EQ(of("ControlParameters.FFFriction"), 0.25);
  EXPECT_EQ(of("ControlParameters.FFAcceleration"), 50.7);
  EXPECT_EQ(of("ControlParameters.FFDeceleration"), 40.0);
  call(run, 5);
  EXPECT_EQ(of("ControlParameters.P"), 2.0);
  EXPECT_EQ(of("ControlParameters.I"), 20.0);
  EXPECT_EQ(of("ControlParameters.D"), 6.0);
  call(run, 6);
  EXPECT_EQ(of("SetValueGeneration.SetValueConfiguration.CurvePosOffset"), 10.0);
  EXPECT_EQ(of("SetValueGeneration.SetValueConfiguration.CurveAmplitude"), 50.0);
  EXPECT_EQ(of("SetValueGeneration.SetValueConfiguration.CurveSpeed"), 25.0);
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, 50.0, 1e-9);
}

TEST(LinMotCell, StartsACurveFromWhereTheDemandIs) {
  LinMotRun run(rows(
      R"({ "1": { "A": { "Abs. Position": [12, 0.5, 10] } }, "2": { "A": { "Curve ActPos": [1] } }, "4": { "A": { "Curve": [1] } } })"));
  start(run);
  call(run, 1);
  run.run(0.5);
  const double demand = run.motor().SetPoint;
  call(run, 2);
  EXPECT_NEAR(run.motor().SetPoint, demand, 1e-3);
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, demand + 30.0, 1e-9);
  EXPECT_EQ(run.read("C.A.SetValueGeneration.SetValueConfiguration.CurvePosOffset"), demand);
}

TEST(LinMotCell, MakesTheActualPositionTheDemand) {
  LinMotRun run(
      rows(R"({ "1": { "A": { "Abs. Position": [50, 0.5, 10] } }, "2": { "A": { "SetDPostoAPos": [] } } })"));
  start(run);
  call(run, 1);
  run.run(0.08);
  set_code(run, 2);
  const double actual = run.motor().ActualPosition;
  run.step();
  EXPECT_NEAR(run.motor().DemandPosition, actual, 0.6);  // that of the tick in which it is called
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
  const double demand = run.motor().DemandPosition;
  run.run(0.5);
  EXPECT_EQ(run.motor().SetPoint, demand);
  EXPECT_NEAR(run.motor().ActualPosition, demand, 0.25);
}

/// [s] from the call of a row until the slider leaves a stop at 10 mm, beyond which its demand is.
double leaves_after(const char* command) {
  Json project = rows(std::string(R"({ "1": { "A": { "Abs. Position": [20, 0.5, 10] } }, "2": { "A": { ")") +
                      command + R"(": [0, 0.5, 10] } } })");
  controller_of(project)["motors"]["A"]["fixed_stops"] = Json::parse(
      R"([ { "position": 10.0, "direction": "positive", "stiffness": 1e6, "damping": 1500.0 } ])");
  LinMotRun run(project);
  start(run);
  call(run, 1);
  run.run(0.5);
  EXPECT_NEAR(run.motor().ActualPosition, 10.0, 0.3);
  const double begin = run.time();
  set_code(run, 2);
  while (run.motor().ActualPosition > 9.99 && run.time() < begin + 1.0) run.step();
  return run.time() - begin;
}

TEST(LinMotCell, LeavesAPressAtOnceFromTheActualPosition) {
  EXPECT_GT(leaves_after("Abs. Position"),
            0.040);  // √(2 · 10 mm / 10 m/s²): the demand has to come back first
  EXPECT_LT(leaves_after("Abs Pos Act Pos"), 0.015);
}

TEST(LinMotCell, OfStopEndsInPosition) {
  LinMotRun run(
      rows(R"({ "1": { "A": { "Abs. Position": [100, 0.5, 10] } }, "2": { "A": { "Stop": [5] } } })"));
  start(run);
  call(run, 1);
  run.run(0.1);
  const double velocity = run.motor().SetPointVelocity, from = run.motor().SetPoint;
  ASSERT_NEAR(velocity, 0.5, 1e-3);
  call(run, 2);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint - from, 1e3 * velocity * velocity / (2.0 * 5.0), 0.6);
  EXPECT_EQ(run.motor().DemandPosition, run.motor().SetPoint);
  EXPECT_TRUE(run.motor().InPosition);
}

TEST(LinMotCell, OfFreezeEndsWithRun) {
  LinMotRun run(
      rows(R"({ "1": { "A": { "Abs. Position": [50, 0.5, 10] } }, "2": { "A": { "Freeze": [] } } })"));
  start(run);
  call(run, 1);
  run.run(0.05);
  call(run, 2);
  run.run(0.1);
  EXPECT_TRUE(run.motor().Frozen);
  run.write("r", 0);
  run.step();
  EXPECT_EQ(run.state(), State::disable);
  run.write("r", 1);
  run.step();
  ASSERT_EQ(run.state(), State::run);
  EXPECT_FALSE(run.motor().Frozen);
}

TEST(LinMotCell, IsCalledInRunAlone) {
  LinMotRun run(rows(
      R"({ "1": { "A": { "Abs. Position": [5, 0.5, 10] } }, "2": { "A": { "Abs. Position": [9, 0.5, 10] } } })"));
  run.step();
  set_code(run, 1);
  run.run(0.1);
  start(run);
  run.run(0.2);
  EXPECT_EQ(run.controller().data.StateNumber, -1);  // that code has been there before
  EXPECT_EQ(run.motor().SetPoint, 0.0);
  call(run, 2);
  EXPECT_EQ(run.controller().data.StateNumber, 2);
}

// ---- In Position

TEST(LinMotInPosition, IsTheEndOfTheMotionAndTheWindow) {
  Json project = linmot_project("1ms");
  controller_of(project)["motors"]["A"]["friction"] = 0.0;
  drive_of(project)["Position Monitoring"] = {{"In Position-", 0.1}, {"In Position+", 0.2}};
  LinMotRun run(project);
  run.start();
  EXPECT_EQ(run.send("!SP2560A"), "#");
  int inside = 0, outside = 0;  // behind the end of the set-point
  bool was_in = false;
  for (int i = 0; i < 1000; ++i) {
    run.step();
    const bool ends = run.motor().SetPoint == 50.0 && run.motor().SetPointVelocity == 0.0;
    const double away = run.motor().ActualPosition - 50.0;
    ASSERT_EQ(run.motor().InPosition, ends && away >= -0.1 && away <= 0.2) << i;
    (run.motor().InPosition ? inside : outside) += ends ? 1 : 0;
    was_in = was_in || run.motor().InPosition;
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 0);  // it comes by its end and leaves the window once more
  run.send("!SR-1");
  run.step();
  EXPECT_FALSE(run.motor().InPosition);
}

TEST(LinMotInPosition, IsNotThereOnACyclicCurve) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"] = Json::parse(
      R"({ "1": { "parts": [ { "end": 30.0, "time": "100ms" }, { "start": 30.0, "time": "100ms" } ] } })");
  LinMotRun run(project);
  run.start();
  EXPECT_EQ(run.send("!CC1A"), "#");
  for (int i = 0; i < 1000; ++i) {
    run.step();
    ASSERT_FALSE(run.motor().InPosition) << i;
  }
  EXPECT_EQ(run.send("!CS1A"), "#");
  run.run(0.5);
  EXPECT_TRUE(run.motor().InPosition);
}

// ---- Outputs

/// OUT 3 or OUT 4 with a function: while A moves from 0 to 50 mm, and when it is there. B stands.
std::pair<bool, bool> output_of(const char* output, const char* function) {
  Json project = rows(R"({ "1": { "A": { "Abs. Position": [50, 0.5, 10] } } })");
  drive_of(project, "B") = drive_of(project);
  controller_of(project)["motors"]["B"] = controller_of(project)["motors"]["A"];
  drive_of(project)["Position Monitoring"] = {{"Pos Range Min", -20.0}, {"Pos Range Max", 20.0}};
  controller_of(project)["config"]["Multi Trigger"]["Output Configuration"][output] = function;
  controller_of(project)["io"].erase("OUT 3");
  controller_of(project)["io"][std::string(output) == "Output 3" ? "OUT 3" : "OUT 4"] = "third";
  LinMotRun run(project);
  start(run);
  call(run, 1);
  run.run(0.05);
  const bool moving = run.read("third") != 0.0;
  run.run(0.5);
  return {moving, run.read("third") != 0.0};
}

TEST(LinMotOutput, IsWhatOutputConfigurationSays) {
  using Pair = std::pair<bool, bool>;
  for (const char* const output : {"Output 3", "Output 4"}) {
    EXPECT_EQ(output_of(output, "None"), Pair(false, false));
    EXPECT_EQ(output_of(output, "In Pos A"), Pair(false, true));
    EXPECT_EQ(output_of(output, "In Pos B"), Pair(true, true));
    EXPECT_EQ(output_of(output, "In Pos C"), Pair(false, false));  // no drive
    EXPECT_EQ(output_of(output, "In Pos A*B"), Pair(false, true));
    EXPECT_EQ(output_of(output, "In Pos C*D"), Pair(true, true));  // nobody is away
    EXPECT_EQ(output_of(output, "In Pos A*B*C*D"), Pair(false, true));
  }
  EXPECT_EQ(output_of("Output 3", "Pos Range"), Pair(false, true));
}

// Without a table OUT 3 is POS ERR and OUT 4 MSG.
TEST(LinMotOutput, TellsOfThePositionAndOfMessages) {
  Json project = linmot_project("1ms");
  drive_of(project)["Position Monitoring"] = {{"Pos Range Min", -20.0}, {"Pos Range Max", 20.0}};
  controller_of(project)["config"]["System"]["Error Handling"]["Msg Mask"]["Slider Missing"] = true;
  controller_of(project)["io"]["OUT 4"] = "r";
  LinMotRun run(project);
  run.start();
  EXPECT_EQ(run.read("third"), 0.0);
  run.send("!SP2560A");
  run.run(0.5);
  EXPECT_EQ(run.read("third"), 1.0);
  EXPECT_EQ(run.read("warning"), 1.0);
  EXPECT_EQ(run.read("r"), 0.0);
  run.write("missing", 1);
  run.step();
  EXPECT_EQ(run.read("r"), 1.0);
  EXPECT_EQ(run.read("error"), 1.0);
  controller_of(project)["config"]["System"]["IO Configuration"] = {
      {"Pos Error Output", false}, {"Msg Output", false}, {"Error Output", false}, {"Warn Output", false}};
  LinMotRun silent(project);
  silent.start();
  silent.send("!SP2560A");
  silent.run(0.5);
  silent.write("missing", 1);
  silent.step();
  for (const char* const output : {"third", "warning", "r", "error"}) EXPECT_EQ(silent.read(output), 0.0);
}

}  // namespace
}  // namespace lockstep::linmot_cell_test
