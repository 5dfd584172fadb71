// The published function diagrams of gearing as projects: what each of them states is observed, in its order.
#include "tests/scenarios/function_diagram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace lockstep::test::function_diagram_test {
namespace {

constexpr double kPeriod = 1e-3;  // of the interpolator [s]

// Of the GearInPos diagrams, whose numbers are left to the user.
constexpr double kMasterSyncPosition = 150.0;
constexpr double kSlaveSyncPosition = 40.0;
constexpr double kMasterStartDistance = 60.0;
constexpr double kRatio = 1.5;
constexpr double kVelocity = 100.0;  // of the leading axis

/// Two leading axes at different speeds; A1 starts at 1 s, A2 at 2 s.
Json gear_in_project() {
  Json project = empty_project();
  project["technology_objects"] = {{"TO_Master_1", virtual_axis()},
                                   {"TO_Master_2", virtual_axis()},
                                   {"TO_Slave", virtual_axis({"TO_Master_1", "TO_Master_2"})}};
  project["tags"] = {{"exe_1", {{"type", "BOOL"}}}, {"exe_2", {{"type", "BOOL"}}}};
  project["stimuli"] = {stimulus("1s", "exe_1", true), stimulus("2s", "exe_2", true)};
  std::vector<Json> calls;
  for (const char* axis : {"TO_Master_1", "TO_Master_2", "TO_Slave"}) enable(calls, axis);
  run(calls, "TO_Master_1", 80.0);
  run(calls, "TO_Master_2", -30.0);
  const auto gear = [](const std::string& master, const std::string& execute) {
    return Json{{"Master", master}, {"Slave", "TO_Slave"}, {"Execute", execute}};
  };
  calls.push_back(call("MC_GearIn", "A1", gear("TO_Master_1", "exe_1")));
  calls.push_back(call("MC_GearIn", "A2", gear("TO_Master_2", "exe_2")));
  return with_program(std::move(project), calls);
}

/// A leading axis that starts at 0.2 s, a following one that waits for it.
Json gear_in_pos_project(int profile) {
  Json project = empty_project();
  project["technology_objects"] = {{"TO_Master", virtual_axis()}, {"TO_Slave", virtual_axis({"TO_Master"})}};
  project["technology_objects"]["TO_Master"]["config"]["Modulo"] = {{"Enable", false}};
  project["tags"]["exe"] = {{"type", "BOOL"}};
  project["stimuli"] = {stimulus("0.1s", "exe", true)};
  std::vector<Json> calls;
  for (const char* axis : {"TO_Master", "TO_Slave"}) enable(calls, axis);
  Json pins{{"Master", "TO_Master"},
            {"Slave", "TO_Slave"},
            {"Execute", "exe"},
            {"RatioNumerator", 3},
            {"RatioDenominator", 2},
            {"MasterSyncPosition", kMasterSyncPosition},
            {"SlaveSyncPosition", kSlaveSyncPosition},
            {"SyncProfileReference", profile}};
  if (profile == 0)
    pins.update({{"Velocity", 400.0}, {"Acceleration", 1500.0}, {"Deceleration", 1500.0}, {"Jerk", 20000.0}});
  else
    pins["MasterStartDistance"] = kMasterStartDistance;
  calls.push_back(call("MC_GearInPos", "A1", pins));
  calls.push_back(call("TON", "later", {{"IN", "A1.Busy"}, {"PT", "T#100ms"}}));
  calls.push_back(call("MC_MoveVelocity", "run",
                       {{"Axis", "TO_Master"}, {"Execute", "later.Q"}, {"Velocity", kVelocity}}));
  return with_program(std::move(project), calls);
}

TEST(FunctionDiagram, GearIn1SynchronizesToOneLeadingAxisAndThenToTheOther) {
  const Json project = gear_in_project();
  const Json facts = diagram("GearIn-1");
  const CsvTable table = simulate(project, "4s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 4u);
  const auto& slave = table["TO_Slave.Position"];
  const auto moves_with = [&](const std::string& master, std::size_t from, std::size_t to) {
    const auto& leading = table[master + ".Position"];
    ASSERT_GT(to, from + 100);
    for (std::size_t i = from; i < to; ++i) {
      ASSERT_NEAR(slave[i] - slave[from], leading[i] - leading[from], 1e-9) << table["t"][i];
      ASSERT_EQ(table["TO_Slave.Velocity"][i], table[master + ".Velocity"][i]) << table["t"][i];
    }
  };
  moves_with(facts["steps"][1]["synchronous_to"], rows[1], rows[2] - 1);
  moves_with(facts["steps"][3]["synchronous_to"], rows[3], table.rows);
  // Between the two it goes over without a step.
  for (std::size_t i = rows[2] - 1; i <= rows[3]; ++i)
    ASSERT_LE(std::abs(table["TO_Slave.Velocity"][i] - table["TO_Slave.Velocity"][i - 1]), 1000.0 * kPeriod);
  EXPECT_EQ(table.first("A1.CommandAborted", 1.0), rows[2]) << "it is aborted by the second job alone";
}

struct PosCase {
  const char* id;
  int profile;
};

class GearInPosDiagram : public testing::TestWithParam<PosCase> {};

TEST_P(GearInPosDiagram, WaitsSynchronizesAndIsSynchronousWhereItSaysSo) {
  const Json facts = diagram(GetParam().id);
  const int profile = GetParam().profile;
  ASSERT_EQ(facts["profile"], profile);
  const Json project = gear_in_pos_project(profile);
  const CsvTable table = simulate(project, "5s", signals_of(facts, project));
  const auto rows = rows_of_steps(facts, table, project);
  ASSERT_EQ(rows.size(), 3u);

  const auto& leading = table["TO_Master.Position"];
  const auto& slave = table["TO_Slave.Position"];
  const double step = kVelocity * kPeriod * 1.001;
  // A program sees a phase one tick after the axis has entered it.
  const auto reached = [&](double place, std::size_t row) {
    EXPECT_GE(leading[row], place - 1e-9);
    EXPECT_LE(leading[row], place + 2.0 * step) << GetParam().id;
  };
  if (profile == 1) reached(kMasterSyncPosition - kMasterStartDistance, rows[1]);
  if (profile == 3) reached(kMasterSyncPosition, rows[1]);
  if (profile == 0) {
    EXPECT_LT(leading[rows[1]], kMasterSyncPosition);
  }
  reached(profile == 3 ? kMasterSyncPosition + kMasterStartDistance : kMasterSyncPosition, rows[2]);

  for (std::size_t i = rows[0]; i + 2 < rows[1]; ++i) ASSERT_EQ(slave[i], 0.0) << "it waits at its place";
  for (std::size_t i = rows[2]; i < table.rows; ++i)
    ASSERT_NEAR(slave[i], kSlaveSyncPosition + kRatio * (leading[i] - kMasterSyncPosition), 1e-9);
  // Profile 3 begins on a moving leading value; the others from rest into the function, all without a step of
  // the position.
  for (std::size_t i = rows[1]; i <= rows[2]; ++i)
    ASSERT_LE(std::abs(slave[i] - slave[i - 1]), 500.0 * kPeriod) << table["t"][i];
}

INSTANTIATE_TEST_SUITE_P(Profiles, GearInPosDiagram,
                         testing::Values(PosCase{"GearInPos-1A", 0}, PosCase{"GearInPos-1B", 1},
                                         PosCase{"GearInPos-2A", 1}, PosCase{"GearInPos-2B", 3}),
                         [](const auto& diagram) {
                           return std::string("GearInPos_") + (diagram.param.id + 10);
                         });

}  // namespace
}  // namespace lockstep::test::function_diagram_test
