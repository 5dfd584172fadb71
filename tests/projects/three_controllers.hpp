/// Three controllers with application cycles of 1, 2 and 4 ms: a leading axis on a ring, followers by gears
/// and a cam, and a cascade; and the path of the leading axis as computed by hand.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "projects/system/apply_delays.hpp"
#include "projects/system/connections.hpp"
#include "projects/system/simulated_system.hpp"
#include "system_files.hpp"

namespace lockstep::test {

inline constexpr std::int64_t kMilli = 1'000'000;
inline constexpr double kRing = 10.0;            // [u] of the leading axis
inline constexpr double kSpeed = 1000.0;         // [u/s] by `go`
inline constexpr double kBackwards = -800.0;     // [u/s] by `back`
inline constexpr double kAcceleration = 5000.0;  // [u/s²]
inline constexpr double kJerk = 97'000.0;        // [u/s³], whose ramps end between two cycles

inline void give_limits(ControllerFile& file) {
  for (auto& [name, object] : file.json["technology_objects"].items())
    if (object["type"] == "TO_SynchronousAxis")
      object["config"]["DynamicLimits"] = {{"MaxVelocity", 1e5},
                                           {"Velocity", 1e5},
                                           {"MaxAcceleration", 1e6},
                                           {"MaxDeceleration", 1e6},
                                           {"MaxJerk", 4e6}};
}

/// The controller of the leading axis, with a local follower; `go` moves it, `back` reverses it.
inline ControllerFile leading(double delay, const std::string& cycle = "1ms") {
  ControllerFile file("leading", cycle);
  file.axis("Leader", kRing);
  file.axis("Near", kRing);
  file.provide("Leader", delay);
  file.gear("Near", "Leader", 1, 1, "delayed");
  for (const char* const tag : {"go", "back"}) file.json["tags"][tag]["type"] = "BOOL";
  for (const bool back : {false, true})
    file.call({{"fb", "MC_MoveVelocity"},
               {"name", back ? "turn" : "run"},
               {"in",
                {{"Axis", "Leader"},
                 {"Velocity", std::to_string(back ? kBackwards : kSpeed)},
                 {"Acceleration", std::to_string(kAcceleration)},
                 {"Deceleration", std::to_string(kAcceleration)},
                 {"Jerk", std::to_string(kJerk)},
                 {"Execute", back ? "back" : "go"}}}});
  give_limits(file);
  return file;
}

/// PLC_2, 2 ms: a gear 7:3, and the virtual axis of a cascade, −1:1.
inline ControllerFile middle(double delay) {
  ControllerFile file("middle", "2ms");
  file.proxy("Line", 0.1, delay);
  file.axis("Seven", kRing);
  file.axis("Virtual", kRing);
  file.provide("Virtual", delay);
  file.gear("Seven", "Line", 7, 3, "delayed");
  file.gear("Virtual", "Line", -1, 1);
  give_limits(file);
  return file;
}

/// PLC_3, 4 ms: a cam on the leading axis, and a follower of the cascade.
inline ControllerFile last() {
  ControllerFile file("last", "1ms", 4);
  file.proxy("Line");
  file.proxy("Cascade");
  file.axis("OnCam", 1000.0);
  file.axis("Behind", kRing);
  file.gear("Behind", "Cascade");
  file.interconnect("OnCam", "Line");
  file.json["technology_objects"]["Curve"] = {
      {"type", "TO_Cam"}, {"points", SystemJson::parse("[[0.0, 0.0], [2.5, 3.0], [6.0, 1.0], [10.0, 0.0]]")}};
  file.call(
      {{"fb", "MC_Home"},
       {"name", "home"},
       {"in", {{"Axis", "OnCam"}, {"Mode", "0"}, {"Position", "0.0"}, {"Execute", "power_OnCam.Status"}}}});
  file.call({{"fb", "MC_CamIn"},
             {"name", "cam_in"},
             {"in",
              {{"Master", "Line"},
               {"Slave", "OnCam"},
               {"Cam", "Curve"},
               {"SyncProfileReference", "2"},
               {"ApplicationMode", "1"},
               {"Execute", "couple"}}}});
  give_limits(file);
  return file;
}

/// All three, with their delays: of the leading axis, and of the cascade.
inline SystemFiles three(double delay, double delay_of_cascade,
                         const std::vector<std::string>& phases = {"", "", ""}) {
  SystemFiles files;
  files.add("PLC_1", leading(delay), phases[0]);
  files.add("PLC_2", middle(delay_of_cascade), phases[1]);
  files.add("PLC_3", last(), phases[2]);
  files.area("line", "PLC_1.Leader", {"PLC_2.Line", "PLC_3.Line"});
  files.area("cascade", "PLC_2.Virtual", {"PLC_3.Cascade"});
  return files;
}

/// Puts the delays that `lockstep connections --calculate --apply` computes into the files.
/// @return that of the leading axis [ns]
inline std::int64_t apply_calculated_delays(const SystemFiles& files) {
  const LoadedSystem loaded = load_system_file(files.path(), LoadedFor::looking);
  for (const Problem& problem : loaded.problems) ADD_FAILURE() << to_string("system.json", problem);
  const Connections connections(loaded.system.value());
  for (const ChangedFile& file : with_delays(*loaded.system, connections).files)
    replace_file(file.path, file.text);
  for (const DelayTime& delay : connections.delays())
    if (delay.object.object->name == "Leader") return std::llround(*delay.computed * 1e9);
  ADD_FAILURE() << "no delay of Leader";
  return 0;
}

inline Axis& axis_of(SimulatedSystem& machine, std::size_t controller, const std::string& name) {
  for (Axis* const axis : machine.system().controllers[controller].project.controller->axes)
    if (axis->name == name) return *axis;
  throw std::out_of_range(name);
}

inline LeadingAxisProxy& proxy_of(SimulatedSystem& machine, std::size_t controller, const std::string& name) {
  for (const auto& object : machine.system().controllers[controller].project.controller->objects)
    if (object->name == name) return static_cast<LeadingAxisProxy&>(*object);
  throw std::out_of_range(name);
}

/// Where it is on a line [u].
inline double line_of(const Setpoint& setpoint, double ring) {
  return static_cast<double>(setpoint.position.turns) * ring + setpoint.position.value;
}

/// Couples all followers, with the leading axis at rest at 0.
inline void couple(SimulatedSystem& machine) {
  machine.run_for(std::chrono::milliseconds(200));
  for (const SystemController& controller : machine.system().controllers)
    machine.write(controller.name + ".couple", 1.0);
  machine.run_for(std::chrono::milliseconds(200));
  EXPECT_EQ(machine.read("PLC_1.gear_Near.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_2.gear_Seven.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_2.gear_Virtual.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_3.gear_Behind.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_3.cam_in.InSync"), 1.0);
}

/// The path of the leading axis by hand: from one velocity to the next by jerk, constant acceleration and
/// jerk, with the highest acceleration and jerk of its jobs.
class PathByHand {
 public:
  /// A job begins. @param time [ns] not before that of the last one, whose ramp is over
  void change(std::int64_t time, double velocity) {
    const Point from = at(time);
    const double by = velocity - from.velocity;
    jobs_.push_back({time, from, std::copysign(1.0, by), kAcceleration / kJerk,
                     std::abs(by) / kAcceleration - kAcceleration / kJerk});
    EXPECT_GE(jobs_.back().constant, 0.0) << "a ramp without constant acceleration";
  }
  /// [u] on a line
  double position(std::int64_t time) const { return at(time).position; }

 private:
  struct Point {
    double position = 0.0;
    double velocity = 0.0;
  };
  struct JobByHand {
    std::int64_t begin;  // [ns]
    Point from;
    double sign;
    double jerked;    // [s] twice
    double constant;  // [s] between them
  };
  Point at(std::int64_t time) const {
    const auto behind = std::ranges::upper_bound(jobs_, time, {}, &JobByHand::begin);
    if (behind == jobs_.begin()) return {};
    const JobByHand& job = *(behind - 1);
    double left = static_cast<double>(time - job.begin) * 1e-9;
    Point point = job.from;
    double acceleration = 0.0;
    const std::pair<double, double> parts[] = {
        {job.jerked, kJerk}, {job.constant, 0.0}, {job.jerked, -kJerk}};
    for (const auto& [duration, jerk] : parts) {
      const double t = std::min(left, duration);
      const double j = job.sign * jerk;
      point.position += t * (point.velocity + t * (acceleration / 2.0 + t * j / 6.0));
      point.velocity += t * (acceleration + t * j / 2.0);
      acceleration += t * j;
      left -= t;
    }
    if (left > 0.0) point.position += left * point.velocity;
    return point;
  }
  std::vector<JobByHand> jobs_;
};

/// A follower, and what it has to be at a place of the leading axis on a line.
struct Followed {
  std::string name;
  std::size_t controller;
  std::string proxy;  // that it follows; empty: it is behind the delay at home
  std::function<double(double)> function;
  double steepness;  // of that function
};

/// The steepest slope of the cam [u/u].
inline double steepness_of(const CamFunction& curve) {
  double steepest = 0.0;
  for (double x = 0.0; x <= kRing; x += 1e-3)
    steepest = std::max(steepest, std::abs(curve.value(x).first_derivative));
  return steepest;
}

/// All followers. `Virtual` is ahead of the others, by the delay of the cascade.
inline std::vector<Followed> followers_of(SimulatedSystem& machine) {
  const CamFunction* curve = nullptr;
  for (const auto& object : machine.system().controllers[2].project.controller->objects)
    if (object->name == "Curve") curve = &static_cast<const Cam&>(*object).function();
  return {{"Near", 0, "", [](double x) { return x; }, 1.0},
          {"Seven", 1, "Line", [](double x) { return x * 7.0 / 3.0; }, 7.0 / 3.0},
          {"Virtual", 1, "Line", [](double x) { return -x; }, 1.0},
          {"OnCam", 2, "Line",
           [curve](double x) { return curve->value(x - std::floor(x / kRing) * kRing).position; },
           steepness_of(*curve)},
          {"Behind", 2, "Cascade", [](double x) { return -x; }, 1.0}};
}

}  // namespace lockstep::test
