// The function of a cam: hints, ends, extrema and the search for a leading value.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tech_objects/cam/function.hpp"
#include "tech_objects/cam/sine.hpp"
#include "tests/support/property.hpp"
#include "tests/tech_objects/cam_cases.hpp"

namespace lockstep::cam_function_test {
namespace {

using test::Cam;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool same(const CamValue& a, const CamValue& b) {
  return a.position == b.position && a.first_derivative == b.first_derivative &&
         a.second_derivative == b.second_derivative;
}

/// A cam with every kind of piece.
void fill_mixed(Cam& cam, DINT mode, std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  cam.mode(mode);
  for (int i = 0; i < 40; ++i) cam.point(i * 5.0 + 4.0 * part(random), 10.0 * part(random));
  TO_Cam_Struct_SegmentData s;
  s.xmin = 50.0;
  s.xmax = 90.0;
  s.a1 = 0.1;
  s.sineAmplitude = 4.0;
  s.sinePeriod = 0.7;
  cam.segment(s);
}

TEST(CamFunction, AnyHintGivesTheSameBits) {
  std::mt19937_64 random(test::seed_of_test(99));
  for (const DINT mode : {0, 1, 2}) {
    Cam cam;
    fill_mixed(cam, mode, random);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    CamHint moving;
    for (int k = 0; k < 20000; ++k) {
      const double x = -1.0 + 202.0 * static_cast<double>(k) / 20000.0;
      CamHint wild{static_cast<std::uint32_t>(random())};
      CamHint near{static_cast<std::uint32_t>(random() % (cam.f.piece_count() + 2))};
      const CamValue expected = cam.f.value(x);
      ASSERT_TRUE(same(expected, cam.f.value(x, moving)));
      ASSERT_TRUE(same(expected, cam.f.value(x, wild)));
      ASSERT_TRUE(same(expected, cam.f.value(x, near)));
    }
  }
}

TEST(CamFunction, OutsideTheRangeOfDefinitionItHoldsTheEndsAndSaysSo) {
  Cam cam;
  cam.mode(1).point(-5.0, 1.0).point(0.0, 3.0).point(7.0, 2.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  for (const double x : {-5.0, -5.1, -1.0e300, -kInfinity, kNan}) EXPECT_EQ(cam.f.value(x).position, 1.0);
  for (const double x : {7.0, 7.1, 1.0e300, kInfinity}) EXPECT_EQ(cam.f.value(x).position, 2.0);
  EXPECT_TRUE(cam.f.defined_at(-5.0) && cam.f.defined_at(7.0) && cam.f.defined_at(0.0));
  EXPECT_FALSE(cam.f.defined_at(std::nextafter(-5.0, -6.0)) || cam.f.defined_at(std::nextafter(7.0, 8.0)) ||
               cam.f.defined_at(kNan));
}

TEST(CamFunction, BeforeTheFirstInterpolationItIsZeroAndDefinedNowhere) {
  const CamFunction f(10);
  EXPECT_FALSE(f.interpolated());
  EXPECT_FALSE(f.defined_at(0.0));
  for (const double x : {0.0, 1.0, -1.0, kNan, kInfinity}) EXPECT_TRUE(same(f.value(x), {}));
  EXPECT_FALSE(f.leading_value(0.0, 0.0).has_value());
}

TEST(CamFunction, TheValuesAtStartAndEndAreThoseOfTheElementsToTheLastBit) {
  std::mt19937_64 random(test::seed_of_test(4));
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const DINT mode : {0, 1, 2})
    for (int run = 0; run < test::cases(100, 10'000); ++run) {
      Cam cam;
      cam.mode(mode, run % 2);
      for (int i = 0; i < 20; ++i) cam.point(i + 0.9 * part(random), part(random));
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
      EXPECT_EQ(cam.f.value(cam.f.start_leading_value()).position, cam.data->Point[0].y);
      EXPECT_EQ(cam.f.value(cam.f.end_leading_value()).position, cam.data->Point[19].y);
      EXPECT_EQ(cam.f.end_following_value(), cam.data->Point[19].y);
      EXPECT_EQ(cam.f.start_following_value(), cam.data->Point[0].y);
    }
}

TEST(CamFunction, ACamThatBeginsOrEndsWithASegmentKnowsItsValuesThere) {
  Cam cam;
  TO_Cam_Struct_SegmentData s;
  s.xmin = 20.0;
  s.xmax = 60.0;
  s.a0 = -5.0;
  s.a1 = 0.75;
  cam.segment(s);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_EQ(cam.f.start_following_value(), 10.0);
  EXPECT_EQ(cam.f.start_following_value(), cam.f.value(20.0).position);
  EXPECT_EQ(cam.f.end_following_value(), 40.0);
  EXPECT_EQ(cam.f.end_following_value(), cam.f.value(60.0).position);
}

TEST(CamFunction, IsContinuousAcrossEveryPiece) {
  std::mt19937_64 random(test::seed_of_test(17));
  for (const DINT mode : {0, 1, 2}) {
    Cam cam;
    fill_mixed(cam, mode, random);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    CamHint hint;
    double last = cam.f.start_following_value();
    constexpr int kSteps = 400000;
    for (int k = 1; k <= kSteps; ++k) {
      const double x = cam.f.start_leading_value() +
                       (cam.f.end_leading_value() - cam.f.start_leading_value()) * k / kSteps;
      const double y = cam.f.value(x, hint).position;
      ASSERT_LE(std::abs(y - last), 0.02) << x;  // 0.0005 leading units times the steepest slope
      last = y;
    }
  }
}

TEST(CamFunction, FindsOfAllLeadingValuesTheOneNearestToTheApproach) {
  Cam cam;  // up, down, up
  cam.point(0.0, 0.0).point(10.0, 10.0).point(20.0, 0.0).point(40.0, 20.0);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 0.0), 5.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 9.9), 5.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 10.1), 15.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 19.0), 15.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 21.0), 25.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 1.0e9), 25.0, 1.0e-12);
  EXPECT_NEAR(*cam.f.leading_value(5.0, 10.0), 5.0, 1.0e-12);  // equally near: the lower
  EXPECT_NEAR(*cam.f.leading_value(15.0, 0.0), 35.0, 1.0e-12);
  EXPECT_EQ(*cam.f.leading_value(20.0, 0.0), 40.0);
  EXPECT_EQ(*cam.f.leading_value(10.0, 0.0), 10.0);
}

TEST(CamFunction, AValueThatTheCamDoesNotTakeHasNoLeadingValue) {
  Cam cam;
  cam.mode(1).point(0.0, 0.0).point(1.0, 1.0).point(2.0, 0.5);
  ASSERT_EQ(cam.interpolate(), ErrorId::none);
  EXPECT_FALSE(cam.f.leading_value(cam.f.highest_following_value() + 1.0e-9, 1.0));
  EXPECT_TRUE(cam.f.leading_value(cam.f.highest_following_value(), 1.0));
  EXPECT_FALSE(cam.f.leading_value(-0.01, 1.0));
  for (const double wrong : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(cam.f.leading_value(wrong, 1.0));
    EXPECT_FALSE(cam.f.leading_value(0.5, wrong));
  }
  Cam step;  // two segments with a step between them
  step.line(0.0, 1.0, 0.0, 0.0).line(1.0, 2.0, 1.0, 0.0);
  ASSERT_EQ(step.interpolate(), ErrorId::none);
  EXPECT_FALSE(step.f.leading_value(0.5, 1.0));
  EXPECT_EQ(*step.f.leading_value(0.0, 0.3), 0.3);  // standing: the approach itself
  EXPECT_EQ(*step.f.leading_value(1.0, 0.3), 1.0);
}

TEST(CamFunction, AFollowingValueARoundingBeyondAnExtremumHasItsLeadingValue) {
  test::Cam cam;
  ASSERT_EQ(cam.mode(0).point(0.0, 0.0).point(10.0, 100.0).point(20.0, 0.0).interpolate(), ErrorId::none);
  EXPECT_EQ(cam.f.leading_value(100.0 + 0.9e-10, 0.0), 10.0);  // 1.0E-12 of the largest value
  EXPECT_EQ(cam.f.leading_value(100.0 + 1.1e-10, 0.0), std::nullopt);
  EXPECT_EQ(cam.f.leading_value(-0.9e-10, 3.0), 0.0);
  EXPECT_EQ(cam.f.leading_value(-1.1e-10, 3.0), std::nullopt);
}

TEST(CamFunction, TheNearestLeadingValueIsNeverFartherThanAnyThatAScanFinds) {
  test::for_each_seed(5150, test::cases(120, 12'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    Cam cam;
    fill_mixed(cam, static_cast<DINT>(one.seed % 3), random);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    const double start = cam.f.start_leading_value();
    const double length = cam.f.end_leading_value() - start;
    for (int query = 0; query < 5; ++query) {
      const double y = cam.f.lowest_following_value() +
                       (cam.f.highest_following_value() - cam.f.lowest_following_value()) * part(random);
      const double approach = start + length * (1.4 * part(random) - 0.2);
      const double near = std::clamp(approach, start, start + length);
      const auto found = cam.f.leading_value(y, approach);
      ASSERT_TRUE(found);
      EXPECT_NEAR(cam.f.value(*found).position, y, 1.0e-9);
      double scanned = kInfinity;
      CamHint hint;
      double last = cam.f.value(start, hint).position;
      for (int k = 1; k <= 4000; ++k) {
        const double x = start + length * k / 4000.0;
        const double value = cam.f.value(x, hint).position;
        if ((last < y) != (value < y)) scanned = std::min(scanned, std::abs(x - near));
        last = value;
      }
      EXPECT_LE(std::abs(*found - near), scanned + length / 4000.0);
    }
  });
}

TEST(CamFunction, APairShowsTheSpareOnlyAfterTheSwap) {
  Cam cam;
  CamFunctionPair pair(kCamPoints);
  cam.point(0.0, 1.0).point(1.0, 1.0);
  ASSERT_EQ(cam.interpolator.interpolate(elements_of(*cam.data), pair.spare()), ErrorId::none);
  EXPECT_FALSE(pair.active().interpolated());
  pair.swap();
  EXPECT_EQ(pair.active().value(0.5).position, 1.0);
  cam.data->Point[0].y = cam.data->Point[1].y = 2.0;
  ASSERT_EQ(cam.interpolator.interpolate(elements_of(*cam.data), pair.spare()), ErrorId::none);
  EXPECT_EQ(pair.active().value(0.5).position, 1.0);
  pair.swap();
  EXPECT_EQ(pair.active().value(0.5).position, 2.0);
}

TEST(CamSine, AgreesWithTheLibraryToTwoUlpOfOne) {
  std::mt19937_64 random(test::seed_of_test(11));
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int k = 0; k < test::cases(200'000, 20'000'000); ++k) {
    const double angle = part(random) * (k % 2 == 0 ? 4.0 : 1.0e5);
    const SineCosine found = sine_cosine(angle);
    ASSERT_NEAR(found.sine, static_cast<double>(std::sin(static_cast<long double>(angle))), 4.5e-16) << angle;
    ASSERT_NEAR(found.cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), 4.5e-16)
        << angle;
  }
  EXPECT_EQ(sine_cosine(0.0).sine, 0.0);
  EXPECT_EQ(sine_cosine(0.0).cosine, 1.0);
}

}  // namespace
}  // namespace lockstep::cam_function_test
