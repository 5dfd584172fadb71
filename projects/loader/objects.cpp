// Technology objects: axes with their drives and their leading values.
#include <algorithm>
#include <limits>

#include "projects/loader/drive.hpp"
#include "projects/loader/loader.hpp"
#include "tech_objects/drive/drive_models.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kLongestLag = 10'000'000'000;  // of a drive [ns]
constexpr std::int64_t kMostDeadCycles = 254;         // of MC_Servo, as dead time of a drive
constexpr double kSecond = 1e9;                       // [ns]

/// Published types that are not there yet.
constexpr std::string_view kLaterTypes[] = {"TO_Kinematics", "TO_LeadingAxisProxy"};

bool known(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::optional<ObjectKind> read_kind(const JsonValue* type, Problems& problems) {
  if (type != nullptr && type->kind == JsonKind::string && known(kLaterTypes, type->text)) {
    problems.report(*type, "technology objects of type " + type->shown() +
                               " are not yet supported; allowed: " + list_of(words::kObjectTypes));
    return std::nullopt;
  }
  const auto word = read_word(type, words::kObjectTypes, problems);
  if (!word) return std::nullopt;
  return kObjectKinds[*word].kind;
}

void declare_object(const std::string& name, const JsonValue& json, const Loading& loading) {
  const bool named = loading.add_name(json, name, {});
  if (read_object(&json, loading.problems) == nullptr) return;
  const JsonValue* const type = json.find("type");
  const auto kind = read_kind(type, loading.problems);
  if (!kind) {
    const Fields fields(json, keys::kObject,
                        loading.problems);  // reports wrong keys; the rest has no meaning
    return;
  }
  // The object is there even if its name is not free, so that its configuration is looked at.
  TechnologyObject& object = loading.controller().add_object(*kind, name);
  if (named) loading.names().define(name, &object);
}

void load_drive(const JsonValue& json, Axis& axis, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kDrive, problems);
  if (const auto model = read_word(fields["model"], kDriveModelNames, problems))
    axis.drive_model = &kDriveModels[*model];
  DriveSettings& drive = axis.drive_settings;
  if (const auto time = read_duration(fields["time_constant"], 0, kLongestLag, problems))
    drive.time_constant = static_cast<double>(*time) / kSecond;
  const std::int64_t longest_dead_time = kMostDeadCycles * loading.controller().clock.servo_cycle;
  if (const auto time = read_duration(fields["dead_time"], 0, longest_dead_time, problems))
    drive.dead_time = static_cast<double>(*time) / kSecond;
  constexpr double kCoarsest = 1e12;
  if (const auto resolution = read_number(fields["encoder_resolution"], 0.0, kCoarsest, problems))
    drive.resolution = *resolution;
  if (const auto inverted = read_bool(fields["inverted"], problems)) drive.inverted = *inverted;
  constexpr double kHardest = 1e12;  // [u/s²]
  if (const auto stop = read_number(fields["quick_stop_deceleration"], 0.0, kHardest, problems))
    drive.quick_stop = *stop;
  if (const JsonValue* const plant = fields["plant"]) load_plant(*plant, drive, loading);
  if (const JsonValue* const faults = fields["faults"]) load_faults(*faults, drive.faults, loading);
  load_signals(fields, drive.signals, loading);
  constexpr std::int64_t kShortestCycle = 10'000, kLongestCycle = 1'000'000'000;  // [ns]
  if (const auto cycle = read_duration(fields["position_cycle"], kShortestCycle, kLongestCycle, problems))
    drive.position_cycle = static_cast<double>(*cycle) / kSecond;
  if (const JsonValue* const sensors = fields["sensors"]) load_sensors(*sensors, axis, loading);
  check_operative_sensor(json, axis, loading);
}

/// An encoder has no setpoint: it leads by its actual value.
std::optional<Coupling> read_coupling(const JsonValue* json, const LeadingObject* source,
                                      Problems& problems) {
  const bool encoder = source != nullptr && source->kind == ObjectKind::TO_ExternalEncoder;
  if (json == nullptr) return encoder ? Coupling::actual : Coupling::setpoint;
  if (json->kind == JsonKind::string && json->text == "delayed") {
    problems.report(*json, "the coupling 'delayed' (cross-controller) is not yet supported; allowed: " +
                               list_of(words::kCouplings));
    return std::nullopt;
  }
  const auto word = read_word(json, words::kCouplings, problems);
  if (!word) return std::nullopt;
  if (encoder && *word == 0) {
    problems.report(*json, "an external encoder has no setpoint; allowed: 'actual'");
    return std::nullopt;
  }
  return *word == 0 ? Coupling::setpoint : Coupling::actual;
}

void load_leading_value(const JsonValue& json, Axis& axis, const Loading& loading) {
  const Fields fields(json, keys::kLeadingValue, loading.problems);
  const JsonValue* const to = fields["to"];
  auto* const source = static_cast<LeadingObject*>(loading.find_object(to, kLeading));
  const auto coupling = read_coupling(fields["coupling"], source, loading.problems);
  if (source == nullptr || !coupling) return;
  if (source == &axis) return loading.problems.report(*to, "an axis cannot follow itself");
  const auto same = [&](const LeadingValue& other) { return other.source == source; };
  if (std::any_of(axis.leading_values.begin(), axis.leading_values.end(), same))
    return loading.problems.report(*to, to->shown() + " is a leading value of '" + axis.name + "' already");
  axis.leading_values.push_back({source, *coupling});
}

void load_leading_values(const JsonValue& json, Axis& axis, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  if (axis.kind != ObjectKind::TO_SynchronousAxis && !json.elements.empty())
    return loading.problems.report(json, "a " + std::string(kind_name(axis.kind)) +
                                             " has no leading values; allowed with: TO_SynchronousAxis");
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
  const Fields fields(json, keys::kObject, problems);
  const std::size_t before = problems.count();
  if (const JsonValue* const config = fields["config"]) {
    load_configuration(*config, axis, loading);
    load_position_limits(*config, axis, loading);
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
  if (const JsonValue* const values = fields["leading_values"]) load_leading_values(*values, axis, loading);
}

void load_object(const JsonValue& json, TechnologyObject& object, const Loading& loading) {
  switch (object.kind) {
    case ObjectKind::TO_SpeedAxis:
    case ObjectKind::TO_PositioningAxis:
    case ObjectKind::TO_SynchronousAxis:
      return load_axis(json, static_cast<Axis&>(object), loading);
    case ObjectKind::TO_ExternalEncoder:
      return load_encoder(json, static_cast<ExternalEncoder&>(object), loading);
    case ObjectKind::TO_MeasuringInput:
      return load_measuring_input(json, static_cast<MeasuringInput&>(object), loading);
    case ObjectKind::TO_OutputCam:
      return load_output_cam(json, static_cast<OutputCam&>(object), loading);
    case ObjectKind::TO_CamTrack:
      return load_cam_track(json, static_cast<CamTrack&>(object), loading);
    case ObjectKind::TO_Cam:
    case ObjectKind::TO_Cam_10k:
      return load_cam(json, static_cast<Cam&>(object), loading);
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
