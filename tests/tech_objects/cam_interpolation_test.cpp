// The rules of interpolation: which elements count, how gaps are closed, what is refused.
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "tech_objects/cam_object/interpolation.hpp"
#include "tests/support/property.hpp"
#include "tests/tech_objects/cam_cases.hpp"

namespace lockstep::cam_interpolation_test {
namespace {

using test::Cam;
using test::Cam10k;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double at(const Cam& cam, double x) {
  return cam.f.value(x).position;
}
double slope_at(const Cam& cam, double x) {
  return cam.f.value(x).first_derivative;
}

/// a3 (x - x0)³ + y0 in coefficients of x.
TO_Cam_Struct_SegmentData cube(double xmin, double xmax, double x0, double y0, double a3) {
  TO_Cam_Struct_SegmentData s;
  s.xmin = xmin;
  s.xmax = xmax;
  s.a0 = y0 - a3 * x0 * x0 * x0;
  s.a1 = 3.0 * a3 * x0 * x0;
  s.a2 = -3.0 * a3 * x0;
  s.a3 = a3;
  return s;
}

TEST(CamInterpolation, AnEmptyCamIsRefusedAndLeavesNoCurve) {
  Cam cam;
  EXPECT_EQ(cam.interpolate(), ErrorId::cam_empty);
  cam.point(0.0, 1.0).point(1.0, 2.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  ASSERT_TRUE(cam.f.interpolated());
  cam.data->ValidPoint[0] = cam.data->ValidPoint[1] = false;
  EXPECT_EQ(cam.interpolate(), ErrorId::cam_empty);
  EXPECT_FALSE(cam.f.interpolated());
  EXPECT_EQ(at(cam, 0.5), 0.0);
}

TEST(CamInterpolation, LinearIsALineFromPointToPointAndTheValueToTheRightInACorner) {
  for (const DINT boundary : {0, 1}) {
    Cam cam;
    cam.mode(0, boundary).point(0.0, 0.0).point(10.0, 20.0).point(30.0, 10.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    EXPECT_EQ(at(cam, 5.0), 10.0);
    EXPECT_EQ(at(cam, 20.0), 15.0);
    EXPECT_EQ(slope_at(cam, 10.0), -0.5);
    EXPECT_EQ(slope_at(cam, 30.0), -0.5);
    EXPECT_EQ(cam.f.value(5.0).second_derivative, 0.0);
  }
}

TEST(CamInterpolation, PointsMayStandInAnyOrderAndOnlyValidOnesCount) {
  Cam cam;
  cam.point(30.0, 10.0).point(0.0, 0.0).point(5.0, 1000.0).point(10.0, 20.0);
  cam.data->ValidPoint[2] = false;
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(cam.f.start_leading_value(), 0.0);
  EXPECT_EQ(cam.f.end_leading_value(), 30.0);
  EXPECT_EQ(at(cam, 5.0), 10.0);
}

TEST(CamInterpolation, OfPointsWithEqualLeadingValueTheLastCounts) {
  Cam cam;
  cam.point(0.0, 0.0).point(10.0, 5.0).point(10.0, 7.0).point(20.0, 0.0).point(10.0, 3.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(at(cam, 10.0), 3.0);
  Cam zeros;  // -0 is 0
  zeros.point(0.0, 1.0).point(-0.0, 2.0).point(1.0, 3.0);
  ASSERT_EQ(zeros.interpolate(), ErrorId::none);
  EXPECT_EQ(at(zeros, 0.0), 2.0);
}

TEST(CamInterpolation, SegmentCoefficientsMeanTheLeadingValueItselfAndAreExactFarFromZero) {
  Cam cam;  // (x - 100)^6, whose terms are 1e12 times its value
  TO_Cam_Struct_SegmentData s;
  s.xmin = 99.0;
  s.xmax = 101.0;
  s.a0 = 1.0e12;
  s.a1 = -6.0e10;
  s.a2 = 15.0e8;
  s.a3 = -20.0e6;
  s.a4 = 15.0e4;
  s.a5 = -600.0;
  s.a6 = 1.0;
  cam.segment(s);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_NEAR(at(cam, 99.0), 1.0, 1.0e-14);
  EXPECT_NEAR(at(cam, 100.5), std::pow(0.5, 6), 1.0e-14);
  EXPECT_NEAR(slope_at(cam, 101.0), 6.0, 1.0e-13);
  EXPECT_NEAR(cam.f.value(100.5).second_derivative, 30.0 * std::pow(0.5, 4), 1.0e-13);
  EXPECT_NEAR(cam.f.lowest_following_value(), 0.0, 1.0e-14);
  EXPECT_NEAR(cam.f.highest_following_value(), 1.0, 1.0e-14);
}

TEST(CamInterpolation, TheSineOfASegmentHasAnAngularFrequencyAndKeepsItsPhaseFarFromZero) {
  for (const double origin : {0.0, 1.0e6, 1.0e9}) {
    Cam cam;
    TO_Cam_Struct_SegmentData s;
    s.xmin = origin;
    s.xmax = origin + 10.0;
    s.a0 = 5.0;
    s.sineAmplitude = 3.0;
    s.sinePeriod = -2.5;
    s.sinePhase = 0.75;
    cam.segment(s);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    for (double d = 0.0; d <= 10.0; d += 0.125) {
      // The angle as long double: 64 bits are enough for these origins.
      const long double angle = -2.5L * (static_cast<long double>(origin) + d) + 0.75L;
      const CamValue value = cam.f.value(origin + d);
      EXPECT_NEAR(value.position, static_cast<double>(5.0L + 3.0L * std::sin(angle)), 2.0e-9 * 3.0);
      EXPECT_NEAR(value.first_derivative, static_cast<double>(-7.5L * std::cos(angle)), 2.0e-9 * 7.5);
      EXPECT_NEAR(value.second_derivative, static_cast<double>(-18.75L * std::sin(angle)), 2.0e-9 * 18.75);
    }
    EXPECT_NEAR(cam.f.highest_following_value(), 8.0, 1.0e-14);
    EXPECT_NEAR(cam.f.lowest_following_value(), 2.0, 1.0e-14);
  }
}

TEST(CamInterpolation, PointsInsideASegmentDoNotCountNorDoThoseOnItsEnds) {
  Cam cam;
  cam.line(10.0, 20.0, 0.0, 1.0);
  cam.point(0.0, 0.0).point(10.0, 99.0).point(15.0, 99.0).point(20.0, 99.0).point(30.0, 10.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(at(cam, 5.0), 0.0);
  EXPECT_DOUBLE_EQ(at(cam, 15.0), 5.0);
  EXPECT_DOUBLE_EQ(at(cam, 25.0), 10.0);
  EXPECT_EQ(cam.f.end_leading_value(), 30.0);
}

TEST(CamInterpolation, AGapUpToATenThousandthIsClosedAndALargerOneGetsATransition) {
  for (const double gap : {1.0e-9, 0.99e-4, 1.01e-4, 1.0e-3}) {
    Cam cam;
    cam.mode(1).line(0.0, 10.0, 0.0, 1.0).line(10.0 + gap, 20.0, 10.0 + gap, 1.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    EXPECT_EQ(cam.f.piece_count(), gap <= 1.0e-4 ? 2u : 3u) << gap;
    EXPECT_NEAR(at(cam, 10.0 + 0.5 * gap), 10.0 + 0.5 * gap, 1.0e-12);
  }
}

TEST(CamInterpolation, AGapWrittenAsExactlyATenThousandthIsClosedWhateverItsDoublesAre) {
  for (const auto& [end, start] :
       {std::pair{10.0, 10.0001}, {359.9998, 359.9999}, {0.0001, 0.0002}, {1.0e6, 1000000.0001}}) {
    Cam cam;
    cam.mode(1).line(end - 1.0, end, 0.0, 1.0).line(start, start + 1.0, 1.0, 1.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    EXPECT_EQ(cam.f.piece_count(), 2u) << end;
  }
}

TEST(CamInterpolation, APointJustBesideASegmentDoesNotCountButStillBoundsTheCam) {
  Cam cam;
  cam.mode(1).line(0.00005, 359.99999, 0.00005, 1.0).point(0.0, 7.0).point(360.0, 9.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(cam.f.start_leading_value(), 0.0);
  EXPECT_EQ(cam.f.end_leading_value(), 360.0);
  EXPECT_NEAR(at(cam, 0.0), 0.0, 1.0e-12);
  EXPECT_NEAR(at(cam, 360.0), 360.0, 1.0e-9);
}

TEST(CamInterpolation, TheSegmentThatBeginsLaterIsUsedWholeAndThenTheEarlierAgain) {
  Cam cam;
  cam.line(0.0, 30.0, 0.0, 0.0).line(10.0, 20.0, 1.0, 0.0).line(12.0, 14.0, 2.0, 0.0);
  cam.line(25.0, 40.0, 3.0, 0.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(at(cam, 9.999), 0.0);
  EXPECT_EQ(at(cam, 10.0), 1.0);
  EXPECT_EQ(at(cam, 12.0), 2.0);
  EXPECT_EQ(at(cam, 14.0), 1.0);
  EXPECT_EQ(at(cam, 20.0), 0.0);
  EXPECT_EQ(at(cam, 24.999), 0.0);
  EXPECT_EQ(at(cam, 25.0), 3.0);
  EXPECT_EQ(at(cam, 39.0), 3.0);
}

TEST(CamInterpolation, OfSegmentsThatBeginTogetherTheLastCounts) {
  Cam cam;
  cam.line(0.0, 30.0, 1.0, 0.0).line(0.0, 10.0, 2.0, 0.0).line(0.0, 5.0, 3.0, 0.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(at(cam, 4.0), 3.0);
  EXPECT_EQ(at(cam, 6.0), 2.0);
  EXPECT_EQ(at(cam, 11.0), 1.0);
}

TEST(CamInterpolation, BesideASegmentValueAndSlopeAreContinuousWithSplinesOfEitherKind) {
  for (const DINT mode : {1, 2})
    for (const int points_between : {0, 1, 2, 5}) {
      SCOPED_TRACE(testing::Message() << "mode " << mode << ", " << points_between << " points between");
      Cam cam;
      cam.mode(mode).point(-20.0, 3.0).point(-10.0, -2.0);
      cam.segment(cube(0.0, 10.0, 3.0, 1.0, 0.01)).line(40.0, 50.0, 12.0, -0.5);
      for (int k = 1; k <= points_between; ++k)
        cam.point(10.0 + 30.0 * k / (points_between + 1), k % 2 == 0 ? 4.0 : 9.0);
      cam.point(60.0, 0.0).point(65.0, 10.0).point(80.0, 4.0);
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
      for (const double x : {0.0, 10.0, 40.0, 50.0}) {
        const CamValue before = cam.f.value(std::nextafter(x, -1.0e9));
        const CamValue after = cam.f.value(x);
        EXPECT_NEAR(before.position, after.position, 1.0e-12) << x;
        EXPECT_NEAR(before.first_derivative, after.first_derivative, 1.0e-12) << x;
      }
      EXPECT_EQ(at(cam, -20.0), 3.0);
      EXPECT_EQ(at(cam, 80.0), 4.0);
    }
}

TEST(CamInterpolation, AGapWithoutPointsIsACubicHermite) {
  for (const DINT mode : {1, 2}) {
    Cam cam;
    cam.mode(mode).line(0.0, 10.0, 0.0, 0.0).line(20.0, 30.0, 10.0, 0.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    for (double t = 0.0; t <= 1.0; t += 0.0625) {
      const CamValue value = cam.f.value(10.0 + 10.0 * t);
      EXPECT_NEAR(value.position, 10.0 * t * t * (3.0 - 2.0 * t), 1.0e-13);
      EXPECT_NEAR(value.first_derivative, 6.0 * t * (1.0 - t), 1.0e-13);
      EXPECT_NEAR(value.second_derivative, 0.6 * (1.0 - 2.0 * t) * (t < 1.0 ? 1.0 : 0.0), 1.0e-12);
    }
  }
}

TEST(CamInterpolation, WithBoundaryConditionsTheFreeEndTakesTheSlopeOfTheSegmentAtTheOther) {
  for (const DINT mode : {1, 2}) {
    Cam start;
    start.mode(mode, 1).line(0.0, 10.0, 0.0, 0.25).point(20.0, 5.0).point(30.0, -5.0);
    ASSERT_EQ(start.interpolate(), ErrorId::none);
    EXPECT_NEAR(slope_at(start, 30.0), 0.25, 1.0e-13);
    EXPECT_EQ(at(start, 30.0), -5.0);
    Cam end;
    end.mode(mode, 1).point(-20.0, 5.0).line(0.0, 10.0, 0.0, 0.25);
    ASSERT_EQ(end.interpolate(), ErrorId::none);
    EXPECT_NEAR(slope_at(end, -20.0), 0.25, 1.0e-13);
    EXPECT_EQ(at(end, -20.0), 5.0);
  }
}

TEST(CamInterpolation, WithBoundaryConditionsTwoFreeEndsBesideSegmentsAgree) {
  for (const DINT mode : {1, 2}) {
    Cam cam;
    cam.mode(mode, 1).point(0.0, 1.0).point(10.0, 3.0).point(20.0, 0.0).line(30.0, 40.0, 0.0, 1.0);
    cam.point(50.0, 8.0).point(60.0, 2.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    const CamValue start = cam.f.value(0.0);
    const CamValue end = cam.f.value(60.0);
    EXPECT_NEAR(start.first_derivative, end.first_derivative, 1.0e-13);
    if (mode == 1) {
      EXPECT_NEAR(start.second_derivative, end.second_derivative, 1.0e-13);
    }
    EXPECT_NEAR(slope_at(cam, std::nextafter(30.0, 0.0)), 1.0, 1.0e-12);
    EXPECT_NEAR(slope_at(cam, 40.0), 1.0, 1.0e-12);
  }
}

TEST(CamInterpolation, WithBoundaryConditionsSegmentsWithUnequalSlopesAtTheEndsAreRefused) {
  for (const DINT mode : {0, 1, 2}) {
    Cam cam;
    cam.mode(mode, 1).line(0.0, 10.0, 0.0, 1.0).line(20.0, 30.0, 0.0, 1.001);
    EXPECT_EQ(cam.interpolate(), mode == 0 ? ErrorId::none : ErrorId::cam_elements_wrong);
    cam.data->Segment[1].a1 = 1.0;
    EXPECT_EQ(cam.interpolate(), ErrorId::none);
  }
}

TEST(CamInterpolation, FewPointsAreEnoughForEveryMode) {
  for (const DINT mode : {0, 1, 2})
    for (const DINT boundary : {0, 1})
      for (const int count : {2, 3, 4}) {
        Cam cam;
        cam.mode(mode, boundary);
        for (int i = 0; i < count; ++i) cam.point(i * 10.0, (i * 7) % 4);
        ASSERT_EQ(cam.interpolate(), ErrorId::none);
        EXPECT_EQ(at(cam, 0.0), 0.0);
        EXPECT_EQ(at(cam, (count - 1) * 10.0), ((count - 1) * 7) % 4);
        if (mode != 0 && boundary == 1) {
          EXPECT_NEAR(slope_at(cam, 0.0), slope_at(cam, (count - 1) * 10.0), 1.0e-13);
        }
      }
}

TEST(CamInterpolation, ABezierCamOfPointsStaysWithinTheRangeOfItsPoints) {
  Cam cam;
  cam.mode(2);
  std::mt19937_64 random(test::seed_of_test(7));
  std::uniform_real_distribution<double> y(0.0, 1.0);
  for (int i = 0; i < 200; ++i) cam.point(i + 0.9 * y(random), y(random));
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_GE(cam.f.lowest_following_value(), 0.0);
  EXPECT_LE(cam.f.highest_following_value(), 1.0);
}

TEST(CamInterpolation, ValuesThatAreNoNumbersOrTooLargeAreRefused) {
  for (const double wrong : {kNan, kInfinity, -kInfinity, 1.0e12 * 1.0001, -1.0e300}) {
    Cam x;
    EXPECT_EQ(x.point(0.0, 0.0).point(wrong, 0.0).interpolate(), ErrorId::cam_elements_wrong);
    Cam y;
    EXPECT_EQ(y.point(0.0, 0.0).point(1.0, wrong).interpolate(), ErrorId::cam_elements_wrong);
    for (double TO_Cam_Struct_SegmentData::*member :
         {&TO_Cam_Struct_SegmentData::xmin, &TO_Cam_Struct_SegmentData::xmax, &TO_Cam_Struct_SegmentData::a0,
          &TO_Cam_Struct_SegmentData::a6, &TO_Cam_Struct_SegmentData::sineAmplitude,
          &TO_Cam_Struct_SegmentData::sinePeriod, &TO_Cam_Struct_SegmentData::sinePhase}) {
      Cam cam;
      cam.line(0.0, 1.0, 0.0, 1.0);
      cam.data->Segment[0].*member = wrong;
      EXPECT_EQ(cam.interpolate(), ErrorId::cam_elements_wrong);
      EXPECT_FALSE(cam.f.interpolated());
      cam.data->ValidSegment[0] = false;  // what does not count is not looked at
      EXPECT_EQ(cam.point(0.0, 0.0).point(1.0, 1.0).interpolate(), ErrorId::none);
    }
  }
}

TEST(CamInterpolation, SegmentsThatDescendOrHaveNoLengthAreRefused) {
  EXPECT_EQ(Cam().line(1.0, 0.0, 0.0, 1.0).interpolate(), ErrorId::cam_elements_wrong);
  EXPECT_EQ(Cam().line(1.0, 1.0, 0.0, 1.0).interpolate(), ErrorId::cam_elements_wrong);
}

TEST(CamInterpolation, TenThousandEqualPointsAndASinglePointAreRefused) {
  Cam10k equal;
  for (std::size_t i = 0; i < kCam10kPoints; ++i) equal.point(5.0, static_cast<double>(i));
  for (const DINT mode : {0, 1, 2}) EXPECT_EQ(equal.mode(mode).interpolate(), ErrorId::cam_elements_wrong);
  EXPECT_EQ(Cam().point(1.0, 1.0).interpolate(), ErrorId::cam_elements_wrong);
}

TEST(CamInterpolation, TenThousandDescendingPointsAreSorted) {
  Cam10k cam;
  for (std::size_t i = 0; i < kCam10kPoints; ++i) cam.point(10000.0 - static_cast<double>(i), 2.0);
  for (const DINT mode : {0, 1, 2}) {
    ASSERT_EQ(cam.mode(mode).interpolate(), ErrorId::none);
    EXPECT_EQ(cam.f.start_leading_value(), 1.0);
    EXPECT_EQ(cam.f.value(1234.5).position, 2.0);
  }
}

TEST(CamInterpolation, LinearIgnoresBoundaryConditions) {
  for (const DINT boundary : {0, 1}) {
    test::Cam cam;
    cam.mode(0, boundary).line(0.0, 10.0, 0.0, 1.0).point(15.0, 0.0).line(20.0, 30.0, 5.0, -2.0);
    ASSERT_EQ(cam.interpolate(), ErrorId::none) << "slopes at both ends differ, and that is no error";
    EXPECT_EQ(cam.f.value(0.0).first_derivative, 1.0);
    EXPECT_EQ(cam.f.value(12.0).first_derivative, -2.0);
    EXPECT_EQ(cam.f.value(30.0).first_derivative, -2.0);
  }
}

TEST(CamInterpolation, TheStatusShowsTheRangeAndTheValidElements) {
  Cam cam;
  cam.line(10.0, 20.0, 0.0, 1.0).point(-4.0, 0.0).point(15.0, 0.0).point(18.0, 0.0).point(25.0, 1.0);
  cam.data->ValidPoint[3] = false;
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  const TO_Cam_Struct_StatusCam status = status_of(elements_of(*cam.data), cam.f);
  EXPECT_EQ(status.StartLeadingValue, -4.0);
  EXPECT_EQ(status.EndLeadingValue, 20.0);
  EXPECT_EQ(status.NumberOfValidPoints, 3);  // also those that a segment covers
  EXPECT_EQ(status.NumberOfValidSegments, 1);
}

TEST(CamInterpolation, UnknownSettingsAreRefused) {
  for (const auto& [mode, boundary] : {std::pair{-1, 0}, {3, 0}, {0, -1}, {0, 2}}) {
    Cam cam;
    EXPECT_EQ(cam.mode(mode, boundary).point(0.0, 0.0).point(1.0, 1.0).interpolate(),
              ErrorId::cam_elements_wrong);
  }
}

TEST(CamInterpolation, PointsTooNearForADoubleAreRefusedAndNeverGiveANumberThatIsNotFinite) {
  Cam cam;
  cam.point(0.0, 0.0).point(5.0e-324, 1.0e12).point(1.0, 0.0);
  for (const DINT mode : {0, 1, 2}) EXPECT_EQ(cam.mode(mode).interpolate(), ErrorId::cam_elements_wrong);
}

TEST(CamInterpolation, MoreThan1024PeriodsOfSinesAreRefused) {
  Cam cam;
  TO_Cam_Struct_SegmentData s;
  s.xmax = 1.0;
  s.sineAmplitude = 1.0;
  s.sinePeriod = 1023.0 * 6.283185307179586;
  cam.segment(s);
  EXPECT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(cam.f.piece_count(), 2u * 1023u + 1u);
  cam.data->Segment[0].sinePeriod = 1025.0 * 6.283185307179586;
  EXPECT_EQ(cam.interpolate(), ErrorId::cam_elements_wrong);
  cam.data->Segment[0].sineAmplitude = 0.0;
  EXPECT_EQ(cam.interpolate(), ErrorId::none);
}

TEST(CamInterpolation, RandomElementsGiveAFiniteCurveWithinItsExtremaOrAnError) {
  int interpolated = 0;
  const test::Cases ran = test::for_each_seed(20240611, test::cases(600, 60'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    Cam cam;
    cam.mode(static_cast<DINT>(random() % 3), static_cast<DINT>(random() % 2));
    const double scale = std::pow(10.0, 12.0 * part(random) - 6.0);
    for (auto n = random() % 20; n > 0; --n) cam.point(scale * part(random), part(random) - 0.5);
    for (auto n = random() % 6; n > 0; --n) {
      TO_Cam_Struct_SegmentData s;
      s.xmin = scale * part(random);
      s.xmax = s.xmin + scale * 0.3 * part(random);
      s.a0 = part(random);
      s.a1 = (part(random) - 0.5) / scale;
      s.a3 = (part(random) - 0.5) / (scale * scale * scale);
      s.a6 = (part(random) - 0.5) / std::pow(scale, 6);
      s.sineAmplitude = random() % 2 == 0 ? 0.0 : part(random);
      s.sinePeriod = 100.0 * (part(random) - 0.5) / scale;
      s.sinePhase = 1000.0 * part(random);
      cam.segment(s);
    }
    if (cam.interpolate() != ErrorId::none) {
      EXPECT_FALSE(cam.f.interpolated());
      return;
    }
    ++interpolated;
    const double length = cam.f.end_leading_value() - cam.f.start_leading_value();
    const double slack = 1.0e-11 * std::max(std::abs(cam.f.lowest_following_value()),
                                            std::abs(cam.f.highest_following_value()));
    for (int k = 0; k <= 500; ++k) {
      const CamValue value = cam.f.value(cam.f.start_leading_value() + length * k / 500.0);
      ASSERT_TRUE(std::isfinite(value.position) && std::isfinite(value.first_derivative) &&
                  std::isfinite(value.second_derivative));
      ASSERT_GE(value.position, cam.f.lowest_following_value() - slack);
      ASSERT_LE(value.position, cam.f.highest_following_value() + slack);
    }
  });
  if (ran.alone) return;
  EXPECT_GT(interpolated, ran.count / 2);
}

TEST(CamInterpolation, TenThousandPointsTakeMilliseconds) {
  Cam10k cam;
  std::mt19937_64 random(test::seed_of_test(3));
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double x = 0.0;
  for (std::size_t i = 0; i < kCam10kPoints; ++i) cam.point(x += 0.01 + part(random), part(random));
  for (const DINT mode : {0, 1, 2}) {
    cam.mode(mode, 1);
    auto best = std::chrono::nanoseconds::max();
    for (int run = 0; run < 5; ++run) {
      const auto begin = std::chrono::steady_clock::now();
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
      best = std::min<std::chrono::nanoseconds>(best, std::chrono::steady_clock::now() - begin);
    }
    RecordProperty("mode_" + std::to_string(mode) + "_us", static_cast<int>(best.count() / 1000));
    EXPECT_LT(best,
              std::chrono::milliseconds(100));  // an unoptimised build with sanitizers on a busy machine
  }
}

}  // namespace
}  // namespace lockstep::cam_interpolation_test
