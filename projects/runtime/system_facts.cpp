#include "projects/runtime/system_facts.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "scheduler/real_time_rights.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// The first line of a file; empty if there is none.
std::string line_of(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// What stands between brackets: "none voluntary (full)" has chosen "full".
std::string chosen_of(const std::string& line) {
  const std::size_t begin = line.find('('), end = line.find(')');
  return begin == std::string::npos || end == std::string::npos || end < begin
             ? ""
             : line.substr(begin + 1, end - begin - 1);
}

/// A kernel says in its version how it was built; new ones say what is chosen too: "PREEMPT(lazy)".
Preemption preemption_of(std::string_view version, bool real_time) {
  const auto says = [&](std::string_view word) { return version.find(word) != std::string_view::npos; };
  if (real_time || says("PREEMPT_RT") || says("PREEMPT_{RT")) return Preemption::real_time;
  if (says("PREEMPT_DYNAMIC") || says("PREEMPT(")) return Preemption::dynamic;
  return says("PREEMPT") ? Preemption::full : Preemption::none;
}

std::vector<std::string> governors_of(const fs::path& processors) {
  std::vector<std::string> governors;
  std::error_code error;
  for (fs::directory_iterator entry(processors, error), end; !error && entry != end; entry.increment(error)) {
    const std::string governor = line_of(entry->path() / "cpufreq" / "scaling_governor");
    if (!governor.empty()) governors.push_back(governor);
  }
  std::sort(governors.begin(), governors.end());
  governors.erase(std::unique(governors.begin(), governors.end()), governors.end());
  return governors;
}

std::int64_t limit_of(int resource) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) return 0;
  return limit.rlim_cur == RLIM_INFINITY ? -1 : static_cast<std::int64_t>(limit.rlim_cur);
}

/// Calls `take(first, last)` for each part of a list such as "1,3-5", as far as it is one.
template <class Take>
void for_each_part(std::string_view list, Take take) {
  while (!list.empty()) {
    const std::string_view part = list.substr(0, list.find(','));
    list.remove_prefix(std::min(part.size() + 1, list.size()));
    int first = 0;
    const char* const end = part.data() + part.size();
    auto [rest, error] = std::from_chars(part.data(), end, first);
    if (error != std::errc{}) return;
    int last = first;
    if (rest != end && *rest == '-') error = std::from_chars(rest + 1, end, last).ec;
    if (error != std::errc{}) return;
    take(first, last);
  }
}

}  // namespace

SystemFacts read_system_facts(const std::string& root) {
  SystemFacts facts;
  utsname system{};
  uname(&system);
  facts.kernel = system.release;
  const fs::path processors = root + "/sys/devices/system/cpu";
  facts.preemption = preemption_of(system.version, line_of(root + "/sys/kernel/realtime") == "1");
  facts.preemption_now = chosen_of(line_of(root + "/sys/kernel/debug/sched/preempt"));
  if (facts.preemption_now.empty()) facts.preemption_now = chosen_of(system.version);
  facts.processors = line_of(processors / "online");
  facts.isolated = line_of(processors / "isolated");
  facts.governors = governors_of(processors);
  facts.priority_limit = limit_of(RLIMIT_RTPRIO);
  facts.memory_limit = limit_of(RLIMIT_MEMLOCK);
  return facts;
}

std::string preemption_text(const SystemFacts& facts) {
  switch (facts.preemption) {
    case Preemption::real_time:
      return "PREEMPT_RT";
    case Preemption::full:
      return "PREEMPT";
    case Preemption::dynamic:
      return "PREEMPT_DYNAMIC" + (facts.preemption_now.empty() ? "" : " (" + facts.preemption_now + ")");
    case Preemption::none:
      break;
  }
  return "without preemption";
}

bool is_in_list(int processor, const std::string& list) {
  bool found = false;
  for_each_part(list, [&](int first, int last) { found |= first <= processor && processor <= last; });
  return found;
}

int count_in_list(const std::string& list) {
  int count = 0;
  for_each_part(list, [&](int first, int last) { count += last - first + 1; });
  return count;
}

int highest_in_list(const std::string& list) {
  int highest = -1;
  for_each_part(list, [&](int, int last) { highest = std::max(highest, last); });
  return highest;
}

std::string system_text(const SystemFacts& facts, const RealTimeRights& rights, int processor) {
  std::string place =
      facts.isolated.empty() ? "no processor isolated" : "isolated processors " + facts.isolated;
  if (processor >= 0)
    place = fmt::format("processor {}, {}", processor,
                        is_in_list(processor, facts.isolated) ? "isolated" : "not isolated");
  return fmt::format("the system gives {}, {}, {}, kernel {} {}",
                     rights.priority ? fmt::format("priority {}", kCyclePriority) : "no real-time priority",
                     rights.memory ? "locked memory" : "no locked memory", place, facts.kernel,
                     preemption_text(facts)) +
         (rights.priority && rights.memory ? "" : "; lockstep doctor tells what helps");
}

}  // namespace lockstep
