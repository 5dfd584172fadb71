// What a field bus, a panel and the drive have to do with a device: process data, parameters written from
// outside, contents of a Modbus map, GETVLT, SETVLT, analog terminals, keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tech_objects/mco305_catalogue/drive_parameters.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::device_outside_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;
using std::chrono::milliseconds;

Json project_with(const Texts& program) {
  Json json = Json::parse(R"({
    "lockstep": 1, "name": "outside", "clock": { "servo_cycle": "1ms" },
    "tags": { "trim": { "type": "LREAL" }, "meter": { "type": "LREAL" } },
    "technology_objects": { "Teddy": {
      "type": "MCO_305",
      "parameters": { "ENCODER": 500, "VELMAX": 3000, "RAMPMIN": 0.5 },
      "analog_inputs": { "53": "trim" }, "analog_outputs": { "42": "meter" },
      "programs": [ { "number": 0, "autostart": true } ] } }
  })");
  json["technology_objects"]["Teddy"]["programs"][0]["lines"] = program;
  return json;
}

struct Machine {
  Simulation machine;
  explicit Machine(const Texts& program) : machine(Simulation::from_text(project_with(program).dump())) {}
  explicit Machine(const Json& project) : machine(Simulation::from_text(project.dump())) {}
  void run(int steps) { machine.run_for(milliseconds(steps)); }
  double operator[](const std::string& variable) const { return machine.read("Teddy." + variable); }
  void write(const std::string& variable, double value) { machine.write("Teddy." + variable, value); }
};

const Texts kRest = {"rest:", "DELAY 100000", "GOTO rest"};

Texts with_rest(Texts lines, const Texts& subprograms = {}) {
  lines.insert(lines.end(), kRest.begin(), kRest.end());
  if (subprograms.empty()) return lines;
  lines.emplace_back("SUBMAINPROG");
  lines.insert(lines.end(), subprograms.begin(), subprograms.end());
  lines.emplace_back("ENDPROG");
  return lines;
}

TEST(ProcessData, AreReadAndWrittenByWordsBytesAndBits) {
  Machine run(with_rest({"DELAY 10", "SET 1901 PCD[1]", "SET 1902 (PCD[2].b2)", "SET 1903 (PCD[1].3)",
                         "SET 1904 (GET 34-02)", "PCD[1].3 = 1", "PCD[1].16 = 1", "PCD[2] = 0x12345",
                         "SET 1905 (GET 34-22)"}));
  run.write("PcdIn[1]", 0xF004);
  run.write("PcdIn[2]", 0xAB01);
  run.run(20);
  EXPECT_EQ(run["P1901"], 0xF004);
  EXPECT_EQ(run["P1902"], 0xAB);
  EXPECT_EQ(run["P1903"], 1);
  EXPECT_EQ(run["P1904"], 0xAB01);
  EXPECT_EQ(run["PcdOut[1]"], 0x8004) << "bits of what is sent, whatever has come";
  EXPECT_EQ(run["PcdOut[2]"], 0x2345) << "a word has 16 bits";
  EXPECT_EQ(run["P1905"], 0x2345);
  EXPECT_EQ(run["P34_21"], 0x8004);
  EXPECT_EQ(run["P34_01"], 0xF004);
}

TEST(ProcessData, AreCopiedFromAndToArrays) {
  Machine run(
      with_rest({"DIM got[10], sent[3]", "DELAY 10", "COMOPTGET 10 got", "SET 1901 got[1]",
                 "SET 1902 got[10]", "sent[1] = 7", "sent[2] = -1", "sent[3] = 9", "COMOPTSEND 2 sent"}));
  run.write("PcdIn[1]", 11);
  run.write("PcdIn[10]", 20);
  run.run(20);
  EXPECT_EQ(run["P1901"], 11);
  EXPECT_EQ(run["P1902"], 20);
  EXPECT_EQ(run["PcdOut[1]"], 7);
  EXPECT_EQ(run["PcdOut[2]"], 0xFFFF);
  EXPECT_EQ(run["PcdOut[3]"], 0) << "two words were sent";
}

TEST(ProcessData, OfWordsThatAreNotThereAreError171) {
  for (const char* const line : {"x = PCD[0]", "x = PCD[11]", "PCD[11] = 1", "COMOPTGET 4 few",
                                 "COMOPTSEND 11 many", "COMOPTGET (-1) few"}) {
    Machine run(with_rest({"DIM few[3], many[20]", line}));
    run.run(10);
    EXPECT_EQ(run["ERRNO"], 171) << line;
  }
}

TEST(Combit, ComesWithTheRisingOrFallingBitOfTheFirst32) {
  Machine run(with_rest({"a = 0", "b = 0", "ON COMBIT 3 GOSUB rises", "ON COMBIT -20 GOSUB falls"},
                        {"SUBPROG rises", "a = a + 1", "SET 1901 a", "RETURN", "SUBPROG falls", "b = b + 1",
                         "SET 1902 b", "RETURN"}));
  run.run(10);
  run.write("PcdIn[1]", 1 << 2);
  run.run(10);
  EXPECT_EQ(run["P1901"], 1);
  run.write("PcdIn[2]", 1 << 3);
  run.run(10);
  EXPECT_EQ(run["P1901"], 1) << "it is held, and comes once";
  EXPECT_EQ(run["P1902"], 0);
  run.write("PcdIn[2]", 0);
  run.write("PcdIn[1]", 0);
  run.run(10);
  EXPECT_EQ(run["P1902"], 1);
  run.write("PcdIn[1]", 1 << 2);
  run.run(10);
  EXPECT_EQ(run["P1901"], 2);
}

TEST(Panel, ChangesParametersWhichOnParamSeesAndSetDoesNot) {
  Machine run(with_rest({"n = 0", "ON PARAM 32-67 GOSUB changed", "SET 32-67 5000"},
                        {"SUBPROG changed", "n = n + 1", "SET 1901 n", "SET 1902 (GET POSERR)", "RETURN"}));
  run.run(10);
  EXPECT_EQ(run["P1901"], 0) << "a program has set it";
  EXPECT_EQ(run["POSERR"], 5000);
  run.write("POSERR", 4000);
  run.run(3);
  EXPECT_EQ(run["P1901"], 1);
  EXPECT_EQ(run["P1902"], 4000);
  run.run(100);
  EXPECT_EQ(run["POSERR"], 4000);
  EXPECT_THROW(run.write("POSERR", -1.0), std::domain_error) << "its printed range";
  EXPECT_THROW(run.write("P34_50", 1.0), std::out_of_range) << "a read-out";
}

TEST(Panel, LeavesAsItWasWhatNothingCanBeComputedWith) {
  Machine run(with_rest({"SET 1900 1"}));
  run.run(10);
  run.write("SYNCFACTM", 0.0);
  run.run(3);
  EXPECT_EQ(run["SYNCFACTM"], 1);
}

TEST(Panel, TakesEffectInTheAxis) {
  Machine run(with_rest({"VEL 100", "ACC 100", "DEC 100", "DELAY 20", "POSA 20000"}));
  run.run(10);
  run.write("VELMAX", 300.0);
  run.run(1500);
  EXPECT_LE(run["AVEL"], 10'001) << "a tenth of before";
  EXPECT_GT(run["AVEL"], 5000);
}

TEST(Panel, KeysAreReadByInkey) {
  Machine run(with_rest({"SET 1901 (INKEY (-1))", "SET 1902 (INKEY 5)", "SET 1903 (INKEY 0)"}));
  run.run(100);
  EXPECT_EQ(run["P1901"], -1);
  EXPECT_EQ(run["P1902"], -1);
  EXPECT_EQ(run["P1903"], 0) << "it waits";
  run.write("Keys", 16.0);
  run.run(3);
  EXPECT_EQ(run["P1903"], 16);
}

TEST(ReadOuts, StandUnderTheirNumbers) {
  Machine run(with_rest({"VEL 100", "ACC 100", "DEC 100", "CVEL 40", "CSTART", "OUT 3 1", "PULSACC 100000",
                         "PULSVEL 4000", "DELAY 200", "SET 1901 (GET 34-61)", "SET 1902 AXEND",
                         "SET 1903 (GET 34-62)", "SET 1904 STAT"}));
  run.run(300);
  EXPECT_NE(run["APOS"], 0);
  for (const auto& [number, name] : std::vector<std::pair<std::string, std::string>>{{"50", "APOS"},
                                                                                     {"51", "CPOS"},
                                                                                     {"52", "MAPOS"},
                                                                                     {"53", "IPOS"},
                                                                                     {"54", "MIPOS"},
                                                                                     {"55", "CURVEPOS"},
                                                                                     {"56", "TRACKERR"},
                                                                                     {"57", "SYNCERR"},
                                                                                     {"58", "AVEL"},
                                                                                     {"59", "MAVEL"},
                                                                                     {"60", "SYNCSTAT"},
                                                                                     {"61", "AXEND"},
                                                                                     {"62", "STAT"}})
    EXPECT_EQ(run["P34_" + number], run[name]) << name;
  EXPECT_NE(run["MAPOS"], 0);
  EXPECT_EQ(run["P34_41"], 4) << "output 3";
  EXPECT_EQ(run["P1901"], run["P1902"]);
  EXPECT_EQ(run["P1903"], run["P1904"]);
}

TEST(Linksysvar, ShowsEachOfFiveVariablesWithin200Milliseconds) {
  Texts lines = {"VEL 100", "ACC 100", "CVEL 20", "CSTART"};
  for (int i = 0; i < 5; ++i) lines.push_back("LINKSYSVAR 22 " + std::to_string(1990 + i) + " \"time\"");
  Machine run(with_rest(lines));
  run.run(500);
  for (int step = 0; step < 300; ++step) {
    run.run(1);
    const double now =
        static_cast<double>(std::chrono::duration_cast<milliseconds>(run.machine.now()).count());
    for (int i = 0; i < 5; ++i) {
      const double shown = run["P" + std::to_string(1990 + i)];
      ASSERT_LE(now - shown, 202.0) << i;
      ASSERT_GE(now - shown, 0.0) << i;
    }
  }
  Machine wrong(with_rest({"LINKSYSVAR 22 2000 \"time\""}));
  wrong.run(5);
  EXPECT_EQ(wrong["ERRNO"], 155);
}

TEST(AnalogTerminals, AreTagsInVoltAndMilliampere) {
  Machine run(with_rest({"DELAY 10", "SET 1901 (INAD 53)", "SET 1902 (INAD 54)", "OUTDA 42 50000",
                         "SET 1903 (GETVLT 16-62)", "SET 1904 (GETVLT 16-65)"}));
  run.machine.write("trim", -2.5);
  run.run(20);
  EXPECT_EQ(run["P1901"], -250);
  EXPECT_EQ(run["P1902"], 0) << "no tag";
  EXPECT_EQ(run.machine.read("meter"), 10.0);
  EXPECT_EQ(run["P1903"], -2500);
  EXPECT_EQ(run["P1904"], 10'000);
  for (const char* const line : {"x = INAD 55", "OUTDA 43 1"}) {
    Machine wrong(with_rest({line}));
    wrong.run(5);
    EXPECT_EQ(wrong["ERRNO"], 171) << line;
  }
}

Json with_drive(Json project) {
  project["technology_objects"]["Teddy"]["drive"] = {{"model", "simulated"}, {"time_constant", "3ms"}};
  project["technology_objects"]["Teddy"]["parameters"]["FFVEL"] = 10'486;
  project["technology_objects"]["Teddy"]["parameters"]["KPROP"] = 1;
  project["technology_objects"]["Teddy"]["parameters"]["KDER"] = 0;
  project["technology_objects"]["Teddy"]["parameters"]["POSERR"] = 10'000'000;
  return project;
}

// With the precontrol alone the motor turns as fast as the reference says, of its maximum.
TEST(DriveParameters, ScaleAndLimitTheReference) {
  const Texts runs = {"VEL 100", "ACC 100", "DEC 100", "CVEL 50", "CSTART"};
  const auto speed = [&](const Texts& before) {
    Texts lines = before;
    lines.insert(lines.end(), runs.begin(), runs.end());
    lines.insert(lines.end(),
                 {"DELAY 1000", "SET 1901 (GETVLT 16-17)", "SET 1902 (GETVLT 3-03)",
                  "SET 1903 (GETVLT 16-05)", "SET 1904 (SYSVAR[32])", "SET 1905 (GETVLT 16-02)"});
    Machine run(with_drive(project_with(with_rest(lines))));
    run.run(1100);
    EXPECT_EQ(run["ERRNO"], 0);
    EXPECT_EQ(run["P1903"], run["P1904"]);
    return std::array{run["P1901"], run["P1902"], run["P1903"], run["P1905"]};
  };
  const auto usual = speed({});
  EXPECT_NEAR(usual[0], 1500, 25);
  EXPECT_EQ(usual[1], 3'000'000) << "VELMAX, in 1/1000";
  EXPECT_NEAR(usual[2], 5000, 80);
  EXPECT_NEAR(usual[3], 500, 8);
  const auto half = speed({"SETVLT 3-03 1500000"});
  EXPECT_NEAR(half[0], 1500 * half[3] / 1000.0, 25) << "of half as much";
  EXPECT_EQ(half[1], 1'500'000);
  const auto limited = speed({"SETVLT 4-13 600"});
  EXPECT_NEAR(limited[0], 600, 5);
}

// A motor of four poles, 400 V at 50 Hz: its current is what magnetizes it and, across to that, its torque.
TEST(DriveParameters, TellVoltageFrequencyAndCurrentOfTheMotor) {
  Json project = with_drive(project_with(with_rest(
      {"VEL 100", "ACC 100", "DEC 100", "CVEL 50", "CSTART", "DELAY 1500", "SET 1901 (GETVLT 16-17)",
       "SET 1902 (SYSVAR[34])", "SET 1903 (SYSVAR[30])", "SET 1904 (SYSVAR[28])", "SET 1905 (SYSVAR[35])",
       "SET 1906 (GETVLT 16-12)", "SET 1907 (GETVLT 16-13)", "SET 1908 (GETVLT 16-14)", "MOTOR OFF",
       "DELAY 1000", "SET 1909 (SYSVAR[28])", "SET 1910 (SYSVAR[30])"})));
  project["technology_objects"]["Teddy"]["drive"]["plant"] = {{"inertia", 0.002}, {"load_torque", -10.0}};
  Machine run(project);
  run.run(3000);
  EXPECT_EQ(run["ERRNO"], 0);
  const double speed = run["P1901"];
  EXPECT_NEAR(speed, 1500, 60);
  EXPECT_NEAR(run["P1902"], speed / 60.0 * 2.0 * 10.0, 1.0) << "1/10 Hz";
  EXPECT_NEAR(run["P1903"], std::min(speed / 60.0 * 2.0 * 8.0, 400.0) * 10.0, 10.0) << "1/10 V";
  EXPECT_NEAR(run["P1905"], 100, 2) << "the motor holds the load";
  EXPECT_NEAR(run["P1904"], std::sqrt(10.0) * 100.0, 5) << "1/100 A";
  EXPECT_EQ(run["P1906"], run["P1903"]);
  EXPECT_EQ(run["P1907"], run["P1902"]);
  EXPECT_EQ(run["P1908"], run["P1904"]);
  EXPECT_EQ(run["P1909"], 0);
  EXPECT_EQ(run["P1910"], 0);
}

TEST(DriveParameters, OfAnotherNumberAreError112) {
  for (const char* const line : {"x = GETVLT 1-24", "SETVLT 4-13 60001", "SETVLT 16-17 1",
                                 "x = GETVLTSUB 5-40 0", "SETVLTSUB 0-25 1 100"}) {
    Machine run(with_rest({line}));
    run.run(5);
    EXPECT_EQ(run["ERRNO"], 112) << line;
  }
  for (const mco305::DriveParameter& one : mco305::drive_parameters()) {
    Machine run(with_rest({"SET 1901 (GETVLT " + std::to_string(one.number) + ")"}));
    run.run(5);
    EXPECT_EQ(run["ERRNO"], 0) << one.number;
  }
}

TEST(Swapmenc, TurnsTwoMotorsInTurnAndLosesNoCount) {
  Machine run(
      with_rest({"VEL 100", "ACC 100", "DEC 100", "POSA 3000", "MOTOR OFF", "SWAPMENC ON", "SET 1901 APOS",
                 "SET 1902 MAPOS", "MOTOR ON", "POSA 10000", "MOTOR OFF", "SWAPMENC OFF", "SET 1903 APOS",
                 "SET 1904 MAPOS", "MOTOR ON", "POSA 4000", "SET 1905 APOS", "SET 1906 MAPOS"}));
  run.run(3000);
  EXPECT_EQ(run["ERRNO"], 0);
  EXPECT_EQ(run["P1901"], 0);
  EXPECT_EQ(run["P1902"], 3000);
  EXPECT_EQ(run["P1903"], 3000);
  EXPECT_EQ(run["P1904"], 10'000);
  EXPECT_EQ(run["P1905"], 4000);
  EXPECT_EQ(run["P1906"], 10'000);
}

Json map_of(const Json& lines) {
  Json project = project_with({"x = 1"});
  project["modbus"] = {{"server", {{"listen", "127.0.0.1:0"}}}, {"map", lines}};
  return project;
}

TEST(ModbusContent, HasParametersByTheirNumbers) {
  const LoadedProject loaded = load_project(
      map_of(Json::parse(R"([ { "object": "Teddy", "content": "parameters", "address": 0 } ])")).dump());
  ASSERT_TRUE(loaded.project);
  const ModbusMap& map = loaded.project->modbus.maps.at(0).map;
  EXPECT_EQ(map.entries().size(), mco305::kParameterCount);
  for (const mco305::Parameter& of : mco305::parameters()) {
    const auto address = static_cast<std::uint32_t>(10 * of.number);
    const ModbusEntry* const entry = map.find(ModbusTable::holding_register, address);
    ASSERT_NE(entry, nullptr) << of.number;
    EXPECT_EQ(modbus_span(*entry), 2u);
    EXPECT_EQ(map.find(ModbusTable::holding_register, address + 2), nullptr);
    EXPECT_EQ(entry->writable, of.number < 3400) << of.number;
  }
  EXPECT_NE(map.find(ModbusTable::holding_register, 19'000), nullptr);
  EXPECT_NE(map.find(ModbusTable::holding_register, 19'990), nullptr);
  EXPECT_EQ(map.find(ModbusTable::holding_register, 0), nullptr) << "everything else is exception 2";
}

TEST(ModbusContent, HasProcessDataAsTenWordsEachWay) {
  const LoadedProject loaded = load_project(
      map_of(Json::parse(R"([ { "object": "Teddy", "content": "pcd", "address": 100 } ])")).dump());
  ASSERT_TRUE(loaded.project);
  const ModbusMap& map = loaded.project->modbus.maps.at(0).map;
  for (std::uint32_t i = 100; i < 110; ++i) {
    ASSERT_NE(map.find(ModbusTable::holding_register, i), nullptr);
    EXPECT_TRUE(map.find(ModbusTable::holding_register, i)->writable);
    ASSERT_NE(map.find(ModbusTable::input_register, i), nullptr);
    EXPECT_FALSE(map.find(ModbusTable::input_register, i)->writable);
  }
  EXPECT_EQ(map.find(ModbusTable::holding_register, 110), nullptr);
  EXPECT_EQ(loaded.project->modbus.signal_of(*map.find(ModbusTable::holding_register, 102)).name,
            "Teddy.PcdIn[3]");
  EXPECT_EQ(loaded.project->modbus.signal_of(*map.find(ModbusTable::input_register, 102)).name,
            "Teddy.PcdOut[3]");
}

TEST(ModbusContent, SaysWhatIsWrongWithALine) {
  const auto problem = [](const char* line) {
    const LoadedProject loaded = load_project(map_of(Json::array({Json::parse(line)})).dump());
    EXPECT_FALSE(loaded.project) << line;
    std::string all;
    for (const Problem& one : loaded.problems) all += one.text + "\n";
    return all;
  };
  EXPECT_NE(
      problem(R"({ "object": "Teddy", "content": "parameters", "address": 40000 })").find("allowed: up to"),
      std::string::npos);
  EXPECT_NE(problem(R"({ "object": "Teddy", "address": 0 })").find("'content' is missing"),
            std::string::npos);
  EXPECT_NE(
      problem(R"({ "object": "Teddy", "content": "pcd", "address": 0, "scale": 2 })").find("no 'scale'"),
      std::string::npos);
  EXPECT_NE(problem(R"({ "tag": "trim", "address": 0 })").find("'table' is missing"), std::string::npos);
  EXPECT_NE(problem(R"({ "address": 0 })").find("'object' with 'content'"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::device_outside_test
