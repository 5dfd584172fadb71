// lockstep cam: through the built program.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::cam_test {
namespace {

using nlohmann::json;

const std::string kCams = LOCKSTEP_SOURCE_DIR "/projects/cams/";
const std::string kFeeder = kCams + "feeder.cam.json";
constexpr char kPng[] = "\x89PNG\r\n\x1a\n";

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A dwell, a transition by a law and a dwell.
std::string rise_by(const std::string& law, const std::string& more = "") {
  return R"({"lockstep_cam": 1, "elements": [
    {"type": "line", "start": 0, "end": 60, "start_value": 0, "slope": 0},
    {"type": "transition", "law": ")" +
         law + "\"" + more + R"(},
    {"type": "line", "start": 180, "end": 240, "start_value": 50, "slope": 0}]})";
}

// The published figures of each law, to the digits of the catalogue.
TEST(Cam, InfoTellsTheFiguresOfTheLawBeforeAndAfterItsMapping) {
  const Directory folder;
  struct Row {
    const char* law;
    double cv, ca, cj;
  };
  for (const Row& row : {Row{"polynomial", 1.875, 5.773502691896258, 60.0},
                         Row{"inclined sine", 2.0, 6.283185307179586, 39.47841760435743},
                         Row{"modified sine", 1.7596033911, 5.527957072, 69.46635729},
                         Row{"modified acceleration trapezoid", 2.0, 4.88812376, 61.42597481}}) {
    const Ended ended = lockstep({"cam", "info", folder.write("cam.json", rise_by(row.law)), "--json"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const json figures = json::parse(ended.out).at("elements").at(1).at("normalised");
    for (const char* which : {"law", "cam"}) {
      EXPECT_NEAR(figures[which]["Cv"].get<double>(), row.cv, 2e-8 * row.cv) << row.law << which;
      EXPECT_NEAR(figures[which]["Ca"].get<double>(), row.ca, 2e-8 * row.ca) << row.law << which;
      EXPECT_NEAR(figures[which]["Cj"].get<double>(), row.cj, 1e-6 * row.cj) << row.law << which;
    }
    const Ended text = lockstep({"cam", "info", folder.file("cam.json")});
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.out.find(std::string(row.law) + " R-R from 60 to 180"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("Cmdyn"), std::string::npos);
  }
}

TEST(Cam, InfoTellsTheFiguresOfAPolynomialOfDegreeSevenBeforeAndAfterItsMapping) {
  const Directory folder;
  const std::string file = folder.write("cam.json", R"({"lockstep_cam": 1, "elements": [
    {"type": "polynomial", "start": 0, "end": 1, "start_value": 0, "start_velocity": 0, "start_acceleration": 0,
     "start_jerk": 0, "end_value": 1, "end_velocity": 0, "end_acceleration": 0, "end_jerk": 0}]})");
  const Ended ended = lockstep({"cam", "info", file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("polynomial from 0 to 1: differs from its curve by 0.00131"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("velocity                2.1875"), std::string::npos) << ended.out;
}

TEST(Cam, SampleGivesPointListsForSpreadsheets) {
  const Directory folder;
  Ended ended = lockstep({"cam", "sample", kFeeder, "--count", "361"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(lines_of(ended.out), 361u);
  EXPECT_EQ(ended.out.substr(0, 4), "0,0\n");
  ended = lockstep(
      {"cam", "sample", kFeeder, "--count", "5", "--derivatives", "--tabs", "--from", "180", "--to", "200"});
  EXPECT_EQ(ended.out,
            "180\t50\t0\t0\t0\n185\t50\t0\t0\t0\n190\t50\t0\t0\t0\n195\t50\t0\t0\t0\n200\t50\t0\t0\t0\n");
  ended = lockstep({"cam", "sample", kFeeder, "--count", "2", "--json"});
  EXPECT_EQ(json::parse(ended.out), json::parse("[[0, 0], [360, 0]]"));
  ended = lockstep({"cam", "sample", kFeeder, "-o", folder.file("list.csv")});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(lines_of(content(folder.file("list.csv"))), 361u);
  ended = lockstep({"cam", "sample", kFeeder, "--from", "-1"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("allowed is an ascending part of 0 to 360"), std::string::npos) << ended.err;
}

TEST(Cam, CheckCarriesOutTheChecksOfTheFile) {
  const Directory folder;
  Ended ended = lockstep({"cam", "check", kFeeder});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  json feeder = json::parse(content(kFeeder));
  feeder["checks"]["max_velocity"] = 300.0;
  feeder["checks"]["following_range"] = {0, 49};
  ended = lockstep({"cam", "check", folder.write("cam.json", feeder.dump())});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find(
                "cam.json: modified sine R-R from 60 to 160: velocity of the following axis reaches 316.7"),
            std::string::npos)
      << ended.err;
  EXPECT_NE(
      ended.err.find("line from 160 to 220: following values from 50 to 50 leave the range from 0 to 49"),
      std::string::npos)
      << ended.err;
  ended = lockstep({"cam", "check", folder.file("cam.json"), "--json"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(json::parse(ended.out).size(), 4u) << ended.out;
}

TEST(Cam, ConvertsBetweenAllFormatsAndBackWithoutALostBit) {
  const Directory folder;
  const auto convert = [&](const std::string& from, const std::string& to,
                           std::vector<std::string> more = {}) {
    std::vector<std::string> command{"cam", "convert", from, "-o", folder.file(to)};
    command.insert(command.end(), more.begin(), more.end());
    const Ended ended = lockstep(command);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return content(folder.file(to));
  };
  const std::string design = convert(kFeeder, "design.json");
  EXPECT_EQ(convert(folder.file("design.json"), "again.json"), design);
  const std::string table = convert(kFeeder, "data.csv");
  EXPECT_EQ(convert(folder.file("data.csv"), "data.txt").find(','), std::string::npos);
  convert(folder.file("data.txt"), "data.json");
  EXPECT_EQ(convert(folder.file("data.json"), "back.csv"), table);
  EXPECT_EQ(lines_of(convert(kFeeder, "points.csv", {"--as", "points", "--count", "91"})), 91u);
  convert(folder.file("points.csv"), "points.json");
  EXPECT_EQ(json::parse(content(folder.file("points.json"))).at("points").size(), 91u);
  Ended ended = lockstep({"cam", "convert", kFeeder, "-o", folder.file("x.csv"), "--as", "design"});
  EXPECT_EQ(ended.status, 2);
  ended = lockstep({"cam", "convert", kFeeder, "-o", folder.file("x.xls")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("has to end in .json, .csv (commas) or .txt (tabs)"), std::string::npos);
}

TEST(Cam, PlotDrawsFourDiagramsAsSvgAndPng) {
  const Directory folder;
  Ended ended = lockstep({"cam", "plot", kFeeder, "-o", folder.file("cam.svg")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string svg = content(folder.file("cam.svg"));
  for (const char* text : {"Feeder", "following value", "velocity", "acceleration", "jerk", "leading value",
                           "transitions by a law"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find("t [s]"), std::string::npos);
  ended =
      lockstep({"cam", "plot", kCams + "contour.csv", "-o", folder.file("cam.png"), "--title", "Contour"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(content(folder.file("cam.png")).starts_with(kPng));
  ended = lockstep({"cam", "plot", kFeeder, "-o", folder.file("cam.pdf")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("has to end in .svg or .png"), std::string::npos);
}

TEST(Cam, BrokenFilesAreToldWithTheirPlaces) {
  const Directory folder;
  Ended ended = lockstep({"cam", "check", folder.write("points.csv", "0,0\n10,zwei\n20\n")});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("points.csv:2:4: 'zwei' is not allowed here"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("points.csv:3:1: the row has 1 values"), std::string::npos) << ended.err;
  ended = lockstep({"cam", "info", folder.write("cam.json", rise_by("harmonic combination"))});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find(
                "cam.json:/elements/1/law: the law 'harmonic combination' does not serve a transition R-R"),
            std::string::npos)
      << ended.err;
  ended = lockstep({"cam", "info", folder.write("syntax.json", "{\n \"lockstep_cam\": ]\n")});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("syntax.json:2:18: "), std::string::npos) << ended.err;
  ended = lockstep({"cam", "info", folder.file("none.json")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("none.json: No such file"), std::string::npos) << ended.err;
  EXPECT_EQ(lockstep({"cam"}).status, 2);
  EXPECT_EQ(lockstep({"cam", "info"}).status, 2);
  EXPECT_EQ(lockstep({"cam", "sample", kFeeder, "--count", "1"}).status, 2);
}

TEST(Cam, TellsElementsThatDoNotCountWithTheirPlaces) {
  const Directory folder;
  Ended ended = lockstep({"cam", "check", folder.write("points.csv", "0,0\n10,1\n10,2\n20,0\n")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("points.csv:2:1: warning: does not count"), std::string::npos) << ended.err;
  ended = lockstep({"cam", "info", folder.write("cam.json", R"({"lockstep_cam": 1, "segments": [
    {"xmin": 0, "xmax": 5}, {"xmin": 4, "xmax": 9, "a0": 3}]})")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("cam.json:/segments/0: warning: does not count from 4 to 5"), std::string::npos)
      << ended.err;
  ended = lockstep({"cam", "check", folder.write("sine.csv", "I,1,0\nS,0,1,0,0,0,0,0,0,0,1,1e6,0\n")});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("sine.csv:2:1: the sines of the cam have 159154.9"), std::string::npos)
      << ended.err;
}

TEST(Cam, FindsTheCamOfAProject) {
  const Directory folder;
  const std::string project = folder.write("project.json", R"({"lockstep": 1, "technology_objects": {
    "Profile": {"type": "TO_Cam", "points": [[0.0, 0.0], [180.0, 50.0], [360.0, 0.0]],
      "config": {"InterpolationSettings": {"InterpolationMode": 1, "BoundaryConditions": 1}}}}})");
  Ended ended = lockstep({"cam", "sample", project, "--cam", "Profile", "--count", "3"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "0,0\n180,50\n360,0\n");
  ended = lockstep({"cam", "info", project});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("name one of its cams with --cam; it has: Profile"), std::string::npos)
      << ended.err;
}

TEST(Cam, HelpTeaches) {
  const Ended ended = lockstep({"cam", "--help"});
  EXPECT_EQ(ended.status, 0);
  for (const char* text : {"info", "sample", "check", "convert", "plot", "CAMS.md", "Exit status"})
    EXPECT_NE(ended.out.find(text), std::string::npos) << text;
  for (const char* command : {"info", "sample", "check", "convert", "plot"})
    EXPECT_EQ(lockstep({"cam", command, "--help"}).status, 0) << command;
}

}  // namespace
}  // namespace lockstep::cli::cam_test
