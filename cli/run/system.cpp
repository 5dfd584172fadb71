// lockstep run of a system file in virtual time: all controllers in this process.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"
#include "cli/run/ending.hpp"
#include "cli/run/run_command.hpp"
#include "cli/run/told.hpp"
#include "hmi_bridge/network/thread_stacks.hpp"
#include "projects/runtime/run_surroundings.hpp"
#include "projects/system/simulated_system.hpp"

namespace lockstep::cli {
namespace {

constexpr std::uint64_t kTicksBetweenSignals = 4096;                    // at signals
constexpr std::size_t kDescriptorsOfController = 8;                     // its trace, its recorder
constexpr std::size_t kMemoryOfController = std::size_t{2} << 20;       // [byte] stacks, events
constexpr std::size_t kDescriptorsOfRun = 40, kMemoryOfRun = 32 << 20;  // what a run has anyway

/// What is around the cycle of one of the controllers.
struct ControllerRun {
  RunOptions options;
  std::unique_ptr<ToldOnStandardError> messages;
  std::unique_ptr<RunSurroundings> surroundings;
};

/// "t.PLC_1.csv" for "t.csv".
std::string trace_of(const std::string& trace, const std::string& controller) {
  const std::filesystem::path path(trace);
  const std::string name = path.stem().string() + "." + controller + path.extension().string();
  return (path.parent_path() / name).string();
}

/// What the command line asks for that only a project alone can give.
void refuse_what_no_system_has(const RunOptions& options) {
  const std::pair<bool, const char*> refused[] = {{!options.modbus.empty(), "--modbus"},
                                                  {!options.lcm.empty(), "--lcm"},
                                                  {!options.audit.empty(), "--audit"},
                                                  {!options.retain.empty(), "--retain"},
                                                  {options.cpu >= 0, "--cpu"},
                                                  {!options.studio.empty(), "--studio"},
                                                  {!options.transcript.empty(), "--transcript"}};
  for (const auto& [given, name] : refused)
    if (given)
      throw CouldNotStart(
          std::string(name) +
          " is for one project, or one controller of a system (--controller); allowed with a "
          "system: --simulate, --duration, --trace, --signals, --stimuli, --fail-on, --no-modbus, "
          "--no-lcm, --no-retain");
}

/// The options of each controller.
std::vector<ControllerRun> divided(const System& system, const RunOptions& options) {
  std::vector<ControllerRun> runs(system.controllers.size());
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].options = options_of(system, i, options);
  return runs;
}

void start(System& system, std::vector<ControllerRun>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    SystemController& controller = system.controllers[i];
    runs[i].messages = std::make_unique<ToldOnStandardError>(500, controller.name);
    runs[i].surroundings =
        std::make_unique<RunSurroundings>(controller.project, runs[i].options, nullptr, *runs[i].messages);
  }
}

std::vector<std::string> unfinished(const System& system, const std::vector<ControllerRun>& runs) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const std::string& text : runs[i].surroundings->unfinished())
      all.push_back(system.controllers[i].name + ": " + text);
  return all;
}

/// As fast as the machine can; waits for the disk, never for the clock.
void simulate(SimulatedSystem& machine, const std::vector<ControllerRun>& runs, Ending& ending,
              std::int64_t duration) {
  const auto begin = std::chrono::steady_clock::now();
  ending.run([&runs] {
    for (const ControllerRun& run : runs) run.surroundings->wait_no_more();
  });
  std::uint64_t ticks = 0;
  std::int64_t end = 0;
  bool goes_on = true;
  while (goes_on && (duration < 0 || machine.now() < duration)) {
    end = machine.now();
    goes_on = runs[machine.next()].surroundings->wait_for_recorder();
    if (!goes_on) break;
    machine.step();
    if (++ticks % kTicksBetweenSignals == 0) goes_on = !ending.requested();
  }
  for (const SystemController& controller : machine.system().controllers)
    controller.project.controller->take_summary();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  // From here on time is limited, and what is not finished in it is told.
  ending.limit([&] { return unfinished(machine.system(), runs); });
  for (const ControllerRun& run : runs) run.surroundings->end();
  ending.finished();
  const double simulated = static_cast<double>(duration < 0 ? end : duration) * 1e-9;
  write_message(
      fmt::format("simulated {:.3f} s of {} controllers in {:.3f} s ({:.0f} × real time), {} ticks\n",
                  simulated, runs.size(), spent.count(), simulated / spent.count(), ticks));
}

int tell_ends(const System& system, const std::vector<ControllerRun>& runs, const FailOn& fail_on) {
  int status = kOk;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SystemController& one = system.controllers[i];
    const Controller& controller = *one.project.controller;
    runs[i].messages->tell_rest();
    runs[i].surroundings->tell_losses();
    write_message(one.name + "\n");
    tell_proxies(controller);
    tell_axes(controller, *runs[i].messages);
    tell_counters(controller, one.name + ": ");
    const int written = runs[i].surroundings->trace_is_incomplete() ? kCouldNotStart : kOk;
    if (const int its = status_of(written, fail_on, *runs[i].messages, controller); its != kOk) status = its;
  }
  return status;
}

int simulate_system(const RunOptions& options, const FailOn& fail_on) {
  int status = kOk;
  std::optional<System> loaded = load_system_or_tell(options.file, status);
  if (!loaded) return status;
  require_descriptors(kDescriptorsOfRun + kDescriptorsOfController * loaded->controllers.size());
  require_memory(kMemoryOfRun + kMemoryOfController * loaded->controllers.size());
  Ending ending;
  SimulatedSystem machine(std::move(*loaded));
  std::vector<ControllerRun> runs = divided(machine.system(), options);
  start(machine.system(), runs);
  struct Forgetting {
    Ending& ending;
    ~Forgetting() { ending.finished(); }
  } const at_the_end{ending};
  simulate(machine, runs, ending, options.duration);
  return tell_ends(machine.system(), runs, fail_on);
}

}  // namespace

RunOptions options_of(const System& system, std::size_t controller, const RunOptions& options) {
  const SystemController& one = system.controllers[controller];
  RunOptions its = options;
  its.file = one.file;
  its.signals.clear();
  for (const std::string& signal : options.signals) {
    const std::size_t dot = signal.find('.');
    const auto index = system.find(std::string_view(signal).substr(0, dot));
    if (!index || dot == signal.npos)
      throw CouldNotStart("--signals: " + quote(signal) +
                          " begins with no controller of the system; allowed: CONTROLLER.PATH");
    if (*index == controller) its.signals.push_back(signal.substr(dot + 1));
  }
  if (!options.trace.empty()) its.trace = trace_of(options.trace, one.name);
  // Where signals are named, a controller of which none is has no trace.
  if (!options.signals.empty() && its.signals.empty()) its.trace.clear();
  return its;
}

int run_system(const RunOptions& options, FailOn fail_on) {
  keep_stacks_small();
  try {
    refuse_what_no_system_has(options);
    return options.simulate ? simulate_system(options, fail_on) : run_processes(options, fail_on);
  } catch (const CouldNotStart& error) {
    tell(with_help(error.what()), Severity::error);
  }
  return kCouldNotStart;
}

}  // namespace lockstep::cli
