/// Figures of a finished cam and checks of it: ranges, limits, joints.
/// @source S7-1500T synchronous operation V7, 8.1.2.3, 8.1.2.4, 8.3.1
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tech_objects/cam_design/designed_cam.hpp"

namespace lockstep {

/// Minimum and maximum of following value and derivatives over a stretch of a cam.
struct CamExtremes {
  double lowest[4] = {};  ///< position, velocity, acceleration, jerk
  double highest[4] = {};
  double torque = 0.0;  ///< maximum |velocity · acceleration|

  double peak(int order) const noexcept;  ///< maximum magnitude
};

/// Extremes of the interpolated cam from one leading value to another, both within its range.
CamExtremes extremes_of(const CamFunction& cam, double from, double to);
/// Extremes of a curve before its mapping.
CamExtremes extremes_of(const std::function<MotionValue(double)>& curve, double from, double to);

/// The normalised figures of a transition: Cv, Ca, Ca*, Cj, Cmdyn, in the direction of its stroke; not
/// numbers without a stroke. Cj is infinite where the acceleration steps in the cam, at its ends too.
MotionPeaks mapped_peaks(const CamFunction& cam, const CamStretch& stretch);

/// A leading value at which the cam steps in its value or a derivative.
struct CamJoint {
  double x = 0.0;
  Continuity keeps = Continuity::not_applicable;  ///< highest that does not step; not_applicable: none
  double left = 0.0, right = 0.0;                 ///< the first that steps, before and behind
  bool wrap = false;                              ///< from the end to the start
};

/// The joints at which something up to the jerk steps, beyond rounding, ascending. A step of one derivative
/// hides those of higher ones.
/// @param cyclic with the wrap from the end to the start, where the following value may step by the stroke
/// @param closed with that wrap, where it may not
std::vector<CamJoint> joints_of(const CamFunction& cam, bool cyclic, bool closed = false);

/// "at leading value 30 the following value steps from 10 to 50".
std::string step_text(const CamJoint& joint);

/// What is to be checked; what is not given is not.
struct CamChecks {
  std::optional<std::array<double, 2>> leading_range, following_range;
  std::optional<double> leading_velocity;                          ///< [leading u/s], for the limits
  std::optional<double> max_velocity, max_acceleration, max_jerk;  ///< of the following axis
  bool suitability = false;  ///< transitions by a law meet velocity and acceleration beside them
  std::optional<Continuity> continuity;
  bool cyclic = false;  ///< the joint from the end to the start counts too
  bool closed = false;  ///< and the cam has to end with the following value with which it begins
};

/// What the checks find. Needs a cam with a function.
std::vector<CamFinding> check_cam(const CamDesign* design, const DesignedCam& cam, const CamChecks& checks);

}  // namespace lockstep
