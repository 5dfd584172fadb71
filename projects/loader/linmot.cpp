// LinMot controllers: parameters by their printed names, motors, curves, wiring; lines to them.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "projects/json/text_file.hpp"
#include "projects/keys/objects.hpp"
#include "projects/loader/linmot_curves.hpp"
#include "projects/loader/linmot_tables.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep {
namespace {

using linmot::kMotors;

class LinMotLoader {
 public:
  LinMotLoader(LinMotController& controller, const Loading& loading)
      : controller_(controller), loading_(loading), problems_(loading.problems) {}

  void load(const JsonValue& json);

 private:
  void load_hardware(const JsonValue& json);
  void load_cycle(const JsonValue& json, const Fields& fields);
  void load_config(const JsonValue& json);
  void load_entry(const std::string& name, const JsonValue& json, const std::string& prefix, void* target,
                  bool of_motor);
  void load_directory(const JsonValue& json, const std::string& prefix, void* target, bool of_motor);
  void load_parameter(const JsonValue& json, const linmot::Parameter& parameter, void* target);
  bool refuses_unbuilt(const JsonValue& json, const linmot::Parameter& parameter, double value,
                       const void* target) const;
  void load_drives(const JsonValue& json);
  void load_motor(const std::string& name, const JsonValue& json);
  void load_wiring(const JsonValue& json);
  void load_faults(const JsonValue& json);
  void check_type(const JsonValue& json, std::size_t index);
  void check_interface(const JsonValue& json);

  LinMotController& controller_;
  const Loading& loading_;
  Problems& problems_;
};

/// The parts of a path behind a prefix, for messages.
std::vector<std::string> names_below(const std::string& prefix, bool of_motor) {
  std::vector<std::string> names;
  const auto all = of_motor ? linmot::motor_parameters() : linmot::system_parameters();
  for (const linmot::Parameter& parameter : all) {
    if (parameter.scope > linmot::Scope::linear_motor || !parameter.path.starts_with(prefix)) continue;
    const std::string_view rest = parameter.path.substr(prefix.size());
    const std::string name(rest.substr(0, rest.find('\\')));
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

void LinMotLoader::load_hardware(const JsonValue& json) {
  const auto name = read_string(&json, problems_);
  if (!name) return;
  if (const linmot::Hardware* const found = linmot::find_hardware(*name)) {
    controller_.hardware = found;
    return;
  }
  std::vector<std::string_view> names;
  for (const linmot::Hardware& one : linmot::all_hardware()) names.push_back(one.name);
  problems_.report(
      json, json.shown() + " is no controller" + did_you_mean(*name, names) + "; allowed: " + list_of(names));
}

/// The position loops close a whole number of times in a servo cycle, and often enough for every stop.
void LinMotLoader::load_cycle(const JsonValue& json, const Fields& fields) {
  constexpr double kSecond = 1e9;  // [ns]
  const auto given = read_value(fields, keys::kLinMot["control_cycle"], loading_);
  if (given) controller_.control_cycle = given->number;
  const JsonValue& at = given ? *fields["control_cycle"] : json;
  const std::int64_t servo_cycle = loading_.controller().clock.servo_cycle;
  const auto cycle = static_cast<std::int64_t>(std::llround(controller_.control_cycle * kSecond));
  if (cycle > servo_cycle || servo_cycle % cycle != 0 ||
      servo_cycle / cycle > LinMotController::kMaximumControlCycles)
    problems_.report(at, "control_cycle is " + duration_text(cycle) + "; allowed: one of which 1 to " +
                             std::to_string(LinMotController::kMaximumControlCycles) +
                             " are a servo_cycle, " + duration_text(servo_cycle));
  for (const linmot::MotorSettings& motor : controller_.motor_settings)
    for (const DampedStop& stop : motor.plant.stops) {
      const double mass = motor.plant.slider_mass + motor.plant.load_mass;
      const double longest = 0.5 * std::sqrt(mass / stop.stiffness);
      if (controller_.control_cycle > longest)
        problems_.report(at, "control_cycle is " + duration_text(cycle) +
                                 "; allowed with a stop of that stiffness: at most " +
                                 duration_text(static_cast<std::int64_t>(longest * kSecond)) +
                                 ", 0.5 √(mass / stiffness)");
    }
}

// ---- Parameters

/// Speeds and accelerations count in whole increments, of which there is at least one.
double counting_value(const linmot::Parameter& parameter, double value) {
  if (parameter.unit != "m/s" && parameter.unit != "m/s²") return value;
  const double increment = linmot::increment_of(parameter);
  return std::max(1, linmot::increments(value, increment)) * increment;
}

void LinMotLoader::load_parameter(const JsonValue& json, const linmot::Parameter& parameter, void* target) {
  using linmot::Kind;
  if (parameter.read_only() || parameter.kind == Kind::shown)
    return problems_.report(json, quote(parameter.path) + " is read only; no project sets it");
  std::optional<double> value;
  if (parameter.kind == Kind::on_off) {
    if (const auto on = read_bool(&json, problems_)) value = *on ? 1.0 : 0.0;
  } else if (parameter.kind == Kind::choice) {
    if (const auto word = read_word(&json, parameter.options, problems_)) value = static_cast<double>(*word);
  } else if (parameter.kind == Kind::whole) {
    if (const auto number = read_integer(&json, static_cast<std::int64_t>(parameter.range.lowest),
                                         static_cast<std::int64_t>(parameter.range.highest), problems_))
      value = static_cast<double>(*number);
  } else if (parameter.unit == "ms" && json.kind == JsonKind::string) {
    constexpr double kMillisecond = 1e6;  // [ns]
    if (const auto time = read_duration(&json, std::llround(parameter.range.lowest * kMillisecond),
                                        std::llround(parameter.range.highest * kMillisecond), problems_))
      value = static_cast<double>(*time) / kMillisecond;
  } else {
    value = read_number(&json, parameter.range.lowest, parameter.range.highest, problems_);
  }
  if (!value || refuses_unbuilt(json, parameter, *value, target)) return;
  if (!parameter.effective() && *value != 0.0)
    problems_.warn(json, quote(parameter.path) + " has no effect yet");
  constexpr double kReach = linmot::kPositionReach * linmot::kPositionIncrement;
  if (parameter.unit == "mm" && std::abs(*value) > kReach)
    problems_.warn(json, json.shown() + " mm lies outside of the positions that protocols have, ±630 mm");
  if (parameter.path.starts_with("Error Handling\\Error Mask\\") && *value == 0.0)
    problems_.warn(json, "that mask hides an error: the motor goes on with it");
  linmot::set_parameter(parameter, target, counting_value(parameter, *value));
}

/// Groups of motors and sensors outside of them have their parameters, and are not built.
bool LinMotLoader::refuses_unbuilt(const JsonValue& json, const linmot::Parameter& parameter, double value,
                                   const void* target) const {
  if (value == 0.0) return false;
  if (parameter.path == "Advanced\\Master / Booster") {
    const bool first = target == &controller_.data.Motors[0].Parameters;
    problems_.report(
        json, json.shown() +
                  (first ? " needs a master before it (E0008), and is not built yet" : " is not built yet") +
                  "; allowed: Master");
    return true;
  }
  if (parameter.path == "Advanced\\Position Sensor") {
    const bool last = target == &controller_.data.Motors[kMotors - 1].Parameters;
    problems_.report(
        json, json.shown() + (last ? " is no sensor for D (E000A), and not built yet" : " is not built yet") +
                  "; allowed: Internal Sensor");
    return true;
  }
  return false;
}

/// @param prefix with its last backslash
void LinMotLoader::load_entry(const std::string& name, const JsonValue& json, const std::string& prefix,
                              void* target, bool of_motor) {
  const std::string path = prefix + name;
  const linmot::Parameter* const parameter =
      of_motor ? linmot::find_motor_parameter(path) : linmot::find_system_parameter(path);
  if (parameter != nullptr) return load_parameter(json, *parameter, target);
  if (!names_below(path + "\\", of_motor).empty()) return load_directory(json, path + "\\", target, of_motor);
  const std::vector<std::string> texts = names_below(prefix, of_motor);
  const std::vector<std::string_view> names(texts.begin(), texts.end());
  problems_.report_key(json, "there is no parameter or directory " + quote(path) + did_you_mean(name, names) +
                                 "; allowed: " + list_of(names));
}

void LinMotLoader::load_directory(const JsonValue& json, const std::string& prefix, void* target,
                                  bool of_motor) {
  if (read_object(&json, problems_) == nullptr) return;
  for (const auto& [name, member] : json.members) load_entry(name, *member, prefix, target, of_motor);
}

void LinMotLoader::check_type(const JsonValue& json, std::size_t index) {
  const auto& parameters = controller_.data.Motors[index].Parameters;
  const linmot::Parameter& type = *linmot::find_motor_parameter("Type");
  const std::string name(1, static_cast<char>('A' + index));
  if (parameters.type >= linmot::kFirstOtherType)
    problems_.report(json, "motors of type " +
                               quote(type.options[static_cast<std::size_t>(parameters.type)]) +
                               " are not built yet; allowed: linear motors, LinMot P0x-…, and 'No Drive'");
  if (parameters.type != linmot::kNoDrive && index >= controller_.hardware->motors)
    problems_.report(json, "the controller has " + std::to_string(controller_.hardware->motors) +
                               " motors, and " + name + " is none of them");
}

void LinMotLoader::load_drives(const JsonValue& json) {
  constexpr std::array<std::string_view, kMotors> kDrives = {"Drive A", "Drive B", "Drive C", "Drive D"};
  if (read_object(&json, problems_) == nullptr) return;
  for (const auto& [name, drive] : json.members) {
    const auto found = std::ranges::find_if(
        kDrives, [&wanted = name](std::string_view one) { return same_name(one, wanted); });
    if (found == kDrives.end()) {
      problems_.report_key(*drive, "there is no drive " + quote(name) + "; allowed: " + list_of(kDrives));
      continue;
    }
    const auto index = static_cast<std::size_t>(found - kDrives.begin());
    load_directory(*drive, "", &controller_.data.Motors[index].Parameters, true);
    check_type(*drive, index);
    const linmot::MotorParameters& limits = controller_.data.Motors[index].Parameters;
    if (limits.minimal_position > limits.maximal_position)
      problems_.report(*drive, "Minimal Position, " + decimal_text(limits.minimal_position) +
                                   " mm, is above Maximal Position, " +
                                   decimal_text(limits.maximal_position) + " mm; allowed: at most that");
  }
}

void LinMotLoader::load_config(const JsonValue& json) {
  if (read_object(&json, problems_) == nullptr) return;
  for (const auto& [name, member] : json.members) {
    if (same_name(name, "Drives"))
      load_drives(*member);
    else
      load_entry(name, *member, "", &controller_.data.Parameters, false);
  }
}

void LinMotLoader::check_interface(const JsonValue& json) {
  using enum linmot::CommandInterface;
  const auto wanted = controller_.command_interface();
  const std::string name(controller_.hardware->name);
  if (wanted == application)
    problems_.report(json, "Command Interface 'Application' is not described; allowed: another one");
  if (wanted == mt && !controller_.hardware->mt)
    problems_.report(json, name + " has no Command Interface 'MT' (E0004); allowed: one with -MT");
  if (wanted == profibus && !controller_.hardware->profibus)
    problems_.report(json, name + " has no PROFIBUS; allowed: one with -DP");
}

// ---- Motors and wiring

void LinMotLoader::load_motor(const std::string& name, const JsonValue& json) {
  const std::size_t index = linmot_motor(name);
  if (index >= kMotors)
    return problems_.report_key(json, "there is no motor " + quote(name) + "; allowed: A, B, C, D");
  linmot::MotorSettings& motor = controller_.motor_settings[index];
  motor.exists = true;
  const Fields fields = read_struct(json, keys::kLinMotMotor, motor, loading_);
  if (const JsonValue* const type = fields["type"])
    if (const auto word = read_word(type, linmot::find_motor_parameter("Type")->options, problems_))
      motor.type = static_cast<int>(*word);
  if (controller_.data.Motors[index].Parameters.type == linmot::kNoDrive)
    problems_.report(json, "Drive " + name + " is 'No Drive'; allowed with a motor: another Type in config");
}

void LinMotLoader::load_wiring(const JsonValue& json) {
  const Fields fields(json, keys::kLinMotWiring, problems_);
  const auto bit = [&](const Key& key) {
    const auto found = read_value(fields, key, loading_);
    return found ? static_cast<bool*>(found->address) : nullptr;
  };
  linmot::Wiring& wiring = controller_.wiring;
  wiring.run = bit(keys::kLinMotWiring["RUN"]);
  wiring.init = bit(keys::kLinMotWiring["INIT"]);
  wiring.freeze = bit(keys::kLinMotWiring["FREEZE"]);
  wiring.stop = bit(keys::kLinMotWiring["STOP"]);
  for (const Key& key : keys::kLinMotWiring.all) {
    const auto index = static_cast<std::size_t>(key.name.back() - 'A');
    if (key.name.starts_with("TRIG ")) controller_.motor_settings[index].trigger = bit(key);
    if (key.name.starts_with("OUT "))
      wiring.outputs[static_cast<std::size_t>(key.name.back() - '1')] = bit(key);
    if (!key.name.starts_with("ANALOG ")) continue;
    if (const auto found = read_value(fields, key, loading_))
      controller_.motor_settings[index].analog = static_cast<const LREAL*>(found->address);
  }
}

void LinMotLoader::load_faults(const JsonValue& json) {
  const Fields fields = read_struct(json, keys::kLinMotFaults, controller_.wiring, loading_);
  for (const char* const name : {"A", "B", "C", "D"})
    if (const JsonValue* const motor = fields[name])
      read_struct(*motor, keys::kLinMotMotorFaults, controller_.motor_settings[linmot_motor(name)], loading_);
}

void LinMotLoader::load(const JsonValue& json) {
  const Fields fields(json, keys::kObjects, variant_of(controller_), problems_);
  if (const JsonValue* const hardware = fields["hardware"]) load_hardware(*hardware);
  if (const JsonValue* const config = fields["config"]) {
    load_config(*config);
    check_interface(*config);
  }
  if (const JsonValue* const motors = fields["motors"]; read_object(motors, problems_) != nullptr)
    for (const auto& [name, motor] : motors->members) load_motor(name, *motor);
  load_cycle(json, fields);
  if (const JsonValue* const curves = fields["curves"]) load_linmot_curves(*curves, controller_, loading_);
  if (const JsonValue* const io = fields["io"]) load_wiring(*io);
  if (const JsonValue* const faults = fields["faults"]) load_faults(*faults);
  if (const JsonValue* const rows = fields["state_table"]) load_state_table(*rows, controller_, loading_);
  if (const JsonValue* const codes = fields["input_table"]) load_input_table(*codes, controller_, loading_);
  if (const JsonValue* const bus = fields["profibus"]) load_linmot_profibus(*bus, controller_, loading_);
  if (const JsonValue* const curves = fields["curves"]) warn_of_linmot_curves(*curves, controller_, loading_);
}

/// The controller that takes part first among those of a line serves it.
void give_to_first(linmot::AsciiLine& line) {
  LinMotController* first = nullptr;
  for (LinMotController* const one : line.controllers)
    if (one != nullptr && (first == nullptr || one->number < first->number)) first = one;
  if (first != nullptr) first->lines.push_back(&line);
}

void load_ascii_line(const JsonValue& json, const Loading& loading) {
  linmot::AsciiLine& line = loading.project.ascii_lines.emplace_back();
  line.applies = &loading.controller().apply_stimuli;
  const Fields fields = read_struct(json, keys::kAsciiLine, line, loading);
  const JsonValue* const controllers = fields["controllers"];
  if (read_object(controllers, loading.problems) == nullptr) return;
  const int highest = line.mode == linmot::AsciiLine::Mode::rs232 ? 1 : linmot::kControllersOnLine;
  for (const auto& [number, name] : controllers->members) {
    if (number.size() != 1 || number[0] < '1' || number[0] > '0' + highest) {
      loading.problems.report_key(*name, quote(number) + " is no controller of the line; allowed: 1" +
                                             (highest == 1 ? " with RS232" : " to 6 with RS485"));
      continue;
    }
    if (TechnologyObject* const object = loading.find_object(name, keys::kLinMotController))
      line.controllers[static_cast<std::size_t>(number[0] - '1')] = static_cast<LinMotController*>(object);
  }
  give_to_first(line);
}

}  // namespace

std::size_t linmot_motor(std::string_view name) noexcept {
  return name.size() == 1 && name[0] >= 'A' && name[0] <= 'D' ? static_cast<std::size_t>(name[0] - 'A')
                                                              : kMotors;
}

void load_linmot(const JsonValue& json, LinMotController& controller, const Loading& loading) {
  LinMotLoader(controller, loading).load(json);
}

void load_ascii_lines(const JsonValue& json, const Loading& loading) {
  if (read_array(&json, loading.problems) == nullptr) return;
  for (const JsonValue* const line : json.elements) load_ascii_line(*line, loading);
}

void load_scripted_command(const JsonValue& json, std::int64_t at, const Loading& loading) {
  const Fields fields(json, keys::kScriptedCommand, loading.problems);
  const auto line = read_value(fields, keys::kScriptedCommand["line"], loading);
  const auto text = read_value(fields, keys::kScriptedCommand["send"], loading);
  if (!text) return;
  const auto index = line ? static_cast<std::size_t>(line->integer) : 0;
  auto& lines = loading.project.ascii_lines;
  if (index >= lines.size())
    return loading.problems.report(json, "there is no line " + std::to_string(index) +
                                             " in 'ascii'; there are " + std::to_string(lines.size()));
  linmot::ScriptedCommand command;
  command.at = at;
  command.text = text->text;
  command.request = linmot::read_ascii(command.text);
  auto& script = lines[index].script;
  const auto behind = std::ranges::upper_bound(script, at, {}, &linmot::ScriptedCommand::at);
  script.insert(behind, std::move(command));
}

}  // namespace lockstep
