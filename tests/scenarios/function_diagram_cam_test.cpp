// The published function diagrams of camming as projects: what each of them states is observed, in its order.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/scenarios/function_diagram.hpp"

namespace lockstep::test::function_diagram_cam_test {
namespace {

constexpr double kPeriod = 1e-3;     // of the interpolator [s]
constexpr double kVelocity = 120.0;  // of the leading axis [°/s]

/// A cam over 360° that comes back to where it begins, by a sine.
Json sine_cam(double height) {
  return {{"type", "TO_Cam"},
          {"segments",
           {{{"xmin", 0.0},
             {"xmax", 360.0},
             {"a0", height},
             {"sineAmplitude", -height},
             {"sinePeriod", M_PI / 180.0},
             {"sinePhase", M_PI / 2.0}}}}};
}

double sine(double height, double leading) {
  return height * (1.0 - std::cos(leading * M_PI / 180.0));
}

Json cam_in(const std::string& cam, const std::string& execute, int profile) {
  return {{"Master", "TO_Master"},           {"Slave", "TO_Slave"}, {"Cam", cam}, {"Execute", execute},
          {"SyncProfileReference", profile}, {"ApplicationMode", 1}};
}

/// A turning leading axis from 0.1 s on, a following one and two cams; `later` starts the second job.
Json project_with(const Json& first, const std::string& second_block, const Json& second,
                  const std::string& later) {
  Json project = empty_project();
  project["technology_objects"] = {{"TO_Master", virtual_axis()},
                                   {"TO_Slave", virtual_axis({"TO_Master"})},
                                   {"Cam_1", sine_cam(20.0)},
                                   {"Cam_2", sine_cam(30.0)}};
  project["technology_objects"]["TO_Master"]["config"]["Modulo"] = {{"Enable", true}};
  project["tags"] = {
      {"go", {{"type", "BOOL"}}}, {"exe_1", {{"type", "BOOL"}}}, {"exe_2", {{"type", "BOOL"}}}};
  project["stimuli"] = {stimulus("50ms", "exe_1", true), stimulus("100ms", "go", true),
                        stimulus(later, "exe_2", true)};
  std::vector<Json> calls;
  for (const char* axis : {"TO_Master", "TO_Slave"}) enable(calls, axis);
  calls.push_back(
      call("MC_MoveVelocity", "run", {{"Axis", "TO_Master"}, {"Execute", "go"}, {"Velocity", kVelocity}}));
  calls.push_back(call("MC_CamIn", "A1", first));
  if (!second.empty()) calls.push_back(call(second_block, "A2", second));
  return with_program(std::move(project), calls);
}

void expect_no_steps(const CsvTable& table) {
  const auto& position = table["TO_Slave.Position"];
  const auto& velocity = table["TO_Slave.Velocity"];
  for (std::size_t i = 1; i < table.rows; ++i) {
    const double mean = 0.5 * (velocity[i] + velocity[i - 1]) * kPeriod;
    ASSERT_NEAR(position[i] - position[i - 1], mean, 2e-3) << table["t"][i];
    ASSERT_LE(std::abs(velocity[i] - velocity[i - 1]), 3.0) << table["t"][i];
  }
}

void expect_on_cam(const CsvTable& table, double height, std::size_t from, std::size_t to) {
  ASSERT_GT(to, from + 50);
  for (std::size_t i = from; i < to; ++i)
    ASSERT_NEAR(table["TO_Slave.Position"][i], sine(height, table["TO_Master.Position"][i]), 1e-9)
        << table["t"][i];
}

TEST(FunctionDiagram, CamIn1And2ChangeFromCamToCam) {
  for (const bool in_time : {true, false}) {
    Json first = cam_in("Cam_1", "exe_1", in_time ? 0 : 1);
    first["MasterSyncPosition"] = 60.0;
    if (in_time)
      first.update(
          Json{{"Velocity", 200.0}, {"Acceleration", 800.0}, {"Deceleration", 800.0}, {"Jerk", 10000.0}});
    else
      first["MasterStartDistance"] = 50.0;
    Json second = cam_in("Cam_2", "exe_2", in_time ? 1 : 3);
    second["MasterSyncPosition"] = 200.0;
    second["MasterStartDistance"] = 80.0;
    const Json project = project_with(first, "MC_CamIn", second, "1s");
    const Json facts = diagram(in_time ? "CamIn-1" : "CamIn-2");
    const CsvTable table = simulate(project, "8s", signals_of(facts, project));
    const auto rows = rows_of_steps(facts, table, project);
    ASSERT_EQ(rows.size(), 6u);
    const auto& leading = table["TO_Master.Position"];
    const double step = 2.0 * kVelocity * kPeriod;
    EXPECT_NEAR(leading[rows[2]], 60.0, step);
    EXPECT_NEAR(leading[rows[4]], in_time ? 120.0 : 200.0, step);
    EXPECT_NEAR(leading[rows[5]], in_time ? 200.0 : 280.0, step);
    expect_on_cam(table, 20.0, rows[2], rows[4] - 1);
    expect_on_cam(table, 30.0, rows[5], table.rows);
    expect_no_steps(table);
  }
}

TEST(FunctionDiagram, CamIn3BeginsWhereTheLeadingAxisIs) {
  for (const char* id : {"CamIn-3A", "CamIn-3B"}) {
    const Json facts = diagram(id);
    Json first =
        cam_in("Cam_1", "TO_Master.Position >= 269.9 AND TO_Master.Position < 280.0", facts["profile"]);
    first["MasterStartDistance"] = facts["distance"];
    if (facts.contains("sync_position")) first["MasterSyncPosition"] = facts["sync_position"];
    const Json project = project_with(first, "", Json::object(), "1s");
    const CsvTable table = simulate(
        project, "6s", signals_of(facts, project) + ",TO_Slave.StatusSynchronizedMotion.MasterOffset");
    const auto rows = rows_of_steps(facts, table, project);
    ASSERT_EQ(rows.size(), 2u);
    const auto& leading = table["TO_Master.Position"];
    const double step = 3.0 * kVelocity * kPeriod;
    EXPECT_NEAR(leading[rows[0]], facts["starts_at"].get<double>(), step);
    EXPECT_NEAR(leading[rows[1]], facts["synchronous_at"].get<double>(), step);
    const double offset = table["TO_Slave.StatusSynchronizedMotion.MasterOffset"][rows[1]];
    EXPECT_NEAR(offset, facts.value("master_offset", 0.0), step);
    std::size_t i = rows[1];
    for (; i < table.rows && !(leading[i] >= 269.9 && leading[i] < 280.0); ++i)  // there it begins anew
      ASSERT_NEAR(table["TO_Slave.Position"][i], sine(20.0, leading[i] - offset), 1e-9);
    EXPECT_GT(i, rows[1] + 100);
    expect_no_steps(table);
  }
}

TEST(FunctionDiagram, CamIn4ChangesTheCamAtItsEnd) {
  Json first = cam_in("Cam_1", "exe_1", 1);
  first["MasterSyncPosition"] = 60.0;
  first["MasterStartDistance"] = 50.0;
  const Json project = project_with(first, "MC_CamIn", cam_in("Cam_2", "exe_2", 5), "2s");
  const Json facts = diagram("CamIn-4");
  const CsvTable table = simulate(project, "8s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_LT(table["TO_Master.Position"][rows[2]], 2.0 * kVelocity * kPeriod);
  expect_on_cam(table, 20.0, rows[0], rows[2] - 1);
  expect_on_cam(table, 30.0, rows[2], table.rows);
  for (std::size_t i = rows[0]; i < table.rows; ++i) ASSERT_EQ(table["TO_Slave.StatusWord.X22"][i], 1.0);
  expect_no_steps(table);
}

TEST(FunctionDiagram, CamOut1LeavesACyclicCamInOneDirection) {
  Json first = cam_in("Cam_1", "exe_1", 1);
  first["MasterSyncPosition"] = 60.0;
  first["MasterStartDistance"] = 50.0;
  const Json facts = diagram("CamOut-1");
  const Json out{{"Slave", "TO_Slave"},        {"Execute", "exe_2"},
                 {"SlavePosition", 20.0},      {"SyncProfileReference", facts["profile"]},
                 {"MasterStopDistance", 30.0}, {"SyncOutDirection", facts["direction"]}};
  const Json project = project_with(first, "MC_CamOut", out, "1s");
  const CsvTable table = simulate(project, "8s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 4u);
  for (std::size_t i = rows[2]; i < rows[3]; ++i) ASSERT_LE(table["TO_Slave.Velocity"][i], 1e-9);
  for (std::size_t i = rows[3]; i < table.rows; ++i) ASSERT_EQ(table["TO_Slave.Position"][i], 20.0);
  expect_no_steps(table);
}

// ---- Shifts on a cam: at 1 s over a distance from where the leading axis is, at 3 s from a start position
// on
// -----------------

constexpr double kShiftDistance = 60.0;   // [°] of the leading axis
constexpr double kStartPosition = 200.0;  // [°]

class ShiftOnACam : public testing::TestWithParam<const char*> {};

Json shift_project(const Json& facts) {
  const std::string block = facts["instruction"];
  const bool phasing = block.starts_with("MC_Phasing");
  Json first = cam_in("Cam_1", "exe_1", 1);
  first["MasterSyncPosition"] = 60.0;
  first["MasterStartDistance"] = 50.0;
  Json shift{{"Slave", "TO_Slave"},
             {"Execute", "exe_2"},
             {"ProfileReference", "profile"},
             {"StartPosition", kStartPosition},
             {phasing ? "PhaseShift" : "Offset", "shift"},
             {phasing ? "PhasingDistance" : "OffsetDistance", kShiftDistance}};
  if (phasing) shift["Master"] = "TO_Master";
  Json project = project_with(first, block, shift, "1s");
  project["tags"]["profile"] = {{"type", "DINT"}, {"init", facts["profile"]}};
  project["tags"]["shift"] = {{"type", "LREAL"}, {"init", 25.0}};
  for (const Json& later :
       {stimulus("2500ms", "exe_2", false), stimulus("2600ms", "profile", 2), stimulus("3s", "exe_2", true)})
    project["stimuli"].push_back(later);
  if (block.ends_with("Absolute")) project["stimuli"].push_back(stimulus("2600ms", "shift", 60.0));
  return project;
}

TEST_P(ShiftOnACam, ShowsItsStepsInOrderAndKeepsTheChain) {
  const Json facts = diagram(GetParam());
  const Json project = shift_project(facts);
  const std::string status = "TO_Slave.StatusSynchronizedMotion.";
  std::string signals = signals_of(facts, project);
  for (const char* name : {"PhaseShift", "Offset"})
    if (signals.find(status + name) == std::string::npos) signals += "," + status + name;
  const CsvTable table = simulate(project, "7s", signals);
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 5u);
  const auto& leading = table["TO_Master.Position"];
  const double step = kVelocity * kPeriod;
  EXPECT_NEAR(table["t"][rows[0]], 1.0, 3.0 * kPeriod) << "at once";
  EXPECT_NEAR((table["t"][rows[1]] - table["t"][rows[0]]) * kVelocity, kShiftDistance, 2.0 * step);
  EXPECT_NEAR(leading[rows[3]], kStartPosition, 3.0 * step);
  EXPECT_NEAR(leading[rows[4]], kStartPosition + kShiftDistance, 3.0 * step);
  for (std::size_t i = rows[0]; i < table.rows; ++i) {
    const double function = sine(20.0, leading[i] + table[status + "PhaseShift"][i]);
    ASSERT_NEAR(table["TO_Slave.Position"][i], function + table[status + "Offset"][i], 1e-9) << table["t"][i];
    ASSERT_NEAR(table["TO_Master.Velocity"][i], kVelocity, 1e-9) << "the leading axis is not affected";
  }
  expect_no_steps(table);
}

INSTANTIATE_TEST_SUITE_P(Shifts, ShiftOnACam,
                         testing::Values("PhasingRelative-2", "PhasingAbsolute-2", "OffsetRelative-2",
                                         "OffsetAbsolute-2"),
                         [](const auto& shift) {
                           std::string name = shift.param;
                           name[name.find('-')] = '_';
                           return name;
                         });

}  // namespace
}  // namespace lockstep::test::function_diagram_cam_test
