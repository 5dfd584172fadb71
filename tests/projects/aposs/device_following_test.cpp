// Devices that follow and lead in a project: axes, encoders, tags, other devices.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"

namespace lockstep::device_following_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;
using std::chrono::milliseconds;

Json device_with(const Texts& lines, const Json& more = Json::object()) {
  Json device = Json::parse(R"({ "type": "MCO_305",
    "parameters": { "ENCODER": 500, "MENCODER": 500, "VELMAX": 3000, "RAMPMIN": 0.5, "SYNCTYPE": 1 },
    "programs": [ { "number": 0, "autostart": true } ] })");
  device["programs"][0]["lines"] = lines;
  device.merge_patch(more);
  return device;
}

const Texts kFollows = {"VEL 100", "ACC 100", "DEC 100", "SYNCP", "rest:", "DELAY 1000", "GOTO rest"};
const Texts kTurns = {"PULSACC 20000", "PULSVEL 5000", "rest:", "DELAY 1000", "GOTO rest"};
const Texts kRuns = {"VEL 100", "ACC 100", "DEC 100",    "CVEL 20",
                     "CSTART",  "rest:",   "DELAY 1000", "GOTO rest"};

Json project_of(const Json& objects, const char* cycle = "1ms") {
  Json json =
      Json::parse(R"({ "lockstep": 1, "name": "following", "tags": { "counts": { "type": "DINT" } } })");
  json["clock"]["servo_cycle"] = cycle;
  json["technology_objects"] = objects;
  return json;
}

/// The largest |a · first - b · second| while both run, in the last part of a run.
double apart(Simulation& machine, const std::string& first, double a, const std::string& second, double b) {
  double largest = 0.0;
  const double before = machine.read(second);
  for (int i = 0; i < 2000; ++i) {
    machine.run_for(milliseconds(1));
    largest = std::max(largest, std::abs(a * machine.read(first) - b * machine.read(second)));
  }
  EXPECT_GT(std::abs(machine.read(second) - before), 100.0) << "nothing has moved";
  return largest;
}

TEST(DevicesInAProject, FollowEachOtherWhateverTheirOrder) {
  const Json follower = {{"master", {{"follows", "First"}}},
                         {"parameters", {{"SYNCFACTM", 3}, {"SYNCFACTS", 2}}}};
  for (const bool leader_first : {true, false}) {
    Json objects;
    if (leader_first) objects["First"] = device_with(kRuns);
    objects["Second"] = device_with(kFollows, follower);
    if (!leader_first) objects["First"] = device_with(kRuns);
    Simulation machine = Simulation::from_text(project_of(objects).dump());
    machine.run_for(milliseconds(3000));
    EXPECT_LE(apart(machine, "Second.CPOS", 3.0, "First.APOS", 2.0), 3.0) << leader_first;
    EXPECT_EQ(machine.read("Second.MAPOS"), machine.read("First.APOS"));
    EXPECT_LE(std::abs(machine.read("Second.SYNCERR")), 1.0);
  }
}

TEST(DevicesInAProject, ShareAVirtualMaster) {
  Json objects;
  objects["Packer"] = device_with({"VEL 100", "ACC 100", "DEC 100", "PULSACC 20000", "PULSVEL 5000", "SYNCP",
                                   "rest:", "DELAY 1000", "GOTO rest"});
  objects["Filler"] = device_with(kFollows, {{"master", {{"encoder_output_of", "Packer"}}},
                                             {"parameters", {{"SYNCFACTM", 2}, {"SYNCFACTS", 3}}}});
  Simulation machine = Simulation::from_text(project_of(objects).dump());
  machine.run_for(milliseconds(3000));
  EXPECT_LE(apart(machine, "Filler.CPOS", 2.0, "Packer.CPOS", 3.0), 4.0) << "within a count through all";
}

TEST(DevicesInAProject, CountATagThatWraps) {
  Json json = project_of({{"Device", device_with(kFollows, {{"master", {{"signal", "counts"}}}})}});
  Simulation machine = Simulation::from_text(json.dump());
  std::int64_t counts = 2'147'480'000;
  const auto put = [&] { machine.write("counts", static_cast<double>(static_cast<std::int32_t>(counts))); };
  put();
  machine.run_for(milliseconds(10));
  const double begin = machine.read("Device.CPOS");
  for (int i = 0; i < 1000; ++i) {
    counts += 10;
    put();
    machine.run_for(milliseconds(1));
  }
  machine.run_for(milliseconds(500));
  EXPECT_EQ(machine.read("Device.CPOS") - begin, 10'000.0);
}

TEST(DevicesInAProject, FollowAnExternalEncoder) {
  Json json = project_of(
      {{"Boxes",
        {{"type", "TO_ExternalEncoder"}, {"encoder", {{"model", "simulated"}, {"signal", "place"}}}}},
       {"Device",
        device_with(kFollows, {{"master", {{"follows", "Boxes"}, {"counts_per_unit", {2048, 55}}}}})}});
  json["tags"]["place"] = {{"type", "LREAL"}};
  Simulation machine = Simulation::from_text(json.dump());
  machine.run_for(milliseconds(50));
  const double begin = machine.read("Device.CPOS");
  double place = 0.0;
  for (int i = 0; i < 1000; ++i) {
    machine.write("place", place += 0.25);
    machine.run_for(milliseconds(1));
  }
  machine.run_for(milliseconds(1000));
  EXPECT_NEAR(machine.read("Device.MAPOS"), 250.0 * 2048.0 / 55.0, 1.0);
  EXPECT_NEAR(machine.read("Device.CPOS") - begin, 250.0 * 2048.0 / 55.0, 2.0);
}

// A proxy leads a device as the axis does whose value it brings, later by the one tick of the transfer.
TEST(DevicesInAProject, FollowALeadingAxisProxy) {
  Json json = project_of(
      {{"Belt", Json::parse(R"({ "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
          "CrossPlcSynchronousOperation": { "Interface[1]": { "EnableLeadingValueOutput": true },
                                            "LocalLeadingValueDelayTime": 0.004 },
          "DynamicDefaults": { "Velocity": 200.0, "Acceleration": 400.0, "Deceleration": 400.0, "Jerk": 4000.0 } } })")},
       {"Line", {{"type", "TO_LeadingAxisProxy"}}},
       {"Device",
        device_with(kFollows, {{"master", {{"follows", "Line"}, {"counts_per_unit", {100, 1}}}}})}});
  json["transfer_areas"] = {{"line", {{"from", "Belt"}, {"to", "Line"}}}};
  json["tags"]["go"] = {{"type", "BOOL"}};
  json["programs"] = Json::parse(R"([ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Belt", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Belt", "Execute": "go", "Velocity": 200.0 } } ] } ])");
  Simulation machine = Simulation::from_text(json.dump());
  machine.run_for(milliseconds(200));
  machine.write("go", 1.0);
  machine.run_for(milliseconds(3000));
  constexpr double kStep = 200.0 * 100.0 / 1000.0;  // [qc] of a millisecond
  EXPECT_NEAR(machine.read("Device.MAPOS"), 100.0 * machine.read("Belt.Position"), 8.0 * kStep);
  EXPECT_NEAR(machine.read("Device.CPOS"), machine.read("Device.MAPOS"), 2.0);
  const double before = machine.read("Device.CPOS"), belt = machine.read("Belt.Position");
  machine.run_for(milliseconds(1000));
  EXPECT_NEAR(machine.read("Device.CPOS") - before, 100.0 * (machine.read("Belt.Position") - belt), 2.0);
  EXPECT_GT(machine.read("Device.CPOS") - before, 19'000.0);
}

Json belt() {
  return Json::parse(R"({ "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicDefaults": { "Velocity": 200.0, "Acceleration": 400.0, "Deceleration": 400.0, "Jerk": 4000.0 } } })");
}
Json stacker(const char* coupling) {
  Json json = Json::parse(R"({ "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicDefaults": { "Velocity": 500.0, "Acceleration": 4000.0, "Deceleration": 4000.0, "Jerk": 0.0 },
    "DynamicLimits": { "MaxVelocity": 1e6, "Velocity": 1e6, "MaxAcceleration": 1e7, "MaxDeceleration": 1e7 } } })");
  json["leading_values"] = {{{"to", "Labeller"}, {"coupling", coupling}}};
  return json;
}
const char* const kPrograms = R"([ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
  { "fb": "MC_Power", "name": "power_b", "in": { "Axis": "Belt", "Enable": true } },
  { "fb": "MC_Power", "name": "power_s", "in": { "Axis": "Stacker", "Enable": true } },
  { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Belt", "Execute": "power_b.Status", "Velocity": 200.0 } },
  { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Labeller", "Slave": "Stacker", "Execute": "power_s.Status",
    "RatioNumerator": 1, "RatioDenominator": 2, "Acceleration": 100000.0, "Deceleration": 100000.0 } } ] } ])";

TEST(DevicesInAProject, DevicesLeadAxesAndFollowThem) {
  for (const char* const cycle : {"1ms", "250us"}) {
    for (const char* const coupling : {"setpoint", "actual"}) {
      Json json = project_of(
          {{"Belt", belt()},
           {"Labeller",
            device_with(kFollows, {{"master", {{"follows", "Belt"}, {"counts_per_unit", {100, 1}}}},
                                   {"parameters", {{"SYNCFACTS", 2}}}})},
           {"Stacker", stacker(coupling)}},
          cycle);
      json["programs"] = Json::parse(kPrograms);
      Simulation machine = Simulation::from_text(json.dump());
      machine.run_for(milliseconds(4000));
      EXPECT_EQ(machine.read("gear.InGear"), 1.0) << cycle << coupling;
      // 200 u/s are 20 counts a millisecond; a tick or a step late is no more than that.
      EXPECT_LE(apart(machine, "Labeller.CPOS", 1.0, "Belt.Position", 200.0), 3.0 * 40.0)
          << cycle << coupling;
      const double offset = machine.read("Stacker.Position") - 0.5 * machine.read("Labeller.CPOS");
      double before = machine.read("Stacker.Velocity");
      for (int i = 0; i < 1000; ++i) {
        machine.run_for(milliseconds(1));
        EXPECT_NEAR(machine.read("Stacker.Position") - 0.5 * machine.read("Labeller.CPOS"), offset, 45.0);
        const double velocity = machine.read("Stacker.Velocity");
        ASSERT_NEAR(velocity, before, 1000.0) << "a step of its velocity at " << i;
        before = velocity;
      }
      EXPECT_NEAR(before, 20'000.0, 500.0);
    }
  }
}

TEST(DevicesInAProject, DoNotStepWhatFollowsThemByZeroPointsAndMotorOff) {
  const Texts lines = {"VEL 100",    "ACC 100",   "DEC 100",         "CVEL 20",   "CSTART",     "DELAY 3000",
                       "DEF ORIGIN", "DELAY 500", "SET ORIGIN 5000", "DELAY 500", "MOTOR OFF",  "DELAY 1000",
                       "MOTOR ON",   "DELAY 500", "CSTART",          "rest:",     "DELAY 1000", "GOTO rest"};
  Json json = project_of(
      {{"Belt", belt()},
       {"Labeller", device_with(lines, {{"drive", {{"model", "simulated"}, {"time_constant", "3ms"}}}})},
       {"Stacker", stacker("setpoint")}});
  json["programs"] = Json::parse(kPrograms);
  Simulation machine = Simulation::from_text(json.dump());
  machine.run_for(milliseconds(2000));
  ASSERT_EQ(machine.read("gear.InGear"), 1.0);
  double before = machine.read("Stacker.Position");
  for (int i = 0; i < 6000; ++i) {
    machine.run_for(milliseconds(1));
    const double now = machine.read("Stacker.Position");
    ASSERT_LE(std::abs(now - before), 15.0) << "in millisecond " << i;
    before = now;
  }
}

struct Refused {
  const char* place;
  Json value;
  const char* told;
};
class FollowingDevice : public testing::TestWithParam<Refused> {};

TEST_P(FollowingDevice, IsRefusedWithPlaceValueAndWhatIsAllowed) {
  Json json = project_of({{"First", device_with(kRuns)},
                          {"Second", device_with(kFollows, {{"master", {{"follows", "First"}}}})},
                          {"Stacker", stacker("setpoint")},
                          {"Labeller", device_with(kTurns)}});
  ASSERT_TRUE(load_project(json.dump()).project.has_value());
  json[Json::json_pointer(GetParam().place)] = GetParam().value;
  const LoadedProject loaded = load_project(json.dump());
  EXPECT_FALSE(loaded.project.has_value());
  std::string all;
  for (const Problem& problem : loaded.problems) all += problem.place + ": " + problem.text + "\n";
  EXPECT_NE(all.find(GetParam().told), std::string::npos) << all;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, FollowingDevice,
    testing::Values(
        Refused{"/technology_objects/First/master/follows", "Second",
                "/technology_objects/First/master/follows: devices follow each other in a circle: 'First' "
                "follows 'Second', which follows 'First'; allowed: leave one of them out: 'follows' of "
                "'First', 'follows' of 'Second'"},
        Refused{"/technology_objects/Second/master/follows", "Second",
                "/technology_objects/Second/master/follows: devices follow each other in a circle: 'Second' "
                "follows 'Second'; allowed: leave it out: 'follows' of 'Second'"},
        Refused{"/technology_objects/Second/master/signal", "counts",
                "allowed is one of 'follows', 'signal'"},
        Refused{"/technology_objects/Second/master/counts_per_unit",
                {1, 2, 3},
                "allowed are two, [counts, units]"},
        Refused{"/technology_objects/Second/master/counts_per_unit", {0, 1}, "is not allowed"},
        Refused{"/technology_objects/Second/markers", {{"period", -1}}, "/markers/period"},
        Refused{"/technology_objects/Second/faults", {{"supply", "counts"}}, "a BOOL tag"},
        Refused{"/technology_objects/Stacker/leading_values/0/coupling", "delayed",
                "allowed: 'setpoint', 'actual'"}));

/// What is told of a project with objects beside a belt, one line each.
std::string told_of(const Json& objects) {
  Json json = project_of(objects);
  json["technology_objects"]["Belt"] = belt();
  std::string all;
  for (const Problem& problem : load_project(json.dump()).problems)
    all += problem.place + ": " + problem.text + "\n";
  return all;
}
Json device_behind(const char* leading, const char* key = "follows") {
  return device_with(kFollows, {{"master", {{key, leading}}}});
}
Json axis_behind(const Texts& leading) {
  Json json = stacker("setpoint");
  json["leading_values"] = Json::array();
  for (const std::string& one : leading) json["leading_values"].push_back({{"to", one}});
  return json;
}

TEST(DevicesInAProject, AreRefusedWhereAnAxisThatMayFollowThemLeadsThem) {
  const std::string told =
      "/technology_objects/Labeller/master/follows: a device leads itself through what it follows: "
      "'Labeller' follows 'Stacker', which may follow 'Labeller'; allowed: leave one of them out: "
      "'follows' of 'Labeller', 'Labeller' among the leading_values of 'Stacker'\n";
  const Json device = device_behind("Stacker"), axis = axis_behind({"Belt", "Labeller"});
  EXPECT_EQ(told_of({{"Labeller", device}, {"Stacker", axis}}), told);
  EXPECT_EQ(told_of({{"Stacker", axis}, {"Labeller", device}}), told) << "whatever their order";
}

TEST(DevicesInAProject, AreRefusedInALongCircleOfDevicesAndAxesOnce) {
  EXPECT_EQ(
      told_of({{"Stacker", axis_behind({"Belt", "Packer"})},
               {"Labeller", device_behind("Folder")},
               {"Folder", axis_behind({"Stacker"})},
               {"Filler", device_behind("Labeller")},
               {"Packer", device_behind("Filler", "encoder_output_of")}}),
      "/technology_objects/Labeller/master/follows: a device leads itself through what it follows: "
      "'Labeller' follows 'Folder', which may follow 'Stacker', which may follow 'Packer', which follows "
      "'Filler', which follows 'Labeller'; allowed: leave one of them out: 'follows' of 'Labeller', "
      "'Stacker' among the leading_values of 'Folder', 'Packer' among the leading_values of "
      "'Stacker', 'encoder_output_of' of 'Packer', 'follows' of 'Filler'\n");
}

TEST(DevicesInAProject, AreRefusedInEachOfTwoCircles) {
  const std::string told = told_of({{"First", device_behind("Stacker")},
                                    {"Second", device_behind("Folder")},
                                    {"Stacker", axis_behind({"First"})},
                                    {"Folder", axis_behind({"Stacker", "Second"})}});
  EXPECT_NE(told.find("'First' follows 'Stacker', which may follow 'First'"), std::string::npos) << told;
  EXPECT_NE(told.find("'Second' follows 'Folder', which may follow 'Second'"), std::string::npos) << told;
}

TEST(DevicesInAProject, AreRefusedInACircleOverAnEncoderAtAnAxis) {
  const Json wheel = {{"type", "TO_ExternalEncoder"},
                      {"encoder", {{"model", "simulated"}, {"follows", "Stacker"}}}};
  EXPECT_EQ(
      told_of(
          {{"Labeller", device_behind("Wheel")}, {"Wheel", wheel}, {"Stacker", axis_behind({"Labeller"})}}),
      "/technology_objects/Labeller/master/follows: a device leads itself through what it follows: "
      "'Labeller' follows 'Wheel', which sits on 'Stacker', which may follow 'Labeller'; allowed: leave "
      "one of them out: 'follows' of 'Labeller', 'follows' of 'Wheel', 'Labeller' among the "
      "leading_values of 'Stacker'\n");
}

TEST(DevicesInAProject, AreRefusedInACircleOverALeadingAxisProxy) {
  Json json = project_of({{"Line", {{"type", "TO_LeadingAxisProxy"}}},
                          {"Labeller", device_behind("Line")},
                          {"Stacker", axis_behind({"Labeller"})}});
  json["technology_objects"]["Stacker"]["config"]["CrossPlcSynchronousOperation"] = {
      {"Interface[1]", {{"EnableLeadingValueOutput", true}}}};
  json["transfer_areas"] = {{"line", {{"from", "Stacker"}, {"to", "Line"}}}};
  const LoadedProject loaded = load_project(json.dump());
  ASSERT_EQ(loaded.problems.size(), 1u);
  EXPECT_EQ(loaded.problems[0].text,
            "a device leads itself through what it follows: 'Labeller' follows 'Line', which has the value "
            "of 'Stacker', which may follow 'Labeller'; allowed: leave one of them out: 'follows' of "
            "'Labeller', the transfer area 'line', 'Labeller' among the leading_values of 'Stacker'");
}

// Whether axes follow each other is decided by the jobs of a run (16#8019).
TEST(DevicesInAProject, MayFollowAxesThatMayFollowEachOther) {
  EXPECT_EQ(told_of({{"Stacker", axis_behind({"Folder"})},
                     {"Folder", axis_behind({"Belt", "Stacker", "Packer"})},
                     {"Labeller", device_behind("Stacker")},
                     {"Packer", device_behind("Belt")}}),
            "");
}

TEST(DevicesInAProject, MayStandBetweenAxes) {
  EXPECT_EQ(told_of({{"Labeller", device_behind("Belt")},
                     {"Filler", device_behind("Labeller")},
                     {"Stacker", axis_behind({"Belt", "Labeller", "Filler"})},
                     {"Folder", axis_behind({"Stacker", "Labeller"})},
                     {"Packer", device_behind("Folder")}}),
            "");
}

}  // namespace
}  // namespace lockstep::device_following_test
