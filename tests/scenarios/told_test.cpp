// What a technician reads when something goes wrong: alarms with cause, remedy and values, jobs that fail,
// shifts that are aborted; on the console, in an LCM log, over Modbus.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <cmath>
#include <memory>
#include <sstream>

#include "hmi_bridge/lcm/commands.hpp"
#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/error_remedies.hpp"
#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test {
namespace {

/// A slide in metres that is to run faster than its drive follows.
Json lagging_slide() {
  Json project = empty_project();
  project["technology_objects"]["Slide"] = Json::parse(R"({
    "type": "TO_PositioningAxis",
    "config": {
      "Units": { "LengthUnit": 1010 },
      "Mechanics": { "LeadScrew": 20.0 },
      "DynamicDefaults": { "Velocity": 200.0, "Acceleration": 2000.0, "Deceleration": 2000.0, "Jerk": 20000.0 },
      "PositionControl": { "Kv": 10.0, "Kpc": 0.0 },
      "FollowingError": { "EnableMonitoring": true, "MinValue": 2.5, "MaxValue": 2.5, "WarningLevel": 100.0 } },
    "drive": { "model": "simulated", "time_constant": "4ms" } })");
  project["tags"]["go"] = {{"type", "BOOL"}, {"init", true}};
  project["programs"] = {
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power", {{"Axis", "Slide"}, {"Enable", true}}),
         call("MC_MoveVelocity", "run",
              {{"Axis", "Slide"}, {"Execute", "power.Status AND go"}, {"Velocity", 200.0}})}}}};
  return project;
}

Ended simulated(const Json& project, const std::string& duration, const std::string& trace = "") {
  const Directory directory;
  std::vector<std::string> words{"run", directory.write("project.json", project.dump(1)), "--simulate",
                                 "--duration", duration};
  if (!trace.empty()) words.insert(words.end(), {"--trace", trace});
  return lockstep(words);
}

/// The line that begins with a text, without that; empty if there is none.
std::string line_behind(const std::string& text, const std::string& begin) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (const auto at = line.find(begin); at != line.npos) return line.substr(at + begin.size());
  return "";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++number;
  return number;
}

TEST(Told, AnAlarmNamesItsCauseItsRemedyAndTheValuesInTheUnitOfTheProject) {
  const Ended ended = simulated(lagging_slide(), "2s");
  EXPECT_NE(ended.err.find(": Slide: alarm 521: Following error too large (remove the enable)\n  tick "),
            std::string::npos)
      << ended.err;
  const Alarm& alarm = *find_alarm(521);
  EXPECT_EQ(line_behind(ended.err, "  cause: "), alarm.cause) << ended.err;
  EXPECT_EQ(line_behind(ended.err, "  remedy: "), alarm.remedy);
  std::istringstream values(line_behind(ended.err, "  following error "));
  double measured = 0.0;
  std::string unit;
  values >> measured >> unit;
  EXPECT_GT(measured, 2.5) << ended.err;
  EXPECT_LT(measured, 5.0) << "of the tick that exceeds it";
  EXPECT_EQ(unit, "m,");
  EXPECT_NE(ended.err.find(" m, permitted 2.5 m; sensor 1\n"), std::string::npos) << ended.err;
  const Ended described = lockstep({"describe", "521", "--json"});
  const Json json = Json::parse(described.out);
  EXPECT_EQ(json.at("cause"), std::string(alarm.cause)) << "the same text";
  EXPECT_EQ(json.at("remedy"), std::string(alarm.remedy));
}

/// The first alarm of an LCM log, and its details.
std::pair<event_t, event_detail_t> first_alarm(const std::string& path) {
  const std::unique_ptr<lcm_eventlog_t, void (*)(lcm_eventlog_t*)> log(lcm_eventlog_create(path.c_str(), "r"),
                                                                       &lcm_eventlog_destroy);
  event_t event{};
  event_detail_t detail{};
  while (lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log.get())) {
    const std::string name(entry->channel, static_cast<std::size_t>(entry->channellen));
    const std::span bytes(static_cast<const std::uint8_t*>(entry->data),
                          static_cast<std::size_t>(entry->datalen));
    if (name.ends_with("_EVENTS") && event.kind != "alarm") event = decode_event(bytes).value();
    if (name.ends_with("_DETAIL") && detail.kind != "alarm") detail = decode_detail(bytes).value();
    lcm_eventlog_free_event(entry);
  }
  return {event, detail};
}

TEST(Told, AnLcmLogHoldsTheDetailsBehindTheEvent) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  EXPECT_EQ(simulated(lagging_slide(), "2s", path).status, 0);
  const auto [event, detail] = first_alarm(path);
  EXPECT_EQ(event.kind, "alarm");
  EXPECT_EQ(detail.kind, "alarm");
  EXPECT_EQ(detail.t, event.t);
  EXPECT_EQ(detail.tick, event.tick);
  EXPECT_EQ(detail.source, "Slide");
  EXPECT_EQ(detail.number, 521);
  EXPECT_EQ(detail.cause, find_alarm(521)->cause);
  EXPECT_EQ(detail.remedy, find_alarm(521)->remedy);
  EXPECT_EQ(detail.sensor, 1);
  EXPECT_EQ(detail.unit, "m");
  ASSERT_EQ(detail.n, 2);
  EXPECT_EQ(detail.names[0], "following error");
  EXPECT_GT(detail.values[0], 2.5);
  EXPECT_EQ(detail.names[1], "permitted");
  EXPECT_EQ(detail.values[1], 2.5);
}

std::int64_t wall_clock() {  // [µs]
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

TEST(Told, AnLcmLogOfARunInRealTimeHasTheTimeOfTheDayToo) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const std::int64_t before = wall_clock();
  const Ended ended = lockstep({"run", directory.write("project.json", lagging_slide().dump(1)), "--duration",
                                "500ms", "--no-modbus", "--no-lcm", "--no-retain", "--trace", path});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto [event, detail] = first_alarm(path);
  EXPECT_EQ(event.kind, "alarm") << ended.err;
  EXPECT_EQ(event.number, 521);
  EXPECT_GT(event.tick, 0);
  EXPECT_GE(event.utime, before);
  EXPECT_LE(event.utime, wall_clock());
}

TEST(Told, ASoftwareLimitNamesItsSideThePositionAndTheLimit) {
  Json project = lagging_slide();
  Json& config = project["technology_objects"]["Slide"]["config"];
  config["Units"]["LengthUnit"] = 1013;
  config["FollowingError"]["EnableMonitoring"] = false;
  config["PositionLimits_SW"] = {{"Active", true}, {"MinPosition", -10.0}, {"MaxPosition", 75.0}};
  project["programs"][0]["calls"].insert(
      project["programs"][0]["calls"].begin() + 1,
      call("MC_Home", "home",
           {{"Axis", "Slide"}, {"Execute", "power.Status"}, {"Mode", 0}, {"Position", 0.0}}));
  project["programs"][0]["calls"][2]["in"]["Execute"] = "home.Done";
  const Ended ended = simulated(project, "3s");
  EXPECT_NE(ended.err.find("alarm 533: "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(" mm, limit 75 mm; at the positive end\n"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("  Slide  alarm 533"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("at 75 mm"), std::string::npos) << "the summary too: " << ended.err;
}

TEST(Told, AHomingWithoutAMarkSaysWhichOneIsMissing) {
  Json project = lagging_slide();
  project["programs"][0]["calls"][1] = call(
      "MC_Home", "home", {{"Axis", "Slide"}, {"Execute", "power.Status"}, {"Mode", 3}, {"Position", 0.0}});
  const Ended ended = simulated(project, "1s");
  EXPECT_NE(
      ended.err.find(": Slide: alarm 343: no zero mark: the encoder of the machine has none (remove the "
                     "enable)\n"),
      std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("  sensor 1\n"), std::string::npos) << ended.err;
  EXPECT_NE(line_behind(ended.err, "  remedy: "), find_alarm(343)->remedy) << "its own";
  EXPECT_NE(ended.err.find(" (MC_Home of Slide): failed, ErrorID 16#8001: technology alarm"),
            std::string::npos)
      << ended.err;
}

/// Asks every other tick for a motion of an axis that is not enabled.
TEST(Told, AJobThatFailsIsToldOnceWithItsAxisAndCountedWhenItFailsAgain) {
  Json project = lagging_slide();
  project["tags"]["odd"] = {{"type", "BOOL"}};
  project["programs"][0]["calls"] = {
      assignment("odd", "NOT odd"),
      call("MC_MoveVelocity", "run", {{"Axis", "Slide"}, {"Execute", "odd"}, {"Velocity", 10.0}})};
  const Ended ended = simulated(project, "1s");
  const std::string what = ": run (MC_MoveVelocity of Slide): failed, ErrorID 16#800F: ";
  ASSERT_EQ(count(ended.err, " s" + what), 1u) << ended.err;
  EXPECT_EQ(line_behind(ended.err, "  remedy: "), error_remedy(ErrorId::locked));
  EXPECT_NE(ended.err.find(": 499 more times\n"), std::string::npos) << "500 in a second: " << ended.err;
  EXPECT_LT(count(ended.err, "\n"), 12u) << ended.err;
}

/// Its default velocity is below the synchronous one, which the value that is permitted for the pin does not
/// tell.
TEST(Told, AGearThatIsFasterThanTheVelocityOfTheJobSaysWhatToRaise) {
  Json project = empty_project();
  project["technology_objects"]["Belt"] = virtual_axis();
  project["technology_objects"]["Drum"] = virtual_axis({"Belt"});
  project["technology_objects"]["Drum"]["config"]["DynamicDefaults"]["Velocity"] = 20.0;
  project["programs"] = {
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power_b", {{"Axis", "Belt"}, {"Enable", true}}),
         call("MC_Power", "power_d", {{"Axis", "Drum"}, {"Enable", true}}),
         call("MC_Home", "home", {{"Axis", "Drum"}, {"Execute", "power_d.Status"}, {"Mode", 0}}),
         call("MC_MoveVelocity", "run",
              {{"Axis", "Belt"}, {"Execute", "power_b.Status"}, {"Velocity", 10.0}}),
         call("MC_GearInPos", "gear",
              {{"Master", "Belt"},
               {"Slave", "Drum"},
               {"Execute", "run.InVelocity AND home.Done"},
               {"RatioNumerator", 3},
               {"SyncProfileReference", 0},
               {"MasterSyncPosition", 100.0}})}}}};
  const Ended ended = simulated(project, "8s");
  EXPECT_NE(ended.err.find(": gear (MC_GearInPos of Drum): failed, ErrorID 16#8003: "), std::string::npos)
      << ended.err;
  const std::string remedy = line_behind(ended.err, "  remedy: ");
  for (const char* const part : {"synchronous velocity", "pin Velocity", "DynamicDefaults.Velocity"})
    EXPECT_NE(remedy.find(part), std::string::npos) << part << "\n" << ended.err;
  // What it says to raise is what helps.
  project["technology_objects"]["Drum"]["config"]["DynamicDefaults"]["Velocity"] = 40.0;
  EXPECT_EQ(simulated(project, "8s").err.find("failed"), std::string::npos);
  project["technology_objects"]["Drum"]["config"]["DynamicDefaults"]["Velocity"] = 20.0;
  project["programs"][0]["calls"][4]["in"]["Velocity"] = 40.0;
  EXPECT_EQ(simulated(project, "8s").err.find("failed"), std::string::npos);
}

TEST(Told, AnAbortedOffsetSaysWhatHasAbortedIt) {
  Json project = empty_project();
  project["technology_objects"]["Belt"] = virtual_axis();
  project["technology_objects"]["Drum"] = virtual_axis({"Belt"});
  project["tags"] = Json::parse(R"({"shift": {"type": "BOOL"}, "halt": {"type": "BOOL"}})");
  project["programs"] = {
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {call("MC_Power", "power_b", {{"Axis", "Belt"}, {"Enable", true}}),
         call("MC_Power", "power_d", {{"Axis", "Drum"}, {"Enable", true}}),
         call("MC_MoveVelocity", "run",
              {{"Axis", "Belt"}, {"Execute", "power_b.Status"}, {"Velocity", 10.0}}),
         call("MC_GearIn", "gear",
              {{"Master", "Belt"}, {"Slave", "Drum"}, {"Execute", "run.InVelocity AND power_d.Status"}}),
         call("MC_OffsetRelative", "move_over",
              {{"Slave", "Drum"}, {"Execute", "shift"}, {"Offset", 50.0}, {"OffsetDistance", 100.0}}),
         call("MC_Halt", "stop_it", {{"Axis", "Drum"}, {"Execute", "halt"}})}}}};
  project["stimuli"] = {stimulus("5s", "shift", true), stimulus("6s", "halt", true)};
  const Ended ended = simulated(project, "8s");
  EXPECT_EQ(line_behind(ended.err, ": move_over (MC_OffsetRelative of Drum): "),
            "aborted by stop_it (MC_Halt)")
      << ended.err;
  EXPECT_EQ(count(ended.err, ": gear"), 0u) << "of others an abort is part of the process: " << ended.err;
}

std::uint64_t registers(modbus_t* client, int address, int words) {
  std::uint16_t read[4] = {};
  EXPECT_EQ(modbus_read_input_registers(client, address, words, read), words) << modbus_strerror(errno);
  std::uint64_t value = 0;
  for (int i = 0; i < words; ++i) value = value << 16 | read[i];
  return value;
}

struct FreeModbus {
  void operator()(modbus_t* client) const {
    modbus_close(client);
    modbus_free(client);
  }
};
using RawModbus = std::unique_ptr<modbus_t, FreeModbus>;

RawModbus connected(int port) {
  RawModbus client(modbus_new_tcp("127.0.0.1", port));
  modbus_set_response_timeout(client.get(), 20, 0);
  EXPECT_EQ(modbus_connect(client.get()), 0) << modbus_strerror(errno);
  return client;
}

TEST(Told, TheNewestAlarmStandsOnModbusWithItsValuesAndItsTime) {
  Json project = lagging_slide();
  project["modbus"]["map"] = Json::parse(R"([
    {"diagnostic": "alarm_number", "table": "input_register", "address": 0, "type": "UINT"},
    {"diagnostic": "alarm_object", "table": "input_register", "address": 1, "type": "UINT"},
    {"diagnostic": "alarm_address", "table": "input_register", "address": 2, "type": "UINT"},
    {"diagnostic": "alarm_value", "table": "input_register", "address": 4},
    {"diagnostic": "alarm_limit", "table": "input_register", "address": 8},
    {"diagnostic": "alarm_clock", "table": "input_register", "address": 12},
    {"tag": "Slide.ErrorDetail.Number", "table": "input_register", "address": 16},
    {"diagnostic": "alarm_tick", "table": "input_register", "address": 18},
    {"diagnostic": "alarm_time", "table": "input_register", "address": 22, "type": "LINT"} ])");
  const Directory directory;
  const auto before = wall_clock();
  RunningLockstep run(directory.write("project.json", project.dump()));
  const RawModbus client = connected(run.port());
  ASSERT_TRUE(wait_until([&] { return registers(client.get(), 0, 1) == 521; })) << run.err();
  EXPECT_EQ(registers(client.get(), 1, 1), 1u);
  EXPECT_EQ(registers(client.get(), 2, 1), 1u) << "sensor";
  EXPECT_GT(std::bit_cast<double>(registers(client.get(), 4, 4)), 2.5);
  EXPECT_EQ(std::bit_cast<double>(registers(client.get(), 8, 4)), 2.5);
  EXPECT_GE(static_cast<std::int64_t>(registers(client.get(), 12, 4)), before);
  EXPECT_LE(static_cast<std::int64_t>(registers(client.get(), 12, 4)), wall_clock() + 1'000'000);
  EXPECT_EQ(registers(client.get(), 16, 2), 521u);
  const std::uint64_t tick = registers(client.get(), 18, 4);
  EXPECT_GT(tick, 0u);
  EXPECT_EQ(registers(client.get(), 22, 4), tick * 1'000'000) << "[ns] of ticks of a millisecond";
}

TEST(Told, AMapEntryWithLimitsRefusesWhatIsOutsideAndWritesNothingOfThatRequest) {
  Json project = empty_project();
  project["tags"] = Json::parse(R"({"speed": {"type": "LREAL", "init": 100.0}, "count": {"type": "INT"}})");
  project["modbus"]["gaps"] = "zero";
  project["modbus"]["map"] = Json::parse(R"([
    {"tag": "count", "table": "holding_register", "address": 10},
    {"tag": "speed", "table": "holding_register", "address": 11, "type": "INT", "scale": 0.1, "min": 20.0, "max": 300.3},
    {"tag": "count", "table": "holding_register", "address": 14, "access": "read"} ])");
  const Directory directory;
  RunningLockstep run(directory.write("project.json", project.dump()));
  const RawModbus client = connected(run.port());
  const auto write = [&](std::uint16_t count, std::uint16_t speed) {
    const std::uint16_t words[] = {count, speed};
    return modbus_write_registers(client.get(), 10, 2, words);
  };
  const auto refused = [&](std::uint16_t speed) {
    errno = 0;
    return write(7, speed) == -1 && errno == EMBXILVAL;
  };
  EXPECT_TRUE(refused(199));
  EXPECT_TRUE(refused(3004));
  EXPECT_TRUE(refused(0xFFFF)) << "-0.1";
  std::uint16_t read[5] = {9, 9, 9, 9, 9};
  ASSERT_EQ(modbus_read_registers(client.get(), 10, 5, read), 5) << "with a gap: " << modbus_strerror(errno);
  EXPECT_EQ(read[0], 0) << "nothing of the request";
  EXPECT_EQ(read[1], 1000);
  EXPECT_EQ(read[2], 0);
  EXPECT_EQ(read[3], 0);
  EXPECT_EQ(write(7, 3003), 2) << "the limit itself: " << modbus_strerror(errno);
  EXPECT_EQ(write(8, 200), 2);
  EXPECT_EQ(modbus_read_registers(client.get(), 9, 2, read), -1) << "before the first entry is no gap";
  EXPECT_EQ(modbus_read_registers(client.get(), 14, 2, read), -1) << "nor behind the last one";
  EXPECT_EQ(modbus_write_register(client.get(), 12, 0), -1) << "nobody writes to a gap";
}

TEST(Told, GapsOfBitsAreReadAsZeroOnlyWhereTheProjectSaysSo) {
  Json project = empty_project();
  project["tags"] =
      Json::parse(R"({"a": {"type": "BOOL", "init": true}, "b": {"type": "BOOL", "init": true}})");
  project["modbus"]["map"] = Json::parse(R"([
    {"tag": "a", "table": "coil", "address": 10}, {"tag": "b", "table": "coil", "address": 13},
    {"tag": "a", "table": "discrete_input", "address": 10}, {"tag": "b", "table": "discrete_input", "address": 13} ])");
  const Directory directory;
  std::uint8_t read[4] = {9, 9, 9, 9};
  {
    RunningLockstep run(directory.write("refused.json", project.dump()));
    const RawModbus client = connected(run.port());
    EXPECT_EQ(modbus_read_bits(client.get(), 10, 4, read), -1);
    EXPECT_EQ(errno, EMBXILADD);
  }
  project["modbus"]["gaps"] = "zero";
  RunningLockstep run(directory.write("zero.json", project.dump()));
  const RawModbus client = connected(run.port());
  for (const auto function : {&modbus_read_bits, &modbus_read_input_bits}) {
    ASSERT_EQ(function(client.get(), 10, 4, read), 4) << modbus_strerror(errno);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(read[i], i == 0 || i == 3 ? 1 : 0) << i;
    EXPECT_EQ(function(client.get(), 9, 2, read), -1) << "before the first entry is no gap";
    EXPECT_EQ(function(client.get(), 13, 2, read), -1) << "nor behind the last one";
  }
  EXPECT_EQ(modbus_write_bit(client.get(), 11, 1), -1) << "nobody writes to a gap";
  const std::uint8_t all[] = {0, 0, 0, 0};
  EXPECT_EQ(modbus_write_bits(client.get(), 10, 4, all), -1);
  ASSERT_EQ(modbus_read_bits(client.get(), 10, 4, read), 4);
  EXPECT_EQ(read[0], 1) << "and nothing of that request is written";
}

TEST(Told, LimitsOfAnEntryAreCheckedAgainstItsTypeAndScale) {
  const auto problem = [](const std::string& entry) {
    Json project = empty_project();
    project["tags"] =
        Json::parse(R"({"speed": {"type": "LREAL"}, "count": {"type": "INT"}, "on": {"type": "BOOL"}})");
    project["modbus"]["map"] = Json::parse("[" + entry + "]");
    const Directory directory;
    const Ended ended = lockstep({"check", directory.write("project.json", project.dump(1))});
    EXPECT_EQ(ended.status, 1) << entry;
    return ended.err;
  };
  const auto expect = [&](const std::string& entry, const std::string& text) {
    const std::string told = problem(entry);
    EXPECT_NE(told.find(text), std::string::npos) << told;
  };
  expect(
      R"({"tag": "speed", "table": "holding_register", "address": 0, "type": "INT", "scale": 0.1, "max": 4000.0})",
      "can never be written here; allowed: -3276.8 to 3276.7");
  expect(R"({"tag": "count", "table": "holding_register", "address": 0, "type": "UINT", "min": -5})",
         "allowed: 0 to 32767");
  expect(R"({"tag": "speed", "table": "holding_register", "address": 0, "type": "REAL", "max": 1e39})",
         "can never be written here; allowed: -3.402823466e+38 to 3.402823466e+38");
  expect(R"({"tag": "speed", "table": "holding_register", "address": 0, "min": 5, "max": 4})",
         "min is above max");
  expect(R"({"tag": "speed", "table": "input_register", "address": 0, "min": 5})",
         "no client may write this entry");
  expect(R"({"tag": "on", "table": "coil", "address": 0, "max": 1})", "of type BOOL has no 'max'");
}

}  // namespace
}  // namespace lockstep::test
