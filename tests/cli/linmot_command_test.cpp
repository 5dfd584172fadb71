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

/// The lid with comments, which stay, and with no feed-forward of C.
std::string lid_with_comments(const Directory& directory) {
  std::string text = content(std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json");
  text.insert(text.find("\"Drive B\""), "// the container\n          ");
  const std::string feed_forward =
      ", \"FF Friction\": 0.2, \"FF Acceleration\": 28.2, \"FF Deceleration\": 28.2";
  const auto found = text.find(feed_forward);
  EXPECT_NE(found, text.npos);
  text.erase(found, feed_forward.size());
  return directory.write("lid.json", text);
}

TEST(LinMotCommand, TunesAMotorOfAProject) {
  const Directory directory;
  const std::string project = lid_with_comments(directory), before = content(project);
  const Ended told = lockstep({"linmot", "tune", project, "Lid", "B"});
  EXPECT_EQ(told.status, 0) << told.err;
  for (const char* const figure : {"2.029 kg", "0.2500 A", "50.725 mA/(m/s²)", "0.00000 A"})
    EXPECT_NE(told.out.find(figure), std::string::npos) << figure << "\n" << told.out;
  EXPECT_EQ(content(project), before);
  const Ended applied = lockstep({"linmot", "tune", project, "Lid", "B", "--apply"});
  EXPECT_EQ(applied.status, 0) << applied.err;
  EXPECT_NE(applied.out.find("lid.json:19: FF Friction\n"), std::string::npos) << applied.out;
  EXPECT_EQ(lockstep({"linmot", "tune", project, "Lid", "C", "--apply"}).status, 0);
  const std::string after = content(project);
  EXPECT_NE(after.find("// the container"), after.npos);
  EXPECT_NE(after.find(R"("Current Offset": 0)"), after.npos) << after;
  const Json drives =
      Json::parse(after, nullptr, true, true)["technology_objects"]["Lid"]["config"]["Drives"];
  const auto of = [&drives](const char* drive) { return drives[drive]["Control Parameters"]; };
  EXPECT_EQ(
      of("Drive A"),
      Json::parse(before, nullptr, true,
                  true)["technology_objects"]["Lid"]["config"]["Drives"]["Drive A"]["Control Parameters"]);
  EXPECT_DOUBLE_EQ(of("Drive B")["FF Friction"], 0.25);
  EXPECT_DOUBLE_EQ(of("Drive B")["FF Acceleration"], 50.725);
  EXPECT_DOUBLE_EQ(of("Drive C")["FF Friction"], 0.2);
  EXPECT_DOUBLE_EQ(of("Drive C")["FF Deceleration"], 28.225);
  EXPECT_DOUBLE_EQ(of("Drive C")["Maximal Current"], 5.0);
  // Once more changes nothing.
  EXPECT_EQ(lockstep({"linmot", "tune", project, "Lid", "C", "--apply"}).status, 0);
  EXPECT_EQ(content(project), after);
}

TEST(LinMotCommand, RefusesToTuneWhatIsNotThere) {
  const Directory directory;
  const std::string project = lid_with_comments(directory), before = content(project);
  const auto refused = [&](std::vector<std::string> words, int status, const std::string& text) {
    words.insert(words.begin(), {"linmot", "tune"});
    const Ended ended = lockstep(words);
    EXPECT_EQ(ended.status, status) << ended.err;
    EXPECT_NE(ended.err.find(text), std::string::npos) << text << "\n" << ended.err;
  };
  refused({project, "Lib", "A", "--apply"}, 1, "there is no LinMot_Controller 'Lib'");
  refused({project, "Lid", "D", "--apply"}, 1, "'motors' of Lid does not describe D");
  refused({project, "Lid", "E"}, 2, "one of A, B, C, D");
  refused({project, "Lid", "A", "--friction", "3"}, 2, "");
  refused({project, "Lid"}, 2, "FILE CONTROLLER A");
  refused({"--apply"}, 2, "");
  refused({}, 2, "FILE CONTROLLER A");
  refused({"/nowhere/x.json", "Lid", "A"}, 2, "");
  EXPECT_EQ(content(project), before);
  // A controller that another file has.
  Json whole = Json::parse(before, nullptr, true, true), part;
  for (const char* const key : {"technology_objects", "tags", "programs"}) {
    part[key] = whole[key];
    whole.erase(key);
  }
  whole["include"] = {"lid.json"};
  directory.write("whole.json", whole.dump());
  directory.write("lid.json", part.dump());
  const std::string in_part = content(project);
  refused({directory.file("whole.json"), "Lid", "A", "--apply"}, 1, "does not stand in this file itself");
  EXPECT_EQ(content(project), in_part);
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

// With the time of 9600 baud: "!PV1", CR, the next tick, "#2", CR; then the next command.
TEST(RunCommand, WritesWhenAnswersAreThereOnALineWithPace) {
  const Directory directory;
  Json project = talking();
  project["ascii"][0]["pace"] = true;
  std::ofstream(directory.file("project.json")) << project.dump();
  const std::string file = directory.file("said.csv");
  const Ended ended = lockstep(
      {"run", directory.file("project.json"), "--simulate", "--duration", "100ms", "--transcript", file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(content(file),
            "t,line,request,answer\n0.019125,0,!PV1,#2\n0.028125,0,!GS1,#W\n0.038208333,0,\"a,b\",#E59\n");
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
