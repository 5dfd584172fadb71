// Cams in a project: their keys, what is reported of them, and a run through the public face.
#include <gtest/gtest.h>

#include <string>

#include "projects/loader/project.hpp"
#include "projects/loader/simulation.hpp"

namespace lockstep::cam_project_test {
namespace {

std::string project(const std::string& cam, const std::string& calls = "") {
  return R"({
  "lockstep": 1, "name": "cam", "clock": { "servo_cycle": "1ms" },
  "technology_objects": {
    "Press": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true } } },
    "Feeder": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
                "leading_values": [ { "to": "Press" } ] },
    "Profile": )" +
         cam + R"(
  },
  "tags": { "start": { "type": "BOOL" }, "height": { "type": "LREAL", "init": 50.0 } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power_p", "in": { "Axis": "Press", "Enable": true } },
    { "fb": "MC_Power", "name": "power_f", "in": { "Axis": "Feeder", "Enable": true } },
    { "fb": "MC_Home", "name": "home_f", "in": { "Axis": "Feeder", "Execute": "power_f.Status" } },
    { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Press", "Execute": "power_p.Status", "Velocity": 360.0,
                                                      "Acceleration": 100000.0, "Jerk": 0.0 } },
    { "fb": "MC_CamIn", "name": "cam_in", "in": { "Master": "Press", "Slave": "Feeder", "Cam": "Profile",
        "Execute": "home_f.Done", "ApplicationMode": 1, "MasterSyncPosition": 90.0, "MasterStartDistance": 60.0 } })" +
         calls + R"( ] } ]
})";
}

const char* const kCam = R"({ "type": "TO_Cam", "points": [ [0.0, 0.0], [180.0, 50.0], [360.0, 0.0] ],
  "config": { "InterpolationSettings": { "InterpolationMode": 1, "BoundaryConditions": 1 } } })";

TEST(CamProject, FollowsThePointsOfTheProject) {
  Simulation machine = Simulation::from_text(project(kCam));
  machine.run_for(std::chrono::seconds(2));
  EXPECT_EQ(machine.read("cam_in.InSync"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X0"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X5"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.EndLeadingValue"), 360.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.NumberOfValidPoints"), 3.0);
  const auto& cam = static_cast<Cam&>(*machine.project().controller->objects[2]);
  for (int i = 0; i < 1000; ++i) {
    machine.step();
    ASSERT_NEAR(machine.read("Feeder.Position"),
                cam.function().value(machine.read("Press.Position")).position, 1e-10);
  }
}

TEST(CamProject, TakesSegmentsAndElementsOfTheConfiguration) {
  Simulation machine = Simulation::from_text(project(R"({ "type": "TO_Cam_10k",
    "segments": [ { "xmin": 0.0, "xmax": 100.0, "a1": 0.5 },
                  { "xmin": 100.0, "xmax": 360.0, "a0": 50.0, "sineAmplitude": 0.0, "sinePeriod": 1.0 } ],
    "config": { "Point[7]": { "x": 400.0, "y": 20.0 }, "ValidPoint[7]": true } })"));
  EXPECT_EQ(machine.read("Profile.StatusCam.EndLeadingValue"), 400.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.NumberOfValidSegments"), 2.0);
  EXPECT_EQ(machine.read("Profile.Segment[1].a1"), 0.5);
  const auto& cam = static_cast<Cam&>(*machine.project().controller->objects[2]);
  EXPECT_DOUBLE_EQ(cam.function().value(50.0).position, 25.0);
  EXPECT_DOUBLE_EQ(cam.function().value(400.0).position, 20.0);
}

TEST(CamProject, ProgramsChangePointsAndInterpolateAnew) {
  Simulation machine = Simulation::from_text(
      project(R"({ "type": "TO_Cam" })",
              R"(, { "set": "Profile.Point[1].x", "to": 0.0 }, { "set": "Profile.Point[2].x", "to": 360.0 },
           { "set": "Profile.Point[2].y", "to": "height" },
           { "set": "Profile.ValidPoint[1]", "to": true }, { "set": "Profile.ValidPoint[2]", "to": true },
           { "fb": "MC_InterpolateCam", "name": "interpolate", "in": { "Cam": "Profile", "Execute": "start" } },
           { "fb": "MC_GetCamFollowingValue", "name": "read",
             "in": { "Cam": "Profile", "Execute": "interpolate.Done", "LeadingValue": 180.0 } })"));
  machine.step();
  EXPECT_EQ(machine.read("Profile.StatusWord.X5"), 0.0);
  machine.run_for(std::chrono::milliseconds(100));
  EXPECT_EQ(machine.read("Profile.StatusWord.X4"), 1.0);
  EXPECT_EQ(machine.read("Feeder.ErrorDetail.Number"), 612.0);  // MC_CamIn came before the cam
  machine.write("start", 1.0);
  machine.step();
  EXPECT_EQ(machine.read("interpolate.Busy"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X6"), 1.0);
  machine.step();
  EXPECT_EQ(machine.read("interpolate.Done"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X5"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X4"), 0.0);
  machine.step();
  EXPECT_EQ(machine.read("read.Value"), 25.0);
}

/// What is told of a cam, one a line, with the place in the cam.
std::string lines_of(const std::vector<Problem>& told) {
  std::string text;
  for (const Problem& problem : told) {
    const std::string prefix = "/technology_objects/Profile";
    EXPECT_TRUE(problem.place.starts_with(prefix)) << problem.place;
    text += problem.place.substr(std::min(prefix.size(), problem.place.size())) + ": " + problem.text + "\n";
  }
  return text;
}

/// ApplicationMode is 2, for which a cam need not close.
std::string appended(const std::string& cam) {
  std::string text = project(cam);
  const std::string mode = "\"ApplicationMode\": 1";
  return text.replace(text.find(mode), mode.size(), "\"ApplicationMode\": 2");
}

std::string problems(const std::string& cam) {
  return lines_of(load_project(appended(cam)).problems);
}

/// Warnings of a valid project, but for tags that nothing uses.
std::vector<Problem> warnings_of(const std::string& text) {
  LoadedProject loaded = load_project(text);
  EXPECT_TRUE(loaded.problems.empty()) << lines_of(loaded.problems);
  const LoadedProject looked_at = load_project(text, "", {}, LoadedFor::looking);
  EXPECT_EQ(looked_at.warnings, loaded.warnings) << "as 'lockstep check' tells them";
  std::erase_if(loaded.warnings, [](const Problem& warning) { return warning.place.starts_with("/tags/"); });
  return std::move(loaded.warnings);
}
std::string warnings(const std::string& cam) {
  return lines_of(warnings_of(appended(cam)));
}

TEST(CamProject, ReportsEverythingThatIsWrongWithACam) {
  const std::string text = problems(R"({ "type": "TO_Cam", "speed": 3,
    "points": [ [0.0, 0.0], [1.0], 5, ["a", 2.0], [1e13, 0.0] ],
    "segments": [ { "xmin": 5.0, "xmax": 5.0 }, { "xmax": 5.0, "a7": 1.0 } ],
    "config": { "Point[1001]": { "x": 1.0 }, "InterpolationSettings": { "InterpolationMode": 3 },
                "StatusCam": { "EndLeadingValue": 1.0 } } })");
  for (const char* part :
       {"/speed: unknown key",
        "/points/1: ", "/points/2: 5 is not allowed here; allowed: [leading value, following value]",
        "/points/3/0: 'a' is not allowed", "/points/4/0: ", "/segments/1: ", "/segments/1/a7: unknown key",
        "/config/Point[1001]: ", "/config/InterpolationSettings/InterpolationMode: ", "/config/StatusCam"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(CamProject, TakesElementsWithTransitionsByALaw) {
  EXPECT_EQ(problems(R"({ "type": "TO_Cam", "elements": [
    { "type": "line", "start": 0, "end": 60, "start_value": 0, "end_value": 0 },
    { "type": "transition", "method": "law", "law": "modified sine" },
    { "type": "line", "start": 160, "end": 360, "start_value": 50, "end_value": 50 } ] })"),
            "");
  EXPECT_NE(problems(R"({ "type": "TO_Cam", "elements": [ { "type": "circle" } ] })").find("/elements/0"),
            std::string::npos);
}

TEST(CamProject, TellsAFileThatIsNotThere) {
  EXPECT_NE(problems(R"({ "type": "TO_Cam", "file": "no/such.cam.json" })").find("/file: cannot be read"),
            std::string::npos);
}

TEST(CamProject, ReportsPointsThatMakeNoCurveAndTooMany) {
  EXPECT_TRUE(problems(R"({ "type": "TO_Cam", "points": [ [1.0, 2.0] ] })")
                  .starts_with("/points/0/0: 1 is the only leading value"));
  std::string many = R"({ "type": "TO_Cam", "points": [ [0.0, 0.0])";
  for (int i = 1; i <= 1000; ++i) many += ", [" + std::to_string(i) + ".0, 0.0]";
  EXPECT_NE(problems(many + "] }").find("takes 1001 points; allowed are 1000"), std::string::npos);
  EXPECT_NE(problems(R"({ "type": "TO_Cam", "segments": [ { "xmin": 5.0, "xmax": 5.0 } ] })")
                .find("/segments/0/xmax: 5 is not above xmin"),
            std::string::npos);
  EXPECT_EQ(problems(R"({ "type": "TO_Cam" })"), "");
}

TEST(CamProject, TellsAtWhichElementACurveFails) {
  EXPECT_TRUE(
      problems(R"({ "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 5, "a1": 1 },
      { "xmin": 7, "xmax": 9, "a1": 2 } ],
      "config": { "InterpolationSettings": { "InterpolationMode": 1, "BoundaryConditions": 1 } } })")
          .starts_with("/segments/1: the cam ends here with a slope of 2 and begins with one of 1; "));
  EXPECT_TRUE(problems(R"({ "type": "TO_Cam",
      "segments": [ { "xmin": 0, "xmax": 1, "sineAmplitude": 1, "sinePeriod": 1e6 } ] })")
                  .starts_with("/segments/0/sinePeriod: the sines of the cam have 159154.9"));
  EXPECT_TRUE(problems(R"({ "type": "TO_Cam", "config": { "Segment[2]": { "xmin": 5, "xmax": 1 },
      "ValidSegment[2]": true } })")
                  .starts_with("/config/Segment[2]/xmax: 1 is not above xmin, 5"));
}

TEST(CamProject, WarnsOfElementsThatDoNotCountWhereTheyStand) {
  EXPECT_TRUE(warnings(R"({ "type": "TO_Cam", "points": [ [0, 0], [0, 1], [10, 2] ] })")
                  .starts_with("/points/0: does not count: of the points at leading value 0 the last does"));
  EXPECT_TRUE(
      warnings(
          R"({ "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 5 } ], "points": [ [8, 1], [2, 3] ] })")
          .starts_with("/points/1: does not count: at leading value 2 the segment from 0 to 5 does"));
  EXPECT_TRUE(
      warnings(
          R"({ "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 5 }, { "xmin": 4, "xmax": 9, "a0": 3 } ] })")
          .starts_with("/segments/0: does not count from 4 to 5"));
  EXPECT_TRUE(warnings(R"({ "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 1e6, "a6": 1e12 } ] })")
                  .starts_with("/segments/0: the following value reaches 1e+48 at leading value 1e+06"));
  EXPECT_TRUE(warnings(R"({ "type": "TO_Cam", "points": [ [0, 0], [10, 2] ],
      "config": { "Point[3]": { "x": 10, "y": 5 }, "ValidPoint[3]": true } })")
                  .starts_with("/points/1: does not count"))
      << "the configuration adds to the points";
  EXPECT_EQ(warnings(kCam), "");
}

TEST(CamProject, WarnsOfACamThatDoesNotCloseAndIsToBePassedAgainAndAgain) {
  const char* const open = R"({ "type": "TO_Cam", "points": [ [0, 0], [50, 50], [100, 80] ] })";
  const std::vector<Problem> told = warnings_of(project(open));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].place, "/programs/0/calls/4/in/ApplicationMode");
  EXPECT_NE(told[0].text.find("'Profile' begins with 0 and ends with 80"), std::string::npos) << told[0].text;
  EXPECT_EQ(warnings_of(appended(open)).size(), 0u);
  EXPECT_EQ(warnings_of(project(kCam)).size(), 0u) << "it closes";
  std::string ring = project(open);  // of 80 units: the cam closes on it
  const std::string line = R"("TO_SynchronousAxis", "config": { )";
  ring.insert(ring.find(line) + line.size(), R"("Modulo": { "Enable": true, "Length": 80.0 }, )");
  const std::vector<Problem> step = warnings_of(ring);  // its slope at the end is not that at its start
  ASSERT_EQ(step.size(), 1u);
  EXPECT_NE(step[0].text.find("from the end to the start the velocity steps from"), std::string::npos);
}

/// The project whose second cam takes over at the end of the first.
std::string exchanged(double slope, const std::string& more = "") {
  std::string text = project(
      R"({ "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 100, "a1": 0.5 } ] },
    "Next": { "type": "TO_Cam", "segments": [ { "xmin": 0, "xmax": 100, "a1": )" +
          std::to_string(slope) + " } ] }",
      R"(, { "fb": "MC_CamIn", "name": "take_over", "in": { "Master": "Press", "Slave": "Feeder", "Cam": "Next",
        "Execute": "start", "SyncProfileReference": 5)" +
          more + " } }");
  const std::string cyclic = R"("ApplicationMode": 1, )";
  return text.erase(text.find(cyclic), cyclic.size());
}

TEST(CamProject, WarnsOfACamThatTakesOverWithAnotherVelocity) {
  EXPECT_TRUE(warnings_of(exchanged(0.5)).empty());
  const std::vector<Problem> told = warnings_of(exchanged(0.75));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].place, "/programs/0/calls/5/in/SyncProfileReference");
  EXPECT_NE(told[0].text.find("'Next' begins with a slope of 0.75 where 'Profile' ends with one of 0.5"),
            std::string::npos)
      << told[0].text;
  EXPECT_TRUE(warnings_of(exchanged(0.25, R"(, "SlaveScaling": 2.0)")).empty()) << "scaled they agree";
  EXPECT_TRUE(warnings_of(exchanged(0.75, R"(, "SlaveScaling": "height")")).empty()) << "nobody knows yet";
}

}  // namespace
}  // namespace lockstep::cam_project_test
