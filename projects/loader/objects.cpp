// Technology objects: axes with their drives and their leading values.
#include "projects/keys/objects.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "projects/loader/drive.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/looked_at_axis.hpp"
#include "projects/loader/read_keys.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep {
namespace {

/// Published types that are not there yet.
constexpr std::string_view kLaterTypes[] = {"TO_Kinematics"};

bool known(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr auto kTypeNames = [] {
  std::array<std::string_view, kObjectKinds.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kObjectKinds[i].name;
  return names;
}();

std::optional<ObjectKind> read_kind(const JsonValue* type, Problems& problems) {
  if (type != nullptr && type->kind == JsonKind::string && known(kLaterTypes, type->text)) {
    problems.report(*type, "technology objects of type " + type->shown() +
                               " are not yet supported; allowed: " + list_of(kTypeNames));
    return std::nullopt;
  }
  const auto word = read_word(type, kTypeNames, problems);
  if (!word) return std::nullopt;
  return kObjectKinds[*word].kind;
}

/// Of an object whose type is not known: what no type has.
void report_wrong_keys(const JsonValue& json, Problems& problems) {
  std::vector<Key> all;
  for (const KeyVariant& type : keys::kObjects)
    for (const Key& key : type.keys) {
      if (std::ranges::find(all, key.name, &Key::name) != all.end()) continue;
      all.push_back(key);
      all.back().required = key.kind == KeyKind::selector;
    }
  const Fields fields(json, all, problems);
}

void declare_object(const std::string& name, const JsonValue& json, const Loading& loading) {
  const bool named = loading.add_name(json, name, {});
  if (read_object(&json, loading.problems) == nullptr) return;
  const JsonValue* const type = json.find("type");
  const auto kind = read_kind(type, loading.problems);
  if (!kind) return report_wrong_keys(json, loading.problems);
  // The object is there even if its name is not free, so that its configuration is looked at.
  TechnologyObject& object = loading.add_object(*kind, name);
  if (named) loading.names().define(name, &object);
}

/// An encoder has no setpoint: it leads by its actual value.
std::optional<Coupling> read_coupling(const JsonValue* json, const LeadingObject* source,
                                      const Loading& loading) {
  Problems& problems = loading.problems;
  const bool encoder = source != nullptr && source->kind == ObjectKind::TO_ExternalEncoder;
  if (json == nullptr) return encoder ? Coupling::actual : Coupling::setpoint;
  const auto word = read_value(json, keys::kLeadingValue["coupling"], loading);
  if (!word) return std::nullopt;
  const auto coupling = static_cast<Coupling>(word->integer);
  if (encoder && coupling == Coupling::setpoint) {
    problems.report(*json, "an external encoder has no setpoint; allowed: 'actual', 'delayed'");
    return std::nullopt;
  }
  if (coupling == Coupling::delayed && source != nullptr && source->kind == ObjectKind::MCO_305) {
    problems.report(*json, "an MCO_305 provides no value behind a delay; allowed: 'setpoint', 'actual'");
    return std::nullopt;
  }
  if (coupling == Coupling::actual && source != nullptr && source->kind == ObjectKind::TO_LeadingAxisProxy) {
    problems.report(*json, "a leading axis proxy has no actual value; allowed: 'setpoint', 'delayed'");
    return std::nullopt;
  }
  return coupling;
}

void load_leading_value(const JsonValue& json, Axis& axis, const Loading& loading) {
  const Fields fields(json, keys::kLeadingValue, loading.problems);
  const JsonValue* const to = fields["to"];
  auto* const source = static_cast<LeadingObject*>(loading.find_object(to, kLeading));
  const auto coupling = read_coupling(fields["coupling"], source, loading);
  if (source == nullptr || !coupling) return;
  if (source->kind == ObjectKind::MCO_305) static_cast<Mco305*>(source)->leads = true;
  if (source->number == axis.number) return loading.problems.report(*to, "an axis cannot follow itself");
  const auto same = [&](const LeadingValue& other) { return other.source == source; };
  if (std::any_of(axis.leading_values.begin(), axis.leading_values.end(), same))
    return loading.problems.report(*to, to->shown() + " is a leading value of '" + axis.name + "' already");
  axis.leading_values.push_back({source, *coupling});
}

void load_leading_values(const JsonValue& json, Axis& axis, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  for (const JsonValue* const leading_value : json.elements)
    load_leading_value(*leading_value, axis, loading);
}

void load_position_limits(const JsonValue& config, const Axis& axis, const Loading& loading) {
  const TO_Struct_PositionLimitsSW& limits = axis.data.PositionLimits_SW;
  const JsonValue* const json = config.find("PositionLimits_SW");
  if (json != nullptr && limits.MinPosition >= limits.MaxPosition)
    loading.problems.report(*json, "MinPosition has to be less than MaxPosition");
}

void load_axis(const JsonValue& json, Axis& axis, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kObjects, variant_of(axis), problems);
  const std::size_t before = problems.count();
  if (const JsonValue* const config = fields["config"]) {
    load_configuration(*config, axis, loading);
    load_position_limits(*config, axis, loading);
    check_delay(*config, axis.data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime, loading);
  }
  const bool sure = problems.count() == before;
  const JsonValue* const drive = fields["drive"];
  if (drive != nullptr) load_drive(*drive, axis, loading);
  if (sure && drive != nullptr && axis.is_virtual())
    problems.report(*drive, "a virtual axis (VirtualAxis.Mode 1) has no drive; allowed is one of the two");
  if (sure && drive == nullptr && !axis.is_virtual())
    problems.report(
        json,
        "the axis is neither virtual nor has it a drive; allowed: \"config\": { \"VirtualAxis\": { "
        "\"Mode\": 1 } }, or \"drive\": { \"model\": \"simulated\" }");
  const JsonValue* const values = fields["leading_values"];
  if (values != nullptr && axis.kind == ObjectKind::TO_SynchronousAxis)
    load_leading_values(*values, axis, loading);
}

void load_proxy(const JsonValue& json, LeadingAxisProxy& proxy, const Loading& loading) {
  const Fields fields(json, keys::kObjects, variant_of(proxy), loading.problems);
  if (const JsonValue* const config = fields["config"]) load_configuration(*config, proxy, loading);
  if (const JsonValue* const telegrams = fields["telegrams"])
    read_struct(*telegrams, keys::kTelegramCounts, proxy.count_tags, loading);
}

/// One axis after the other is loaded whole, and what is asked for later stays.
void look_at_axis(const JsonValue& json, LookedAtAxis& looked_at, const Loading& loading) {
  const auto axis = std::make_unique<Axis>(looked_at.kind, looked_at.name, looked_at.number);
  load_axis(json, *axis, loading);
  looked_at.take(*axis);
}

void load_object(const JsonValue& json, TechnologyObject& object, const Loading& loading) {
  switch (object.kind) {
    case ObjectKind::TO_SpeedAxis:
    case ObjectKind::TO_PositioningAxis:
    case ObjectKind::TO_SynchronousAxis:
      if (loading.use == LoadedFor::looking)
        return look_at_axis(json, static_cast<LookedAtAxis&>(object), loading);
      return load_axis(json, static_cast<Axis&>(object), loading);
    case ObjectKind::TO_ExternalEncoder:
      return load_encoder(json, static_cast<ExternalEncoder&>(object), loading);
    case ObjectKind::TO_LeadingAxisProxy:
      return load_proxy(json, static_cast<LeadingAxisProxy&>(object), loading);
    case ObjectKind::TO_MeasuringInput:
      return load_measuring_input(json, static_cast<MeasuringInput&>(object), loading);
    case ObjectKind::TO_OutputCam:
      return load_output_cam(json, static_cast<OutputCam&>(object), loading);
    case ObjectKind::TO_CamTrack:
      return load_cam_track(json, static_cast<CamTrack&>(object), loading);
    case ObjectKind::TO_Cam:
    case ObjectKind::TO_Cam_10k:
      return load_cam(json, static_cast<Cam&>(object), loading);
    case ObjectKind::MCO_305:
      return load_mco305(json, static_cast<Mco305&>(object), loading);
  }
}

}  // namespace

void declare_objects(const JsonValue& objects, const Loading& loading) {
  if (read_object(&objects, loading.problems) == nullptr) return;
  for (const auto& [name, json] : objects.members) declare_object(name, *json, loading);
}

void load_objects(const JsonValue& objects, const Loading& loading) {
  auto object = loading.controller().objects.begin();
  const auto end = loading.controller().objects.end();
  for (const auto& [name, json] : objects.members) {
    if (object == end) return;
    if ((*object)->name != name) continue;  // could not be declared
    load_object(*json, **object, loading);
    ++object;
  }
  check_outputs(objects, loading);
}

}  // namespace lockstep
