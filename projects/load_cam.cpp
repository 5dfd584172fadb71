// Cams: points and segments, curve elements or a file, as the project gives them, and the curve through them.
#include "projects/cam_definition.hpp"
#include "projects/loader.hpp"

namespace lockstep {
namespace {

/// Why a definition in which every single value is right makes no curve.
std::string_view interpolation_problem(ErrorId error) {
  if (error == ErrorId::cam_elements_wrong)
    return "the points and segments make no curve; allowed: valid elements at two leading values at least, "
           "segments whose slopes at both ends agree where BoundaryConditions is 1, up to 1024 periods of "
           "sines, finite values everywhere";
  return error_text(error);
}

void define(Cam& cam, const DesignedCam& designed) {
  for (std::size_t i = 0; i < designed.points.size(); ++i) cam.define_point(i, designed.points[i]);
  for (std::size_t i = 0; i < designed.segments.size(); ++i) cam.define_segment(i, designed.segments[i]);
  cam.set_interpolation(designed.interpolation);
}

}  // namespace

/// A cam that the project defines is interpolated when the run begins. One without elements is left to the
/// programs.
void load_cam(const JsonValue& json, Cam& cam, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kCam, problems);
  const std::size_t before = problems.count();
  if (const JsonValue* const config = fields["config"]) load_configuration(*config, cam, loading);
  CamDefinition definition;
  definition.capacity = cam.point_count();
  definition.design.interpolation = cam.interpolation();
  read_cam_definition(json, loading.folder, CamWithoutCurve::allowed, definition, problems);
  if (problems.count() != before) return;
  define(cam, definition.cam);
  if (!cam.has_elements()) return;
  CamInterpolator interpolator(cam.point_count());
  if (const ErrorId error = cam.interpolate(interpolator); error != ErrorId::none)
    problems.report(json, std::string(interpolation_problem(error)));
}

}  // namespace lockstep
