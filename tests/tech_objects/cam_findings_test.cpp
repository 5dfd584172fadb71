// What is told of points and segments: why they make no curve, and which of them do not count.
#include <random>

#include "tech_objects/cam_design/findings.hpp"
#include "tests/support/property.hpp"
#include "tests/tech_objects/cam_cases.hpp"

namespace lockstep::cam_findings_test {
namespace {

using test::Cam;
using Reason = CamFault::Reason;

CamFindings findings(Cam& cam) {
  cam.interpolate();
  return findings_of(elements_of(*cam.data), cam.interpolator, cam.f);
}

/// The only finding of a list, as "point 2 x: text" or "segment 1: text", counted from 0.
std::string only(const std::vector<CamFinding>& list) {
  if (list.size() != 1) return std::to_string(list.size()) + " findings";
  const CamFinding& finding = list[0];
  std::string place = "cam";
  if (finding.element != CamFinding::kWhole)
    place = (finding.transition ? "segment " : "point ") + std::to_string(finding.element);
  if (!finding.field.empty()) place += " " + std::string(finding.field);
  return place + ": " + finding.text;
}

TO_Cam_Struct_SegmentData sine(double from, double to, double frequency) {
  TO_Cam_Struct_SegmentData s;
  s.xmin = from;
  s.xmax = to;
  s.sineAmplitude = 1.0;
  s.sinePeriod = frequency * 6.283185307179586;
  return s;
}

TEST(CamFindings, UnequalSlopesAreToldAtTheLastSegmentWithBoth) {
  Cam cam;
  cam.mode(1, 1).line(7.0, 9.0, 0.0, 2.0).line(0.0, 5.0, 0.0, 1.0);
  const std::string text = only(findings(cam).problems);
  EXPECT_TRUE(text.starts_with("segment 0: the cam ends here with a slope of 2 and begins with one of 1; "))
      << text;
  EXPECT_EQ(cam.interpolator.fault().reason, Reason::end_slopes);
}

TEST(CamFindings, ASinglePointIsTold) {
  Cam cam;
  cam.point(3.5, 1.0).point(3.5, 2.0);
  EXPECT_EQ(
      only(findings(cam).problems),
      "point 1 x: 3.5 is the only leading value, which makes no curve; allowed: two at least, or a segment");
}

TEST(CamFindings, TooManyPeriodsAreToldWhereMostOfThemAre) {
  Cam cam;
  cam.segment(sine(0.0, 1.0, 500.0)).segment(sine(1.0, 2.0, 600.0)).segment(sine(2.0, 3.0, 100.0));
  EXPECT_EQ(only(findings(cam).problems),
            "segment 1 sinePeriod: the sines of the cam have 1200 periods, 600 of them here; allowed: 1024 "
            "together");
}

TEST(CamFindings, SegmentsThatDescendAndNumbersBeyondTheDataBlockAreTold) {
  Cam order;
  order.point(0.0, 0.0).line(0.0, 1.0, 0.0, 0.0).line(5.0, 4.0, 0.0, 0.0);
  EXPECT_EQ(only(findings(order).problems), "segment 1 xmax: 4 is not above xmin, 5");
  Cam number;
  number.point(0.0, 0.0).point(1.0, 2e12);
  EXPECT_EQ(only(findings(number).problems),
            "point 1: 2e+12 is not allowed here; allowed: a number from -1e12 to 1e12");
}

TEST(CamFindings, ACurveThatADoubleCannotHoldIsToldWhereItFails) {
  for (const DINT mode : {0, 1, 2}) {
    Cam cam;
    cam.mode(mode).point(0.0, 0.0).point(1.0, 0.0).point(2.0, 0.0).point(0.0, 1.0);
    cam.point(5.0e-324, 1.0e12);
    cam.interpolate();
    const CamFault& fault = cam.interpolator.fault();
    EXPECT_EQ(fault.reason, Reason::not_held);
    EXPECT_FALSE(fault.segment);
    EXPECT_TRUE(fault.element == 3 || fault.element == 4) << fault.element << " in mode " << mode;
    EXPECT_LE(fault.value, 5.0e-324);
  }
}

TEST(CamFindings, OfPointsWithOneLeadingValueThoseThatDoNotCountAreTold) {
  Cam cam;
  cam.point(0.0, 0.0).point(10.0, 5.0).point(20.0, 0.0).point(10.0, 7.0);
  EXPECT_EQ(only(findings(cam).warnings),
            "point 1: does not count: of the points at leading value 10 the last does, with the following "
            "value 7");
  EXPECT_TRUE(findings(cam).problems.empty());
}

TEST(CamFindings, APointInASegmentIsToldUnlessItLiesOnTheCurve) {
  Cam cam;
  cam.line(0.0, 5.0, 0.0, 2.0).point(2.0, 4.0).point(5.0, 10.0).point(3.0, 1.0).point(8.0, 1.0);
  EXPECT_EQ(only(findings(cam).warnings),
            "point 2: does not count: at leading value 3 the segment from 0 to 5 does, with the following "
            "value 6");
}

TEST(CamFindings, OverlappingSegmentsAreToldAtTheOneThatIsCutOff) {
  Cam cam;
  cam.line(0.0, 5.0, 3.0, 0.0).line(4.0, 9.0, 3.0, 0.0);
  EXPECT_EQ(only(findings(cam).warnings),
            "segment 0: does not count from 4 to 5: there the segment from 4 to 9 does, which overlaps it");
  Cam meeting;
  meeting.line(0.0, 0.3, 3.0, 0.0).line(0.1 + 0.2, 9.0, 3.0, 0.0).line(9.00005, 10.0, 3.0, 0.0);
  EXPECT_EQ(only(findings(meeting).warnings), "0 findings");
}

TEST(CamFindings, AFollowingValueThatCamInRefusesIsTold) {
  Cam cam;
  TO_Cam_Struct_SegmentData s;
  s.xmax = 1.0e6;
  s.a6 = -1.0e12;
  cam.segment(s);
  EXPECT_EQ(only(findings(cam).warnings),
            "segment 0: the following value reaches -1e+48 at leading value 1e+06: MC_CamIn refuses the cam "
            "with 16#8024 unless SlaveScaling brings it to -1e12 to 1e12");
}

// What is told not to count has no effect; every other point has one.
TEST(CamFindings, APointCountsExactlyIfNothingIsToldOfIt) {
  test::for_each_seed(11, test::cases(200, 20000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    Cam cam;
    for (int i = 0; i < 12; ++i)
      cam.point(static_cast<double>(random() % 20), 1.0 + static_cast<double>(random() % 1000) / 16.0);
    for (auto n = random() % 4; n > 0; --n) {
      const double from = static_cast<double>(random() % 18) + 0.25;
      cam.line(from, from + 2.0, -1.0 - static_cast<double>(n), 0.0);
    }
    std::vector<bool> told(cam.point_count, false);
    for (const CamFinding& warning : findings(cam).warnings)
      if (!warning.transition && warning.element < told.size()) told[warning.element] = true;
    for (std::size_t i = 0; i < cam.point_count; ++i) {
      const auto at = [&] { return cam.f.value(cam.data->Point[i].x).position; };
      const double before = at();
      cam.data->Point[i].y += 5.0;
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
      EXPECT_EQ(at() == before, told[i]) << "point " << i;
      cam.data->Point[i].y -= 5.0;
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
    }
  });
}

}  // namespace
}  // namespace lockstep::cam_findings_test
