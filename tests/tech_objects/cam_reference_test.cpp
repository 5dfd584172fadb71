// Cams of points against the values of an independent library.
#include <algorithm>
#include <cmath>

#include "tests/tech_objects/cam_cases.hpp"

namespace lockstep::cam_reference_test {
namespace {

/// Compares every sample to a part of the range that position and derivatives span over the cam.
void compare_with_reference(const std::string& file, DINT mode, double part) {
  const auto cams = test::reference_cams(file);
  ASSERT_FALSE(cams.empty());
  double worst[3] = {};
  for (const auto& reference : cams) {
    SCOPED_TRACE(reference.at("name").get<std::string>());
    test::Cam cam;
    cam.mode(mode, reference.at("boundary") == "none" ? 0 : 1);
    for (const auto& point : reference.at("points")) cam.point(point[0], point[1]);
    ASSERT_EQ(cam.interpolate(), ErrorId::none);
    double range[3] = {cam.f.highest_following_value() - cam.f.lowest_following_value(), 0.0, 0.0};
    for (const auto& sample : reference.at("samples"))
      for (int k = 1; k < 3; ++k) range[k] = std::max(range[k], std::abs(sample[k + 1].get<double>()));
    for (const auto& sample : reference.at("samples")) {
      const CamValue value = cam.f.value(sample[0]);
      const double found[3] = {value.position, value.first_derivative, value.second_derivative};
      for (int k = 0; k < 3; ++k) {
        const double deviation =
            std::abs(found[k] - sample[k + 1].get<double>()) / std::max(range[k], 1.0e-12);
        EXPECT_LE(deviation, part) << "order " << k << " at " << sample[0];
        worst[k] = std::max(worst[k], deviation);
      }
    }
  }
  testing::Test::RecordProperty("worst_position", std::to_string(worst[0] * 1.0e12) + "e-12");
  testing::Test::RecordProperty("worst_first", std::to_string(worst[1] * 1.0e12) + "e-12");
  testing::Test::RecordProperty("worst_second", std::to_string(worst[2] * 1.0e12) + "e-12");
}

TEST(CamReference, CubicSplinesAgreeWithAnIndependentLibraryToOneBillionthOfTheRange) {
  compare_with_reference("cam_cubic_splines.json", 1, 1.0e-9);
}

TEST(CamReference, BezierSplinesAgreeWithAnIndependentLibraryToOneBillionthOfTheRange) {
  compare_with_reference("cam_bezier_splines.json", 2, 1.0e-9);
}

TEST(CamReference, DerivativesAreThoseOfTheValues) {
  for (const DINT mode : {1, 2})
    for (const auto& reference :
         test::reference_cams(mode == 1 ? "cam_cubic_splines.json" : "cam_bezier_splines.json")) {
      SCOPED_TRACE(reference.at("name").get<std::string>());
      if (reference.at("points").size() > 100) continue;  // points too near to each other for differences
      test::Cam cam;
      cam.mode(mode, reference.at("boundary") == "none" ? 0 : 1);
      for (const auto& point : reference.at("points")) cam.point(point[0], point[1]);
      ASSERT_EQ(cam.interpolate(), ErrorId::none);
      const double h = 1.0e-6 * (cam.f.end_leading_value() - cam.f.start_leading_value());
      double slope_range = 0.0;
      double curvature_range = 0.0;
      for (const auto& sample : reference.at("samples")) {
        slope_range = std::max(slope_range, std::abs(sample[2].get<double>()));
        curvature_range = std::max(curvature_range, std::abs(sample[3].get<double>()));
      }
      for (const auto& sample : reference.at("samples")) {
        const double x = sample[0];
        if (x - h < cam.f.start_leading_value() || x + h > cam.f.end_leading_value()) continue;
        const CamValue value = cam.f.value(x);
        const CamValue before = cam.f.value(x - h);
        const CamValue after = cam.f.value(x + h);
        EXPECT_NEAR((after.position - before.position) / (2.0 * h), value.first_derivative,
                    1.0e-4 * slope_range + 1.0e-9);
        EXPECT_NEAR((after.first_derivative - before.first_derivative) / (2.0 * h), value.second_derivative,
                    1.0e-3 * curvature_range + 1.0e-9);
      }
    }
}

}  // namespace
}  // namespace lockstep::cam_reference_test
