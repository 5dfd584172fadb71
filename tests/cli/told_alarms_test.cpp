// lockstep run: what the console tells of an alarm whose cause is a value of the project.
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::told_alarms_test {
namespace {

struct ZeroCase {
  const char* name;
  const char* config;
  const char* told;    // the values
  const char* remedy;  // what to write
};

class LimitOfZeroIsTold : public testing::TestWithParam<ZeroCase> {};

TEST_P(LimitOfZeroIsTold, WithWhichLimitItIsTheValuesAndWhatToWrite) {
  const Directory folder;
  const std::string file = folder.write(
      "zero.json", std::string(R"({ "lockstep": 1, "name": "zero", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
      "DynamicDefaults": { "Velocity": 10.0, "Acceleration": 100.0, "Deceleration": 100.0, "Jerk": 400.0 }, )") +
                       GetParam().config + R"( } } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [
      { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } },
      { "fb": "MC_MoveRelative", "name": "move", "in": { "Axis": "Slide", "Execute": "power.Status", "Distance": 5.0 } } ] } ] })");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "100ms"});
  EXPECT_EQ(ended.status, 0);
  for (const char* const part :
       {GetParam().told, GetParam().remedy, "move (MC_MoveRelative of Slide): failed"})
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
}

INSTANTIATE_TEST_SUITE_P(
    Alarms, LimitOfZeroIsTold,
    testing::Values(ZeroCase{"Velocity", R"("DynamicLimits": { "MaxVelocity": 500.0, "Velocity": 0.0 })",
                             "MaxVelocity 500 mm/s, Velocity 0 mm/s\n",
                             "remedy: write a value above 0 to the one that is 0"},
                    ZeroCase{"Deceleration", R"("DynamicLimits": { "MaxDeceleration": 0.0 })",
                             "value of the motion 0 mm/s², limit 0 mm/s²; the deceleration\n",
                             "remedy: write a value above 0 to the limit"},
                    ZeroCase{"Jerk", R"("DynamicLimits": { "MaxJerk": 0.0 })",
                             "jerk of the job 400 mm/s³, limit 0 mm/s³\n",
                             "remedy: write a value above 0 to DynamicLimits.MaxJerk"}),
    [](const auto& tested) { return tested.param.name; });

/// A run of 8 s of a project with some objects, tags, calls and stimuli.
Ended run_of(const std::string& objects, const std::string& tags, const std::string& calls,
             const std::string& stimuli = "") {
  const Directory folder;
  const std::string file = folder.write(
      "project.json",
      R"({ "lockstep": 1, "name": "told", "clock": { "servo_cycle": "1ms" }, "technology_objects": { )" +
          objects + R"( }, "tags": { )" + tags +
          R"( }, "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ )" + calls +
          R"( ] } ], "stimuli": [ )" + stimuli + " ] }");
  Ended ended = lockstep({"run", file, "--simulate", "--duration", "8s"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended;
}

void expect_told(const Ended& ended, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
}

constexpr char kPower[] = R"({ "fb": "MC_Power", "name": "on", "in": { "Axis": "Slide", "Enable": true } })";

std::string slide(const std::string& config, const std::string& drive = "") {
  return R"("Slide": { "type": "TO_PositioningAxis", "config": { )" + config +
         R"( }, "drive": { "model": "simulated", "time_constant": "2ms")" + drive + " } }";
}

TEST(HomingIsTold, WithTheMarkThatIsMissingInTheSummaryToo) {
  const auto home = [](const std::string& mode) {
    return run_of(
        slide(R"("Sensor[1]": { "ActiveHoming": { "Mode": )" + mode + " } }"), "",
        std::string(kPower) +
            R"(, { "fb": "MC_Home", "name": "home", "in": { "Axis": "Slide", "Execute": "on.Status", "Mode": 3 } })");
  };
  const Ended mark = home("1"), cam = home("2");
  expect_told(mark, {"alarm 343: no zero mark: the encoder of the machine has none (",
                     "remedy: give the machine zero_marks",
                     "  Slide  alarm 343 (no zero mark: the encoder of the machine has none) at "});
  expect_told(cam, {"alarm 343: no reference cam or switch: ", "remedy: give the machine a reference cam",
                    "  Slide  alarm 343 (no reference cam or switch: "});
  for (const Ended& ended : {mark, cam})
    EXPECT_EQ(ended.err.find("not supported"), std::string::npos) << ended.err;
}

TEST(AddressesAreTold, OfLimitSwitchesTheSideAndTheInput) {
  const auto run_out = [](const std::string& velocity) {
    return run_of(
        slide(
            R"("PositionLimits_HW": { "Active": true, "MinSwitchAddress": "low", "MinSwitchLevel": true,
                 "MaxSwitchAddress": "high", "MaxSwitchLevel": true })",
            R"(, "digital_inputs": [ { "tag": "low", "range": [-60.0, -50.0] }, { "tag": "high", "range": [50.0, 60.0] } ])"),
        R"("low": { "type": "BOOL" }, "high": { "type": "BOOL" })",
        std::string(kPower) +
            R"(, { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Slide", "Execute": "on.Status", "Velocity": )" +
            velocity + " } }");
  };
  expect_told(run_out("20.0"), {"alarm 531: ", "position 49.99", " mm; positive limit switch, input high\n"});
  expect_told(run_out("-20.0"),
              {"alarm 531: ", "position -49.99", " mm; negative limit switch, input low\n"});
}

TEST(AddressesAreTold, OfSeveralEncodersWhichOneHasFailed) {
  const Ended ended = run_of(
      slide(R"("Sensor[1]": { "Existent": true }, "Sensor[2]": { "Existent": true })",
            R"(, "sensors": [ { "sensor": 2, "fault": "broken" } ])"),
      R"("broken": { "type": "BOOL" })",
      std::string(kPower) +
          R"(, { "fb": "MC_SetSensor", "name": "take", "in": { "Axis": "Slide", "Execute": "on.Status", "Sensor": 2 } })",
      R"({ "at": "2s", "set": { "broken": true } })");
  expect_told(ended, {"Slide: alarm 411: ", "  sensor 2\n"});
}

TEST(AddressesAreTold, OfACouplingTheLeadingObject) {
  const Ended ended = run_of(
      R"("Belt": { "type": "TO_ExternalEncoder", "encoder": { "model": "simulated", "signal": "counted", "valid": "heard" } },
         "Drum": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
                   "leading_values": [ { "to": "Belt", "coupling": "actual" } ] })",
      R"("counted": { "type": "LREAL" }, "heard": { "type": "BOOL", "init": true })",
      R"({ "fb": "MC_Power", "name": "on", "in": { "Axis": "Drum", "Enable": true } },
         { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Belt", "Slave": "Drum", "Execute": "on.Status" } })",
      R"({ "at": "2s", "set": { "heard": false } })");
  expect_told(ended, {"Drum: alarm 601: ", "TO_ExternalEncoder Belt"});
}

/// What ends a shift or an offset before it is made.
TEST(AbortedShiftsAreTold, WithWhatHasAbortedThem) {
  const auto aborted = [](const std::string& shift, const std::string& by) {
    return run_of(
        R"("Belt": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } },
           "Drum": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } }, "leading_values": [ { "to": "Belt" } ] })",
        R"("shift": { "type": "BOOL" }, "other": { "type": "BOOL" }, "enable": { "type": "BOOL", "init": true })",
        R"({ "fb": "MC_Power", "name": "on_b", "in": { "Axis": "Belt", "Enable": true } },
           { "fb": "MC_Power", "name": "on_d", "in": { "Axis": "Drum", "Enable": "enable" } },
           { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Belt", "Execute": "on_b.Status", "Velocity": 10.0 } },
           { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Belt", "Slave": "Drum", "Execute": "run.InVelocity AND on_d.Status" } },
           )" +
            shift + ", " + by,
        R"({ "at": "5s", "set": { "shift": true } }, { "at": "5.2s", "set": { "other": true } })");
  };
  constexpr char kHalt[] =
      R"({ "fb": "MC_Halt", "name": "stop_it", "in": { "Axis": "Drum", "Execute": "other" } })";
  constexpr char kDisable[] = R"({ "set": "enable", "to": "NOT other" })";
  for (const std::string type : {"MC_PhasingRelative", "MC_PhasingAbsolute"}) {
    const std::string shift =
        R"({ "fb": ")" + type +
        R"(", "name": "move_over", "in": { "Master": "Belt", "Slave": "Drum", "Execute": "shift", "PhaseShift": 50.0 } })";
    const std::string begin = " s: move_over (" + type + " of Drum): aborted by ";
    expect_told(aborted(shift, kHalt), {begin + "stop_it (MC_Halt)\n"});
    expect_told(aborted(shift, kDisable), {begin + "disabling the axis\n"});
  }
  const std::string offset =
      R"({ "fb": "MC_OffsetAbsolute", "name": "move_over", "in": { "Slave": "Drum", "Execute": "shift", "Offset": 50.0, "OffsetDistance": 100.0 } })";
  expect_told(aborted(offset, kDisable),
              {" s: move_over (MC_OffsetAbsolute of Drum): aborted by disabling the axis\n"});
}

/// For a log book; nobody knows the time of a run in virtual time.
TEST(AlarmsAreTold, InRealTimeWithTheTickAndTheTimeOfTheDay) {
  const Directory folder;
  const std::string file =
      folder.write("project.json", R"({ "lockstep": 1, "name": "clock", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
      "DynamicLimits": { "Velocity": 0.0 } } } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [
      { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } },
      { "fb": "MC_MoveRelative", "name": "move", "in": { "Axis": "Slide", "Execute": "power.Status", "Distance": 5.0 } } ] } ] })");
  using std::chrono::system_clock;
  const auto before = system_clock::now();
  const Ended real = lockstep({"run", file, "--duration", "300ms", "--no-retain"});
  const auto after = system_clock::now();
  std::smatch told;
  const std::regex moment(R"(\n  tick ([0-9]+), ([0-9-]+ [0-9:]+)\.[0-9]{6} UTC\n)");
  ASSERT_TRUE(std::regex_search(real.err, told, moment)) << real.err;
  std::tm parts{};
  ASSERT_NE(::strptime(told[2].str().c_str(), "%Y-%m-%d %H:%M:%S", &parts), nullptr) << told[2];
  const auto at = system_clock::from_time_t(::timegm(&parts));
  EXPECT_GE(at, before - std::chrono::seconds(1));
  EXPECT_LE(at, after);
  const Ended simulated = lockstep({"run", file, "--simulate", "--duration", "300ms"});
  EXPECT_EQ(simulated.err.find("UTC"), std::string::npos) << simulated.err;
  EXPECT_NE(simulated.err.find("\n  tick "), std::string::npos) << simulated.err;
}

}  // namespace
}  // namespace lockstep::cli::told_alarms_test
