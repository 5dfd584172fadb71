#include "cli/doctor/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hmi_bridge/network/visible_text.hpp"
#include "scheduler/real_time_rights.hpp"

namespace lockstep::cli {
namespace {

using nlohmann::ordered_json;

std::string one_line(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// As precise as a lateness is worth.
std::string lateness_text(std::int64_t late) {
  const auto value = static_cast<double>(late);
  if (late >= 1'000'000'000) return fmt::format("{:.2f} s", value * 1e-9);
  if (late >= 1'000'000) return fmt::format("{:.2f} ms", value * 1e-6);
  return fmt::format("{:.0f} µs", value * 1e-3);
}

/// The verdict, in a sentence or two.
std::string verdict_text(const Findings& findings) {
  const std::string asked = time_text(findings.servo_cycle);
  const std::int64_t shortest = findings.verdict.shortest;
  if (findings.verdict.holds && shortest == findings.servo_cycle)
    return fmt::format("This machine holds a servo_cycle of {}, and no shorter one.\n", asked);
  if (findings.verdict.holds)
    return fmt::format("This machine holds a servo_cycle of {}.\n", asked) +
           (shortest == 0 ? "" : fmt::format("The shortest that it holds is {}.\n", time_text(shortest)));
  if (findings.verdict.fits)
    return fmt::format(
        "This machine holds a servo_cycle of {} as long as nothing else wants its processors:\n"
        "without real-time priority any other process may delay a tick.\n",
        asked);
  return fmt::format("This machine does not hold a servo_cycle of {}.\n", asked) +
         (shortest == 0
              ? "It holds none that is usual.\n"
              : fmt::format("The shortest that fits what was measured is {}.\n", time_text(shortest)));
}

std::string system_lines(const Findings& findings) {
  const SystemFacts& facts = findings.facts;
  return fmt::format(
      "  kernel       {}, {}\n"
      "  priority     {}\n"
      "  memory       {}\n"
      "  processors   {}, {}\n"
      "  governor     {}\n",
      visible(facts.kernel), visible(preemption_text(facts)),
      findings.rights.priority ? fmt::format("{}, real time", kCyclePriority)
                               : fmt::format("no real-time one; the limit is {}", facts.priority_limit),
      findings.rights.memory ? "locked" : "not locked", visible(facts.processors),
      facts.isolated.empty() ? "none isolated" : "isolated: " + visible(facts.isolated),
      facts.governors.empty() ? "not told by this machine" : visible(one_line(facts.governors)));
}

std::string advice_lines(const std::vector<Advice>& advice) {
  if (advice.empty()) return "Nothing is left to be told that would help.\n";
  std::string text = "What would help, most first:\n";
  for (const Advice& one : advice) {
    text += "  " + one.text + "\n    " + one.command + "\n";
    if (!one.after.empty()) text += "    (" + one.after + ")\n";
  }
  return text;
}

}  // namespace

std::string time_text(std::int64_t time) {
  const auto value = static_cast<double>(time);
  if (time >= 1'000'000'000) return fmt::format("{:.6g} s", value * 1e-9);
  if (time >= 1'000'000) return fmt::format("{:.6g} ms", value * 1e-6);
  return fmt::format("{:.6g} µs", value * 1e-3);
}

std::string report_text(const Findings& findings) {
  const std::string place =
      findings.processor < 0 ? "any processor" : fmt::format("processor {}", findings.processor);
  return fmt::format("{} wake-ups in {}, every {}, on {}\n", findings.wakeups, time_text(findings.duration),
                     time_text(findings.servo_cycle), place) +
         fmt::format("late by: median {}, 99 % within {}, 99.99 % within {}, worst {}\n\n",
                     lateness_text(findings.median), lateness_text(findings.one_percent),
                     lateness_text(findings.rarest), lateness_text(findings.worst)) +
         verdict_text(findings) +
         fmt::format(
             "(It has to be {} times the worst lateness: a third for what was measured, a third for what is\n"
             "rarer than that, a third for the work of a tick. Measure while the machine does what it will "
             "do\n"
             "beside Lockstep: at rest it shows less.)\n\n",
             kMargin) +
         system_lines(findings) + "\n" + advice_lines(findings.advice);
}

std::string report_json(const Findings& findings) {
  const SystemFacts& facts = findings.facts;
  ordered_json advice = ordered_json::array();
  for (const Advice& one : findings.advice)
    advice.push_back({{"key", one.key}, {"text", one.text}, {"command", one.command}, {"after", one.after}});
  const ordered_json report = {
      {"servo_cycle_ns", findings.servo_cycle},
      {"holds", findings.verdict.holds},
      {"fits", findings.verdict.fits},
      {"shortest_ns",
       findings.verdict.shortest == 0 ? ordered_json() : ordered_json(findings.verdict.shortest)},
      {"measured",
       {{"duration_ns", findings.duration},
        {"processor", findings.processor < 0 ? ordered_json() : ordered_json(findings.processor)},
        {"wakeups", findings.wakeups},
        {"lateness_ns",
         {{"median", findings.median},
          {"p99", findings.one_percent},
          {"p99_99", findings.rarest},
          {"worst", findings.worst}}}}},
      {"system",
       {{"kernel", facts.kernel},
        {"preemption", preemption_text(facts)},
        {"priority", findings.rights.priority ? kCyclePriority : 0},
        {"priority_limit", facts.priority_limit},
        {"memory_locked", findings.rights.memory},
        {"processors", facts.processors},
        {"isolated", facts.isolated},
        {"governors", facts.governors}}},
      {"advice", advice}};
  return report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace lockstep::cli
