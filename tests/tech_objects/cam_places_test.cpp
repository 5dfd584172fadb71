// The same design wherever it lies, and however short it is: its joints and ends are exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tech_objects/cam/motion.hpp"
#include "tech_objects/cam_design/design.hpp"
#include "tech_objects/cam_design/design_check.hpp"

namespace lockstep::cam_places_test {
namespace {

struct Place {
  double begin, from, to, end;  // dwell, transition away, dwell
};
constexpr Place kPlaces[] = {
    {0.0, 340.0, 350.0, 360.0},       {0.0, 350.0, 355.0, 360.0},    {0.0, 340.0, 359.5, 360.0},
    {0.0, 359.0, 359.9, 360.0},       {0.0, 5000.0, 5100.0, 5200.0}, {0.0, 1.0e6, 1.0e6 + 10.0, 1.0e6 + 20.0},
    {-3600.0, -3590.0, -3580.0, 0.0}, {-1.0e5, -5.0, 5.0, 1.0e5},    {0.0, 0.1, 0.2, 0.3}};

CamElement dwell(double start, double end, double value) {
  return {CamLine{start, end, value, value, {}}, "", std::nullopt, ""};
}

/// A dwell at `low`, a transition by a law to `high`, a dwell there.
CamDesign rise(const Place& place, MotionLawKind law, double low, double high) {
  CamDesign design;
  design.elements = {dwell(place.begin, place.from, low), dwell(place.to, place.end, high)};
  design.elements[0].transition.emplace();
  design.elements[0].transition->law = law;
  return design;
}

TEST(CamPlaces, EachLawMeetsItsDwellsExactlyWhereverItLies) {
  std::size_t tried = 0;
  for (const Place& place : kPlaces)
    for (std::size_t i = 0; i < kMotionLaws; ++i)
      for (const double stroke : {50.0, -0.3, 1.0e6}) {
        const auto law = static_cast<MotionLawKind>(i);
        const DesignedCam cam = design_cam(rise(place, law, 7.0, 7.0 + stroke), kCamPoints);
        if (!cam.problems.empty() && cam.problems[0].text.find("serve") != std::string::npos) continue;
        ASSERT_TRUE(cam.function) << motion_law_name(law) << " from " << place.from << ": "
                                  << cam.problems[0].text;
        if (cam.segments.empty() || !cam.points.empty()) continue;  // a law that becomes points
        ++tried;
        for (const CamJoint& joint : joints_of(*cam.function, false))
          EXPECT_GE(joint.keeps, law == MotionLawKind::line ? Continuity::position : Continuity::velocity)
              << motion_law_name(law) << ": " << step_text(joint) << ", from " << place.from;
        const CamFunction& f = *cam.function;
        const double rounding = 1.0e-12 * std::abs(stroke) + 4.0e-15;
        EXPECT_NEAR(f.value(place.from).position, 7.0, rounding) << motion_law_name(law);
        EXPECT_NEAR(f.value(place.to).position, 7.0 + stroke, rounding) << motion_law_name(law);
        EXPECT_NEAR(f.value(std::nextafter(place.to, 0.0)).position, 7.0 + stroke,
                    rounding + 1.0e-9 * std::abs(stroke))
            << motion_law_name(law);
        EXPECT_NEAR(f.value(0.5 * (place.from + place.to)).position, 7.0 + 0.5 * stroke,
                    0.2 * std::abs(stroke));
      }
  EXPECT_GT(tried, 100u);
}

/// A dwell, up, and back to the start over the last few of the cam, which ends there.
TEST(CamPlaces, ADesignThatEndsWhereItBeginsClosesWithinTheRounding) {
  for (const double last : {20.0, 15.0, 10.0, 5.0, 1.0, 0.1})
    for (const double start_value : {0.0, 12.5}) {
      CamDesign design;
      design.elements = {dwell(0.0, 100.0, start_value),
                         dwell(200.0, 360.0 - last, start_value + 50.0),
                         {CamPointElement{360.0, start_value, 0.0, 0.0, {}}, "", std::nullopt, ""}};
      for (CamElement* element : {&design.elements[0], &design.elements[1]}) {
        element->transition.emplace();
        element->transition->law = MotionLawKind::polynomial;
      }
      const DesignedCam cam = design_cam(design, kCamPoints);
      ASSERT_TRUE(cam.function) << cam.problems[0].text;
      const CamFunction& f = *cam.function;
      EXPECT_NEAR(f.end_following_value(), start_value, 1.0e-12 * 50.0) << last;
      EXPECT_TRUE(CamFollowing::closes(f, 1.0, {})) << "the last " << last;
      EXPECT_TRUE(joints_of(f, true, true).empty() ||
                  joints_of(f, true, true).front().keeps >= Continuity::velocity);
    }
}

/// The published form, with coefficients of the leading value itself, is that with Origin 0.
TEST(CamPlaces, ASegmentWithAnOriginIsTheOneWithoutSeenFromThere) {
  const TO_Cam_Struct_SegmentData published{10.0, 20.0, 3.0, -2.0, 0.5, 0.01, 0.0, 0.0, 0.0, 1.5, 0.4, 0.3};
  TO_Cam_Struct_SegmentData local = published;  // in d = x - 10: the Taylor expansion by hand
  local.Origin = 10.0;
  local.a0 = 3.0 - 20.0 + 50.0 + 10.0;
  local.a1 = -2.0 + 10.0 + 3.0;
  local.a2 = 0.5 + 0.3;
  local.a3 = 0.01;
  local.sinePhase = 0.3 + 4.0;
  for (const TO_Cam_Struct_SegmentData& segment : {published, local}) {
    const DesignedCam cam = interpolated_cam({}, {segment}, {1, 0}, kCamPoints);
    ASSERT_TRUE(cam.function);
    for (const double x : {10.0, 12.5, 17.0, 20.0}) {
      const double expected = 3.0 - 2.0 * x + 0.5 * x * x + 0.01 * x * x * x + 1.5 * std::sin(0.4 * x + 0.3);
      EXPECT_NEAR(cam.function->value(x).position, expected, 1e-11) << x;
    }
  }
}

// ---- What is warned of

bool warns(const DesignedCam& cam, const std::string& part) {
  return std::ranges::any_of(cam.warnings,
                             [&](const CamFinding& one) { return one.text.find(part) != std::string::npos; });
}

TEST(CamJumps, WithinACamAreWarnedOf) {
  CamDesign design;
  design.elements = {dwell(0.0, 30.0, 10.0), dwell(30.0, 50.0, 50.0)};
  const DesignedCam cam = design_cam(design, kCamPoints);
  ASSERT_TRUE(cam.function);
  EXPECT_TRUE(warns(cam, "at leading value 30 the following value steps from 10 to 50"));
  design.elements[1] = dwell(30.0, 50.0, 10.0);
  EXPECT_TRUE(design_cam(design, kCamPoints).warnings.empty());
}

TEST(CamJumps, AtTheWrapAreFoundWhereTheCamHasToClose) {
  CamDesign design;
  design.elements = {dwell(0.0, 30.0, 10.0), dwell(40.0, 50.0, 50.0)};
  design.elements[0].transition.emplace();
  const DesignedCam cam = design_cam(design, kCamPoints);
  ASSERT_TRUE(cam.function);
  CamChecks checks;
  checks.cyclic = true;
  EXPECT_TRUE(check_cam(&design, cam, checks).empty()) << "a stroke a turn is no step";
  checks.closed = true;
  const auto findings = check_cam(&design, cam, checks);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NE(findings[0].text.find("from the end to the start the following value steps from 50 to 10"),
            std::string::npos)
      << findings[0].text;
}

}  // namespace
}  // namespace lockstep::cam_places_test
