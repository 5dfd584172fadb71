// Cams: points and segments as the project gives them, and the curve through them.
#include <array>

#include "projects/loader.hpp"

namespace lockstep {
namespace {

constexpr double kLargest = 1.0e12;  // magnitude of everything in the data block

/// The members of a segment in the order of the keys.
constexpr std::array kSegmentMembers = {
    &TO_Cam_Struct_SegmentData::xmin,       &TO_Cam_Struct_SegmentData::xmax,
    &TO_Cam_Struct_SegmentData::a0,         &TO_Cam_Struct_SegmentData::a1,
    &TO_Cam_Struct_SegmentData::a2,         &TO_Cam_Struct_SegmentData::a3,
    &TO_Cam_Struct_SegmentData::a4,         &TO_Cam_Struct_SegmentData::a5,
    &TO_Cam_Struct_SegmentData::a6,         &TO_Cam_Struct_SegmentData::sineAmplitude,
    &TO_Cam_Struct_SegmentData::sinePeriod, &TO_Cam_Struct_SegmentData::sinePhase};
static_assert(kSegmentMembers.size() == std::size(keys::kSegment));

/// The elements of an array, or none of them if there are too many.
std::span<const JsonValue* const> read_elements(const JsonValue* json, std::size_t most,
                                                std::string_view what, Problems& problems) {
  if (read_array(json, problems) == nullptr) return {};
  if (json->elements.size() <= most) return json->elements;
  problems.report(*json, std::to_string(json->elements.size()) + " " + std::string(what) +
                             " are too many; allowed: up to " + std::to_string(most));
  return {};
}

void load_points(const JsonValue* json, Cam& cam, Problems& problems) {
  const auto points = read_elements(json, cam.point_count(), "points", problems);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const JsonValue& point = *points[i];
    if (point.kind != JsonKind::array || point.elements.size() != 2) {
      report_kind(point, "a pair of numbers [leading value, following value]", problems);
      continue;
    }
    const auto x = read_number(point.elements[0], -kLargest, kLargest, problems);
    const auto y = read_number(point.elements[1], -kLargest, kLargest, problems);
    if (x && y) cam.define_point(i, {*x, *y});
  }
}

void load_segment(const JsonValue& json, std::size_t index, Cam& cam, Problems& problems) {
  const Fields fields(json, keys::kSegment, problems);
  TO_Cam_Struct_SegmentData segment{};
  for (std::size_t i = 0; i < kSegmentMembers.size(); ++i)
    if (const auto value = read_number(fields[keys::kSegment[i].name], -kLargest, kLargest, problems))
      segment.*kSegmentMembers[i] = *value;
  if (fields["xmin"] != nullptr && fields["xmax"] != nullptr && !(segment.xmin < segment.xmax))
    problems.report(json, "xmin has to be less than xmax");
  cam.define_segment(index, segment);
}

void load_segments(const JsonValue* json, Cam& cam, Problems& problems) {
  const auto segments = read_elements(json, kCamSegments, "segments", problems);
  for (std::size_t i = 0; i < segments.size(); ++i) load_segment(*segments[i], i, cam, problems);
}

/// Why a definition in which every single value is right makes no curve.
std::string_view interpolation_problem(ErrorId error) {
  if (error == ErrorId::cam_elements_wrong)
    return "the points and segments make no curve; allowed: valid elements at two leading values at least, "
           "segments whose slopes at both ends agree where BoundaryConditions is 1, up to 1024 periods of "
           "sines, finite values everywhere";
  return error_text(error);
}

}  // namespace

/// A cam that the project defines is interpolated when the run begins. One without elements is left to the
/// programs.
void load_cam(const JsonValue& json, Cam& cam, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kCam, problems);
  const std::size_t before = problems.count();
  if (const JsonValue* const points = fields["points"]) load_points(points, cam, problems);
  if (const JsonValue* const segments = fields["segments"]) load_segments(segments, cam, problems);
  // A definition by curve elements with transitions has its place here.
  if (const JsonValue* const config = fields["config"]) load_configuration(*config, cam, loading);
  if (problems.count() != before || !cam.has_elements()) return;
  CamInterpolator interpolator(cam.point_count());
  if (const ErrorId error = cam.interpolate(interpolator); error != ErrorId::none)
    problems.report(json, std::string(interpolation_problem(error)));
}

}  // namespace lockstep
