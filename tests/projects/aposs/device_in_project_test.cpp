// An MCO 305 as an object of a project: its program in the tick, wiring, what it tells, what the loader
// refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hmi_bridge/traces/event.hpp"
#include "projects/loader/simulation.hpp"
#include "projects/runtime/stepped_run.hpp"
#include "tests/support/allocations.hpp"

namespace lockstep::device_in_project_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

/// One device whose program waits for `start`, and switches `done`.
Json project_with(const Texts& program) {
  Json json = Json::parse(R"({
    "lockstep": 1, "name": "device", "clock": { "servo_cycle": "250us" },
    "tags": { "start": { "type": "BOOL" }, "done": { "type": "BOOL" } },
    "stimuli": [ { "at": "100ms", "set": { "start": true } } ],
    "technology_objects": { "Lift": {
      "type": "MCO_305",
      "parameters": { "VELMAX": 3000, "1900": 4000 },
      "inputs": { "1": "start" }, "outputs": { "1": "done" },
      "programs": [ { "number": 7, "autostart": true } ] } },
    "trace": { "signals": [ "Lift.CPOS", "done" ] }
  })");
  json["technology_objects"]["Lift"]["programs"][0]["lines"] = program;
  return json;
}

const Texts kMoves = {"VEL 100",    "ACC 100",         "DEC 100",  "PRINT \"waits\"",
                      "WAITI 1 ON", "POSA (GET 1900)", "OUT 1 1",  "PRINT \"at\", APOS",
                      "rest:",      "DELAY 1000",      "GOTO rest"};

TEST(DeviceInAProject, IsStartedByATagAndSwitchesOneWhenItHasArrived) {
  Simulation machine = Simulation::from_text(project_with(kMoves).dump());
  machine.run_for(std::chrono::milliseconds(100));
  EXPECT_EQ(machine.read("Lift.CPOS"), 0.0);
  EXPECT_EQ(machine.read("Lift.Program.Number"), 7.0);
  double before = 0.0, fastest = 0.0;
  while (machine.read("done") == 0.0 && machine.now() < std::chrono::seconds(5)) {
    machine.run_for(std::chrono::milliseconds(1));
    const double position = machine.read("Lift.CPOS");
    fastest = std::max(fastest, std::abs(position - before));
    before = position;
  }
  EXPECT_EQ(machine.read("Lift.CPOS"), 4000.0);
  EXPECT_EQ(machine.read("Lift.APOS"), 4000.0);
  EXPECT_EQ(machine.read("done"), 1.0);
  EXPECT_LE(fastest, 101.0);  // VELMAX of 3000 1/min and 2000 counts a turn are 100 in a millisecond
  EXPECT_GE(fastest, 10.0);
  machine.run_for(std::chrono::milliseconds(10));
  EXPECT_EQ(machine.read("Lift.CPOS"), 4000.0);
}

TEST(DeviceInAProject, TellsWhatItsProgramPrints) {
  Project project = std::move(*load_project(project_with(kMoves).dump()).project);
  SteppedRun run(std::move(project), {});
  run.project().controller->apply_stimuli = true;
  run.step(20'000);
  Texts printed;
  for (const TraceEvent& event : run.events()) {
    EXPECT_EQ(event.kind, EventKind::printed);
    EXPECT_EQ(event.source, "Lift");
    EXPECT_EQ(event.type, "MCO_305");
    printed.push_back(event.text);
  }
  EXPECT_EQ(printed, (Texts{"waits", "at 4000"}));
}

TEST(DeviceInAProject, TellsItsErrorWithProgramAndLine) {
  Project project = std::move(*load_project(project_with({"a = 1", "b = SYSVAR[9999]"}).dump()).project);
  SteppedRun run(std::move(project), {});
  run.step(100);
  ASSERT_EQ(run.events().size(), 1u);
  const TraceEvent& event = run.events()[0];
  EXPECT_EQ(event.kind, EventKind::program_error);
  EXPECT_EQ(event.source, "Lift");
  EXPECT_EQ(event.number, 112);
  EXPECT_NE(event.text.find("; program 7, line 2"), std::string::npos) << event.text;
}

TEST(DeviceInAProject, AllocatesNothingInTheCycle) {
  Simulation machine = Simulation::from_text(
      project_with({"ON ERROR GOSUB trouble", "VEL 100", "ACC 100", "DEC 100", "again:", "POSA 1000",
                    "PRINT \"at\", APOS", "a = SYSVAR[9999]", "POSA 0", "GOTO again", "SUBMAINPROG",
                    "SUBPROG trouble", "ERRCLR", "RETURN", "ENDPROG"})
          .dump());
  EventQueue events(64);
  machine.project().controller->events = &events;
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    machine.run_for(std::chrono::seconds(5));
  }
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_GT(events.lost() + events.readable(), 3u);
}

/// What happens to a device in its executed ticks, of which the wall clock leaves some out.
std::vector<double> seen_with(int every) {
  Json json = project_with({"VEL 50", "ACC 50", "DEC 50", "again:", "POSA 20000", "OUT 1 1", "DELAY 7",
                            "POSA 0", "OUT 1 0", "GOTO again"});
  json["technology_objects"]["Lift"]["drive"] = {{"model", "simulated"}, {"time_constant", "3ms"}};
  json["technology_objects"]["Lift"]["parameters"]["FFVEL"] = 1000;
  Simulation machine = Simulation::from_text(json.dump());
  std::vector<double> seen;
  for (int i = 0; i < 20'000; ++i) {
    if (every != 0 && i % every == every - 1) machine.project().controller->skip(1 + i % 7);
    machine.step();
    for (const char* const path : {"Lift.CPOS", "Lift.APOS", "Lift.TRACKERR", "Lift.ERRNO", "done"})
      seen.push_back(machine.read(path));
  }
  return seen;
}

// In virtual time no tick is missed; in real time the device is later, like its machine, and does not jump.
TEST(DeviceInAProject, IsLaterAfterMissedTicksAndNothingElse) {
  const std::vector<double> whole = seen_with(0);
  EXPECT_EQ(seen_with(3), whole);
  EXPECT_EQ(seen_with(50), whole);
  EXPECT_NE(*std::max_element(whole.begin(), whole.end()), 0.0);
}

// Nobody reads for a while: each line that is told has its own text, and those that are lost are counted.
TEST(DeviceInAProject, TellsHowManyLinesAreLost) {
  Simulation machine =
      Simulation::from_text(project_with({"n = 0", "again:", "n = n + 1", "PRINT n", "GOTO again"}).dump());
  Controller& controller = *machine.project().controller;
  EventQueue events;
  controller.events = &events;
  const EventTexts texts(controller, 0);
  std::int64_t last = 0, told_lines = 0, lost = 0;
  const auto read = [&] {
    for (; events.readable() != 0; events.pop(1)) {
      const TraceEvent told = texts.of(events.event(0), 0);
      if (told.number != 0) {
        EXPECT_NE(told.text.find(" are lost"), std::string::npos) << told.text;
        lost += told.number;
        continue;
      }
      const std::int64_t line = std::stoll(told.text);
      EXPECT_GT(line, last);
      last = line;
      ++told_lines;
    }
  };
  machine.run_for(std::chrono::milliseconds(1000));
  read();
  EXPECT_EQ(told_lines, 2048);
  for (int i = 0; i < 100; ++i) {
    machine.step();
    read();
  }
  EXPECT_GT(lost, 1000);
  EXPECT_GT(last, 60'000) << "66 lines in a millisecond";
  EXPECT_EQ(told_lines + lost, last) << "none is missing without a word";
  EXPECT_EQ(events.lost(), 0u);
}

/// What is warned of a device with more in its place, one line each.
std::string warned_of(const Json& device) {
  Json json = project_with(kMoves);
  json["technology_objects"]["Lift"].merge_patch(device);
  std::string all;
  for (const Problem& problem : load_project(json.dump()).warnings)
    all += problem.place + ": " + problem.text + "\n";
  return all;
}

// Published: 0 to the distance of the markers (33-21, 33-22).
TEST(DeviceInAProject, IsWarnedOfWindowsThatAreWiderThanTheDistanceOfTheirMarkers) {
  const std::string at = "/technology_objects/Lift/parameters/";
  EXPECT_EQ(warned_of({{"parameters", {{"SYNCMWINM", 4096}, {"SYNCMWINS", 4096}}}}), "");
  EXPECT_EQ(warned_of({{"parameters", {{"SYNCMWINM", 4097}}}}),
            at + "SYNCMWINM: 33-21 SYNCMWINM = 4097 is wider than the distance of the markers; allowed: 0 to "
                 "4096, which is 33-17 SYNCMPULSM\n");
  EXPECT_EQ(warned_of({{"parameters", {{"33-22", 500}, {"SYNCMPULSS", 400}, {"SYNCMPULSM", 400}}}}),
            at + "33-22: 33-22 SYNCMWINS = 500 is wider than the distance of the markers; allowed: 0 to 400, "
                 "which is 33-18 SYNCMPULSS\n");
}

TEST(DeviceInAProject, IsWarnedOfMarkersThatLieOffByMoreThanHalfTheirPeriod) {
  const std::string told =
      " is more than half the period: markers may change places; allowed without this warning: 0 to 2000\n";
  EXPECT_EQ(warned_of({{"markers", {{"period", 4000}, {"noise", 2000}}}}), "");
  EXPECT_EQ(warned_of({{"markers", {{"period", 4000}, {"noise", 3000}}}}),
            "/technology_objects/Lift/markers/noise: 3000" + told);
  EXPECT_EQ(warned_of({{"master", {{"markers", {{"period", 4000}, {"noise", 1e12}}}}}}),
            "/technology_objects/Lift/master/markers/noise: 1000000000000.0" + told);
}

struct Refused {
  const char* place;
  Json value;
  const char* told;
};

class DeviceOfAProject : public testing::TestWithParam<Refused> {};

TEST_P(DeviceOfAProject, IsRefusedWithPlaceValueAndWhatIsAllowed) {
  Json json = project_with(kMoves);
  json[Json::json_pointer(GetParam().place)] = GetParam().value;
  const LoadedProject loaded = load_project(json.dump());
  EXPECT_FALSE(loaded.project.has_value());
  std::string all;
  for (const Problem& problem : loaded.problems) all += problem.place + ": " + problem.text + "\n";
  EXPECT_NE(all.find(GetParam().told), std::string::npos) << all;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, DeviceOfAProject,
    testing::Values(
        Refused{"/technology_objects/Lift/parameters/VELMAXX", 1, "(nearest: VELMAX 32-80)"},
        Refused{"/technology_objects/Lift/parameters/32-80", 1, "are one parameter"},
        Refused{"/technology_objects/Lift/parameters/VELMAX", 0,
                "/technology_objects/Lift/parameters/VELMAX: "},
        Refused{"/technology_objects/Lift/parameters/SYNCFACTM", 0, "nothing can be computed with it"},
        Refused{"/technology_objects/Lift/inputs/13", "start", "is no number of one; allowed: 1, 2, 3"},
        Refused{"/technology_objects/Lift/outputs/1", "nothing", "/technology_objects/Lift/outputs/1: "},
        Refused{"/technology_objects/Lift/programs/0/file", "x.m", "a program is a 'file' or 'lines'"},
        Refused{"/technology_objects/Lift/programs/0/lines", {"POSA"}, "/programs/0/lines: "},
        Refused{"/clock/servo_cycle", "3ms", "allowed: one that divides 1ms"}));

}  // namespace
}  // namespace lockstep::device_in_project_test
