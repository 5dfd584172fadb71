// A cam applied to positions: scaling, passes without drift, both ends.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "tech_objects/cam/motion.hpp"
#include "tech_objects/cam_object/interpolation.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cam_motion_test {
namespace {

constexpr Modulo kRing{true, 360.0, 0.0};
constexpr Modulo kLine{};

// A curve through points, as cubic splines.
CamFunction curve(const std::vector<TO_Cam_Struct_PointData>& points, DINT boundary = 0, DINT mode = 1) {
  const auto valid = std::make_unique<BOOL[]>(points.size());
  std::fill_n(valid.get(), points.size(), true);
  CamFunction function(points.size());
  CamInterpolator interpolator(points.size());
  const CamElements elements{points, {valid.get(), points.size()}, {}, {}, {mode, boundary}};
  EXPECT_EQ(interpolator.interpolate(elements, function), ErrorId::none);
  return function;
}

CamFunction wave() {
  return curve({{0.0, 0.0}, {90.0, 30.0}, {180.0, 50.0}, {270.0, 10.0}, {360.0, 0.0}}, 1);
}

CamFunction feed() {
  return curve({{0.0, 0.0}, {120.0, 5.0}, {240.0, 35.0}, {360.0, 40.0}}, 1);
}

CamFollowing applied(const CamFunction& function, const CamUse& use, const Modulo& leading = kLine,
                     const Modulo& following = kLine) {
  CamFollowing cam;
  cam.set(function, use, {0, 0.0}, {}, leading, following);
  return cam;
}

TEST(CamFollowing, IsTheScaledAndShiftedCurve) {
  const CamFunction f = wave();
  CamFollowing cam;
  // MasterOffset 100, MasterScaling 2: the cam starts at 100.
  cam.set(f, {2.0, -0.5, CamMode::once}, {0, 160.0}, {60.0, 0.0}, kLine, kLine);
  cam.value({0, 100.0});  // back to its start
  EXPECT_EQ(cam.ended(), CamEnd::at_start);
  cam.clear_end();
  for (double leading = 100.0; leading < 820.0; leading += 7.3) {
    const CamValue reference = f.value((leading - 100.0) / 2.0);
    const CamFollowingValue place = cam.value({0, leading});
    EXPECT_NEAR(place.position.value, -0.5 * reference.position, 1e-13) << leading;
    EXPECT_NEAR(place.slope, -0.5 * reference.first_derivative / 2.0, 1e-14);
    EXPECT_NEAR(place.curvature, -0.5 * reference.second_derivative / 4.0, 1e-15);
    EXPECT_EQ(cam.ended(), CamEnd::none) << leading;
  }
}

TEST(CamFollowing, RunsTheOtherWayWithANegativeMasterScaling) {
  const CamFunction f = wave();
  CamFollowing cam = applied(f, {-1.0, 1.0, CamMode::cyclic});
  for (double leading = -1000.0; leading <= 1000.0; leading += 13.7) {
    double u = -leading - 360.0 * std::floor(-leading / 360.0);
    const CamFollowingValue place = cam.value({0, leading});
    EXPECT_NEAR(place.position.value, f.value(u).position, 1e-11) << leading;
    EXPECT_NEAR(place.slope, -f.value(u).first_derivative, 1e-12) << leading;
  }
}

// Leading value of the cam at (turn · 360 + value), reduced in exact integers to passes of scaling · 360;
// `value` is a multiple of 2^-40, the scaling one of 2^-60.
double exact_leading_value(std::int64_t turn, double value, double scaling) {
  __extension__ using Wide = __int128;
  const Wide pass = static_cast<Wide>(std::ldexp(scaling, 60)) * 360;
  Wide sum = 0;
  Wide power =
      (static_cast<Wide>(360) << 60) % pass;  // turn · power by doubling, which stays within 128 bits
  for (auto left = static_cast<std::uint64_t>(std::abs(turn)); left != 0; left >>= 1) {
    if ((left & 1u) != 0) sum = (sum + power) % pass;
    power = (power + power) % pass;
  }
  if (turn < 0 && sum != 0) sum = pass - sum;
  const Wide rest = (sum + static_cast<Wide>(std::ldexp(value, 40)) * (Wide{1} << 20)) % pass;
  return std::ldexp(static_cast<double>(rest), -60) / scaling;
}

TEST(CamFollowing, DoesNotDriftInAnyNumberOfTurns) {
  const CamFunction f = wave();
  const double scaling = 0.1;  // as a double a little more, so that ten passes are not quite a turn
  ASSERT_NE(two_product(scaling, 360.0).lo, 0.0);
  CamFollowing cam = applied(f, {scaling, 1.0, CamMode::cyclic}, kRing, kLine);
  std::mt19937_64 random(test::seed_of_test(1));
  std::uniform_real_distribution<double> place(0.0, 360.0);
  for (const std::int64_t turn : {std::int64_t{0}, std::int64_t{1}, std::int64_t{100'000},
                                  std::int64_t{-100'000}, std::int64_t{1} << 40, std::int64_t{100'001}}) {
    for (int i = 0; i < test::cases(200, 20'000); ++i) {
      const double value = std::ldexp(std::floor(std::ldexp(place(random), 40)), -40);
      const double reference = f.value(exact_leading_value(turn, value, scaling)).position;
      EXPECT_NEAR(cam.value({turn, value}).position.value, reference, 50.0 * 1e-12)
          << "turn " << turn << ", value " << value;
    }
  }
}

TEST(CamFollowing, RepeatsExactlyWhereAPassIsATurn) {
  const CamFunction f = wave();
  CamFollowing cam = applied(f, {1.0, 1.0, CamMode::cyclic}, kRing, kLine);
  for (double value = 0.0; value < 360.0; value += 11.7) {
    const double first = cam.value({0, value}).position.value;
    EXPECT_EQ(first, f.value(value).position);
    for (const std::int64_t turn :
         {std::int64_t{1}, std::int64_t{2}, std::int64_t{100'000}, std::int64_t{-7}, std::int64_t{1} << 50})
      EXPECT_EQ(cam.value({turn, value}).position.value, first) << turn;
  }
}

TEST(CamFollowing, AppendsPassesOnALineAndOnARing) {
  const CamFunction f = feed();
  CamFollowing line = applied(f, {1.0, 1.0, CamMode::appended}, kRing, kLine);
  const Modulo belt{true, 250.0, -50.0};
  CamFollowing ring = applied(f, {1.0, 1.0, CamMode::appended}, kRing, belt);
  for (const std::int64_t turn :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{3}, std::int64_t{1'000'000}}) {
    for (double value = 0.0; value < 360.0; value += 17.3) {
      const double reference = f.value(value).position + 40.0 * static_cast<double>(turn);
      EXPECT_NEAR(line.value({turn, value}).position.value, reference,
                  1e-13 * std::max(1.0, std::abs(reference)));
      const AxisPosition on_ring = ring.value({turn, value}).position;
      EXPECT_TRUE(belt.contains(on_ring.value));
      EXPECT_NEAR(on_ring.value + 250.0 * static_cast<double>(on_ring.turns), reference,
                  1e-13 * std::max(250.0, std::abs(reference)));
      // 25 passes are four rings: the error does not grow with the passes.
      const double first = ring.value({turn % 25, value}).position.value;
      EXPECT_EQ(on_ring.value, first);
    }
  }
}

TEST(CamFollowing, ACyclicCamWhoseEndsLieATurnApartGoesOnTurning) {
  const CamFunction f = curve({{0.0, 0.0}, {180.0, 100.0}, {360.0, 360.0}}, 1);
  EXPECT_TRUE(CamFollowing::closes(f, 1.0, kRing));
  EXPECT_TRUE(CamFollowing::closes(f, 2.0, kRing));
  EXPECT_FALSE(CamFollowing::closes(f, 0.5, kRing));
  EXPECT_FALSE(CamFollowing::closes(f, 1.0, kLine));
  CamFollowing cam = applied(f, {1.0, 1.0, CamMode::cyclic}, kRing, kRing);
  AxisPosition last = cam.value({0, 0.0}).position;
  for (int i = 1; i < 1000; ++i) {
    const AxisPosition now = cam.value(normalised({0, 7.5 * i}, kRing)).position;
    const double step = difference(now, last, kRing).rounded();
    EXPECT_GT(step, 0.0) << i;
    EXPECT_LT(step, 30.0) << i;
    last = now;
  }
  EXPECT_EQ(last.turns, 20);
}

TEST(CamFollowing, TellsWhenItReachesAnEnd) {
  const CamFunction f = wave();
  CamFollowing once = applied(f, {1.0, 1.0, CamMode::once});
  once.value({0, 359.0});
  EXPECT_EQ(once.ended(), CamEnd::none);
  EXPECT_EQ(once.end_before({0, 360.0}), CamEnd::at_end);
  EXPECT_EQ(once.value({0, 360.0}).position.value, f.end_following_value());
  EXPECT_EQ(once.ended(), CamEnd::at_end);
  once.clear_end();
  once.value({0, 12.0});
  EXPECT_EQ(once.ended(), CamEnd::none);
  EXPECT_EQ(once.end_before({0, -0.1}), CamEnd::at_start);
  once.value({0, 0.0});
  EXPECT_EQ(once.ended(), CamEnd::at_start);

  CamFollowing cyclic = applied(f, {1.0, 1.0, CamMode::cyclic});
  cyclic.value({0, 359.0});
  EXPECT_EQ(cyclic.ended(), CamEnd::none);
  cyclic.value({0, 361.0});
  EXPECT_EQ(cyclic.ended(), CamEnd::at_end);
  cyclic.clear_end();
  cyclic.value({0, 362.0});
  EXPECT_EQ(cyclic.ended(), CamEnd::none);
  cyclic.value({0, 358.0});
  EXPECT_EQ(cyclic.ended(), CamEnd::at_start);
}

TEST(CamFollowing, ACamThatStartsAtItsEndMayBeLeft) {
  const CamFunction f = wave();
  CamFollowing cam;
  cam.set(f, {1.0, 1.0, CamMode::once}, {0, 360.0}, {360.0, 0.0}, kLine, kLine);
  cam.value({0, 360.0});
  EXPECT_EQ(cam.ended(), CamEnd::none);
  cam.value({0, 350.0});
  EXPECT_EQ(cam.ended(), CamEnd::none);
}

TEST(CamFollowing, KnowsWhereAPassEnds) {
  const CamFunction f = feed();
  CamFollowing cam = applied(f, {0.1, 1.0, CamMode::appended}, kRing, kLine);
  cam.value({5, 100.0});
  const CamFollowing::LeadingPosition end = cam.end_place(CamEnd::at_end);
  const AxisPosition position = normalised(end.turns, end.value, kRing);
  const AxisPosition following = cam.end_position(CamEnd::at_end);
  EXPECT_NEAR(difference(position, {5, 100.0}, kRing).rounded(), 36.0 - std::fmod(1900.0, 36.0), 1e-9);
  EXPECT_NEAR(cam.value(position).position.value, following.value, 1e-9);
}

TEST(CamFollowing, SeesACornerFromTheSideWhereItGoes) {
  const CamFunction f = curve({{0.0, 0.0}, {100.0, 50.0}, {200.0, 0.0}}, 0, 0);
  const CamFollowing cam = applied(f, {1.0, 1.0, CamMode::cyclic});
  EXPECT_NEAR(cam.joined_at({0, 100.0}, 1).slope, -0.5, 1e-12);
  EXPECT_NEAR(cam.joined_at({0, 100.0}, -1).slope, 0.5, 1e-12);
  EXPECT_NEAR(cam.joined_at({0, 0.0}, -1).slope, -0.5, 1e-12);
  EXPECT_NEAR(cam.joined_at({0, 0.0}, 1).slope, 0.5, 1e-12);
  EXPECT_EQ(cam.joined_at({0, 100.0}, 1).position.value, 50.0);
}

TEST(CamFollowing, IsContinuousAcrossPassesWithRandomScaling) {
  const CamFunction f = feed();
  test::for_each_seed(20240611, test::cases(200, 20'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_real_distribution<double> scale(0.01, 3.0);
    CamUse use{scale(random), scale(random), CamMode::appended};
    if (one.seed % 3 == 0) use.master_scaling = -use.master_scaling;
    if (one.seed % 2 == 0) use.slave_scaling = -use.slave_scaling;
    CamFollowing cam = applied(f, use, kRing, kRing);
    AxisPosition leading{0, 0.0};
    const double step = (one.seed % 5 == 0 ? -1.0 : 1.0) * std::abs(use.master_scaling) * 0.7;
    AxisPosition last = cam.value(leading).position;
    const double steepest = 0.6 * std::abs(use.slave_scaling / use.master_scaling);
    for (int i = 0; i < 3000; ++i) {
      leading = advanced(leading, step, kRing);
      const AxisPosition now = cam.value(leading).position;
      ASSERT_LE(std::abs(difference(now, last, kRing).rounded()), steepest * std::abs(step)) << i;
      last = now;
    }
  });
}

}  // namespace
}  // namespace lockstep::cam_motion_test
