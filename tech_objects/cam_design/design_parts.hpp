/// What a cam design is made of inside: elements and transitions one by one.
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/cam_design/designed_cam.hpp"

namespace lockstep {

/// A number for a message, in as few digits as tell it from its neighbours.
std::string number_text(double value);

/// Takes findings about one element or transition after the other.
class CamReport {
 public:
  explicit CamReport(DesignedCam& cam) : cam_(cam) {}

  void look_at(std::size_t element, bool transition) noexcept {
    element_ = element;
    transition_ = transition;
  }
  void problem(std::string_view field, std::string text) {
    cam_.problems.push_back({element_, transition_, field, std::move(text)});
  }
  void warning(std::string_view field, std::string text) {
    cam_.warnings.push_back({element_, transition_, field, std::move(text)});
  }
  std::size_t problems() const noexcept { return cam_.problems.size(); }

  /// A number of the data block: finite, -1.0E12 … 1.0E12.
  bool in_range(std::string_view field, std::optional<double> value);
  bool ascending(double start, double end);
  bool count(std::string_view field, std::size_t value, std::size_t maximum);

 private:
  DesignedCam& cam_;
  std::size_t element_ = CamFinding::kWhole;
  bool transition_ = false;
};

/// An element by itself.
struct BuiltElement {
  MotionBoundary at_start, at_end;  ///< all derivatives given
  double stroke = 0.0;              ///< maximum less minimum following value
  std::function<MotionValue(double)> curve;
  std::vector<TO_Cam_Struct_PointData> points;
  std::vector<TO_Cam_Struct_SegmentData> segments;
};

/// Makes an element. FALSE, and a problem in the report, if it is wrong.
bool build_element(const CamShape& shape, CamReport& report, BuiltElement& built);

/// Makes a transition by a law between two elements. FALSE, and a problem, if there is none.
bool build_transition(const CamTransition& transition, const CamDesign& design, const BuiltElement& left,
                      const BuiltElement& right, CamReport& report, CamStretch& stretch, BuiltElement& built);

/// Interpolates points and segments, all of which are valid.
/// @param findings gets what is to be told of them; nullptr: nobody asks
ErrorId interpolate_all(std::span<const TO_Cam_Struct_PointData> points,
                        std::span<const TO_Cam_Struct_SegmentData> segments,
                        const TO_Cam_Struct_InterpolationSettings& settings, CamFunction& function,
                        CamFindings* findings = nullptr);

}  // namespace lockstep
