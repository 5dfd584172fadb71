#include "projects/cam_files/facts.hpp"

#include <cmath>
#include <cstddef>

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kQuantities[] = {"following value", "velocity", "acceleration", "jerk"};

struct Figure {
  const char* name;
  double MotionPeaks::*member;
};
constexpr Figure kFigures[] = {{"Cv", &MotionPeaks::velocity},
                               {"Ca", &MotionPeaks::acceleration},
                               {"Ca*", &MotionPeaks::deceleration},
                               {"Cj", &MotionPeaks::jerk},
                               {"Cmdyn", &MotionPeaks::torque}};

/// JSON has neither infinity nor NaN.
Json json_of(double value) {
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return std::isnan(value) ? Json(nullptr) : Json(value);
}

Json json_of(const MotionPeaks& peaks) {
  Json json = Json::object();
  for (const Figure& figure : kFigures) json[figure.name] = json_of(peaks.*figure.member);
  return json;
}

Json json_of(const CamDefinition& definition, const CamStretch& stretch) {
  Json json = {{"element", stretch.element},
               {"transition", stretch.transition},
               {"kind", stretch_name(definition, stretch)},
               {"from", stretch.from},
               {"to", stretch.to},
               {"points", stretch.points},
               {"segments", stretch.segments}};
  if (stretch.curve) json["deviation"] = json_of(stretch.deviation);
  if (!stretch.law) return json;
  json["law"] = motion_law_name(stretch.kind);
  json["task"] = std::string{task_letter(stretch.start_task), '-', task_letter(stretch.end_task)};
  json["normalised"] = {{"law", json_of(stretch.law->normalised_peaks())},
                        {"cam", json_of(mapped_peaks(*definition.cam.function, stretch))}};
  json["absolute"] = {{"law", json_of(stretch.law->peaks())}};
  return json;
}

}  // namespace

std::string stretch_name(const CamDefinition& definition, const CamStretch& stretch) {
  if (!stretch.transition)
    return std::string(cam_shape_name(definition.design.elements[stretch.element].shape));
  return std::string(motion_law_name(stretch.kind)) + " " + task_letter(stretch.start_task) + "-" +
         task_letter(stretch.end_task);
}

nlohmann::ordered_json cam_facts(const CamDefinition& definition) {
  const CamFunction& cam = *definition.cam.function;
  const CamExtremes all = extremes_of(cam, cam.start_leading_value(), cam.end_leading_value());
  Json extremes = Json::object();
  for (int order = 0; order < 4; ++order)
    extremes[kQuantities[order]] = {json_of(all.lowest[order]), json_of(all.highest[order])};
  Json joints = Json::array();
  for (const CamJoint& joint : joints_of(cam, true))
    joints.push_back({{"x", joint.x},
                      {"steps", kQuantities[static_cast<int>(joint.keeps)]},
                      {"left", json_of(joint.left)},
                      {"right", json_of(joint.right)},
                      {"wrap", joint.wrap}});
  Json stretches = Json::array();
  for (const CamStretch& stretch : definition.cam.stretches)
    stretches.push_back(json_of(definition, stretch));
  return {{"name", definition.name},
          {"start", cam.start_leading_value()},
          {"end", cam.end_leading_value()},
          {"points", definition.cam.points.size()},
          {"segments", definition.cam.segments.size()},
          {"extremes", extremes},
          {"joints", joints},
          {"elements", stretches}};
}

}  // namespace lockstep
