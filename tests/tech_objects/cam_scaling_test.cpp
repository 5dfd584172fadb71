// Scalings of a cam from the smallest to the largest: what a position belongs to stays exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "tech_objects/cam/motion.hpp"
#include "tech_objects/cam_object/interpolation.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cam_scaling_test {
namespace {

constexpr Modulo kLine{};
constexpr double kLength = 360.0;  // of the cam [leading u]
constexpr int kFinest = 12;        // positions here are multiples of 2^-12, as those at 1.0E12 are

CamFunction wave() {
  const TO_Cam_Struct_PointData points[] = {
      {0.0, 0.0}, {90.0, 30.0}, {180.0, 50.0}, {270.0, 10.0}, {kLength, 0.0}};
  const BOOL valid[] = {true, true, true, true, true};
  CamFunction function(5);
  CamInterpolator interpolator(5);
  const CamElements elements{points, valid, {}, {}, {1, 1}};
  EXPECT_EQ(interpolator.interpolate(elements, function), ErrorId::none);
  return function;
}

/// Leading value in the cam at a position, by whole numbers.
double exact_leading_value(double position, double scaling) {
  __extension__ using Wide = __int128;
  int exponent = 0;
  const double mantissa = std::frexp(scaling, &exponent);  // of 53 bits
  const int unit = std::min(exponent - 53, -kFinest);
  const auto pass = static_cast<Wide>(std::ldexp(mantissa, 53)) * static_cast<Wide>(kLength)
                    << (exponent - 53 - unit);
  Wide rest = (static_cast<Wide>(std::ldexp(position, kFinest)) << (-kFinest - unit)) % pass;
  if (rest < 0) rest += pass;
  return std::ldexp(static_cast<double>(rest), unit) / scaling;
}

double log_uniform(std::mt19937_64& random, double minimum, double maximum) {
  return minimum * std::exp(std::uniform_real_distribution<double>(0.0, std::log(maximum / minimum))(random));
}

TEST(CamScaling, RepeatsExactlyAtEveryPositionThatThereIs) {
  const CamFunction f = wave();
  test::for_each_seed(1, test::cases(300, 30'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const double scaling = log_uniform(random, 1.0001e-6 / kLength, 1e12);
    CamFollowing cam;
    cam.set(f, {scaling, 1.0, CamMode::cyclic}, {0, 0.0}, {}, kLine, kLine);
    for (int i = 0; i < 20; ++i) {
      const double far = log_uniform(random, 1.0, 1e12) * (random() % 2 == 0 ? 1.0 : -1.0);
      const double position = std::ldexp(std::floor(std::ldexp(far, kFinest)), -kFinest);
      const double reference = f.value(exact_leading_value(position, scaling)).position;
      ASSERT_NEAR(cam.value({0, position}).position.value, reference, 1e-11)
          << "at " << position << ", scaled by " << scaling;
    }
  });
}

TEST(CamScaling, PassedOnceIsTheCurveHoweverShort) {
  const CamFunction f = wave();
  test::for_each_seed(1, test::cases(300, 30'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const double scaling = log_uniform(random, 1e-12 / kLength, 1e12);
    CamFollowing cam;
    cam.set(f, {scaling, 1.0, CamMode::once}, {0, 0.0}, {}, kLine, kLine);
    for (int i = 0; i < 20; ++i) {
      const double place = std::uniform_real_distribution<double>(0.0, kLength)(random);
      const CamFollowingValue at = cam.value({0, place * scaling});
      const CamValue reference = f.value(place);
      ASSERT_NEAR(at.position.value, reference.position, 1e-11);
      ASSERT_NEAR(at.slope * scaling, reference.first_derivative, 1e-12);
      ASSERT_NEAR(at.curvature * scaling * scaling, reference.second_derivative, 1e-13);
    }
  });
}

TEST(CamScaling, OfTheFollowingSideBy0RestsEverywhere) {
  const CamFunction f = wave();
  for (const CamMode mode : {CamMode::once, CamMode::cyclic, CamMode::appended})
    for (const Modulo& following : {kLine, Modulo{true, 360.0, -180.0}}) {
      EXPECT_TRUE(CamFollowing::closes(f, 0.0, following));
      CamFollowing cam;
      cam.set(f, {1.0, 0.0, mode}, {0, 0.0}, {}, kLine, following);
      for (double leading = 0.5; leading < (mode == CamMode::once ? 360.0 : 3000.0); leading += 7.3) {
        const CamFollowingValue at = cam.value({0, leading});
        ASSERT_EQ(at.position.value, 0.0);
        ASSERT_EQ(at.position.turns, 0);
        ASSERT_EQ(at.slope, 0.0);
        ASSERT_EQ(at.curvature, 0.0);
        const CamFollowingValue joined = cam.joined_at({0, leading}, 1);
        ASSERT_EQ(joined.slope, 0.0);
        ASSERT_EQ(joined.curvature, 0.0);
      }
      EXPECT_TRUE(cam.rests_at(CamEnd::at_end));
      EXPECT_TRUE(cam.rests_at(CamEnd::at_start));
    }
}

}  // namespace
}  // namespace lockstep::cam_scaling_test
