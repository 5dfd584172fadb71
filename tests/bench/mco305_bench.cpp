// What a step of an MCO 305 takes: ./dev bench mco305 [--quick] [--instructions]
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure.hpp"
#include "projects/aposs/compiler.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep::bench {
namespace {

using mco305::SyncMode;

struct Case {
  const char* name;
  bool drive;   ///< simulated, with its machine
  bool moves;   ///< positions to and fro; else it stands in position control
  bool object;  ///< with read-outs and program, as the tick of a project has it; else the axis alone
  SyncMode mode = SyncMode::kNone;  ///< in place of positioning: it follows a virtual master
  bool inertia = false;             ///< the drive's machine is a plant: torque, friction
};

constexpr Case kCases[] = {
    {"axis, idle", false, false, false},
    {"axis, positioning", false, true, false},
    {"axis with drive, idle", true, false, false},
    {"axis with drive, positioning", true, true, false},
    {"axis, SYNCV", false, true, false, SyncMode::kVelocity},
    {"axis, SYNCP", false, true, false, SyncMode::kPosition},
    {"axis, SYNCM, windows and filters", false, true, false, SyncMode::kMarkers},
    {"axis with drive, SYNCP", true, true, false, SyncMode::kPosition},
    {"axis with drive, SYNCM, windows and filters", true, true, false, SyncMode::kMarkers},
    {"axis with drive and plant, SYNCM", true, true, false, SyncMode::kMarkers, true},
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
  if (one.inertia) object->settings.drive.plant.inertia = 0.002;
  if (one.mode == SyncMode::kMarkers) {
    object->settings.markers = {.period = 4000.0, .noise = 20.0, .seed = 1 + number};
    object->settings.master_marks = {.period = 4000.0, .noise = 20.0, .seed = 1000 + number};
    for (const auto& [parameter, value] : {std::pair{mco305::kMarkerTypeMaster, 2},
                                           {mco305::kMarkerTypeSlave, 2},
                                           {mco305::kSyncMPulsM, 4000},
                                           {mco305::kSyncMPulsS, 4000},
                                           {mco305::kSyncMWinM, 200},
                                           {mco305::kSyncMWinS, 200},
                                           {mco305::kSyncMStart, 5},
                                           {mco305::kSyncVfTime, -50'000},
                                           {mco305::kSyncMfTime, 2000}})
      object->parameters().set(parameter, value);
  }
  if (one.object) {
    const std::string text =
        one.moves ? "again:\nPOSA 100000\nPOSA 0\nGOTO again\n" : "again:\nDELAY 1000000\nGOTO again\n";
    object->programs.push_back({0, true, *aposs::compile_program("bench.m", text).image, {}, 0});
  }
  object->configure(1e-3, 1);
  if (one.mode != SyncMode::kNone) {
    object->device().master().set_acceleration(20'000);
    object->device().turn_own_master(5000);
    object->device().follow(one.mode);
    return object;
  }
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
  bool quick = false, instructions = false;
  for (int i = 1; i < argc; ++i) {
    quick = quick || std::string(argv[i]) == "--quick";
    instructions = instructions || std::string(argv[i]) == "--instructions";
  }
  if (instructions && !lockstep::bench::counting_instructions())
    lockstep::bench::restart_under_callgrind(argv);
  for (const auto& one : lockstep::bench::kCases) lockstep::bench::measure_case(one, quick);
  return 0;
}
