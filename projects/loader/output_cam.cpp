// Output cams and cam tracks: by whose position they switch which output, and where the times of its edges
// stand.
#include <unordered_map>

#include "projects/loader/loader.hpp"

namespace lockstep {
namespace {

double* read_time_tag(const JsonValue* json, const Loading& loading) {
  const auto name = read_string(json, loading.problems);
  if (!name) return nullptr;
  const auto found = loading.find(*json, *name);
  if (!found) return nullptr;
  if (found->tag == nullptr || found->signal.type != Type::LREAL) {
    loading.problems.report(*json, json->shown() + " is not allowed here; allowed: the name of an LREAL tag");
    return nullptr;
  }
  return static_cast<double*>(found->signal.address);
}

const JsonValue* member(const JsonValue* json, std::string_view name) {
  return json == nullptr || json->kind != JsonKind::object ? nullptr : json->find(name);
}

/// What both kinds have; `Cam` is one of them.
template <class Cam>
void load_switching(const JsonValue& json, Cam& cam, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kOutputCamObject, problems);
  const JsonValue* const config = fields["config"];
  const std::size_t before = problems.count();
  if (config != nullptr) load_configuration(*config, cam, loading);
  const bool sure = problems.count() == before;
  if (const JsonValue* const assigned = fields["assigned_to"])
    cam.assigned = static_cast<LeadingObject*>(loading.find_object(assigned, kLeading));
  const bool encoder = cam.assigned != nullptr && cam.assigned->kind == ObjectKind::TO_ExternalEncoder;
  if (const JsonValue* const type = member(member(config, "Parameter"), "PositionType");
      sure && encoder && type != nullptr && cam.data.Parameter.PositionType == 0)
    problems.report(*type, "an external encoder has no setpoint; allowed: 1 (actual position)");
  if (encoder) cam.data.Parameter.PositionType = 1;
  if (const JsonValue* const times = fields["switching_times"]) {
    const Fields of_times(*times, keys::kSwitchingTimes, problems);
    cam.switching_times.on = read_time_tag(of_times["on"], loading);
    cam.switching_times.off = read_time_tag(of_times["off"], loading);
  }
}

}  // namespace

void load_output_cam(const JsonValue& json, OutputCam& cam, const Loading& loading) {
  load_switching(json, cam, loading);
  const JsonValue* const type = member(member(json.find("config"), "Parameter"), "OutputCamType");
  if (type != nullptr && cam.data.Parameter.OutputCamType == 2)
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
