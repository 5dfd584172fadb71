// Cams: points and segments, curve elements or a file, as the project gives them, and the curve through them.
#include <algorithm>

#include "projects/cam_files/file.hpp"
#include "projects/keys/objects.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/cam_design/findings.hpp"

namespace lockstep {
namespace {

void define(Cam& cam, const DesignedCam& designed) {
  for (std::size_t i = 0; i < designed.points.size(); ++i) cam.define_point(i, designed.points[i]);
  for (std::size_t i = 0; i < designed.segments.size(); ++i) cam.define_segment(i, designed.segments[i]);
  cam.set_interpolation(designed.interpolation);
}

/// Where the element stands that a finding is about: in its list, else in the configuration, else in what
/// gives all elements.
const JsonValue& place_of(const CamFinding& finding, const JsonValue& cam) {
  if (finding.element == CamFinding::kWhole) return cam;
  const JsonValue* const list = cam.find(finding.transition ? "segments" : "points");
  if (list != nullptr && finding.element < list->elements.size())
    return cam_member(*list->elements[finding.element], finding.field);
  const JsonValue* const config = cam.find("config");
  const std::string key =
      (finding.transition ? "Segment[" : "Point[") + std::to_string(finding.element + 1) + "]";
  if (config != nullptr && config->find(key) != nullptr) return cam_member(*config->find(key), finding.field);
  for (const char* whole : {"elements", "file"})
    if (const JsonValue* const value = cam.find(whole)) return *value;
  return cam;
}

}  // namespace

/// A cam that the project defines is interpolated when the run begins. One without elements is left to the
/// programs.
void load_cam(const JsonValue& json, Cam& cam, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kObjects, variant_of(cam), problems);
  const std::size_t before = problems.count();
  if (const JsonValue* const config = fields["config"]) load_configuration(*config, cam, loading);
  CamDefinition definition;
  definition.capacity = cam.point_count();
  definition.design.interpolation = cam.interpolation();
  const JsonValue* const file = fields["file"];
  // Relative to the file that names it, which may be an included one.
  const std::string folder =
      file != nullptr && file->source() != nullptr ? file->source()->folder() : loading.folder;
  read_cam_definition(json, folder, loading.folder, CamWithoutCurve::allowed, definition, problems);
  if (problems.count() != before) return;
  define(cam, definition.cam);
  const CamElements elements = cam.elements();
  const auto valid =
      std::ranges::count(elements.ValidPoint, true) + std::ranges::count(elements.ValidSegment, true);
  if (valid == 0) return;
  CamInterpolator interpolator(cam.point_count());
  cam.interpolate(interpolator);
  const std::size_t given = definition.cam.points.size() + definition.cam.segments.size();
  if (definition.cam.function && static_cast<std::size_t>(valid) == given) return;  // told where they stand
  const CamFindings findings = findings_of(elements, interpolator, cam.function());
  for (const CamFinding& problem : findings.problems) problems.report(place_of(problem, json), problem.text);
  for (const CamFinding& warning : findings.warnings) problems.warn(place_of(warning, json), warning.text);
}

}  // namespace lockstep
