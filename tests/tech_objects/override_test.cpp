// Compares the override rules with the printed tables, one single pair of instructions after another.
#include "tech_objects/jobs/override.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

namespace lockstep::override_test {
namespace {

using Json = nlohmann::json;
using Cell = std::pair<JobClass, JobClass>;  // new job, running job

// Every single pair of the catalogue; the fourth of its tables is that of kinematics.
constexpr std::size_t kPairsInCatalogue = 1378;
constexpr const char* kTables[] = {"homing_motion", "synchronous", "measuring_input"};
constexpr std::size_t kPairsOfTables = 850;

const Json& catalogue() {
  static const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/override.json"));
  return file;
}

const std::map<std::string, JobKind> kKinds = {
    {"MC_Home", JobKind::MC_Home},
    {"MC_Halt", JobKind::MC_Halt},
    {"MC_MoveAbsolute", JobKind::MC_MoveAbsolute},
    {"MC_MoveRelative", JobKind::MC_MoveRelative},
    {"MC_MoveVelocity", JobKind::MC_MoveVelocity},
    {"MC_MoveJog", JobKind::MC_MoveJog},
    {"MC_Stop", JobKind::MC_Stop},
    {"MC_MoveSuperimposed", JobKind::MC_MoveSuperimposed},
    {"MC_MotionInSuperimposed", JobKind::MC_MotionInSuperimposed},
    {"MC_HaltSuperimposed", JobKind::MC_HaltSuperimposed},
    {"MC_MotionInVelocity", JobKind::MC_MotionInVelocity},
    {"MC_MotionInPosition", JobKind::MC_MotionInPosition},
    {"MC_GearIn", JobKind::MC_GearIn},
    {"MC_GearInVelocity", JobKind::MC_GearInVelocity},
    {"MC_GearInPos", JobKind::MC_GearInPos},
    {"MC_CamIn", JobKind::MC_CamIn},
    {"MC_PhasingAbsolute", JobKind::MC_PhasingAbsolute},
    {"MC_PhasingRelative", JobKind::MC_PhasingRelative},
    {"MC_OffsetAbsolute", JobKind::MC_OffsetAbsolute},
    {"MC_OffsetRelative", JobKind::MC_OffsetRelative},
    {"MC_LeadingValueAdditive", JobKind::MC_LeadingValueAdditive},
    {"MC_GearOut", JobKind::MC_GearOut},
    {"MC_CamOut", JobKind::MC_CamOut},
    {"MC_MeasuringInput", JobKind::MC_MeasuringInput},
    {"MC_MeasuringInputCyclic", JobKind::MC_MeasuringInputCyclic},
    {"MC_AbortMeasuringInput", JobKind::MC_AbortMeasuringInput},
};

// The class of a job as the catalogue names it: instruction, state, mode.
JobClass named_class(const Json& job, const Json& state, const Json& mode) {
  Job made;
  made.kind = kKinds.at(job.get<std::string>());
  if (made.kind == JobKind::MC_Home)
    made.asks = HomingJob{.mode = static_cast<HomeMode>(mode.is_null() ? 0 : mode.get<DINT>())};
  if (state.is_null()) return class_of(made, true);  // without states: the class is one and the same
  return class_of(made, state.get<std::string>() == "active");
}

Cell cell_of(const Json& pair) {
  return {named_class(pair.at("newJob"), pair.at("newState"), pair.at("newMode")),
          named_class(pair.at("runningJob"), pair.at("runningState"), pair.at("runningMode"))};
}

OverrideEffect named_effect(const std::string& effect) {
  static const std::map<std::string, OverrideEffect> effects = {
      {"no_effect", OverrideEffect::none},
      {"aborts", OverrideEffect::abort},
      {"new_job_rejected", OverrideEffect::reject},
      {"aborts_if_same_or_higher_stop_response", OverrideEffect::abort_by_rank}};
  return effects.at(effect);
}

// The printed effect; one that depends on the position control is spelled out in its conditions.
OverrideEffect printed_effect(const Json& pair, bool position_controlled) {
  if (pair.at("effect") != "conditional") return named_effect(pair.at("effect"));
  const std::string state =
      position_controlled ? "following axis position-controlled" : "following axis not position-controlled";
  for (const Json& condition : pair.at("conditions"))
    if (condition.at("when") == state) return named_effect(condition.at("effect"));
  ADD_FAILURE() << "no condition for " << state << " in " << pair;
  return OverrideEffect::none;
}

bool is_of_ours(const Json& pair) {
  return std::find(std::begin(kTables), std::end(kTables), pair.at("matrix").get<std::string>()) !=
         std::end(kTables);
}

const OverrideException* exception_for(const Cell& cell) {
  static const auto exceptions = override_exceptions();
  const auto* found = std::find_if(exceptions.begin(), exceptions.end(), [&](const OverrideException& e) {
    return Cell{e.new_job, e.running} == cell;
  });
  return found == exceptions.end() ? nullptr : found;
}

TEST(Override, AgreesWithThePrintedTablesPairByPairButForTheExceptions) {
  ASSERT_EQ(catalogue().at("pairs").size(), kPairsInCatalogue);
  std::size_t compared = 0;
  std::set<Cell> differing;
  for (const Json& pair : catalogue().at("pairs")) {
    if (!is_of_ours(pair)) continue;
    const Cell cell = cell_of(pair);
    for (const bool position_controlled : {true, false}) {
      const OverrideEffect printed = printed_effect(pair, position_controlled);
      const OverrideEffect effect = override_effect(cell.first, cell.second, position_controlled);
      if (const OverrideException* exception = exception_for(cell)) {
        EXPECT_EQ(effect, exception->effect) << pair;
        EXPECT_NE(effect, printed) << "an exception that differs in nothing: " << pair;
        differing.insert(cell);
      } else {
        EXPECT_EQ(effect, printed) << pair << ", position-controlled: " << position_controlled;
      }
    }
    ++compared;
  }
  EXPECT_EQ(compared, kPairsOfTables);
  EXPECT_EQ(differing.size(), override_exceptions().size()) << "an exception that is never used";
}

TEST(Override, HasNoEffectWhereTheTablesPrintNone) {
  std::set<Cell> printed;
  for (const Json& pair : catalogue().at("pairs"))
    if (is_of_ours(pair)) printed.insert(cell_of(pair));
  for (const OverrideRow& row : override_rows())
    for (int column = 0; column < kRunningClasses; ++column) {
      const Cell cell{row.new_job, static_cast<JobClass>(column)};
      if (printed.contains(cell)) continue;
      for (const bool position_controlled : {true, false})
        EXPECT_EQ(override_effect(cell.first, cell.second, position_controlled), OverrideEffect::none)
            << static_cast<int>(row.new_job) << " against " << column;
    }
}

// A row of ours may join printed rows of the same letters; it names the first of their lines.
TEST(Override, NamesTheLinesOfThePrintedRows) {
  std::map<JobClass, std::array<int, 3>> first_lines;
  for (const Json& pair : catalogue().at("pairs"))
    for (std::size_t table = 0; table < std::size(kTables); ++table) {
      if (pair.at("matrix") != kTables[table]) continue;
      int& first = first_lines[cell_of(pair).first][table];
      const int line = pair.at("line");
      if (first == 0 || line < first) first = line;
    }
  for (const OverrideRow& row : override_rows()) {
    const auto found = first_lines.find(row.new_job);
    const auto expected = found == first_lines.end() ? std::array<int, 3>{} : found->second;
    EXPECT_EQ(row.lines, expected) << static_cast<int>(row.new_job);
  }
}

TEST(Override, HasARowPerClassInOrderAndALetterPerColumn) {
  const auto rows = override_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(rows[i].new_job), i);
    EXPECT_EQ(rows[i].codes.size(), static_cast<std::size_t>(kRunningClasses)) << i;
    EXPECT_EQ(rows[i].codes.find_first_not_of("ANB.an"), std::string_view::npos) << rows[i].codes;
  }
}

// Footnote 5: MC_GearInVelocity leaves position control, and what needs it then is refused.
TEST(Override, DependsOnPositionControlOnlyUnderVelocityGearing) {
  for (const OverrideRow& row : override_rows())
    for (int column = 0; column < kRunningClasses; ++column) {
      const auto running = static_cast<JobClass>(column);
      const bool depends =
          override_effect(row.new_job, running, true) != override_effect(row.new_job, running, false);
      if (!depends) continue;
      EXPECT_EQ(running, JobClass::gear_in_velocity);
      EXPECT_EQ(override_effect(row.new_job, running, false), OverrideEffect::reject);
    }
}

// Footnote 6: MC_GearOut ends gear jobs only, MC_CamOut cam jobs only.
TEST(Override, DesynchronizesOnlyItsOwnKind) {
  constexpr JobClass kGears[] = {JobClass::gear_in, JobClass::gear_in_pos_waiting,
                                 JobClass::gear_in_pos_active, JobClass::gear_out_waiting};
  constexpr JobClass kCams[] = {JobClass::cam_in_waiting, JobClass::cam_in_active, JobClass::cam_out_waiting};
  for (const JobClass gear : kGears)
    for (const JobClass out : {JobClass::cam_out_waiting, JobClass::cam_out_active})
      EXPECT_EQ(override_effect(out, gear, true), OverrideEffect::none) << static_cast<int>(gear);
  for (const JobClass cam : kCams)
    for (const JobClass out : {JobClass::gear_out_waiting, JobClass::gear_out_active})
      EXPECT_EQ(override_effect(out, cam, true), OverrideEffect::none) << static_cast<int>(cam);
  EXPECT_EQ(override_effect(JobClass::gear_out_active, JobClass::gear_in_pos_active, true),
            OverrideEffect::abort);
  EXPECT_EQ(override_effect(JobClass::cam_out_active, JobClass::cam_in_active, true), OverrideEffect::abort);
}

// Footnote 7: a waiting job ends when the next one waits; what moves the axis does not.
TEST(Override, AWaitingJobEndsNothingThatMovesTheAxis) {
  constexpr JobClass kWaiting[] = {JobClass::gear_in_pos_waiting, JobClass::cam_in_waiting,
                                   JobClass::gear_out_waiting, JobClass::cam_out_waiting};
  for (const JobClass job : kWaiting)
    for (int column = 0; column < kRunningClasses; ++column) {
      const auto running = static_cast<JobClass>(column);
      if (std::find(std::begin(kWaiting), std::end(kWaiting), running) != std::end(kWaiting)) continue;
      EXPECT_NE(override_effect(job, running, true), OverrideEffect::abort)
          << static_cast<int>(job) << " against " << column;
    }
  EXPECT_EQ(override_effect(JobClass::cam_in_waiting, JobClass::gear_in_pos_waiting, true),
            OverrideEffect::abort);
}

TEST(Override, KnowsEveryModeOfHoming) {
  const std::map<DINT, JobClass> classes = {
      {0, JobClass::home_direct},   {1, JobClass::home_direct},  {2, JobClass::home_passive},
      {3, JobClass::home_active},   {5, JobClass::home_active},  {6, JobClass::home_direct},
      {7, JobClass::home_direct},   {8, JobClass::home_passive}, {9, JobClass::home_cancel},
      {10, JobClass::home_passive}, {11, JobClass::home_direct}, {12, JobClass::home_direct},
      {13, JobClass::home_direct}};
  for (const auto& [mode, expected] : classes) {
    Job job;
    job.kind = JobKind::MC_Home;
    job.asks = HomingJob{.mode = static_cast<HomeMode>(mode)};
    for (const bool active : {true, false}) EXPECT_EQ(class_of(job, active), expected) << "Mode " << mode;
  }
}

}  // namespace
}  // namespace lockstep::override_test
