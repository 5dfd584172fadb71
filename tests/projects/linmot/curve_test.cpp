// Curves by their formulas, from files, and played while somebody changes rate, amplitude and offset.
#include <algorithm>
#include <numbers>

#include "projects/loader/project.hpp"
#include "tests/projects/linmot/linmot_run.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::linmot_curve_test {
namespace {

linmot::Curve curve_of(const std::string& json, std::string* warnings = nullptr) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"]["1"] = Json::parse(json);
  LoadedProject loaded = load_project(project.dump());
  EXPECT_TRUE(loaded.project.has_value()) << json << (loaded.problems.empty() ? "" : loaded.problems[0].text);
  if (warnings != nullptr)
    for (const Problem& warning : loaded.warnings) *warnings += warning.text + "\n";
  if (loaded.project)
    for (const auto& object : loaded.project->controller->objects)
      if (object->kind == ObjectKind::LinMot_Controller)
        return static_cast<LinMotController*>(object.get())->curves[1];
  return {};
}
double at(const linmot::Curve& curve, double time) {
  return curve.function().value(time).position;
}

TEST(LinMotCurve, OfSineIsHalfACosine) {
  const linmot::Curve curve = curve_of(R"({ "type": "Sine", "start": 10, "end": 50, "time": "200ms" })");
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    EXPECT_NEAR(at(curve, 0.2 * s), 10.0 + 20.0 * (1.0 - std::cos(std::numbers::pi * s)), 1e-9) << s;
  }
  const linmot::CurvePeaks peaks = curve.peaks();
  EXPECT_NEAR(peaks.velocity, 0.5 * std::numbers::pi * 0.04 / 0.2, 1e-6);
  EXPECT_NEAR(peaks.acceleration, 0.5 * std::numbers::pi * std::numbers::pi * 0.04 / 0.04, 1e-6);
}

TEST(LinMotCurve, FromPointToPointIsATrapezoid) {
  const linmot::Curve curve =
      curve_of(R"({ "type": "Point To Point", "end": 100, "speed": 0.5, "acceleration": 10 })");
  EXPECT_NEAR(curve.duration(), 0.1 / 0.5 + 0.5 / 10.0, 1e-12);
  EXPECT_NEAR(at(curve, 0.05), 12.5, 1e-9);
  EXPECT_NEAR(at(curve, 0.125), 50.0, 1e-9);
  EXPECT_NEAR(at(curve, 0.20), 87.5, 1e-9);
  EXPECT_NEAR(curve.peaks().velocity, 0.5, 1e-9);
  EXPECT_NEAR(curve.peaks().acceleration, 10.0, 1e-9);
  // Too short for its speed: a triangle.
  const linmot::Curve shorter =
      curve_of(R"({ "type": "Point To Point", "end": 10, "speed": 0.5, "acceleration": 10 })");
  EXPECT_NEAR(shorter.duration(), 2.0 * std::sqrt(0.01 / 10.0), 1e-9);
  EXPECT_NEAR(shorter.peaks().velocity, std::sqrt(0.01 * 10.0), 1e-9);
}

// Without a jerk the acceleration is a triangle, as releases before had it.
TEST(LinMotCurve, OfLimitedJerkWithoutAJerkHasATriangleOfAcceleration) {
  const linmot::Curve curve =
      curve_of(R"({ "type": "Limited Jerk", "end": 100, "speed": 0.8, "acceleration": 20 })");
  EXPECT_NEAR(curve.peaks().jerk, 20.0 * 20.0 / 0.8, 1e-6);
  EXPECT_NEAR(curve.peaks().acceleration, 20.0, 1e-6);
  EXPECT_NEAR(curve.peaks().velocity, 0.8, 1e-9);
  EXPECT_NEAR(curve.duration(), 0.1 / 0.8 + 2.0 * 0.8 / 20.0, 1e-9);  // D/v + T_j, T_j = v/a twice
}

/// The second derivatives of a natural cubic spline, by elimination.
std::vector<double> natural(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> diagonal(n, 1.0), right(n, 0.0), above(n, 0.0), m(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x[i] - x[i - 1], behind = x[i + 1] - x[i];
    const double factor = before / diagonal[i - 1];
    diagonal[i] = 2.0 * (before + behind) - factor * above[i - 1];
    above[i] = behind;
    right[i] = 6.0 * ((y[i + 1] - y[i]) / behind - (y[i] - y[i - 1]) / before) - factor * right[i - 1];
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] = (right[i] - above[i] * m[i + 1]) / diagonal[i];
  return m;
}

TEST(LinMotCurve, ThroughPointsIsANaturalSpline) {
  const std::vector<double> x = {0.0, 0.01, 0.05, 0.06, 0.1}, y = {0.0, 1.0, 4.2, -3.0, 10.0};
  const linmot::Curve curve =
      curve_of(R"({ "type": "Manual", "points": [[0,0],[10,1],[50,4.2],[60,-3],[100,10]] })");
  const std::vector<double> m = natural(x, y);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double h = x[i + 1] - x[i];
    for (int k = 0; k <= 10; ++k) {
      const double t = x[i] + h * k / 10.0, a = x[i + 1] - t, b = t - x[i];
      const double wanted = m[i] * a * a * a / (6.0 * h) + m[i + 1] * b * b * b / (6.0 * h) +
                            (y[i] / h - m[i] * h / 6.0) * a + (y[i + 1] / h - m[i + 1] * h / 6.0) * b;
      EXPECT_NEAR(at(curve, t), wanted, 1e-9) << t;
    }
  }
  // Two points are what replaces a ramp: a line.
  const linmot::Curve line = curve_of(R"({ "points": [[0,0],[100,10]] })");
  for (int k = 0; k <= 10; ++k) EXPECT_NEAR(at(line, 0.01 * k), k, 1e-12);
}

TEST(LinMotCurve, WithFewPointsIsToldOf) {
  std::string warnings;
  curve_of(R"({ "points": [[0,0],[50,1],[100,0]] })", &warnings);
  EXPECT_NE(warnings.find("fewer than 16 points, 3"), std::string::npos) << warnings;
}

// ---- From a file

std::string loaded_with_file(const std::string& csv, linmot::Curve* curve = nullptr) {
  const test::Directory directory;
  directory.write("press.csv", csv);
  Json project = linmot_project("1ms");
  controller_of(project)["curves"]["3"] = {{"file", "press.csv"}};
  const LoadedProject loaded = load_project_file(directory.write("project.json", project.dump()));
  std::string text;
  for (const Problem& problem : loaded.problems) text += problem.place + ": " + problem.text + "\n";
  if (loaded.project && curve != nullptr)
    for (const auto& object : loaded.project->controller->objects)
      if (object->kind == ObjectKind::LinMot_Controller)
        *curve = static_cast<LinMotController*>(object.get())->curves[3];
  return text;
}

TEST(LinMotCurve, ComesFromAFile) {
  linmot::Curve curve;
  EXPECT_EQ(loaded_with_file("ms;mm\n0;0\n10;1\r\n50;4.2\n60;-3\n\n100;10\n", &curve), "");
  ASSERT_TRUE(curve.exists());
  const linmot::Curve same = curve_of(R"({ "points": [[0,0],[10,1],[50,4.2],[60,-3],[100,10]] })");
  EXPECT_EQ(curve.duration(), same.duration());
  for (int k = 0; k <= 100; ++k) EXPECT_EQ(at(curve, 0.001 * k), at(same, 0.001 * k)) << k;
}

// Spreadsheets begin their files with a byte order mark, and end lines with a separator.
TEST(LinMotCurve, OfAFileThatASpreadsheetHasWrittenHasItsFirstPoint) {
  linmot::Curve curve;
  EXPECT_EQ(loaded_with_file("\xEF\xBB\xBF"
                             "0;0\n50;4.2;\r\n100;10; \n",
                             &curve),
            "");
  ASSERT_TRUE(curve.exists());
  EXPECT_EQ(curve.duration(), 0.1);
  EXPECT_EQ(curve.start(), 0.0);
}

TEST(LinMotCurve, NamesTheLineOfAFileThatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"ms;mm\n0;0\n10\n", "press.csv:3: allowed: a time in ms from 0 on and a position in mm"},
      {"0;0\nten;1\n", "press.csv:2: allowed: a time in ms"},
      {"0;0\n10;1\n10;2\n", "press.csv:3: its time is not behind that of the point before"},
      {"0;0\n10;nan\n20;1\n", "press.csv:2: allowed: a time in ms"},
      {"0;0\nnan;1\n20;1\n", "press.csv:2: allowed: a time in ms"},
      {"0;0\n10;1e9\n", "press.csv:2: allowed: a time in ms"},
      {"-1;0\n10;1\n", "press.csv:1: allowed: a time in ms"},
      {"0;0\n100;1,5\n", "press.csv:2: more than a time and a position; allowed: ms;mm with decimal points"},
      {"0;0;0\n100;1;2\n", "press.csv:1: more than a time and a position"},
      {"0;0\n100;1x\n", "press.csv:2: more than a time and a position"},
      {"0;0\n", "that makes no curve"},
      {"", "that makes no curve"},
  };
  for (const auto& [csv, text] : cases) {
    const std::string errors = loaded_with_file(csv);
    EXPECT_NE(errors.find("/technology_objects/C/curves/3"), std::string::npos) << csv << errors;
    EXPECT_NE(errors.find(text), std::string::npos) << csv << "\n" << errors;
  }
  std::string many;
  for (int i = 0; i <= 100'000; ++i) many += std::to_string(i) + ";0\n";
  EXPECT_NE(loaded_with_file(many).find("there are more than 100000 points"), std::string::npos);
}

// ---- Played

Json playing() {
  Json project = linmot_project();
  controller_of(project).erase("motors");
  controller_of(project)["curves"] = Json::parse(
      R"({ "1": { "end": 30.0, "time": "400ms" }, "2": { "start": 10.0, "end": 20.0, "time": "100ms" } })");
  return project;
}

TEST(LinMotCurve, ChangesItsRateInTheMiddleWithoutAStep) {
  LinMotRun run(playing());
  run.start();
  EXPECT_EQ(run.send("!RC1A"), "#");
  run.run(0.2);
  const auto before = run.samples.back();
  EXPECT_EQ(run.send("!DS2048A"), "#");
  const auto now = run.samples.back();
  EXPECT_NEAR(now.velocity, 0.5 * before.velocity, 0.01 * before.velocity);
  EXPECT_NEAR(now.setpoint - before.setpoint, before.velocity * 1e3 * 1e-4, 1e-3);
  // What is left takes twice as long.
  const double from = run.time();
  while (run.motor().CurveActive) run.step();
  EXPECT_NEAR(run.time() - from, 0.4, 0.001);
  EXPECT_EQ(run.motor().SetPoint, 30.0);
  EXPECT_EQ(run.send("!DS0A"), "#");  // stands at its begin
  EXPECT_EQ(run.send("!RC1A"), "#");
  run.run(0.5);
  EXPECT_TRUE(run.motor().CurveActive);
  EXPECT_EQ(run.motor().SetPoint, 0.0);
}

TEST(LinMotCurve, ChangesItsAmplitudeAndOffsetWithTheirSteps) {
  LinMotRun run(playing());
  run.start();
  EXPECT_EQ(run.send("!RC1A"), "#");
  run.run(0.2);
  const double middle = run.motor().SetPoint;
  EXPECT_NEAR(middle, 15.0, 0.05);
  EXPECT_EQ(run.send("!DC2048A"), "#");
  EXPECT_NEAR(run.motor().SetPoint, 0.5 * middle, 0.05);
  EXPECT_EQ(run.send("!DO512A"), "#");
  EXPECT_NEAR(run.motor().SetPoint, 10.0 + 0.5 * middle, 0.05);
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, 10.0 + 15.0, 1e-9);
  // The amplitude is about zero, not about where the curve begins.
  EXPECT_EQ(run.send("!DO0A"), "#");
  EXPECT_EQ(run.send("!RC2A"), "#");
  EXPECT_NEAR(run.motor().SetPoint, 5.0, 1e-9);
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
}

}  // namespace
}  // namespace lockstep::linmot_curve_test
