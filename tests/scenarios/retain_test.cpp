// Values that are kept across runs, through the command line: also when a run is killed.
#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <regex>

#include "hmi_bridge/retain/file.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::retain_test {
namespace {

/// Two tags and an array that change together in every millisecond, and go on from what was kept.
Json counting() {
  Json project = empty_project();
  project["tags"] = {{"count", {{"type", "DINT"}, {"init", 5}, {"retain", true}}},
                     {"triple", {{"type", "LREAL"}, {"init", 15.0}, {"retain", true}}},
                     {"row", {{"type", "ARRAY[1..3] OF DINT"}, {"init", {5, 5, 5}}, {"retain", true}}},
                     {"passing", {{"type", "DINT"}}}};
  project["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {assignment("count", "count + 1"), assignment("triple", "TO_LREAL(count) * 3.0"),
         assignment("row[1]", "TO_DINT(count)"), assignment("row[2]", "row[2] + 1"),
         assignment("row[3]", "TO_DINT(count)"), assignment("passing", "TO_DINT(count)")}}});
  project["retain"] = {{"interval", "1ms"}};
  return project;
}

std::vector<std::string> quietly(const std::string& project, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run", project, "--no-modbus", "--no-lcm"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// What the file beside a project holds; -1: no count.
int kept_count(const std::string& file) {
  const RetainFile opened(file, "small");
  const KeptRow* const count = opened.find("count");
  if (count == nullptr) return -1;
  EXPECT_EQ(std::stod(opened.find("triple")->value), 3.0 * std::stod(count->value)) << "two instants mixed";
  EXPECT_EQ(opened.find("row")->value, count->value + "," + count->value + "," + count->value)
      << "two instants mixed, or an element not given back";
  EXPECT_EQ(opened.find("passing"), nullptr);
  return std::stoi(count->value);
}

TEST(Retain, AFileOfAnotherProjectIsNotCalledNew) {
  const Directory directory;
  const std::string kept = directory.file("both.retain");
  Json project = counting();
  const std::string one = directory.write("one.json", project.dump());
  project["name"] = "other";
  const std::string other = directory.write("other.json", project.dump());
  ASSERT_EQ(lockstep(quietly(one, {"--duration", "50ms", "--retain", kept})).status, 0);
  const Ended second = lockstep(quietly(other, {"--duration", "50ms", "--retain", kept}));
  EXPECT_NE(second.err.find("it has values of project 'small' and none of 'other'"), std::string::npos);
  EXPECT_EQ(second.err.find("which is new"), std::string::npos) << second.err;
}

// As beside an example that the package has installed, where only root may write.
TEST(Retain, WhereNoFileCanBeMadeTheRunSaysWhyAndWhatMayBeDone) {
  const Directory directory;
  Json project = counting();
  project["retain"]["file"] = "/proc/nowhere/values.retain";
  const Ended ended = lockstep(quietly(directory.write("project.json", project.dump())));
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("/proc/nowhere/values.retain: it can neither be opened nor made: No such file"),
            std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("--no-retain begins with their init values"), std::string::npos) << ended.err;
}

TEST(Retain, ARunGoesOnWhereTheOneBeforeEnded) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  const Ended first = lockstep(quietly(project, {"--duration", "100ms"}));
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("project.retain, which is new"), std::string::npos) << first.err;
  const int count = kept_count(directory.file("project.retain"));
  EXPECT_GT(count, 5);
  EXPECT_LE(count, 105);
  const Ended second = lockstep(quietly(project, {"--duration", "50ms"}));
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_NE(second.err.find("3 kept values from"), std::string::npos) << second.err;
  EXPECT_GT(kept_count(directory.file("project.retain")), count);
}

TEST(Retain, ASignalThatEndsARunKeepsTheValuesOfItsLastTick) {
  const Directory directory;
  Json json = counting();
  json["retain"] = {{"interval", "1h"}, {"file", "state/kept.db"}};
  json["tags"]["speed"] = {{"type", "LREAL"}, {"init", 1.0}, {"retain", true}};
  json["modbus"]["map"] = {
      {{"tag", "speed"}, {"table", "holding_register"}, {"address", 0}, {"type", "REAL"}}};
  const std::string project = directory.write("project.json", json.dump());
  std::filesystem::create_directory(directory.file("state"));
  RunningLockstep run(project);
  ModbusClient(run.port()).write_float(0, 42.5F);
  run.send(SIGTERM);
  ASSERT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(RetainFile(directory.file("state/kept.db"), "small").find("speed")->value, "42.5");
}

/// When a file was changed last.
std::filesystem::file_time_type written(const std::string& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

TEST(Retain, KilledAtAnyTimeARunLosesNothingOlderThanItsIntervalAndMixesNothing) {
  const int kills = test::cases(30, 3000);
  std::mt19937 random(test::seed_of_test(20260713));
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  const std::string file = directory.file("project.retain");
  int before = -1;
  int grown = 0;
  for (int i = 0; i < kills; ++i) {
    const auto last = written(file);
    Process run(lockstep_command(quietly(project)));
    // Every second one from when it writes, so that a busy machine comes to that too.
    if (i % 2 == 0) {
      ASSERT_TRUE(wait_until([&] { return written(file) != last; }));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 120'000));
    run.send(SIGKILL);
    run.status();
    const int now = kept_count(file);
    ASSERT_GE(now, before) << "kill " << i << ": an older state came back";
    if (now > before) ++grown;
    before = now;
  }
  EXPECT_GT(grown, kills / 4) << "too few of the runs came to writing anything";
}

TEST(Retain, AnArrayOfAnotherShapeIsToldAndStaysInTheFile) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  ASSERT_EQ(lockstep(quietly(project, {"--duration", "50ms"})).status, 0);
  Json json = counting();
  json["tags"]["row"]["type"] = "ARRAY[0..4] OF DINT";
  directory.write("project.json", json.dump());
  Ended ended = lockstep(quietly(project, {"--duration", "50ms"}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("row was kept as ARRAY[1..3] OF DINT ("), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("and is ARRAY[0..4] OF DINT now: it begins with its init value"),
            std::string::npos);
  ended = lockstep(quietly(project, {"--duration", "50ms"}));
  EXPECT_EQ(ended.err.find("row was kept"), std::string::npos) << "told once: " << ended.err;
  EXPECT_NE(ended.err.find("row@ARRAY[1..3] OF DINT ("), std::string::npos) << ended.err;
  EXPECT_NE(RetainFile(directory.file("project.retain"), "small").find("row@ARRAY[1..3] OF DINT"), nullptr);
}

TEST(Retain, ASimulationNeitherReadsNorWrites) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  const auto simulate = [&] {
    const CsvTable table = test::simulate(project, "10ms", {"--signals", "count"});
    return table["count"].back();
  };
  EXPECT_EQ(simulate(), 15.0);
  EXPECT_FALSE(std::filesystem::exists(directory.file("project.retain")));
  ASSERT_EQ(lockstep(quietly(project, {"--duration", "100ms"})).status, 0);
  const std::string kept = content(directory.file("project.retain"));
  EXPECT_EQ(simulate(), 15.0);
  EXPECT_EQ(content(directory.file("project.retain")), kept);
  EXPECT_EQ(lockstep({"run", project, "--simulate", "--retain", "x"}).status, 2);
}

TEST(Retain, TheCommandLineNamesAnotherFileOrNone) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  const std::string other = directory.file("other");
  ASSERT_EQ(lockstep(quietly(project, {"--duration", "20ms", "--retain", other})).status, 0);
  EXPECT_GT(kept_count(other), 5);
  ASSERT_EQ(lockstep(quietly(project, {"--duration", "20ms", "--no-retain"})).status, 0);
  EXPECT_FALSE(std::filesystem::exists(directory.file("project.retain")));
}

TEST(Retain, AServiceKeepsItsValuesInTheStateDirectoryThatSystemdGivesIt) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  std::filesystem::create_directory(directory.file("state"));
  std::vector<std::string> command{"env", "STATE_DIRECTORY=" + directory.file("state") + ":/var/empty"};
  for (const std::string& word : lockstep_command(quietly(project, {"--duration", "20ms"})))
    command.push_back(word);
  EXPECT_EQ(Process(command).status(), 0);
  EXPECT_GT(kept_count(directory.file("state/project.retain")), 5);
  EXPECT_FALSE(std::filesystem::exists(directory.file("project.retain")));
}

TEST(Retain, ADamagedFileIsNoPlaceToStartFrom) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  directory.write("project.retain", std::string(8192, 'x'));
  const Ended ended = lockstep(quietly(project, {"--duration", "20ms"}));
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("project.retain: it is damaged"), std::string::npos) << ended.err;
  EXPECT_EQ(content(directory.file("project.retain")), std::string(8192, 'x')) << "it is not touched";
}

TEST(Retain, AFileInUseByAnotherRunIsNotShared) {
  const Directory directory;
  Json json = counting();
  json["modbus"]["map"] = {{{"tag", "count"}, {"table", "input_register"}, {"address", 0}}};
  const std::string project = directory.write("project.json", json.dump());
  RunningLockstep run(project);
  const Ended second = lockstep(quietly(project, {"--duration", "20ms"}));
  EXPECT_EQ(second.status, 2);
  EXPECT_NE(second.err.find("in use by another run"), std::string::npos) << second.err;
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
}

TEST(Retain, ATagOfAnotherTypeAndOneThatIsGoneAreTold) {
  const Directory directory;
  const std::string project = directory.write("project.json", counting().dump());
  ASSERT_EQ(lockstep(quietly(project, {"--duration", "20ms"})).status, 0);
  Json changed = counting();
  changed["tags"]["count"]["type"] = "LINT";
  changed["tags"]["triple"]["retain"] = false;
  directory.write("project.json", changed.dump());
  const Ended ended = lockstep(quietly(project, {"--duration", "20ms"}));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(std::regex_search(ended.err, std::regex("count was kept as DINT \\([0-9]+\\) and is LINT now")))
      << ended.err;
  EXPECT_TRUE(std::regex_search(ended.err, std::regex("triple \\([0-9.]+\\) is kept there and not in the")))
      << ended.err;
}

TEST(Retain, AnAdjustedEncoderKnowsWhereItIsInTheNextRun) {
  const Directory directory;
  Json json = empty_project();
  json["technology_objects"]["Slide"] = {{"type", "TO_PositioningAxis"},
                                         {"config", {{"Sensor[1]", {{"Type", 1}}}}},
                                         {"drive", {{"model", "simulated"}, {"start_position", 40.0}}}};
  json["tags"]["go"] = {{"type", "BOOL"}, {"init", true}};
  json["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power", {{"Axis", "Slide"}, {"Enable", true}}),
         call("MC_Home", "home",
              {{"Axis", "Slide"}, {"Execute", "power.Status AND go"}, {"Mode", 7}, {"Position", 1000.0}})}}});
  const std::string project = directory.write("project.json", json.dump());
  const auto last = [&](const std::string& signal) {
    const std::string trace = directory.file("t.csv");
    const Ended ended =
        lockstep(quietly(project, {"--duration", "100ms", "--trace", trace, "--signals", signal}));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return read_csv(trace)[signal].back();
  };
  EXPECT_EQ(last("Slide.StatusSensor[1].AbsEncoderOffset"), 960.0);
  json["tags"]["go"]["init"] = false;
  directory.write("project.json", json.dump());
  EXPECT_EQ(last("Slide.ActualPosition"), 1000.0);
  EXPECT_EQ(last("Slide.StatusWord.X5"), 1.0) << "homed";
  // With another gear the value of the encoder means another place.
  json["technology_objects"]["Slide"]["config"]["LoadGear"] = {{"Numerator", 2}};
  directory.write("project.json", json.dump());
  const Ended other = lockstep(quietly(project, {"--duration", "50ms"}));
  EXPECT_NE(other.err.find("LoadGear.Numerator=2"), std::string::npos) << other.err;
  EXPECT_EQ(last("Slide.StatusWord.X5"), 0.0) << "nobody knows where it is";
}

/// The interval is long, and the run is killed: all that the file has is what the job was for.
TEST(Retain, WhatMC_SaveAbsoluteEncoderDataHasDoneOutlivesTheRun) {
  const Directory directory;
  Json json = empty_project();
  json["technology_objects"]["Slide"] = {{"type", "TO_PositioningAxis"},
                                         {"config", {{"Sensor[1]", {{"Type", 1}}}}},
                                         {"drive", {{"model", "simulated"}, {"start_position", 40.0}}}};
  json["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power", {{"Axis", "Slide"}, {"Enable", true}}),
         call("MC_Home", "home",
              {{"Axis", "Slide"}, {"Execute", "power.Status"}, {"Mode", 7}, {"Position", 1000.0}}),
         call("MC_SaveAbsoluteEncoderData", "save", {{"Execute", "home.Done"}})}}});
  json["retain"] = {{"interval", "1h"}};
  json["modbus"]["map"] = {{{"tag", "save.Done"}, {"table", "discrete_input"}, {"address", 0}}};
  const std::string project = directory.write("project.json", json.dump());
  RunningLockstep run(project);
  ModbusClient client(run.port());
  ASSERT_TRUE(wait_until([&] { return client.input(0); }));
  run.send(SIGKILL);
  run.status();
  const RetainFile kept(directory.file("project.retain"), "small");
  ASSERT_NE(kept.find("Slide.StatusSensor[1].AbsEncoderOffset"), nullptr);
  EXPECT_EQ(kept.find("Slide.StatusSensor[1].AbsEncoderOffset")->value, "960");

  const CsvTable simulated = simulate(project, "100ms", {"--signals", "save.Done,save.ErrorID"});
  EXPECT_EQ(simulated["save.Done"].back(), 0.0);
  EXPECT_EQ(simulated["save.ErrorID"].back(), 0x80EF) << "a simulation keeps nothing";
}

}  // namespace
}  // namespace lockstep::test::retain_test
