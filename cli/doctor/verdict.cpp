#include "cli/doctor/verdict.hpp"

#include <fmt/format.h>

#include "scheduler/real_time_rights.hpp"

namespace lockstep::cli {
namespace {

constexpr std::int64_t kUsual[] = {125'000,   250'000,   500'000,    1'000'000, 2'000'000,
                                   4'000'000, 8'000'000, 16'000'000, 32'000'000};

constexpr const char* kLimits = "/etc/security/limits.d/lockstep.conf";
constexpr const char* kNewLogin =
    "log in anew; in a container: docker run --ulimit rtprio=80 --ulimit memlock=-1";
constexpr const char* kRestart = "restart the machine";

/// Adds words to the command line of the kernel, on Debian.
std::string boot_with(const std::string& words) {
  return fmt::format("sudo sed -i 's/^GRUB_CMDLINE_LINUX=\"/&{} /' /etc/default/grub && sudo update-grub",
                     words);
}

Advice priority() {
  return {"priority", "Allow real-time priority: without it every other process may delay a tick.",
          fmt::format("echo \"$USER - rtprio {}\" | sudo tee -a {}", kCyclePriority, kLimits), kNewLogin};
}

Advice memory() {
  return {"memory", "Allow locked memory: without it a page that has to be fetched may delay a tick.",
          fmt::format("echo \"$USER - memlock unlimited\" | sudo tee -a {}", kLimits), kNewLogin};
}

Advice kernel() {
  return {"kernel", "Use a kernel with PREEMPT_RT: the cycle then interrupts nearly everything it does.",
          "sudo apt install linux-image-rt-$(dpkg --print-architecture)", kRestart};
}

Advice preempt() {
  return {"preempt",
          "Or have this kernel let itself be interrupted in more places: less than PREEMPT_RT gives.",
          boot_with("preempt=full"), kRestart};
}

Advice isolation(int processor) {
  return {"isolation", "Keep a processor free for the cycle: nothing else is then scheduled there.",
          boot_with(fmt::format("isolcpus={0} nohz_full={0} rcu_nocbs={0}", processor)),
          fmt::format("{}; then use lockstep run --cpu {}", kRestart, processor)};
}

Advice use_processor(int processor) {
  return {"processor", "Measure on the processor that is isolated, and run the cycle there.",
          fmt::format("lockstep doctor --cpu {}", processor),
          fmt::format("use lockstep run --cpu {}", processor)};
}

Advice governor() {
  return {"governor", "Keep the frequency of the processors up: one that has slowed down wakes later.",
          "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor",
          "at each start of the machine"};
}

bool is_slowed(const SystemFacts& facts) {
  return !facts.governors.empty() && facts.governors != std::vector<std::string>{"performance"};
}

}  // namespace

std::span<const std::int64_t> usual_servo_cycles() noexcept {
  return kUsual;
}

Verdict judge(std::int64_t worst, std::int64_t servo_cycle, const RealTimeRights& rights) {
  const auto fits = [&](std::int64_t cycle) { return worst <= cycle / kMargin; };
  Verdict verdict;
  verdict.fits = fits(servo_cycle);
  verdict.holds = verdict.fits && rights.priority;
  for (const std::int64_t cycle : kUsual)
    if (verdict.shortest == 0 && fits(cycle)) verdict.shortest = cycle;
  return verdict;
}

std::vector<Advice> advise(const SystemFacts& facts, const RealTimeRights& rights, int processor) {
  std::vector<Advice> advice;
  if (!rights.priority) advice.push_back(priority());
  if (!rights.memory) advice.push_back(memory());
  if (facts.preemption != Preemption::real_time) advice.push_back(kernel());
  if (facts.preemption == Preemption::dynamic && facts.preemption_now != "full") advice.push_back(preempt());
  if (facts.isolated.empty()) {
    const int free = processor >= 0 ? processor : highest_in_list(facts.processors);
    if (count_in_list(facts.processors) > 1) advice.push_back(isolation(free));
  } else if (!is_in_list(processor, facts.isolated)) {
    advice.push_back(use_processor(highest_in_list(facts.isolated)));
  }
  if (is_slowed(facts)) advice.push_back(governor());
  return advice;
}

}  // namespace lockstep::cli
