// What happens when a Modbus client that gives signs of life falls silent.
#include <gtest/gtest.h>

#include "changed_project.hpp"
#include "projects/loader/simulation.hpp"

namespace lockstep::watchdog_test {
namespace {

using namespace std::chrono_literals;

std::string project(const std::string& stimuli, const std::string& calls = "", const std::string& more = "") {
  return R"({ "lockstep": 1, "name": "watched", "clock": { "servo_cycle": "1ms" },
    "tags": { "beat": { "type": "UINT", "init": 7, "retain": true }, "start": { "type": "BOOL" },
      "speed": { "type": "LREAL", "init": 50.0 }, "kind": { "type": "STRING[8]", "init": "ale" },
      "silent": { "type": "BOOL" }, "pulse": { "type": "BOOL" }, "limits": { "type": "ARRAY[0..1] OF INT", "init": [ 3, 4 ] },
      "doubled": { "type": "LREAL" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms",
      "calls": [ { "set": "doubled", "to": "speed * 2.0" } )" +
         calls + R"( ] } ],
    "stimuli": [ )" +
         stimuli + R"( ],
    "modbus": { "map": [
        { "tag": "beat", "table": "holding_register", "address": 0 },
        { "tag": "start", "table": "coil", "address": 0 },
        { "tag": "pulse", "table": "coil", "address": 1 },
        { "tag": "speed", "table": "holding_register", "address": 1 } ],
      "watchdog": { "tag": "beat", "timeout": "10ms", "status": "silent",
        "set": { "start": false, "speed": 5, "kind": "none", "limits[1]": -1 } } )" +
         more + " } }";
}

Simulation watched(const std::string& stimuli, const std::string& calls = "") {
  return Simulation::from_text(project(stimuli, calls));
}

Controller& controller_of(Simulation& machine) {
  return *machine.project().controller;
}

TEST(Watchdog, SetsItsValuesInTheTickOfItsTimeoutAndNotBefore) {
  Simulation machine = watched(R"({ "at": "0s", "set": { "start": true } })");
  machine.run_for(10ms);  // ticks 0 to 9
  EXPECT_EQ(machine.read("silent"), 0.0);
  EXPECT_EQ(machine.read("start"), 1.0);
  EXPECT_EQ(machine.read("doubled"), 100.0);
  machine.step();
  EXPECT_EQ(machine.read("silent"), 1.0);
  EXPECT_EQ(machine.read("start"), 0.0);
  EXPECT_EQ(machine.read("doubled"), 10.0) << "programs of the same tick see them";
  EXPECT_EQ(machine.read("limits[0]"), 3.0);
  EXPECT_EQ(machine.read("limits[1]"), -1.0);
  EXPECT_EQ(controller_of(machine).strings[0].text.view(), "none");
}

TEST(Watchdog, IsKeptQuietByEveryChangeOfTheHeartbeat) {
  Simulation machine =
      watched(R"({ "at": "9ms", "set": { "beat": 8 } }, { "at": "18ms", "set": { "beat": 7 } })");
  machine.run_for(28ms);  // up to tick 27
  EXPECT_EQ(machine.read("silent"), 0.0);
  machine.step();
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, TakesTheSameValueAgainForNoSignOfLife) {
  Simulation machine = watched(R"({ "at": "5ms", "set": { "beat": 7, "speed": 60 } })");
  machine.run_for(11ms);
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, HoldsItsValuesAgainstWhoeverWritesThemUntilTheHeartbeatChanges) {
  Simulation machine = watched(
      R"({ "at": "20ms", "set": { "start": true, "speed": 99 } },
         { "at": "30ms", "set": { "beat": 8, "speed": 70 } }, { "at": "32ms", "set": { "start": true } })");
  machine.run_for(21ms);
  EXPECT_EQ(machine.read("start"), 0.0);
  EXPECT_EQ(machine.read("speed"), 5.0);
  machine.run_for(10ms);  // with tick 30
  EXPECT_EQ(machine.read("silent"), 0.0);
  EXPECT_EQ(machine.read("speed"), 70.0) << "what comes with the sign of life counts";
  EXPECT_EQ(machine.read("start"), 0.0) << "nobody has written it since";
  machine.run_for(2ms);
  EXPECT_EQ(machine.read("start"), 1.0);
  machine.run_for(10ms);
  EXPECT_EQ(machine.read("silent"), 1.0) << "and again";
  EXPECT_EQ(controller_of(machine).watchdogs[0].silences(), 2u);
}

TEST(Watchdog, IsNotDeceivedByAProgramThatChangesTheHeartbeat) {
  Simulation machine = watched("", R"(, { "set": "beat", "to": "beat + 1" })");
  machine.run_for(11ms);
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, SeesASignOfLifeThatAProgramTakesBackInTheSameTick) {
  Simulation machine =
      watched(R"({ "at": "8ms", "set": { "beat": 1 } }, { "at": "16ms", "set": { "beat": 1 } })",
              R"(, { "set": "beat", "to": "0" })");
  machine.run_for(26ms);
  EXPECT_EQ(machine.read("silent"), 0.0) << "a handshake: a panel writes 1, the program 0";
  machine.step();
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, TakesAHeartbeatBeforeTheFirstTickForASignOfLife) {
  // Nothing is gained by it here: the time begins with the first tick. But it is no change of the first tick
  // over again, and none is lost.
  Simulation machine = watched("");
  machine.write("beat", 8.0);
  machine.run_for(10ms);
  EXPECT_EQ(machine.read("silent"), 0.0);
  machine.step();
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, ComparesWithTheHeartbeatThatWasKept) {
  const auto heartbeat = [](Project& project) { return project.names.find("beat").place->signal; };
  for (const auto& [value, silent] : {std::pair{40u, true}, {7u, false}}) {
    LoadedProject loaded =
        load_project(project(""), "", [&](Project& kept) { heartbeat(kept).store(Value{.u = 40}); });
    ASSERT_TRUE(loaded.project) << lines(loaded.problems);
    Controller& controller = *loaded.project->controller;
    for (int tick = 0; tick < 5; ++tick) controller.tick();
    heartbeat(*loaded.project).store(Value{.u = value});
    for (int tick = 5; tick < 11; ++tick) controller.tick();
    EXPECT_EQ(controller.watchdogs[0].silent(), silent) << value;
  }
}

TEST(Watchdog, CountsTicksThatWereLeftOutAsTime) {
  Simulation machine = watched("");
  machine.run_for(3ms);
  controller_of(machine).skip(7);
  machine.step();  // tick 10
  EXPECT_EQ(machine.read("silent"), 1.0);
}

TEST(Watchdog, MayBeOneOfSeveral) {
  std::string two = project("");
  const std::string one = R"("watchdog": { "tag": "beat",)";
  two.replace(
      two.find(one), one.size(),
      R"("watchdog": [ { "tag": "pulse", "timeout": "5ms", "set": { "doubled": 0 } }, { "tag": "beat",)");
  two.replace(two.rfind("} }") - 1, 0, "]");
  Simulation machine = Simulation::from_text(two);
  ASSERT_EQ(controller_of(machine).watchdogs.size(), 2u);
  machine.run_for(6ms);
  EXPECT_TRUE(controller_of(machine).watchdogs[0].silent());
  EXPECT_FALSE(controller_of(machine).watchdogs[1].silent());
}

struct Wrong {
  std::string watchdog, place, part;
};

TEST(Watchdog, IsToldOfWhatIsWrong) {
  const std::string text = project("");
  const auto begin = text.find(R"("watchdog": )") + 12;
  const auto end = text.find("} }", begin) + 3;
  for (const Wrong& wrong : std::vector<Wrong>{
           {"1", "", "allowed: an object, or an array of them"},
           {"{}", "", "the key 'tag' is missing"},
           {R"({ "tag": "beat", "timeout": "1s" })", "", "would have no effect"},
           {R"({ "tag": "beat", "timeout": "0s", "status": "silent" })", "/timeout", "from 1ms to"},
           {R"({ "tag": "baet", "timeout": "1s", "status": "silent" })", "/tag", "did you mean 'beat'"},
           {R"({ "tag": "silent", "timeout": "1s", "status": "silent" })", "/tag",
            "cannot be written by a client"},
           {R"({ "tag": "limits", "timeout": "1s", "status": "silent" })", "/tag", ""},
           {R"({ "tag": "beat", "timeout": "1s", "status": "speed" })", "/status", "is no BOOL"},
           {R"({ "tag": "beat", "timeout": "1s", "set": { "speed": true } })", "/set/speed", ""},
           {R"({ "tag": "beat", "timeout": "1s", "set": { "beat": 1 } })", "/set/beat",
            "is the heartbeat of a watchdog"},
           {R"({ "tag": "beat", "timeout": "1s", "set": { "START": false, "start": true } })", "/set/start",
            "is set by a watchdog already"},
           {R"([ { "tag": "beat", "timeout": "1s", "set": { "speed": 0 } },
                 { "tag": "beat", "timeout": "2s", "set": { "speed": 9 } } ])",
            "/1/set/speed", "is set by a watchdog already"},
           {R"([ { "tag": "beat", "timeout": "1s", "set": { "speed": 0 } },
                 { "tag": "start", "timeout": "2s", "set": { "beat": 1 } } ])",
            "/1/set/beat", "is the heartbeat of a watchdog"},
           {R"([ { "tag": "beat", "timeout": "1s", "status": "silent" },
                 { "tag": "start", "timeout": "2s", "set": { "silent": true } } ])",
            "/1/set/silent", "is the status of a watchdog"},
           {R"({ "tag": "start", "timeout": "1s", "status": "start" })", "/status",
            "is the heartbeat of a watchdog"},
           {R"([ { "tag": "beat", "timeout": "1s", "status": "silent" },
                 { "tag": "start", "timeout": "1s", "status": "silent" } ])",
            "/1/status", "is the status of a watchdog"}}) {
    std::string changed_text = text;
    changed_text.replace(begin, end - begin, wrong.watchdog);
    const LoadedProject loaded = load_project(changed_text);
    EXPECT_FALSE(loaded.project) << wrong.watchdog;
    ASSERT_FALSE(loaded.problems.empty()) << wrong.watchdog;
    EXPECT_EQ(loaded.problems[0].place, "/modbus/watchdog" + wrong.place) << loaded.problems[0].text;
    EXPECT_NE(loaded.problems[0].text.find(wrong.part), std::string::npos) << loaded.problems[0].text;
  }
}

TEST(Watchdog, StandsBesideTheMapThatHasItsHeartbeat) {
  const auto first_problem = [](const std::string& more) {
    const LoadedProject loaded = load_project(project("", "", more));
    return loaded.problems.empty() ? "" : loaded.problems[0].place + ": " + loaded.problems[0].text;
  };
  const std::string dog = R"("watchdog": { "tag": "pulse", "timeout": "1s", "set": { "doubled": 0 } })";
  const std::string map = R"("map": [ { "tag": "pulse", "table": "coil", "address": 0 } ])";
  EXPECT_EQ(first_problem(R"(, "server": { "listen": "127.0.0.1:0", )" + map + ", " + dog + " }"), "");
  EXPECT_EQ(first_problem(R"(, "units": [ { "unit": 3, )" + map + ", " + dog + " } ]"), "");
  EXPECT_NE(first_problem(R"(, "server": { "listen": "127.0.0.1:0", )" + dog + " }")
                .find("/modbus/server/watchdog: this server has no map of its own"),
            std::string::npos);
  EXPECT_NE(first_problem(R"(, "units": [ { "unit": 3, "map": [], )" + dog + " } ]")
                .find("/modbus/units/0/watchdog/tag: 'pulse' cannot be written by a client"),
            std::string::npos);
}

}  // namespace
}  // namespace lockstep::watchdog_test
