// Arrays in a project: how they are declared, given values, indexed and told of.
#include <gtest/gtest.h>

#include <string>

#include "projects/loader/simulation.hpp"

namespace lockstep::array_test {
namespace {

/// @param tags further tags  @param calls of the program
std::string project(const std::string& tags, const std::string& calls = "", const std::string& more = "") {
  return R"({ "lockstep": 1, "name": "arrays", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Profile": { "type": "TO_Cam" } },
    "tags": { "i": { "type": "INT", "init": 2 }, "value": { "type": "LREAL", "init": 1.5 }, )" +
         tags + R"( },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ )" +
         calls + " ] } ]" + more + " }";
}

const char* const kArrays = R"(
  "numbers": { "type": "ARRAY[-1..3] OF LREAL", "init": [ 10.0, 11, "2.0 * 6.0" ], "comment": "five" },
  "flags": { "type": "array [0 .. 7] of WORD", "init": [ "16#0005" ] },
  "points": { "type": "ARRAY[1..4] OF TO_Cam_Struct_PointData", "init": [ [ 0.0, 5.0 ], { "y": 7.5, "x": 90.0 } ] },
  "parts": { "type": "ARRAY[1..2] OF TO_Cam_Struct_SegmentData", "init": [ { "xmin": 1.0, "a6": 2.0 } ] })";

TEST(Arrays, HoldTheValuesThatTheyAreGivenAndZero) {
  const Simulation machine = Simulation::from_text(project(kArrays));
  EXPECT_EQ(machine.read("numbers[-1]"), 10.0);
  EXPECT_EQ(machine.read("Numbers[0]"), 11.0);
  EXPECT_EQ(machine.read("numbers[1]"), 12.0);
  EXPECT_EQ(machine.read("numbers[3]"), 0.0);
  EXPECT_EQ(machine.read("flags[0]"), 5.0);
  EXPECT_EQ(machine.read("flags[0].X2"), 1.0);
  EXPECT_EQ(machine.read("flags[0].X1"), 0.0);
  EXPECT_EQ(machine.read("points[1].y"), 5.0);
  EXPECT_EQ(machine.read("points[2].X"), 90.0);
  EXPECT_EQ(machine.read("points[2].y"), 7.5);
  EXPECT_EQ(machine.read("parts[1].a6"), 2.0);
  EXPECT_EQ(machine.read("parts[2].sinePhase"), 0.0);
}

TEST(Arrays, AreReadAndWrittenByConstantIndices) {
  Simulation machine = Simulation::from_text(project(kArrays, R"(
    { "set": "numbers[3]", "to": "numbers[-1] + numbers[1]" },
    { "set": "points[4].x", "to": "points[2].x * 2.0" },
    { "set": "points[ 1 + 2 ].y", "to": "points[1 + 1].y" },
    { "set": "flags[7].X3", "to": "flags[0].X2" })"));
  machine.step();
  EXPECT_EQ(machine.read("numbers[3]"), 22.0);
  EXPECT_EQ(machine.read("points[4].x"), 180.0);
  EXPECT_EQ(machine.read("points[3].y"), 7.5);
  EXPECT_EQ(machine.read("flags[7]"), 8.0);
}

TEST(Arrays, AreReadAndWrittenByIndicesThatAreComputed) {
  Simulation machine = Simulation::from_text(project(kArrays, R"(
    { "set": "points[i].x", "to": "10.0 * TO_LREAL(i) + numbers[i - 2]" },
    { "set": "flags[i].X1", "to": "flags[2 * i - 4].X2" },
    { "set": "value", "to": "ABS(points[i].x) + numbers[-1]" })"));
  machine.step();
  EXPECT_EQ(machine.read("points[2].x"), 31.0);
  EXPECT_EQ(machine.read("flags[2].X1"), 1.0);
  EXPECT_EQ(machine.read("value"), 41.0);
  machine.write("i", 3.0);
  machine.step();
  EXPECT_EQ(machine.read("points[3].x"), 42.0);
  EXPECT_EQ(machine.read("flags[3].X1"), 0.0);
}

TEST(Arrays, CountAnIndexThatIsOutOfRangeReadZeroThereAndWriteNothing) {
  Simulation machine = Simulation::from_text(project(kArrays, R"(
    { "set": "value", "to": "numbers[i] + 1.0" }, { "set": "points[i].y", "to": 99.0 },
    { "set": "Profile.Point[i].y", "to": 99.0 })"));
  for (const double index : {-32768.0, -2.0, 4.0, 1001.0, 32767.0}) {
    machine.write("i", index);
    const auto before = machine.project().controller->counters().evaluation.indices_out_of_range;
    machine.step();
    EXPECT_EQ(machine.read("value"), 1.0) << index;
    EXPECT_EQ(machine.read("points[1].y"), 5.0);
    EXPECT_EQ(machine.read("points[2].y"), 7.5);
    const std::uint64_t more = index == 4.0 ? 1 : 3;
    EXPECT_EQ(machine.project().controller->counters().evaluation.indices_out_of_range - before, more)
        << index;
    if (index == 4.0) {
      EXPECT_EQ(machine.read("points[4].y"), 99.0);
    }
  }
}

TEST(Arrays, OfTechnologyObjectsTakeComputedIndicesToo) {
  Simulation machine = Simulation::from_text(project(R"("unused": { "type": "BOOL" })", R"(
    { "set": "Profile.Point[i].x", "to": "value" }, { "set": "Profile.ValidPoint[i]", "to": "i > 0" },
    { "set": "value", "to": "Profile.Point[i].x + 1.0" })"));
  machine.step();
  machine.step();
  EXPECT_EQ(machine.read("Profile.Point[2].x"), 2.5);
  EXPECT_EQ(machine.read("Profile.ValidPoint[2]"), 1.0);
  EXPECT_EQ(machine.read("Profile.ValidPoint[1]"), 0.0);
  machine.write("value", 1e13);
  machine.step();
  EXPECT_EQ(machine.read("Profile.Point[2].x"), 1e12) << "the limit of the variable counts";
}

TEST(Arrays, AreSetByStimuliAndWritable) {
  Simulation machine = Simulation::from_text(project(
      kArrays, "", R"(, "stimuli": [ { "at": "1ms", "set": { "points[3].y": 4.5, "numbers[2]": 3 } } ])"));
  machine.run_for(std::chrono::milliseconds(3));
  EXPECT_EQ(machine.read("points[3].y"), 4.5);
  EXPECT_EQ(machine.read("numbers[2]"), 3.0);
  machine.write("points[3].x", 8.0);
  EXPECT_EQ(machine.read("points[3].x"), 8.0);
}

/// All problems, one a line.
std::string problems(const std::string& text) {
  std::string all;
  for (const Problem& problem : load_project(text).problems)
    all += problem.place + ": " + problem.text + "\n";
  return all;
}

TEST(ArrayProblems, AreToldOfTypes) {
  for (const auto& [type, problem] : std::initializer_list<std::pair<const char*, const char*>>{
           {"ARRAY", "is no type of an array; allowed: ARRAY[lower..upper] OF type"},
           {"ARRAY[1..] OF LREAL", "is no type of an array"},
           {"ARRAY[1..2] LREAL", "is no type of an array"},
           {"ARRAY[1.5..2] OF LREAL", "is no type of an array"},
           {"ARRAY[1..99999999999] OF LREAL", "is no type of an array"},
           {"ARRAY[1..2] OF LREEL", "unknown type 'LREEL' of elements (did you mean 'LREAL'?)"},
           {"ARRAY[1..2] OF TO_Cam_Struct_PointDate", "(did you mean 'TO_Cam_Struct_PointData'?)"},
           {"ARRAY[1..2] OF ARRAY[1..2] OF INT", "unknown type 'ARRAY[1..2] OF INT' of elements"},
           {"ARRAY[2..1] OF LREAL", "the upper bound 1 is less than the lower bound 2"},
           {"ARRAY[0..100000] OF BOOL", "has 100001 elements; allowed are 100000"}}) {
    const std::string all = problems(project(std::string(R"("a": { "type": ")") + type + "\" }"));
    EXPECT_EQ(all.find("/tags/a/type: "), 0u) << all;
    EXPECT_NE(all.find(problem), std::string::npos) << type << ": " << all;
  }
  EXPECT_EQ(problems(project(R"("a": { "type": "ARRAY[-2147483648..-2147483640] OF SINT" })")), "");
}

TEST(ArrayProblems, AreToldOfMemoryBeyondAllMachines) {
  std::string tags;
  for (int i = 0; i < 8; ++i)
    tags += (i > 0 ? ", " : "") + std::string("\"a") + std::to_string(i) +
            R"(": { "type": "ARRAY[1..100000] OF TO_Cam_Struct_SegmentData" })";
  EXPECT_NE(problems(project(tags)).find("/tags/a6/type: the arrays of the project take more than 64 MiB"),
            std::string::npos);
}

TEST(ArrayProblems, AreToldOfValues) {
  const auto told = [](const std::string& type, const std::string& init) {
    return problems(project(R"("a": { "type": ")" + type + R"(", "init": )" + init + " }"));
  };
  EXPECT_EQ(told("ARRAY[1..2] OF LREAL", "[1, 2, 3]"),
            "/tags/a/init: there are 3 values; the array has 2 elements\n");
  EXPECT_EQ(told("ARRAY[1..2] OF LREAL", "5").find("/tags/a/init: "), 0u);
  EXPECT_EQ(told("ARRAY[1..2] OF SINT", "[1, 200]").find("/tags/a/init/1: 200 is not allowed here"), 0u);
  const std::string points = "ARRAY[1..2] OF TO_Cam_Struct_PointData";
  EXPECT_EQ(
      told(points, R"([ { "z": 1.0 } ])"),
      "/tags/a/init/0/z: unknown member 'z' of TO_Cam_Struct_PointData (did you mean 'x'?); allowed: x, y\n");
  EXPECT_EQ(
      told(points, "[ [1, 2, 3] ]").find("/tags/a/init/0: there are 3 values; a TO_Cam_Struct_PointData"),
      0u);
  EXPECT_EQ(told(points, "[ 1 ]").find("/tags/a/init/0: "), 0u);
  EXPECT_EQ(told(points, R"([ [ true, 2 ] ])").find("/tags/a/init/0/0: "), 0u);
  EXPECT_EQ(problems(project(R"("a": { "type": "ARRAY[1..2] OF INT", "retain": true, "none": 1 })")),
            "/tags/a/none: unknown key 'none'; allowed: type, init, retain, comment\n");
  const std::string kept = R"(": { "type": "ARRAY[1..3000] OF TO_Cam_Struct_PointData", "retain": true })";
  EXPECT_EQ(problems(project("\"a" + kept + ", \"b" + kept)),
            "/tags/b/retain: with the 6000 values of this tag 12000 values of arrays and texts are kept; "
            "allowed are "
            "10000 in all of the project\n");
}

TEST(ArrayProblems, AreToldOfPlaces) {
  const auto told = [](const std::string& call) { return problems(project(kArrays, call)); };
  const auto set = [&](const std::string& path) { return told(R"({ "set": ")" + path + R"(", "to": 1 })"); };
  const auto get = [&](const std::string& text) {
    return told(R"({ "set": "value", "to": ")" + text + "\" }");
  };
  EXPECT_EQ(
      set("numbers[4]"),
      "/programs/0/calls/0/set: 'numbers' is an ARRAY[-1..3] OF LREAL and has no element [4]; allowed: -1 to "
      "3\n");
  EXPECT_NE(get("numbers[-2]").find("has no element [-2]; allowed: -1 to 3"), std::string::npos);
  EXPECT_NE(get("numbers[2 + 2]").find("has no element [4]"), std::string::npos);
  EXPECT_NE(get("numbers").find("an index has to follow, as in numbers[-1]"), std::string::npos);
  EXPECT_NE(set("numbers").find("an index has to follow"), std::string::npos);
  EXPECT_NE(set("numbers[]").find("/programs/0/calls/0/set: "), std::string::npos);
  EXPECT_NE(get("numbers[]").find("an index"), std::string::npos);
  EXPECT_NE(get("numbers[1].x").find("whose elements have no part '.x'"), std::string::npos);
  EXPECT_NE(get("numbers[1].X0").find("is of type LREAL and has no bits"), std::string::npos);
  EXPECT_NE(get("points[1]").find("one of the members of an element has to follow: x, y"), std::string::npos);
  EXPECT_NE(get("points[i].z").find("whose elements have no member 'z' (did you mean 'x'?); allowed: x, y"),
            std::string::npos);
  EXPECT_NE(get("points[value].x").find("LREAL does not fit where LINT is expected"), std::string::npos);
  EXPECT_NE(set("points[value].x").find("LREAL does not fit where LINT is expected"), std::string::npos);
  EXPECT_NE(get("points[nobody].x").find("unknown name 'nobody'"), std::string::npos);
  EXPECT_NE(get("points[i][i].x").find("only one index may be an expression"), std::string::npos);
  EXPECT_NE(set("i[1]").find("the tag 'i' has no part '[1]'"), std::string::npos);
  EXPECT_NE(problems(project(kArrays, "", R"(, "trace": { "signals": [ "points[].x" ] })"))
                .find("the index is missing in 'points[].x'; allowed: 1 to 4"),
            std::string::npos);
}

TEST(ArrayProblems, AreToldOfPins) {
  const auto told = [](const std::string& array) {
    return problems(project(kArrays, R"({ "fb": "MC_CopyCamData", "name": "copy",
      "in": { "Cam": "Profile", "Execute": true, "NumberOfPoints": 2, "ArrayOfPoints": )" +
                                         array + " } }"));
  };
  EXPECT_EQ(told("\"points\""), "");
  EXPECT_EQ(told("\"parts\""),
            "/programs/0/calls/0/in/ArrayOfPoints: 'parts' is an ARRAY[1..2] OF TO_Cam_Struct_SegmentData; "
            "allowed: "
            "ARRAY[…] OF TO_Cam_Struct_PointData\n");
  EXPECT_NE(told("\"value\"").find("'value' is no array; allowed: the name of a tag of type ARRAY"),
            std::string::npos);
  EXPECT_NE(told("\"poinst\"").find("there is no tag 'poinst' (did you mean 'points'?)"), std::string::npos);
  EXPECT_NE(told("3").find("the name of an array tag"), std::string::npos);
  EXPECT_NE(
      problems(project(kArrays, R"({ "fb": "MC_CopyCamData", "name": "copy", "in": { "Cam": "Profile" } },
                                          { "set": "value", "to": "copy.ArrayOfPoints" })"))
          .find("the pin 'ArrayOfPoints' takes an array and has no value"),
      std::string::npos);
}

TEST(ArrayProblems, WarnOfElementsThatAnArrayDoesNotHave) {
  const auto warned = [](const std::string& pins) {
    std::string all;
    const std::string call =
        R"({ "fb": "MC_CopyCamData", "name": "copy", "in": { "Cam": "Profile", )" + pins + " } }";
    for (const Problem& warning : load_project(project(kArrays, call)).warnings)
      if (warning.place.starts_with("/programs")) all += warning.place + ": " + warning.text + "\n";
    return all;
  };
  EXPECT_EQ(warned(R"("NumberOfPoints": 4, "ArrayOfPoints": "points")"), "");
  EXPECT_EQ(warned(R"("NumberOfPoints": "i", "ArrayOfPoints": "points")"), "");
  EXPECT_EQ(warned(R"("NumberOfPoints": 4, "StartPointArray": "i", "ArrayOfPoints": "points")"), "");
  EXPECT_EQ(
      warned(R"("NumberOfPoints": 4, "StartPointArray": 2, "ArrayOfPoints": "points")"),
      "/programs/0/calls/0/in/NumberOfPoints: 4 from 2 on are more than 'points' has, an ARRAY[1..4] OF "
      "TO_Cam_Struct_PointData; the block will report an error\n");
  EXPECT_EQ(warned(R"("NumberOfSegments": 1)"),
            "/programs/0/calls/0/in/NumberOfSegments: ArrayOfSegments is not given; the block will report an "
            "error\n");
}

// ---- A cam that a program computes
// --------------------------------------------------------------------------------------

TEST(CamData, OfAProgramAreCopiedInterpolatedAndRead) {
  Simulation machine = Simulation::from_text(project(R"(
    "curve": { "type": "ARRAY[0..100] OF TO_Cam_Struct_PointData" }, "k": { "type": "DINT" },
    "ready": { "type": "BOOL" })",
                                                     R"(
    { "if": "k <= 100", "then": [ { "set": "curve[k].x", "to": "TO_LREAL(k) " },
      { "set": "curve[k].y", "to": "0.5 * curve[k].x" }, { "set": "k", "to": "k + 1" } ],
      "else": [ { "set": "ready", "to": true } ]
},
    { "fb": "MC_CopyCamData", "name": "copy", "in": { "Cam": "Profile", "Execute": "ready", "StartPointArray": 0,
      "NumberOfPoints": 101, "ArrayOfPoints": "curve" } },
    { "fb": "MC_InterpolateCam", "name": "make", "in": { "Cam": "Profile", "Execute": "copy.Done" } },
    { "fb": "MC_GetCamFollowingValue", "name": "read",
      "in": { "Cam": "Profile", "Execute": "make.Done", "LeadingValue": 50.0 } })"));
  machine.run_for(std::chrono::milliseconds(102));
  EXPECT_EQ(machine.read("copy.Busy"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X7"), 1.0);
  machine.run_for(std::chrono::milliseconds(10));
  EXPECT_EQ(machine.read("Profile.StatusCam.NumberOfValidPoints"), 101.0);
  EXPECT_EQ(machine.read("read.Value"), 25.0);
  EXPECT_EQ(machine.project().controller->counters().evaluation.indices_out_of_range, 0u);
}

// Point by point, each valid when it is there.
TEST(CamData, AreWrittenByAProgramWithoutACopy) {
  Simulation machine = Simulation::from_text(project(R"("k": { "type": "DINT", "init": 1 })", R"(
    { "if": "k <= 20", "then": [ { "set": "Profile.Point[k].x", "to": "TO_LREAL(k) * 10.0" },
      { "set": "Profile.Point[k].y", "to": "Profile.Point[k].x + value" },
      { "set": "Profile.ValidPoint[k]", "to": true }, { "set": "k", "to": "k + 1" } ], "else": [
      { "set": "Profile.Segment[1].xmin", "to": 300.0 }, { "set": "Profile.Segment[1].xmax", "to": 360.0 },
      { "set": "Profile.Segment[1].a1", "to": 1.0 }, { "set": "Profile.ValidSegment[1]", "to": true },
      { "set": "Profile.InterpolationSettings.InterpolationMode", "to": 0 } ] },
    { "fb": "MC_InterpolateCam", "name": "make", "in": { "Cam": "Profile", "Execute": "Profile.ValidSegment[1]" } })"));
  machine.run_for(std::chrono::milliseconds(30));
  EXPECT_EQ(machine.read("make.Done"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.StartLeadingValue"), 10.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.EndLeadingValue"), 360.0);
  EXPECT_EQ(machine.read("Profile.StatusCam.NumberOfValidPoints"), 20.0);
  const auto& cam = static_cast<Cam&>(*machine.project().controller->objects[0]);
  EXPECT_EQ(cam.function().value(150.0).position, 151.5);
  EXPECT_EQ(cam.function().value(330.0).position, 330.0);
}

// ---- Restart of a cam with start values that a program has changed
// ------------------------------------------------------

TEST(CamData, StartValuesThatAProgramChangesCountWithARestart) {
  const std::string text = R"({ "lockstep": 1, "name": "restart", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Profile": { "type": "TO_Cam", "points": [ [0.0, 0.0], [100.0, 50.0] ] } },
    "tags": { "change": { "type": "BOOL" }, "again": { "type": "BOOL" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "if": "change", "then": [ { "set_start": "Profile.Point[2].y", "to": 80.0 } ] },
      { "fb": "MC_Reset", "name": "reset", "in": { "Axis": "Profile", "Execute": "again", "Restart": true } } ] } ] })";
  Simulation machine = Simulation::from_text(text);
  const auto& cam = static_cast<Cam&>(*machine.project().controller->objects[0]);
  machine.write("change", 1.0);
  machine.step();
  machine.write("change", 0.0);
  machine.step();
  EXPECT_EQ(machine.read("Profile.StatusWord.X3"), 1.0);
  EXPECT_EQ(machine.read("Profile.Point[2].y"), 50.0);
  EXPECT_EQ(cam.function().value(100.0).position, 50.0);
  machine.write("again", 1.0);
  machine.run_for(std::chrono::milliseconds(4));
  EXPECT_EQ(machine.read("reset.Done"), 1.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X3"), 0.0);
  EXPECT_EQ(machine.read("Profile.Point[2].y"), 80.0);
  EXPECT_EQ(cam.function().value(100.0).position, 80.0);
}

// Point by point, as a program writes all else.
TEST(CamData, StartValuesTakeComputedIndicesToo) {
  const std::string text = R"({ "lockstep": 1, "name": "restart", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Profile": { "type": "TO_Cam", "points": [ [0.0, 0.0], [50.0, 9.0], [100.0, 50.0] ] } },
    "tags": { "k": { "type": "INT" }, "change": { "type": "BOOL" }, "again": { "type": "BOOL" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "if": "change", "then": [ { "set_start": "Profile.Point[k + 1].y", "to": "TO_LREAL(k) * 10.0" } ] },
      { "fb": "MC_Reset", "name": "reset", "in": { "Axis": "Profile", "Execute": "again", "Restart": true } } ] } ] })";
  Simulation machine = Simulation::from_text(text);
  machine.write("change", 1.0);
  for (const double k : {0.0, 1.0, 2.0}) {
    machine.write("k", k);
    machine.step();
  }
  const auto out_of_range = [&] {
    return machine.project().controller->counters().evaluation.indices_out_of_range;
  };
  EXPECT_EQ(out_of_range(), 0u);
  for (const double k : {-1.0, 1000.0}) {
    machine.write("k", k);
    machine.step();
  }
  EXPECT_EQ(out_of_range(), 2u) << "counted, and nothing is written";
  machine.write("change", 0.0);
  EXPECT_EQ(machine.read("Profile.Point[3].y"), 50.0);
  EXPECT_EQ(machine.read("Profile.StatusWord.X3"), 1.0);
  machine.write("again", 1.0);
  machine.run_for(std::chrono::milliseconds(4));
  EXPECT_EQ(machine.read("reset.Done"), 1.0);
  EXPECT_EQ(machine.read("Profile.Point[1].y"), 0.0);
  EXPECT_EQ(machine.read("Profile.Point[2].y"), 10.0);
  EXPECT_EQ(machine.read("Profile.Point[3].y"), 20.0);
  EXPECT_EQ(static_cast<Cam&>(*machine.project().controller->objects[0]).function().value(100.0).position,
            20.0);
}

TEST(CamData, StartValuesAtAnIndexThatCannotBeAreToldWhenTheProjectIsLoaded) {
  const auto told = [](const std::string& path) {
    return problems(project(kArrays, R"({ "set_start": ")" + path + R"(", "to": 1.0 })"));
  };
  EXPECT_NE(told("Profile.Point[1001].y").find("/programs/0/calls/0/set_start: "), std::string::npos);
  EXPECT_NE(told("Profile.Point[value].y").find("LREAL does not fit where LINT is expected"),
            std::string::npos);
  EXPECT_NE(told("numbers[i]").find("only variables of technology objects have start values"),
            std::string::npos);
}

}  // namespace
}  // namespace lockstep::array_test
