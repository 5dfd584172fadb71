// Cams in a project: their keys, what is reported of them, and a run through the public face.
#include <gtest/gtest.h>

#include <string>

#include "projects/project.hpp"
#include "projects/simulation.hpp"

namespace lockstep {
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

/// The problems of a cam, one a line without its place in the file.
std::string problems(const std::string& cam) {
  std::string text;
  for (const Problem& problem : load_project(project(cam)).problems) {
    const std::string prefix = "/technology_objects/Profile";
    EXPECT_TRUE(problem.place.starts_with(prefix)) << problem.place;
    text += problem.place.substr(std::min(prefix.size(), problem.place.size())) + ": " + problem.text + "\n";
  }
  return text;
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
  EXPECT_NE(problems(R"({ "type": "TO_Cam", "points": [ [1.0, 2.0] ] })").find("make no curve"),
            std::string::npos);
  std::string many = R"({ "type": "TO_Cam", "points": [ [0.0, 0.0])";
  for (int i = 1; i <= 1000; ++i) many += ", [" + std::to_string(i) + ".0, 0.0]";
  EXPECT_NE(problems(many + "] }").find("takes 1001 points; allowed are 1000"), std::string::npos);
  EXPECT_NE(problems(R"({ "type": "TO_Cam", "segments": [ { "xmin": 5.0, "xmax": 5.0 } ] })")
                .find("/segments/0/xmax: 5 is not above xmin"),
            std::string::npos);
  EXPECT_EQ(problems(R"({ "type": "TO_Cam" })"), "");
}

}  // namespace
}  // namespace lockstep
