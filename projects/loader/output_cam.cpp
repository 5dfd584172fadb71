// Output cams and cam tracks: by whose position they switch which output, and where the times of its edges
// stand.
#include <unordered_map>

#include "projects/keys/objects.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

const JsonValue* member(const JsonValue* json, std::string_view name) {
  return json == nullptr || json->kind != JsonKind::object ? nullptr : json->find(name);
}

/// What both kinds have; `Cam` is one of them.
template <class Cam>
void load_switching(const JsonValue& json, Cam& cam, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kObjects, variant_of(cam), problems);
  const JsonValue* const config = fields["config"];
  const std::size_t before = problems.count();
  if (config != nullptr) load_configuration(*config, cam, loading);
  const bool sure = problems.count() == before;
  if (const auto assigned = read_value(fields, keys::kAssignedTo, loading))
    key_detail::assign(cam.assigned, *assigned);
  const bool encoder = cam.assigned != nullptr && cam.assigned->kind == ObjectKind::TO_ExternalEncoder;
  if (const JsonValue* const type = member(member(config, "Parameter"), "PositionType");
      sure && encoder && type != nullptr && cam.data.Parameter.PositionType == PositionType::setpoint)
    problems.report(*type, "an external encoder has no setpoint; allowed: 1 (actual position)");
  if (encoder) cam.data.Parameter.PositionType = PositionType::actual_position;
  if (const JsonValue* const times = fields["switching_times"])
    read_struct(*times, keys::kSwitchingTimes, cam.switching_times, loading);
}

}  // namespace

void load_output_cam(const JsonValue& json, OutputCam& cam, const Loading& loading) {
  load_switching(json, cam, loading);
  const JsonValue* const type = member(member(json.find("config"), "Parameter"), "OutputCamType");
  if (type != nullptr && cam.data.Parameter.OutputCamType == OutputCamType::switching)
    loading.problems.report(*type,
                            "a switching cam is not supported; allowed: 0 (distance cam), 1 (time cam)");
}

void load_cam_track(const JsonValue& json, CamTrack& track, const Loading& loading) {
  load_switching(json, track, loading);
}

void check_outputs(const JsonValue& objects, const Loading& loading) {
  std::unordered_map<const BOOL*, const OutputCam*> first;  // that switches an output
  for (const auto& object : loading.controller().objects) {
    if (object->kind != ObjectKind::TO_OutputCam) continue;
    const auto* const cam = static_cast<const OutputCam*>(object.get());
    const auto& mine = cam->data.Interface;
    if (mine.Address == nullptr) continue;
    const auto [entry, alone] = first.emplace(mine.Address, cam);
    const OutputCam* const other = entry->second;
    if (alone || mine.LogicOperation == other->data.Interface.LogicOperation) continue;
    const JsonValue* const interface = member(member(objects.find(cam->name), "config"), "Interface");
    if (interface != nullptr)
      loading.problems.report(*interface, "'" + cam->name + "' and '" + other->name +
                                              "' switch one output; allowed is one LogicOperation for it");
  }
}

}  // namespace lockstep
