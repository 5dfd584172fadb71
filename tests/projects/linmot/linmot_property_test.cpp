// The multi-trigger controller by chance, against a model of the table of resulting motions; runs that
// repeat.
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <optional>
#include <random>

#include "tests/projects/linmot/linmot_run.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/property.hpp"

namespace lockstep::linmot_property_test {
namespace {

using linmot::State;

/// Rows of one motor, in whole increments so that a model counts with the same numbers.
enum class Does { nothing, absolute, relative, curve, stop, freeze, unfreeze };
struct ModelRow {
  Does does = Does::nothing;
  double value = 0.0;
};
constexpr double kEnds[] = {0.0, 25.0, -10.0};  // [mm] of the curves 1 and 2

/// Where a motor goes to, by table 2-1: the called motion takes the place of the running one; what is
/// relative adds to where that goes, behind a curve to its end; while frozen the last call waits.
struct MotionModel {
  double target = 0.0;
  bool frozen = false, stopped = false;  // stopped: where is seen, not known
  std::optional<double> waiting_curve;

  void call(const ModelRow& row) {
    switch (row.does) {
      case Does::nothing:
        return;
      case Does::absolute:
        target = row.value;
        waiting_curve.reset();
        return;
      case Does::relative:
        target += row.value;
        waiting_curve.reset();
        return;
      case Does::curve:
        (frozen ? waiting_curve.emplace() : target) = kEnds[static_cast<int>(row.value)];
        return;
      case Does::stop:
        stopped = true;
        waiting_curve.reset();
        return;
      case Does::freeze:
        frozen = true;
        return;
      case Does::unfreeze:
        frozen = false;
        if (waiting_curve) target = *waiting_curve;
        waiting_curve.reset();
        return;
    }
  }
};

class TableModel {
 public:
  explicit TableModel(std::mt19937_64& random) : random_(random) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = random_row();
    for (auto& code : codes) code = pick(5) == 0 ? -1 - pick(4) : pick(static_cast<int>(rows.size()));
  }

  Json state_table() const {
    Json table = Json::object();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Json& row = table[std::to_string(i)] = Json::object();
      const ModelRow& one = rows[i];
      if (one.does == Does::absolute) row["A"]["Abs. Position"] = {one.value, 0.5, 20.0};
      if (one.does == Does::relative) row["A"]["Rel. Position"] = {one.value, 0.5, 20.0};
      if (one.does == Does::curve) row["A"]["Curve"] = {static_cast<int>(one.value)};
      if (one.does == Does::stop) row["A"]["Stop"] = {20.0};
      if (one.does == Does::freeze) row["A"]["Freeze"] = Json::array();
      if (one.does == Does::unfreeze) row["A"]["Unfreeze"] = Json::array();
    }
    return table;
  }
  Json input_table() const {
    constexpr const char* kCommands[] = {"No operation", "Goto next state", "Goto previous state",
                                         "Repeat actual state"};
    Json table = {{"active_inputs", "ABCD"}, {"active_triggers", "ABC"}};
    for (std::size_t code = 0; code < codes.size(); ++code) {
      std::string bits;
      for (int bit = 3; bit >= 0; --bit) bits += (code >> bit & 1) != 0 ? '1' : '0';
      if (codes[code] < 0)
        table[bits] = kCommands[-1 - codes[code]];
      else
        table[bits] = Json::array({"Goto state", codes[code]});
    }
    return table;
  }
  /// @return whether a row is called
  bool code(int code) {
    const int changed = code ^ code_;
    code_ = code;
    if ((changed & 7) == 0) return false;  // D is no trigger
    const int does = codes[static_cast<std::size_t>(code)];
    if (does == -1) return false;
    const int wanted = does >= 0 ? does : does == -2 ? row + 1 : does == -3 ? row - 1 : row;
    if (wanted < 0 || wanted >= static_cast<int>(rows.size())) return false;
    row = wanted;
    motion.call(rows[static_cast<std::size_t>(row)]);
    return true;
  }

  std::array<ModelRow, 24> rows{};
  std::array<int, 16> codes{};  // a row, or -1 - the other commands
  int row = -1;
  MotionModel motion;

 private:
  int pick(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  ModelRow random_row() {
    const double increments = (pick(8001) - 4000) * 5.0 / 256.0;
    switch (pick(10)) {
      case 0:
        return {};
      case 1:
      case 2:
      case 3:
        return {Does::absolute, increments};
      case 4:
      case 5:
        return {Does::relative, increments / 8.0 - std::remainder(increments / 8.0, 5.0 / 256.0)};
      case 6:
        return {Does::curve, 1.0 + pick(2)};
      case 7:
        return {Does::stop, 0.0};
      case 8:
        return {Does::freeze, 0.0};
      default:
        return {Does::unfreeze, 0.0};
    }
  }

  std::mt19937_64& random_;
  int code_ = 0;
};

Json table_of(const TableModel& model) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  Json& c = controller_of(project);
  c["control_cycle"] = "1ms";
  c.erase("motors");  // the set-point alone
  c["config"]["System"]["Command Interface"] = "MT";
  c["config"]["System"]["IO Configuration"] = {{"Run Input", true}, {"Init Input", true}};
  c["config"]["Multi Trigger"]["Jitter Filter"]["Time"] = 0.0;
  c["io"] = {{"RUN", "r"},      {"INIT", "hot"},   {"TRIG A", "t_a"},
             {"TRIG B", "t_b"}, {"TRIG C", "t_c"}, {"TRIG D", "t_d"}};
  c.erase("faults");
  c["curves"] = Json::parse(
      R"({ "1": { "end": 25.0, "time": "30ms" }, "2": { "start": 5.0, "end": -10.0, "time": "50ms" } })");
  c["state_table"] = model.state_table();
  c["input_table"] = model.input_table();
  return project;
}

void set_code(LinMotRun& run, int code) {
  const char* const inputs[] = {"t_a", "t_b", "t_c", "t_d"};
  for (int i = 0; i < 4; ++i) run.write(inputs[i], code >> i & 1);
}

// A hundredth of the codes that a soak has.
TEST(LinMotTableProperty, GoesWhereTheModelDoes) {
  constexpr int kCodesOfATable = 500;
  int settled = 0, calls = 0;
  test::for_each_seed(1, test::cases(20, 2000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    TableModel model(random);
    LinMotRun run(table_of(model));
    run.write("hot", 1);  // INIT
    run.step();
    run.write("hot", 0);
    run.write("r", 1);
    run.step();
    ASSERT_EQ(run.state(), State::run);
    for (int i = 0; i < kCodesOfATable; ++i) {
      const int code = static_cast<int>(random() % 16);
      set_code(run, code);
      run.step();
      calls += model.code(code) ? 1 : 0;
      ASSERT_EQ(run.controller().data.StateNumber, model.row) << i;
      if (model.motion.stopped) {
        model.motion.target = run.motor().DemandPosition;
        model.motion.stopped = false;
      }
      ASSERT_NEAR(run.motor().DemandPosition, model.motion.target, 1e-9) << i;
      ASSERT_EQ(run.motor().Frozen, model.motion.frozen) << i;
      for (auto ticks = random() % 40; ticks > 0; --ticks) run.step();
      ASSERT_TRUE(std::isfinite(run.motor().SetPoint)) << i;
      if (random() % 25 != 0) continue;
      run.run(1.5);
      if (model.motion.frozen) {
        ASSERT_EQ(run.motor().SetPointVelocity, 0.0) << i;
        ASSERT_FALSE(run.motor().InPosition) << i;
        continue;
      }
      ASSERT_NEAR(run.motor().SetPoint, model.motion.target, 1e-9) << i;
      ASSERT_TRUE(run.motor().InPosition) << i;
      ++settled;
    }
  });
  EXPECT_GT(settled, 20);
  EXPECT_GT(calls, 1000);
}

/// What two runs of one project have been, sample by sample.
std::vector<double> course_of(const Json& project) {
  LinMotRun run(project);
  run.run(1.0);
  std::vector<double> all;
  for (const auto& one : run.samples)
    for (const double value : {one.setpoint, one.velocity, one.actual, one.current}) all.push_back(value);
  return all;
}

TEST(LinMotCycle, TakesNothingFromTheHeap) {
  Json project = linmot_project("1ms");
  for (const char* const letter : {"B", "C", "D"}) {
    drive_of(project, letter) = drive_of(project);
    controller_of(project)["motors"][letter] = controller_of(project)["motors"]["A"];
  }
  controller_of(project)["curves"] = Json::parse(R"({ "1": { "end": 25.0, "time": "30ms" } })");
  project["stimuli"] = Json::parse(R"([
    { "at": "100ms", "ascii": { "send": "!SP2560A" } }, { "at": "110ms", "ascii": { "send": "!RC1B" } },
    { "at": "120ms", "ascii": { "send": "!RC9B" } }, { "at": "130ms", "ascii": { "send": "!GS1" } } ])");
  Simulation machine = Simulation::from_text(project.dump());
  machine.run_for(std::chrono::milliseconds(90));
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    machine.run_for(std::chrono::milliseconds(300));
  }
  EXPECT_EQ(test::allocations_counted(), before);
}

TEST(LinMotProject, RepeatsARunWithItsCommandsToTheBit) {
  Json project = linmot_project("1ms");
  project["stimuli"] = Json::parse(R"([
    { "at": "10ms", "ascii": { "send": "!SR-1" } }, { "at": "10ms", "ascii": { "send": "!SI-1" } },
    { "at": "20ms", "ascii": { "send": "!SI+1" } }, { "at": "30ms", "ascii": { "send": "!SR+1" } },
    { "at": "30ms", "ascii": { "send": "!SI-1" } }, { "at": "50ms", "ascii": { "send": "!SP2560A" } },
    { "at": "90ms", "ascii": { "send": "!SP-100A" } }, { "at": "95ms", "ascii": { "send": "!XX" } } ])");
  const std::vector<double> first = course_of(project), second = course_of(project);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(first[i]), std::bit_cast<std::uint64_t>(second[i])) << i;
  EXPECT_GT(*std::max_element(first.begin(), first.end()), 20.0);
}

}  // namespace
}  // namespace lockstep::linmot_property_test
