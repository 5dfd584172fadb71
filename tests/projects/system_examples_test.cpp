// The example of two controllers: both presses strike where the conveyor is, on a network that loses
// telegrams.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "projects/json/document.hpp"
#include "projects/loader/project_schema.hpp"
#include "projects/system/connections.hpp"
#include "projects/system/simulated_system.hpp"
#include "schema_check.hpp"

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
