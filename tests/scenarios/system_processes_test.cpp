// lockstep run of a system in real time: a process for each controller, on this machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/hmi_bridge/own_network.hpp"
#include "tests/projects/system_files.hpp"
#include "tests/scenarios/csv_table.hpp"
#include "tests/scenarios/lockstep_process.hpp"

namespace lockstep::test::system_processes_test {
namespace {

/// A conveyor that runs at once, and a press on another controller that goes with it.
SystemFiles two() {
  ControllerFile infeed("infeed");
  infeed.axis("Conveyor");
  infeed.provide("Conveyor", 0.004);
  infeed.call({{"fb", "MC_MoveVelocity"},
               {"name", "run"},
               {"in", {{"Axis", "Conveyor"}, {"Velocity", "100.0"}, {"Execute", "power_Conveyor.Status"}}}});
  for (const char* const tag : {"sent", "failed", "clock_losses"}) {
    infeed.json["tags"][tag]["type"] = "ULINT";
    infeed.json["telegrams"][tag] = tag;
  }
  infeed.json["trace"]["signals"] = {"Conveyor.Position", "Conveyor.Velocity", "sent", "failed",
                                     "clock_losses"};
  ControllerFile press("press", "2ms");
  // A source that misses ticks stands still in them; what looks ahead goes on, and back.
  press.axis("Press")["config"]["Synchronization"]["MasterReversionTolerance"] = 1000.0;
  press.proxy("Line", 1.0);
  press.interconnect("Press", "Line");
  press.json["tags"]["foreign"]["type"] = "ULINT";
  press.json["technology_objects"]["Line"]["telegrams"]["foreign"] = "foreign";
  press.call(
      {{"fb", "MC_GearIn"},
       {"name", "gear"},
       {"in",
        {{"Master", "Line"}, {"Slave", "Press"}, {"Execute", "power_Press.Status AND Line.StatusWord.X4"}}}});
  press.json["trace"]["signals"] = {"Line.Position", "Press.Velocity", "gear.InGear", "foreign"};
  SystemFiles files;
  files.add("PLC_1", infeed);
  files.add("PLC_2", press);
  files.area("line", "PLC_1.Conveyor", {"PLC_2.Line"});
  return files;
}

std::vector<pid_t> children_of(pid_t process) {
  const std::string number = std::to_string(process);
  std::ifstream list("/proc/" + number + "/task/" + number + "/children");
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

pid_t find_thread(pid_t process, const std::string& name) {
  std::error_code gone;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm"), found);
    if (found == name) return std::stoi(task.path().filename().string());
  }
  return 0;
}

/// Waits until the press goes with the conveyor.
bool coupled(const std::string& trace) {
  return wait_until([&] {
    std::ifstream file(trace);
    std::string line, last;
    while (std::getline(file, line)) last = line;
    const std::regex in_gear("[^,]*,[^,]*,100\\.0,1,.*");
    return std::regex_match(last, in_gear);
  });
}

TEST(SystemProcesses, RunEachControllerAndComeToRestTogether) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    const std::string trace = files.directory().file("t.csv");
    Process run(lockstep_command({"run", files.path(), "--trace", trace}));
    ASSERT_TRUE(wait_until([&] { return children_of(run.pid()).size() == 2; })) << run.err();
    EXPECT_TRUE(coupled(files.directory().file("t.PLC_2.csv"))) << run.err();
    run.send(SIGINT);
    EXPECT_EQ(run.status(), 0) << run.err();
    const std::string text = run.err();
    for (const char* const controller : {"PLC_1", "PLC_2"})
      EXPECT_TRUE(
          std::regex_search(text, std::regex(std::string(controller) + "\nran [0-9.]+ s: [0-9]+ ticks")))
          << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("Conveyor +moving +at .*brought to rest at"))) << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("Press +synchronous +at .*brought to rest at"))) << text;
    EXPECT_TRUE(std::regex_search(text, std::regex("Line  [0-9]+ telegrams, "))) << text;
    EXPECT_LT(text.rfind("time 0 is"), text.find("\nran ")) << "one summary, at the end: " << text;
    CsvTable infeed = read_csv(files.directory().file("t.PLC_1.csv"));
    EXPECT_GT(infeed["sent"].back(), 100.0);
    EXPECT_LE(infeed["sent"].back(), static_cast<double>(infeed.rows));
    EXPECT_EQ(infeed["failed"].back() + infeed["clock_losses"].back(), 0.0);
  });
}

TEST(SystemProcesses, EndByThemselvesAfterADuration) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    const Ended run = lockstep({"run", files.path(), "--duration", "500ms", "--trace",
                                files.directory().file("t.csv"), "--signals", "PLC_2.Press.Velocity"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_FALSE(std::filesystem::exists(files.directory().file("t.PLC_1.csv")))
        << "nothing of it is asked for";
    EXPECT_GT(read_csv(files.directory().file("t.PLC_2.csv")).rows, 10u);
  });
}

TEST(SystemProcesses, OfWhichOneFailsBringTheOthersToRest) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    Process run(lockstep_command({"run", files.path(), "--trace", files.directory().file("t.csv")}));
    ASSERT_TRUE(coupled(files.directory().file("t.PLC_2.csv"))) << run.err();
    const std::vector<pid_t> children = children_of(run.pid());
    ASSERT_EQ(children.size(), 2u);
    ::kill(children[1], SIGKILL);
    EXPECT_EQ(run.status(), 3) << run.err();
    EXPECT_NE(run.err().find("PLC_2 has ended with status 3: the other controllers are brought to rest"),
              std::string::npos)
        << run.err();
    EXPECT_TRUE(std::regex_search(run.err(), std::regex("Conveyor +moving +at .*brought to rest at")))
        << run.err();
  });
}

TEST(SystemProcesses, EndWithTheOneThatHasStartedThem) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    std::vector<pid_t> children;
    {
      Process run(lockstep_command({"run", files.path()}));
      ASSERT_TRUE(wait_until([&] { return (children = children_of(run.pid())).size() == 2; }));
      run.send(SIGKILL);
      run.status();
    }
    for (const pid_t child : children)
      EXPECT_TRUE(wait_until([&] {
        return ::kill(child, 0) != 0 || content("/proc/" + std::to_string(child) + "/cmdline").empty();
      }));
  });
}

TEST(SystemProcesses, ThatCannotStartAreToldAndNothingRuns) {
  in_own_network([] {
    bring_up_network();
    SystemFiles files = two();
    files.json["network"]["key_file"] = "key";
    const Ended missing = lockstep({"run", files.path()});
    EXPECT_EQ(missing.status, 2) << missing.err;
    EXPECT_NE(missing.err.find("leading values: key file " + files.directory().file("key") + ": "),
              std::string::npos)
        << missing.err;
    const Ended unknown = lockstep({"run", files.path(), "--controller", "PLC_3"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("there is no controller 'PLC_3'"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("allowed: PLC_1, PLC_2"), std::string::npos) << unknown.err;
    const Ended project = lockstep({"run", files.directory().file("PLC_1.json"), "--controller", "PLC_1"});
    EXPECT_EQ(project.status, 2);
    EXPECT_NE(project.err.find("is no system file"), std::string::npos) << project.err;
    EXPECT_EQ(lockstep({"run", files.path(), "--controller", "PLC_1", "--simulate"}).status, 2);
    const Ended modbus = lockstep({"run", files.path(), "--modbus", "127.0.0.1:0"});
    EXPECT_EQ(modbus.status, 2);
    EXPECT_NE(modbus.err.find("--controller"), std::string::npos) << "what helps: " << modbus.err;
  });
}

/// A system of which each controller has another key: nothing leads, and what has come is counted.
TEST(SystemProcesses, WithAnotherKeyAreRefused) {
  in_own_network([] {
    bring_up_network();
    SystemFiles files = two();
    files.json["network"]["key_file"] = "key";
    const auto write_key = [&](const std::string& key) {
      const std::string path = files.directory().write("key", key);
      std::filesystem::permissions(path,
                                   std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    };
    write_key("the key of the one, sixteen bytes and more");
    Process infeed(lockstep_command({"run", files.path(), "--controller", "PLC_1"}));
    ASSERT_TRUE(wait_until([&] { return infeed.err().find("time 0 is") != std::string::npos; }))
        << infeed.err();
    write_key("the key of the other, sixteen bytes and more");
    const Ended other = lockstep({"run", files.path(), "--controller", "PLC_2", "--duration", "300ms"});
    EXPECT_EQ(other.status, 0) << other.err;
    EXPECT_TRUE(std::regex_search(
        other.err, std::regex("Line: messages that did not count: [0-9]+ without the right code")))
        << other.err;
    EXPECT_NE(other.err.find("Line  0 telegrams"), std::string::npos) << other.err;
    write_key("the key of the one, sixteen bytes and more");
    const Ended right = lockstep({"run", files.path(), "--controller", "PLC_2", "--duration", "300ms"});
    EXPECT_EQ(right.err.find("did not count"), std::string::npos) << right.err;
    EXPECT_EQ(right.err.find("Line  0 telegrams"), std::string::npos) << right.err;
    infeed.send(SIGTERM);
    EXPECT_EQ(infeed.status(), 0);
  });
}

/// The flight recorder writes what came before the leading value was lost.
TEST(SystemProcesses, KeepTheTelegramsAroundAnAlarm) {
  in_own_network([] {
    bring_up_network();
    SystemFiles files = two();
    SystemJson press = SystemJson::parse(content(files.directory().file("PLC_2.json")));
    press["flight_recorder"] = {{"before", "2s"}, {"after", "100ms"}, {"file", "flight"}};
    files.directory().write("PLC_2.json", press.dump());
    Process infeed(lockstep_command({"run", files.path(), "--controller", "PLC_1"}));
    Process second(lockstep_command(
        {"run", files.path(), "--controller", "PLC_2", "--trace", files.directory().file("t.csv")}));
    ASSERT_TRUE(coupled(files.directory().file("t.PLC_2.csv"))) << second.err();
    infeed.send(SIGKILL);
    infeed.status();
    EXPECT_TRUE(wait_until([&] { return second.err().find("alarm 900") != std::string::npos; }));
    second.send(SIGTERM);
    EXPECT_EQ(second.status(), 0) << second.err();
    std::string log;
    for (const auto& entry : std::filesystem::directory_iterator(files.directory().file("")))
      if (entry.path().filename().string().starts_with("flight_telegrams_")) log = content(entry.path());
    std::size_t telegrams = 0;
    for (std::size_t at = 0; (at = log.find("test.line", at)) != log.npos; ++at) ++telegrams;
    EXPECT_GT(telegrams, 100u) << "each has the name of its channel, and of its area";
    EXPECT_NE(second.err().find("flight recorder: wrote "), std::string::npos) << second.err();
  });
}

/// A stranger's program in Python, with nothing of Lockstep but the declaration of the message.
TEST(SystemProcesses, AreHeardByAStrangerWhoKnowsTheMessageAlone) {
  in_own_network([] {
    bring_up_network();
    SystemFiles files = two();
    files.json["network"]["key_file"] = "key";
    const std::string key = files.directory().write("key", "a key of sixteen bytes and more\n");
    std::filesystem::permissions(key,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    Process infeed(lockstep_command({"run", files.path(), "--controller", "PLC_1"}));
    const std::string bridge = std::string(LOCKSTEP_SOURCE_DIR) + "/hmi_bridge/";
    const std::string folder = files.directory().file("");
    Process stranger({"sh", "-c",
                      "set -e; cd " + folder + "; lcm-gen --python " + bridge + "lcm/trace.lcm " + bridge +
                          "lcm/leading_value.lcm; PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" + folder +
                          " exec python3 " + bridge + "subscriber/leading_values.py test.line 200 " + key});
    EXPECT_EQ(stranger.status(), 0) << stranger.err();
    const std::string text = stranger.out();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 200) << text;
    EXPECT_TRUE(std::regex_search(
        text,
        std::regex(
            "PLC_1 #[0-9]+  position [0-9.]+ \\+ 0 turns  velocity 100  valid, position led, signed\n")))
        << text;
    EXPECT_EQ(text.find("NOT SIGNED"), std::string::npos) << text;
    infeed.send(SIGTERM);
    EXPECT_EQ(infeed.status(), 0);
  });
}

/// A project that belongs to no system, with an area that it receives.
TEST(SystemProcesses, AreJoinedByAProjectOfSomebodyElse) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    Process infeed(lockstep_command({"run", files.path(), "--controller", "PLC_1"}));
    ControllerFile stranger("stranger", "2ms");
    stranger.axis("Stamp")["config"]["Synchronization"]["MasterReversionTolerance"] = 1000.0;
    stranger.proxy("Belt", 1.0);
    stranger.interconnect("Stamp", "Belt");
    stranger.call({{"fb", "MC_GearIn"},
                   {"name", "gear"},
                   {"in",
                    {{"Master", "Belt"},
                     {"Slave", "Stamp"},
                     {"Execute", "power_Stamp.Status AND Belt.StatusWord.X4"}}}});
    stranger.json["transfer_areas"]["belt"] = {{"direction", "receive"}, {"channel", "test.line"},
                                               {"controller", "PLC_1"},  {"source", "Conveyor"},
                                               {"to", "Belt"},           {"address", "0.0.0.0/8"}};
    stranger.json["trace"]["signals"] = {"Stamp.Velocity"};
    const auto run = [&] {
      const std::string trace = files.directory().file("stranger.csv");
      const Ended ended = lockstep({"run", files.directory().write("stranger.json", stranger.json.dump()),
                                    "--duration", "1s", "--trace", trace});
      EXPECT_EQ(ended.status, 0) << ended.err;
      return std::pair(ended.err, read_csv(trace)["Stamp.Velocity"].back());
    };
    const auto [told, velocity] = run();
    EXPECT_NEAR(velocity, 100.0, 1e-9) << told;
    stranger.json["transfer_areas"]["belt"]["source"] =
        "Convayor";  // what both do not agree on leads nothing
    const auto [refused, standing] = run();
    EXPECT_EQ(standing, 0.0) << refused;
    EXPECT_TRUE(std::regex_search(refused, std::regex("Belt: messages that did not count: [0-9]+ foreign")))
        << refused;
    infeed.send(SIGTERM);
    EXPECT_EQ(infeed.status(), 0);
  });
}

#ifndef __SANITIZE_THREAD__  // which has locks of its own behind every access
TEST(SystemProcesses, AskTheSystemForNothingInTheirTicksButTheTimeOfTheNextOne) {
  in_own_network([] {
    bring_up_network();
    const SystemFiles files = two();
    Process run(lockstep_command({"run", files.path(), "--trace", files.directory().file("t.csv")}));
    ASSERT_TRUE(coupled(files.directory().file("t.PLC_2.csv"))) << run.err();
    for (const pid_t child : children_of(run.pid())) {
      pid_t cycle = 0;
      ASSERT_TRUE(wait_until([&] { return (cycle = find_thread(child, "cycle")) != 0; }));
      const std::string calls = files.directory().file("calls");
      Process strace(
          {"timeout", "-s", "INT", "2", "strace", "-qq", "-o", calls, "-p", std::to_string(cycle)});
      strace.status();
      std::ifstream lines(calls);
      int sleeps = 0;
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME") ||
            line.starts_with("restart_syscall"))
          ++sleeps;
        else
          EXPECT_EQ(line, "") << "a system call of the cycle";
      }
      EXPECT_GT(sleeps, 200);
    }
    run.send(SIGTERM);  // strace may have held ticks up for longer than the tolerance time
    EXPECT_EQ(run.status(), 0) << run.err();
  });
}
#endif

}  // namespace
}  // namespace lockstep::test::system_processes_test
