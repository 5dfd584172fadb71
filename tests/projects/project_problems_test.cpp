// All problems of a project are told, each once.
#include <gtest/gtest.h>

#include <algorithm>

#include "changed_project.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::project_problems_test {
namespace {

TEST(ProjectProblems, AreToldForSectionsOfAnotherKind) {
  for (const auto& [section, allowed] : {std::pair{"technology_objects", "an object"},
                                         std::pair{"tags", "an object"}, std::pair{"programs", "an array"}}) {
    Json project = {{"lockstep", 1}, {"name", "x"}, {"clock", {{"servo_cycle", "1ms"}}}};
    project[section] = "text";
    const LoadedProject loaded = load_project(project.dump());
    EXPECT_EQ(lines(loaded.problems),
              std::string("FILE:/") + section + ": 'text' is not allowed here; allowed: " + allowed + "\n");
  }
}

TEST(ProjectProblems, AreAllToldAtOnce) {
  Json project = Json::parse(kExampleProject);
  project["clock"]["interpolator_ratio"] = 99;
  project["technology_objects"]["Knife"]["config"]["Modulo"]["Length"] = -1;
  project["tags"]["speed"]["type"] = "FLOAT";
  project["programs"][0]["calls"][4]["in"]["Ratio"] = 1;
  project["modbus"]["map"][0]["address"] = -1;
  project["trace"]["signals"][0] = "Conveyer.Position";
  project["extra"] = 1;
  const LoadedProject loaded = load_project(project.dump());
  std::vector<std::string> places;
  for (const Problem& problem : loaded.problems) places.push_back(problem.place);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places,
            (std::vector<std::string>{"/clock/interpolator_ratio", "/extra", "/modbus/map/0/address",
                                      "/programs/0/calls/4/in/Ratio", "/tags/speed/type",
                                      "/technology_objects/Knife/config/Modulo/Length", "/trace/signals/0"}))
      << "and nothing about what only follows from the faulty declaration of 'speed'";
}

TEST(ProjectProblems, DoNotRepeatThemselvesWhereAFaultyObjectIsUsed) {
  Json project = Json::parse(kExampleProject);
  project["technology_objects"]["Knife"]["type"] = "TO_Kinematics";
  const LoadedProject loaded = load_project(project.dump());
  ASSERT_EQ(loaded.problems.size(), 1u) << lines(loaded.problems);
  EXPECT_EQ(loaded.problems[0].place, "/technology_objects/Knife/type");
}

/// A following error of 100 is 100 m there, and a machine pushes for long before it is seen.
TEST(ProjectProblems, WarnOfDefaultsThatAreMadeForMillimetresInALongerUnit) {
  Json project = Json::parse(kExampleProject);
  Json& config = project["technology_objects"]["Knife"]["config"];
  const auto warned = [&project] {
    std::string text;
    for (const Problem& warning : load_project(project.dump()).warnings)
      if (warning.place == "/technology_objects/Knife/config/Units/LengthUnit") text = warning.text;
    return text;
  };
  config["Units"]["LengthUnit"] = 1013;
  EXPECT_EQ(warned(), "");
  for (const int longer : {1010, 1011, 1018, 1019, 1021}) {
    config["Units"]["LengthUnit"] = longer;
    EXPECT_NE(warned().find(
                  "FollowingError.MinValue 10, FollowingError.MaxValue 100, PositioningMonitoring.Window 1, "
                  "StandstillSignal.VelocityThreshold 5;"),
              std::string::npos)
        << longer << warned();
  }
  config["FollowingError"] = {{"MinValue", 0.001}, {"MaxValue", 0.01}};
  EXPECT_EQ(warned().find("FollowingError"), std::string::npos) << warned();
  config["PositioningMonitoring"]["Window"] = 0.001;
  config["StandstillSignal"]["VelocityThreshold"] = 0.005;
  EXPECT_EQ(warned(), "");
}

TEST(ProjectProblems, IncludeThePinsOfACallWhoseNameIsTaken) {
  const LoadedProject loaded = load_project(
      changed("/programs/0/calls/7", R"({"fb": "R_TRIG", "name": "run", "in": {"CLCK": true}})"));
  ASSERT_EQ(loaded.problems.size(), 2u) << lines(loaded.problems);
  EXPECT_EQ(loaded.problems[0].place, "/programs/0/calls/7/name");
  EXPECT_EQ(loaded.problems[1].place, "/programs/0/calls/7/in/CLCK");
}

TEST(ProjectProblems, AreToldForDuplicateKeysAndWhatElseIsWrong) {
  const LoadedProject loaded = load_project(
      R"({"lockstep": 1, "lockstep": 2, "name": "x", "clock": {"servo_cycle": "1ms"}, "tags": {"a": {"type": "BOL"}}})");
  EXPECT_EQ(lines(loaded.problems),
            "FILE:/lockstep: the key 'lockstep' is there twice; each key is allowed once, the other one is "
            "in line 1\n"
            "FILE:/tags/a/type: unknown type 'BOL' (did you mean 'BOOL'?); allowed: BOOL, SINT, INT, DINT, "
            "LINT, USINT, "
            "UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD, REAL, LREAL, TIME, STRING[n], ARRAY[lower..upper] "
            "OF one of "
            "them or of a structure of cams\n");
}

TEST(ProjectProblems, OfAnExpressionHaveOnePlaceWhichIsThatInTheFile) {
  const auto told = [](const std::string& set, const std::string& to) {
    const LoadedProject loaded = load_project(R"({"lockstep": 1, "name": "x", "clock": {"servo_cycle": "1ms"},
"tags": {"n": {"type": "DINT"}, "a": {"type": "ARRAY[1..3] OF DINT"}},
"programs": [{"name": "M", "ob": "Main", "cycle": "1ms", "calls": [
{"set": )" + set + R"(, "to": )" + to + "}]}]}");
    std::string text;
    for (const Problem& problem : loaded.problems.empty() ? loaded.warnings : loaded.problems)
      text += to_string("FILE", problem) + "\n";
    return text;
  };
  EXPECT_NE(told("\"n\"", "\"n + m\"").find("unknown name 'm'"), std::string::npos);
  EXPECT_NE(told("\"n\"", "\"n + m\"").find(" (line 4, column 25"), std::string::npos)
      << told("\"n\"", "\"n + m\"");
  EXPECT_NE(told("\"n\"", "\"n / 0\"").find("the divisor is always 0"), std::string::npos);
  EXPECT_NE(told("\"n\"", "\"n / 0\"").find(" (line 4, column 23"), std::string::npos)
      << told("\"n\"", "\"n / 0\"");
  EXPECT_NE(told("\"a[n + m]\"", "1").find(" (line 4, column 16"), std::string::npos)
      << told("\"a[n + m]\"", "1");
  // Of a text with escapes no column of the file is known.
  EXPECT_NE(told("\"n\"", R"("n \u002B m")").find(" (character 5 of the text) (line 4, column 20"),
            std::string::npos)
      << told("\"n\"", R"("n \u002B m")");
}

TEST(ProjectProblems, NameTheServoCycleWithItsUnit) {
  const LoadedProject loaded = load_project(changed("/programs/0/cycle", "\"1500us\""));
  EXPECT_NE(lines(loaded.problems).find("allowed: multiples of 1ms"), std::string::npos)
      << lines(loaded.problems);
}

TEST(ProjectProblems, NameAPlaceOnOneLineWhateverTheKey) {
  const LoadedProject loaded = load_project(
      "{\"lockstep\": 1, \"name\": \"x\", \"clock\": {\"servo_cycle\": \"1ms\"}, \"tags\": {\"a\\nb\": "
      "{\"type\": \"BOOL\"}}}");
  ASSERT_EQ(loaded.problems.size(), 1u);
  EXPECT_EQ(loaded.problems[0].place, "/tags/a?b");
  EXPECT_EQ(lines(loaded.problems).find('\n'), lines(loaded.problems).size() - 1);
}

TEST(ProjectProblems, StayShortForVeryLongNames) {
  const std::string name(1'000'000, 'n');
  const LoadedProject loaded =
      load_project(R"({"lockstep": 1, "name": ")" + name + R"(", "clock": {"servo_cycle": ")" + name +
                   R"("}, ")" + name + R"(": 1, "tags": {")" + name + R"(": {"type": ")" + name +
                   R"("}}, "trace": {"signals": [")" + name + R"(", ")" + name + "." + name + R"("]}})");
  EXPECT_GE(loaded.problems.size(), 6u);
  EXPECT_LT(lines(loaded.problems).size(), 4000u) << lines(loaded.problems);
}

TEST(ProjectProblems, AreFoundInTimeAmongManyNames) {
  Json project = Json::parse(kExampleProject);
  for (int i = 0; i < 3000; ++i) {
    project["tags"]["tag_number_" + std::to_string(i)] = {{"type", "BOOL"}};
    project["trace"]["signals"].push_back("tug_number_" + std::to_string(i));
  }
  const LoadedProject loaded = load_project(project.dump());
  EXPECT_EQ(loaded.problems.size(), 3000u);
}

}  // namespace
}  // namespace lockstep::project_problems_test
