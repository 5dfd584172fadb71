// What a step of an MCO 305 takes: ./dev bench mco305 [--quick]
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "bench/measure.hpp"
#include "projects/aposs/compiler.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep::bench {
namespace {

struct Case {
  const char* name;
  bool drive;   ///< simulated, with its machine
  bool moves;   ///< positions to and fro; else it stands in position control
  bool object;  ///< with read-outs and program, as the tick of a project has it; else the axis alone
};

constexpr Case kCases[] = {
    {"axis, idle", false, false, false},
    {"axis, positioning", false, true, false},
    {"axis with drive, idle", true, false, false},
    {"axis with drive, positioning", true, true, false},
    {"object with program, idle", false, false, true},
    {"object with program, positioning", false, true, true},
    {"object, drive and program, positioning", true, true, true},
};

constexpr int kDevices = 128;

std::unique_ptr<Mco305> device_of(const Case& one, int number) {
  auto object = std::make_unique<Mco305>("Device", DB_ANY{1});
  object->settings.has_drive = one.drive;
  object->settings.drive.time_constant = 0.003;
  object->parameters().set(mco305::kFFVel, 10'486);
  object->parameters().set(mco305::kPosErr, 1'000'000);
  if (one.object) {
    const std::string text =
        one.moves ? "again:\nPOSA 100000\nPOSA 0\nGOTO again\n" : "again:\nDELAY 1000000\nGOTO again\n";
    object->programs.push_back({0, true, *aposs::compile_program("bench.m", text).image, {}, 0});
  }
  object->configure(1e-3, 1);
  if (one.moves && !one.object) object->device().position_to(1'000'000'000 - number, false);
  return object;
}

void measure_case(const Case& one, bool quick) {
  std::vector<std::unique_ptr<Mco305>> devices;
  for (int i = 0; i < kDevices; ++i) devices.push_back(device_of(one, i));
  std::int64_t now = 0;
  const auto work = [&](int calls) {
    for (int i = 0; i < calls; ++i) {
      for (const auto& object : devices) {
        if (one.object) {
          object->servo(now);
          object->run_program(now);
        } else {
          object->device().servo(true);
        }
      }
      now += 1'000'000;
    }
  };
  work(1000);  // past the ramps of those that move without an end
  const Timing timing = measure(work, {.runs = quick ? 1 : 9, .calls = quick ? 10 : 2000});
  const auto instructions = static_cast<double>(count_instructions([&] { work(10); })) / (10.0 * kDevices);
  std::printf("%-40s %8.1f ns a step", one.name, timing.mean / kDevices);
  if (instructions > 0.0) std::printf(" %8.1f instructions", instructions);
  std::printf("\n");
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  for (const auto& one : lockstep::bench::kCases) lockstep::bench::measure_case(one, quick);
  return 0;
}
