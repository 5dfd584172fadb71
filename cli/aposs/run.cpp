// lockstep aposs run: a program in virtual time, in a device whose axis is where it is told to be.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "cli/aposs/aposs_command.hpp"
#include "cli/command/standard_streams.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "projects/literals/duration.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/printed_line.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep::cli {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;  // [ns]

/// A level of an input from a time on.
struct InputChange {
  std::int64_t at = 0;  ///< [ms]
  std::size_t input = 0;
  bool level = false;
};

struct ProgramOptions {
  std::string file;
  std::int64_t duration = 10'000;  ///< [ms]
  std::int32_t steps_per_ms = 200;
  std::vector<InputChange> inputs;
  std::vector<std::pair<std::int32_t, std::int32_t>> parameters;
  aposs::CompilerSettings settings;
  std::string trace;  ///< CSV; empty: none
  bool plant = false, later_edition = true;
};

std::optional<std::int64_t> integer_of(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::int64_t milliseconds_of(const std::string& option, const std::string& text) {
  std::string problem;
  const auto value = parse_duration(text, problem);
  if (!value) throw CLI::ValidationError(option, problem);
  if (*value < 0 || *value % kMillisecond != 0)
    throw CLI::ValidationError(option, text + ": has to be whole milliseconds, as 500ms");
  return *value / kMillisecond;
}

/// "1=0.5s:1", "1=1" (from the beginning).
InputChange input_of(const std::string& text) {
  const std::string allowed = text + ": has to be INPUT=TIME:LEVEL, as 1=0.5s:1";
  const std::size_t equals = text.find('='), colon = text.find(':');
  if (equals == text.npos) throw CLI::ValidationError("--in", allowed);
  const auto input = integer_of(std::string_view(text).substr(0, equals));
  const std::string level = text.substr((colon == text.npos ? equals : colon) + 1);
  if (!input || *input < 1 || *input > static_cast<std::int64_t>(mco305::InputsOutputs::kInputs) ||
      (level != "0" && level != "1"))
    throw CLI::ValidationError("--in", allowed);
  InputChange change{0, static_cast<std::size_t>(*input), level == "1"};
  if (colon != text.npos) change.at = milliseconds_of("--in", text.substr(equals + 1, colon - equals - 1));
  return change;
}

/// "1900=20", "32-81=0.5", "VELMAX=3000", as printed.
std::pair<std::int32_t, std::int32_t> parameter_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto number = aposs::parameter_of(name);
  const std::string allowed =
      text + ": has to be PARAMETER=VALUE, the parameter by mnemonic or number, as 32-80=3000";
  if (!number || equals == text.npos || mco305::is_read_out(*number))
    throw CLI::ValidationError("--set", allowed);
  double value = 0.0;
  const char* const begin = text.data() + equals + 1;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (begin == end || error != std::errc() || rest != end) throw CLI::ValidationError("--set", allowed);
  double lowest = INT32_MIN, highest = INT32_MAX;
  if (!mco305::is_application_parameter(*number)) {
    const mco305::Parameter& of = mco305::parameters()[mco305::parameter_index(*number)];
    for (int i = 0; i < of.decimals; ++i) value *= 10.0;
    lowest = of.lowest;
    highest = of.highest;
  }
  const bool within = value >= lowest && value <= highest;  // false for a NaN
  if (!within || std::abs(value - std::round(value)) > 1e-6)
    throw CLI::ValidationError("--set", text + ": the value is outside of the range of the parameter");
  const auto whole = static_cast<std::int32_t>(std::lround(value));
  if (mco305::ParameterValues().set(*number, whole) != 0)
    throw CLI::ValidationError("--set", text + ": nothing can be computed with that value");
  return {*number, whole};
}

/// Gives out the lines that have been printed.
class Printer {
 public:
  explicit Printer(std::span<const std::string> texts) : texts_(texts) {}
  void take(aposs::PrintQueue& queue) {
    aposs::Printed item;
    while (queue.take(item))
      if (append_printed(line_, texts_, item)) {
        text_ += visible(line_) + "\n";
        line_.clear();
      }
    if (text_.size() > kEnough) give_out();
  }
  void give_out() {
    write_data(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t kEnough = 4096;
  std::span<const std::string> texts_;
  std::string line_, text_;
};

/// What the axis does, a row each millisecond.
class AxisTrace {
 public:
  /// @throws nothing: `failed` says it
  explicit AxisTrace(const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_.open(path, std::ios::binary);
    file_ << "t,CPOS,APOS,AVEL,TRACKERR,Reference,AXEND,ERRNO,Line\n";
  }
  void row(std::int64_t t, const Mco305Data& data) {
    if (path_.empty()) return;
    const Mco305ReadOuts& read = data.Read;
    file_ << fmt::format("{:.3f},{},{},{},{},{},{},{},{}\n", static_cast<double>(t) * 1e-3, read.CPOS,
                         read.APOS, read.AVEL, read.TRACKERR, read.Reference, read.AXEND, read.ERRNO,
                         data.Program.Line);
  }
  /// Whether all of it is in the file.
  bool end() {
    if (path_.empty()) return true;
    file_.close();
    return !file_.fail();
  }

 private:
  std::string path_;
  std::ofstream file_;
};

std::string text_of(int error) {
  const mco305::Error* const known = mco305::find_error(error);
  return "error " + std::to_string(error) + (known == nullptr ? "" : ": " + std::string(known->text));
}

/// How the program has come to its end.
int tell_end(const std::vector<std::string>& files, aposs::Machine& machine, const mco305::Device& device) {
  std::string outputs;
  for (std::size_t i = 1; i <= mco305::InputsOutputs::kOutputs; ++i)
    if (device.io().output(i)) outputs += (outputs.empty() ? "" : ", ") + std::to_string(i);
  if (!outputs.empty()) tell("outputs that are on: " + outputs);
  if (machine.prints().dropped_lines() != 0)
    tell("warning: " + std::to_string(machine.prints().dropped_lines()) +
             " printed lines did not fit and are lost",
         Severity::warning);
  if (machine.counters().divisions_by_zero != 0)
    tell("warning: " + std::to_string(machine.counters().divisions_by_zero) + " divisions by 0 gave 0",
         Severity::warning);
  const auto at = [&files](const aposs::Place& place, const std::string& text) {
    tell_line(aposs::to_string(files, {place, text}), Severity::error);
    return static_cast<int>(kNotValid);
  };
  if (machine.state() == aposs::ProgramState::kRefused)
    return at(
        machine.place(),
        std::string(row_of(*machine.refused()).name) +
            " is not built yet: cams, process data, parameters of the drive, analog values and recording are "
            "not");
  if (machine.state() == aposs::ProgramState::kError)
    return at(machine.error_place(), text_of(machine.error()) + "; without ON ERROR it ends the program");
  return kOk;
}

int run(const ProgramOptions& options) {
  int status = kOk;
  auto program = compile_or_tell(options.file, options.settings, status);
  if (!program) return status;
  Mco305 object("device", DB_ANY{1});
  for (const auto& [number, value] : options.parameters) object.parameters().set(number, value);
  object.programs.push_back({0, true, std::move(*program->image), program->files, 0});
  object.repeats = false;
  object.settings.has_drive = options.plant;
  object.settings.later_edition = options.later_edition;
  object.steps_per_millisecond = options.steps_per_ms;
  object.configure(1e-3, 1);
  if (const int error = object.programs[0].fault; error != 0) {
    tell(options.file + ": " + text_of(error), Severity::error);
    return kNotValid;
  }
  aposs::Machine& machine = object.machine();
  Printer printer(object.programs[0].image.texts);
  AxisTrace trace(options.trace);
  std::size_t next = 0;
  for (std::int64_t t = 0; t < options.duration && !machine.over(); ++t) {
    for (; next < options.inputs.size() && options.inputs[next].at <= t; ++next)
      object.device().io().set_input(options.inputs[next].input, options.inputs[next].level);
    object.servo(t * kMillisecond);
    object.run_program(t * kMillisecond);
    printer.take(machine.prints());
    trace.row(t, object.data);
  }
  machine.prints().flush();
  printer.take(machine.prints());
  printer.give_out();
  if (!trace.end()) {
    tell(options.trace + ": the trace cannot be written", Severity::error);
    return kCouldNotStart;
  }
  return tell_end(program->files, machine, object.device());
}

}  // namespace

void add_aposs_run(CLI::App& aposs, Action& action) {
  CLI::App* command =
      aposs.add_subcommand("run", "Run a program in virtual time, on an axis that is where it is told to be");
  auto options = std::make_shared<ProgramOptions>();
  auto duration = std::make_shared<std::string>("10s");
  auto inputs = std::make_shared<std::vector<std::string>>();
  auto parameters = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", options->file, "a program")->required();
  command->add_option("--duration", *duration, "how long at most (10s)");
  command->add_option("--in", *inputs, "INPUT=TIME:LEVEL, again and again: an input changes");
  command->add_option(
      "--set", *parameters,
      "PARAMETER=VALUE, again and again: at the start, as printed: 32-80=3000, RAMPMIN=0.5, 1900=20");
  command->add_option("--trace", options->trace,
                      "write position, velocity, reference, errors and line of each millisecond as CSV");
  command->add_flag(
      "--plant", options->plant,
      "with a simulated drive and its machine, in place of an axis that is where it is told to be");
  command->add_option("--steps-per-ms", options->steps_per_ms, "internal commands per millisecond (200)")
      ->check(CLI::Range(1, 100'000));
  add_compiler_options(*command, options->settings);
  command->footer(
      "What the program prints goes to standard output. Inputs are low and parameters at their start "
      "values unless told\n"
      "otherwise. A command that is not built yet ends the run with its place and exit status 1.");
  command->callback([&action, options, duration, inputs, parameters] {
    options->later_edition = options->settings.later_edition;
    options->duration = milliseconds_of("--duration", *duration);
    for (const std::string& text : *inputs) options->inputs.push_back(input_of(text));
    std::stable_sort(options->inputs.begin(), options->inputs.end(),
                     [](const InputChange& a, const InputChange& b) { return a.at < b.at; });
    for (const std::string& text : *parameters) options->parameters.push_back(parameter_of(text));
    action = [options] { return run(*options); };
  });
}

}  // namespace lockstep::cli
