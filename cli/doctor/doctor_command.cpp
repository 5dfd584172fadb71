// lockstep doctor: measures how late this machine wakes the cycle of a run, and says what that is good for.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/doctor/lateness.hpp"
#include "cli/doctor/report.hpp"
#include "hmi_bridge/network/thread_stacks.hpp"
#include "projects/literals/duration.hpp"
#include "scheduler/processor.hpp"
#include "scheduler/real_time_rights.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kProgressRefresh = 200ms;                   // of the progress
constexpr std::int64_t kLongestCycle = 60'000'000'000;     // [ns], as in a project
constexpr std::int64_t kLongest = 7 * 86'400'000'000'000;  // [ns] of measuring

struct DoctorOptions {
  std::string file{};                      ///< of a project; empty: none
  std::int64_t servo_cycle = 1'000'000;    ///< [ns]
  std::int64_t duration = 10'000'000'000;  ///< [ns]
  int cpu = -1;
  bool json = false;
};

/// How far the measurement is, on a terminal.
void show_progress(const DoctorOptions& options, const Lateness& lateness) {
  const double waited = static_cast<double>(lateness.count()) * static_cast<double>(options.servo_cycle);
  write_message(fmt::format("\r\033[Kmeasuring: {:.0f} of {:.0f} s, worst {}", waited * 1e-9,
                            static_cast<double>(options.duration) * 1e-9, time_text(lateness.worst())),
                0);
}

/// Waits for the end of the measurement, and shows on a terminal how far it is.
void wait_for(const std::atomic<bool>& over, const DoctorOptions& options, const Lateness& lateness) {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  while (!over.load(std::memory_order_acquire)) {
    if (terminal) show_progress(options, lateness);
    for (auto waited = 0ms; waited < kProgressRefresh && !over.load(std::memory_order_acquire);
         waited += 10ms)
      std::this_thread::sleep_for(10ms);
  }
  if (terminal) write_message("\r\033[K", 0);
}

/// Measures as a run would: with its priority, its memory locked, on its processor.
Findings examine(const DoctorOptions& options) {
  Findings findings;
  findings.servo_cycle = options.servo_cycle;
  findings.duration = options.duration;
  findings.processor = options.cpu;
  findings.facts = read_system_facts();
  Lateness lateness;
  std::atomic<bool> begins{false}, over{false};
  std::thread thread([&] {
    while (!begins.load(std::memory_order_acquire)) std::this_thread::sleep_for(1ms);
    measure(monotonic_clock(), options.servo_cycle, options.duration, lateness);
    over.store(true, std::memory_order_release);
  });
  if (options.cpu >= 0 && keep_on_processor(thread.native_handle(), options.cpu) != 0)
    findings.processor = -1;
  findings.rights.memory = lock_memory() == 0;
  findings.rights.priority = give_priority(thread.native_handle(), kCyclePriority) == 0;
  begins.store(true, std::memory_order_release);
  wait_for(over, options, lateness);
  thread.join();
  findings.wakeups = lateness.count();
  findings.median = lateness.quantile(0.5);
  findings.one_percent = lateness.quantile(0.99);
  findings.rarest = lateness.quantile(0.9999);
  findings.worst = lateness.worst();
  findings.verdict = judge(findings.worst, findings.servo_cycle, findings.rights);
  findings.advice = advise(findings.facts, findings.rights, findings.processor);
  return findings;
}

int run_doctor(DoctorOptions options) {
  keep_stacks_small();
  if (!options.file.empty()) {
    int status = kOk;
    const auto project = load_or_tell(options.file, status, {}, Warnings::kept, LoadedFor::looking);
    if (!project) return kCouldNotStart;
    options.servo_cycle = project->controller->clock.servo_cycle;
  }
  if (options.cpu >= 0)
    if (const std::string problem = leave_processor(options.cpu); !problem.empty()) {
      tell("--cpu: " + problem, Severity::error);
      return kCouldNotStart;
    }
  const Findings findings = examine(options);
  write_data(options.json ? report_json(findings) : report_text(findings));
  return findings.verdict.holds ? kOk : kNotValid;
}

/// A duration of the command line. @throws CLI::ValidationError
std::int64_t duration_of(const std::string& option, const std::string& text, std::int64_t longest) {
  std::string problem;
  const auto value = parse_duration(text, problem);
  if (!value) throw CLI::ValidationError(option, problem);
  if (*value <= 0 || *value > longest)
    throw CLI::ValidationError(
        option, fmt::format("{}: has to be more than nothing and at most {}", text, time_text(longest)));
  return *value;
}

}  // namespace

void add_doctor_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Measure which servo_cycle this machine can hold, and say what would help");
  auto options = std::make_shared<DoctorOptions>();
  auto duration = std::make_shared<std::string>();
  auto cycle = std::make_shared<std::string>();
  auto* file = command->add_option("FILE", options->file, "a project file, whose servo_cycle is looked at");
  command->add_option("--servo-cycle", *cycle, "the servo_cycle to look at, such as 250us; 1ms if not given")
      ->excludes(file);
  command->add_option("--duration", *duration, "measure for so long, such as 10min; 10s if not given");
  command->add_option("--cpu", options->cpu, "measure on this processor, from 0, as lockstep run --cpu does")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", options->json, "the report as JSON, for programs");
  command->footer(
      "It waits for each tick of that servo_cycle as a run does, with its priority and locked memory, and "
      "does\n"
      "nothing in it. A servo_cycle is held if three times the worst lateness fit into it and real-time "
      "priority\n"
      "is permitted. Measure while the machine does what it will do beside Lockstep, and longer where much\n"
      "depends on it: what happens once an hour is not seen in ten seconds.\n"
      "Exit status: 0 the servo_cycle is held, 1 it is not, 2 it could not be measured");
  command->callback([&action, options, duration, cycle] {
    if (!duration->empty()) options->duration = duration_of("--duration", *duration, kLongest);
    if (!cycle->empty()) options->servo_cycle = duration_of("--servo-cycle", *cycle, kLongestCycle);
    action = [options] { return run_doctor(*options); };
  });
}

}  // namespace lockstep::cli
