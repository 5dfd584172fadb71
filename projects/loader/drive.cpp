#include "projects/loader/drive.hpp"

#include <cmath>

#include "projects/keys/drive.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/types/published.hpp"

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

/// A linear motor counts in mm and pushes with N; so does its axis.
void check_units(const JsonValue& json, const Axis& axis, const Loading& loading) {
  constexpr UDINT kMillimetre = 1013, kFineMillimetre = 1536, kNewton = 1120;
  const auto refuse = [&](const std::string& what, const char* allowed) {
    loading.problems.report(json, "a linear motor, and " + what + "; allowed: " + allowed);
  };
  const AxisData& data = axis.data;
  if (axis.kind == ObjectKind::TO_SpeedAxis)
    return refuse("a speed axis has no position", "an axis with positions");
  if (data.Actor.MotorType != MotorType::linear)
    refuse("Actor.MotorType is " + std::to_string(data.Actor.MotorType), "1, linear");
  if (data.Properties.MotionType != MotionType::linear)
    refuse("Properties.MotionType is " + std::to_string(data.Properties.MotionType), "0, linear");
  if (data.Units.LengthUnit != kMillimetre && data.Units.LengthUnit != kFineMillimetre)
    refuse("Units.LengthUnit is " + std::to_string(data.Units.LengthUnit), "1013 or 1536, mm");
  if (data.Units.ForceUnit != kNewton)
    refuse("Units.ForceUnit is " + std::to_string(data.Units.ForceUnit), "1120, N");
}

/// The position loop closes a whole number of times in a servo cycle, and often enough for every stop.
void check_control_cycle(const JsonValue& json, const Fields& fields, const LinearMotorSettings& motor,
                         const Loading& loading) {
  constexpr double kSecond = 1e9;  // [ns]
  constexpr double kPartOfPeriod = 0.5;
  const std::int64_t servo_cycle = loading.controller().clock.servo_cycle;
  const auto cycle = static_cast<std::int64_t>(std::llround(motor.control_cycle * kSecond));
  const JsonValue* const given = fields["control_cycle"];
  const JsonValue& at = given != nullptr ? *given : json;
  if (cycle > servo_cycle || servo_cycle % cycle != 0 ||
      servo_cycle / cycle > LinearMotorDrive::kMaximumControlCycles)
    loading.problems.report(at, "control_cycle is " + duration_text(cycle) + "; allowed: one of which 1 to " +
                                    std::to_string(LinearMotorDrive::kMaximumControlCycles) +
                                    " are a servo_cycle, " + duration_text(servo_cycle));
  const double mass = motor.plant.slider_mass + motor.plant.load_mass;
  for (const DampedStop& stop : motor.plant.stops) {
    const double longest = kPartOfPeriod * std::sqrt(mass / stop.stiffness);
    if (motor.control_cycle <= longest) continue;
    loading.problems.report(
        at, "control_cycle is " + duration_text(cycle) + "; allowed with a stop of that stiffness: at most " +
                duration_text(static_cast<std::int64_t>(longest * kSecond)) + ", 0.5 √(mass / stiffness)");
  }
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
  if (keys::kDrives[model].name == "linear_motor") {
    check_units(json, axis, loading);
    check_control_cycle(json, fields, drive.linear_motor, loading);
  }
  load_sensors(fields["sensors"], axis, loading);
  check_operative_sensor(json, axis, loading);
}

}  // namespace lockstep
