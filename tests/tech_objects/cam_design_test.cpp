// Cams from elements and transitions: what each takes of the data block, how they join, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tech_objects/cam_design/design.hpp"
#include "tech_objects/cam_design/design_check.hpp"
#include "tech_objects/cam_object/segment_data.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cam_design_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

CamElement element(CamShape shape) {
  return {std::move(shape), "", std::nullopt, ""};
}

CamElement followed_by(CamShape shape, MotionLawKind law) {
  CamElement result = element(std::move(shape));
  result.transition.emplace();
  result.transition->law = law;
  return result;
}

CamLine dwell(double start, double end, double value) {
  return {start, end, value, value, {}};
}

CamLine sloped(double start, double end, double value, double slope) {
  return {start, end, value, {}, slope};
}

CamDesign design_of(std::vector<CamElement> elements) {
  CamDesign design;
  design.elements = std::move(elements);
  return design;
}

std::string told(const DesignedCam& cam) {
  std::string text;
  for (const CamFinding& problem : cam.problems)
    text += std::to_string(problem.element) + (problem.transition ? "t " : " ") + std::string(problem.field) +
            ": " + problem.text + "\n";
  return text;
}

DesignedCam made(const CamDesign& design, std::size_t capacity = kCamPoints) {
  DesignedCam cam = design_cam(design, capacity);
  EXPECT_TRUE(cam.function) << told(cam);
  return cam;
}

bool has_problem(const DesignedCam& cam, std::size_t index, bool transition, std::string_view field,
                 std::string_view text) {
  return !cam.function && std::ranges::any_of(cam.problems, [&](const CamFinding& problem) {
    return problem.element == index && problem.transition == transition && problem.field == field &&
           problem.text.find(text) != std::string::npos;
  });
}

TEST(CamDesign, ALineByAnyTwoOfItsThreeValuesIsTheSameSegment) {
  for (const CamLine& line : {CamLine{60.0, 180.0, 10.0, 40.0, {}}, CamLine{60.0, 180.0, 10.0, {}, 0.25},
                              CamLine{60.0, 180.0, {}, 40.0, 0.25}}) {
    const DesignedCam cam = made(design_of({element(line)}));
    ASSERT_EQ(cam.segments.size(), 1u);
    EXPECT_TRUE(cam.points.empty());
    EXPECT_EQ(cam.segments[0].a1, 0.25);
    EXPECT_EQ(cam.segments[0].a0, 10.0);
    EXPECT_EQ(cam.segments[0].Origin, 60.0);
    EXPECT_EQ(cam.function->value(180.0).position, 40.0);
  }
}

TEST(CamDesign, ASineByAnyOfItsFiveDefinitionsIsTheSameCurve) {
  const CamWave waves[] = {{10.0, 90.0, 450.0, {}, {}},
                           {10.0, 90.0, {}, 120.0, {}},
                           {10.0, 90.0, {}, {}, 1.0 / 120.0},
                           {10.0, {}, 450.0, 120.0, {}},
                           {10.0, {}, 450.0, {}, 1.0 / 120.0}};
  for (const CamWave& wave : waves) {
    CamSine sine{30.0, 150.0, wave, 5.0, {}, {}, {}};
    const DesignedCam cam = made(design_of({element(sine)}));
    ASSERT_EQ(cam.segments.size(), 1u);
    for (double x = 30.0; x <= 150.0; x += 7.5)
      EXPECT_NEAR(cam.function->value(x).position, 5.0 + 10.0 * std::cos(2.0 * kPi * (x - 30.0) / 120.0),
                  1e-12);
  }
}

TEST(CamDesign, AnInclinedSineSwingsAboutALineByAnyTwoOfItsValues) {
  const CamWave wave{2.0, 0.0, 360.0, {}, {}};
  for (const CamSine& sine :
       {CamSine{0.0, 100.0, wave, {}, 1.0, 6.0, {}}, CamSine{0.0, 100.0, wave, {}, 1.0, {}, 0.05},
        CamSine{0.0, 100.0, wave, {}, {}, 6.0, 0.05}}) {
    const DesignedCam cam = made(design_of({element(sine)}));
    for (double x = 0.0; x <= 100.0; x += 5.0)
      EXPECT_NEAR(cam.function->value(x).position, 1.0 + 0.05 * x + 2.0 * std::sin(2.0 * kPi * x / 100.0),
                  1e-12);
  }
}

TEST(CamDesign, APolynomialTakesCoefficientsOfTheLeadingValueItselfAndASineOnTop) {
  CamPolynomial polynomial;
  polynomial.start = 2.0;
  polynomial.end = 6.0;
  polynomial.coefficients = {1.0, -2.0, 0.5, 0.0, 0.01, 0.0, 0.001};
  polynomial.wave = CamWave{0.5, 0.0, 180.0, {}, {}};
  const DesignedCam cam = made(design_of({element(polynomial)}));
  ASSERT_EQ(cam.segments.size(), 1u);
  EXPECT_EQ(cam.segments[0].a6, 0.001);
  for (double x = 2.0; x <= 6.0; x += 0.25)
    EXPECT_NEAR(cam.function->value(x).position,
                1.0 - 2.0 * x + 0.5 * x * x + 0.01 * std::pow(x, 4) + 0.001 * std::pow(x, 6) +
                    0.5 * std::sin(kPi * (x - 2.0) / 4.0),
                1e-12);
}

TEST(CamDesign, APolynomialOfDegreeSevenIsTwoSegmentsThatMeetItAsTheDecisionSays) {
  CamPolynomial polynomial;
  polynomial.start = 20.0;
  polynomial.end = 30.0;
  polynomial.start_value = 1.0;
  polynomial.start_velocity = 0.5;
  polynomial.start_acceleration = -0.25;
  polynomial.start_jerk = 0.125;
  polynomial.end_value = 9.0;
  polynomial.end_velocity = 0.25;
  polynomial.end_acceleration = 0.5;
  polynomial.end_jerk = -0.5;
  for (const bool with_sine : {false, true}) {
    if (with_sine) polynomial.wave = CamWave{0.3, 20.0, 100.0, {}, {}};
    const DesignedCam cam = made(design_of({element(polynomial)}));
    ASSERT_EQ(cam.segments.size(), 2u);
    EXPECT_EQ(cam.segments[0].xmax, 25.0);
    EXPECT_EQ(cam.segments[1].xmin, 25.0);
    const auto& curve = cam.stretches[0].curve;
    EXPECT_NEAR(curve(20.0).jerk, 0.125, 1e-9);
    EXPECT_NEAR(curve(30.0).jerk, -0.5, 1e-9);
    for (const auto& [segment, x, orders] :
         {std::tuple{0, 20.0, 3}, {0, 25.0, 2}, {1, 25.0, 2}, {1, 30.0, 3}}) {
      const MotionValue value = curve(x);
      const double wanted[] = {value.position, value.velocity, value.acceleration, value.jerk};
      const CamSegment seen = shifted(cam.segments[segment], x);
      for (int order = 0; order <= orders; ++order)
        EXPECT_NEAR(seen.derivative(order, 0.0), wanted[order], 1e-9) << segment << ' ' << x << ' ' << order;
    }
    EXPECT_GT(cam.stretches[0].deviation, 1e-4) << "figures before and after the mapping differ";
    EXPECT_LT(cam.stretches[0].deviation, 0.1);
  }
}

TEST(CamDesign, AnInverseSineIsTheArcsineAsPoints) {
  CamInverseSine inverse{10.0, 50.0, 0.0, 90.0, false, -0.5, 1.0, 33, {}};
  DesignedCam cam = made(design_of({element(inverse)}));
  EXPECT_EQ(cam.points.size(), 33u);
  const auto wanted = [](double x) {
    const double low = std::asin(-0.5);
    return 90.0 * (std::asin(-0.5 + 1.5 * (x - 10.0) / 40.0) - low) / (std::asin(1.0) - low);
  };
  for (const auto& point : cam.points) EXPECT_NEAR(point.y, wanted(point.x), 1e-12) << point.x;
  const auto& curve = cam.stretches[0].curve;
  for (double x = 12.0; x < 48.0; x += 3.0) {  // derivatives against differences
    const double h = 1e-3;
    EXPECT_NEAR(curve(x).velocity, (curve(x + h).position - curve(x - h).position) / (2 * h), 1e-4);
    EXPECT_NEAR(curve(x).acceleration, (curve(x + h).velocity - curve(x - h).velocity) / (2 * h), 1e-4);
    EXPECT_NEAR(curve(x).jerk, (curve(x + h).acceleration - curve(x - h).acceleration) / (2 * h), 1e-3);
  }
  inverse.mirrored = true;
  cam = made(design_of({element(inverse)}));
  EXPECT_NEAR(cam.function->value(10.0).position, 90.0, 1e-12);
  EXPECT_NEAR(cam.function->value(50.0).position, 0.0, 1e-12);
}

TEST(CamDesign, APointGroupKeepsItsCurveAsPointsOrAsSegments) {
  CamPointGroup group;
  group.points = {{0.0, 0.0}, {20.0, 15.0}, {35.0, 5.0}, {60.0, 30.0}};
  group.count = 4;
  DesignedCam cam = made(design_of({element(group)}));
  ASSERT_EQ(cam.points.size(), 4u);
  EXPECT_EQ(cam.points[2].x, 35.0);
  EXPECT_LT(cam.stretches[0].deviation, 1e-12) << "as many points as the group has are its own";
  group.as_segments = true;
  cam = made(design_of({element(group)}));
  EXPECT_EQ(cam.segments.size(), 3u);
  EXPECT_LT(cam.stretches[0].deviation, 1e-10) << "a cubic spline is a segment between its points";
  for (const bool bezier : {false, true}) {
    group.bezier = bezier;
    group.count = 32;
    cam = made(design_of({element(group)}));
    EXPECT_EQ(cam.segments.size(), 31u);
    EXPECT_LT(cam.stretches[0].deviation, 0.01);
    EXPECT_TRUE(std::ranges::all_of(joints_of(*cam.function, false), [](const CamJoint& joint) {
      return joint.keeps >= Continuity::acceleration;
    }));
    group.as_segments = false;
    cam = made(design_of({element(group)}));
    EXPECT_EQ(cam.points.size(), 32u);
    EXPECT_LT(cam.stretches[0].deviation, 0.05);
    group.as_segments = true;
  }
}

TEST(CamDesign, APointGroupMayBeRelativeToItsRange) {
  CamPointGroup group;
  group.points = {{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.25}};
  group.relative_x = group.relative_y = true;
  group.start = 100.0;
  group.end = 200.0;
  group.lowest = -10.0;
  group.highest = 30.0;
  group.count = 3;
  const DesignedCam cam = made(design_of({element(group)}));
  EXPECT_EQ(cam.points[1].x, 150.0);
  EXPECT_EQ(cam.points[1].y, 30.0);
  EXPECT_NEAR(cam.points[2].y, 0.0, 1e-12);
}

TEST(CamDesign, TakesOfTheDataBlockWhatTheConsumptionTableSays) {
  using enum MotionLawKind;
  struct Row {
    MotionLawKind law;
    bool from_dwell, to_dwell;
    std::optional<double> lambda;
    std::size_t segments;
  };
  const Row rows[] = {{sine, true, true, {}, 1},
                      {sine, true, true, 0.4, 2},
                      {inclined_sine, true, true, {}, 1},
                      {inclined_sine, true, true, 0.4, 2},
                      {polynomial, true, true, {}, 1},
                      {polynomial, true, true, 0.4, 2},
                      {modified_acceleration_trapezoid, true, true, {}, 6},
                      {modified_sine, true, true, {}, 3},
                      {modified_sine, false, false, {}, 4},
                      {modified_sine, false, true, {}, 4},
                      {modified_sine, true, false, {}, 4},
                      {sine_line_combination, true, true, {}, 3},
                      {quadratic_parabola, true, true, {}, 2},
                      {line, true, true, {}, 1}};
  for (const Row& row : rows) {
    CamElement first =
        followed_by(row.from_dwell ? dwell(0.0, 60.0, 0.0) : sloped(0.0, 60.0, 0.0, 0.125), row.law);
    first.transition->lambda = row.lambda;
    const DesignedCam cam = made(design_of(
        {first, element(row.to_dwell ? dwell(180.0, 240.0, 50.0) : sloped(180.0, 240.0, 50.0, 0.25))}));
    ASSERT_EQ(cam.stretches.size(), 3u);
    EXPECT_EQ(cam.stretches[1].segments, row.segments) << motion_law_name(row.law);
    EXPECT_EQ(cam.stretches[1].points, 0u);
    EXPECT_EQ(cam.segments.size(), 2 + row.segments);
  }
}

// The rows without two dwells or slopes beside a law, and those of elements.
TEST(CamDesign, TakesOfTheDataBlockWhatTheConsumptionTableSaysBesideReversalsAndOfElements) {
  using enum MotionLawKind;
  const CamPointElement rest{0.0, 0.0, {}, {}, {}};
  const CamPointElement rest_behind{100.0, 50.0, {}, {}, {}};
  const CamPointElement reversal{0.0, 0.0, 0.0, 0.02, {}};
  const CamPointElement reversal_behind{100.0, 50.0, 0.0, -0.02, {}};
  struct Law {
    MotionLawKind law;
    bool from_rest;
    std::size_t points, segments;
  };
  for (const Law& row :
       {Law{harmonic_combination, true, 0, 3}, Law{harmonic_combination, false, 0, 3},
        Law{double_harmonic_transition, true, 32, 0}, Law{double_harmonic_transition, false, 32, 0},
        Law{modified_acceleration_trapezoid, true, 0, 5},
        Law{modified_acceleration_trapezoid, false, 0, 5}}) {
    const DesignedCam cam = made(design_of({followed_by(row.from_rest ? rest : reversal, row.law),
                                            element(row.from_rest ? reversal_behind : rest_behind)}));
    EXPECT_EQ(cam.points.size(), row.points) << motion_law_name(row.law) << row.from_rest;
    EXPECT_EQ(cam.segments.size(), row.segments) << motion_law_name(row.law) << row.from_rest;
  }
  for (const MotionLawKind law : {sine, inclined_sine, polynomial}) {
    CamElement first = followed_by(dwell(0.0, 60.0, 0.0), law);
    first.transition->lambda = 0.5;
    const DesignedCam cam = made(design_of({first, element(dwell(180.0, 240.0, 50.0))}));
    EXPECT_EQ(cam.segments.size(), 3u) << motion_law_name(law) << ": 0.5 is where it is anyway";
  }
  CamPolynomial flat;
  flat.start = 0.0;
  flat.end = 100.0;
  flat.start_value = flat.start_velocity = flat.start_acceleration = 0.0;
  flat.end_value = 50.0;
  flat.end_velocity = flat.end_acceleration = 0.0;
  CamPolynomial seventh = flat;
  seventh.start_jerk = seventh.end_jerk = 0.0;
  CamPointGroup group;
  for (int i = 0; i < 5; ++i) group.points.push_back({25.0 * i, 10.0 * (i % 2)});
  CamPointGroup segments = group;
  segments.as_segments = true;
  struct Row {
    CamShape shape;
    std::size_t points, segments;
  };
  const Row rows[] = {{group, 32, 0},
                      {segments, 0, 31},
                      {sloped(0.0, 100.0, 0.0, 1.0), 0, 1},
                      {CamSine{0.0, 100.0, {1.0, 0.0, 360.0, {}, {}}, 0.0, {}, {}, {}}, 0, 1},
                      {flat, 0, 1},
                      {seventh, 0, 2},
                      {CamInverseSine{0.0, 100.0, 20.0, 80.0, false, -0.8, 0.8, 32, {}}, 32, 0}};
  for (const Row& row : rows) {
    const DesignedCam cam = made(design_of({element(row.shape)}));
    EXPECT_EQ(cam.points.size(), row.points) << cam_shape_name(row.shape);
    EXPECT_EQ(cam.segments.size(), row.segments) << cam_shape_name(row.shape);
  }
  const DesignedCam cam = made(design_of({element(rest), element(rest_behind)}));
  EXPECT_EQ(cam.points.size(), 2u);
  EXPECT_TRUE(cam.segments.empty()) << "the transition is left to the interpolation";
}

TEST(CamDesign, PointsAtALawTakeNothingAndALawOfTwoSinesBecomesPoints) {
  using enum MotionLawKind;
  const CamPointElement rest{0.0, 0.0, {}, {}, {}};
  CamPointElement reversal{100.0, 50.0, 0.0, -0.02, {}};
  DesignedCam cam = made(design_of({followed_by(rest, harmonic_combination), element(reversal)}));
  EXPECT_TRUE(cam.points.empty());
  EXPECT_EQ(cam.segments.size(), 3u);
  cam = made(design_of({followed_by(reversal, modified_acceleration_trapezoid),
                        element(CamPointElement{200.0, 0.0, {}, {}, {}})}));
  EXPECT_EQ(cam.segments.size(), 5u);
  cam = made(design_of({followed_by(rest, modified_acceleration_trapezoid), element(reversal)}));
  EXPECT_EQ(cam.segments.size(), 5u);
  cam = made(design_of({followed_by(rest, double_harmonic_transition), element(reversal)}));
  EXPECT_EQ(cam.points.size(), 32u);
  EXPECT_TRUE(cam.segments.empty());
  CamElement first = followed_by(rest, double_harmonic_transition);
  first.transition->count = 8;
  first.transition->tolerance = 0.01;
  cam = made(design_of({first, element(reversal)}));
  EXPECT_EQ(cam.points.size(), 8u);
  ASSERT_EQ(cam.warnings.size(), 1u);
  EXPECT_EQ(cam.warnings[0].field, "tolerance");
  EXPECT_GT(cam.stretches[1].deviation, 0.01);
}

TEST(CamDesign, AnInverseSineBehindALawGivesItsFirstPointToIt) {
  const CamInverseSine inverse{100.0, 200.0, 20.0, 80.0, false, -0.8, 0.8, 32, {}};
  DesignedCam cam =
      made(design_of({followed_by(dwell(0.0, 50.0, 0.0), MotionLawKind::polynomial), element(inverse)}));
  EXPECT_EQ(cam.points.size(), 31u);
  EXPECT_EQ(cam.segments.size(), 2u);
  cam = made(design_of({element(dwell(0.0, 50.0, 0.0)), element(inverse)}));
  EXPECT_EQ(cam.points.size(), 32u);
}

TEST(CamDesign, SystemInterpolationTakesNothingAndClosesTheGap) {
  const DesignedCam cam =
      made(design_of({element(dwell(0.0, 50.0, 0.0)), element(CamPointElement{75.0, 10.0, {}, {}, {}}),
                      element(dwell(100.0, 150.0, 30.0))}));
  EXPECT_EQ(cam.points.size(), 1u);
  EXPECT_EQ(cam.segments.size(), 2u);
  EXPECT_EQ(cam.stretches.size(), 3u);
  EXPECT_NEAR(cam.function->value(75.0).position, 10.0, 1e-12);
  for (const CamJoint& joint : joints_of(*cam.function, false)) EXPECT_GE(joint.keeps, Continuity::velocity);
}

// Random machine-like cams of all laws and pairs: the finished curve is the law.
TEST(CamDesign, LawsInACamAreTheLawsBeforeTheirMappingWithinATenMillionthOfTheStroke) {
  double worst = 0.0;
  int compared = 0;
  const test::Cases ran = test::for_each_seed(1, test::cases(400, 40'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double x[] = {between(-180.0, 0.0), between(10.0, 60.0), between(120.0, 200.0),
                        between(220.0, 360.0)};
    const double stroke = between(-100.0, 100.0);
    const auto kind = static_cast<MotionLawKind>(one.seed % kMotionLaws);
    const bool resting_start = random() % 2 == 0;
    const bool resting_end = random() % 2 == 0;
    const double slope = stroke / 300.0;
    const CamDesign design = design_of(
        {followed_by(resting_start ? dwell(x[0], x[1], 0.0) : CamLine{x[0], x[1], {}, 0.0, slope}, kind),
         element(resting_end ? dwell(x[2], x[3], stroke) : sloped(x[2], x[3], stroke, 0.5 * slope))});
    DesignedCam cam = design_cam(design, kCamPoints);
    if (!cam.function) return;
    ++compared;
    worst = std::max(worst, cam.stretches[1].deviation / std::abs(stroke));
    for (const CamJoint& joint : joints_of(*cam.function, false)) {
      const bool at_start = joint.x == cam.stretches[1].from;
      if (!at_start && joint.x != cam.stretches[1].to) continue;
      EXPECT_GE(joint.keeps, at_start ? cam.stretches[1].start_continuity : cam.stretches[1].end_continuity)
          << motion_law_name(kind) << " at " << joint.x;
    }
  });
  if (!ran.alone) {
    EXPECT_GT(compared, ran.count / 2);
  }
  EXPECT_LT(worst, 1e-7);
  RecordProperty("worst", std::to_string(worst));
}

TEST(CamDesign, FiguresAfterTheMappingAreThoseOfTheLawUnlessTheMappingChangesTheCurve) {
  for (std::size_t i = 0; i < kMotionLaws; ++i) {
    const auto kind = static_cast<MotionLawKind>(i);
    if (applicability(kind, MotionTask::rest, MotionTask::rest).start == Continuity::not_applicable) continue;
    const DesignedCam cam =
        made(design_of({followed_by(dwell(0.0, 60.0, 0.0), kind), element(dwell(180.0, 240.0, -40.0))}));
    const MotionPeaks before = cam.stretches[1].law->normalised_peaks();
    const MotionPeaks after = mapped_peaks(*cam.function, cam.stretches[1]);
    SCOPED_TRACE(motion_law_name(kind));
    EXPECT_NEAR(after.velocity / before.velocity, 1.0, 1e-8);
    EXPECT_NEAR(after.acceleration, before.acceleration, 1e-6);
    EXPECT_NEAR(after.deceleration, before.deceleration, 1e-6);
    if (std::isfinite(before.jerk) && before.jerk > 0.0) {
      EXPECT_NEAR(after.jerk / before.jerk, 1.0, 1e-6);
    } else {
      EXPECT_EQ(after.jerk, kInfinity);
    }
    EXPECT_NEAR(after.torque, before.torque, 1e-6);
  }
}

TEST(CamDesign, TheGoalChoosesTheLawWithTheLeastPeakThatKeepsTheContinuity) {
  using enum MotionLawKind;
  const auto chosen = [](CamGoal goal, std::optional<Continuity> continuity) {
    CamElement first = element(dwell(0.0, 60.0, 0.0));
    first.transition.emplace();
    first.transition->goal = goal;
    CamDesign design = design_of({first, element(dwell(180.0, 240.0, 50.0))});
    design.continuity = continuity;
    return made(design).stretches[1].kind;
  };
  EXPECT_EQ(chosen(CamGoal::none, {}), polynomial);
  EXPECT_EQ(chosen(CamGoal::velocity, {}), modified_sine);                             // 1.76
  EXPECT_EQ(chosen(CamGoal::acceleration, {}), modified_acceleration_trapezoid);       // 4.89
  EXPECT_EQ(chosen(CamGoal::jerk, {}), inclined_sine);                                 // 39.5
  EXPECT_EQ(chosen(CamGoal::torque, {}), modified_sine);                               // 5.46
  EXPECT_EQ(chosen(CamGoal::acceleration, Continuity::velocity), quadratic_parabola);  // 4
  EXPECT_EQ(chosen(CamGoal::velocity, Continuity::position), line);                    // 1
}

TEST(CamDesign, ContinuityDecidesTheDegreeOfAPolynomial) {
  const auto kept = [](std::optional<Continuity> start, std::optional<Continuity> end) {
    CamElement first = followed_by(dwell(0.0, 1.0, 0.0), MotionLawKind::polynomial);
    first.transition->start_continuity = start;
    first.transition->end_continuity = end;
    const DesignedCam cam = made(design_of({first, element(dwell(2.0, 3.0, 1.0))}));
    return cam.stretches[1].law->normalised_peaks().velocity;
  };
  EXPECT_NEAR(kept(Continuity::position, Continuity::position), 1.0, 1e-12);
  EXPECT_NEAR(kept(Continuity::velocity, Continuity::velocity), 1.5, 1e-9);
  EXPECT_NEAR(kept({}, {}), 1.875, 1e-9);
  EXPECT_GT(kept(Continuity::jerk, {}), 1.875);
}

TEST(CamDesign, ALambdaAsLeadingValueIsThatRelativeToTheTransition) {
  CamElement relative = followed_by(dwell(0.0, 60.0, 0.0), MotionLawKind::modified_sine);
  CamElement absolute = relative;
  relative.transition->lambda = 0.25;
  absolute.transition->lambda_at = 90.0;
  const CamElement last = element(dwell(180.0, 240.0, 50.0));
  const DesignedCam one = made(design_of({relative, last}));
  const DesignedCam other = made(design_of({absolute, last}));
  for (double x = 60.0; x <= 180.0; x += 10.0)
    EXPECT_EQ(one.function->value(x).position, other.function->value(x).position);
  EXPECT_NEAR(one.function->value(90.0).second_derivative, 0.0, 1e-9);
}

TEST(CamDesign, ASineThatEndsInItsCentreIsAConstantVelocityDespiteRounding) {
  const CamSine sine{0.0, 100.0, {10.0, 0.0, 180.0, {}, {}}, 0.0, {}, {}, {}};
  const DesignedCam cam =
      made(design_of({followed_by(sine, MotionLawKind::modified_sine), element(dwell(200.0, 300.0, 5.0))}));
  EXPECT_EQ(cam.stretches[1].start_task, MotionTask::constant_velocity);
  EXPECT_EQ(cam.stretches[1].end_task, MotionTask::rest);
}

TEST(CamDesign, WhatIsWrongIsToldAllAtOnceWithElementAndMember) {
  CamDesign design =
      design_of({element(CamLine{0.0, 60.0, 1.0, 2.0, 3.0}), element(CamLine{100.0, 90.0, 0.0, 0.0, {}}),
                 element(CamPointElement{kInfinity, 0.0, {}, {}, {}}),
                 element(CamSine{200.0, 300.0, {1.0, {}, {}, 50.0, 0.02}, 0.0, {}, {}, {}}),
                 element(CamInverseSine{310.0, 320.0, 0.0, 1.0, false, -2.0, 1.0, 1, {}})});
  const DesignedCam cam = design_cam(design, kCamPoints);
  EXPECT_TRUE(has_problem(cam, 0, false, "", "two of start_value, end_value and slope"));
  EXPECT_TRUE(has_problem(cam, 1, false, "end", "90 is not above the start, 100"));
  EXPECT_TRUE(has_problem(cam, 2, false, "x", "inf is not allowed"));
  EXPECT_TRUE(has_problem(cam, 3, false, "", "one has to be a phase"));
  EXPECT_TRUE(has_problem(cam, 4, false, "from", "from -2 to 1"));
  EXPECT_TRUE(has_problem(cam, 4, false, "count", "2 to 10000"));
}

TEST(CamDesign, ElementsHaveToAscend) {
  EXPECT_TRUE(has_problem(
      design_cam(design_of({element(dwell(0.0, 60.0, 0.0)), element(dwell(50.0, 90.0, 0.0))}), 1000), 1,
      false, "", "begins at 50"));
  EXPECT_TRUE(has_problem(design_cam(design_of({element(CamPointElement{5.0, 0.0, {}, {}, {}}),
                                                element(CamPointElement{5.0, 1.0, {}, {}, {}})}),
                                     1000),
                          1, false, "", "begins at 5"));
  made(design_of({element(dwell(0.0, 60.0, 0.0)), element(dwell(60.0, 90.0, 0.0))}));
  EXPECT_TRUE(has_problem(design_cam({}, 1000), CamFinding::kWhole, false, "", "no element"));
}

TEST(CamDesign, TransitionsThatCannotBeAreRefusedWithWhatIsAllowed) {
  using enum MotionLawKind;
  const CamElement rise = element(dwell(180.0, 240.0, 50.0));
  const auto refused = [&](const CamElement& first, const CamElement& second, std::string_view field,
                           std::string_view text) {
    const DesignedCam cam = design_cam(design_of({first, second}), kCamPoints);
    EXPECT_TRUE(has_problem(cam, 0, true, field, text)) << told(cam) << "missing: " << text;
  };
  CamElement first = followed_by(dwell(0.0, 60.0, 0.0), sine);
  first.transition->start_continuity = Continuity::acceleration;
  refused(first, rise, "law",
          "allowed: polynomial, inclined sine, modified acceleration trapezoid, modified sine");
  first = followed_by(dwell(0.0, 60.0, 0.0), harmonic_combination);
  refused(first, rise, "law", "does not serve a transition R-R");
  refused(first, element(dwell(60.0, 90.0, 0.0)), "", "no room");
  first = followed_by(dwell(0.0, 60.0, 0.0), polynomial);
  first.transition->start_continuity = first.transition->end_continuity = Continuity::jerk;
  refused(first, rise, "", "one end only");
  first = followed_by(dwell(0.0, 60.0, 0.0), polynomial);
  first.transition->ca = 5.0;
  refused(first, rise, "ca", "does not have this parameter");
  first.transition->ca.reset();
  first.transition->lambda_at = 190.0;
  refused(first, rise, "lambda_at", "from 60 to 180");
  first = followed_by(sloped(0.0, 60.0, 0.0, 1.0), line);
  first.transition->start_continuity = Continuity::velocity;
  refused(first, element(sloped(100.0, 120.0, 0.0, 1.0)), "law", "slopes at both ends that are its own");
  first = followed_by(CamInverseSine{0.0, 60.0, 0.0, 10.0, false, -1.0, 1.0, 32, {}}, polynomial);
  refused(first, rise, "", "infinite");
  CamDesign open = design_of({followed_by(dwell(0.0, 60.0, 0.0), polynomial)});
  EXPECT_TRUE(has_problem(design_cam(open, 1000), 0, true, "", "an element behind it"));
}

TEST(CamDesign, MoreThanTheDataBlockHoldsIsRefused) {
  std::vector<CamElement> elements;
  for (int i = 0; i < 51; ++i) elements.push_back(element(dwell(10.0 * i, 10.0 * i + 5.0, 0.0)));
  EXPECT_TRUE(
      has_problem(design_cam(design_of(elements), kCamPoints), CamFinding::kWhole, false, "", "51 segments"));
  CamPointGroup group;
  group.points = {{0.0, 0.0}, {1.0, 1.0}};
  group.count = 1001;
  EXPECT_TRUE(has_problem(design_cam(design_of({element(group)}), kCamPoints), CamFinding::kWhole, false, "",
                          "1001 points; allowed are 1000"));
  made(design_of({element(group)}), kCam10kPoints);
}

TEST(CamDesign, ATransitionSoSteepThatItsCoefficientsCannotBeHeldIsRefused) {
  const CamDesign design = design_of(
      {followed_by(dwell(0.0, 1.0, 0.0), MotionLawKind::polynomial), element(dwell(1.0 + 1e-4, 2.0, 50.0))});
  EXPECT_TRUE(has_problem(design_cam(design, kCamPoints), 0, true, "", "-1e12 to 1e12"));
}

TEST(CamDesign, PointsAndSegmentsGivenAsSuchAreCheckedOneByOne) {
  std::vector<TO_Cam_Struct_PointData> points = {{0.0, 0.0}, {1.0, kInfinity}};
  std::vector<TO_Cam_Struct_SegmentData> segments(1);
  DesignedCam cam = interpolated_cam(points, segments, {1, 0}, kCamPoints);
  EXPECT_TRUE(has_problem(cam, 1, false, "y", "inf"));
  EXPECT_TRUE(has_problem(cam, 0, true, "xmax", "not above xmin"));
  cam = interpolated_cam({}, {}, {1, 0}, kCamPoints);
  EXPECT_TRUE(has_problem(cam, CamFinding::kWhole, false, "", "neither"));
  cam = interpolated_cam({{0.0, 0.0}, {1.0, 1.0}}, {}, {1, 0}, kCamPoints);
  EXPECT_TRUE(cam.function);
}

std::string all(const std::vector<CamFinding>& findings) {
  std::string text;
  for (const CamFinding& finding : findings)
    text += std::to_string(finding.element) + (finding.transition ? "t " : " ") + finding.text + "\n";
  return text;
}

TEST(CamChecks, TellLeavingARangeAtTheElementThatDoes) {
  const CamDesign design = design_of(
      {followed_by(dwell(0.0, 60.0, 0.0), MotionLawKind::polynomial), element(dwell(180.0, 240.0, 50.0))});
  const DesignedCam cam = made(design);
  CamChecks checks;
  checks.leading_range = {0.0, 200.0};
  checks.following_range = {0.0, 50.0};
  EXPECT_EQ(all(check_cam(&design, cam, checks)),
            "1 leading values from 180 to 240 leave the range from 0 to 200\n");
  checks.leading_range.reset();
  checks.following_range = {0.0, 49.0};
  const std::string text = all(check_cam(&design, cam, checks));
  EXPECT_NE(text.find("0t following values from"), std::string::npos) << text;
  EXPECT_NE(text.find("1 following values from 50 to 50"), std::string::npos) << text;
}

TEST(CamChecks, LimitsCountAtTheAssumedLeadingVelocity) {
  const CamDesign design = design_of(
      {followed_by(dwell(0.0, 60.0, 0.0), MotionLawKind::polynomial), element(dwell(180.0, 240.0, 50.0))});
  const DesignedCam cam = made(design);
  CamChecks checks;
  checks.leading_velocity = 100.0;
  checks.max_velocity = 1.875 * 50.0 / 120.0 * 100.0;
  checks.max_acceleration = 5.7735027 * 50.0 / 14400.0 * 1e4;
  checks.max_jerk = 60.0 * 50.0 / 1728000.0 * 1e6;
  EXPECT_EQ(all(check_cam(&design, cam, checks)), "");
  checks.leading_velocity = 101.0;
  const std::string text = all(check_cam(&design, cam, checks));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
  EXPECT_NE(text.find("0t velocity of the following axis reaches 78.9"), std::string::npos) << text;
}

TEST(CamChecks, AStepOfADerivativeBreaksEveryLimitOfTheNext) {
  const CamDesign design = design_of(
      {followed_by(dwell(0.0, 60.0, 0.0), MotionLawKind::sine), element(dwell(180.0, 240.0, 50.0))});
  CamChecks checks;
  checks.leading_velocity = 1.0;
  checks.max_jerk = 1e9;
  const std::string text = all(check_cam(&design, made(design), checks));
  EXPECT_NE(text.find("0t at leading value 60 the acceleration steps from 0 to"), std::string::npos) << text;
  EXPECT_NE(text.find("the jerk is infinite"), std::string::npos) << text;
}

TEST(CamChecks, ContinuityTellsTheFirstDerivativeThatSteps) {
  CamDesign design = design_of({element(CamPointElement{0.0, 0.0, {}, {}, {}}),
                                element(CamPointElement{10.0, 10.0, {}, {}, {}}),
                                element(CamPointElement{30.0, 0.0, {}, {}, {}})});
  design.interpolation = {0, 0};
  const DesignedCam cam = made(design);
  CamChecks checks;
  checks.continuity = Continuity::velocity;
  EXPECT_EQ(all(check_cam(&design, cam, checks)),
            "1 at leading value 10 the velocity steps from 1 to -0.5; it has to be continuous up to the "
            "velocity\n");
  checks.continuity = Continuity::position;
  EXPECT_EQ(all(check_cam(&design, cam, checks)), "");
  checks.cyclic = true;
  checks.continuity = Continuity::velocity;
  EXPECT_NE(all(check_cam(&design, cam, checks))
                .find("from the end to the start the velocity steps from -0.5 to 1"),
            std::string::npos);
}

TEST(CamChecks, SuitabilityTellsALawThatMissesTheMotionBesideIt) {
  const CamSine sine{0.0, 100.0, {10.0, 0.0, 90.0, {}, {}}, 0.0, {}, {}, {}};  // ends in a reversal
  const auto checked = [&](MotionLawKind law) {
    const CamDesign design = design_of({followed_by(sine, law), element(dwell(200.0, 300.0, -20.0))});
    CamChecks checks;
    checks.suitability = true;
    return all(check_cam(&design, made(design), checks));
  };
  EXPECT_EQ(checked(MotionLawKind::polynomial), "");
  EXPECT_NE(
      checked(MotionLawKind::quadratic_parabola).find("0t the law 'quadratic parabola' has the acceleration"),
      std::string::npos);
}

TEST(CamChecks, ExtremesAreThoseOfTheFormula) {
  const CamSine sine{0.0, 300.0, {10.0, 17.0, {}, 120.0, {}}, 5.0, {}, {}, {}};
  const DesignedCam cam = made(design_of({element(sine)}));
  const CamExtremes extremes = extremes_of(*cam.function, 0.0, 300.0);
  const double w = 2.0 * kPi / 120.0;
  EXPECT_NEAR(extremes.lowest[0], -5.0, 1e-9);
  EXPECT_NEAR(extremes.highest[0], 15.0, 1e-9);
  EXPECT_NEAR(extremes.peak(1), 10.0 * w, 1e-9);
  EXPECT_NEAR(extremes.peak(2), 10.0 * w * w, 1e-9);
  EXPECT_NEAR(extremes.peak(3), 10.0 * w * w * w, 1e-9);
  EXPECT_NEAR(extremes.torque, 50.0 * w * w * w, 1e-9);
}

// The third derivative of every kind of piece against differences of the second.
TEST(CamChecks, ThirdDerivativesAreThoseOfTheSecond) {
  for (const DINT mode : {1, 2}) {
    const DesignedCam cam = interpolated_cam({{0.0, 0.0}, {1.0, 3.0}, {2.5, 1.0}, {4.0, 2.0}, {7.0, -1.0}},
                                             {}, {mode, 0}, kCamPoints);
    ASSERT_TRUE(cam.function);
    for (std::size_t piece = 0; piece < cam.function->piece_count(); ++piece) {
      const double from = cam.function->piece_start(piece);
      const double to = cam.function->piece_start(piece + 1);
      const double x = 0.6 * from + 0.4 * to;
      const double h = 1e-5;
      const double difference =
          (cam.function->piece_value(piece, x + h).second - cam.function->piece_value(piece, x - h).second) /
          (2 * h);
      const CamDerivatives value = cam.function->piece_value(piece, x);
      EXPECT_NEAR(value.third, difference, 1e-4 * (1.0 + std::abs(difference))) << mode << ' ' << piece;
      EXPECT_EQ(value.position, cam.function->value(x).position);
      EXPECT_EQ(value.first, cam.function->value(x).first_derivative);
      EXPECT_EQ(value.second, cam.function->value(x).second_derivative);
    }
  }
}

}  // namespace
}  // namespace lockstep::cam_design_test
