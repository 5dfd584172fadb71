// lockstep run: puts the parts together, runs them and tells how it went.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/command/command.hpp"
#include "cli/command/redirect.hpp"
#include "cli/command/shortage.hpp"
#include "cli/run/ending.hpp"
#include "cli/run/run_command.hpp"
#include "cli/run/service_manager.hpp"
#include "cli/run/told.hpp"
#include "cli/run/transcript.hpp"
#include "hmi_bridge/network/thread_stacks.hpp"
#include "projects/json/problem.hpp"
#include "projects/runtime/kept_values.hpp"
#include "projects/runtime/run_surroundings.hpp"
#include "projects/runtime/runtime.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kRefresh = 100ms;                           // of the display
constexpr std::size_t kRunDescriptors = 40;                // beside those of Modbus clients
constexpr std::size_t kRunMemory = std::size_t{32} << 20;  // [byte] stacks, and what grows with the run
constexpr std::uint64_t kTicksBetweenLooks = 4096;         // of a simulation, at the clock and for signals

/// What a signal is to do is forgotten with what it is done to.
struct Forgetting {
  Ending& ending;
  ~Forgetting() { ending.finished(); }
};

/// Virtual time: as fast as the machine can; waits for the disk, never for the clock.
/// @return time of the first integer division by zero [ns]; negative: there is none
std::int64_t simulate(Project& project, RunSurroundings& surroundings, Display& display, Ending& ending,
                      std::int64_t duration) {
  Controller& controller = *project.controller;
  const auto begin = std::chrono::steady_clock::now();
  auto next_look = begin;
  const Forgetting at_the_end{ending};
  ending.run([&surroundings] { surroundings.wait_no_more(); });
  bool last = false;
  std::int64_t divided = -1;
  controller.employ_processors(static_cast<int>(std::thread::hardware_concurrency()));
  for (std::uint64_t tick = 0; !last && surroundings.wait_for_recorder(); ++tick) {
    last =
        (duration >= 0 && controller.now() + controller.clock.servo_cycle >= duration) || ending.requested();
    if (last) surroundings.take_no_more();
    controller.tick();
    if (divided < 0 && controller.counters().evaluation.integer_divisions_by_zero != 0)
      divided = controller.now() - controller.clock.servo_cycle;
    if (tick % kTicksBetweenLooks != 0) continue;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look) continue;
    display.show(controller.now(), "");
    next_look = now + kRefresh;
  }
  controller.take_summary();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  // From here on time is limited, and what is not finished in it is told.
  ending.limit([&surroundings] { return surroundings.unfinished(); });
  surroundings.end();
  ending.finished();
  display.close();
  const double simulated = static_cast<double>(controller.now()) * 1e-9;
  write_message(fmt::format("simulated {:.3f} s in {:.3f} s ({:.0f} × real time), {} ticks\n", simulated,
                            spent.count(), simulated / spent.count(), controller.counters().ticks));
  return divided;
}

/// What goes wrong with the clock, for the display; nothing as long as nothing does.
std::string trouble(const RealTimeStatus& status) {
  const std::uint64_t overruns = status.overruns.load();
  const std::uint64_t missed = status.missed_ticks.load();
  return overruns + missed == 0 ? "" : fmt::format("  overruns {}  missed ticks {}", overruns, missed);
}

/// What missed ticks may explain, so that nobody looks for it at the machine.
void tell_missed(const RealTimeStatus& status) {
  if (const std::uint64_t missed = status.missed_ticks.load(); missed > 0)
    tell(fmt::format(
        "warning: {} ticks were missed: motion stood still in them, while encoder signals, Modbus "
        "and timers went on; following errors and alarms within a second of missed ticks may come "
        "from that",
        missed));
}

/// Axes that could not be brought to rest in the time that there is for it.
void tell_moving(const Controller& controller) {
  for (const Axis* axis : controller.axes)
    if (!axis->off())
      tell("warning: " + axis->name +
           " was not at rest when the time for it was over; nothing brakes it now");
}

/// Waits for the end of a run, and shows meanwhile how it goes.
void wait_for_end(Runtime& machine, Display& display, ServiceManager& manager, Ending& ending) {
  const RealTimeStatus& status = machine.status();
  ending.run([&machine] { machine.stop(); });
  while (!machine.wait_for_rest(manager.interval(kRefresh))) {
    manager.look(status.ticks.load());
    if (ending.requested()) manager.stopping();
    display.show(status.time.load(), trouble(status));
  }
  manager.look(status.ticks.load());
  manager.stopping();
  // From here on time is limited, and what is not finished in it is told.
  ending.limit([&machine] { return machine.unfinished(); });
  while (!machine.wait()) continue;
  ending.finished();
  display.close();
}

/// How the run was, and its exit status.
int tell_end(const RealTimeStatus& status, const Controller& controller) {
  write_message(fmt::format(
      "ran {:.3f} s: {} ticks, {} overruns, {} missed ticks, worst lateness {:.1f} µs, longest tick "
      "{:.1f} µs\n",
      static_cast<double>(status.time.load()) * 1e-9, status.ticks.load(), status.overruns.load(),
      status.missed_ticks.load(), static_cast<double>(status.worst_lateness.load()) * 1e-3,
      static_cast<double>(status.longest_tick.load()) * 1e-3));
  tell_missed(status);
  tell_moving(controller);
  if (!status.stopped_by_overrun.load()) return kOk;
  tell("stopped: three interpolator cycles in a row were not over in time (clock.overrun is \"stop\")",
       Severity::error);
  return kStoppedByFault;
}

/// Connections that the Modbus of a project may have at once.
std::size_t clients_of(const Project& project) {
  std::size_t clients = project.modbus.clients.size();
  for (const ModbusServerOptions& server : project.modbus.servers)
    clients += server.listen.size() + static_cast<std::size_t>(server.max_clients);
  return clients;
}

/// Before the axes move: whether what a run may need can be had.
void require_means(const Project& project, bool modbus) {
  require_descriptors(kRunDescriptors + (modbus ? clients_of(project) : 0));
  require_memory(kRunMemory);
}

int run_simulated(Project project, std::unique_ptr<RetainWriter> keeper, const RunOptions& options,
                  const FailOn& fail_on, ToldOnStandardError& messages) {
  project.controller->apply_stimuli = true;
  require_means(project, !options.modbus.empty());
  Transcript transcript(options.transcript, project);
  Ending ending;
  RunSurroundings surroundings(project, options, std::move(keeper), messages);
  Display display(project, surroundings.signals(), options.duration);
  const std::int64_t divided = simulate(project, surroundings, display, ending, options.duration);
  messages.tell_rest();
  surroundings.tell_losses();
  tell_proxies(*project.controller);
  tell_axes(*project.controller, messages);
  tell_counters(*project.controller, "", divided);
  // In virtual time nothing is lost but by a disk, and the trace is what the run was for.
  const int status = transcript.write(project) && !surroundings.trace_is_incomplete() ? kOk : kCouldNotStart;
  return status_of(status, fail_on, messages, *project.controller);
}

/// Where another process wants the summary, by a descriptor; negative: nobody else does.
int summary_descriptor() {
  const char* const text = std::getenv(kSummaryVariable);
  if (text == nullptr) return -1;
  int descriptor = -1;
  const char* const end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, descriptor);
  const bool usable =
      error == std::errc{} && stop == end && descriptor > STDERR_FILENO && ::fcntl(descriptor, F_GETFD) >= 0;
  return usable ? descriptor : -1;
}

/// The threads of the run do the work; this one only looks and tells.
int run_in_real_time(Project project, std::unique_ptr<RetainWriter> keeper, const RunOptions& options,
                     const FailOn& fail_on, const std::shared_ptr<ToldOnStandardError>& messages) {
  std::unique_ptr<Display> display;  // of whose image the cycle knows: it goes after the cycle
  Runtime machine(std::move(project), std::move(keeper), options, messages);
  const int summary = summary_descriptor();
  machine.leave_processor();
  require_means(machine.project(), true);
  Transcript transcript(options.transcript, machine.project());
  Ending ending;
  machine.prepare();
  display =
      std::make_unique<Display>(machine.project(), machine.trace_signals(), options.duration, summary < 0);
  const Controller& controller = *machine.project().controller;
  ServiceManager manager(controller.clock.servo_cycle);
  const Forgetting at_the_end{ending};
  machine.start();
  wait_for_end(machine, *display, manager, ending);
  messages->tell_rest();
  if (summary >= 0) write_messages_to(summary);
  int status = tell_end(machine.status(), controller);
  if (!transcript.write(machine.project()) && status == kOk) status = kCouldNotStart;
  tell_proxies(controller);
  tell_axes(controller, *messages);
  tell_counters(controller);
  return status_of(status, fail_on, *messages, controller);
}

/// @param path of the system file  @param status the exit status if there is no system
std::optional<System> load_controller_or_tell(const std::string& path, const std::string& controller,
                                              int& status, const PrepareController& prepare) {
  LoadedSystem loaded = load_controller_of(path, controller, prepare);
  for (const Problem& problem : loaded.problems) tell_line(to_string(path, problem), Severity::error);
  status = kNotValid;
  if (!loaded.system) return std::nullopt;
  if (!loaded.system->find(controller)) {
    std::vector<std::string_view> names;
    for (const SystemController& one : loaded.system->controllers) names.push_back(one.name);
    throw CouldNotStart("--controller: there is no controller " + quote(controller) +
                        did_you_mean(controller, names) + "; allowed: " + list_of(names));
  }
  // Told once, where several processes of a system are started at a time.
  if (std::getenv(kSummaryVariable) == nullptr)
    for (Problem& warning : loaded.warnings) {
      warning.text = "warning: " + warning.text;
      tell_line(to_string(path, warning), Severity::warning);
    }
  return std::move(loaded.system);
}

int start_controller(const RunOptions& options, const std::string& controller, FailOn fail_on) {
  const auto messages = std::make_shared<ToldOnStandardError>(0, controller);
  std::unique_ptr<RetainWriter> keeper;
  int status = kOk;
  std::optional<System> system = load_controller_or_tell(options.file, controller, status,
                                                         [&](Project& project, const SystemController& one) {
                                                           RunOptions its = options;
                                                           its.file = one.file;
                                                           keeper = restore_kept(project, its, *messages);
                                                         });
  if (!system) return status;
  const std::size_t index = *system->find(controller);
  return run_in_real_time(std::move(system->controllers[index].project), std::move(keeper),
                          options_of(*system, index, options), fail_on, messages);
}

}  // namespace

int run_controller(const RunOptions& options, const std::string& controller, FailOn fail_on) {
  keep_stacks_small();
  try {
    if (options.simulate)
      throw CouldNotStart("--controller: in virtual time all controllers of a system run; leave it out");
    if (!is_system_file(options.file))
      throw CouldNotStart("--controller: " + options.file + " is no system file");
    return start_controller(options, controller, fail_on);
  } catch (const UnreadableFile& error) {
    tell(with_help(error.what()), Severity::error);
  } catch (const CouldNotStart& error) {
    tell(with_help(error.what()), Severity::error);
  } catch (const RetainFileError& error) {
    tell(with_help(error.what()), Severity::error);
  }
  return kCouldNotStart;
}

int run_project(const RunOptions& options, FailOn fail_on) {
  keep_stacks_small();
  const auto messages = std::make_shared<ToldOnStandardError>(options.simulate ? 500 : 0);
  try {
    std::unique_ptr<RetainWriter> keeper;
    int status = kOk;
    std::optional<Project> project = load_or_tell(
        options.file, status, [&](Project& loaded) { keeper = restore_kept(loaded, options, *messages); });
    if (!project) return status;
    return options.simulate
               ? run_simulated(std::move(*project), std::move(keeper), options, fail_on, *messages)
               : run_in_real_time(std::move(*project), std::move(keeper), options, fail_on, messages);
  } catch (const CouldNotStart& error) {
    tell(with_help(error.what()), Severity::error);
  } catch (const RetainFileError& error) {
    tell(with_help(error.what()), Severity::error);
    tell(
        "--retain FILE keeps values in another file; --no-retain begins with their init values and keeps "
        "nothing");
  }
  return kCouldNotStart;
}

}  // namespace lockstep::cli
