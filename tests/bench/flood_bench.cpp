// What Modbus clients cost the tick: ./dev bench flood
#include <lcm/lcm.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bench/machine.hpp"
#include "hmi_bridge/csv_trace.hpp"
#include "hmi_bridge/lcm_publisher.hpp"
#include "hmi_bridge/modbus_server.hpp"
#include "hmi_bridge/trace_recorder.hpp"
#include "projects/project.hpp"
#include "scheduler/processor.hpp"
#include "tests/support/flood.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] =
    R"(flood_bench [--rounds N] [--ticks N] [--axes N] [--share] [--quick]: Modbus clients and the tick

A line shaft of six axes, and machines of 32 and 128 axes in gear with five mapped signals each (or of N
alone), run in ticks of their servo cycle, as in real time, and are recorded. In turns nobody is connected,
the other processors only count, thirty-two clients are at full speed, half of them malformed, slow or
silent, and the same with a full disk under the recorder and a stopped subscriber of LCM. Shown is the
processor time of a tick (CLOCK_THREAD_CPUTIME_ID without what reading this clock takes, mean of a round),
median and least of all rounds, and how many requests were answered. Counting touches no memory: what it costs
the tick is the machine's, whose processors share clock and power, and what the clients cost beyond it is
Lockstep's. The cycle has the last processor for itself, as with `lockstep run --cpu`; with --share it shares
all with the rest.
)";

double processor_time() {  // of this thread [µs]
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

/// A program that has subscribed to everything on the network of LCM and then stopped: what it does not take
/// fills the buffer of its socket. To be made before there are threads.
class StoppedSubscriber {
 public:
  static constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";

  StoppedSubscriber() : child_(::fork()) {
    if (child_ == 0) be_it();
    int status = 0;
    ::waitpid(child_, &status, WUNTRACED);
    is_there_ = WIFSTOPPED(status);
    if (!is_there_) std::printf("there is no network of LCM, and no subscriber\n");
  }
  ~StoppedSubscriber() {
    if (!is_there_) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  StoppedSubscriber(const StoppedSubscriber&) = delete;
  StoppedSubscriber& operator=(const StoppedSubscriber&) = delete;

  const char* url() const { return is_there_ ? kUrl : "memq://"; }

 private:
  [[noreturn]] static void be_it() {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    lcm_t* const lcm = lcm_create(kUrl);
    if (lcm == nullptr) ::_exit(1);
    lcm_subscribe(
        lcm, ".*", [](const lcm_recv_buf_t*, const char*, void*) {}, nullptr);
    ::raise(SIGSTOP);
    ::_exit(0);
  }

  const pid_t child_;
  bool is_there_ = false;
};

/// A project that runs, with its Modbus server and its recorder.
class FloodedMachine {
 public:
  /// @param processor of the cycle; negative: any
  FloodedMachine(const std::string& text, int processor)
      : project_(loaded(text)), image_(places_of(project_.modbus.signals)), processor_(processor) {
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    server_ = std::make_unique<ModbusServer>(
        std::vector<ModbusService>{{options, project_.modbus.units_of(0)}}, image_, ModbusIdentity{});
    project_.controller->apply_stimuli = true;
    project_.controller->images = {&image_};
    if (const std::string problem = server_->start(); !problem.empty()) throw std::runtime_error(problem);
    record("/dev/null", "memq://");
    run(1000);
  }
  ~FloodedMachine() { project_.controller->trace = nullptr; }

  /// Records from here on to other places.
  void record(const char* file, const char* url) {
    recorder_.reset();
    ring_ = std::make_unique<TraceRing>(places_of(project_.trace.signals));
    std::vector<std::unique_ptr<TraceSink>> sinks;
    sinks.push_back(std::make_unique<CsvTrace>(file));
    sinks.push_back(std::make_unique<LcmPublisher>(
        url, LcmTraceIdentity{"flood", "FLOOD", project_.controller->clock.interpolator_cycle(), 0}));
    std::vector<TraceSignal> columns;
    for (const NamedSignal& signal : project_.trace.signals)
      columns.push_back({signal.name, signal.signal.value_type(), ""});
    recorder_ = std::make_unique<TraceRecorder>(*ring_, std::move(columns), std::move(sinks));
    project_.controller->trace = ring_.get();
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
        processor_time();
        const double first = processor_time();
        const double begin = processor_time();
        project_.controller->tick();
        spent += processor_time() - begin - (begin - first);
      }
    });
    cycle.join();
    return spent / ticks;
  }
  std::uint64_t requests() const { return server_->counters().requests; }
  std::uint16_t port() const { return server_->port(); }

 private:
  static Project loaded(const std::string& text) {
    LoadedProject loaded = load_project(text);
    if (!loaded.project) throw std::runtime_error("the project does not load: " + loaded.problems[0].text);
    return std::move(*loaded.project);
  }

  Project project_;
  ProcessImage image_;
  int processor_;
  std::unique_ptr<ModbusServer> server_;
  std::unique_ptr<TraceRing> ring_;
  std::unique_ptr<TraceRecorder> recorder_;
};

using Json = nlohmann::ordered_json;

std::string line_shaft() {
  std::ifstream file(LOCKSTEP_SOURCE_DIR "/projects/03_line_shaft/project.json");
  return test::flooded_project(Json::parse(file));
}

/// So many axes in gear, each with five signals that an operator sees, two of which are recorded.
std::string axes_in_gear(int axes) {
  Json json = Json::parse(project_text({.motion = Motion::gear, .axes = axes}));
  json["tags"] = Json::object();
  int address = 1000;
  for (int i = 1; i <= axes; ++i) {
    const std::string axis = "Axis" + std::to_string(i);
    for (const char* name : {".Position", ".Velocity", ".ActualPosition", ".StatusWord", ".ErrorWord"}) {
      json["modbus"]["map"].push_back(
          {{"tag", axis + name}, {"table", "input_register"}, {"address", address}});
      address += 4;
    }
    for (const char* name : {".Position", ".Velocity"}) json["trace"]["signals"].push_back(axis + name);
  }
  return test::flooded_project(std::move(json));
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

struct Plan {
  int rounds = 9;
  int ticks = 4000;
  int axes = 0;  ///< of a machine that is measured alone; 0: all machines
  bool share = false;
};

void measure(const char* name, const std::string& text, int processor, const Plan& plan,
             const StoppedSubscriber& subscriber) {
  FloodedMachine machine(text, processor);
  std::vector<double> idle;
  std::vector<double> beside;
  std::vector<double> flooded;
  std::vector<double> worst;
  std::uint64_t answered = 0;
  for (int round = 0; round < plan.rounds; ++round) {
    idle.push_back(machine.run(plan.ticks));
    {
      const Counters counters;
      beside.push_back(machine.run(plan.ticks));
    }
    const test::FloodClients clients(machine.port(), 0, 20240604);
    const std::uint64_t before = machine.requests();
    flooded.push_back(machine.run(plan.ticks));
    answered += machine.requests() - before;
    machine.record("/dev/full", subscriber.url());
    worst.push_back(machine.run(plan.ticks));
    machine.record("/dev/null", "memq://");
    if (clients.wrong() != 0 || clients.torn() != 0) throw std::runtime_error("a client got a wrong answer");
  }
  std::printf("\n%-42s %8s %8s\n", name, "median", "least");
  show("nobody connected [us]", idle);
  show("nobody connected, other processors busy", beside);
  show("32 clients at full speed", flooded);
  show("  and a full disk, a stopped subscriber", worst);
  std::printf("ratio, round by round\n");
  show("  clients : nobody", ratios_of(flooded, idle));
  show("  clients : nobody, other processors busy", ratios_of(flooded, beside));
  show("  with disk and subscriber : nobody", ratios_of(worst, idle));
  std::printf("%.1f requests in a tick\n",
              static_cast<double>(answered) / (static_cast<double>(plan.rounds) * plan.ticks));
}

void measure(const Plan& plan) {
  const StoppedSubscriber subscriber;
  const int processor = plan.share ? -1 : processor_of_its_own();
  const auto in_gear = [&](int axes) {
    measure(("gear, " + std::to_string(axes) + " axes").c_str(), axes_in_gear(axes), processor, plan,
            subscriber);
  };
  if (plan.axes > 0) return in_gear(plan.axes);
  measure("line shaft, 6 axes", line_shaft(), processor, plan, subscriber);
  for (const int axes : {32, 128}) in_gear(axes);
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
    lockstep::bench::measure(plan);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flood_bench: %s\n", error.what());
    return 1;
  }
}
