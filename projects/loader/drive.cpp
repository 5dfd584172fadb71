#include "projects/loader/drive.hpp"

namespace lockstep {
namespace {

constexpr double kMost = 1e12;
constexpr double kLeast = 1e-12;  // of what has to be greater than 0

void load_fixed_stop(const JsonValue& json, MachinePlantSettings& plant, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kFixedStop, problems);
  const auto position = read_number(fields["position"], -kMost, kMost, problems);
  const auto stiffness = read_number(fields["stiffness"], kLeast, kMost, problems);
  const JsonValue* const direction = fields["direction"];
  const auto word = direction == nullptr ? std::optional<std::size_t>{0}
                                         : read_word(direction, words::kDirections, problems);
  if (!position || !stiffness || !word) return;
  plant.has_stop = true;
  plant.stop = {*position, *word == 0 ? 1 : -1, *stiffness};
}

void load_sensor(const JsonValue& json, Axis& axis, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kSensor, problems);
  const JsonValue* const number = fields["sensor"];
  const auto index = read_integer(number, 2, Axis::kSensors, problems);
  SimulatedSensor sensor{.exists = true};
  const JsonValue* const ratio = fields["ratio"];
  if (const auto value = read_number(ratio, -kMost, kMost, problems)) {
    sensor.ratio = *value;
    if (*value == 0.0) problems.report(*ratio, "0 is not allowed; allowed: any other number");
  }
  if (const auto value = read_number(fields["resolution"], 0.0, kMost, problems)) sensor.resolution = *value;
  if (const auto value = read_bool(fields["inverted"], problems)) sensor.inverted = *value;
  if (const auto value = read_number(fields["start_position"], -kMost, kMost, problems))
    sensor.start_position = *value;
  sensor.fault = find_bool_tag(fields["fault"], loading);
  if (!index) return;
  SimulatedSensor& place = axis.drive_settings.sensors[static_cast<std::size_t>(*index - 2)];
  if (place.exists) return problems.report(*number, "there is an encoder " + number->shown() + " already");
  if (!axis.data.Sensor[*index - 1].Existent)
    return problems.report(
        *number, R"(the axis has no such encoder; allowed: one with "config": { "Sensor[)" + number->shown() +
                     R"(]": { "Existent": true } })");
  place = sensor;
}

}  // namespace

const bool* find_bool_tag(const JsonValue* json, const Loading& loading) {
  if (json == nullptr) return nullptr;
  const auto tag = read_string(json, loading.problems);
  if (!tag) return nullptr;
  const auto found = loading.find(*json, *tag);
  if (!found) return nullptr;
  if (found->tag == nullptr || found->signal.type != Type::BOOL) {
    loading.problems.report(*json, json->shown() + " is not allowed here; allowed: the name of a BOOL tag");
    return nullptr;
  }
  return static_cast<const bool*>(found->signal.address);
}

void load_sensors(const JsonValue& json, Axis& axis, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  for (const JsonValue* const sensor : json.elements) load_sensor(*sensor, axis, loading);
}

void check_operative_sensor(const JsonValue& json, const Axis& axis, const Loading& loading) {
  const UDINT first = axis.data.PositionControl.InitialOperativeSensor;
  if (first < 2 || first > Axis::kSensors || axis.drive_settings.sensors[first - 2].exists) return;
  loading.problems.report(json, "PositionControl.InitialOperativeSensor is " + std::to_string(first) +
                                    ", but 'sensors' has no such encoder");
}

void load_plant(const JsonValue& json, DriveSettings& drive, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kPlant, problems);
  MachinePlantSettings& plant = drive.plant;
  if (const auto inertia = read_number(fields["inertia"], kLeast, kMost, problems)) plant.inertia = *inertia;
  if (const auto friction = read_number(fields["friction"], 0.0, kMost, problems)) plant.friction = *friction;
  if (const auto torque = read_number(fields["load_torque"], -kMost, kMost, problems))
    plant.load_torque = *torque;
  if (const auto torque = read_number(fields["maximum_torque"], kLeast, kMost, problems))
    plant.maximum_torque = *torque;
  if (const JsonValue* const stop = fields["fixed_stop"]) load_fixed_stop(*stop, plant, loading);
}

void load_faults(const JsonValue& json, SimulatedFaults& faults, const Loading& loading) {
  const Fields fields(json, keys::kFaults, loading.problems);
  faults.drive = find_bool_tag(fields["drive"], loading);
  faults.encoder = find_bool_tag(fields["encoder"], loading);
  faults.communication = find_bool_tag(fields["communication"], loading);
  faults.blocked = find_bool_tag(fields["blocked"], loading);
}

}  // namespace lockstep
