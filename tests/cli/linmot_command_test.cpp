// lockstep describe and lockstep linmot: what they tell of servo controllers LinMot.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::linmot_command_test {
namespace {

using Json = nlohmann::json;

Json described(std::vector<std::string> words) {
  words.insert(words.begin(), "describe");
  words.emplace_back("--json");
  const Ended ended = lockstep(words);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended.status == 0 ? Json::parse(ended.out) : Json();
}

TEST(DescribeLinMot, TellsParametersCommandsAndModules) {
  const Json speed = described({"LinMot_Controller", "Max Speed"});
  EXPECT_EQ(speed["start"], "0.78125, printed");
  EXPECT_EQ(speed["signal"], "A.SetValueGeneration.FilterParameter.MaxSpeed");
  EXPECT_TRUE(speed["live"]);
  EXPECT_EQ(described({"LinMot_Controller", "Initialization\\Init Config\\Init Speed"})["start"],
            "0.05, ours: the source prints none");
  EXPECT_EQ(described({"ASCII"})["entries"].size(), 70u);
  EXPECT_EQ(described({"ASCII", "SP"})["range"], "-32256 to 32256");
  EXPECT_EQ(described({"MT"})["entries"].size(), 22u);
  EXPECT_EQ(described({"MT", "freeze"})["name"], "Freeze");
  EXPECT_EQ(described({"PROFIBUS", "Run Curve"})["words"], "1 out, 0 in");
}

/// A cell of a table of Markdown.
std::string cell_of(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell;
}

/// A table for each kind of motor, from what describe tells.
std::string parameter_document(const Json& parameters) {
  std::string text =
      "# Parameters of a LinMot controller\n\n"
      "What `lockstep describe LinMot_Controller Parameters` tells, all 212 in published order; renew it "
      "with\n"
      "`LOCKSTEP_UPDATE=1 cli_tests --gtest_filter=DescribeLinMot.*`. L: may be changed at run time. The "
      "address is that\n"
      "of the ASCII commands AS 0, AO. A start value without \"printed\" is this program's choice. Where "
      "there is no\n"
      "signal the parameter is declared and has no effect.\n";
  std::string of;
  for (const Json& one : parameters) {
    if (one["of"] != of) {
      of = one["of"];
      text += "\n## Of " + of +
              "\n\n| parameter | signal | unit | allowed | start value | L | address | meaning "
              "|\n|---|---|---|---|---|---|---|---|\n";
    }
    std::string start = one["start"];
    if (const auto ours = start.find(", ours"); ours != start.npos) start.resize(ours);
    const std::string changes = one["read_only"] ? "read only" : one["live"] ? "L" : "";
    text += "|";
    for (const std::string& cell :
         {"`" + one["path"].get<std::string>() + "`", one["signal"].get<std::string>(),
          one["unit"].get<std::string>(), one["allowed"].get<std::string>(), start, changes,
          one["address"].get<std::string>(), one["text"].get<std::string>()})
      text += " " + cell_of(cell) + " |";
    text += "\n";
  }
  return text;
}

TEST(DescribeLinMot, MakesTheDocumentOfItsParameters) {
  const Json all = described({"LinMot_Controller", "Parameters"})["parameters"];
  EXPECT_EQ(all.size(), 212u);
  const std::string made = parameter_document(all);
  const std::string path = std::string(LOCKSTEP_SOURCE_DIR) + "/tech_objects/linmot/PARAMETERS.md";
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(path) << made;
  EXPECT_EQ(content(path), made)
      << "a declaration has changed: run LOCKSTEP_UPDATE=1 cli_tests --gtest_filter=DescribeLinMot.*";
}

TEST(DescribeLinMot, HasEveryCommandOfTheTableInItsDocument) {
  const std::string document = content(std::string(LOCKSTEP_SOURCE_DIR) + "/tech_objects/linmot/MT.md");
  const Json entries = described({"MT"})["entries"];
  for (const Json& entry : entries)
    EXPECT_NE(document.find("| `" + entry["name"].get<std::string>() + "` |"), std::string::npos)
        << entry["name"];
}

TEST(LinMotCommand, CalculatesFeedForward) {
  const Ended ended = lockstep({"linmot", "tune", "--force-constant", "40", "--slider-mass", "0.829",
                                "--load-mass", "1.2", "--friction", "10", "--vertical"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* const figure : {"2.029 kg", "0.2500 A", "50.725 mA/(m/s²)", "0.49761 A"})
    EXPECT_NE(ended.out.find(figure), std::string::npos) << figure << "\n" << ended.out;
}

TEST(LinMotCommand, TellsCurvesAndRows) {
  const std::string project = std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json";
  const Ended curves = lockstep({"linmot", "curve", project, "--number", "1"});
  EXPECT_NE(curves.out.find("Lid curve 1: 0 mm to 0 mm in 500 ms, at most 0.533333 m/s"), std::string::npos)
      << curves.out << curves.err;
  const Ended table = lockstep({"linmot", "table", project});
  EXPECT_NE(table.out.find("Abs. Position 0 mm, 1.00002 m/s, 50.0679 m/s²"), std::string::npos)
      << table.out << table.err;
  EXPECT_EQ(lockstep({"linmot", "curve", "/nowhere/x.json"}).status, 2);
  EXPECT_EQ(lockstep({"linmot", "curve", project, "--number", "9"}).status, 1);
}

TEST(CheckCommand, TellsWhatOfALinMotControllerCounts) {
  const Ended checked =
      lockstep({"check", "-v", std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  for (const char* const line :
       {"Abs. Position 0 mm, 1.00002 m/s, 50.0679 m/s²",
        "  A  Max Speed 0.78125 m/s, Max Acceleration 30.5176 m/s², Init Speed 0.0499725 m/s"})
    EXPECT_NE(checked.out.find(line), std::string::npos) << line << "\n" << checked.out;
}

TEST(LinMotCommand, WritesRowsAsAFileHasThem) {
  const std::string project = std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json";
  const Ended csv = lockstep({"linmot", "table", project, "--csv"});
  EXPECT_EQ(
      csv.out,
      "state;A;B;C;D\n0;Curve 1;Curve 2;Curve 3;\n"
      "1;;Abs. Position 0 mm, 1.00002 m/s, 50.0679 m/s²;Abs. Position 0 mm, 1.00002 m/s, 50.0679 m/s²;\n")
      << csv.err;
  const Directory directory;
  Json json = Json::parse(std::ifstream(project));
  std::ofstream(directory.file("rows.csv")) << csv.out;
  json["technology_objects"]["Lid"]["state_table"] = {{"file", "rows.csv"}};
  std::ofstream(directory.file("project.json")) << json.dump();
  const Ended again = lockstep({"linmot", "table", directory.file("project.json"), "--csv"});
  EXPECT_EQ(again.out, csv.out) << again.err;
}

TEST(LinMotCommand, DrawsACurve) {
  const std::string project = std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json";
  const Directory directory;
  const std::string picture = directory.file("curve.svg");
  const Ended drawn = lockstep({"linmot", "curve", project, "--number", "2", "--plot", picture});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(content(picture).find("Lid curve 2"), std::string::npos);
  EXPECT_NE(
      lockstep({"linmot", "curve", project, "--number", "2", "--plot", "curve.gif"}).err.find(".svg or .png"),
      std::string::npos);
}

Json talking() {
  return Json::parse(R"({
    "lockstep": 1, "name": "talk", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "C": { "type": "LinMot_Controller",
      "config": { "System": { "Command Interface": "ASCII RS232" }, "Drives": { "Drive A": { "Type": "LinMot P0x-37" } } } } },
    "ascii": [ { "mode": "RS232", "controllers": { "1": "C" } } ],
    "stimuli": [ { "at": "10ms", "ascii": { "send": "!PV1" } }, { "at": "10ms", "ascii": { "send": "!GS1" } },
                 { "at": "20ms", "ascii": { "send": "a,b" } } ] })");
}

TEST(RunCommand, WritesWhatWasSaidOnTheLines) {
  const Directory directory;
  std::ofstream(directory.file("project.json")) << talking().dump();
  const std::string file = directory.file("said.csv");
  const Ended ended = lockstep(
      {"run", directory.file("project.json"), "--simulate", "--duration", "100ms", "--transcript", file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  // One command at a time: the second has its answer a tick later.
  EXPECT_EQ(content(file), "t,line,request,answer\n0.01,0,!PV1,#2\n0.011,0,!GS1,#W\n0.02,0,\"a,b\",#E59\n");
}

TEST(RunCommand, RefusesATranscriptWithoutALine) {
  const Directory directory;
  Json project = talking();
  project.erase("ascii");
  project.erase("stimuli");
  std::ofstream(directory.file("project.json")) << project.dump();
  const Ended ended = lockstep({"run", directory.file("project.json"), "--simulate", "--duration", "1ms",
                                "--transcript", directory.file("said.csv")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("--transcript: the project has no line in 'ascii'"), std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace lockstep::cli::linmot_command_test
