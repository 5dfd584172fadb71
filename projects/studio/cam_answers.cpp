#include "projects/studio/cam_answers.hpp"

#include <cstddef>

#include "projects/cam_files/facts.hpp"
#include "projects/cam_files/table.hpp"
#include "projects/json/document.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/project_answers.hpp"

namespace lockstep::studio_api {
namespace {

constexpr std::int64_t kMaximumSamples = 10'000;

Json curves_of(const CamFunction& cam, std::size_t count) {
  Json x = Json::array();
  Json curves[4] = {Json::array(), Json::array(), Json::array(), Json::array()};
  for (const CamSample& sample : sampled(cam, cam.start_leading_value(), cam.end_leading_value(), count)) {
    x.push_back(number_json(sample.x));
    const double values[] = {sample.value.position, sample.value.first, sample.value.second,
                             sample.value.third};
    for (std::size_t order = 0; order < 4; ++order) curves[order].push_back(number_json(values[order]));
  }
  return {{"x", x},
          {"following value", curves[0]},
          {"velocity", curves[1]},
          {"acceleration", curves[2]},
          {"jerk", curves[3]}};
}

}  // namespace

StudioAnswer cam_answer(const StudioRequest& request, const LoadedCam& loaded) {
  const std::int64_t count = whole_number(request, "curves", 0);
  if (count != 0 && (count < 2 || count > kMaximumSamples))
    throw BadRequest(422, "out_of_range", "curves: " + std::to_string(count) + "; allowed: 2 to 10000");
  Json json = Json::object();
  const bool has_curve = loaded.definition && loaded.definition->cam.function;
  if (has_curve) {
    json = cam_facts(*loaded.definition);
    json["description"] = loaded.definition->description;
    if (count != 0)
      json["curves"] = curves_of(*loaded.definition->cam.function, static_cast<std::size_t>(count));
  }
  json["problems"] = problems_json(loaded.problems);
  json["warnings"] = problems_json(loaded.warnings);
  return answer_of(json);
}

StudioAnswer design_answer(const StudioRequest& request) {
  const JsonDocument document(request.body);
  Wrong wrong{422};
  for (const Problem& problem : document.problems()) {
    Json more = {{"pointer", problem.place}};
    if (problem.line != 0) more["line"] = problem.line;
    wrong.add("bad_request", problem.text, more);
  }
  if (!wrong.errors.empty()) return answer_of(wrong);
  // A project names files of this machine, which whoever asks may not read by it.
  const JsonValue& root = document.root();
  if (root.find("lockstep_cam") == nullptr || root.find("lockstep") != nullptr)
    throw BadRequest(422, "bad_request", "the body has to be a cam file, which begins with \"lockstep_cam\"");
  return cam_answer(request, load_cam(request.body, "", "", kCam10kPoints));
}

}  // namespace lockstep::studio_api
