// The example of two controllers: both presses strike where the conveyor is, on a network that loses
// telegrams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "projects/json/document.hpp"
#include "projects/loader/project_schema.hpp"
#include "projects/system/apply_delays.hpp"
#include "projects/system/connections.hpp"
#include "projects/system/simulated_system.hpp"
#include "schema_check.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::system_examples_test {
namespace {

using namespace std::chrono_literals;

const std::string kTwoPresses = LOCKSTEP_SOURCE_DIR "/projects/12_two_presses/system.json";
const std::string kPaperLine = LOCKSTEP_SOURCE_DIR "/projects/13_paper_line/system.json";

class SystemExamples : public testing::TestWithParam<std::string> {};

TEST_P(SystemExamples, HaveTheDelaysThatTheOverviewComputes) {
  const LoadedSystem loaded = load_system_file(GetParam(), LoadedFor::looking);
  for (const Problem& problem : loaded.problems) ADD_FAILURE() << to_string(GetParam(), problem);
  EXPECT_TRUE(loaded.warnings.empty()) << to_string(GetParam(), loaded.warnings[0]);
  ASSERT_TRUE(loaded.system);
  const Connections connections(*loaded.system);
  EXPECT_FALSE(connections.delays().empty());
  for (const DelayTime& delay : connections.delays())
    EXPECT_TRUE(delay.is_current()) << delay.object.object->name;
}

INSTANTIATE_TEST_SUITE_P(Each, SystemExamples, testing::Values(kTwoPresses, kPaperLine));

TEST(TwoPresses, StrikeWhereTheConveyorIs) {
  SimulatedSystem machine(kTwoPresses);
  machine.run_for(400ms);
  ASSERT_EQ(machine.read("Infeed.ready"), 1.0);
  ASSERT_EQ(machine.read("Stamping.ready"), 1.0);
  double lowest_1 = 80.0, lowest_2 = 80.0;
  int strokes = 0;
  bool down = false;
  const std::int64_t end = 8'000'000'000;
  while (machine.now() < end) {
    machine.step();
    const double at_1 =
        machine.read("Infeed.Conveyor.StatusProvidedLeadingValue.DelayedLeadingValue.Position");
    const double at_2 = machine.read("Stamping.Line.Position");
    const double press_1 = machine.read("Infeed.Press_1.Position");
    const double press_2 = machine.read("Stamping.Press_2.Position");
    lowest_1 = std::min(lowest_1, press_1);
    lowest_2 = std::min(lowest_2, press_2);
    // Each is open but around its turning point, on the board that is there.
    if (at_1 < 150.0 || at_1 > 450.0) {
      ASSERT_NEAR(press_1, 80.0, 1e-6) << machine.now();
    }
    if (at_2 < 300.0 && at_2 > 1.0) {
      ASSERT_NEAR(press_2, 80.0, 1e-6) << machine.now();
    }
    const bool now_down = press_2 < 10.0;
    if (now_down) {
      EXPECT_NEAR(at_2, 450.0, 50.0);
    }
    strokes += now_down && !down ? 1 : 0;
    down = now_down;
  }
  EXPECT_NEAR(lowest_1, 0.0, 0.5);
  EXPECT_NEAR(lowest_2, 0.0, 3.0);
  EXPECT_GE(strokes, 6);
  EXPECT_EQ(machine.read("Stamping.Line.ErrorDetail.Number"), 0.0);
  EXPECT_EQ(machine.read("Stamping.refused"), 0.0);
  EXPECT_GT(machine.read("Stamping.lost"), 0.0);
  EXPECT_LT(machine.read("Stamping.Line.StatusExternalLeadingValue.AdjustmentTime"), 0.0);
}

/// What an axis has moved on a line [u]; its ring is 1000 mm.
double line_of(SimulatedSystem& machine, std::size_t controller, const char* name) {
  for (const Axis* const axis : machine.system().controllers[controller].project.controller->axes)
    if (axis->name == name)
      return static_cast<double>(axis->setpoint().position.turns) * 1000.0 + axis->setpoint().position.value;
  ADD_FAILURE() << name;
  return 0.0;
}

/// The reel, two controllers and a draw of 501 : 500 further on, is where the press has it at the same time.
TEST(PaperLine, WindsWhatThePressLetsThrough) {
  SimulatedSystem machine(kPaperLine);
  machine.run_for(400ms);
  ASSERT_EQ(machine.read("Finish.gear_reel.InGear"), 1.0);
  for (int i = 0; i < 2000; ++i) {
    machine.run_for(4ms);
    const double press = line_of(machine, 0, "Press");
    ASSERT_NEAR(line_of(machine, 1, "Dryer"), press, 2.5) << i << ": a tick of the press apart";
    ASSERT_NEAR(line_of(machine, 2, "Reel"), press * 501.0 / 500.0, 5.0) << i;
  }
  EXPECT_EQ(machine.read("Wet.Line.Velocity"), 0.0) << "at rest again";
  const double press = line_of(machine, 0, "Press");
  EXPECT_GT(press, 5000.0);
  EXPECT_NEAR(line_of(machine, 1, "Dryer"), press, 1e-9);
  EXPECT_NEAR(line_of(machine, 2, "Reel"), press * 501.0 / 500.0, 1e-9);
  EXPECT_GT(machine.read("Dry.lost") + machine.read("Finish.lost"), 0.0);
  EXPECT_EQ(machine.read("Finish.Web.ErrorDetail.Number"), 0.0);
}

// ---- What their READMEs propose to try

/// An example in a folder of the test, where it may be changed.
class Copied {
 public:
  explicit Copied(const std::string& system) {
    const std::filesystem::path folder = std::filesystem::path(system).parent_path();
    for (const auto& file : std::filesystem::directory_iterator(folder))
      if (file.path().extension() == ".json")
        directory_.write(file.path().filename().string(), test::content(file.path().string()));
  }
  std::string system() const { return directory_.file("system.json"); }
  std::string text(const std::string& file) const { return test::content(directory_.file(file)); }
  /// The one place in a file that is `from` is `to`.
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string all = text(file);
    const std::size_t at = all.find(from);
    ASSERT_NE(at, all.npos) << file << ": " << from;
    ASSERT_EQ(all.find(from, at + 1), all.npos) << file << ": " << from << " stands there twice";
    all.replace(at, from.size(), to);
    directory_.write(file, all);
  }

 private:
  test::Directory directory_;
};

/// The rows of an overview that name an axis as following, as `what` tells of each.
template <class What>
std::string rows_of(const std::string& system, const std::string& axis, What what) {
  const LoadedSystem loaded = load_system_file(system, LoadedFor::looking, SeveralSources::kept);
  for (const Problem& problem : loaded.problems) ADD_FAILURE() << to_string(system, problem);
  if (!loaded.system) return "";
  const Connections connections(*loaded.system);
  std::string text;
  for (const Interconnection& row : connections.rows())
    if (row.following.object != nullptr && row.following.object->name == axis) text += what(row);
  return text;
}

std::string path_of(const Interconnection& row) {
  return row.extrapolated ? "extrapolated " : "interpolated ";
}

/// A delay of 2 ms: the proxy extrapolates; `connections --calculate --apply` puts 8 ms back, and the file is
/// as it was, to the byte.
TEST(TwoPresses, ExtrapolateBehindAShorterDelayWhichIsPutBackByApply) {
  const Copied example(kTwoPresses);
  const std::string before = example.text("infeed.json");
  EXPECT_EQ(rows_of(example.system(), "Press_2", path_of), "interpolated ");
  example.change("infeed.json", "\"LocalLeadingValueDelayTime\": 0.008",
                 "\"LocalLeadingValueDelayTime\": 0.002");
  EXPECT_EQ(rows_of(example.system(), "Press_2", path_of), "extrapolated ");
  SimulatedSystem machine(example.system());
  machine.run_for(1s);
  EXPECT_GT(machine.read("Stamping.Line.StatusExternalLeadingValue.AdjustmentTime"), -0.002);
  const LoadedSystem loaded = load_system_file(example.system(), LoadedFor::looking);
  ASSERT_TRUE(loaded.system);
  const Connections connections(*loaded.system);
  const ChangedFiles changed = with_delays(*loaded.system, connections);
  ASSERT_EQ(changed.files.size(), 1u);
  EXPECT_EQ(changed.files[0].text, before);
}

/// Nothing comes, or too late: the second press does not start, and nothing fails.
TEST(TwoPresses, DoNotStartWithoutALeadingValue) {
  for (const auto& [from, to] :
       {std::pair{"\"loss\": 0.001", "\"loss\": 1"}, {"\"latency\": \"300us\"", "\"latency\": \"50ms\""}}) {
    const Copied example(kTwoPresses);
    example.change("system.json", from, to);
    SimulatedSystem machine(example.system());
    machine.run_for(2s);
    EXPECT_EQ(machine.read("Stamping.Line.StatusWord.X4"), 0.0) << to;
    EXPECT_EQ(machine.read("Stamping.press.Busy"), 0.0) << to;
    EXPECT_EQ(machine.read("Stamping.Line.ErrorDetail.Number"), 0.0) << "what has never led is not lost";
    EXPECT_EQ(machine.read("Infeed.ready"), 1.0) << "the first one does";
  }
}

TEST(PaperLine, IsExtrapolatedWhereItsCascadeIsFixedTooShort) {
  const Copied example(kPaperLine);
  EXPECT_EQ(rows_of(example.system(), "Reel", path_of), "interpolated ");
  example.change("dry.json",
                 "\"ToleranceTimeExternalLeadingValueInvalid\": 0.02, \"LocalLeadingValueDelayTime\": 0.008",
                 "\"ToleranceTimeExternalLeadingValueInvalid\": 0.02, \"LocalLeadingValueDelayTime\": 0.002");
  example.change("dry.json", "true }, \"LocalLeadingValueDelayTime\": 0.008",
                 "true }, \"LocalLeadingValueDelayTime\": 0.002");
  example.change("system.json", "\"simulated_network\"",
                 "\"delays\": { \"fixed\": [ \"Dry.Draw\" ] },\n  \"simulated_network\"");
  EXPECT_EQ(rows_of(example.system(), "Reel", path_of), "extrapolated ");
}

/// Coupled by the setpoint, the dryer sees what the proxy brings forward: 8 ms at 1200 mm/s.
TEST(PaperLine, DriesAheadWhereTheDryerIsNotDelayed) {
  const Copied example(kPaperLine);
  example.change("dry.json", "{ \"to\": \"Line\", \"coupling\": \"delayed\" }",
                 "{ \"to\": \"Line\", \"coupling\": \"setpoint\" }");
  SimulatedSystem machine(example.system());
  machine.run_for(5s);
  ASSERT_EQ(machine.read("Dry.gear_dryer.InGear"), 1.0);
  ASSERT_NEAR(machine.read("Wet.Press.Velocity"), 1200.0, 1e-6);
  while (machine.now() % 2'000'000 != 0) machine.step();
  const std::int64_t now = machine.now();
  while (machine.now() == now) machine.step();  // all of them at that time
  EXPECT_NEAR(line_of(machine, 1, "Dryer") - line_of(machine, 0, "Press"), 1200.0 * 0.008, 1e-6);
}

TEST(PaperLine, IsRecursiveWhereTheReelLeadsTheLine) {
  const Copied example(kPaperLine);
  example.change("finish.json", "\"MaxJerk\": 100000.0 }",
                 "\"MaxJerk\": 100000.0 }, \"CrossPlcSynchronousOperation\": { \"Interface[1]\": { "
                 "\"EnableLeadingValueOutput\": true } }");
  example.change("wet.json", "\"Press\": {",
                 "\"Back\": { \"type\": \"TO_LeadingAxisProxy\" },\n    \"Press\": {");
  example.change(
      "wet.json", "\"LocalLeadingValueDelayTime\": 0.01 }\n      }",
      "\"LocalLeadingValueDelayTime\": 0.01 }\n      },\n      \"leading_values\": [ { \"to\": \"Back\" } ]");
  example.change(
      "system.json", "\"to\": \"Finish.Web\" }",
      "\"to\": \"Finish.Web\" },\n    \"back\": { \"from\": \"Finish.Reel\", \"to\": \"Wet.Back\" }");
  EXPECT_EQ(rows_of(example.system(), "Line",
                    [](const Interconnection& row) { return row.recursive ? "recursive" : "not"; }),
            "recursive");
}

/// With the delays as computed no proxy looks ahead at any time, as long as none is lost.
TEST_P(SystemExamples, NeverExtrapolateWithoutLoss) {
  const Copied example(GetParam());
  example.change("system.json", "\"loss\": 0.001", "\"loss\": 0");
  SimulatedSystem machine(example.system());
  machine.run_for(300ms);
  double ahead = -1.0;
  while (machine.now() < 3'000'000'000) {
    machine.step();
    for (const SystemController& one : machine.system().controllers)
      for (const auto& object : one.project.controller->objects)
        if (object->kind == ObjectKind::TO_LeadingAxisProxy)
          ahead = std::max(
              ahead,
              static_cast<const LeadingAxisProxy&>(*object).data.StatusExternalLeadingValue.AdjustmentTime);
  }
  EXPECT_LE(ahead, 0.0);
  EXPECT_GT(ahead, -0.02) << "there were proxies";
}

class SystemExamplesSchema : public SchemaCheck {
 protected:
  SystemExamplesSchema() : SchemaCheck(system_schema()) {}
};

TEST_F(SystemExamplesSchema, AcceptsThem) {
  for (const std::string& path : {kTwoPresses, kPaperLine})
    EXPECT_TRUE(accepts(nlohmann::json::parse(read(path)))) << path;
}

}  // namespace
}  // namespace lockstep::system_examples_test
