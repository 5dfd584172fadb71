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

namespace lockstep::two_presses_test {
namespace {

using namespace std::chrono_literals;

const std::string kSystem = LOCKSTEP_SOURCE_DIR "/projects/12_two_presses/system.json";

TEST(TwoPresses, HaveTheDelayThatTheOverviewComputes) {
  const LoadedSystem loaded = load_system_file(kSystem, LoadedFor::looking);
  for (const Problem& problem : loaded.problems) ADD_FAILURE() << to_string(kSystem, problem);
  EXPECT_TRUE(loaded.warnings.empty()) << to_string(kSystem, loaded.warnings[0]);
  ASSERT_TRUE(loaded.system);
  const Connections connections(*loaded.system);
  for (const DelayTime& delay : connections.delays()) EXPECT_TRUE(delay.is_current());
}

TEST(TwoPresses, StrikeWhereTheConveyorIs) {
  SimulatedSystem machine(kSystem);
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

class TwoPressesSchema : public SchemaCheck {
 protected:
  TwoPressesSchema() : SchemaCheck(system_schema()) {}
};

TEST_F(TwoPressesSchema, AcceptsIt) {
  EXPECT_TRUE(accepts(nlohmann::json::parse(read(kSystem))));
}

}  // namespace
}  // namespace lockstep::two_presses_test
