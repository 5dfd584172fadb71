// Variables, arrays and system variables of a program as paths: for traces, Modbus and the project's own
// programs, read only.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "projects/studio/tree.hpp"
#include "scheduler/mco305/mco305.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"
#include "tests/support/allocations.hpp"

namespace lockstep::program_values_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;
using std::chrono::milliseconds;

Json project_with(const std::vector<Texts>& programs) {
  Json json = Json::parse(R"({
    "lockstep": 1, "name": "values", "clock": { "servo_cycle": "1ms" },
    "tags": { "twice": { "type": "DINT" } },
    "technology_objects": { "Teddy": { "type": "MCO_305",
      "parameters": { "ENCODER": 500, "VELMAX": 3000, "RAMPMIN": 0.5 }, "programs": [] } }
  })");
  for (std::size_t i = 0; i < programs.size(); ++i)
    json["technology_objects"]["Teddy"]["programs"].push_back(
        {{"number", i}, {"lines", programs[i]}, {"autostart", i == 0}});
  return json;
}

struct Machine {
  Simulation machine;
  explicit Machine(const Json& project) : machine(Simulation::from_text(project.dump())) {}
  explicit Machine(const Texts& program) : Machine(project_with({program})) {}
  void run(int steps) { machine.run_for(milliseconds(steps)); }
  double operator[](const std::string& variable) { return machine.read("Teddy." + variable); }
  Mco305& object() { return static_cast<Mco305&>(*machine.project().controller->objects.at(0)); }
};

std::string problems_of(const Json& project) {
  std::string all;
  for (const Problem& problem : load_project(project.dump()).problems) all += problem.text + "\n";
  return all;
}

const Texts kCounts = {"DIM target1[3], other[2]", "man_vel = 5",   "n = 0",    "main:",    "n = n + 1",
                       "target1[3] = 10 * n",      "other[1] = -n", "DELAY 10", "GOTO main"};

TEST(ProgramValues, AreReadByTheirPaths) {
  Machine run(kCounts);
  EXPECT_EQ(run["Var.n"], 0) << "before the first step";
  run.run(35);
  EXPECT_EQ(run["Var.man_vel"], 5);
  EXPECT_EQ(run["Var.n"], 4);
  EXPECT_EQ(run["var.N"], 4) << "names have any case";
  EXPECT_EQ(run["Var.n.X2"], 1);
  EXPECT_EQ(run["Var.n.X0"], 0);
  EXPECT_EQ(run["Arr.target1[3]"], 40);
  EXPECT_EQ(run["Arr.target1[1]"], 0);
  EXPECT_EQ(run["Arr.other[1]"], -4);
  EXPECT_EQ(run["Arr.target1[3].X3"], 1);
}

// What two Cyclic programs of the project see of a count that the device's program steps in each millisecond.
TEST(ProgramValues, ComeBetweenCyclicProgramsByThePriorityOfTheDevice) {
  const auto behind = [](const Json& priority) {
    Json project = project_with({{"n = 0", "main:", "n = n + 1", "DELAY 1", "GOTO main"}});
    project["tags"] = {
        {"high", {{"type", "DINT"}}}, {"low", {{"type", "DINT"}}}, {"last", {{"type", "DINT"}}}};
    project["programs"] = Json::array();
    const auto program = [&](const char* name, const char* ob, int of, const char* tag) {
      Json one = {{"name", name}, {"ob", ob}, {"cycle", "1ms"}};
      if (of != 0) one["priority"] = of;
      one["calls"] = {{{"set", tag}, {"to", "Teddy.Var.n"}}};
      project["programs"].push_back(one);
    };
    program("Last", "Main", 0, "last");
    program("Low", "Cyclic", 4, "low");
    program("High", "Cyclic", 10, "high");
    if (!priority.is_null()) project["technology_objects"]["Teddy"]["priority"] = priority;
    Machine run(project);
    run.run(20);
    const double last = run.machine.read("last");
    return std::vector<double>{last - run.machine.read("high"), last - run.machine.read("low")};
  };
  using Steps = std::vector<double>;
  EXPECT_EQ(behind(nullptr), (Steps{0, 0})) << "before all Cyclic programs";
  EXPECT_EQ(behind(26), (Steps{0, 0}));
  EXPECT_EQ(behind(10), (Steps{0, 0})) << "of the same one the device is first";
  EXPECT_EQ(behind(9), (Steps{1, 0}));
  EXPECT_EQ(behind(4), (Steps{1, 0}));
  EXPECT_EQ(behind(1), (Steps{1, 1})) << "before Main in any case";
  Json wrong = project_with({kCounts});
  wrong["technology_objects"]["Teddy"]["priority"] = 27;
  EXPECT_NE(problems_of(wrong).find("allowed: an integer from 1 to 26"), std::string::npos)
      << problems_of(wrong);
}

TEST(ProgramValues, AreSignalsOfATraceOfModbusAndOfThePrograms) {
  Json project = project_with({kCounts});
  project["trace"] = {
      {"signals", {"Teddy.Var.n", "Teddy.Arr.target1[3]", "Teddy.Arr.other[1]", "Teddy.SysVar.22"}}};
  project["modbus"] = Json::parse(R"({ "server": { "listen": "127.0.0.1:0" }, "map": [
    { "tag": "Teddy.Var.n", "table": "input_register", "address": 0, "type": "DINT" },
    { "tag": "Teddy.Arr.other[1]", "table": "input_register", "address": 2, "type": "DINT" } ] })");
  project["programs"] = Json::parse(
      R"([ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ { "set": "twice", "to": "2 * Teddy.Var.n" } ] } ])");
  const std::string problems = problems_of(project);
  ASSERT_EQ(problems, "");
  Machine run(project);
  run.run(35);
  EXPECT_EQ(run.machine.read("twice"), 8);
  const auto& signals = run.machine.project().trace.signals;
  ASSERT_EQ(signals.size(), 4u);
  EXPECT_EQ(signals[0].signal.load().i, 4);
  EXPECT_EQ(signals[1].signal.load().i, 40);
  EXPECT_EQ(signals[2].name, "Teddy.Arr.other[1]");
  EXPECT_EQ(signals[2].signal.load().i, -4);
  EXPECT_EQ(signals[3].signal.load().i, 34);
  const ModbusMap& map = run.machine.project().modbus.maps.at(0).map;
  const ModbusEntry* const entry = map.find(ModbusTable::input_register, 2);
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(run.machine.project().modbus.signal_of(*entry).signal.load().i, -4);
}

TEST(ProgramValues, AreReadOnlyFromOutside) {
  Machine run(kCounts);
  EXPECT_THROW(run.machine.write("Teddy.Var.n", 1.0), std::out_of_range);
  EXPECT_THROW(run.machine.write("Teddy.Arr.other[1]", 1.0), std::out_of_range);
  EXPECT_THROW(run.machine.write("Teddy.SysVar.4107", 1.0), std::out_of_range);
  Json project = project_with({kCounts});
  project["programs"] = Json::parse(
      R"([ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ { "set": "Teddy.Var.n", "to": "1" } ] } ])");
  EXPECT_NE(problems_of(project).find("computed by the runtime and cannot be written"), std::string::npos);
}

TEST(ProgramValues, SayWhatIsThere) {
  Machine run(kCounts);
  const auto said = [&](const char* path) {
    try {
      run[path];
    } catch (const std::out_of_range& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(said("Var.man_vl").find("has no variable 'Var.man_vl' (did you mean 'Var.man_vel'?)"),
            std::string::npos)
      << said("Var.man_vl");
  EXPECT_EQ(said("Arr.target1[4]"),
            "'Teddy.Arr.target1[4]' is no element of an array of 3; allowed: [1] to [3]");
  EXPECT_EQ(said("Arr.target1[0]"),
            "'Teddy.Arr.target1[0]' is no element of an array of 3; allowed: [1] to [3]");
  EXPECT_NE(said("Arr.target1[x"), "");
  EXPECT_NE(said("Arr.target1[]"), "");
  EXPECT_NE(said("Arr.target1"), "");
  EXPECT_NE(said("Var.n[1]"), "");
  EXPECT_NE(said("SysVar.4219"), "");
}

// Variables of several programs have one name for each, whichever runs.
TEST(ProgramValues, OfSeveralProgramsStayWhereTheyAre) {
  const Texts first = {"a = 1", "shared = 2", "SET PRGPAR 1", "DELAY 10"};
  const Texts second = {"DIM field[4]", "b = 3",        "c = b + 1", "Shared = 5",
                        "field[2] = 7", "SET PRGPAR 0", "DELAY 10"};
  Machine run(project_with({first, second}));
  const auto seen = [&] {
    return std::vector<double>{run["Program.Number"], run["Var.a"], run["Var.shared"], run["Var.b"],
                               run["Var.c"]};
  };
  run.run(5);
  EXPECT_EQ(seen(), (std::vector<double>{0, 1, 2, 0, 0}));
  run.run(12);
  EXPECT_EQ(seen(), (std::vector<double>{1, 0, 5, 3, 4}));
  EXPECT_EQ(run["Arr.field[2]"], 7);
  run.run(12);
  EXPECT_EQ(seen(), (std::vector<double>{0, 1, 2, 0, 0}));
  EXPECT_EQ(run["Arr.field[2]"], 7) << "arrays are those of the device";
}

// A program has 92 variables, and what the others have does not count.
TEST(ProgramValues, OfOtherProgramsTakeNoVariable) {
  std::vector<Texts> programs(2);
  for (int i = 0; i < 92; ++i) {
    programs[0].push_back("a" + std::to_string(i) + " = " + std::to_string(i));
    programs[1].push_back("b" + std::to_string(i) + " = " + std::to_string(100 + i));
  }
  programs[0].insert(programs[0].end(), {"SET PRGPAR 1", "DELAY 5"});
  programs[1].emplace_back("DELAY 1000");
  ASSERT_EQ(problems_of(project_with(programs)), "");
  Machine run(project_with(programs));
  run.run(4);
  EXPECT_EQ(run["Var.a91"], 91);
  run.run(20);
  EXPECT_EQ(run["Var.b91"], 191);
  EXPECT_EQ(run["Var.a91"], 0);
  programs[0].insert(programs[0].begin(), "more = 1");
  EXPECT_NE(problems_of(project_with(programs)).find("the program has 93 variables and arrays"),
            std::string::npos);
}

// Two names of the same array; and none behind one of which programs say different sizes.
TEST(ProgramValues, OfArraysAreKnownByTheirOrder) {
  const Texts first = {"DIM one[2], two[3]", "one[1] = 11", "two[1] = 22", "DELAY 1000"};
  const Texts second = {"DIM uno[2], due[4], tre[1]", "DELAY 1000"};
  Machine run(project_with({first, second}));
  run.run(3);
  EXPECT_EQ(run["Arr.one[1]"], 11);
  EXPECT_EQ(run["Arr.uno[1]"], 11);
  EXPECT_THROW(run["Arr.two[1]"], std::out_of_range);
  EXPECT_THROW(run["Arr.tre[1]"], std::out_of_range);
}

TEST(ProgramValues, OfArraysThatAreDeletedAndMadeAnew) {
  Machine run(Texts{"DIM field[2]", "n = field[1]", "field[1] = 5", "DELAY 5", "DELETE ARRAYS"});
  run.run(3);
  EXPECT_EQ(run["Arr.field[1]"], 5);
  run.run(4);
  EXPECT_EQ(run["Var.n"], 0) << "its second run began with new ones";
  EXPECT_EQ(run["Arr.field[1]"], 5);
}

TEST(SystemVariablesAsPaths, AgreeWithWhatAProgramReads) {
  Machine run(
      Texts{"VEL 100", "ACC 100", "DEC 100", "PULSACC 100000", "PULSVEL 4000", "SYNCP", "DELAY 100000"});
  int moving = 0;
  for (int i = 0; i < 30; ++i) {
    run.run(37);
    for (const mco305::SystemVariable& of : mco305::system_variables()) {
      std::int32_t value = 0;
      const std::string path = "SysVar." + std::to_string(of.index);
      const double shown = run[path];
      if (!run.object().device().system_variable(of.index, value)) {
        EXPECT_FALSE(of.built) << of.index;
        EXPECT_EQ(shown, 0);
        continue;
      }
      EXPECT_EQ(shown, value) << of.index;
      EXPECT_EQ(run["SysVar." + std::string(of.name)], value) << of.name;
      moving += value != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(moving, 500);
}

TEST(SystemVariablesAsPaths, AreThereAtTheFirstLook) {
  Machine run(Texts{"DELAY 100000"});
  run.run(10);
  EXPECT_EQ(run["SysVar.22"], 9);
  EXPECT_EQ(run["SysVar.33"], 1);
}

TEST(ProgramValues, AllocateNothingInTheCycle) {
  Machine run(kCounts);
  run["Var.n"], run["SysVar.4107"], run["Arr.other[1]"];
  run.run(10);
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counted;
    run.run(100);
  }
  EXPECT_EQ(test::allocations_counted(), before);
}

TEST(ProgramValues, StandInTheTreeOfTheStudio) {
  Machine run(kCounts);
  std::vector<std::string> found;
  for (const StudioSignal& one : studio_signals(run.machine.project(), StudioUnits(run.machine.project())))
    if (one.path.find(".Var.") != std::string::npos || one.path.find(".Arr.") != std::string::npos)
      found.push_back(one.path);
  EXPECT_EQ(found, (Texts{"Teddy.Var.man_vel", "Teddy.Var.n", "Teddy.Arr.target1[1]", "Teddy.Arr.target1[2]",
                          "Teddy.Arr.target1[3]", "Teddy.Arr.other[1]", "Teddy.Arr.other[2]"}));
}

}  // namespace
}  // namespace lockstep::program_values_test
