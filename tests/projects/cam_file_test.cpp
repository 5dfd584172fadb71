// Cam files: every element is read and written without a lost bit, and whatever is wrong has its place.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>

#include "projects/cam_files/file.hpp"
#include "projects/cam_files/table.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cam_file_test {
namespace {

const std::string kCams = LOCKSTEP_SOURCE_DIR "/projects/cams";

LoadedCam loaded(const std::string& text, const std::string& name = "") {
  return load_cam(text, "", name, kCamPoints);
}

std::string told(const LoadedCam& cam) {
  std::string text;
  for (const Problem& problem : cam.problems) text += problem.place + ": " + problem.text + "\n";
  return text;
}

std::string with_elements(const std::string& elements, const std::string& rest = "") {
  return R"({"lockstep_cam": 1, "elements": [)" + elements + "]" + (rest.empty() ? "" : ", " + rest) + "}";
}

constexpr char kEverything[] = R"({
  "lockstep_cam": 1, "name": "Everything", "description": "every element there is", "type": "TO_Cam_10k",
  "interpolation": {"mode": "bezier", "boundary": "free"},
  "optimization": {"continuity": "velocity", "goal": "Cv"},
  "elements": [
    {"type": "point", "x": -50, "y": 0.1, "velocity": 0.25, "acceleration": -0.001, "jerk": 1e-6},
    {"type": "transition", "law": "polynomial", "start_continuity": "jerk", "end_continuity": "velocity",
     "tolerance": 0.5, "comment": "in"},
    {"type": "line", "start": 0, "end": 10, "start_value": 0.3, "slope": 0.7, "comment": "a line"},
    {"type": "transition", "lambda": 0.3, "law": "modified sine"},
    {"type": "line", "start": 20, "end": 25, "end_value": 12, "slope": 0.1},
    {"type": "transition", "lambda_at": 27.3, "law": "inclined sine"},
    {"type": "sine", "start": 30, "end": 90, "amplitude": 3.3, "start_phase": 0, "end_phase": 540, "offset": 11},
    {"type": "transition", "goal": "Ca"},
    {"type": "sine", "start": 100, "end": 130, "amplitude": 1, "period": 17, "end_phase": 90, "start_offset": 4,
     "inclination": 0.05},
    {"type": "transition", "law": "quadratic parabola", "ca": 7.1, "start_continuity": "velocity"},
    {"type": "polynomial", "start": 140, "end": 150, "coefficients": [40, -0.1, 1e-4, 0, 1e-9]},
    {"type": "transition", "method": "system", "comment": "left to the interpolation"},
    {"type": "polynomial", "start": 160, "end": 170, "start_value": 1, "start_velocity": 0, "start_acceleration": 0,
     "start_jerk": 0, "end_value": 4, "end_velocity": 0, "end_acceleration": 0, "end_jerk": 0.01},
    {"type": "polynomial", "start": 175, "end": 180, "start_value": 1, "start_velocity": 0, "end_value": 4,
     "end_velocity": 0.1, "lambda": 0.4, "amplitude": 0.1, "start_phase": 10, "frequency": 0.2},
    {"type": "inverse sine", "start": 200, "end": 240, "lowest": -1, "highest": 7.7, "from": -0.9, "to": 0.5,
     "mirrored": true, "count": 17, "tolerance": 0.9},
    {"type": "point group", "points": [[0, 0], [0.25, 1], [1, 0.5]], "relative_x": true, "relative_y": true,
     "start": 250, "end": 260, "lowest": 2, "highest": 3, "interpolation": "cubic", "mapping": "segments", "count": 4},
    {"type": "point group", "points": [[270, 1.1], [280, 2], [290, 0.3]], "interpolation": "bezier",
     "mapping": "points", "count": 9, "tolerance": 1},
    {"type": "point", "x": 300, "y": 0.1},
    {"type": "transition", "law": "sine-line combination", "ca": 30.5, "ca_star": 40.5, "start_continuity": "velocity",
     "end_continuity": "position"},
    {"type": "point", "x": 320, "y": 5.1}
  ],
  "checks": {"leading_range": [-50, 320], "following_range": [-100, 100], "leading_velocity": 1.5, "max_velocity": 100,
    "max_acceleration": 1e6, "max_jerk": 1e9, "suitability": true, "continuity": "position", "cyclic": true}
})";

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same_data(const DesignedCam& a, const DesignedCam& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    EXPECT_TRUE(same_bits(a.points[i].x, b.points[i].x) && same_bits(a.points[i].y, b.points[i].y)) << i;
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    const auto& s = a.segments[i];
    const auto& t = b.segments[i];
    for (const auto& [left, right] : {std::pair{s.xmin, t.xmin},
                                      {s.xmax, t.xmax},
                                      {s.a0, t.a0},
                                      {s.a1, t.a1},
                                      {s.a2, t.a2},
                                      {s.a3, t.a3},
                                      {s.a4, t.a4},
                                      {s.a5, t.a5},
                                      {s.a6, t.a6},
                                      {s.sineAmplitude, t.sineAmplitude},
                                      {s.sinePeriod, t.sinePeriod},
                                      {s.sinePhase, t.sinePhase}})
      EXPECT_EQ(left, right) << i;
  }
  EXPECT_EQ(a.interpolation.InterpolationMode, b.interpolation.InterpolationMode);
  EXPECT_EQ(a.interpolation.BoundaryConditions, b.interpolation.BoundaryConditions);
}

TEST(CamFile, EveryElementGoesThroughAFileWithoutALostBit) {
  const LoadedCam first = loaded(kEverything);
  ASSERT_TRUE(first.definition) << told(first);
  const CamDefinition& cam = *first.definition;
  EXPECT_EQ(cam.design.elements.size(), 13u);
  EXPECT_EQ(cam.capacity, kCam10kPoints);
  const std::string text = cam_document(cam, false);
  const LoadedCam again = loaded(text);
  ASSERT_TRUE(again.definition) << told(again) << text;
  EXPECT_EQ(cam_document(*again.definition, false), text);
  expect_same_data(cam.cam, again.definition->cam);
  for (const char* key : {"velocity",
                          "acceleration",
                          "jerk",
                          "start_continuity",
                          "end_continuity",
                          "tolerance",
                          "comment",
                          "slope",
                          "lambda",
                          "lambda_at",
                          "amplitude",
                          "start_phase",
                          "end_phase",
                          "offset",
                          "goal",
                          "period",
                          "start_offset",
                          "inclination",
                          "ca",
                          "ca_star",
                          "coefficients",
                          "start_jerk",
                          "end_jerk",
                          "frequency",
                          "lowest",
                          "highest",
                          "from",
                          "to",
                          "mirrored",
                          "count",
                          "relative_x",
                          "relative_y",
                          "interpolation",
                          "mapping",
                          "leading_range",
                          "following_range",
                          "leading_velocity",
                          "max_velocity",
                          "max_acceleration",
                          "max_jerk",
                          "suitability",
                          "continuity",
                          "cyclic"})
    EXPECT_NE(text.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
  EXPECT_NE(text.find("left to the interpolation"), std::string::npos)
      << "the comment of a transition by the system";
}

TEST(CamFile, TheDataBlockGoesThroughJsonAndTablesWithoutALostBit) {
  const LoadedCam first = loaded(kEverything);
  ASSERT_TRUE(first.definition);
  for (const std::string& text :
       {cam_document(*first.definition, true), cam_element_table(*first.definition, ','),
        cam_element_table(*first.definition, '\t')}) {
    const LoadedCam again = load_cam(text, "", "", kCam10kPoints);
    ASSERT_TRUE(again.definition) << told(again);
    expect_same_data(first.definition->cam, again.definition->cam);
  }
}

TEST(CamFile, RandomDataBlocksGoThroughTablesWithoutALostBit) {
  std::mt19937_64 random(test::seed_of_test(1));
  std::uniform_real_distribution<double> value(-1e3, 1e3);
  CamDefinition definition;
  for (int i = 0; i < 500; ++i)
    definition.cam.points.push_back({i + 0.3 * value(random) / 1e3, value(random) / 7.0});
  definition.design.interpolation = definition.cam.interpolation = {1, 0};
  for (const char separator : {',', '\t'}) {
    const LoadedCam again = loaded(cam_element_table(definition, separator));
    ASSERT_TRUE(again.definition) << told(again);
    expect_same_data(definition.cam, again.definition->cam);
  }
}

TEST(CamFile, APointListHasRowsOfTwoToFiveNumbersAndPerhapsAHeader) {
  for (const char* text :
       {"0,0\n90,45\n180,90\n", "x,y\r\n0,0\r\n90,45\r\n180,90\r\n", "0\t0\t1\n90\t45\t1\n180\t90\t1",
        "x,y,v,a,j\n0, 0,1,0,0\n90 ,45,1,0,0\n180,90,1,0,0\n\n"}) {
    const LoadedCam cam = loaded(text);
    ASSERT_TRUE(cam.definition) << told(cam);
    ASSERT_EQ(cam.definition->cam.points.size(), 3u);
    EXPECT_EQ(cam.definition->cam.points[1].y, 45.0);
    EXPECT_NEAR(cam.definition->cam.function->value(45.0).position, 22.5, 1e-12);
  }
}

TEST(CamFile, BrokenTablesAreToldAllAtOnceWithLineAndColumn) {
  const LoadedCam cam = loaded("0,0\n10,zwei\n20\n30,1,2,3,4,5\n40,1e13\n50,nan\n");
  EXPECT_FALSE(cam.definition);
  EXPECT_EQ(told(cam),
            "2:4: 'zwei' is not allowed here; allowed: a number from -1e12 to 1e12, such as 1.5\n"
            "3:1: the row has 1 values; allowed: x,y and perhaps velocity, acceleration and jerk\n"
            "4:12: the row has 6 values; allowed: x,y and perhaps velocity, acceleration and jerk\n"
            "5:4: '1e13' is not allowed here; allowed: a number from -1e12 to 1e12, such as 1.5\n"
            "6:4: 'nan' is not allowed here; allowed: a number from -1e12 to 1e12, such as 1.5\n");
  const LoadedCam elements = loaded("I,3,0\nP,1\nX,1,2\nS,10,5,0,0,0,0,0,0,0,0,0,0\nS,1\n");
  EXPECT_EQ(told(elements),
            "1:3: '3' is not allowed here; allowed: 0 to 2\n"
            "2:3: the row has 2 values; allowed: P,x,y\n"
            "3:1: a row of elements begins with 'X'; allowed: P for a point, S for a segment, I for the "
            "interpolation\n"
            "5:3: the row has 2 values; allowed: "
            "S,xmin,xmax,a0,a1,a2,a3,a4,a5,a6,sineAmplitude,sinePeriod,sinePhase and perhaps origin\n");
  EXPECT_EQ(told(loaded("P,0,0\nS,10,5,0,0,0,0,0,0,0,0,0,0\n")), "2:1: 5 is not above xmin, 10\n");
  EXPECT_EQ(told(loaded("")),
            "1:1: the file is empty; a cam is a JSON object or a table of points or elements\n");
  EXPECT_EQ(told(loaded("x,y\n")), "1:1: the file has no points and no segments\n");
}

TEST(CamFile, BrokenJsonIsToldAllAtOnceWithItsPointer) {
  const LoadedCam cam = loaded(with_elements(R"(
      {"type": "lin", "start": 0},
      {"type": "line", "start": 0, "end": "x", "start_value": 0, "sloop": 1},
      {"type": "transition"}, {"type": "transition"},
      {"start": 1},
      {"type": "polynomial", "start": 0, "end": 1, "coefficients": [], "period": 3},
      {"type": "transition", "method": "system", "law": "sine"},
      {"type": "transition", "law": "sinus"})",
                                             R"("checks": {"max_jerk": 1}, "points": [], "nmae": "A")"));
  EXPECT_FALSE(cam.definition);
  const std::string text = told(cam);
  for (const char* line :
       {"/elements/0/type: 'lin' is not allowed here (did you mean 'line'?)",
        "/elements/1/end: 'x' is not allowed here; allowed: a number",
        "/elements/1/sloop: unknown key 'sloop'; allowed: type, comment, start",
        "/elements/3: a transition has to stand between two elements",
        "/elements/4: the key 'type' is missing",
        "/elements/5/coefficients: an array is not allowed here; allowed: 1 to 7 numbers",
        "/elements/5: the key 'amplitude' is missing",
        "/elements/6/law: 'law' has no meaning with the method 'system'",
        "/elements/7/law: 'sinus' is not allowed here", "/checks/max_jerk: needs the key 'leading_velocity'",
        "/points: is not allowed beside elements", "/nmae: unknown key 'nmae' (did you mean 'name'?)"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nis not in\n" << text;
}

TEST(CamFile, ASyntaxErrorHasLineAndColumn) {
  EXPECT_EQ(told(loaded("{\n  \"lockstep_cam\": 1,\n  \"elements\": [}\n")).substr(0, 6), "3:16: ");
}

TEST(CamFile, WhatTheDesignFindsHasThePointerOfTheMember) {
  const LoadedCam cam = loaded(with_elements(R"(
      {"type": "line", "start": 0, "end": 60, "start_value": 0, "slope": 0},
      {"type": "transition", "law": "harmonic combination"},
      {"type": "line", "start": 100, "end": 160, "start_value": 50, "slope": 0})"));
  EXPECT_EQ(cam.problems.size(), 1u);
  EXPECT_EQ(cam.problems[0].place, "/elements/1/law");
  const LoadedCam range =
      loaded(with_elements(R"({"type": "line", "start": 0, "end": -1, "start_value": 0, "slope": 0})"));
  EXPECT_EQ(told(range), "/elements/0/end: -1 is not above the start, 0\n");
  const LoadedCam data =
      loaded(R"({"lockstep_cam": 1, "points": [[0, 0]], "segments": [{"xmin": 5, "xmax": 5}]})");
  EXPECT_EQ(told(data), "/segments/0/xmax: 5 is not above xmin, 5\n");
}

constexpr char kProject[] = R"({"lockstep": 1, "technology_objects": {
  "Knife": {"type": "TO_SynchronousAxis"},
  "Profile": {"type": "TO_Cam", "points": [[0.0, 0.0], [180.0, 50.0], [360.0, 0.0]],
    "config": {"InterpolationSettings": {"InterpolationMode": 1, "BoundaryConditions": 1}}},
  "Feeder": {"type": "TO_Cam_10k", "elements": [
    {"type": "line", "start": 0, "end": 60, "start_value": 0, "slope": 0}, {"type": "transition"},
    {"type": "line", "start": 100, "end": 160, "start_value": 50, "slope": 0}]},
  "Beside": {"type": "TO_Cam", "file": "feeder.cam.json"},
  "Missing": {"type": "TO_Cam", "file": "missing.json"}}})";

TEST(CamFile, ACamOfAProjectIsFoundByItsName) {
  const LoadedCam profile = loaded(kProject, "profile");
  ASSERT_TRUE(profile.definition) << told(profile);
  EXPECT_EQ(profile.definition->cam.interpolation.BoundaryConditions, 1);
  EXPECT_NEAR(profile.definition->cam.function->value(180.0).position, 50.0, 1e-12);
  const LoadedCam feeder = loaded(kProject, "Feeder");
  ASSERT_TRUE(feeder.definition) << told(feeder);
  EXPECT_EQ(feeder.definition->capacity, kCam10kPoints);
  EXPECT_EQ(feeder.definition->cam.segments.size(), 3u);
  const LoadedCam beside = load_cam(kProject, kCams, "Beside", kCamPoints);
  ASSERT_TRUE(beside.definition) << told(beside);
  EXPECT_EQ(beside.definition->cam.segments.size(), 12u);
  EXPECT_NE(told(load_cam(kProject, kCams, "Missing", kCamPoints))
                .find("/technology_objects/Missing/file: cannot be read"),
            std::string::npos);
  EXPECT_EQ(told(loaded(kProject, "Feder")),
            "/technology_objects: the project has no cam 'Feder' (did you mean 'Feeder'?); it has: Profile, "
            "Feeder, "
            "Beside, Missing\n");
  EXPECT_NE(told(loaded(kProject)).find("name one of its cams with --cam"), std::string::npos);
  EXPECT_NE(told(loaded("0,0\n1,1\n", "Feeder")).find("--cam"), std::string::npos);
}

TEST(CamFile, AProjectsCamMayBeEmptyUntilTheProgramFillsIt) {
  for (const auto& [text, problems] : {std::pair{"{}", 0u},
                                       {R"({"points": [[1, 2]]})", 0u},
                                       {R"({"points": [[1]]})", 1u},
                                       {R"({"segments": [{"xmin": 1, "xmax": 0}]})", 1u},
                                       {R"({"elements": []})", 1u}}) {
    const JsonDocument document(text);
    CamDefinition definition;
    Problems found;
    read_cam_definition(document.root(), "", "", CamWithoutCurve::allowed, definition, found);
    EXPECT_EQ(found.count(), problems) << text;
    if (problems == 0) {
      EXPECT_FALSE(definition.cam.function) << text;
    }
  }
}

TEST(CamFile, EveryExampleIsValid) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kCams)) {
    const LoadedCam cam = load_cam_file(entry.path().string(), "", kCamPoints);
    EXPECT_TRUE(cam.definition) << entry.path() << "\n" << told(cam);
    EXPECT_TRUE(cam.warnings.empty()) << entry.path();
    ++found;
  }
  EXPECT_GE(found, 3);
}

// Files cut short and with bytes changed end in problems or a cam with a curve, never in anything else.
TEST(CamFile, DamagedFilesEndInProblemsOrACurve) {
  const LoadedCam whole = loaded(kEverything);
  const std::string texts[] = {kEverything, cam_document(*whole.definition, true),
                               cam_element_table(*whole.definition, ',')};
  constexpr char kBytes[] = "0123456789eE+-.,:{}[]\"\t\n truefalsnPSI\xff";
  test::for_each_seed(1, test::cases(600, 60'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::string text = texts[one.seed % 3];
    for (auto changes = random() % 4; changes > 0; --changes)
      text[random() % text.size()] = kBytes[random() % (sizeof kBytes - 1)];
    if (random() % 3 == 0) text.resize(random() % text.size());
    const LoadedCam cam = load_cam(text, "", "", kCam10kPoints);
    EXPECT_NE(cam.definition.has_value(), !cam.problems.empty());
    if (!cam.definition) return;
    ASSERT_TRUE(cam.definition->cam.function);
    const CamFunction& f = *cam.definition->cam.function;
    for (int k = 0; k <= 20; ++k)
      EXPECT_TRUE(std::isfinite(
          f.value(f.start_leading_value() + (f.end_leading_value() - f.start_leading_value()) * k / 20.0)
              .position));
  });
}

}  // namespace
}  // namespace lockstep::cam_file_test
