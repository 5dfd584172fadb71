// What the cycle and its parts cost: ./dev bench [--help]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/machine.hpp"
#include "bench/measure.hpp"
#include "bench/parts.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] = R"(lockstep_bench [OPTIONS]: what the cycle and its parts cost

  --full           every combination of motion, axes, drives, ratio and traced signals
  --filter TEXT    only rows whose name contains TEXT
  --runs N         the best of N runs counts (5)
  --instructions   instructions alone, counted by callgrind (valgrind)
  --time           time alone
  --lines          one line "nanoseconds<TAB>name" per row, for comparisons
  --processors N   that a tick uses: p50 is what tells then, since the mean is of the thread of the cycle alone
  --axes N         machines of N axes instead of those of the table
  --quick          a look at everything, to see that it works

The machines are projects, loaded as `lockstep run` loads them, with a servo cycle of 1 ms and every block
called in every interpolator cycle. All figures are per axis and interpolator cycle, times in nanoseconds:

  mean       processor time over at least 1,000 cycles between two readings
  instr.     instructions, in a run under callgrind before; "-" where valgrind is not installed
  p50, p99   by the clock: of single cycles from 32 axes on; with fewer axes of 32 / axes cycles in a row,
             since reading the clock would count for too much. Cycles in which the system gave the processor
             to another thread are left out
  load       share of its period that an interpolator cycle (with its servo ticks) takes
  x real     how much faster than real time the machine runs in virtual time

Each figure is the least of the runs: a machine that is shared only ever adds.
The work of the leading axis of a gear is measured as well, but it is not counted as an axis.
)";

struct Options {
  bool full = false;
  bool quick = false;
  bool instructions = false;
  bool time = false;
  bool lines = false;
  int runs = 5;
  int processors = 1;
  int axes = 0;  // 0: those of the table
  std::string filter;
};

/// Reads the command line; false if it is wrong.
bool read(char** arguments, Options& options) {
  for (char** argument = arguments + 1; *argument != nullptr; ++argument) {
    const std::string_view name = *argument;
    const bool has_value =
        name == "--filter" || name == "--runs" || name == "--processors" || name == "--axes";
    if (has_value && *++argument == nullptr) return false;
    if (name == "--full") {
      options.full = true;
    } else if (name == "--quick") {
      options.quick = true;
      options.runs = 1;
    } else if (name == "--instructions") {
      options.instructions = true;
    } else if (name == "--time") {
      options.time = true;
    } else if (name == "--lines") {
      options.lines = true;
    } else if (name == "--runs") {
      options.runs = std::max(1, std::atoi(*argument));
    } else if (name == "--processors") {
      options.processors = std::clamp(std::atoi(*argument), 1, Clock::kMaximumProcessors);
    } else if (name == "--axes") {
      options.axes = std::max(1, std::atoi(*argument));
    } else if (name == "--filter") {
      options.filter = *argument;
    } else {
      return false;
    }
  }
  return true;
}

/// The rows of the table. Ratio and traced signals are varied at one size, unless all combinations are asked
/// for.
std::vector<MachinePlan> plans(const Options& options) {
  const std::vector<int> sizes = options.axes > 0 ? std::vector{options.axes}
                                 : options.quick  ? std::vector{1, 8}
                                                  : std::vector{1, 8, 32, 128, 1000};
  const int varied = options.quick ? 8 : 128;
  const int cam_points = options.quick ? 100 : 10'000;
  std::vector<MachinePlan> result;
  for (const Motion motion : {Motion::gear, Motion::shifted, Motion::cam, Motion::positioning, Motion::idle})
    for (const bool drives : {false, true})
      for (const int axes : sizes)
        for (const int ratio : {1, 4})
          for (const int signals : {0, 8, 100}) {
            const bool plain = ratio == 1 && signals == 0;
            const bool one_varied = axes == varied && (ratio == 1 || signals == 0);
            if (options.full || plain || one_varied)
              result.push_back({motion, axes, drives, ratio, signals, options.processors, cam_points});
          }
  return result;
}

/// Prints the rows of both tables as they are measured.
class Report {
 public:
  /// @param instructions of each row, next to its time
  Report(const Options& options, std::map<std::string, double> instructions)
      : options_(options), instructions_(std::move(instructions)) {}

  void machines() {
    std::vector<MachinePlan> rows = plans(options_);
    std::erase_if(rows, [this](const MachinePlan& plan) { return !wanted(plan.name()); });
    if (rows.empty()) return;
    if (!options_.lines)
      std::printf("%-12s %5s %-8s %5s %7s %8s %8s %8s %8s %8s %9s\n", "motion", "axes", "drive", "ratio",
                  "signals", "instr.", "mean", "p50", "p99", "load", "x real");
    for (const MachinePlan& plan : rows) machine(plan);
  }

  void single_parts() {
    std::vector<Part> rows = parts(options_.quick);
    for (Part& row : telegram_parts()) rows.push_back(std::move(row));
    std::erase_if(rows, [this](const Part& part) { return !wanted(part.name); });
    if (!rows.empty() && !options_.lines) std::printf("\n%-75s %10s %10s\n", "part", "instr.", "[ns]");
    for (Part& part : rows) this->part(part);
  }

 private:
  bool wanted(const std::string& name) const { return name.find(options_.filter) != name.npos; }

  void machine(const MachinePlan& plan) const {
    Machine machine(plan);
    if (options_.instructions) return count(machine);
    const Effort effort{.runs = options_.runs,
                        .calls = options_.quick ? 1000 : std::max(1000, 200'000 / plan.axes),
                        .burst = std::max(1, 32 / plan.axes),
                        .bursts = options_.quick ? 100 : 2000};
    const Timing timing = measure([&](int cycles) { machine.run(cycles); }, effort);
    const double axes = plan.axes;
    if (options_.lines) return line(plan.name(), timing.mean / axes);
    const double period = 1e6 * plan.ratio;
    head(plan);
    std::printf(" %8s %8.1f %8.1f %8.1f %7.3f%% %9.0f\n", instructions_text(plan.name()).c_str(),
                timing.mean / axes, timing.median / axes, timing.p99 / axes, 100.0 * timing.mean / period,
                period / timing.mean);
    std::fflush(stdout);
  }

  void count(Machine& machine) const {
    const int cycles = options_.quick ? 20 : 1000;  // the latter is more than a positioning takes
    const MachinePlan& plan = machine.plan();
    const auto instructions = static_cast<double>(count_instructions([&] { machine.run(cycles); }));
    const double per_axis = instructions / cycles / plan.axes;
    if (options_.lines) return line(plan.name(), per_axis);
    head(plan);
    std::printf(" %8.1f\n", per_axis);
    std::fflush(stdout);
  }

  void part(Part& part) const {
    const int calls = options_.quick ? std::min(part.calls, 10) : part.calls;
    double figure = 0.0;
    if (options_.instructions) {
      figure = static_cast<double>(count_instructions([&] { part.work(calls); })) / calls;
    } else {
      part.work(calls);
      figure = measure(part.work, {.runs = options_.runs, .calls = calls, .burst = 1, .bursts = 0}).mean;
    }
    if (options_.lines) return line(part.name, figure);
    if (options_.instructions)
      std::printf("%-75s %10.1f\n", part.name.c_str(), figure);
    else
      std::printf("%-75s %10s %10.1f\n", part.name.c_str(), instructions_text(part.name).c_str(), figure);
    std::fflush(stdout);
  }

  std::string instructions_text(const std::string& name) const {
    const auto row = instructions_.find(name);
    if (row == instructions_.end()) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", row->second);
    return text;
  }

  static void head(const MachinePlan& plan) {
    std::printf("%-12s %5d %-8s %5d %7d", std::string(name_of(plan.motion)).c_str(), plan.axes,
                plan.drives ? "drives" : "virtual", plan.ratio, plan.signals);
  }

  static void line(const std::string& name, double figure) {
    std::printf("%.2f\t%s\n", figure, name.c_str());
    std::fflush(stdout);
  }

  const Options& options_;
  std::map<std::string, double> instructions_;
};

int run(char** arguments) {
  Options options;
  if (!read(arguments, options)) {
    const bool help = std::strcmp(arguments[1], "--help") == 0;
    std::fputs(kHelp, help ? stdout : stderr);
    return help ? 0 : 2;
  }
  if (options.instructions && !counting_instructions()) {
    restart_under_callgrind(arguments);
    return 2;
  }
  std::map<std::string, double> instructions;
  if (!options.time && !options.lines && !options.instructions) {
    std::fputs("counting instructions first; --time leaves that out\n", stderr);
    instructions = instructions_of_rows(arguments);
  }
  Report report(options, std::move(instructions));
  report.machines();
  report.single_parts();
  return 0;
}

}  // namespace
}  // namespace lockstep::bench

int main(int /*count*/, char** arguments) {
  try {
    return lockstep::bench::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lockstep_bench: %s\n", error.what());
    return 1;
  }
}
