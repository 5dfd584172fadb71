// A loaded project is wired as it is written.
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "changed_project.hpp"
#include "projects/json/addresses.hpp"
#include "projects/json/text_file.hpp"
#include "projects/loader/project.hpp"
#include "tests/support/directory.hpp"
#include "tests/support/values.hpp"

namespace lockstep::project_wiring_test {
namespace {

using test::integer;
using test::real;

Project load(std::string_view text) {
  LoadedProject loaded = load_project(text);
  EXPECT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  return loaded.project ? std::move(*loaded.project) : Project{};
}

Value value_of(const Project& project, std::string_view path) {
  const FoundOperand found = project.names.find(path);
  EXPECT_TRUE(found.place.has_value()) << found.problem;
  return found.place ? found.place->signal.load() : Value{};
}

void store(const Project& project, std::string_view path, Value value) {
  const FoundOperand found = project.names.find(path);
  ASSERT_TRUE(found.place.has_value()) << found.problem;
  found.place->signal.store(value);
}

void run(const Project& project, std::int64_t now = 0) {
  EvaluationCounters counters;
  for (const Program& program : project.controller->programs) program.run(now, counters);
}

/// A project with some tags and the calls of one Main program.
std::string with_calls(const std::string& calls) {
  return R"({"lockstep": 1, "name": "test", "clock": {"servo_cycle": "1ms"},
             "technology_objects": {"A": {"type": "TO_SynchronousAxis", "config": {"VirtualAxis": {"Mode": 1}}}},
             "tags": {"b": {"type": "BOOL"}, "i": {"type": "INT"}, "x": {"type": "LREAL", "init": 1.5},
                      "w": {"type": "WORD"}, "t": {"type": "TIME"}},
             "programs": [{"name": "Main", "ob": "Main", "cycle": "1ms", "calls": [)" +
         calls + "]}]}";
}

TEST(ExampleProject, LoadsWithoutProblemsOrWarnings) {
  const LoadedProject loaded = load_project(kExampleProject);
  EXPECT_EQ(lines(loaded.problems), "");
  EXPECT_EQ(lines(loaded.warnings), "");
  EXPECT_TRUE(loaded.project.has_value());
}

TEST(ExampleProject, HasItsClockAndItsAxes) {
  const Project project = load(kExampleProject);
  const Controller& controller = *project.controller;
  EXPECT_EQ(project.name, "rotary_knife");
  EXPECT_EQ(project.description, "A knife drum geared to a conveyor.");
  EXPECT_FALSE(project.stop_on_overrun);
  EXPECT_EQ(controller.clock.servo_cycle, 1'000'000);
  EXPECT_EQ(controller.clock.interpolator_ratio, 2);
  ASSERT_EQ(controller.axes.size(), 2u);
  const Axis& conveyor = *controller.axes[0];
  const Axis& knife = *controller.axes[1];
  EXPECT_EQ(conveyor.name, "Conveyor");
  EXPECT_EQ(conveyor.kind, ObjectKind::TO_PositioningAxis);
  EXPECT_EQ(conveyor.number, static_cast<DB_ANY>(1));
  EXPECT_TRUE(conveyor.is_virtual());
  EXPECT_EQ(conveyor.data.DynamicDefaults.Jerk, 10000.0);
  EXPECT_EQ(knife.number, static_cast<DB_ANY>(2));
  EXPECT_EQ(knife.data.Properties.MotionType, 1);
  EXPECT_TRUE(knife.data.Modulo.Enable);
  EXPECT_EQ(knife.drive_settings.time_constant, 0.002);
  EXPECT_EQ(knife.drive_settings.dead_time, 0.001);
  ASSERT_EQ(knife.leading_values.size(), 1u);
  EXPECT_EQ(knife.leading_values[0].source, &conveyor);
  EXPECT_EQ(knife.leading_values[0].coupling, Coupling::setpoint);
}

TEST(ExampleProject, StoresConstantPinsOnceAndObjectsByTheirAddress) {
  const Project project = load(kExampleProject);
  EXPECT_EQ(value_of(project, "gear.RatioNumerator").i, 3);
  EXPECT_EQ(value_of(project, "gear.MasterSyncPosition").r, 300.0);
  EXPECT_EQ(value_of(project, "power_c.Enable").u, 1u);
  EXPECT_EQ(value_of(project, "gear.Velocity").r, -1.0) << "a pin that is not given keeps its default";
  const Instance& gear = project.controller->instances[4];
  ASSERT_EQ(gear.name, "gear");
  const auto object = [&](std::string_view pin) {
    return std::bit_cast<const Axis*>(gear.type->find_pin(pin)->signal(*gear.block).load().u);
  };
  EXPECT_EQ(object("Master"), project.controller->axes[0]);
  EXPECT_EQ(object("Slave"), project.controller->axes[1]);
}

TEST(ExampleProject, MovesExpressionsToPinsAndOutputsToTags) {
  const Project project = load(kExampleProject);
  store(project, "start", integer(1));
  store(project, "speed", real(123.0));
  store(project, "power_c.Status", integer(1));
  store(project, "gear.InSync", integer(1));
  run(project);
  EXPECT_EQ(value_of(project, "run.Velocity").r, 123.0);
  EXPECT_EQ(value_of(project, "gear.Execute").u, 0u) << "home_k.Done is FALSE";
}

TEST(ExampleProject, HasItsStimuliItsMapAndItsTrace) {
  const Project project = load(kExampleProject);
  ASSERT_EQ(project.controller->stimuli.size(), 1u);
  EXPECT_EQ(project.controller->stimuli[0].at, 500'000'000);
  EXPECT_EQ(project.controller->stimuli[0].place.address, project.controller->tags[0].signal.address);
  EXPECT_EQ(project.controller->stimuli[0].value.u, 1u);
  ASSERT_EQ(project.modbus.servers.size(), 1u);
  EXPECT_EQ(project.modbus.servers[0].listen, (std::vector<Endpoint>{{"127.0.0.1", 1502}}));
  ASSERT_EQ(project.modbus.signals.size(), 4u);
  const auto& entries = project.modbus.maps[0].map.entries();
  ASSERT_EQ(entries.size(), 4u);
  EXPECT_TRUE(entries[0].writable && entries[1].writable);
  EXPECT_FALSE(entries[2].writable || entries[3].writable);
  EXPECT_EQ(entries[1].type, Type::REAL);
  EXPECT_EQ(project.modbus.signals[3].signal.address, &project.controller->axes[1]->data.ActualPosition);
  EXPECT_EQ(project.trace.url, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(project.trace.channel, "ROTARY_KNIFE");
  ASSERT_EQ(project.trace.signals.size(), 4u);
  EXPECT_EQ(project.trace.signals[0].unit, Unit::kPosition);
  EXPECT_EQ(project.trace.signals[3].signal.bit, 22);
  EXPECT_EQ(project.trace.signals[3].name, "Knife.StatusWord.X22");
}

TEST(ExampleProject, RunsToSynchronism) {
  Project project = load(kExampleProject);
  project.controller->apply_stimuli = true;
  for (int tick = 0; tick < 10'000; ++tick) project.controller->tick();
  EXPECT_EQ(value_of(project, "synced").u, 1u);
  EXPECT_EQ(value_of(project, "gear.ErrorID").u, 0u);
}

TEST(Program, RunsTheBranchThatTheConditionChooses) {
  const Project project = load(with_calls(
      R"({"if": "b", "then": [{"set": "i", "to": 1}, {"if": "x > 1.0", "then": [{"set": "w", "to": "16#FF"}]}],
                          "else": [{"set": "i", "to": "2"}]}, {"set": "t", "to": "T#5ms"})"));
  run(project);
  EXPECT_EQ(value_of(project, "i").i, 2);
  EXPECT_EQ(value_of(project, "w").u, 0u);
  EXPECT_EQ(value_of(project, "t").i, 5'000'000);
  store(project, "b", integer(1));
  run(project);
  EXPECT_EQ(value_of(project, "i").i, 1);
  EXPECT_EQ(value_of(project, "w").u, 255u);
}

/// The call is no part of the branch before it, also where that ends with copying a BOOL.
TEST(Program, CallsWhatStandsBehindABranch) {
  const Project project = load(with_calls(
      R"({"if": "x > 2.0", "then": [{"set": "b", "to": "fall.Q"}]}, {"fb": "F_TRIG", "name": "fall"})"));
  run(project);
  EXPECT_EQ(value_of(project, "fall.Q").u, 1u) << "a first call with CLK FALSE counts as a fall";
  EXPECT_EQ(value_of(project, "b").u, 0u) << "the branch is not taken";
}

TEST(Program, SetsVariablesAndBits) {
  const Project project =
      load(with_calls(R"({"set": "A.Override.Velocity", "to": "x * 20.0"}, {"set": "w.X3", "to": true})"));
  run(project);
  EXPECT_EQ(value_of(project, "A.Override.Velocity").r, 30.0);
  EXPECT_EQ(value_of(project, "w").u, 8u);
}

TEST(Program, MayNameALaterInstance) {
  const Project project = load(with_calls(
      R"({"set": "b", "to": "later.Q"}, {"fb": "R_TRIG", "name": "later", "in": {"CLK": true}}, {"set": "w.X0", "to": "later.Q"})"));
  run(project);
  EXPECT_EQ(value_of(project, "b").u, 0u);
  EXPECT_EQ(value_of(project, "w").u, 1u);
  run(project);
  EXPECT_EQ(value_of(project, "b").u, 1u);
  EXPECT_EQ(value_of(project, "w").u, 0u);
}

TEST(Names, AreFoundInAnyCase) {
  const Project project = load(kExampleProject);
  EXPECT_TRUE(project.names.find("KNIFE.statusword.x22").place.has_value());
  EXPECT_TRUE(project.names.find("Gear.insync").place.has_value());
  EXPECT_TRUE(project.names.find("SPEED").place.has_value());
}

TEST(Tags, TakeTheirStartValues) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"}, "tags": {
          "a": {"type": "BOOL", "init": true}, "b": {"type": "SINT", "init": -128}, "c": {"type": "ULINT", "init": 18446744073709551615},
          "d": {"type": "WORD", "init": "16#ABCD"}, "e": {"type": "REAL", "init": 0.1}, "f": {"type": "TIME", "init": "1.5s"},
          "g": {"type": "LINT", "init": -9223372036854775808}, "h": {"type": "TIME", "init": "T#-5ms"},
          "k": {"type": "LREAL", "init": 2, "retain": true, "comment": "kept"}, "l": {"type": "DINT", "init": 3e2}}})");
  EXPECT_EQ(value_of(project, "a").u, 1u);
  EXPECT_EQ(value_of(project, "b").i, -128);
  EXPECT_EQ(value_of(project, "c").u, 18446744073709551615u);
  EXPECT_EQ(value_of(project, "d").u, 0xABCDu);
  EXPECT_EQ(value_of(project, "e").r, static_cast<double>(0.1F));
  EXPECT_EQ(value_of(project, "f").i, 1'500'000'000);
  EXPECT_EQ(value_of(project, "g").i, INT64_MIN);
  EXPECT_EQ(value_of(project, "h").i, -5'000'000);
  EXPECT_EQ(value_of(project, "k").r, 2.0);
  EXPECT_EQ(value_of(project, "l").i, 300);
  EXPECT_TRUE(project.controller->tags[8].retain);
  EXPECT_EQ(project.controller->tags[8].comment, "kept");
}

TEST(Configuration, ReachesArrayElementsAndTags) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"}, "tags": {"limit": {"type": "BOOL"}},
          "technology_objects": {"A": {"type": "TO_PositioningAxis", "drive": {"model": "simulated", "encoder_resolution": 0.001},
            "config": {"Sensor[2]": {"Parameter": {"Resolution": 0.25}}, "PositionLimits_HW": {"MinSwitchAddress": "limit"},
                       "CrossPlcSynchronousOperation": {"Interface[8]": {"EnableLeadingValueOutput": true}}}}}})");
  const Axis& axis = *project.controller->axes[0];
  EXPECT_EQ(axis.data.Sensor[1].Parameter.Resolution, 0.25);
  EXPECT_EQ(axis.data.Sensor[0].Parameter.Resolution, 0.001);
  EXPECT_EQ(axis.data.PositionLimits_HW.MinSwitchAddress, project.controller->tags[0].signal.address);
  EXPECT_TRUE(axis.data.CrossPlcSynchronousOperation.Interface[7].EnableLeadingValueOutput);
  EXPECT_EQ(axis.drive_settings.resolution, 0.001);
}

TEST(Drive, TakesTheMarksAndSwitchesOfItsMachine) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"}, "tags": {"door": {"type": "BOOL"}},
          "technology_objects": {"A": {"type": "TO_PositioningAxis", "drive": {"model": "simulated", "start_position": 40.5,
            "zero_marks": {"position": 3, "period": 10.0}, "reference_cam": [100, 120], "limit_switches": {"min": -200, "max": 400},
            "digital_inputs": [{"tag": "door", "range": [-1, 1]}]}}}})");
  const MachineSignals& signals = project.controller->axes[0]->drive_settings.signals;
  EXPECT_EQ(signals.start_position, 40.5);
  ASSERT_TRUE(signals.zero_marks && signals.reference_cam);
  EXPECT_EQ(signals.zero_marks->position, 3.0);
  EXPECT_EQ(signals.zero_marks->period, 10.0);
  EXPECT_EQ(signals.reference_cam->from, 100.0);
  EXPECT_EQ(signals.reference_cam->to, 120.0);
  EXPECT_EQ(signals.limit_min, -200.0);
  EXPECT_EQ(signals.limit_max, 400.0);
  ASSERT_EQ(signals.digital_inputs.size(), 1u);
  EXPECT_EQ(signals.digital_inputs[0].tag, project.controller->tags[0].signal.address);
  EXPECT_EQ(signals.digital_inputs[0].range.from, -1.0);
}

TEST(Drive, TakesWhatItMovesAndWhatGoesWrong) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"}, "tags": {"f": {"type": "BOOL"}, "g": {"type": "BOOL"}},
          "technology_objects": {"A": {"type": "TO_PositioningAxis", "drive": {"model": "simulated", "quick_stop_deceleration": 500,
            "plant": {"inertia": 0.5, "friction": 1, "load_torque": -2, "maximum_torque": 30,
                      "fixed_stop": {"position": -7.5, "stiffness": 400, "direction": "negative"}},
            "faults": {"drive": "f", "blocked": "g"}}}}})");
  const DriveSettings& drive = project.controller->axes[0]->drive_settings;
  EXPECT_EQ(drive.quick_stop, 500.0);
  EXPECT_EQ(drive.plant.inertia, 0.5);
  EXPECT_EQ(drive.plant.friction, 1.0);
  EXPECT_EQ(drive.plant.load_torque, -2.0);
  EXPECT_EQ(drive.plant.maximum_torque, 30.0);
  ASSERT_TRUE(drive.plant.has_stop);
  EXPECT_EQ(drive.plant.stop.position, -7.5);
  EXPECT_EQ(drive.plant.stop.side, -1);
  EXPECT_EQ(drive.plant.stop.stiffness, 400.0);
  EXPECT_EQ(drive.faults.drive, project.controller->tags[0].signal.address);
  EXPECT_EQ(drive.faults.blocked, project.controller->tags[1].signal.address);
  EXPECT_EQ(drive.faults.encoder, nullptr);
}

TEST(ModbusMapping, WritesAVariableOnlyIfTheEntryAsksForIt) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"},
          "technology_objects": {"A": {"type": "TO_PositioningAxis", "config": {"VirtualAxis": {"Mode": 1}}}},
          "tags": {"x": {"type": "LREAL"}},
          "modbus": {"map": [
            {"tag": "A.Override.Velocity", "table": "holding_register", "address": 0},
            {"tag": "A.Override.Velocity", "table": "holding_register", "address": 10, "access": "write"},
            {"tag": "x", "table": "holding_register", "address": 20, "access": "read", "word_order": "little"}]}})");
  const auto& entries = project.modbus.maps[0].map.entries();
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_FALSE(entries[0].writable);
  EXPECT_TRUE(entries[1].writable);
  EXPECT_EQ(entries[1].range.highest, 200.0);
  EXPECT_FALSE(entries[2].writable);
  EXPECT_EQ(entries[2].word_order, WordOrder::little);
  EXPECT_TRUE(project.modbus.servers.empty());
}

TEST(ModbusMapping, ServersAndUnitsMayHaveMapsOfTheirOwn) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"},
          "tags": {"x": {"type": "LREAL"}, "flag": {"type": "BOOL"}},
          "modbus": {
            "server": [
              {"listen": ["127.0.0.1:1", "[::1]:1"], "allow": ["127.0.0.0/8", "::1"], "max_clients": 3,
               "max_requests_per_second": 100, "idle_timeout": "2s"},
              {"listen": "127.0.0.1:2", "map": [{"tag": "flag", "table": "coil", "address": 7}]}],
            "map": [
              {"tag": "x", "table": "holding_register", "address": 0, "type": "INT", "scale": 0.1, "offset": 5},
              {"tag": "flag", "table": "holding_register", "address": 9, "bit": 3, "byte_order": "little"},
              {"diagnostic": "overruns", "table": "input_register", "address": 0, "type": "UDINT"},
              {"diagnostic": "not_allowed", "table": "input_register", "address": 2, "type": "UINT"}],
            "units": [{"unit": 9, "map": [{"tag": "flag", "table": "coil", "address": 1}]}]}})");
  const ModbusConfig& modbus = project.modbus;
  ASSERT_EQ(modbus.servers.size(), 2u);
  EXPECT_EQ(modbus.servers[0].listen, (std::vector<Endpoint>{{"127.0.0.1", 1}, {"::1", 1}}));
  EXPECT_EQ(modbus.servers[0].allow.size(), 2u);
  EXPECT_EQ(modbus.servers[0].max_clients, 3u);
  EXPECT_EQ(modbus.servers[0].requests_per_second, 100u);
  EXPECT_EQ(modbus.servers[0].idle_limit, std::chrono::seconds(2));
  const ModbusUnits first = modbus.units_of(0);
  const ModbusEntry& scaled = *first.of(1).find(ModbusTable::holding_register, 0);
  EXPECT_TRUE(scaled.is_scaled && scaled.scale == 0.1 && scaled.offset == 5.0 && scaled.writable);
  const ModbusEntry& bit = *first.of(1).find(ModbusTable::holding_register, 9);
  EXPECT_EQ(modbus_bit(bit), 1u << 11);
  const ModbusEntry& overruns = *first.of(1).find(ModbusTable::input_register, 0);
  EXPECT_EQ(modbus.signal_of(overruns).name, "diagnostic.overruns");
  EXPECT_EQ(modbus.signal_of(*first.of(1).find(ModbusTable::input_register, 2)).name,
            "diagnostic.not_allowed");
  EXPECT_NE(first.of(9).find(ModbusTable::coil, 1), nullptr);
  EXPECT_EQ(first.of(1).find(ModbusTable::coil, 1), nullptr);
  const ModbusUnits second = modbus.units_of(1);
  EXPECT_NE(second.of(9).find(ModbusTable::coil, 7), nullptr) << "its own map";
  EXPECT_EQ(second.of(9).find(ModbusTable::coil, 1), nullptr);
  EXPECT_EQ(second.of(1).find(ModbusTable::holding_register, 0), nullptr);
}

TEST(ModbusMapping, LinesAndClientsAreReadAsTheyStand) {
  const Project project = load(
      R"({"lockstep": 1, "name": "t", "clock": {"servo_cycle": "1ms"},
          "tags": {"power": {"type": "LREAL"}, "limit": {"type": "INT"}, "good": {"type": "BOOL"},
                   "age": {"type": "TIME"}},
          "modbus": {
            "server": {"serial": {"device": "/dev/ttyS1", "baud": 9600, "parity": "none", "stop_bits": 2,
                                  "silence": "5ms"}, "unit": 12},
            "clients": [{"connect": "[::1]:502", "timeout": "250ms", "devices": [
              {"name": "meter", "unit": 3, "cycle": "20ms", "quality": "good", "age": "age",
               "read": [{"tag": "power", "table": "input_register", "address": 7, "type": "DINT", "scale": 0.1}],
               "write": [{"tag": "limit", "table": "holding_register", "address": 9}]}]}]}})");
  const ModbusServerOptions& server = project.modbus.servers.at(0);
  ASSERT_TRUE(server.serial.has_value());
  EXPECT_EQ(server.serial->device, "/dev/ttyS1");
  EXPECT_EQ(server.serial->baud, 9600);
  EXPECT_EQ(server.serial->parity, Parity::none);
  EXPECT_EQ(server.serial->stop_bits, 2);
  EXPECT_EQ(server.serial->silence, std::chrono::milliseconds(5));
  EXPECT_EQ(server.serial_unit, 12);
  const ModbusClientConfig& client = project.modbus.clients.at(0);
  EXPECT_EQ(client.options.endpoint(), "[::1]:502");
  EXPECT_EQ(client.options.timeout, std::chrono::milliseconds(250));
  const ModbusDevice& device = client.options.devices.at(0);
  EXPECT_EQ(device.unit, 3);
  EXPECT_EQ(device.cycle, std::chrono::milliseconds(20));
  EXPECT_EQ(client.signals.at(device.quality.value()).name, "good");
  EXPECT_EQ(client.signals.at(device.age.value()).name, "age");
  EXPECT_EQ(client.signals.at(device.reads.at(0).signal).name, "power");
  EXPECT_TRUE(device.reads[0].is_scaled && device.reads[0].type == Type::DINT);
  EXPECT_EQ(client.signals.at(device.writes.at(0).signal).name, "limit");
}

TEST(LoadProjectFile, ReadsAFileAndTellsWhenItCannot) {
  const std::string path = testing::TempDir() + "lockstep_project.json";
  std::ofstream(path) << kExampleProject;
  EXPECT_TRUE(load_project_file(path).project.has_value());
  std::remove(path.c_str());
  EXPECT_THROW(load_project_file(path), UnreadableFile);
  EXPECT_THROW(load_project_file(testing::TempDir()), UnreadableFile);
}

TEST(LoadProjectFile, StopsReadingWhatIsTooLong) {
  EXPECT_THROW(load_project_file("/dev/zero"), UnreadableFile) << "which has no end";
  const test::Directory folder;
  const std::string file = folder.write("long.json", "{}");
  std::filesystem::resize_file(file, std::uintmax_t{64} << 20);
  const LoadedProject loaded = load_project_file(file);
  ASSERT_EQ(loaded.problems.size(), 1u);
  EXPECT_NE(loaded.problems[0].text.find("16 MiB"), std::string::npos);
}

TEST(LoadProject, LoadsAThousandAxesInTime) {
  std::string objects, calls;
  for (int i = 0; i < 1000; ++i) {
    const std::string n = std::to_string(i);
    const std::string comma = i == 0 ? "" : ",";
    objects +=
        comma + R"("Axis)" + n + R"(": {"type": "TO_SynchronousAxis", "config": {"VirtualAxis": {"Mode": 1},
      "Modulo": {"Enable": true, "Length": 360.0}, "DynamicDefaults": {"Velocity": 10.0, "Jerk": 0}}, "leading_values": [{"to": "axis0"}]})";
    if (i == 0) objects.replace(objects.find(R"(, "leading_values")"), std::string::npos, "}");
    calls += comma + R"({"fb": "MC_Power", "name": "power)" + n + R"(", "in": {"Axis": "Axis)" + n +
             R"(", "Enable": "power)" + std::to_string((i + 1) % 1000) +
             R"(.Status AND Axis0.Position >= 0.0"}})";
  }
  const std::string text =
      R"({"lockstep": 1, "name": "big", "clock": {"servo_cycle": "1ms"}, "technology_objects": {)" + objects +
      R"(}, "programs": [{"name": "Main", "ob": "Main", "cycle": "1ms", "calls": [)" + calls + "]}]}";
  const auto start = std::chrono::steady_clock::now();
  const Project project = load(text);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(project.controller->axes.size(), 1000u);
  EXPECT_EQ(project.controller->instances.size(), 1000u);
  EXPECT_LT(time.count(), 5.0) << "takes some 50 ms; a quadratic look-up would take much longer";
  RecordProperty("seconds", std::to_string(time.count()));
  std::printf("loaded 1000 axes in %.3f s\n", time.count());
}

TEST(Endpoint, IsAHostAndAPort) {
  std::string problem;
  EXPECT_EQ(parse_endpoint("127.0.0.1:1502", problem), (Endpoint{"127.0.0.1", 1502}));
  EXPECT_EQ(parse_endpoint("plc-1.local:0", problem), (Endpoint{"plc-1.local", 0}));
  EXPECT_EQ(parse_endpoint("[::1]:502", problem), (Endpoint{"::1", 502}));
  for (const char* wrong :
       {"", ":", "localhost", ":502", "host:", "host:65536", "host:-1", "host: 1", "a b:1", "[::1]",
        "::1:502", "[127.0.0.1]:1", "[::1/64]:1", "host:0x10", "http://host:1"}) {
    problem.clear();
    EXPECT_FALSE(parse_endpoint(wrong, problem).has_value()) << wrong;
    EXPECT_NE(problem.find("allowed"), std::string::npos) << wrong;
  }
}

TEST(LcmUrl, NamesAMulticastNetwork) {
  for (const char* good : {"udpm://239.255.76.67:7667?ttl=0", "udpm://", "udpm://?ttl=1", "udpm://224.0.0.1",
                           "udpm://239.1.1.1:1", "memq://"})
    EXPECT_EQ(lcm_url_problem(good), "") << good;
  for (const char* wrong : {"", "239.255.76.67:7667", "tcpq://", "udpm://10.0.0.1:7667", "udpm://239.1.1:7",
                            "udpm://239.1.1.256:7", "udpm://239.1.1.1:0", "udpm://239.1.1.1:65536",
                            "udpm://239.1.1.1?ttl=256", "udpm://239.1.1.1?x=1", "udpm://240.0.0.1"})
    EXPECT_NE(lcm_url_problem(wrong), "") << wrong;
}

// What editors refuse by the pattern of a form nobody may write.
TEST(TextForms, HaveAPatternThatRefusesNothingThatIsAllowed) {
  const char* const texts[] = {"",
                               "127.0.0.1:1502",
                               "plc-1.local:0",
                               "[::1]:502",
                               "[fe80::1]:00080",
                               "host:65535",
                               "host:65536",
                               "host:",
                               ":1",
                               "localhost",
                               "[1.2.3.4]:1",
                               "10.0.0.0/8",
                               "10.0.0.1",
                               "fd00::/8",
                               "::1",
                               "::ffff:1.2.3.4",
                               "10.0.0.0/08",
                               "10.0.0.1/8",
                               "1.2.3",
                               "memq://",
                               "udpm://",
                               "udpm://?ttl=1",
                               "udpm://224.0.0.1",
                               "tcpq://",
                               "udpm://:1",
                               "udpm://239.1.1.1:1?ttl=0",
                               "udpm://239.1.1:7",
                               "udpm://239.1.1.1?x=1"};
  int refused = 0;
  for (const TextForm* const form : {&kEndpointForm, &kNetworkForm, &kSenderForm, &kLcmUrlForm}) {
    const std::regex pattern{std::string(form->pattern)};
    for (const char* const text : texts) {
      const bool matches = std::regex_match(text, pattern);
      if (form->problem(text).empty()) {
        EXPECT_TRUE(matches) << form->what << ": " << text;
      }
      refused += matches ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 60);
}

}  // namespace
}  // namespace lockstep::project_wiring_test
