// MCO 305: parameters by name or number, wiring, and its programs, which are compiled here.
#include "scheduler/mco305/mco305.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "projects/aposs/compiler.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "projects/json/named_file.hpp"
#include "projects/json/text_file.hpp"
#include "projects/keys/objects.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/mco305_retain.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kLargestParameterFile = 1 << 20;
constexpr int kInputs[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 18, 19, 27, 29, 32, 33};
constexpr int kOutputs[] = {1, 2, 3, 4, 5, 6, 7, 8, 21, 22, 27, 29};
constexpr int kAnalogInputs[] = {53, 54}, kAnalogOutputs[] = {42};

std::optional<std::int32_t> whole_number(std::string_view text) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

class DeviceLoader {
 public:
  DeviceLoader(Mco305& device, const Loading& loading)
      : device_(device), loading_(loading), problems_(loading.problems) {}

  void load(const JsonValue& json);

 private:
  void load_parameters(const JsonValue& json, bool from_file);
  void load_parameter(const std::string& name, const JsonValue& json);
  void store(std::int32_t number, std::int32_t value, const JsonValue& json);
  void warn_without_effect(std::int32_t number, std::int32_t value, const JsonValue& json) const;
  void load_parameter_file(const JsonValue& json);
  void warn_of_windows(const JsonValue& json) const;
  void load_drive(const JsonValue& json);
  void load_master(const JsonValue& json);
  void load_counts(const JsonValue& json);
  void load_markers(const JsonValue& json, mco305::MarkerTrackSettings& markers);
  template <std::size_t n>
  std::optional<std::size_t> line(const std::string& name, const JsonValue& json, const int (&allowed)[n]);
  void load_wiring(const Fields& fields);
  void warn_of_shared_terminals(const Fields& fields) const;
  void load_programs(const JsonValue& json);
  void load_program(const JsonValue& json);
  void compile(const JsonValue& at, const Fields& fields, DeviceProgram& program);
  void warn_of_budget(const JsonValue& json) const;
  void align_variables(const JsonValue& json);
  aposs::CompilerSettings compiler_settings() const {
    return {.later_edition = device_.settings.later_edition, .variables_of_others = variables_};
  }
  /// This loading, with problems told elsewhere.
  Loading telling(Problems& problems) const {
    return {loading_.project, problems,     loading_.instances,   loading_.folder,
            loading_.named,   loading_.use, loading_.used_outside};
  }
  void take(const JsonValue& at, aposs::CompiledProgram compiled, DeviceProgram& program);

  Mco305& device_;
  const Loading& loading_;
  Problems& problems_;
  std::map<std::int32_t, std::string> given_;  // parameters of the project itself
  std::vector<std::string> variables_;         // of all programs, once these are known
};

void DeviceLoader::load_parameter(const std::string& name, const JsonValue& json) {
  const auto number = aposs::parameter_of(name);
  if (!number) {
    std::string upper = name;
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    const std::string nearest = aposs::nearest_parameter(upper);
    return problems_.report(json,
                            quote(name) + " is no parameter; allowed: a mnemonic or a number of the option" +
                                (nearest.empty() ? "" : " (nearest: " + nearest + ")") + ", or 1900 to 1999");
  }
  const auto [other, first] = given_.emplace(*number, name);
  if (!first)
    return problems_.report(
        json, quote(name) + " and " + quote(other->second) + " are one parameter; allowed is one of them");
  if (mco305::is_read_out(*number))
    return problems_.report(json, aposs::parameter_text(*number) + " is read only; no project sets it");
  double lowest = -2147483648.0, highest = 2147483647.0, scale = 1.0;
  if (!mco305::is_application_parameter(*number)) {
    const mco305::Parameter& of = mco305::parameters()[mco305::parameter_index(*number)];
    for (int i = 0; i < of.decimals; ++i) scale *= 10.0;
    lowest = of.lowest / scale;
    highest = of.highest / scale;
    if (of.later_edition && !device_.settings.later_edition)
      return problems_.report(json, aposs::parameter_text(*number) +
                                        R"( is of the later edition; allowed with "firmware": "5.00")");
    if (*number == 3200) highest = 9;
  }
  const bool belongs_to_can = *number == mco305::kCanNumber || *number == mco305::kCanBaud;
  if (scale == 1.0) {
    const auto value =
        read_integer(&json, static_cast<std::int64_t>(lowest), static_cast<std::int64_t>(highest), problems_);
    if (!value) return;
    const auto whole = static_cast<std::int32_t>(*value);
    if (!mco305::is_option(*number, whole, device_.settings.later_edition))
      return problems_.report(json, std::to_string(whole) + " is not allowed here; allowed: " +
                                        std::string(mco305::options_of(*number)));
    if (belongs_to_can && whole != device_.parameters()[*number])
      return problems_.report(json, aposs::parameter_text(*number) +
                                        " belongs to CAN, which is not built; allowed: its start value " +
                                        std::to_string(device_.parameters()[*number]));
    store(*number, whole, json);
    return;
  }
  const auto value = read_number(&json, lowest, highest, problems_);
  if (value) store(*number, static_cast<std::int32_t>(std::lround(*value * scale)), json);
}

/// A value of the range with which nothing can be computed, such as 0 of what others are divided by, is none.
void DeviceLoader::store(std::int32_t number, std::int32_t value, const JsonValue& json) {
  if (device_.parameters().set(number, value) == 0) return warn_without_effect(number, value, json);
  problems_.report(json, aposs::parameter_text(number) + " = " + std::to_string(value) +
                             ": nothing can be computed with it; allowed: another value of its range");
}

void DeviceLoader::warn_without_effect(std::int32_t number, std::int32_t value, const JsonValue& json) const {
  if (mco305::is_application_parameter(number)) return;
  const mco305::Parameter& of = mco305::parameters()[mco305::parameter_index(number)];
  if (!of.effective && value != of.start)
    problems_.warn(json, aposs::parameter_text(number) + (of.mnemonic.empty() ? "" : " ") +
                             std::string(of.mnemonic) + " is declared, without effect");
}

void DeviceLoader::load_parameter_file(const JsonValue& json) {
  if (!read_string(&json, problems_)) return;
  const auto path = named_file(json, loading_.folder, loading_.folder, problems_);
  if (!path) return;
  if (const std::string_view reason = aposs::why_not_readable(*path); !reason.empty())
    return problems_.report(json, *path + ": " + std::string(reason));
  try {
    const JsonDocument document(read_text_file(*path, kLargestParameterFile));
    for (const Problem& problem : document.problems()) problems_.report(json, *path + ": " + problem.text);
    if (!document.usable()) return;
    Problems inner;
    const Loading of_file = telling(inner);
    DeviceLoader file(device_, of_file);
    file.load_parameters(document.root(), true);
    for (const Problem& problem : inner.take_errors())
      problems_.report(json, *path + problem.place + ": " + problem.text);
  } catch (const UnreadableFile& error) {
    problems_.report(json, error.what());
  }
}

/// What a file says first, then what stands in the project.
void DeviceLoader::load_parameters(const JsonValue& json, bool from_file) {
  if (read_object(&json, problems_) == nullptr) return;
  if (const JsonValue* const file = json.find("file"); file != nullptr && !from_file)
    load_parameter_file(*file);
  for (const auto& [name, value] : json.members)
    if (name != "file" || from_file) load_parameter(name, *value);
}

/// A window that is wider than the distance of its markers: told where it stands, else where the distance
/// does.
void DeviceLoader::warn_of_windows(const JsonValue& json) const {
  const auto name = [](std::int32_t number) {
    return aposs::parameter_text(number) + " " +
           std::string(mco305::parameters()[mco305::parameter_index(number)].mnemonic);
  };
  const auto given = [&](std::int32_t number) {
    const auto found = given_.find(number);
    return found != given_.end() ? json.find(found->second) : nullptr;
  };
  for (const auto& [window, distance] : {std::pair{mco305::kSyncMWinM, mco305::kSyncMPulsM},
                                         std::pair{mco305::kSyncMWinS, mco305::kSyncMPulsS}}) {
    const std::int32_t has = device_.parameters()[window], highest = device_.parameters()[distance];
    if (has <= highest) continue;
    const JsonValue* at = given(window);
    if (at == nullptr) at = given(distance);
    if (at == nullptr) at = json.find("file");
    problems_.warn(at != nullptr ? *at : json,
                   name(window) + " = " + std::to_string(has) +
                       " is wider than the distance of the markers; allowed: 0 to " +
                       std::to_string(highest) + ", which is " + name(distance));
  }
}

void DeviceLoader::load_drive(const JsonValue& json) {
  const std::size_t model = read_variant(json, keys::kDeviceDrives, problems_).value_or(0);
  const Fields fields(json, keys::kDeviceDrives, model, problems_);
  read_members(fields, keys::kDeviceDrives[model].keys, &device_.settings.drive, loading_);
  device_.settings.has_drive = model == 0;
  const JsonValue* const plant = fields["plant"];
  device_.settings.drive.plant.has_stop = plant != nullptr && plant->find("fixed_stop") != nullptr;
}

/// [counts, units]
void DeviceLoader::load_counts(const JsonValue& json) {
  if (read_array(&json, problems_) == nullptr) return;
  if (json.elements.size() != 2)
    return problems_.report(json, "there are " + std::to_string(json.elements.size()) +
                                      " numbers; allowed are two, [counts, units]");
  const auto counts = read_value(json.elements[0], keys::kDeviceMaster["counts_per_unit"], loading_);
  const auto units = read_value(json.elements[1], keys::kDeviceMaster["counts_per_unit"], loading_);
  if (counts) device_.master.counts = counts->number;
  if (units) device_.master.units = units->number;
}

void DeviceLoader::load_markers(const JsonValue& json, mco305::MarkerTrackSettings& markers) {
  const Fields fields = read_struct(json, keys::kMarkers, markers, loading_);
  const JsonValue* const noise = fields["noise"];
  const double highest = 0.5 * markers.period;
  if (noise != nullptr && highest > 0.0 && markers.noise > highest)
    problems_.warn(*noise, noise->shown() +
                               " is more than half the period: markers may change places; allowed without "
                               "this warning: 0 to " +
                               decimal_text(highest));
}

void DeviceLoader::load_master(const JsonValue& json) {
  const Fields fields(json, keys::kDeviceMaster, problems_);
  DeviceMaster& master = device_.master;
  if (const auto found = read_value(fields, keys::kDeviceMaster["follows"], loading_))
    master.follows = static_cast<LeadingObject*>(static_cast<TechnologyObject*>(found->address));
  if (const auto found = read_value(fields, keys::kDeviceMaster["encoder_output_of"], loading_))
    master.encoder_output_of = static_cast<LeadingObject*>(static_cast<TechnologyObject*>(found->address));
  if (const auto found = read_value(fields, keys::kDeviceMaster["signal"], loading_))
    master.signal = static_cast<const DINT*>(found->address);
  if (const JsonValue* const counts = fields["counts_per_unit"]) load_counts(*counts);
  if (const JsonValue* const markers = fields["markers"])
    load_markers(*markers, device_.settings.master_marks);
  const int given = (master.follows != nullptr ? 1 : 0) + (master.encoder_output_of != nullptr ? 1 : 0) +
                    (master.signal != nullptr ? 1 : 0);
  if (given > 1)
    problems_.report(json,
                     "a master encoder is turned by several; allowed is one of 'follows', 'signal', "
                     "'encoder_output_of'");
}

template <std::size_t n>
std::optional<std::size_t> DeviceLoader::line(const std::string& name, const JsonValue& json,
                                              const int (&allowed)[n]) {
  const auto number = whole_number(name);
  if (number && std::find(std::begin(allowed), std::end(allowed), *number) != std::end(allowed))
    return static_cast<std::size_t>(*number - 1);
  std::string all;
  for (const int one : allowed) all += (all.empty() ? "" : ", ") + std::to_string(one);
  problems_.report(json, quote(name) + " is no number of one; allowed: " + all);
  return std::nullopt;
}

void DeviceLoader::take(const JsonValue& at, aposs::CompiledProgram compiled, DeviceProgram& program) {
  for (const aposs::Message& error : compiled.errors)
    problems_.report(at, aposs::to_string(compiled.files, error));
  if (compiled.errors_found > compiled.errors.size())
    problems_.report(at, std::to_string(compiled.errors_found - compiled.errors.size()) + " further errors");
  for (const aposs::Message& warning : compiled.warnings)
    problems_.warn(at, aposs::to_string(compiled.files, warning));
  if (!compiled.image) return;
  program.image = std::move(*compiled.image);
  program.files = std::move(compiled.files);
}

void DeviceLoader::compile(const JsonValue& at, const Fields& fields, DeviceProgram& program) {
  const JsonValue* const file = fields["file"];
  const JsonValue* const lines = fields["lines"];
  if ((file == nullptr) == (lines == nullptr))
    return problems_.report(at, "a program is a 'file' or 'lines'; allowed is one of the two");
  if (file != nullptr) {
    if (!read_string(file, problems_)) return;
    const auto path = named_file(*file, loading_.folder, loading_.folder, problems_);
    if (!path) return;
    try {
      take(*file, aposs::compile_file(*path, compiler_settings(), loading_.folder), program);
    } catch (const UnreadableFile& error) {
      problems_.report(*file, error.what());
    }
    return;
  }
  if (read_array(lines, problems_) == nullptr) return;
  std::string text;
  for (const JsonValue* const line : lines->elements)
    if (const auto one = read_string(line, problems_)) text += std::string(*one) + "\n";
  take(*lines,
       aposs::compile_program("program " + std::to_string(program.number), text, {}, compiler_settings()),
       program);
}

void DeviceLoader::load_program(const JsonValue& json) {
  const Fields fields(json, keys::kDeviceProgram, problems_);
  const auto number = read_value(fields, keys::kDeviceProgram["number"], loading_);
  const auto autostart = read_value(fields, keys::kDeviceProgram["autostart"], loading_);
  if (!number) return;
  DeviceProgram program;
  program.number = static_cast<std::int32_t>(number->integer);
  program.autostart = autostart && autostart->integer != 0;
  for (const DeviceProgram& other : device_.programs) {
    if (other.number == program.number)
      problems_.report(*fields["number"],
                       "there is a program " + std::to_string(program.number) + " already");
    if (other.autostart && program.autostart)
      problems_.report(*fields["autostart"], "program " + std::to_string(other.number) +
                                                 " starts by itself already; allowed is one of all");
  }
  compile(json, fields, program);
  device_.programs.push_back(std::move(program));
}

void DeviceLoader::load_programs(const JsonValue& json) {
  if (read_array(&json, problems_) == nullptr) return;
  for (const JsonValue* const program : json.elements) load_program(*program);
  const auto is_faulty = [](const DeviceProgram& program) { return program.image.code.empty(); };
  if (device_.programs.size() != json.elements.size() || std::ranges::any_of(device_.programs, is_faulty))
    return;
  align_variables(json);
  device_.declare_values();
}

/// Gives each variable the same cell in all programs: those with others of their own are compiled anew. What
/// there was to say has been said.
void DeviceLoader::align_variables(const JsonValue& json) {
  std::set<std::string> known;
  std::vector<std::string> all;
  for (const DeviceProgram& program : device_.programs)
    for (const std::string& name : program.image.variables)
      if (known.insert(aposs::folded(name)).second) all.push_back(name);
  Problems said;
  const Loading silent = telling(said);
  DeviceLoader again(device_, silent);
  again.variables_ = all;
  for (std::size_t i = 0; i < device_.programs.size(); ++i) {
    if (device_.programs[i].image.variables == all) continue;
    const Fields fields(*json.elements[i], keys::kDeviceProgram, said);
    again.compile(*json.elements[i], fields, device_.programs[i]);
  }
}

/// The tags at its terminals.
void DeviceLoader::load_wiring(const Fields& fields) {
  mco305::DeviceSettings& settings = device_.settings;
  const auto each = [&](const Key& key, const auto& allowed, auto&& wire) {
    const JsonValue* const terminals = fields[key.name];
    if (read_object(terminals, problems_) == nullptr) return;
    for (const auto& [name, tag] : terminals->members)
      if (const auto at = line(name, *tag, allowed))
        if (const auto found = read_value(tag, key, loading_)) wire(*at, found->address);
  };
  each(keys::kMco305["inputs"], kInputs,
       [&](std::size_t at, const void* tag) { settings.inputs[at] = static_cast<const bool*>(tag); });
  each(keys::kMco305["outputs"], kOutputs,
       [&](std::size_t at, void* tag) { settings.outputs[at] = static_cast<bool*>(tag); });
  each(keys::kMco305["analog_inputs"], kAnalogInputs, [&](std::size_t at, const void* tag) {
    settings.analog_inputs[at + 1 - kAnalogInputs[0]] = static_cast<const double*>(tag);
  });
  each(keys::kMco305["analog_outputs"], kAnalogOutputs,
       [&](std::size_t, void* tag) { settings.analog_output = static_cast<double*>(tag); });
}

/// X59/1 and X59/2 are inputs or outputs.
void DeviceLoader::warn_of_shared_terminals(const Fields& fields) const {
  const bool are_inputs = device_.parameters()[mco305::kIoMode] == 0;
  constexpr std::size_t kFirstInput = 11;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string terminal = " is terminal X59/" + std::to_string(i + 1);
    if (!are_inputs && device_.settings.inputs[kFirstInput + i - 1] != nullptr)
      problems_.warn(*fields["inputs"],
                     "input " + std::to_string(kFirstInput + i) + terminal +
                         R"(, which is an output and reads FALSE; allowed with "IOMODE": 0)");
    if (are_inputs && device_.settings.outputs[i] != nullptr)
      problems_.warn(*fields["outputs"],
                     "output " + std::to_string(i + 1) + terminal +
                         R"(, which is an input and stays FALSE; allowed with "IOMODE": 1)");
  }
}

/// Where programs that never wait would take a quarter of each step: told at the device that is one too many.
void DeviceLoader::warn_of_budget(const JsonValue& json) const {
  constexpr std::int64_t kCommand = 8, kQuarter = 250'000;  // [ns]
  if (device_.programs.empty()) return;
  std::int64_t others = 0;
  for (const auto& object : loading_.controller().objects) {
    if (object->kind != ObjectKind::MCO_305 || object.get() == &device_) continue;
    const auto& other = static_cast<const Mco305&>(*object);
    if (!other.programs.empty()) others += other.steps_per_millisecond;
  }
  const std::int64_t all = others + device_.steps_per_millisecond;
  if (others * kCommand > kQuarter || all * kCommand <= kQuarter) return;
  problems_.warn(json,
                 "with this device programs may carry out " + std::to_string(all) +
                     " internal commands in a step, which can take a quarter of a millisecond and more; "
                     "allowed without this warning: " +
                     std::to_string(kQuarter / kCommand) + " in all ('steps_per_ms')");
}

void DeviceLoader::load(const JsonValue& json) {
  const Fields fields(json, keys::kObjects, variant_of(device_), problems_);
  if (const auto edition = read_value(fields, keys::kMco305["firmware"], loading_))
    device_.settings.later_edition = edition->integer != 0;
  if (const JsonValue* const parameters = fields["parameters"]) {
    load_parameters(*parameters, false);
    warn_of_windows(*parameters);
  }
  if (const JsonValue* const drive = fields["drive"]) load_drive(*drive);
  if (const JsonValue* const master = fields["master"]) load_master(*master);
  if (const JsonValue* const markers = fields["markers"]) load_markers(*markers, device_.settings.markers);
  if (const JsonValue* const faults = fields["faults"])
    read_struct(*faults, keys::kDeviceFaults, device_.settings.faults, loading_);
  load_wiring(fields);
  warn_of_shared_terminals(fields);
  if (const auto scale = read_value(fields, keys::kMco305["controller_scale"], loading_))
    device_.settings.controller_scale = scale->number;
  if (const auto steps = read_value(fields, keys::kMco305["steps_per_ms"], loading_))
    device_.steps_per_millisecond = static_cast<std::int32_t>(steps->integer);
  if (const auto priority = read_value(fields, keys::kMco305["priority"], loading_))
    device_.priority = static_cast<int>(priority->integer);
  if (const auto times = read_value(fields, keys::kMco305["time_interrupts"], loading_))
    device_.time_interrupts = static_cast<std::int32_t>(times->integer);
  if (const JsonValue* const programs = fields["programs"]) load_programs(*programs);
  warn_of_budget(json);
  if (const auto locked = read_value(fields, keys::kMco305["write_protected"], loading_))
    device_.eeprom.write_protected = locked->integer != 0;
  device_.eeprom.disk = &loading_.controller().encoder_saving;
  if (const std::size_t kept = make_kept_arrays(device_); kept > kMaximumKeptCells)
    problems_.report(json, "its programs save arrays of " + std::to_string(kept) +
                               " elements; allowed where SAVE or SAVEPROM is used are " +
                               std::to_string(kMaximumKeptCells));
  constexpr std::int64_t kStep = 1'000'000;  // [ns]
  if (kStep % loading_.controller().clock.servo_cycle != 0)
    problems_.report(json, "an MCO 305 steps every 1ms, and servo_cycle is " +
                               duration_text(loading_.controller().clock.servo_cycle) +
                               "; allowed: one that divides 1ms, such as 250us, 500us, 1ms");
}

}  // namespace

void load_mco305(const JsonValue& json, Mco305& device, const Loading& loading) {
  DeviceLoader(device, loading).load(json);
}

}  // namespace lockstep
