// Cams for tests: built from lists of points and segments, and the reference cams.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tech_objects/cam_object/interpolation.hpp"

namespace lockstep::test {

/// A cam block, its interpolator and its function.
template <std::size_t points>
struct BasicCam {
  std::unique_ptr<CamData<points>> data = std::make_unique<CamData<points>>();
  CamInterpolator interpolator{points};
  CamFunction f{points};
  std::size_t point_count = 0;
  std::size_t segment_count = 0;

  BasicCam& mode(DINT interpolation_mode, DINT boundary_conditions = 0) {
    data->InterpolationSettings = {interpolation_mode, boundary_conditions};
    return *this;
  }
  BasicCam& point(double x, double y) {
    data->Point[point_count] = {x, y};
    data->ValidPoint[point_count++] = true;
    return *this;
  }
  BasicCam& segment(const TO_Cam_Struct_SegmentData& segment) {
    data->Segment[segment_count] = segment;
    data->ValidSegment[segment_count++] = true;
    return *this;
  }
  /// The line through (from, y) with a slope.
  BasicCam& line(double from, double to, double y, double slope) {
    TO_Cam_Struct_SegmentData s;
    s.xmin = from;
    s.xmax = to;
    s.a0 = y - slope * from;
    s.a1 = slope;
    return segment(s);
  }
  ErrorId interpolate() { return interpolator.interpolate(elements_of(*data), f); }
};

using Cam = BasicCam<kCamPoints>;
using Cam10k = BasicCam<kCam10kPoints>;

inline nlohmann::json reference_cams(const std::string& file) {
  std::ifstream stream(std::string(LOCKSTEP_TEST_DATA) + "/" + file);
  return nlohmann::json::parse(stream).at("cams");
}

}  // namespace lockstep::test
