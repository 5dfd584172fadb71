// System files at the command line: check, run --simulate, connections.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "command_run.hpp"
#include "tests/projects/system_files.hpp"

namespace lockstep::cli::system_test {
namespace {

using test::ControllerFile;
using test::SystemFiles;
using Json = nlohmann::json;

/// @param failing whether a halt of the second one is rejected, whose deceleration is 0
SystemFiles two(bool failing = false) {
  ControllerFile infeed("infeed");
  infeed.axis("Conveyor");
  infeed.provide("Conveyor", 0.0);
  infeed.call({{"fb", "MC_MoveVelocity"},
               {"name", "run"},
               {"in", {{"Axis", "Conveyor"}, {"Velocity", "100.0"}, {"Execute", "power_Conveyor.Status"}}}});
  infeed.json["trace"]["signals"] = {"Conveyor.Position"};
  ControllerFile press("press", "2ms");
  press.axis("Press");
  press.proxy("Line");
  press.gear("Press", "Line");
  press.json["tags"]["couple"]["init"] = false;
  press.json["stimuli"] = test::SystemJson::parse(R"([ { "at": "50ms", "set": { "couple": true } } ])");
  press.json["trace"]["signals"] = {"Line.Position", "Press.Velocity"};
  if (failing)
    press.call({{"fb", "MC_Halt"},
                {"name", "halt"},
                {"in", {{"Axis", "Press"}, {"Execute", "power_Press.Status"}, {"Deceleration", 0.0}}}});
  SystemFiles files;
  files.add("PLC_1", infeed);
  files.add("PLC_2", press, "300us");
  files.area("line", "PLC_1.Conveyor", {"PLC_2.Line"});
  files.json["simulated_network"] = {{"latency", "300us"}, {"jitter", "200us"}, {"loss", 0.05}, {"seed", 3}};
  return files;
}

TEST(SystemCommand, IsCheckedWithAllItsProjects) {
  SystemFiles files = two();
  const Ended valid = lockstep({"check", files.path()});
  EXPECT_EQ(valid.status, 0) << valid.err;
  EXPECT_EQ(valid.err, files.path() + ": valid\n");
  files.json["transfer_areas"]["line"]["from"] = "PLC_1.Convayor";
  const Ended wrong = lockstep({"check", files.path()});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("system.json:/transfer_areas/line/from: of the controller 'PLC_1': "),
            std::string::npos)
      << wrong.err;
  EXPECT_NE(wrong.err.find("Conveyor"), std::string::npos) << "the nearest name: " << wrong.err;
  EXPECT_EQ(lockstep({"check", "--expanded", two().path()}).status, 2);
}

TEST(SystemCommand, RunsAllControllersOnOneVirtualTime) {
  const SystemFiles files = two();
  const Directory out;
  for (const char* const name : {"once.csv", "again.csv"}) {
    const Ended run =
        lockstep({"run", files.path(), "--simulate", "--duration", "1s", "--trace", out.file(name)});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.err.find("simulated 1.000 s of 2 controllers"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("Line  9"), std::string::npos) << "telegrams of the proxy: " << run.err;
    EXPECT_EQ(run.err.find("alarm"), std::string::npos) << run.err;
  }
  for (const char* const controller : {"PLC_1", "PLC_2"}) {
    const std::string once = content(out.file(std::string("once.") + controller + ".csv"));
    EXPECT_GT(once.size(), 5000u) << controller;
    EXPECT_EQ(once, content(out.file(std::string("again.") + controller + ".csv"))) << controller;
  }
  EXPECT_NE(content(out.file("once.PLC_2.csv")).find("Press.Velocity"), std::string::npos);
}

TEST(SystemCommand, RecordsTheSignalsThatAreNamedWithTheirController) {
  const SystemFiles files = two();
  const Directory out;
  const Ended run = lockstep({"run", files.path(), "--simulate", "--duration", "100ms", "--trace",
                              out.file("t.csv"), "--signals", "PLC_2.Line.Velocity"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(content(out.file("t.PLC_2.csv")).find("Line.Velocity"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out.file("t.PLC_1.csv"))) << "nothing of it is asked for";
  const Ended wrong = lockstep({"run", files.path(), "--simulate", "--duration", "100ms", "--trace",
                                out.file("t.csv"), "--signals", "Line.Velocity"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("allowed: CONTROLLER.PATH"), std::string::npos) << wrong.err;
}

TEST(SystemCommand, RefusesWhatIsForOneProject) {
  const SystemFiles files = two();
  const Ended studio = lockstep({"run", files.path(), "--studio", "127.0.0.1:0"});
  EXPECT_EQ(studio.status, 2);
  EXPECT_NE(studio.err.find("--controller"), std::string::npos) << "where it is for: " << studio.err;
  const Ended modbus = lockstep({"run", files.path(), "--simulate", "--modbus", "127.0.0.1:0"});
  EXPECT_EQ(modbus.status, 2);
  EXPECT_NE(modbus.err.find("--modbus is for one project"), std::string::npos) << modbus.err;
}

TEST(SystemCommand, FailsOnAlarmsOfAnyController) {
  SystemFiles files = two();
  files.json["simulated_network"]["loss"] = 0.0;
  files.json["simulated_network"]["latency"] = "2s";  // telegrams are too old when they come
  const Ended run =
      lockstep({"run", files.path(), "--simulate", "--duration", "5s", "--fail-on", "alarm,job"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_NE(run.err.find("PLC_2.Press"), std::string::npos) << "whose it is: " << run.err;
}

TEST(SystemCommand, FailsOnAFailedJobOfAnyController) {
  const auto run = [](const SystemFiles& files, const char* fail_on) {
    return lockstep({"run", files.path(), "--simulate", "--duration", "40ms", "--fail-on", fail_on});
  };
  const Ended good = run(two(), "alarm,job");
  EXPECT_EQ(good.status, 0) << good.err;
  const SystemFiles files = two(true);
  const Ended spared = run(files, "alarm");
  EXPECT_EQ(spared.status, 0) << "it is no alarm: " << spared.err;
  const Ended failed = run(files, "job");
  EXPECT_EQ(failed.status, 4) << failed.err;
  EXPECT_NE(failed.err.find("PLC_2.halt (MC_Halt of Press): failed, ErrorID 16#8005"), std::string::npos)
      << failed.err;
}

TEST(Connections, ShowTheOverviewAsTextJsonAndPicture) {
  const SystemFiles files = two();
  const Ended text = lockstep({"connections", files.path(), "--calculate", "--routes", "PLC_2.Press"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("PLC_1.Conveyor"), std::string::npos);
  EXPECT_NE(text.out.find("0 ms → 4 ms"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("PLC_2.Press ← PLC_2.Line ← PLC_1.Conveyor: extrapolated"), std::string::npos)
      << text.out;
  EXPECT_EQ(lockstep({"connections", files.path(), "--filter", "nobody"}).out, "no interconnections\n");
  const Directory out;
  const Ended json =
      lockstep({"connections", files.path(), "--json", "--local", "--svg", out.file("overview.svg")});
  EXPECT_EQ(json.status, 0) << json.err;
  const Json overview = Json::parse(json.out);
  ASSERT_EQ(overview["interconnections"].size(), 1u);
  EXPECT_EQ(overview["interconnections"][0]["receiver"]["proxy"], "Line");
  EXPECT_EQ(overview["interconnections"][0]["source"]["delay"]["computed"], 0.004);
  const std::string picture = content(out.file("overview.svg"));
  EXPECT_TRUE(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
  for (const char* const name : {"PLC_1", "PLC_2", "Conveyor", "Line", "Press"})
    EXPECT_NE(picture.find(std::string(">") + name + "<"), std::string::npos) << name;
}

TEST(Connections, WriteDelaysAndAreThenAsComputed) {
  const SystemFiles files = two();
  EXPECT_EQ(lockstep({"connections", files.path(), "--apply"}).status, 2) << "needs --calculate";
  const Ended applied = lockstep({"connections", files.path(), "--calculate", "--apply"});
  EXPECT_EQ(applied.status, 0) << applied.err;
  EXPECT_NE(applied.err.find("PLC_1.json: 1 delay written"), std::string::npos) << applied.err;
  const Ended again = lockstep({"connections", files.path(), "--calculate", "--apply"});
  EXPECT_NE(again.err.find("nothing to write"), std::string::npos) << again.err;
  EXPECT_NE(again.out.find("as computed"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("interpolated"), std::string::npos) << again.out;
}

TEST(Connections, WriteThroughALinkToAProject) {
  const SystemFiles files = two();
  files.path();
  const std::string link = files.directory().file("PLC_1.json"), real = files.directory().file("real.json");
  std::filesystem::rename(link, real);
  std::filesystem::create_symlink("real.json", link);
  EXPECT_EQ(lockstep({"connections", files.path(), "--calculate", "--apply"}).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_NE(content(real).find("\"LocalLeadingValueDelayTime\": 0.004"), std::string::npos) << content(real);
}

TEST(Connections, TellWhatIsNoSystem) {
  const SystemFiles files = two();
  files.path();
  const Ended project = lockstep({"connections", files.directory().file("PLC_1.json")});
  EXPECT_EQ(project.status, 2);
  EXPECT_NE(project.err.find("is no system file"), std::string::npos);
  const Ended route = lockstep({"connections", files.path(), "--routes", "PLC_2.Line"});
  EXPECT_EQ(route.status, 1) << route.out;
}

}  // namespace
}  // namespace lockstep::cli::system_test
