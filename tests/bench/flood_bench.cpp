// What Modbus clients cost the tick: ./dev bench flood
#include <pthread.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus_server.hpp"
#include "projects/project.hpp"
#include "scheduler/processor.hpp"
#include "tests/support/flood.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] =
    R"(flood_bench [--rounds N] [--ticks N] [--share] [--quick]: Modbus clients and the tick

Six axes on a line shaft run in ticks of their servo cycle, as in real time; in turns nobody is connected, the
other processors only count, and thirty-two clients are at full speed, half of them malformed, slow or silent. Shown
is the processor time of a tick (CLOCK_THREAD_CPUTIME_ID, mean of a round), median and least of all rounds, and how
many requests were answered. Counting touches no memory: what it costs the tick is the machine's, whose processors
share clock and power, and what the clients cost beyond it is Lockstep's. The cycle has the last processor for
itself, as with `lockstep run --cpu`; with --share it shares all with the rest.
)";

double processor_time() {  // of this thread [µs]
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

/// A project that runs, with its Modbus server.
class Machine {
 public:
  /// @param processor of the cycle; negative: any
  Machine(Project loaded, int processor)
      : project_(std::move(loaded)), image_(places()), processor_(processor) {
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    server_ = std::make_unique<ModbusServer>(
        std::vector<ModbusService>{{options, project_.modbus.units_of(0)}}, image_, ModbusIdentity{});
    project_.controller->apply_stimuli = true;
    project_.controller->images = {&image_};
    if (const std::string problem = server_->start(); !problem.empty()) throw std::runtime_error(problem);
    run(1000);
  }

  /// So many ticks on a thread of their own, as `lockstep run` has them: with real-time priority where that
  /// is permitted, each at its time, and none made up. @return processor time of one [µs]
  double run(int ticks) {
    double spent = 0.0;
    std::thread cycle([&] {
      const sched_param priority{80};
      pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
      if (processor_ >= 0) keep_on_processor(pthread_self(), processor_);
      const std::chrono::nanoseconds period(project_.controller->clock.servo_cycle);
      auto due = std::chrono::steady_clock::now();
      for (int i = 0; i < ticks; ++i) {
        do due += period;
        while (due < std::chrono::steady_clock::now());
        std::this_thread::sleep_until(due);
        const double before = processor_time();
        project_.controller->tick();
        spent += processor_time() - before;
      }
    });
    cycle.join();
    return spent / ticks;
  }
  std::uint64_t requests() const { return server_->counters().requests; }
  std::uint16_t port() const { return server_->port(); }

 private:
  std::vector<Signal> places() const {
    std::vector<Signal> places;
    for (const NamedSignal& signal : project_.modbus.signals) places.push_back(signal.signal);
    return places;
  }

  Project project_;
  ProcessImage image_;
  int processor_;
  std::unique_ptr<ModbusServer> server_;
};

std::unique_ptr<Machine> line_shaft(int processor) {
  std::ifstream file(LOCKSTEP_SOURCE_DIR "/projects/03_line_shaft/project.json");
  LoadedProject loaded = load_project(test::flooded_project(nlohmann::ordered_json::parse(file)));
  if (!loaded.project) throw std::runtime_error("the project of the line shaft does not load");
  return std::make_unique<Machine>(std::move(*loaded.project), processor);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void show(const char* what, const std::vector<double>& times) {
  std::printf("%-42s %8.2f %8.2f\n", what, median(times), *std::min_element(times.begin(), times.end()));
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

std::vector<double> ratios_of(const std::vector<double>& times, const std::vector<double>& others) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / others[i]);
  return ratios;
}

void measure(int rounds, int ticks, bool share) {
  const std::unique_ptr<Machine> machine = line_shaft(share ? -1 : processor_of_its_own());
  std::vector<double> idle;
  std::vector<double> beside;
  std::vector<double> flooded;
  std::uint64_t answered = 0;
  for (int round = 0; round < rounds; ++round) {
    idle.push_back(machine->run(ticks));
    {
      const Counters counters;
      beside.push_back(machine->run(ticks));
    }
    const test::FloodClients clients(machine->port(), 0, 20240604);
    const std::uint64_t before = machine->requests();
    flooded.push_back(machine->run(ticks));
    answered += machine->requests() - before;
  }
  std::printf("%-42s %8s %8s\n", "tick, processor time [µs]", "median", "least");
  show("nobody connected", idle);
  show("nobody connected, other processors busy", beside);
  show("32 clients at full speed", flooded);
  std::printf("ratio, round by round\n");
  show("  clients : nobody", ratios_of(flooded, idle));
  show("  clients : nobody, other processors busy", ratios_of(flooded, beside));
  std::printf("%.1f requests in a tick\n",
              static_cast<double>(answered) / (static_cast<double>(rounds) * ticks));
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  int rounds = 9;
  int ticks = 4000;
  bool share = false;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--quick") == 0)
      rounds = 1, ticks = 50;
    else if (std::strcmp(argv[i], "--share") == 0)
      share = true;
    else if (std::strcmp(argv[i], "--rounds") == 0 && has_value)
      rounds = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--ticks") == 0 && has_value)
      ticks = std::max(1, std::atoi(argv[++i]));
    else
      return std::fputs(lockstep::bench::kHelp, stderr), 2;
  }
  try {
    lockstep::bench::measure(rounds, ticks, share);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flood_bench: %s\n", error.what());
    return 1;
  }
}
