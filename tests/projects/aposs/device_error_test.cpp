// Each error that a device can have, by a project of its own: what provokes it, its number, its bit, and that
// it can be cleared.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tech_objects/mco305_catalogue/errors.hpp"

namespace lockstep::device_error_test {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

struct Provoked {
  int number;
  Texts program;       ///< behind ON ERROR GOSUB
  Json parameters{};   ///< of the device
  bool drive = false;  ///< with its machine
  const char* fault =
      nullptr;    ///< key of "faults" of the drive, or of the device: the tag is TRUE from 100 ms
  int input = 0;  ///< that the tag switches, in place of a fault
  Texts subprograms{};
  Texts head{};         ///< in front of all: DIM
  bool locked = false;  ///< "write_protected"
};

Texts many(int count, const std::string& before, const std::string& behind, int step = 1) {
  Texts lines;
  for (int i = 1; i <= count; ++i) lines.push_back(before + std::to_string(step * i) + behind);
  return lines;
}

Texts thirteen() {
  Texts lines;
  for (int i = 1; i <= 13; ++i) lines.push_back("ON PERIOD 1000 GOSUB s" + std::to_string(i));
  return lines;
}
Texts thirteen_subprograms() {
  Texts lines;
  for (int i = 1; i <= 13; ++i) {
    lines.push_back("SUBPROG s" + std::to_string(i));
    lines.emplace_back("RETURN");
  }
  return lines;
}

Texts nested_loops(int count) {
  Texts lines;
  for (int i = 1; i <= count; ++i) lines.push_back("l" + std::to_string(i) + ":");
  for (int i = count; i >= 1; --i) lines.push_back("LOOP 1 l" + std::to_string(i));
  return lines;
}

const std::vector<Provoked>& provoked() {
  const Texts runs = {"VEL 50", "ACC 50", "DEC 50", "CVEL 50", "CSTART"};
  const Texts empty = {"SUBPROG s", "RETURN"};
  static const std::vector<Provoked> kRows = {
      {.number = 112, .program = {"DELAY 10", "a = GET 32-99"}},
      {.number = 106, .program = {"POSA 100"}, .parameters = {{"HOME_FORCE", 1}}},
      {.number = 107, .program = {"HOME"}, .parameters = {{"HOME_VEL", 0}}},
      {.number = 108, .program = runs, .parameters = {{"POSERR", 1000}}, .drive = true, .fault = "blocked"},
      {.number = 109, .program = {"INDEX"}, .parameters = {{"HOME_VEL", 50}}},
      {.number = 111, .program = {"POSA 1001"}, .parameters = {{"SWPOSLIMACT", 1}, {"POSLIMIT", 1000}}},
      {.number = 113, .program = {}, .parameters = {{"33-82", 1}}, .drive = true, .fault = "drive"},
      {.number = 114, .program = nested_loops(11)},
      {.number = 119, .program = runs, .parameters = {{"33-50", 9}}, .input = 1},
      {.number = 125, .program = runs, .parameters = {{"33-50", 5}}, .input = 1},
      {.number = 149, .program = many(21, "ON +APOS ", " GOSUB s", 1000), .subprograms = empty},
      {.number = 150, .program = runs, .parameters = {{"EXTERNAL24V", 1}}, .fault = "supply"},
      {.number = 151, .program = {"GOSUB s"}, .subprograms = {"SUBPROG s", "GOSUB s", "RETURN"}},
      {.number = 152,
       .program = {"GOSUB a"},
       .subprograms = {"SUBPROG a", "GOTO inside", "RETURN", "SUBPROG b", "inside:", "RETURN"}},
      {.number = 154, .program = {"OUT 1 1"}, .fault = "output"},
      {.number = 155, .program = {"LINKGPAR 1900 \"x\" 5 1 0"}},
      {.number = 171, .program = {"i = 6", "a[i] = 1"}, .head = {"DIM a[5]"}},
      {.number = 179, .program = {"WAITNDX 100"}},
      {.number = 184, .program = thirteen(), .subprograms = thirteen_subprograms()},
      {.number = 190, .program = {"SAVE AXPARS"}, .locked = true},
      {.number = 191, .program = {"SETCURVE a"}, .head = {"DIM a[5]"}},
      {.number = 192, .program = runs, .parameters = {{"32-09", 1}}, .drive = true, .fault = "encoder"},
      {.number = 192, .program = {}, .parameters = {{"32-39", 1}}, .fault = "master_encoder"},
      {.number = 198,
       .program = {"CVEL 20", "CSTART", "again:", "DELAY 1000", "POSA 900000", "GOTO again"},
       .parameters = {{"SWPOSLIMACT", 1}, {"POSLIMIT", 1000}}},
  };
  return kRows;
}

Json project_of(const Provoked& one) {
  Json json = Json::parse(R"({ "lockstep": 1, "name": "errors", "clock": { "servo_cycle": "1ms" },
    "tags": { "fault": { "type": "BOOL" } },
    "stimuli": [ { "at": "100ms", "set": { "fault": true } }, { "at": "1500ms", "set": { "fault": false } } ],
    "technology_objects": { "Lift": { "type": "MCO_305", "programs": [ { "number": 0, "autostart": true } ] } } })");
  Json& device = json["technology_objects"]["Lift"];
  Texts lines = one.head;
  // 1990: the first error; 1991, 1992: its bits; 1993: the errors that were cleared.
  const auto add = [&](const Texts& more) { lines.insert(lines.end(), more.begin(), more.end()); };
  add({"n = 0", "ON ERROR GOSUB trouble"});
  add(one.program);
  add({"wait:", "DELAY 10", "GOTO wait", "SUBMAINPROG", "SUBPROG trouble",
       "IF (GET 1990 == 0 OR ERRNO == 198) THEN", "SET 1990 (ERRNO)", "SET 1991 (GET 34-70)",
       "SET 1992 (GET 34-71)", "ENDIF", "ERRCLR", "n = n + 1", "SET 1993 n", "RETURN"});
  add(one.subprograms);
  add({"ENDPROG"});
  device["programs"][0]["lines"] = lines;
  device["parameters"] = one.parameters.is_null() ? Json::object() : one.parameters;
  if (one.drive) {
    device["drive"] = {{"model", "simulated"}, {"time_constant", "3ms"}};
    device["parameters"]["FFVEL"] = 10'486;
  }
  if (one.locked) device["write_protected"] = true;
  if (one.input != 0) device["inputs"] = {{std::to_string(one.input), "fault"}};
  if (one.fault != nullptr) (one.drive ? device["drive"] : device)["faults"] = {{one.fault, "fault"}};
  return json;
}

TEST(DeviceErrors, AreEachProvokedByAProject) {
  for (const Provoked& one : provoked()) {
    Simulation machine = Simulation::from_text(project_of(one).dump());
    machine.run_for(std::chrono::milliseconds(4000));
    EXPECT_EQ(machine.read("Lift.P1990"), one.number);
    EXPECT_GE(machine.read("Lift.P1993"), 1.0) << one.number << ": its handler ran and cleared it";
    const mco305::Error* const error = mco305::find_error(one.number);
    ASSERT_NE(error, nullptr);
    EXPECT_TRUE(error->never.empty()) << one.number;
    if (error->word == 0) continue;
    const auto bits = static_cast<std::uint32_t>(
        static_cast<std::int32_t>(machine.read(error->word == 1 ? "Lift.P1991" : "Lift.P1992")));
    EXPECT_NE(bits & 1U << error->bit, 0u) << one.number;
    EXPECT_EQ((static_cast<std::uint32_t>(static_cast<std::int32_t>(machine.read("Lift.P1991"))) >> 31) == 1,
              error->word == 2)
        << one.number << ": bit 31 says that the other word has bits";
  }
}

// What belongs to an error beside its number, of those of which anything does.
TEST(DeviceErrors, HaveAValueInTheirHistory) {
  int looked_at = 0;
  for (const Provoked& one : provoked()) {
    Simulation machine = Simulation::from_text(project_of(one).dump());
    machine.run_for(std::chrono::milliseconds(400));
    const auto past = [&](int i, const std::string& what) {
      return machine.read("Lift.ErrorHistory[" + std::to_string(i) + "]." + what);
    };
    double value = 0.0;
    for (int i = 1; i <= 50; ++i)
      if (past(i, "Number") == one.number) value = past(i, "Value");
    ++looked_at;
    if (one.number == 108) {
      EXPECT_GT(value, 1000.0) << "the following error, beyond POSERR";
      EXPECT_LT(value, 5000.0);
    } else if (one.number == 112) {
      EXPECT_EQ(value, 3299.0);
    } else if (one.number == 125) {
      EXPECT_EQ(value, one.input);
    } else if (one.number == 192) {
      EXPECT_EQ(value, one.drive ? 2.0 : 1.0);
    } else if (one.number != 198 && one.number != 111) {
      EXPECT_EQ(value, 0.0) << one.number;
    }
  }
  EXPECT_GT(looked_at, 20);
  const Provoked beyond{.number = 111,
                        .program = {"CVEL 20", "CSTART"},
                        .parameters = {{"SWPOSLIMACT", 1}, {"POSLIMIT", 1000}}};
  Simulation machine = Simulation::from_text(project_of(beyond).dump());
  machine.run_for(std::chrono::milliseconds(2000));
  bool found = false;
  for (int i = 1; i <= 50 && !found; ++i) {
    found = machine.read("Lift.ErrorHistory[" + std::to_string(i) + "].Number") == 111.0;
    if (found) {
      EXPECT_GT(machine.read("Lift.ErrorHistory[" + std::to_string(i) + "].Value"), 1000.0);
    }
  }
  EXPECT_TRUE(found);
}

// The last fifty, the newest first, each with its time, its program and its line.
TEST(DeviceErrors, StandInTheirHistory) {
  Json json = Json::parse(R"({ "lockstep": 1, "name": "history", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Lift": { "type": "MCO_305", "programs": [ { "number": 7, "autostart": true } ] } } })");
  json["technology_objects"]["Lift"]["programs"][0]["lines"] = {"ON ERROR GOSUB trouble",
                                                                "DELAY 10",
                                                                "a = GET 32-99",
                                                                "again:",
                                                                "HOME",
                                                                "DELAY 10",
                                                                "GOTO again",
                                                                "SUBMAINPROG",
                                                                "SUBPROG trouble",
                                                                "ERRCLR",
                                                                "RETURN",
                                                                "ENDPROG"};
  json["technology_objects"]["Lift"]["parameters"] = {{"HOME_VEL", 0}};
  Simulation machine = Simulation::from_text(json.dump());
  const auto past = [&](int i, const std::string& what) {
    return machine.read("Lift.ErrorHistory[" + std::to_string(i) + "]." + what);
  };
  EXPECT_EQ(past(1, "Number"), 0);
  machine.run_for(std::chrono::milliseconds(15));
  EXPECT_EQ(past(1, "Number"), 107);
  EXPECT_EQ(past(1, "Line"), 5);
  EXPECT_EQ(past(2, "Number"), 112);
  EXPECT_EQ(past(2, "Program"), 7);
  EXPECT_EQ(past(2, "Line"), 3);
  EXPECT_NEAR(past(2, "Time"), 10, 1);
  EXPECT_EQ(past(3, "Number"), 0);
  machine.run_for(std::chrono::milliseconds(2000));
  for (int i = 1; i <= 50; ++i) {
    EXPECT_EQ(past(i, "Number"), 107) << i;
    if (i < 50) {
      EXPECT_GT(past(i, "Time"), past(i + 1, "Time"));
    }
  }
}

// What has no program of its own here: 105 waits behind another one, 110 and 196 need a damaged image, 115 a
// disk that is gone, 116 a damaged retain file, 170 and 176 two
// programs; each has its test elsewhere.
TEST(DeviceErrors, HaveATestEachOrSayWhyNot) {
  std::set<int> tested = {105, 110, 115, 116, 162, 170, 175, 176, 196};
  for (const Provoked& one : provoked()) tested.insert(one.number);
  for (const mco305::Error& error : mco305::errors())
    EXPECT_EQ(tested.contains(error.number), error.never.empty()) << error.number;
  // What can be provoked is, or says why not: it is found when a program is compiled, or what it is about is
  // not built.
  const Json document =
      Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/errors_provoke.json"));
  std::set<int> published;
  for (const Json& one : document.at("errors")) {
    const int number = one.at("number");
    published.insert(number);
    if (one.at("provoke").is_null()) {
      EXPECT_FALSE(tested.contains(number)) << number;
    }
  }
  for (const mco305::Error& error : mco305::errors())
    EXPECT_TRUE(published.contains(error.number)) << error.number;
  EXPECT_EQ(published.size(), mco305::errors().size());
}

}  // namespace
}  // namespace lockstep::device_error_test
