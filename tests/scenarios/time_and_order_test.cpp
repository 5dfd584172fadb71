// Time and order of a tick, as the contract of the project file has them, seen in traces of small projects.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::time_and_order_test {
namespace {

/// A program; `details` are its cycle and priority, where it has them.
Json program(const std::string& name, const std::string& ob, const std::vector<Json>& calls,
             const Json& details = Json::object()) {
  Json made{{"name", name}, {"ob", ob}, {"calls", calls}};
  made.update(details);
  return made;
}

Json tag(const std::string& type) {
  return Json{{"type", type}};
}

/// An axis that is enabled, and moved by a program of the given organization block from 50 ms on.
Json moved_by(const std::string& ob, int ratio) {
  Json project = empty_project("1ms", ratio);
  project["technology_objects"]["A"] = virtual_axis();
  project["tags"]["go"] = tag("BOOL");
  project["stimuli"] = {stimulus("52ms", "go", true)};
  const Json every_tick = ob == "Main" || ob == "Cyclic" ? Json{{"cycle", "1ms"}} : Json::object();
  project["programs"] = {
      program("Enable", "Main", {call("MC_Power", "power", {{"Axis", "A"}, {"Enable", true}})},
              {{"cycle", "1ms"}}),
      program("Move", ob,
              {call("MC_MoveVelocity", "move", {{"Axis", "A"}, {"Execute", "go"}, {"Velocity", 10.0}})},
              every_tick)};
  return project;
}

/// Time of the first row in which the axis has left its place; -1: it never does.
double departure(const Json& project) {
  const CsvTable table = simulate(project, "100ms", "A.Velocity,A.Position");
  for (std::size_t i = 0; i < table.rows; ++i)
    if (table["A.Velocity"][i] != 0.0) return table["t"][i];
  return -1.0;
}

TEST(TimeAndOrder, AJobOfPreInterpolatorMovesTheAxisInTheSameTickOneOfMainInTheNextInterpolatorTick) {
  EXPECT_DOUBLE_EQ(departure(moved_by("MC_PreInterpolator", 1)), 0.052);
  EXPECT_DOUBLE_EQ(departure(moved_by("MC_PreServo", 1)), 0.052);
  EXPECT_DOUBLE_EQ(departure(moved_by("MC_PostServo", 1)), 0.052);
  EXPECT_DOUBLE_EQ(departure(moved_by("Cyclic", 1)), 0.053);
  EXPECT_DOUBLE_EQ(departure(moved_by("Main", 1)), 0.053);
}

TEST(TimeAndOrder, WithARatioOfFourTheInterpolatorRunsOnEveryFourthTick) {
  EXPECT_DOUBLE_EQ(departure(moved_by("MC_PreInterpolator", 4)), 0.052);
  EXPECT_DOUBLE_EQ(departure(moved_by("Main", 4)), 0.056);
}

TEST(TimeAndOrder, ProgramsRunInTheOrderServoInterpolatorCyclicByPriorityMain) {
  // Each program adds its digit; written here in an order of no meaning.
  Json project = empty_project("1ms", 2);
  project["tags"]["order"] = tag("UDINT");
  // The interpolator runs in every second tick, so the servo's programs run in between as well.
  const auto append = [](int digit) {
    return std::vector<Json>{assignment("order", "order * 10 + " + std::to_string(digit))};
  };
  project["programs"] = {program("F", "Main", append(6), {{"cycle", "2ms"}}),
                         program("E", "Cyclic", append(5), {{"cycle", "2ms"}, {"priority", 7}}),
                         program("D", "Cyclic", append(4), {{"cycle", "2ms"}, {"priority", 20}}),
                         program("C", "MC_PreInterpolator", append(3)),
                         program("B", "MC_PostServo", append(2)),
                         program("A", "MC_PreServo", {assignment("order", 1)})};
  const CsvTable table = simulate(project, "20ms", "order");
  ASSERT_EQ(table.rows, 10u);
  for (std::size_t i = 0; i < table.rows; ++i) EXPECT_EQ(table["order"][i], 123456.0) << table["t"][i];
}

TEST(TimeAndOrder, ProgramsOfOnePriorityRunInTheOrderOfTheFile) {
  Json project = empty_project();
  project["tags"]["order"] = tag("UDINT");
  for (int digit = 1; digit <= 3; ++digit) {
    const std::string name = "P" + std::to_string(digit);
    const std::string expression = digit == 1 ? std::string("1") : "order * 10 + " + std::to_string(digit);
    project["programs"].push_back(
        program(name, "Main", {assignment("order", expression)}, {{"cycle", "1ms"}}));
  }
  EXPECT_EQ(simulate(project, "5ms", "order")["order"].back(), 123.0);
}

TEST(TimeAndOrder, ACycleIsMetOnItsMultiples) {
  Json project = empty_project();
  project["tags"] = {{"two", tag("UDINT")}, {"five", tag("UDINT")}, {"servo", tag("UDINT")}};
  project["programs"] = {
      program("Two", "Cyclic", {assignment("two", "two + 1")}, {{"cycle", "2ms"}, {"priority", 5}}),
      program("Five", "Main", {assignment("five", "five + 1")}, {{"cycle", "5ms"}}),
      program("Servo", "MC_PreServo", {assignment("servo", "servo + 1")})};
  const CsvTable table = simulate(project, "1s", "two,five,servo");
  ASSERT_EQ(table.rows, 1000u);
  for (std::size_t tick = 0; tick < table.rows; ++tick) {
    const std::size_t second = tick / 2;
    const std::size_t fifth = tick / 5;
    ASSERT_EQ(table["two"][tick], static_cast<double>(second + 1));
    ASSERT_EQ(table["five"][tick], static_cast<double>(fifth + 1));
    ASSERT_EQ(table["servo"][tick], static_cast<double>(tick + 1));
  }
}

TEST(TimeAndOrder, AnExpressionThatNamesALaterCallReadsItsLastValues) {
  Json project = empty_project();
  project["tags"] = {{"before", tag("INT")}, {"after", tag("INT")}, {"go", tag("BOOL")}};
  project["stimuli"] = {stimulus("3ms", "go", true)};
  project["programs"] = {
      program("Main", "Main",
              {assignment("before", "counter.CV"), call("CTU", "counter", {{"CU", "go"}, {"PV", 5}}),
               assignment("after", "counter.CV")},
              {{"cycle", "1ms"}})};
  const CsvTable table = simulate(project, "10ms", "before,after");
  EXPECT_EQ(table.first("after", 1.0), 3u);
  EXPECT_EQ(table.first("before", 1.0), 4u);
}

TEST(TimeAndOrder, OutputsOfABlockChangeOnlyInItsOwnCall) {
  // The gear's block is called every 10 ms; the axis is synchronous earlier than that.
  Json project = empty_project();
  project["technology_objects"] = {{"L", virtual_axis()}, {"F", virtual_axis({"L"})}};
  project["programs"] = {
      program("Main", "Main",
              {call("MC_Power", "power_l", {{"Axis", "L"}, {"Enable", true}}),
               call("MC_Power", "power_f", {{"Axis", "F"}, {"Enable", true}}),
               call("MC_GearIn", "gear", {{"Master", "L"}, {"Slave", "F"}, {"Execute", "power_f.Status"}})},
              {{"cycle", "10ms"}})};
  const CsvTable table = simulate(project, "100ms", "gear.InGear,gear.Busy,F.StatusWord.X22");
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["gear.InGear"][i] != table["gear.InGear"][i - 1] ||
        table["gear.Busy"][i] != table["gear.Busy"][i - 1]) {
      EXPECT_EQ(i % 10, 0u) << "changed at " << table["t"][i];
    }
  }
  const std::size_t synchronous = table.first("F.StatusWord.X22", 1.0);
  ASSERT_LT(synchronous, table.rows);
  EXPECT_NE(synchronous % 10, 0u);
  EXPECT_EQ(table.first("gear.InGear", 1.0), synchronous / 10 * 10 + 10);
}

TEST(TimeAndOrder, AStimulusEntersAtItsTimeAndOneBetweenTwoTicksAtTheNext) {
  Json project = empty_project();
  project["tags"] = {{"x", tag("INT")}, {"seen", tag("INT")}};
  // Not in the order of time; of two at one time the later one in the file wins.
  project["stimuli"] = {stimulus("20ms", "x", 3), stimulus("5ms", "x", 1), stimulus("10500us", "x", 2),
                        stimulus("20ms", "x", 4), stimulus("0s", "x", -1)};
  project["programs"] = {program("First", "MC_PreServo", {assignment("seen", "x")})};
  const CsvTable table = simulate(project, "30ms", "x,seen");
  for (std::size_t i = 0; i < table.rows; ++i) {
    const double expected = i < 5 ? -1 : i < 11 ? 1 : i < 20 ? 2 : 4;
    EXPECT_EQ(table["x"][i], expected) << i;
    EXPECT_EQ(table["seen"][i], expected) << "it enters before the first program; " << i;
  }
}

TEST(TimeAndOrder, MotionAdvancesByOneInterpolatorCyclePerInterpolatorTickAtEveryRatio) {
  for (const int ratio : {1, 2, 4, 32}) {
    const Json project = moved_by("MC_PreInterpolator", ratio);
    const CsvTable table = simulate(project, "2s", "A.Position,A.Velocity");
    const double period = 1e-3 * ratio;
    std::size_t checked = 0;
    for (std::size_t i = 1; i < table.rows; ++i) {
      if (table["A.Velocity"][i] != 10.0 || table["A.Velocity"][i - 1] != 10.0) continue;
      ASSERT_NEAR(table["A.Position"][i] - table["A.Position"][i - 1], 10.0 * period, 1e-12) << ratio;
      ++checked;
    }
    EXPECT_GT(checked, table.rows / 2) << ratio;
  }
}

TEST(TimeAndOrder, ALeadingAndItsFollowersMoveInTheSameTickInWhateverOrderTheyStandInTheFile) {
  Json project = empty_project();
  // The chain Last → Middle → First is written with its end first.
  project["technology_objects"] = {
      {"Last", virtual_axis({"Middle"})}, {"Middle", virtual_axis({"First"})}, {"First", virtual_axis()}};
  Json calls = Json::array();
  for (const char* name : {"First", "Middle", "Last"})
    calls.push_back(call("MC_Power", std::string("power_") + name, {{"Axis", name}, {"Enable", true}}));
  calls.push_back(call(
      "MC_GearIn", "gear_m",
      {{"Master", "First"}, {"Slave", "Middle"}, {"Execute", "power_Middle.Status"}, {"RatioNumerator", 3}}));
  calls.push_back(call(
      "MC_GearIn", "gear_l",
      {{"Master", "Middle"}, {"Slave", "Last"}, {"Execute", "power_Last.Status"}, {"RatioNumerator", -7}}));
  calls.push_back(
      call("MC_MoveVelocity", "run", {{"Axis", "First"}, {"Execute", "gear_m.InGear AND gear_l.InGear"}}));
  project["programs"] = {program("Main", "Main", calls, {{"cycle", "1ms"}})};
  const CsvTable table = simulate(project, "1s", "First.Position,Middle.Position,Last.Position");
  ASSERT_GT(table["First.Position"].back(), 10.0);
  for (std::size_t i = 0; i < table.rows; ++i) {
    ASSERT_DOUBLE_EQ(table["Middle.Position"][i], 3.0 * table["First.Position"][i]) << i;
    ASSERT_DOUBLE_EQ(table["Last.Position"][i], -7.0 * table["Middle.Position"][i]) << i;
  }
}

}  // namespace
}  // namespace lockstep::test::time_and_order_test
