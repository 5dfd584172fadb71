#include "projects/loader/drive.hpp"

#include "projects/keys/drive.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

void load_sensor(const JsonValue& json, Axis& axis, const Loading& loading) {
  Problems& problems = loading.problems;
  SimulatedSensor sensor{.exists = true};
  const Fields fields = read_struct(json, keys::kSensor, sensor, loading);
  const auto number = read_value(fields, keys::kSensor["sensor"], loading);
  if (!number) return;
  const JsonValue& at = *fields["sensor"];
  const auto index = static_cast<std::size_t>(number->integer);
  SimulatedSensor& place = axis.drive_settings.sensors[index - 2];
  if (place.exists) return problems.report(at, "there is an encoder " + at.shown() + " already");
  if (!axis.data.Sensor[index - 1].Existent)
    return problems.report(at, R"(the axis has no such encoder; allowed: one with "config": { "Sensor[)" +
                                   at.shown() + R"(]": { "Existent": true } })");
  place = sensor;
}

void load_sensors(const JsonValue* json, Axis& axis, const Loading& loading) {
  if (read_array(json, loading.problems) == nullptr) return;
  for (const JsonValue* const sensor : json->elements) load_sensor(*sensor, axis, loading);
}

/// Position control begins with an encoder that is there.
void check_operative_sensor(const JsonValue& json, const Axis& axis, const Loading& loading) {
  const UDINT first = axis.data.PositionControl.InitialOperativeSensor;
  if (first < 2 || first > Axis::kSensors || axis.drive_settings.sensors[first - 2].exists) return;
  loading.problems.report(json, "PositionControl.InitialOperativeSensor is " + std::to_string(first) +
                                    ", but 'sensors' has no such encoder");
}

/// The memory of a drive goes as far as a number of servo cycles.
void check_dead_time(const Fields& fields, const DriveSettings& drive, const Loading& loading) {
  constexpr double kSecond = 1e9;  // [ns]
  const std::int64_t longest =
      static_cast<std::int64_t>(keys::kMaximumDeadCycles) * loading.controller().clock.servo_cycle;
  if (drive.dead_time <= static_cast<double>(longest) / kSecond) return;
  report_kind(*fields["dead_time"], "a duration from 0ns to " + duration_text(longest), loading.problems);
}

void check_limit_switches(const Fields& fields, const MachineSignals& signals, const Loading& loading) {
  if (signals.limit_min && signals.limit_max && *signals.limit_min >= *signals.limit_max)
    loading.problems.report(*fields["limit_switches"], "min has to be less than max");
}

}  // namespace

void load_drive(const JsonValue& json, Axis& axis, const Loading& loading) {
  const std::size_t model = read_variant(json, keys::kDrives, loading.problems).value_or(0);
  axis.drive_model = &kDriveModels[model];
  DriveSettings& drive = axis.drive_settings;
  const Fields fields(json, keys::kDrives, model, loading.problems);
  read_members(fields, keys::kDrives[model].keys, &drive, loading);
  const JsonValue* const plant = fields["plant"];
  drive.plant.has_stop = plant != nullptr && plant->find("fixed_stop") != nullptr;
  check_dead_time(fields, drive, loading);
  check_limit_switches(fields, drive.signals, loading);
  load_sensors(fields["sensors"], axis, loading);
  check_operative_sensor(json, axis, loading);
}

}  // namespace lockstep
