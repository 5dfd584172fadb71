/// The definition of a cam: from JSON to points and segments, and back.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"
#include "tech_objects/cam_design/design.hpp"
#include "tech_objects/cam_design/design_check.hpp"

namespace lockstep {

/// A cam as a file or a project defines it, with what becomes of it.
struct CamDefinition {
  std::string name;
  std::string description;
  std::size_t capacity = kCamPoints;  ///< kCam10kPoints for a TO_Cam_10k
  bool designed = false;              ///< by elements; else points and segments are given as such
  CamDesign design;                   ///< with the interpolation in either case
  CamChecks checks;
  /// Points, segments and interpolation for the data block; a function if these make a curve.
  DesignedCam cam;
};

/// Whether points and segments given as such have to make a curve by themselves.
enum class CamWithoutCurve {
  refused,  ///< those of a file have to
  allowed   ///< the configuration, or the program, may add to them: their curve is not made here
};

/// Reads what defines a cam within an object: `elements`, with `optimization` for their transitions by a law,
/// or `points` and `segments` of the data block; other members are not looked at. Every problem is reported
/// where it stands, and without one `definition.cam` has points and segments for the data block.
/// @param definition with capacity and design.interpolation as they are known so far
void read_cam_members(const JsonValue& object, CamWithoutCurve without_curve, CamDefinition& definition,
                      Problems& problems);

/// The member of a point, a segment or an element of a cam that a finding means; the whole if it is no
/// member.
const JsonValue& cam_member(const JsonValue& element, std::string_view field);

/// Reads a cam file of format "lockstep_cam".
void read_cam_document(const JsonValue& root, CamDefinition& definition, Problems& problems);

/// The text of a cam file: reading it gives the same definition, to the last bit.
/// @param flat with the points and segments instead of the elements
std::string cam_document(const CamDefinition& definition, bool flat);

}  // namespace lockstep
