// lockstep plot: pictures of small traces, and what cannot be drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::plot_test {
namespace {

constexpr char kPng[] = "\x89PNG\r\n\x1a\n";
constexpr char kKnife[] = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";

/// A modulo axis that turns, with a flag and a state.
std::string turning() {
  std::string text = "t,A.Position,A.Velocity,gear.InSync,A.StatusSynchronizedMotion.FunctionState\n";
  for (int i = 0; i < 400; ++i)
    text += std::to_string(i) + "," + std::to_string(i * 7 % 360) + ",7," + std::to_string(i / 200) + "," +
            std::to_string(i / 100) + "\n";
  return text;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++number;
  return number;
}

TEST(Plot, DrawsACsvTraceAsSvgWithALegendAndUnits) {
  const Directory folder;
  const std::string picture = folder.file("trace.svg");
  const Ended ended = lockstep({"plot", folder.write("trace.csv", turning()), "-o", picture});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string svg = content(picture);
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.rfind("</svg>"), std::string::npos);
  for (const char* text : {"trace.csv", "position [u]", "velocity [u/s]", "A.Position", "gear.InSync",
                           "t [s]", "A.StatusSynchronizedMotion.FunctionState"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Plot, BreaksTheLineOfAModuloPositionWhereItWraps) {
  const Directory folder;
  const auto lines_of = [&](const std::string& rows) {
    const std::string picture = folder.file("trace.svg");
    const Ended ended = lockstep({"plot", folder.write("trace.csv", "t,A.Position\n" + rows), "-o", picture});
    EXPECT_EQ(ended.status, 0) << ended.err;
    const std::string svg = content(picture);
    const auto path = svg.find("<path stroke='rgb(  0, 114, 178)'");
    EXPECT_NE(path, std::string::npos);
    return count(svg.substr(path, svg.find("/>", path) - path), "M") - 1;  // one is the legend's
  };
  EXPECT_EQ(lines_of("0,0\n1,100\n2,200\n3,300\n"), 1u);
  EXPECT_EQ(lines_of("0,200\n1,300\n2,40\n3,140\n"), 2u) << "a wrap";
  EXPECT_EQ(lines_of("0,0\n1,0\n2,300\n3,300\n"), 1u) << "a step while standing, as homing makes it";
}

TEST(Plot, DrawsAnLcmTraceAsPng) {
  const Directory folder;
  const std::string log = folder.file("knife.lcm"), picture = folder.file("knife.png");
  const Ended made = lockstep({"run", kKnife, "--simulate", "--duration", "2s", "--trace", log});
  ASSERT_EQ(made.status, 0) << made.err;
  const Ended ended = lockstep({"plot", log, "-o", picture, "--from", "500ms", "--to", "1.5"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(content(picture).substr(0, 8), kPng);
}

TEST(Plot, DrawsOnlyTheSignalsThatAreAskedFor) {
  const Directory folder;
  const std::string picture = folder.file("trace.svg");
  const Ended ended =
      lockstep({"plot", folder.write("trace.csv", turning()), "-o", picture, "--signals", "a.velocity"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(content(picture).find("A.Velocity"), std::string::npos);
  EXPECT_EQ(content(picture).find("A.Position"), std::string::npos);
}

TEST(Plot, ANameFromAFileIsTextAndNothingElse) {
  const Directory folder;
  const std::string mark = folder.file("mark");
  const std::string name = "x'; system \"touch " + mark + "\" #";
  const std::string other = "`touch " + mark + "`";
  const std::string trace = folder.write("trace.csv", "t," + name + "," + other + "\n0,1.5,1.5\n1,2.5,0.5\n");
  const Ended ended = lockstep({"plot", trace, "-o", folder.file("trace.svg")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(content(folder.file("trace.svg")).find("touch"), std::string::npos) << "shown as it is";
  EXPECT_FALSE(std::filesystem::exists(mark));
}

// A hundred thousand rows with one peak, which is one row long.
TEST(Plot, ALongTraceGivesASmallPictureThatStillHasItsPeak) {
  const Directory folder;
  const auto marks_of = [&](const std::string& peak) {
    std::string text = "t,A.Velocity\n";
    for (int i = 0; i < 100'000; ++i)
      text += std::to_string(i) + "," + (i == 54'321 ? peak : std::to_string(i % 10)) + "\n";
    const Ended ended = lockstep({"plot", folder.write("long.csv", text), "-o", folder.file("long.svg")});
    EXPECT_EQ(ended.status, 0) << ended.err;
    const std::string svg = content(folder.file("long.svg"));
    EXPECT_LT(svg.size(), 300'000u);
    return count(svg, ">100<");  // a mark of the axis
  };
  EXPECT_EQ(marks_of("5"), 0u);
  EXPECT_EQ(marks_of("100"), 1u);
}

constexpr char kWhole[] = R"json({
  "lockstep": 1, "name": "whole", "clock": { "servo_cycle": "100ms" },
  "technology_objects": { "Slide": { "type": "TO_PositioningAxis",
    "config": { "VirtualAxis": { "Mode": 1 }, "Units": { "LengthUnit": 1010 } } } },
  "tags": { "level": { "type": "LREAL" }, "state": { "type": "INT" } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "100ms", "calls": [
    { "set": "level", "to": "level + 1.0" }, { "set": "state", "to": "state + 1" } ] } ] })json";

TEST(Plot, DrawsARealAsACurveEvenIfItsValuesAreWholeAndTakesUnitsFromAProject) {
  const Directory folder;
  const std::string project = folder.write("project.json", kWhole);
  const std::string trace = folder.file("run.csv"), picture = folder.file("run.svg");
  const Ended run = lockstep({"run", project, "--simulate", "--duration", "1s", "--trace", trace, "--signals",
                              "level,state,Slide.Position"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(content(trace).find(",2.0,2,0.0\n"), std::string::npos) << content(trace);
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"plot", trace, "-o", picture};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = lockstep(words);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return content(picture);
  };
  constexpr char kCurve[] = "<path stroke='rgb(  0, 114, 178)'";
  EXPECT_NE(drawn({"--signals", "level"}).find(kCurve), std::string::npos);
  EXPECT_EQ(drawn({"--signals", "state"}).find(kCurve), std::string::npos);
  EXPECT_NE(drawn({}).find("position [u]"), std::string::npos);
  EXPECT_NE(drawn({"--project", project}).find("position [m]"), std::string::npos);
}

TEST(Plot, SaysThatACsvTraceHasNoUnits) {
  const Directory folder;
  const std::string trace = folder.file("t.csv");
  const std::string project = LOCKSTEP_SOURCE_DIR "/projects/01_positioning/project.json";
  ASSERT_EQ(lockstep({"run", project, "--simulate", "--duration", "1s", "--trace", trace}).status, 0);
  const Ended without = lockstep({"plot", trace, "-o", folder.file("p.svg")});
  EXPECT_EQ(without.status, 0);
  EXPECT_NE(without.err.find("does not say its units"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--project PROJECT.json"), std::string::npos) << without.err;
  EXPECT_EQ(lockstep({"plot", trace, "-o", folder.file("p.svg"), "--project", project}).err, "");
  const std::string log = folder.file("t.lcm");
  ASSERT_EQ(lockstep({"run", project, "--simulate", "--duration", "1s", "--trace", log}).status, 0);
  EXPECT_EQ(lockstep({"plot", log, "-o", folder.file("p.svg")}).err, "") << "which has them";
}

TEST(Plot, TellsWhatItsProjectDoesNotKnow) {
  const Directory folder;
  const std::string trace = folder.write("t.csv", "t,level,Slide.Position,gone\n0,1.5,0.5,1\n1,2.5,1.5,0\n");
  const std::string project = folder.write("whole.json", kWhole), picture = folder.file("t.svg");
  const auto told = [&](const std::string& of, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"plot", trace, "-o", picture, "--project", of});
    const Ended ended = lockstep(more);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.err;
  };
  EXPECT_EQ(told(project, {"--signals", "level,Slide.Position"}), "");
  EXPECT_NE(told(project).find("whole.json' knows nothing of: gone; their units"), std::string::npos)
      << told(project);
  const std::string other = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";
  EXPECT_NE(told(other).find("knows none of these signals: level, Slide.Position, gone;"), std::string::npos)
      << told(other);
}

TEST(Plot, DrawsOddTraces) {
  const Directory folder;
  const std::pair<const char*, const char*> odd[] = {
      {"one row", "t,a\n0,1.5\n"},
      {"a constant", "t,a\n0,1.5\n1,1.5\n"},
      {"nothing finite", "t,A.Position\n0,nan\n1,inf\n"},
      {"the greatest numbers", "t,A.Position\n0,-1.7e308\n1,1.7e308\n"},
      {"gaps", "t,A.Position\n0,1\n1,nan\n2,3\n3,4\n"},
  };
  for (const auto& [what, text] : odd) {
    const Ended ended = lockstep({"plot", folder.write("odd.csv", text), "-o", folder.file("odd.png")});
    EXPECT_EQ(ended.status, 0) << what << ": " << ended.err;
    EXPECT_EQ(content(folder.file("odd.png")).substr(0, 8), kPng) << what;
    std::filesystem::remove(folder.file("odd.png"));
  }
}

TEST(Plot, WhatCannotBeDrawnExitsWith2AndTheReasonAndLeavesNoPicture) {
  const Directory folder;
  const std::string good = folder.write("good.csv", turning());
  const std::string picture = folder.file("x.png");
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{folder.write("bad.csv", "t,a\n0,1\n1,x\n"), "-o", picture}, "bad.csv:3:3: "},
      {{folder.write("empty.csv", ""), "-o", picture}, "the file is empty"},
      {{folder.write("rows.csv", "t,a\n"), "-o", picture}, "has no rows"},
      {{folder.write("names.csv", "t\n0\n"), "-o", picture}, "has no signals"},
      {{folder.write("back.csv", "t,a\n1,0\n0,0\n"), "-o", picture}, "go back"},
      {{folder.write("time.csv", "t,a\nnan,0\n"), "-o", picture}, "is no number"},
      {{folder.write("bad.lcm", "no log"), "-o", picture}, "bad.lcm: "},
      {{folder.file("nothing.csv"), "-o", picture}, "No such file"},
      {{folder.write("trace.txt", ""), "-o", picture}, "has to end in .csv or .lcm"},
      {{good, "-o", folder.file("x.pdf")}, "has to end in .svg or .png"},
      {{good, "-o", folder.file("no/x.png")}, "No such file"},
      {{good, "-o", picture, "--signals", "A.Positio"}, "did you mean 'A.Position'?"},
      {{good, "-o", picture, "--from", "soon"}, "is no time"},
      {{good, "-o", picture, "--from", "1000"}, "it goes from 0 s to 399 s"},
      {{good, "-o", picture, "--from", "5", "--to", "4"}, "no rows in that time"},
  };
  for (const auto& [arguments, reason] : bad) {
    std::vector<std::string> command = arguments;
    command.insert(command.begin(), "plot");
    const Ended ended = lockstep(command);
    EXPECT_EQ(ended.status, 2) << reason;
    EXPECT_NE(ended.err.find(reason), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(picture)) << reason;
  }
}

TEST(Plot, WithoutGnuplotTheUserIsToldWhatToInstall) {
  const Directory folder;
  const Ended ended = run({"env", "PATH=" + folder.file("nowhere"), LOCKSTEP_EXECUTABLE, "plot",
                           folder.write("trace.csv", turning()), "-o", folder.file("x.png")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("gnuplot-nox"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace lockstep::cli::plot_test
