#include "bench/measure.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_TOGGLE_COLLECT
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS
#endif

namespace lockstep::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Time for which this thread has had a processor [ns].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// How often this thread has been taken from its processor.
long switches() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw + usage.ru_nvcsw;
}

/// Bursts of calls, each per call [ns]; those that another thread has interrupted are left out.
std::vector<double> sample(const std::function<void(int)>& work, const Effort& effort) {
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(effort.bursts));
  for (int i = 0; i < effort.bursts; ++i) {
    const long before = switches();
    const auto begin = Clock::now();
    work(effort.burst);
    const std::chrono::duration<double, std::nano> time = Clock::now() - begin;
    if (switches() == before) samples.push_back(time.count() / effort.burst);
  }
  return samples;
}

double quantile(std::vector<double>& samples, double share) {
  const auto place =
      samples.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), place, samples.end());
  return *place;
}

/// Where callgrind puts its counts: a file per dump, numbered from 1.
std::string dump_prefix() {
  return (std::filesystem::temp_directory_path() / ("lockstep_bench." + std::to_string(getpid()))).string();
}

std::uint64_t total_of(const std::string& dump) {
  std::ifstream file(dump);
  std::uint64_t total = 0;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("totals: ")) total = std::stoull(line.substr(8));
  return total;
}

/// Returns only if it fails.
void execute_under_callgrind(char** arguments, const std::vector<const char*>& more) {
  const std::string out = "--callgrind-out-file=" + dump_prefix();  // the process keeps its number
  // Under valgrind /proc/self/exe is this program as well, so it has to be named before.
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<const char*> command = {"valgrind", "--tool=callgrind", "--collect-atstart=no",
                                      "-q",       out.c_str(),        self.c_str()};
  for (char** argument = arguments + 1; *argument != nullptr; ++argument) command.push_back(*argument);
  command.insert(command.end(), more.begin(), more.end());
  command.push_back(nullptr);
  execvp(command.front(), const_cast<char* const*>(command.data()));
}

}  // namespace

Timing measure(const std::function<void(int)>& work, const Effort& effort) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Timing best{kNever, kNever, kNever};
  for (int run = 0; run < effort.runs; ++run) {
    const double begin = processor_time();
    work(effort.calls);
    best.mean = std::min(best.mean, (processor_time() - begin) / effort.calls);
    std::vector<double> samples = sample(work, effort);
    if (samples.empty()) continue;
    best.median = std::min(best.median, quantile(samples, 0.5));
    best.p99 = std::min(best.p99, quantile(samples, 0.99));
  }
  return best;
}

bool counting_instructions() {
  return RUNNING_ON_VALGRIND != 0;
}

std::uint64_t count_instructions(const std::function<void()>& work) {
  return count_instructions(
      1, [] {}, work);
}

std::uint64_t count_instructions(int times, const std::function<void()>& before,
                                 const std::function<void()>& work) {
  if (!counting_instructions()) return 0;
  static int dumps = 0;
  CALLGRIND_ZERO_STATS;
  for (int i = 0; i < times; ++i) {
    before();
    CALLGRIND_TOGGLE_COLLECT;
    work();
    CALLGRIND_TOGGLE_COLLECT;
  }
  CALLGRIND_DUMP_STATS;
  const std::string dump = dump_prefix() + "." + std::to_string(++dumps);
  const std::uint64_t total = total_of(dump);
  std::filesystem::remove(dump);
  return total;
}

void restart_under_callgrind(char** arguments) {
  execute_under_callgrind(arguments, {});
  std::perror("valgrind");
}

std::map<std::string, double> instructions_of_rows(char** arguments) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
    execute_under_callgrind(arguments, {"--lines", "--instructions"});
    _exit(127);
  }
  close(ends[1]);
  std::map<std::string, double> rows;
  FILE* const lines = fdopen(ends[0], "r");
  double figure = 0.0;
  char name[256];
  while (std::fscanf(lines, "%lf\t%255[^\n]\n", &figure, name) == 2) rows[name] = figure;
  std::fclose(lines);
  if (child > 0) waitpid(child, nullptr, 0);
  return rows;
}

}  // namespace lockstep::bench
