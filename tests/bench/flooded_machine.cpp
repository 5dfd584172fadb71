#include "bench/flooded_machine.hpp"

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
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "bench/machine.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/traces/csv_trace.hpp"
#include "scheduler/processor.hpp"
#include "tests/support/flood.hpp"

namespace lockstep::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kNetwork[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr char kWithinProcess[] = "memq://";
constexpr int kNotCounted = 25;  // ticks at the beginning

double thread_time() {  // of this thread [µs]
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

/// Without what reading the clock takes [µs].
double time_of_tick(Controller& controller) {
  thread_time();
  const double first = thread_time();
  const double begin = thread_time();
  controller.tick();
  return thread_time() - begin - (begin - first);
}

[[noreturn]] void subscribe_and_stop() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  lcm_t* const lcm = lcm_create(kNetwork);
  if (lcm == nullptr) ::_exit(1);
  lcm_subscribe(
      lcm, ".*", [](const lcm_recv_buf_t*, const char*, void*) {}, nullptr);
  ::raise(SIGSTOP);
  ::_exit(0);
}

std::vector<TraceSignal> columns_of(const Project& project) {
  std::vector<TraceSignal> columns;
  for (const NamedSignal& signal : project.trace.signals)
    columns.push_back({signal.name, signal.signal.value_type(), ""});
  return columns;
}

std::vector<std::unique_ptr<TraceSink>> sinks_to(const Project& project, const char* file, const char* url) {
  std::vector<std::unique_ptr<TraceSink>> sinks;
  sinks.push_back(std::make_unique<CsvTrace>(file));
  sinks.push_back(std::make_unique<LcmPublisher>(
      url, LcmTraceIdentity{"flood", "FLOOD", project.controller->clock.interpolator_cycle(), 0}));
  return sinks;
}

/// On a thread as the one of a cycle.
void as_a_cycle(int processor, const std::function<void()>& work) {
  std::thread([&] {
    const sched_param priority{80};
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
    if (processor >= 0) keep_on_processor(pthread_self(), processor);
    work();
  }).join();
}

/// Ticks at their times, on the thread that makes it.
class Pace {
 public:
  explicit Pace(Controller& controller) : controller_(controller) {}
  /// @return what it took [µs]
  double tick() {
    const std::chrono::nanoseconds period(controller_.clock.servo_cycle);
    do due_ += period;
    while (due_ < std::chrono::steady_clock::now());
    std::this_thread::sleep_until(due_);
    return time_of_tick(controller_);
  }

 private:
  Controller& controller_;
  std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now();
};

TickTimes times_of(std::vector<double> ticks) {
  const auto middle = ticks.begin() + static_cast<std::ptrdiff_t>(ticks.size() / 2);
  std::nth_element(ticks.begin(), middle, ticks.end());
  return {*middle, std::accumulate(ticks.begin(), ticks.end(), 0.0) / static_cast<double>(ticks.size())};
}

}  // namespace

std::string line_shaft() {
  std::ifstream file(LOCKSTEP_SOURCE_DIR "/projects/03_line_shaft/project.json");
  return test::flooded_project(Json::parse(file));
}

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

Project project_of(const std::string& text) {
  LoadedProject loaded = load_project(text);
  if (!loaded.project) throw std::runtime_error("the project does not load: " + loaded.problems[0].text);
  return std::move(*loaded.project);
}

StoppedSubscriber::StoppedSubscriber() : child_(::fork()) {
  if (child_ == 0) subscribe_and_stop();
  int status = 0;
  ::waitpid(child_, &status, WUNTRACED);
  is_there_ = WIFSTOPPED(status);
  if (!is_there_) std::printf("there is no network of LCM, and no subscriber\n");
}

StoppedSubscriber::~StoppedSubscriber() {
  if (!is_there_) return;
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

const char* StoppedSubscriber::url() const {
  return is_there_ ? kNetwork : kWithinProcess;
}

TickTimes run_ticks(Controller& controller, int processor, int ticks) {
  std::vector<double> times;
  as_a_cycle(processor, [&] {
    Pace pace(controller);
    for (int i = 0; i < kNotCounted; ++i) pace.tick();
    for (int i = 0; i < ticks; ++i) times.push_back(pace.tick());
  });
  return times_of(std::move(times));
}

TurnTimes run_ticks_by_turns(Controller& controller, int processor, int ticks,
                             const std::function<void(bool with)>& turn) {
  std::vector<double> times[2];
  as_a_cycle(processor, [&] {
    Pace pace(controller);
    std::mt19937 random(20261127);
    turn(true);
    for (int i = 0; i < kNotCounted; ++i) pace.tick();
    // As long as a cycle of the interpolator, whose ticks take longer than those between.
    const int length = controller.clock.interpolator_ratio;
    for (int i = 0; i < ticks; i += length) {
      const bool first = random() % 2 == 0;
      for (const bool with : {first, !first}) {
        turn(with);
        for (int tick = 0; tick < length; ++tick) times[with].push_back(pace.tick());
      }
    }
  });
  return {times_of(std::move(times[true])), times_of(std::move(times[false]))};
}

FloodedMachine::Recording::Recording(const Project& project, const char* file, const char* url)
    : ring(places_of(project.trace.signals)),
      recorder(ring, columns_of(project), sinks_to(project, file, url)) {}

FloodedMachine::FloodedMachine(const std::string& text, int processor, const StoppedSubscriber& subscriber)
    : project_(project_of(text)),
      image_(places_of(project_.modbus.signals)),
      processor_(processor),
      free_(project_, "/dev/null", kWithinProcess),
      hindered_(project_, "/dev/full", subscriber.url()) {
  ModbusServerOptions options;
  options.listen = {{"127.0.0.1", 0}};
  server_ = std::make_unique<ModbusServer>(std::vector<ModbusService>{{options, project_.modbus.units_of(0)}},
                                           image_, ModbusIdentity{});
  project_.controller->apply_stimuli = true;
  project_.controller->images = {&image_};
  if (const std::string problem = server_->start(); !problem.empty()) throw std::runtime_error(problem);
  hinder_recorder(false);
  run(1000);
}

FloodedMachine::~FloodedMachine() {
  project_.controller->trace = nullptr;
}

void FloodedMachine::hinder_recorder(bool hindered) {
  project_.controller->trace = hindered ? &hindered_.ring : &free_.ring;
}

}  // namespace lockstep::bench
