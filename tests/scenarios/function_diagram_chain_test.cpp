// The published function diagrams of what acts on a gear: shifts, desynchronizing, additive leading values
// and a changing ratio. Those of shifts on a cam are in function_diagram_cam_test.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/scenarios/function_diagram.hpp"

namespace lockstep::test::function_diagram_chain_test {
namespace {

constexpr double kPeriod = 1e-3;     // of the interpolator [s]
constexpr double kVelocity = 100.0;  // of the leading axis [u/s]
constexpr double kDistance = 60.0;   // of shifts and of desynchronizing [u] of the leading axis
constexpr double kSyncPosition = 20.0;
constexpr double kSlaveSyncPosition = 10.0;
constexpr double kRatio = 1.5;

/// A leading axis that runs and a following one; `exe_1` and `exe_2` start the jobs A1 and A2.
Json machine(std::vector<Json>& calls) {
  Json project = empty_project();
  project["technology_objects"] = {{"TO_Master", virtual_axis()}, {"TO_Slave", virtual_axis({"TO_Master"})}};
  project["tags"] = {{"exe_1", {{"type", "BOOL"}}}, {"exe_2", {{"type", "BOOL"}}}};
  for (const char* axis : {"TO_Master", "TO_Slave"}) enable(calls, axis);
  run(calls, "TO_Master", kVelocity);
  return project;
}

Json gear_in_pos(double sync_position, double distance, const std::string& execute, int profile = 1) {
  return call("MC_GearInPos", "A1",
              {{"Master", "TO_Master"},
               {"Slave", "TO_Slave"},
               {"Execute", execute},
               {"RatioNumerator", 3},
               {"RatioDenominator", 2},
               {"MasterSyncPosition", sync_position},
               {"SlaveSyncPosition", kSlaveSyncPosition},
               {"SyncProfileReference", profile},
               {"MasterStartDistance", distance},
               {"Velocity", 300.0},
               {"Acceleration", 100.0},
               {"Deceleration", 100.0},
               {"Jerk", 2000.0}});
}

/// A value that a program changes from one to another, evenly in every millisecond.
void ramp(Json& stimuli, const std::string& tag, int from_ms, int to_ms, double from, double to) {
  for (int ms = from_ms; ms <= to_ms; ++ms)
    stimuli.push_back(
        stimulus(std::to_string(ms) + "ms", tag, from + (to - from) * (ms - from_ms) / (to_ms - from_ms)));
}

/// Position of the following axis less its function, from the values of one row.
double off_function(const CsvTable& table, std::size_t row) {
  const std::string status = "TO_Slave.StatusSynchronizedMotion.";
  const double leading =
      table[status + "EffectiveLeadingValue.Position"][row] + table[status + "PhaseShift"][row];
  return table["TO_Slave.Position"][row] -
         (kSlaveSyncPosition + kRatio * (leading - kSyncPosition) + table[status + "Offset"][row]);
}

/// The signals of a diagram and those of the chain.
std::string with_chain(std::string signals) {
  for (const char* signal : {"EffectiveLeadingValue.Position", "PhaseShift", "Offset"}) {
    const std::string name = std::string("TO_Slave.StatusSynchronizedMotion.") + signal;
    if (("," + signals + ",").find("," + name + ",") == std::string::npos) signals += "," + name;
  }
  return signals;
}

// ---- Shifts
// -----------------------------------------------------------------------------------------------------

class ShiftDiagram : public testing::TestWithParam<const char*> {};

/// Started at 1 s and at 3 s.
Json shift_project(const Json& facts) {
  const std::string block = facts["instruction"];
  const bool phasing = block.starts_with("MC_Phasing");
  std::vector<Json> calls;
  Json project = machine(calls);
  project["tags"]["profile"] = {{"type", "DINT"}, {"init", facts["profile"]}};
  project["tags"]["shift"] = {{"type", "LREAL"}, {"init", phasing ? 50.0 : 90.0}};
  project["stimuli"] = {stimulus("10ms", "exe_1", true), stimulus("1s", "exe_2", true),
                        stimulus("2500ms", "exe_2", false), stimulus("3s", "exe_2", true)};
  calls.push_back(gear_in_pos(kSyncPosition, 15.0, "exe_1"));
  Json pins{{"Slave", "TO_Slave"},
            {"Execute", "exe_2"},
            {"ProfileReference", "profile"},
            {phasing ? "PhaseShift" : "Offset", "shift"},
            {phasing ? "PhasingDistance" : "OffsetDistance", kDistance}};
  if (phasing)
    pins.update({{"Master", "TO_Master"},
                 {"Velocity", 120.0},
                 {"Acceleration", 800.0},
                 {"Deceleration", 800.0},
                 {"Jerk", 20000.0}});
  calls.push_back(call(block, "A2", pins));
  return with_program(std::move(project), calls);
}

TEST_P(ShiftDiagram, ShowsItsStepsInOrderAndKeepsTheChain) {
  const Json facts = diagram(GetParam());
  const Json project = shift_project(facts);
  const CsvTable table = simulate(project, "7s", with_chain(signals_of(facts, project)));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), facts["steps"].size());
  const auto& leading = table["TO_Master.Position"];
  const double step = kVelocity * kPeriod;
  if (facts["profile"] == 1) {
    EXPECT_NEAR(leading[rows[1]] - leading[rows[0]], kDistance, 2.0 * step);
  }
  for (std::size_t i = rows[0]; i < table.rows; ++i) {
    ASSERT_NEAR(off_function(table, i), 0.0, 1e-9) << table["t"][i];
    ASSERT_EQ(table["TO_Master.Velocity"][i], kVelocity) << "the leading axis is not affected";
  }
  const std::string shown = facts["steps"][1]["observed"].contains("TO_Slave.StatusSynchronizedMotion.Offset")
                                ? "TO_Slave.StatusSynchronizedMotion.Offset"
                                : "TO_Slave.StatusSynchronizedMotion.PhaseShift";
  const bool met_already = std::string(GetParam()).ends_with("Absolute-1");
  for (std::size_t i = rows[1]; met_already && i < table.rows; ++i)
    ASSERT_EQ(table[shown][i], table[shown][rows[1]]) << "a target that is met moves nothing";
}

INSTANTIATE_TEST_SUITE_P(Shifts, ShiftDiagram,
                         testing::Values("PhasingRelative-1", "PhasingAbsolute-1", "OffsetRelative-1",
                                         "OffsetAbsolute-1"),
                         [](const auto& shift) {
                           std::string name = shift.param;
                           name[name.find('-')] = '_';
                           return name;
                         });

// ---- Desynchronizing
// --------------------------------------------------------------------------------------------

class GearOutDiagram : public testing::TestWithParam<const char*> {};

TEST_P(GearOutDiagram, WaitsDesynchronizesAndRestsAtTheStopPosition) {
  const Json facts = diagram(GetParam());
  std::vector<Json> calls;
  Json project = machine(calls);
  project["stimuli"] = {stimulus("10ms", "exe_1", true), stimulus("1s", "exe_2", true)};
  calls.push_back(gear_in_pos(kSyncPosition, 15.0, "exe_1"));
  calls.push_back(call("MC_GearOut", "A2",
                       {{"Slave", "TO_Slave"},
                        {"Execute", "exe_2"},
                        {"SlavePosition", 400.0},
                        {"SyncProfileReference", facts["profile"]},
                        {"MasterStopDistance", kDistance},
                        {"Deceleration", 200.0},
                        {"Jerk", 5000.0}}));
  project = with_program(std::move(project), calls);
  const CsvTable table = simulate(project, "6s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 4u);
  const auto& velocity = table["TO_Slave.Velocity"];
  for (std::size_t i = rows[1]; i + 2 < rows[2]; ++i) ASSERT_EQ(velocity[i], kRatio * kVelocity);
  for (std::size_t i = rows[2]; i < rows[3]; ++i) {
    ASSERT_LE(velocity[i], velocity[i - 1] + 1e-9) << "pure braking, at " << table["t"][i];
    ASSERT_LE(velocity[i - 1] - velocity[i], 0.5) << "a step at " << table["t"][i];
  }
  EXPECT_EQ(velocity[rows[3]], 0.0);
  if (facts["profile"] == 1) {
    const auto& leading = table["TO_Master.Position"];
    const std::size_t rest = table.first("TO_Slave.Velocity", 0.0, rows[2]);
    EXPECT_NEAR(leading[rest] - leading[rows[2]], kDistance, 3.0 * kVelocity * kPeriod);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, GearOutDiagram, testing::Values("GearOut-1A", "GearOut-1B"),
                         [](const auto& distance) { return std::string(1, distance.param[9]); });

// ---- Velocity gear
// ----------------------------------------------------------------------------------------------

TEST(FunctionDiagram, GearInVelocity1FollowsTheRatioWhileUpdatesAreActive) {
  const Json facts = diagram("GearInVelocity-1");
  std::vector<Json> calls;
  Json project = machine(calls);
  project["tags"]["cu"] = {{"type", "BOOL"}, {"init", true}};
  project["tags"]["den"] = {{"type", "DINT"}, {"init", 1}};
  project["stimuli"] = {
      stimulus("500ms", "exe_1", true),   stimulus("1500ms", "den", 2),      stimulus("1700ms", "den", 4),
      stimulus("2s", "cu", false),        stimulus("2100ms", "den", 1),      stimulus("2200ms", "cu", true),
      stimulus("2400ms", "exe_1", false), stimulus("2500ms", "exe_1", true), stimulus("3500ms", "cu", false),
      stimulus("3600ms", "den", 4),       stimulus("3700ms", "cu", true)};
  calls.push_back(call("MC_GearInVelocity", "A1",
                       {{"Master", "TO_Master"},
                        {"Slave", "TO_Slave"},
                        {"Execute", "exe_1"},
                        {"ContinuousUpdate", "cu"},
                        {"RatioDenominator", "den"},
                        {"PositionControlled", true}}));
  project = with_program(std::move(project), calls);
  const CsvTable table = simulate(project, "4s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), facts["steps"].size());
  for (std::size_t i = rows[4]; i + 2 < rows[6]; ++i)
    ASSERT_EQ(table["TO_Slave.Velocity"][i], 25.0) << "the last ratio stays, at " << table["t"][i];
  for (std::size_t i = rows[7]; i < table.rows; ++i)
    ASSERT_EQ(table["TO_Slave.Velocity"][i], 100.0) << "the last ratio stays, at " << table["t"][i];
}

// ---- Additive leading value
// -------------------------------------------------------------------------------------

Json additive_call() {
  return call("MC_LeadingValueAdditive", "A2",
              {{"Axis", "TO_Slave"}, {"Enable", "exe_2"}, {"Position", "add"}});
}

/// The program's value counts from the next tick on.
void expect_effective_is_the_sum(const CsvTable& table, std::size_t from, std::size_t to) {
  const auto& effective = table["TO_Slave.StatusSynchronizedMotion.EffectiveLeadingValue.Position"];
  for (std::size_t i = from + 1; i < to; ++i)
    ASSERT_NEAR(effective[i], table["TO_Master.Position"][i] + table["add"][i - 1], 1e-9) << table["t"][i];
}

TEST(FunctionDiagram, LeadingValueAdditive1ASynchronizesByTheEffectiveLeadingValue) {
  const Json facts = diagram("LeadingValueAdditive-1A");
  std::vector<Json> calls;
  Json project = machine(calls);
  project["tags"]["add"] = {{"type", "LREAL"}};
  project["stimuli"] = {stimulus("300ms", "exe_1", true), stimulus("300ms", "exe_2", true)};
  ramp(project["stimuli"], "add", 3000, 3300, 0.0, 10.0);
  ramp(project["stimuli"], "add", 3400, 3700, 10.0, 0.0);
  project["stimuli"].push_back(stimulus("6s", "exe_2", false));
  calls.push_back(gear_in_pos(500.0, 1.0, "exe_1", 0));
  calls.push_back(additive_call());
  project = with_program(std::move(project), calls);
  const CsvTable table = simulate(project, "7s", with_chain(signals_of(facts, project)));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), facts["steps"].size());
  expect_effective_is_the_sum(table, rows[0], table.rows);
  const auto& slave = table["TO_Slave.Position"];
  EXPECT_NEAR(table["TO_Master.Position"][rows[4]], 500.0, 3.0 * kVelocity * kPeriod);
  for (std::size_t i = rows[4]; i < table.rows; ++i)
    ASSERT_NEAR(slave[i], kSlaveSyncPosition + kRatio * (table["TO_Master.Position"][i] - 500.0), 1e-9);
}

TEST(FunctionDiagram, LeadingValueAdditive1BShiftsTheSynchronousPosition) {
  const Json facts = diagram("LeadingValueAdditive-1B");
  std::vector<Json> calls;
  Json project = machine(calls);
  project["tags"]["add"] = {{"type", "LREAL"}};
  project["stimuli"] = {stimulus("100ms", "exe_2", true), stimulus("700ms", "exe_1", true)};
  ramp(project["stimuli"], "add", 200, 600, 0.0, 100.0);
  ramp(project["stimuli"], "add", 3000, 4000, 100.0, 0.0);
  project["stimuli"].push_back(stimulus("5s", "exe_2", false));
  calls.push_back(gear_in_pos(300.0, 100.0, "exe_1"));  // from 200 on
  calls.push_back(additive_call());
  project = with_program(std::move(project), calls);
  const CsvTable table = simulate(project, "6s", with_chain(signals_of(facts, project)));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), facts["steps"].size());
  const double step = kVelocity * kPeriod;
  EXPECT_NEAR(table["TO_Master.Position"][rows[3]], 100.0, 2.0 * step);
  EXPECT_NEAR(table["TO_Master.Position"][rows[4]], 200.0, 2.0 * step);
  expect_effective_is_the_sum(table, rows[2], table.rows);
  // As fast as the leading axis moves on, the additive value falls: the following axis stands.
  const auto& slave = table["TO_Slave.Position"];
  const std::size_t falling = table.first("t", 3.01), fallen = table.first("t", 3.99);
  ASSERT_LT(falling, fallen);
  ASSERT_LT(fallen, table.rows);
  for (std::size_t i = falling; i < fallen; ++i) ASSERT_NEAR(slave[i], slave[falling], 1e-9) << table["t"][i];
  EXPECT_GT(slave[rows[6]], slave[rows[5]] + 100.0) << "then it moves on";
}

}  // namespace
}  // namespace lockstep::test::function_diagram_chain_test
