// What an MCO 305 keeps across runs: arrays and parameters by SAVE, those of the application by themselves.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/retain/writer.hpp"
#include "projects/loader/project.hpp"
#include "scheduler/mco305/mco305.hpp"
#include "tests/hmi_bridge/memory_disk.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::device_retain_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

struct Machine {
  std::string file;
  Texts program;
  Json parameters = {{"KPROP", 30}, {"1900", 4}};
  std::vector<std::string> remarks{};
  bool loses_its_disk = false;  ///< when the run has begun
  const char* disk = nullptr;   ///< name of SQLite's access to files; nullptr: the usual one
  std::size_t rests_in = 0;     ///< line of the loop in which it has done all; 0: the last one but one
  Json map = Json::array();     ///< of Modbus
  std::vector<std::pair<std::int32_t, DINT>> panel{};  ///< parameters that a client writes in the third tick

  std::string text() const {
    Json json = Json::parse(R"({ "lockstep": 1, "name": "kept", "clock": { "servo_cycle": "1ms" },
      "technology_objects": { "Lift": { "type": "MCO_305", "programs": [ { "number": 0, "autostart": true } ] } } })");
    json["technology_objects"]["Lift"]["parameters"] = parameters;
    json["technology_objects"]["Lift"]["programs"][0]["lines"] = program;
    if (!map.empty()) json["modbus"] = {{"server", {{"listen", "127.0.0.1:0"}}}, {"map", map}};
    return json.dump();
  }

  /// One run, which ends at once like a loss of power when its program is at its end.
  std::unique_ptr<Project> run() {
    std::unique_ptr<RetainWriter> writer;
    remarks.clear();
    LoadedProject loaded = load_project(text(), "", [&](Project& project) {
      RetainFile kept(file, project.name, disk);
      remarks = restore(kept, project.retain.values);
      writer = std::make_unique<RetainWriter>(std::move(kept), project.retain.values, std::chrono::seconds(1),
                                              &project.controller->encoder_saving);
    });
    if (!loaded.project) return nullptr;
    auto project = std::make_unique<Project>(std::move(*loaded.project));
    Controller& controller = *project->controller;
    controller.images.push_back(&writer->image());
    writer->start();
    if (loses_its_disk) std::filesystem::remove_all(std::filesystem::path(file).parent_path());
    constexpr int kTries = 20'000;
    Mco305& device = device_of(*project);
    for (int i = 0; i < kTries && !waits(device); ++i) {
      controller.tick();
      if (i == 2)
        for (const auto& [number, value] : panel)
          device.data.Parameters[mco305::parameter_index(number)] = value;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the disk has its own time
    }
    EXPECT_TRUE(waits(device)) << "error " << device.machine().error();
    writer->stop();
    return project;
  }
  static Mco305& device_of(Project& project) {
    return static_cast<Mco305&>(*project.controller->objects.front());
  }
  /// In its last line but one: everything has been saved.
  bool waits(Mco305& device) const {
    const std::size_t line = device.machine().place().line;
    return rests_in != 0 ? line >= rests_in && line <= rests_in + 2
                         : line >= program.size() - 1 || device.machine().over();
  }
};

std::int32_t element(Project& project, const std::string& name) {
  const Mco305& device = Machine::device_of(project);
  for (std::size_t i = 0; i < device.program()->image.variables.size(); ++i)
    if (device.program()->image.variables[i] == name)
      return Machine::device_of(project).machine().variable(i);
  return -1;
}

const Texts kCounts = {"DIM a[3], b[2]",   "SET 1900 (GET 1900 + 1)",
                       "a[2] = a[2] + 10", "b[2] = b[2] + 1",
                       "k = GET KPROP",    "SET KPROP (k + 5)",
                       "SET 33-83 2",      "SAVE ARRAYS",
                       "SAVE AXPARS",      "x = a[2]",
                       "y = b[2]",         "z = GET 1900",
                       "e = GET 33-83",    "wait:",
                       "DELAY 100",        "GOTO wait"};

TEST(DeviceRetain, GivesBackWhatHasBeenSaved) {
  const test::Directory directory;
  Machine machine{directory.file("kept"), kCounts};
  for (int run = 1; run <= 3; ++run) {
    const auto project = machine.run();
    ASSERT_NE(project, nullptr);
    EXPECT_EQ(element(*project, "x"), 10 * run);
    EXPECT_EQ(element(*project, "y"), run);
    EXPECT_EQ(element(*project, "z"), 4 + run) << "1900: by itself";
    EXPECT_EQ(element(*project, "k"), 30 + 5 * (run - 1)) << "AXPARS";
    EXPECT_EQ(Machine::device_of(*project).eeprom.writes, static_cast<UDINT>(2 * run));
    EXPECT_EQ(machine.remarks, Texts{});
  }
}

TEST(DeviceRetain, TellsThatTheDiskIsNotThereAnyMore) {
  const test::Directory directory;
  const std::string folder = directory.file("disk");
  std::filesystem::create_directory(folder);
  Machine machine{
      .file = folder + "/kept",
      .program = {"found = 0", "ON ERROR GOSUB trouble", "SET KPROP 31", "SAVE AXPARS",
                  "wait:", "IF (found == 0) THEN", "GOTO wait", "ENDIF", "rest:", "DELAY 100", "GOTO rest",
                  "SUBMAINPROG", "SUBPROG trouble", "found = ERRNO", "ERRCLR", "RETURN", "ENDPROG"},
      .loses_its_disk = true};
  machine.rests_in = 9;
  const auto project = machine.run();
  ASSERT_NE(project, nullptr);
  EXPECT_EQ(element(*project, "found"), 115);
}

// The disk keeps another value than was written: it is read back.
TEST(DeviceRetain, TellsThatTheDiskKeepsSomethingElse) {
  for (const bool spoils : {false, true}) {
    test::MemoryDisk disk;
    if (spoils) disk.spoiled = "815,4711";
    Machine machine{.file = "kept",
                    .program = {"DIM a[2]",
                                "found = -1",
                                "ON ERROR GOSUB trouble",
                                "a[1] = 815",
                                "a[2] = 4711",
                                "SAVE ARRAYS",
                                "DELAY 20",
                                "IF (found == -1) THEN",
                                "found = 0",
                                "ENDIF",
                                "rest:",
                                "DELAY 100",
                                "GOTO rest",
                                "SUBMAINPROG",
                                "SUBPROG trouble",
                                "found = ERRNO",
                                "bits = GET 34-70",
                                "ERRCLR",
                                "RETURN",
                                "ENDPROG"},
                    .disk = disk.name(),
                    .rests_in = 11};
    const auto project = machine.run();
    ASSERT_NE(project, nullptr);
    EXPECT_EQ(element(*project, "found"), spoils ? 162 : 0);
    EXPECT_EQ(element(*project, "bits"), spoils ? 1 << 10 : 0);
  }
}

// 33-83 is one of GLBPARS: SAVE AXPARS leaves it out.
TEST(DeviceRetain, KeepsOnlyThePartThatIsSaved) {
  const test::Directory directory;
  for (const bool saved : {false, true}) {
    Machine machine{directory.file(saved ? "a" : "b"),
                    {"e = GET 33-83", "SET 33-83 2", saved ? "SAVE GLBPARS" : "SAVE USRPARS",
                     "wait:", "DELAY 100", "GOTO wait"}};
    const auto first = machine.run();
    const auto second = machine.run();
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(element(*first, "e"), 0);
    EXPECT_EQ(element(*second, "e"), saved ? 2 : 0);
  }
}

// Without any SAVE: a panel keeps what is changed at it.
TEST(DeviceRetain, KeepsWhatAClientWrites) {
  const test::Directory directory;
  const Json whole = {{{"object", "Lift"}, {"content", "parameters"}, {"address", 0}}};
  const Json single = {
      {{"tag", "Lift.KDER"}, {"table", "holding_register"}, {"address", 0}, {"access", "write"}}};
  const Json words = {{{"object", "Lift"}, {"content", "pcd"}, {"address", 0}}};
  for (const Json& map : {whole, single, words}) {
    Machine machine{
        directory.file("kept" + std::to_string(map[0].size()) + map[0].dump().substr(2, 12)),
        {"DELAY 20", "k = GET KDER", "e = GET 33-83", "z = GET 1903", "wait:", "DELAY 100", "GOTO wait"}};
    machine.map = map;
    machine.panel = {{3261, 77}, {3383, 2}, {1903, 9}};
    ASSERT_NE(machine.run(), nullptr);
    machine.panel.clear();
    const auto project = machine.run();
    ASSERT_NE(project, nullptr);
    const bool kept = map != words;
    EXPECT_EQ(element(*project, "k"), kept ? 77 : 0) << map;
    EXPECT_EQ(element(*project, "e"), kept ? 2 : 0) << map;
    EXPECT_EQ(element(*project, "z"), kept ? 9 : 0) << map;
  }
}

TEST(DeviceRetain, PutsAsideWhatDoesNotFitTheProjectAnyMore) {
  const test::Directory directory;
  Machine machine{directory.file("kept"), kCounts};
  ASSERT_NE(machine.run(), nullptr);
  machine.parameters["KPROP"] = 70;
  machine.program[0] = "DIM a[3], b[2], c[1]";
  const auto project = machine.run();
  ASSERT_NE(project, nullptr);
  EXPECT_EQ(element(*project, "k"), 70) << "what the project says now";
  EXPECT_EQ(element(*project, "x"), 10);
  EXPECT_EQ(element(*project, "z"), 6) << "those of the application still fit";
  std::string all;
  for (const std::string& remark : machine.remarks) all += remark + "\n";
  EXPECT_EQ(machine.remarks.size(), 2u) << all;
  EXPECT_NE(all.find("Lift.AXPARS was kept"), std::string::npos) << all;
  EXPECT_NE(all.find("It was: start values; it is: 3260=70"), std::string::npos) << all;
  EXPECT_NE(all.find("Lift.ARRAYS was kept"), std::string::npos) << all;
  EXPECT_NE(all.find("stays in the file as 'Lift.AXPARS@ARRAY[1.."), std::string::npos) << all;
}

TEST(DeviceRetain, RefusesADamagedFile) {
  const test::Directory directory;
  Machine machine{directory.file("kept"), kCounts};
  ASSERT_NE(machine.run(), nullptr);
  {
    std::fstream file(machine.file, std::ios::in | std::ios::out | std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t at = text.find("Lift.AXPARS");
    ASSERT_NE(at, std::string::npos);
    file.clear();
    file.seekp(static_cast<std::streamoff>(at + 40));
    file << "9";
  }
  try {
    machine.run();
    FAIL() << "it was taken";
  } catch (const RetainFileError& error) {
    EXPECT_NE(std::string(error.what()).find("damaged"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(machine.file), std::string::npos) << error.what();
  }
}

// A value in the file with which nothing can be computed, such as VELRES 0: error 116, and the project's
// stays.
TEST(DeviceRetain, TakesNoValueWithWhichNothingCanBeComputed) {
  const test::Directory directory;
  Machine machine{directory.file("kept"), kCounts};
  LoadedProject loaded = load_project(machine.text(), "", [&](Project& project) {
    auto& parameters = Machine::device_of(project).parameters();
    *parameters.kept(mco305::kVelRes) = 0;
    *parameters.saved(mco305::ParameterSet::kAxis) = true;
  });
  ASSERT_TRUE(loaded.project.has_value());
  Mco305& device = Machine::device_of(*loaded.project);
  EXPECT_EQ(device.parameters()[mco305::kVelRes], 100);
  loaded.project->controller->tick();
  EXPECT_EQ(device.machine().error(), 116);
}

TEST(DeviceRetain, CopiesNothingInTheTickWhereNoProgramChangesAnything) {
  const Machine machine{"", {"POSA 100", "wait:", "DELAY 100", "GOTO wait"}};
  const LoadedProject loaded = load_project(machine.text());
  ASSERT_TRUE(loaded.project.has_value());
  EXPECT_TRUE(loaded.project->retain.values.empty());
}

}  // namespace
}  // namespace lockstep::device_retain_test
