// What Modbus clients cost the tick: ./dev bench flood
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "bench/flooded_machine.hpp"
#include "bench/measure.hpp"
#include "bench/pairs.hpp"
#include "scheduler/processor.hpp"
#include "tests/support/flood.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] =
    R"(flood_bench [--rounds N] [--ticks N] [--axes N] [--share] [--quick]: Modbus clients and the tick
flood_bench --instructions: instructions of a tick, which no clock disturbs (valgrind)

A line shaft of six axes, and machines of 32 and 128 axes in gear with five mapped signals each (or of N
alone), run in ticks of their servo cycle, as in real time, and are recorded. Beside them

  counting      the other processors count in their registers, which touches no memory
  elsewhere     thirty-two clients are at full speed at the server of another machine, which stands: what the
                machine's processors share counts, and nothing goes over between the tick and the bridge
  clients       thirty-two clients are at full speed, half of them malformed, slow or silent
  and hindered  the same, with a full disk under the recorder and a stopped subscriber of LCM

A shared machine's speed changes by more than what is measured, but slowly. So each of these is measured for a
short time (--ticks), next to as many ticks beside which nobody asks for anything, before or after by turns;
their ratio counts. Shown are medians over many such pairs (--rounds): processor time of a tick
(CLOCK_THREAD_CPUTIME_ID without what reading this clock takes), and the ratio with the interval in which the
true median lies by 95 %; for the middle one of the ticks and for their mean. The cycle has the last processor
for itself, as with `lockstep run --cpu`; with --share it shares all with the rest.
)";

struct Plan {
  int rounds = 60;
  int ticks = 150;
  int axes = 0;  ///< of a machine that is measured alone; 0: all machines
  bool share = false;
  bool instructions = false;
};

struct MachineText {
  std::string name;
  std::string project;
};

std::vector<MachineText> machines_of(const Plan& plan) {
  const auto in_gear = [](int axes) {
    return MachineText{"gear, " + std::to_string(axes) + " axes", axes_in_gear(axes)};
  };
  if (plan.axes > 0) return {in_gear(plan.axes)};
  return {{"line shaft, 6 axes", line_shaft()}, in_gear(32), in_gear(128)};
}

/// The last processor, which everything else leaves; negative where that cannot be.
int processor_of_its_own() {
  const auto last = static_cast<int>(std::thread::hardware_concurrency()) - 1;
  const std::string problem = leave_processor(last);
  if (problem.empty()) return last;
  std::printf("the cycle shares its processor: %s\n", problem.c_str());
  return -1;
}

/// Threads that keep all processors but one busy without touching memory.
class Counters {
 public:
  Counters() {
    for (unsigned i = 1; i < std::max(2u, std::thread::hardware_concurrency()); ++i)
      threads_.emplace_back([](const std::stop_token& end) {
        for (std::uint64_t count = 0; (count & 0xFFFFu) != 0 || !end.stop_requested(); ++count)
          asm volatile("" : "+r"(count));
      });
  }

 private:
  std::vector<std::jthread> threads_;
};

void show(const MachineText& machine, const std::vector<Company>& companies) {
  std::printf("\n%-18s  %-35s  %s\n%-18s", machine.name.c_str(), "median of the ticks [us]",
              "mean of the ticks [us]", "beside them");
  for (int i = 0; i < 2; ++i) std::printf("  %6s %6s  %-20s", "alone", "so", "ratio");
  std::printf("\n");
  for (const Company& company : companies) print(company);
}

void measure(const MachineText& text, int processor, const Plan& plan, const StoppedSubscriber& subscriber) {
  FloodedMachine machine(text.project, processor, subscriber);
  const FloodedMachine other(text.project, processor, subscriber);
  test::FloodClients elsewhere(other.port(), 0, 20240604);
  test::FloodClients clients(machine.port(), 0, 20240604);
  elsewhere.rest();
  clients.rest();
  std::uint64_t answered = 0;
  const auto alone = [&] { return machine.run(plan.ticks); };
  const auto counting = [&] {
    const Counters counters;
    return alone();
  };
  const auto beside = [&](test::FloodClients& flood) {
    flood.go_on();
    const std::uint64_t before = machine.requests();
    const TickTimes times = alone();
    answered += machine.requests() - before;
    flood.rest();
    return times;
  };
  const auto hindered = [&] {
    machine.hinder_recorder(true);
    const TickTimes times = beside(clients);
    machine.hinder_recorder(false);
    return times;
  };
  std::vector<Company> companies = {{"counting", counting},
                                    {"elsewhere", [&] { return beside(elsewhere); }},
                                    {"clients", [&] { return beside(clients); }},
                                    {"and hindered", hindered}};
  for (int round = 0; round < plan.rounds; ++round)
    for (Company& company : companies) company.measure(alone, round % 2 == 0);
  for (const test::FloodClients* flood : {&elsewhere, &clients})
    if (flood->wrong() != 0 || flood->torn() != 0) throw std::runtime_error("a client got a wrong answer");
  show(text, companies);
  std::printf("%.1f requests of the clients in a tick\n",
              static_cast<double>(answered) / (2.0 * plan.rounds * plan.ticks));
}

/// Instructions of a tick of a machine that has just begun, if the bridge asks for a snapshot before each, or
/// writes so many of the registers of the good clients.
double instructions_of_tick(const MachineText& text, int ticks, bool asks, std::size_t values) {
  Project project = project_of(text.project);
  ProcessImage image(places_of(project.modbus.signals));
  project.controller->apply_stimuli = true;
  project.controller->images = {&image};
  std::vector<SignalWrite> writes;
  for (std::size_t i = 0; i < project.modbus.signals.size() && writes.size() < values; ++i)
    if (project.modbus.signals[i].name.starts_with("own_"))
      writes.push_back({static_cast<std::uint32_t>(i), Value{.i = 1}});
  const auto before = [&] {
    if (asks) image.refresh();
    if (!writes.empty()) image.post(writes);
  };
  const auto tick = [&] { project.controller->tick(); };
  for (int i = 0; i < 1000; ++i) tick();
  return static_cast<double>(count_instructions(ticks, before, tick)) / ticks;
}

void count(const MachineText& text, int ticks) {
  const double alone = instructions_of_tick(text, ticks, false, 0);
  const auto more = [&](bool asks, std::size_t values) {
    return instructions_of_tick(text, ticks, asks, values) - alone;
  };
  std::printf("%-18s  %9.1f  in a tick of which nobody asks anything\n", text.name.c_str(), alone);
  std::printf("%-18s  %+9.1f  with a snapshot asked for\n", "", more(true, 0));
  for (const std::size_t values : {1, 8, 16})
    std::printf("%-18s  %+9.1f  with values written: %zu\n", "", more(false, values), values);
}

void run(const Plan& plan) {
  if (plan.instructions) {
    for (const MachineText& text : machines_of(plan)) count(text, plan.ticks);
    return;
  }
  const StoppedSubscriber subscriber;
  const int processor = plan.share ? -1 : processor_of_its_own();
  for (const MachineText& text : machines_of(plan)) measure(text, processor, plan, subscriber);
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  lockstep::bench::Plan plan;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--quick") == 0)
      plan.rounds = 1, plan.ticks = 50;
    else if (std::strcmp(argv[i], "--share") == 0)
      plan.share = true;
    else if (std::strcmp(argv[i], "--instructions") == 0)
      plan.instructions = true;
    else if (std::strcmp(argv[i], "--rounds") == 0 && has_value)
      plan.rounds = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--ticks") == 0 && has_value)
      plan.ticks = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--axes") == 0 && has_value)
      plan.axes = std::max(1, std::atoi(argv[++i]));
    else
      return std::fputs(lockstep::bench::kHelp, stderr), 2;
  }
  try {
    if (plan.instructions && !lockstep::bench::counting_instructions()) {
      lockstep::bench::restart_under_callgrind(argv);
      return 2;
    }
    lockstep::bench::run(plan);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flood_bench: %s\n", error.what());
    return 1;
  }
}
