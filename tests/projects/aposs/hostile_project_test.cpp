// Projects that want an MCO 305 to fall: parameters and programs of any kind. There is always an answer, and
// what is wrong has a place.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/aposs/parameter_names.hpp"
#include "projects/loader/simulation.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::hostile_project_test {
namespace {

using Json = nlohmann::ordered_json;

Json project(const Json& device) {
  Json json = Json::parse(R"({ "lockstep": 1, "name": "hostile", "clock": { "servo_cycle": "1ms" } })");
  json["technology_objects"]["Lift"] = {{"type", "MCO_305"}};
  json["technology_objects"]["Lift"].update(device);
  return json;
}

/// Whether it is a project; if not every problem has its place in the device.
bool loads(const std::string& text, const std::string& what) {
  const LoadedProject loaded = load_project(text);
  for (const Problem& problem : loaded.problems)
    EXPECT_TRUE(problem.place.starts_with("/technology_objects/Lift")) << what << ": " << problem.place;
  EXPECT_EQ(loaded.project.has_value(), loaded.problems.empty()) << what;
  return loaded.project.has_value();
}

/// As text: not every value is one of JSON.
std::string text_with(const std::string& name, const std::string& value) {
  return R"({"lockstep":1,"name":"h","clock":{"servo_cycle":"1ms"},"technology_objects":{"Lift":)"
         R"({"type":"MCO_305","parameters":{")" +
         name + "\":" + value + "}}}}";
}

TEST(HostileProject, SaysOfEachParameterWhetherItsValueIsOne) {
  for (const mco305::Parameter& of : mco305::parameters()) {
    double scale = 1.0;
    for (int i = 0; i < of.decimals; ++i) scale *= 10.0;
    const std::string name = aposs::parameter_text(of.number);
    const auto accepted = [&](const std::string& value) {
      return loads(text_with(name, value), name + " = " + value);
    };
    const auto printed = [&](double value) {
      return scale == 1.0 ? std::to_string(static_cast<std::int64_t>(value)) : std::to_string(value / scale);
    };
    if (mco305::is_read_out(of.number)) {
      EXPECT_FALSE(accepted("1")) << name;
      continue;
    }
    EXPECT_TRUE(accepted(printed(of.start))) << name;
    const bool of_can = of.number == mco305::kCanNumber || of.number == mco305::kCanBaud;
    EXPECT_EQ(accepted(printed(of.highest)), !of_can || of.highest == of.start) << name;
    const double above = of.number == 3200 ? 10.0 : of.highest + 1.0;
    EXPECT_FALSE(accepted(printed(above)) && of.highest < INT32_MAX) << name;
    EXPECT_FALSE(accepted(printed(of.lowest - 1.0)) && of.lowest > INT32_MIN) << name;
    for (const char* const value : {"NaN", "\"12\"", "true", "null", "[]", "{}", "1e400", "-1e400", "1e300",
                                    "99999999999999999999999999", "[1,2,3]", "{\"a\":1}", "0.3333333333"})
      EXPECT_TRUE((scale != 1.0 && std::string(value) == "0.3333333333") ||
                  !load_project(text_with(name, value)).project.has_value())
          << name << " = " << value;
  }
}

// Options with gaps, and what CAN would need.
TEST(HostileProject, TakesPublishedOptionsOnly) {
  const auto told = [](const std::string& name, int value, const std::string& firmware = "5.00") {
    Json device = {{"firmware", firmware}};
    device["parameters"][name] = value;
    const LoadedProject loaded = load_project(project(device).dump());
    return loaded.problems.empty() ? std::string() : loaded.problems.front().text;
  };
  for (const int value : {0, 4, 5}) EXPECT_EQ(told("32-02", value), "") << value;
  for (const int value : {1, 2, 3}) {
    EXPECT_EQ(told("32-02", value), std::to_string(value) + " is not allowed here; allowed: 0, 4, 5");
    EXPECT_NE(told("32-32", value), "");
  }
  for (const int value : {0, 6, 7, 1000, 1006, 1007, 2000}) EXPECT_EQ(told("SYNCMSTART", value), "") << value;
  for (const int value : {8, 999, 1008, 1500, 1999}) EXPECT_NE(told("SYNCMSTART", value), "") << value;
  for (const int value : {7, 1007}) EXPECT_NE(told("SYNCMSTART", value, "<5.00"), "") << value;
  for (const int value : {0, 1, 2, 3, 5}) EXPECT_EQ(told("ERRCOND", value), "") << value;
  EXPECT_EQ(told("ERRCOND", 4), "4 is not allowed here; allowed: 0, 1, 2, 3, 5");
  EXPECT_EQ(told("33-90", 127), "");
  EXPECT_EQ(told("33-90", 5), "33-90 belongs to CAN, which is not built; allowed: its start value 127");
  EXPECT_EQ(told("33-91", 20), "");
  EXPECT_NE(told("33-91", 16), "");
}

TEST(HostileProject, IsToldOfFilesOfTheVendor) {
  const LoadedProject loaded =
      load_project(project({{"parameters", {{"file", "machine.cnf"}}},
                            {"programs", {{{"number", 0}, {"file", "machine.ZBC"}}}}})
                       .dump());
  ASSERT_EQ(loaded.problems.size(), 2U);
  for (const Problem& problem : loaded.problems)
    EXPECT_NE(problem.text.find("not described in its documents"), std::string::npos) << problem.text;
}

// A parameter that nothing looks at says so, where a value was given to it.
TEST(HostileProject, IsWarnedOfParametersWithoutEffect) {
  const auto told = [](const std::string& text) {
    std::string all;
    for (const Problem& problem : load_project(text).warnings)
      all += problem.place + ": " + problem.text + "\n";
    return all;
  };
  int without = 0;
  for (const mco305::Parameter& of : mco305::parameters()) {
    if (of.decimals != 0 || mco305::is_read_out(of.number)) continue;
    if (of.number == mco305::kCanNumber || of.number == mco305::kCanBaud) continue;  // an error
    const std::string name = aposs::parameter_text(of.number);
    const bool warns = told(text_with(name, std::to_string(of.start == of.highest ? of.lowest : of.highest)))
                           .find("without effect") != std::string::npos;
    EXPECT_EQ(warns, !of.effective) << name;
    EXPECT_EQ(told(text_with(name, std::to_string(of.start))).find("without effect"), std::string::npos)
        << name;
    without += of.effective ? 0 : 1;
  }
  EXPECT_GT(without, 10);
}

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(HostileProject, SurvivesProgramsOfAnySize) {
  const std::pair<std::string, bool> programs[] = {
      {"", true},
      {repeated("a = 1\n", 50'000), true},
      {repeated("a = 1\n", 70'000), false},
      {"a = " + repeated("(", 100'000) + "1" + repeated(")", 100'000), false},
      {"a = " + repeated("-", 100'000) + "1", false},
      {"a = 1" + repeated(" + 1", 100'000), false},
      {repeated("IF 1 THEN\n", 10'000), false},
      {repeated("REPEAT\n", 10'000), false},
      {"DIM a[2000000000]\n", false},
      {"DIM a[0]\n", false},
      {"DIM a[-1]\n", false},
      {repeated("x", 1'000'000), false},
      {"PRINT \"" + repeated("x", 100'000) + "\"\n", true},
      {"#INCLUDE \"../../../../etc/passwd\"\n", false},
      {repeated("GOSUB ", 10'000), false},
      {"SUBMAINPROG\nSUBPROG s\nGOSUB s\nRETURN\nENDPROG\n", true},
      {repeated("\xff\xfe", 1'000), false},
  };
  for (const auto& [text, fine] : programs) {
    Json lines = Json::array();
    std::string line;
    for (const char c : text) {
      if (c == '\n')
        lines.push_back(std::exchange(line, ""));
      else
        line += c;
    }
    if (!line.empty()) lines.push_back(line);
    const Json json = project({{"programs", {{{"number", 0}, {"autostart", true}, {"lines", lines}}}}});
    const std::string dumped = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    EXPECT_EQ(loads(dumped, text.substr(0, 40)), fine) << text.substr(0, 40);
  }
}

// 31,250 internal commands of 8 ns are a quarter of a step.
TEST(HostileProject, IsWarnedOfProgramsThatMayTakeAQuarterOfAStep) {
  const auto warnings = [](int devices, int steps) {
    Json json = Json::parse(R"({ "lockstep": 1, "name": "budget", "clock": { "servo_cycle": "1ms" } })");
    for (int i = 0; i < devices; ++i)
      json["technology_objects"]["D" + std::to_string(i)] = {
          {"type", "MCO_305"},
          {"steps_per_ms", steps},
          {"programs", {{{"number", 0}, {"autostart", true}, {"lines", {"DELAY 10"}}}}}};
    int count = 0;
    const LoadedProject loaded = load_project(json.dump());
    for (const Problem& problem : loaded.warnings)
      count += problem.text.find("quarter of a millisecond") != std::string::npos ? 1 : 0;
    return count;
  };
  EXPECT_EQ(warnings(128, 200), 0) << "as many as there may be, with the start value";
  EXPECT_EQ(warnings(2, 15'625), 0);
  EXPECT_EQ(warnings(2, 15'626), 1);
  EXPECT_EQ(warnings(5, 31'251), 1) << "told once";
}

TEST(HostileProject, SurvivesManyProgramsAndArrays) {
  Json programs = Json::array();
  for (int i = 0; i < 128; ++i)
    programs.push_back({{"number", i}, {"lines", {"DIM a[1000]", "a[1000] = 1", "SAVE ARRAYS"}}});
  EXPECT_TRUE(loads(project({{"programs", programs}}).dump(), "128 programs"));
  programs.push_back({{"number", 128}, {"lines", {"a = 1"}}});
  EXPECT_FALSE(loads(project({{"programs", programs}}).dump(), "number 128"));
  programs.back()["number"] = 5;
  EXPECT_FALSE(loads(project({{"programs", programs}}).dump(), "number 5 twice"));
  const Json large = {{{"number", 0}, {"lines", {"DIM a[10001]", "SAVE ARRAYS"}}}};
  EXPECT_FALSE(loads(project({{"programs", large}}).dump(), "more than is kept"));
}

/// The largest and smallest parameters that a project may give: the device runs, and its setpoint is finite.
TEST(HostileProject, RunsWithEveryParameterAtEitherEndOfItsRange) {
  for (const bool highest : {false, true})
    for (const bool drive : {false, true}) {
      Json parameters;
      for (const mco305::Parameter& of : mco305::parameters()) {
        const bool of_can = of.number == mco305::kCanNumber || of.number == mco305::kCanBaud;
        if (mco305::is_read_out(of.number) || of_can) continue;
        double value = highest ? of.highest : of.lowest;
        for (int i = 0; i < of.decimals; ++i) value /= 10.0;
        if (of.number == 3310 && value == 0.0) value = 1.0;
        if (of.decimals == 0)
          parameters[aposs::parameter_text(of.number)] = static_cast<std::int64_t>(value);
        else
          parameters[aposs::parameter_text(of.number)] = value;
      }
      Json device = {{"parameters", parameters},
                     {"programs",
                      {{{"number", 0},
                        {"autostart", true},
                        {"lines",
                         {"ON ERROR GOSUB e", "again:", "VEL 100", "POSA 1000000000", "POSA (-1000000000)",
                          "GOTO again", "SUBMAINPROG", "SUBPROG e", "ERRCLR", "RETURN", "ENDPROG"}}}}}};
      if (drive) device["drive"] = {{"model", "simulated"}};
      const LoadedProject loaded = load_project(project(device).dump());
      std::string all;
      for (const Problem& problem : loaded.problems) all += problem.place + ": " + problem.text + "\n";
      ASSERT_TRUE(loaded.project.has_value()) << all;
      Simulation machine = Simulation::from_text(project(device).dump());
      for (int i = 0; i < 500; ++i) {
        machine.run_for(std::chrono::milliseconds(1));
        ASSERT_TRUE(std::isfinite(machine.read("Lift.CPOS")));
        ASSERT_LE(std::abs(machine.read("Lift.SysVar.4111")), 1'048'575.0);
      }
    }
}

}  // namespace
}  // namespace lockstep::hostile_project_test
