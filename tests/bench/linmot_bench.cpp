// What LinMot controllers take: ./dev bench linmot [--quick]
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure.hpp"
#include "projects/loader/project.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep::bench {
namespace {

constexpr int kTicksBetweenTurns = 250;

enum class Does { rests, positions, curves };

/// A controller with a servo cycle of 1 ms whose motors, with their plants, do something.
struct LinMotMachine {
  std::unique_ptr<LinMotController> controller = std::make_unique<LinMotController>("C", DB_ANY{1});
  bool trigger = false;
  int ticks = 0;
  std::int64_t now = 0;

  LinMotMachine(int motors, double control_cycle, Does does) {
    constexpr DINT kLinear = 3, kContinuous = 2, kTwoPoint = 4;
    LinMotController& c = *controller;
    c.control_cycle = control_cycle;
    c.data.Parameters.auto_start = true;
    std::vector<linmot::CurvePart> there_and_back(2);
    there_and_back[0].end = there_and_back[1].start = 30.0;
    there_and_back[0].time = there_and_back[1].time = 0.2;
    c.curves[1].make(there_and_back);
    for (std::size_t i = 0; i < static_cast<std::size_t>(motors); ++i) {
      LinMotMotorData& motor = c.data.Motors[i];
      motor.Parameters.type = kLinear;
      motor.Parameters.maximal_current = 5.0;
      motor.Parameters.curve_number = 1;
      if (does == Does::curves) motor.Parameters.run_mode = kContinuous;
      if (does == Does::positions) motor.Parameters.run_mode = kTwoPoint;
      linmot::MotorSettings& settings = c.motor_settings[i];
      settings.exists = true;
      settings.force_constant = 40.0;
      settings.plant.slider_mass = 0.829;
      settings.plant.load_mass = 1.2;
      settings.plant.friction = 10.0;
      settings.trigger = &trigger;
    }
    c.configure(1e-3, 1);
  }
  void run(int count) {
    for (int i = 0; i < count; ++i, ++ticks, now += 1'000'000) {
      if (ticks % kTicksBetweenTurns == 0) trigger = !trigger;
      controller->servo(now);
    }
  }
};

/// Instructions of a tick; 0 without callgrind.
double instructions_of(int motors, double control_cycle, Does does) {
  LinMotMachine machine(motors, control_cycle, does);
  machine.run(500);
  constexpr int kTicks = 1000;  // four turns
  return static_cast<double>(count_instructions([&] { machine.run(kTicks); })) / kTicks;
}

/// The parts of a tick are what more motors and more control cycles add to it.
void tell_parts(const char* name, Does does) {
  constexpr double kCycle = 100e-6, kHalfCycle = 50e-6;
  const double one = instructions_of(1, kCycle, does), four = instructions_of(4, kCycle, does);
  const double twice = instructions_of(4, kHalfCycle, does);
  const double cycle = (twice - four) / 40.0, tick = (four - one) / 3.0 - 10.0 * cycle;
  std::printf(
      "%-10s a motor and control cycle %7.1f (220), a motor and tick %7.1f (350), a controller %7.1f (600), "
      "four motors at 100 us %9.1f (13000)\n",
      name, cycle, tick, one - tick - 10.0 * cycle, four);
}

/// How much faster than real time 64 controllers with four motors each run, one control cycle a tick.
void tell_fleet(bool quick) {
  std::vector<std::unique_ptr<LinMotMachine>> all;
  for (int i = 0; i < 64; ++i) all.push_back(std::make_unique<LinMotMachine>(4, 1e-3, Does::curves));
  const auto work = [&](int calls) {
    for (const auto& one : all) one->run(calls);
  };
  work(100);
  const Timing timing = measure(work, {.runs = quick ? 1 : 9, .calls = quick ? 10 : 1000});
  std::printf("64 controllers, 256 motors, 1 ms: %.1f us a tick, %.1f times real time\n", timing.mean * 1e-3,
              1e6 / timing.mean);
}

/// A curve of a hundred thousand points, 63 curves, 64 rows of four motors.
std::string large_project() {
  nlohmann::json controller = {{"type", "LinMot_Controller"},
                               {"config", {{"System", {{"Command Interface", "MT"}}}, {"Drives", {}}}}};
  for (const char* const letter : {"A", "B", "C", "D"})
    controller["config"]["Drives"][std::string("Drive ") + letter] = {{"Type", "LinMot P0x-37"}};
  nlohmann::json points = nlohmann::json::array();
  for (int i = 0; i < 100'000; ++i) points.push_back({i * 1.5, (i % 100) * 0.1});
  controller["curves"]["1"] = {{"points", points}};
  for (int curve = 2; curve < 64; ++curve)
    controller["curves"][std::to_string(curve)] = {
        {"type", "Minimal Jerk"}, {"end", curve}, {"time", "200ms"}};
  for (int row = 0; row < 64; ++row)
    for (const char* const letter : {"A", "B", "C", "D"})
      controller["state_table"][std::to_string(row)][letter] = {{"Curve", {row % 63 + 1}}};
  return nlohmann::json{{"lockstep", 1},
                        {"name", "large"},
                        {"clock", {{"servo_cycle", "1ms"}}},
                        {"technology_objects", {{"C", controller}}}}
      .dump();
}

void tell_loading() {
  const std::string text = large_project();
  const auto begin = std::chrono::steady_clock::now();
  const LoadedProject loaded = load_project(text);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  std::printf("loading a curve of 100000 points, 62 others, 64 rows of 4 motors: %.3f s (1), %zu problems\n",
              spent.count(), loaded.problems.size());
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  using namespace lockstep::bench;
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  if (!counting_instructions()) {
    tell_fleet(quick);
    tell_loading();
    std::fflush(stdout);
    if (!quick) restart_under_callgrind(argv);
  }
  std::printf("instructions; what is aimed at in brackets; 0 where they are not counted\n");
  std::printf("without motors %.1f (150)\n", instructions_of(0, 100e-6, Does::rests));
  tell_parts("at rest", Does::rests);
  tell_parts("positions", Does::positions);
  tell_parts("curves", Does::curves);
  return 0;
}
