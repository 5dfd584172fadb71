// A run whose retain file is moved, replaced, deleted or cut under it: the next run has all values.
#include <gtest/gtest.h>

#include <filesystem>

#include "hmi_bridge/retain/file.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::retain_outside_test {
namespace {

namespace fs = std::filesystem;

/// A tag that is written from outside, an encoder that is adjusted, and a job that keeps it at once.
Json keeping() {
  Json json = empty_project();
  json["technology_objects"]["Slide"] = {{"type", "TO_PositioningAxis"},
                                         {"config", {{"Sensor[1]", {{"Type", 1}}}}},
                                         {"drive", {{"model", "simulated"}, {"start_position", 40.0}}}};
  json["tags"] = {{"speed", {{"type", "LREAL"}, {"init", 1.0}, {"retain", true}}},
                  {"go", {{"type", "BOOL"}}}};
  json["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power", {{"Axis", "Slide"}, {"Enable", true}}),
         call("MC_Home", "home",
              {{"Axis", "Slide"}, {"Execute", "power.Status"}, {"Mode", 7}, {"Position", 1000.0}}),
         call("MC_SaveAbsoluteEncoderData", "save", {{"Execute", "home.Done AND go"}})}}});
  json["retain"] = {{"interval", "1h"}};
  json["modbus"]["map"] = {
      {{"tag", "speed"}, {"table", "holding_register"}, {"address", 0}, {"type", "REAL"}},
      {{"tag", "go"}, {"table", "coil"}, {"address", 0}},
      {{"tag", "save.Done"}, {"table", "discrete_input"}, {"address", 0}},
      {{"tag", "save.Error"}, {"table", "discrete_input"}, {"address", 1}}};
  return json;
}

struct Deed {
  const char* name;
  void (*perform)(const std::string&);
};

void PrintTo(const Deed& deed, std::ostream* out) {
  *out << deed.name;
}

constexpr Deed kDeeds[] = {
    {"Deleted", [](const std::string& file) { fs::remove(file); }},
    {"Moved", [](const std::string& file) { fs::rename(file, file + ".moved"); }},
    {"Truncated", [](const std::string& file) { fs::resize_file(file, 0); }},
    {"Replaced",
     [](const std::string& file) {
       std::ofstream(file + ".other") << "something else";
       fs::rename(file + ".other", file);
     }},
};

/// Whether the first values have reached the disk.
bool is_written(const std::string& file) {
  return wait_until([&] { return content(file).find("AbsEncoderOffset") != std::string::npos; });
}

class RetainUnderARun : public testing::TestWithParam<Deed> {
 protected:
  const Directory directory;
  const std::string project = directory.write("project.json", keeping().dump());
  const std::string file = directory.file("project.retain");
};

TEST_P(RetainUnderARun, IsToldAndTheLastValuesAreKept) {
  RunningLockstep run(project);
  ModbusClient client(run.port());
  ASSERT_TRUE(wait_until([&] { return content(file).find("speed") != std::string::npos; }));
  client.write_float(0, 1.5F);
  GetParam().perform(file);
  client.write_float(0, 42.5F);
  EXPECT_TRUE(wait_until([&] { return run.err().find("made again with all values") != std::string::npos; }))
      << run.err();
  client.write_float(0, 43.5F);
  GetParam().perform(file);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
  const RetainFile kept(file, "small");
  ASSERT_NE(kept.find("speed"), nullptr);
  EXPECT_EQ(kept.find("speed")->value, "43.5");
  EXPECT_NE(kept.find("Slide.StatusSensor[1].AbsEncoderOffset"), nullptr);
}

/// Killed right after it, so that nothing but the job can have brought the adjustment onto the disk.
TEST_P(RetainUnderARun, WhatMC_SaveAbsoluteEncoderDataCallsDoneIsThere) {
  RunningLockstep run(project);
  ModbusClient client(run.port());
  // The job has been done once.
  client.write_coil(0, true);
  ASSERT_TRUE(wait_until([&] { return client.input(0) && is_written(file); }));
  client.write_coil(0, false);
  ASSERT_TRUE(wait_until([&] { return !client.input(0); }));
  GetParam().perform(file);
  client.write_coil(0, true);
  ASSERT_TRUE(wait_until([&] { return client.input(0) || client.input(1); }));
  EXPECT_TRUE(client.input(0));
  run.send(SIGKILL);
  run.status();
  const RetainFile kept(file, "small");
  ASSERT_NE(kept.find("Slide.StatusSensor[1].AbsEncoderOffset"), nullptr);
  EXPECT_EQ(kept.find("Slide.StatusSensor[1].AbsEncoderOffset")->value, "960");
}

INSTANTIATE_TEST_SUITE_P(Deeds, RetainUnderARun, testing::ValuesIn(kDeeds),
                         [](const auto& deed) { return std::string(deed.param.name); });

TEST(RetainUnderARunOfNothing, AnEmptyFileIsNoPlaceToStartFrom) {
  const Directory directory;
  const std::string project = directory.write("project.json", keeping().dump());
  for (const std::string text : {"", "x"}) {
    directory.write("project.retain", text);
    const Ended ended = lockstep({"run", project, "--no-modbus", "--no-lcm", "--duration", "20ms"});
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_NE(ended.err.find("project.retain: it is damaged (it is empty)"), std::string::npos) << ended.err;
    EXPECT_EQ(content(directory.file("project.retain")), text) << "it is not touched";
  }
}

/// Where it cannot be made again nobody is told that it is kept.
TEST(RetainUnderARunOfNothing, WithoutItsDirectorySavingFailsAndTheEndSaysSo) {
  const Directory directory;
  Json json = keeping();
  json["retain"]["file"] = "state/values";
  const std::string project = directory.write("project.json", json.dump());
  fs::create_directory(directory.file("state"));
  RunningLockstep run(project);
  ModbusClient client(run.port());
  fs::rename(directory.file("state"), directory.file("elsewhere"));
  client.write_coil(0, true);
  ASSERT_TRUE(wait_until([&] { return client.input(0) || client.input(1); }));
  EXPECT_TRUE(client.input(1)) << "it is not on the disk";
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
  EXPECT_NE(run.err().find("cannot be made again: No such file or directory"), std::string::npos)
      << run.err();
  EXPECT_NE(run.err().find("the last values are not kept"), std::string::npos) << run.err();
}

}  // namespace
}  // namespace lockstep::test::retain_outside_test
