// The motion laws: figures, ends, derivatives, parameters and what they become in a cam.
#include "tech_objects/cam_design/motion_law.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tech_objects/cam_cases.hpp"

namespace lockstep::motion_law_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr MotionTask kTasks[] = {MotionTask::rest, MotionTask::constant_velocity, MotionTask::reversal,
                                 MotionTask::motion};

MotionLawKind law_number(std::size_t i) {
  return static_cast<MotionLawKind>(i);
}

/// Rest in rest from (0, 0) to (1, 1), with as many derivatives as the polynomial shall have.
MotionLawRequest rest_in_rest(MotionLawKind law, int derivatives = 2) {
  MotionLawRequest request;
  request.law = law;
  request.end.x = request.end.y = 1.0;
  for (MotionBoundary* end : {&request.start, &request.end}) {
    if (derivatives >= 1) end->velocity = 0.0;
    if (derivatives >= 2) end->acceleration = 0.0;
    if (derivatives >= 3) end->jerk = 0.0;
  }
  return request;
}

void set_task(MotionBoundary& end, MotionTask task, double velocity, double acceleration) {
  const bool moves = task == MotionTask::constant_velocity || task == MotionTask::motion;
  const bool accelerates = task == MotionTask::reversal || task == MotionTask::motion;
  end.velocity = moves ? velocity : 0.0;
  end.acceleration = accelerates ? acceleration : 0.0;
}

/// A transition of any law and pair, with a stroke and velocities as they come in a machine.
MotionLawRequest between_tasks(MotionLawKind law, MotionTask start, MotionTask end) {
  MotionLawRequest request;
  request.law = law;
  request.start = {30.0, -5.0, {}, {}, {}};
  request.end = {110.0, 35.0, {}, {}, {}};
  set_task(request.start, start, law == MotionLawKind::line ? 0.5 : 0.25, 0.01);
  set_task(request.end, end, law == MotionLawKind::line ? 0.5 : 0.125, -0.02);
  return request;
}

MotionLaw made(const MotionLawRequest& request) {
  MotionLaw law;
  EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::none);
  return law;
}

/// Whether two numbers agree in the digits in which one of them is written.
void expect_digits(double found, const std::string& written, const std::string& what) {
  if (written == "inf") {
    EXPECT_EQ(found, kInfinity) << what;
    return;
  }
  const auto point = written.find('.');
  const auto digits = point == std::string::npos ? 0 : static_cast<int>(written.size() - point - 1);
  const double number = std::stod(written);
  EXPECT_NEAR(found, number, std::max(0.51 * std::pow(10.0, -digits), 1.0e-12 * number)) << what;
}

TEST(MotionLaw, FiguresOfRestInRestAgreeWithTheReferenceInEveryDigit) {
  const std::map<std::string, std::pair<MotionLawKind, int>> laws = {
      {"quadratic_parabola", {MotionLawKind::quadratic_parabola, 2}},
      {"polynomial_2_3", {MotionLawKind::polynomial, 1}},
      {"simple_sine", {MotionLawKind::sine, 2}},
      {"polynomial_3_4_5", {MotionLawKind::polynomial, 2}},
      {"polynomial_4_5_6_7", {MotionLawKind::polynomial, 3}},
      {"inclined_sine", {MotionLawKind::inclined_sine, 2}},
      {"modified_sine", {MotionLawKind::modified_sine, 2}},
      {"modified_trapezoid", {MotionLawKind::modified_acceleration_trapezoid, 2}}};
  std::ifstream file(std::string(LOCKSTEP_TEST_DATA) + "/motion_laws.csv");
  std::string line;
  std::size_t compared = 0;
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const auto entry = laws.find(cells.at(0));
    if (entry == laws.end()) continue;
    SCOPED_TRACE(cells[0]);
    ++compared;
    const MotionLaw law = made(rest_in_rest(entry->second.first, entry->second.second));
    const MotionPeaks peaks = law.normalised_peaks();
    expect_digits(peaks.velocity, cells.at(1), "Cv");
    expect_digits(peaks.acceleration, cells.at(2), "Ca");
    expect_digits(peaks.deceleration, cells.at(2), "Ca*");
    expect_digits(peaks.jerk, cells.at(3), "Cj");
    expect_digits(law.value(0.25).position, cells.at(4), "s(0.25)");
    expect_digits(peaks.torque, cells.at(5), "Cmdyn");
  }
  EXPECT_EQ(compared, laws.size());
}

TEST(MotionLaw, FiguresOfTheModifiedSineAreThoseOfItsClosedForm) {
  const double pi = 3.14159265358979323846;
  const MotionPeaks peaks = made(rest_in_rest(MotionLawKind::modified_sine)).normalised_peaks();
  EXPECT_NEAR(peaks.velocity, 4.0 * pi / (4.0 + pi), 1.0e-14);
  EXPECT_NEAR(peaks.acceleration, 4.0 * pi * pi / (4.0 + pi), 1.0e-13);
  EXPECT_NEAR(peaks.deceleration, 4.0 * pi * pi / (4.0 + pi), 1.0e-13);
  EXPECT_NEAR(peaks.jerk, 16.0 * pi * pi * pi / (4.0 + pi), 1.0e-12);
}

TEST(MotionLaw, EveryLawKeepsAtBothEndsWhatTheTableSaysForEveryPair) {
  int pairs = 0;
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    for (const MotionTask start : kTasks)
      for (const MotionTask end : kTasks) {
        const MotionLawKind kind = law_number(i);
        SCOPED_TRACE(testing::Message()
                     << motion_law_name(kind) << ' ' << task_letter(start) << '-' << task_letter(end));
        const Applicability kept = applicability(kind, start, end);
        const MotionLawRequest request = between_tasks(kind, start, end);
        MotionLaw law;
        const MotionLawError error = MotionLaw::make(request, law);
        if (kept.start == Continuity::not_applicable) {
          EXPECT_EQ(error, MotionLawError::not_applicable);
          continue;
        }
        ASSERT_EQ(error, MotionLawError::none);
        ++pairs;
        const auto check = [&](const MotionValue& value, const MotionBoundary& wanted, Continuity order) {
          EXPECT_NEAR(value.position, wanted.y, 1.0e-13 * 40.0);
          if (order >= Continuity::velocity) {
            EXPECT_NEAR(value.velocity, *wanted.velocity, 1.0e-13);
          }
          if (order >= Continuity::acceleration) {
            EXPECT_NEAR(value.acceleration, *wanted.acceleration, 1.0e-14);
          }
        };
        check(law.value(request.start.x), request.start, kept.start);
        check(law.value(request.end.x), request.end, kept.end);
      }
  EXPECT_EQ(pairs, 16 + 16 + 16 + 16 + 4 + 12 + 4 + 8 + 2 + 16);
}

TEST(MotionLaw, PositionAndVelocityAreContinuousInsideAndTheDerivativesAreThoseOfTheValues) {
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    for (const MotionTask start : kTasks)
      for (const MotionTask end : kTasks)
        for (const double lambda : {0.0, 0.3, 0.6}) {
          MotionLawRequest request = between_tasks(law_number(i), start, end);
          if (lambda > 0.0) request.lambda = lambda;
          MotionLaw law;
          const MotionLawError error = MotionLaw::make(request, law);
          if (error == MotionLawError::not_applicable || error == MotionLawError::parameter) continue;
          SCOPED_TRACE(testing::Message() << motion_law_name(request.law) << ' ' << task_letter(start) << '-'
                                          << task_letter(end) << " lambda " << lambda);
          ASSERT_EQ(error, MotionLawError::none);
          const double scale = std::max(1.0, law.peaks().velocity);
          for (std::size_t k = 1; k < law.pieces().size(); ++k) {
            const MotionPiece& before = law.pieces()[k - 1];
            const MotionValue left = before.value(before.length);
            const MotionValue right = law.pieces()[k].value(0.0);
            EXPECT_NEAR(left.position, right.position, 1.0e-12 * scale);
            EXPECT_NEAR(left.velocity, right.velocity, 1.0e-12 * scale);
          }
          for (const MotionPiece& piece : law.pieces()) {
            const double h = 1.0e-4 * piece.length;
            for (const double part : {0.1, 0.37, 0.5, 0.81}) {
              const MotionValue value = piece.value(part * piece.length);
              const MotionValue a = piece.value(part * piece.length - h);
              const MotionValue b = piece.value(part * piece.length + h);
              const MotionPeaks peaks = law.peaks();
              const double ca = peaks.acceleration + peaks.deceleration;
              EXPECT_NEAR((b.position - a.position) / (2.0 * h), value.velocity, 1.0e-6 * scale);
              EXPECT_NEAR((b.velocity - a.velocity) / (2.0 * h), value.acceleration, 1.0e-6 * ca + 1.0e-10);
              EXPECT_NEAR((b.acceleration - a.acceleration) / (2.0 * h), value.jerk,
                          1.0e-4 * ca / piece.length + 1.0e-10);
            }
          }
        }
}

TEST(MotionLaw, TheLawsThatArePromisedWithoutJerkStepsHaveNone) {
  for (const MotionLawKind kind : {MotionLawKind::inclined_sine, MotionLawKind::modified_sine,
                                   MotionLawKind::modified_acceleration_trapezoid})
    for (const MotionTask start : {MotionTask::rest, MotionTask::constant_velocity})
      for (const MotionTask end : {MotionTask::rest, MotionTask::constant_velocity})
        for (const double lambda : {0.2, 0.5, 0.7}) {
          MotionLawRequest request = between_tasks(kind, start, end);
          request.lambda = lambda;
          EXPECT_TRUE(std::isfinite(made(request).peaks().jerk)) << motion_law_name(kind);
        }
  for (const MotionTask task : {MotionTask::rest, MotionTask::constant_velocity})
    for (const MotionLawKind kind :
         {MotionLawKind::harmonic_combination, MotionLawKind::modified_acceleration_trapezoid}) {
      EXPECT_TRUE(std::isfinite(made(between_tasks(kind, task, MotionTask::reversal)).peaks().jerk));
      EXPECT_TRUE(std::isfinite(made(between_tasks(kind, MotionTask::reversal, task)).peaks().jerk));
    }
  EXPECT_EQ(made(between_tasks(MotionLawKind::sine, MotionTask::rest, MotionTask::rest)).peaks().jerk,
            kInfinity);
}

TEST(MotionLaw, TheInflectionPointLiesAtLambda) {
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    for (const double lambda : {0.25, 0.4, 0.5, 0.75}) {
      MotionLawRequest request = rest_in_rest(law_number(i));
      request.lambda = lambda;
      MotionLaw law;
      if (MotionLaw::make(request, law) != MotionLawError::none) continue;
      SCOPED_TRACE(testing::Message() << motion_law_name(request.law) << " lambda " << lambda);
      for (double z = 0.02; z < 0.99; z += 0.01) {
        const double acceleration = law.value(z).acceleration;
        if (z < lambda - 0.005) {
          EXPECT_GE(acceleration, -1.0e-12) << z;
        }
        if (z > lambda + 0.005) {
          EXPECT_LE(acceleration, 1.0e-12) << z;
        }
      }
    }
}

TEST(MotionLaw, APolynomialInTwoPiecesIsThatOfOnePieceForTheMiddleAndStretchesItsHalvesElsewhere) {
  for (const int derivatives : {1, 2, 3}) {
    MotionLawRequest request = rest_in_rest(MotionLawKind::polynomial, derivatives);
    const MotionLaw one = made(request);
    request.lambda = 0.5;
    const MotionLaw two = made(request);
    request.lambda = 0.3;
    const MotionLaw uneven = made(request);
    ASSERT_EQ(uneven.pieces().size(), 2u);
    // With the jerk the one piece has degree 7, the halves have degree 6: 0.13 % of the stroke apart.
    const double tolerance = derivatives < 3 ? 1.0e-14 : 1.4e-3;
    for (double z = 0.0; z <= 0.5; z += 0.03125) {
      EXPECT_NEAR(two.value(z).position, one.value(z).position, tolerance);
      EXPECT_NEAR(two.value(1.0 - z).position, one.value(1.0 - z).position, tolerance);
      EXPECT_NEAR(uneven.value(0.6 * z).position, 0.6 * two.value(z).position, 1.0e-14);
      EXPECT_NEAR(1.0 - uneven.value(1.0 - 1.4 * z).position, 1.4 * (1.0 - two.value(1.0 - z).position),
                  1.0e-14);
    }
    EXPECT_NEAR(uneven.normalised_peaks().velocity, one.normalised_peaks().velocity, 1.0e-12);
    EXPECT_NEAR(uneven.value(0.3).acceleration, 0.0, 1.0e-12);
  }
}

TEST(MotionLaw, CaOrCaStarSetTheGreatestAccelerationInsteadOfLambda) {
  for (const MotionLawKind kind :
       {MotionLawKind::quadratic_parabola, MotionLawKind::sine, MotionLawKind::inclined_sine,
        MotionLawKind::modified_acceleration_trapezoid, MotionLawKind::modified_sine}) {
    SCOPED_TRACE(motion_law_name(kind));
    MotionLawRequest request = rest_in_rest(kind);
    request.end = {200.0, -50.0, 0.0, 0.0, {}};
    const double usual = made(request).normalised_peaks().acceleration;
    request.ca = 1.5 * usual;
    EXPECT_NEAR(made(request).normalised_peaks().acceleration, 1.5 * usual, 1.0e-6);
    request.ca.reset();
    request.ca_star = 1.25 * usual;
    EXPECT_NEAR(made(request).normalised_peaks().deceleration, 1.25 * usual, 1.0e-6);
    request.lambda = 0.5;
    MotionLaw law;
    EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::parameter);
  }
}

TEST(MotionLaw, TheSineLineCombinationTakesCaAndCaStarTogetherIfTheyLeaveALine) {
  MotionLawRequest request = rest_in_rest(MotionLawKind::sine_line_combination);
  request.ca = 10.0;
  request.ca_star = 20.0;
  const MotionPeaks peaks = made(request).normalised_peaks();
  EXPECT_NEAR(peaks.acceleration, 10.0, 1.0e-9);
  EXPECT_NEAR(peaks.deceleration, 20.0, 1.0e-9);
  EXPECT_EQ(made(request).pieces().size(), 3u);
  EXPECT_NEAR(made(request).value(1.0).position, 1.0, 1.0e-14);
  request.ca = 3.0;  // below π²/2 no ramp reaches the stroke
  request.ca_star = 3.0;
  MotionLaw law;
  EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::parameter);
  request.ca_star.reset();
  EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::parameter);
}

TEST(MotionLaw, SlopesAtConstantVelocityAreMetAtUnequalValues) {
  for (const MotionLawKind kind : {MotionLawKind::modified_sine, MotionLawKind::inclined_sine}) {
    const MotionLaw law =
        made(between_tasks(kind, MotionTask::constant_velocity, MotionTask::constant_velocity));
    EXPECT_NEAR(law.value(30.0).velocity, 0.25, 1.0e-14);
    EXPECT_NEAR(law.value(110.0).velocity, 0.125, 1.0e-14);
    EXPECT_NEAR(law.value(110.0).position, 35.0, 1.0e-12);
  }
}

TEST(MotionLaw, ALineBetweenConstantVelocitiesHasToHaveTheirSlope) {
  MotionLawRequest request =
      between_tasks(MotionLawKind::line, MotionTask::constant_velocity, MotionTask::constant_velocity);
  MotionLaw law;
  EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::none);
  request.end.velocity = 0.501;
  EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::boundary);
}

TEST(MotionLaw, APolynomialTakesAnyChoiceOfDerivatives) {
  MotionLawRequest request;
  request.end = {2.0, 3.0, {}, {}, {}};
  EXPECT_NEAR(made(request).value(1.0).position, 1.5, 1.0e-14);  // a line
  request.start.acceleration = 0.75;
  request.end.jerk = -2.0;
  const MotionLaw law = made(request);
  EXPECT_NEAR(law.value(0.0).acceleration, 0.75, 1.0e-13);
  EXPECT_NEAR(law.value(2.0).jerk, -2.0, 1.0e-13);
  EXPECT_NEAR(law.value(2.0).position, 3.0, 1.0e-13);
  request.start = {0.0, 0.0, {}, {}, 1.0};  // two positions and two jerks leave the slope open
  MotionLaw unchanged = law;
  EXPECT_EQ(MotionLaw::make(request, unchanged), MotionLawError::boundary);
  EXPECT_EQ(unchanged.value(2.0).jerk, law.value(2.0).jerk);
}

TEST(MotionLaw, TakesAsManySegmentsAsTheConsumptionTableSays) {
  struct Row {
    MotionLawRequest request;
    std::size_t segments;
  };
  const auto with_lambda = [](MotionLawRequest request) {
    request.lambda = 0.4;
    return request;
  };
  using enum MotionTask;
  using enum MotionLawKind;
  const Row rows[] = {{rest_in_rest(line), 1},
                      {rest_in_rest(sine), 1},
                      {with_lambda(rest_in_rest(sine)), 2},
                      {rest_in_rest(inclined_sine), 1},
                      {with_lambda(rest_in_rest(inclined_sine)), 2},
                      {rest_in_rest(polynomial), 1},
                      {rest_in_rest(polynomial, 3), 2},
                      {with_lambda(rest_in_rest(polynomial)), 2},
                      {with_lambda(rest_in_rest(polynomial, 3)), 2},
                      {between_tasks(modified_acceleration_trapezoid, rest, reversal), 5},
                      {between_tasks(modified_acceleration_trapezoid, reversal, rest), 5},
                      {rest_in_rest(modified_acceleration_trapezoid), 6},
                      {rest_in_rest(modified_sine), 3},
                      {between_tasks(modified_sine, constant_velocity, constant_velocity), 4},
                      {between_tasks(modified_sine, constant_velocity, rest), 4},
                      {between_tasks(modified_sine, rest, constant_velocity), 4},
                      {rest_in_rest(sine_line_combination), 3},
                      {between_tasks(harmonic_combination, reversal, rest), 3},
                      {between_tasks(harmonic_combination, rest, reversal), 3},
                      {rest_in_rest(quadratic_parabola), 2},
                      {between_tasks(double_harmonic_transition, rest, reversal), 0}};
  for (const Row& row : rows) {
    TO_Cam_Struct_SegmentData segments[8];
    const MotionLaw law = made(row.request);
    EXPECT_EQ(law.segments(segments), row.segments) << motion_law_name(row.request.law);
    EXPECT_EQ(law.becomes_points(), row.segments == 0);
    if (row.segments > 0) {
      EXPECT_EQ(law.segments({segments, row.segments - 1}), 0u);  // no room, no half a law
    }
  }
}

/// The law in a cam, between the lines that its ends continue.
void fill_cam(test::Cam& cam, const MotionLaw& law) {
  if (law.becomes_points()) {
    std::vector<TO_Cam_Struct_PointData> points(MotionLaw::kDefaultPoints);
    law.points(points);
    for (const auto& point : points) cam.point(point.x, point.y);
    return;
  }
  TO_Cam_Struct_SegmentData segments[8];
  const std::size_t count = law.segments(segments);
  for (std::size_t k = 0; k < count; ++k) cam.segment(segments[k]);
}

TEST(MotionLaw, ACamOfItsSegmentsIsTheLaw) {
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    for (const MotionTask start : kTasks)
      for (const MotionTask end : kTasks) {
        const MotionLawKind kind = law_number(i);
        if (applicability(kind, start, end).start == Continuity::not_applicable) continue;
        SCOPED_TRACE(testing::Message()
                     << motion_law_name(kind) << ' ' << task_letter(start) << '-' << task_letter(end));
        const MotionLaw law = made(between_tasks(kind, start, end));
        test::Cam cam;
        cam.mode(1);
        fill_cam(cam, law);
        ASSERT_EQ(cam.interpolate(), ErrorId::none);
        EXPECT_EQ(cam.f.start_leading_value(), 30.0);
        EXPECT_EQ(cam.f.end_leading_value(), 110.0);
        const double tolerance = law.becomes_points() ? 0.1 : 1.0e-11;
        for (double x = 30.0; x <= 110.0; x += 0.5) {
          const MotionValue wanted = law.value(x);
          const CamValue found = cam.f.value(x);
          ASSERT_NEAR(found.position, wanted.position, tolerance) << x;
          if (law.becomes_points()) continue;
          ASSERT_NEAR(found.first_derivative, wanted.velocity, 1.0e-11) << x;
        }
      }
}

TEST(MotionLaw, ADegree7PolynomialInTwoSegmentsKeepsItsEndsUpToTheJerkAndItsMiddle) {
  MotionLawRequest request = rest_in_rest(MotionLawKind::polynomial, 3);
  request.start = {20.0, 1.0, 0.5, -0.25, 0.125};
  request.end = {30.0, 9.0, 0.25, 0.5, -0.5};
  const MotionLaw law = made(request);
  ASSERT_EQ(law.pieces().size(), 1u);
  ASSERT_NE(law.pieces()[0].coefficient[7], 0.0);
  TO_Cam_Struct_SegmentData segments[2];
  ASSERT_EQ(law.segments(segments), 2u);
  EXPECT_EQ(segments[0].xmin, 20.0);
  EXPECT_EQ(segments[0].xmax, 25.0);
  EXPECT_EQ(segments[1].xmin, 25.0);
  EXPECT_EQ(segments[1].xmax, 30.0);
  for (const auto& [segment, x, orders] :
       {std::tuple{0, 20.0, 3}, {0, 25.0, 2}, {1, 25.0, 2}, {1, 30.0, 3}}) {
    const MotionValue value = law.value(x);
    const double wanted[] = {value.position, value.velocity, value.acceleration, value.jerk};
    const CamSegment seen = shifted(segments[segment], x);
    for (int order = 0; order <= orders; ++order)
      EXPECT_NEAR(seen.derivative(order, 0.0), wanted[order], 1.0e-9) << segment << ' ' << x << ' ' << order;
  }
}

TEST(MotionLaw, ThePolynomial4567InTwoSegmentsDeviatesByAnEighthOfAPercentOfTheStroke) {
  const MotionLaw law = made(rest_in_rest(MotionLawKind::polynomial, 3));
  test::Cam cam;
  TO_Cam_Struct_SegmentData segments[2];
  ASSERT_EQ(law.segments(segments), 2u);
  ASSERT_EQ(cam.segment(segments[0]).segment(segments[1]).interpolate(), ErrorId::none);
  double deviation = 0.0;
  for (double z = 0.0; z <= 1.0; z += 0.001)
    deviation = std::max(deviation, std::abs(cam.f.value(z).position - law.value(z).position));
  EXPECT_NEAR(deviation, 1.31e-3, 0.01e-3);
}

TEST(MotionLaw, MirroredStrokesAndFarLeadingValuesChangeNothingButTheSign) {
  for (std::size_t i = 0; i < kMotionLaws; ++i) {
    MotionLawRequest request = rest_in_rest(law_number(i));
    if (law_number(i) == MotionLawKind::double_harmonic_transition ||
        law_number(i) == MotionLawKind::harmonic_combination)
      request.end.acceleration = -1.0;
    const MotionLaw law = made(request);
    request.start.x += 1000.0;
    request.end.x = 1002.0;
    request.end.y = -3.0;
    const MotionLaw other = made(request);
    for (double z = 0.0; z <= 1.0; z += 0.0625)
      EXPECT_NEAR(other.value(1000.0 + 2.0 * z).position, -3.0 * law.value(z).position, 1.0e-13);
    EXPECT_NEAR(other.normalised_peaks().velocity, law.normalised_peaks().velocity, 1.0e-9);
    EXPECT_NEAR(other.normalised_peaks().deceleration, law.normalised_peaks().deceleration, 1.0e-8);
  }
}

TEST(MotionLaw, FiguresWithoutAStrokeAreNotNormalised) {
  MotionLawRequest request = rest_in_rest(MotionLawKind::polynomial);
  request.end.y = 0.0;
  const MotionLaw law = made(request);
  EXPECT_EQ(law.peaks().velocity, 0.0);
  EXPECT_TRUE(std::isnan(law.normalised_peaks().velocity));
  request.law = MotionLawKind::modified_sine;
  request.ca = 5.0;
  MotionLaw other;
  EXPECT_EQ(MotionLaw::make(request, other), MotionLawError::parameter);
}

TEST(MotionLaw, HostileRequestsAreRefused) {
  for (std::size_t i = 0; i < kMotionLaws; ++i) {
    MotionLaw law;
    for (const double wrong : {kNan, kInfinity, -kInfinity}) {
      for (double MotionBoundary::*member : {&MotionBoundary::x, &MotionBoundary::y}) {
        MotionLawRequest request = rest_in_rest(law_number(i));
        request.end.*member = wrong;
        EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::not_finite);
      }
      MotionLawRequest request = rest_in_rest(law_number(i));
      request.start.velocity = wrong;
      EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::not_finite);
      request = rest_in_rest(law_number(i));
      request.lambda = wrong;
      EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::parameter);
    }
    for (const double lambda : {0.0, 1.0, -0.5, 1.5}) {
      MotionLawRequest request = rest_in_rest(law_number(i));
      request.lambda = lambda;
      EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::parameter);
    }
    MotionLawRequest request = rest_in_rest(law_number(i));
    request.end.x = 0.0;
    EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::not_finite);
    request.end.x = -1.0;
    EXPECT_EQ(MotionLaw::make(request, law), MotionLawError::not_finite);
    EXPECT_TRUE(law.pieces().empty());
  }
}

TEST(MotionLaw, TasksFollowFromVelocityAndAcceleration) {
  EXPECT_EQ(motion_task(0.0, 0.0), MotionTask::rest);
  EXPECT_EQ(motion_task(-1.0, 0.0), MotionTask::constant_velocity);
  EXPECT_EQ(motion_task(0.0, 2.0), MotionTask::reversal);
  EXPECT_EQ(motion_task(1.0, -2.0), MotionTask::motion);
}

}  // namespace
}  // namespace lockstep::motion_law_test
