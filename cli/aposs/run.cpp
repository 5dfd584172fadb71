// lockstep aposs run: a program in virtual time, against a device without a machine.
#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>

#include "cli/aposs/aposs_command.hpp"
#include "cli/command/standard_streams.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/aposs/error_texts.hpp"
#include "projects/aposs/listing.hpp"
#include "projects/literals/duration.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/plain_device.hpp"

namespace lockstep::cli {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;  // [ns]

/// A level of an input from a time on.
struct InputChange {
  std::int64_t at = 0;  ///< [ms]
  std::size_t input = 0;
  bool level = false;
};

struct RunOptions {
  std::string file;
  std::int64_t duration = 10'000;  ///< [ms]
  std::int32_t steps_per_ms = 200;
  std::vector<InputChange> inputs;
  std::vector<std::pair<std::int32_t, std::int32_t>> parameters;
  aposs::CompilerSettings settings;
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
  if (!input || *input < 1 || *input > static_cast<std::int64_t>(aposs::PlainDevice::kInputs) ||
      (level != "0" && level != "1"))
    throw CLI::ValidationError("--in", allowed);
  InputChange change{0, static_cast<std::size_t>(*input), level == "1"};
  if (colon != text.npos) change.at = milliseconds_of("--in", text.substr(equals + 1, colon - equals - 1));
  return change;
}

/// "1900=20".
std::pair<std::int32_t, std::int32_t> parameter_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto number = integer_of(std::string_view(text).substr(0, equals));
  const auto value =
      equals == text.npos ? std::nullopt : integer_of(std::string_view(text).substr(equals + 1));
  const bool fits = value && *value >= INT32_MIN && *value <= INT32_MAX;
  if (!number || *number < aposs::PlainDevice::kFirstParameter ||
      *number > aposs::PlainDevice::kLastParameter || !fits)
    throw CLI::ValidationError("--set",
                               text + ": has to be PARAMETER=VALUE with a parameter from 1900 to 1999");
  return {static_cast<std::int32_t>(*number), static_cast<std::int32_t>(*value)};
}

/// Gives out the lines that have been printed.
class Printer {
 public:
  explicit Printer(const aposs::Image& image) : image_(image) {}
  void take(aposs::PrintQueue& queue) {
    aposs::Printed item;
    while (queue.take(item))
      if (append_printed(line_, image_, item)) {
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
  const aposs::Image& image_;
  std::string line_, text_;
};

std::string text_of(int error) {
  const std::string_view meaning = aposs::error_text(error);
  return "error " + std::to_string(error) + (meaning.empty() ? "" : ": " + std::string(meaning));
}

/// How the program has come to its end.
int tell_end(const aposs::CompiledProgram& program, aposs::Machine& machine,
             const aposs::PlainDevice& device) {
  std::string outputs;
  for (std::size_t i = 1; i <= aposs::PlainDevice::kOutputs; ++i)
    if (device.output(i)) outputs += (outputs.empty() ? "" : ", ") + std::to_string(i);
  if (!outputs.empty()) tell("outputs that are on: " + outputs);
  if (machine.prints().dropped_lines() != 0)
    tell("warning: " + std::to_string(machine.prints().dropped_lines()) +
             " printed lines did not fit and are lost",
         Severity::warning);
  if (machine.counters().divisions_by_zero != 0)
    tell("warning: " + std::to_string(machine.counters().divisions_by_zero) + " divisions by 0 gave 0",
         Severity::warning);
  const auto at = [&program](const aposs::Place& place, const std::string& text) {
    tell_line(aposs::to_string(program.files, {place, text}), Severity::error);
    return static_cast<int>(kNotValid);
  };
  if (machine.state() == aposs::ProgramState::kRefused)
    return at(machine.place(),
              std::string(row_of(*machine.refused()).name) +
                  " needs a machine, and that is not built yet; what runs: the language, PRINT, "
                  "time, inputs, outputs, parameters 1900 to 1999");
  if (machine.state() == aposs::ProgramState::kError)
    return at(machine.error_place(), text_of(machine.error()) + "; without ON ERROR it ends the program");
  return kOk;
}

int run(const RunOptions& options) {
  int status = kOk;
  const auto program = compile_or_tell(options.file, options.settings, status);
  if (!program) return status;
  aposs::PlainDevice device;
  aposs::Arrays arrays;
  aposs::Machine machine(device, arrays);
  for (const auto& [number, value] : options.parameters) device.set_parameter(number, value);
  if (const int error = machine.load(*program->image); error != 0) {
    tell(options.file + ": " + text_of(error), Severity::error);
    return kNotValid;
  }
  Printer printer(*program->image);
  std::size_t next = 0;
  for (std::int64_t t = 0; t < options.duration && !machine.over(); ++t) {
    for (; next < options.inputs.size() && options.inputs[next].at <= t; ++next)
      device.set_input(options.inputs[next].input, options.inputs[next].level);
    machine.step(options.steps_per_ms);
    printer.take(machine.prints());
    device.advance(1);
  }
  machine.prints().flush();
  printer.take(machine.prints());
  printer.give_out();
  return tell_end(*program, machine, device);
}

}  // namespace

void add_aposs_run(CLI::App& aposs, Action& action) {
  CLI::App* command = aposs.add_subcommand("run", "Run a program in virtual time, without a machine");
  auto options = std::make_shared<RunOptions>();
  auto duration = std::make_shared<std::string>("10s");
  auto inputs = std::make_shared<std::vector<std::string>>();
  auto parameters = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", options->file, "a program")->required();
  command->add_option("--duration", *duration, "how long at most (10s)");
  command->add_option("--in", *inputs, "INPUT=TIME:LEVEL, again and again: an input changes");
  command->add_option("--set", *parameters, "PARAMETER=VALUE, again and again: 1900 to 1999 at the start");
  command->add_option("--steps-per-ms", options->steps_per_ms, "internal commands per millisecond (200)")
      ->check(CLI::Range(1, 100'000));
  add_compiler_options(*command, options->settings);
  command->footer(
      "What the program prints goes to standard output. Inputs are low and parameters 0 unless told "
      "otherwise. A\n"
      "command that needs a machine ends the run with its place and exit status 1.");
  command->callback([&action, options, duration, inputs, parameters] {
    options->duration = milliseconds_of("--duration", *duration);
    for (const std::string& text : *inputs) options->inputs.push_back(input_of(text));
    std::stable_sort(options->inputs.begin(), options->inputs.end(),
                     [](const InputChange& a, const InputChange& b) { return a.at < b.at; });
    for (const std::string& text : *parameters) options->parameters.push_back(parameter_of(text));
    action = [options] { return run(*options); };
  });
}

}  // namespace lockstep::cli
