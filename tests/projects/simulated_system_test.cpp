// Followers on several controllers: where they are is the function of the leading value of the delay ago,
// with and without a network that loses telegrams.
#include "projects/system/simulated_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "system_files.hpp"
#include "tests/support/seeds.hpp"

namespace lockstep::simulated_system_test {
namespace {

using namespace std::chrono_literals;
using test::ControllerFile;
using test::SystemFiles;

constexpr std::int64_t kMilli = 1'000'000;
constexpr double kRing = 10.0;            // [u] of the leading axis
constexpr double kSpeed = 1000.0;         // [u/s]
constexpr double kAcceleration = 5000.0;  // [u/s²]
constexpr double kJerk = 100'000.0;       // [u/s³]

void give_limits(ControllerFile& file) {
  for (auto& [name, object] : file.json["technology_objects"].items())
    if (object["type"] == "TO_SynchronousAxis")
      object["config"]["DynamicLimits"] = {{"MaxVelocity", 1e5},
                                           {"Velocity", 1e5},
                                           {"MaxAcceleration", 1e6},
                                           {"MaxDeceleration", 1e6},
                                           {"MaxJerk", 4e6}};
}

/// The controller of the leading axis, with a local follower; `go` moves it, `back` reverses it.
ControllerFile leading(double delay, const std::string& cycle = "1ms") {
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
                 {"Velocity", back ? "-800.0" : "1000.0"},
                 {"Acceleration", "5000.0"},
                 {"Deceleration", "5000.0"},
                 {"Jerk", "100000.0"},
                 {"Execute", back ? "back" : "go"}}}});
  give_limits(file);
  return file;
}

/// PLC_2, 2 ms: a gear 7:3, and the virtual axis of a cascade, −1:1.
ControllerFile middle(double delay) {
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
ControllerFile last() {
  ControllerFile file("last", "1ms", 4);
  file.proxy("Line");
  file.proxy("Cascade");
  file.axis("OnCam", 1000.0);
  file.axis("Behind", kRing);
  file.gear("Behind", "Cascade");
  file.interconnect("OnCam", "Line");
  file.json["technology_objects"]["Curve"] = {
      {"type", "TO_Cam"},
      {"points", test::SystemJson::parse("[[0.0, 0.0], [2.5, 3.0], [6.0, 1.0], [10.0, 0.0]]")}};
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

// 2 × 4 ms at the cascade; at the leading axis the greater one of 2 × 2 ms + 8 ms and 2 × 4 ms.
constexpr double kDelayOfCascade = 0.008;
constexpr double kDelay = 0.012;

SystemFiles three(double delay = kDelay, const std::vector<std::string>& phases = {"", "", ""}) {
  SystemFiles files;
  files.add("PLC_1", leading(delay), phases[0]);
  files.add("PLC_2", middle(kDelayOfCascade), phases[1]);
  files.add("PLC_3", last(), phases[2]);
  files.area("line", "PLC_1.Leader", {"PLC_2.Line", "PLC_3.Line"});
  files.area("cascade", "PLC_2.Virtual", {"PLC_3.Cascade"});
  return files;
}

Axis& axis_of(SimulatedSystem& machine, std::size_t controller, const char* name) {
  for (Axis* const axis : machine.system().controllers[controller].project.controller->axes)
    if (axis->name == name) return *axis;
  throw std::out_of_range(name);
}

/// Where it is on a line [u].
double line_of(const Setpoint& setpoint, double ring) {
  return static_cast<double>(setpoint.position.turns) * ring + setpoint.position.value;
}

void couple(SimulatedSystem& machine) {
  machine.run_for(200ms);
  for (const SystemController& controller : machine.system().controllers)
    machine.write(controller.name + ".couple", 1.0);
  machine.run_for(200ms);
  EXPECT_EQ(machine.read("PLC_1.gear_Near.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_2.gear_Seven.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_2.gear_Virtual.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_3.gear_Behind.InGear"), 1.0);
  EXPECT_EQ(machine.read("PLC_3.cam_in.InSync"), 1.0);
}

/// The true path of the leading axis, from a controller of a finer cycle whose job begins at the same time.
class TruePath {
 public:
  TruePath() : machine_(Simulation::from_text(leading(0.0, "100us").json.dump())) {
    for (const Axis* const axis : machine_.project().controller->axes)
      if (axis->name == "Leader") leader_ = axis;
  }
  /// The motion begins at the time of the write, of which the next tick, after 1 ms or 100 µs, shows the
  /// first part.
  void write_at(std::int64_t time, const char* tag) {
    run_to(time);
    machine_.write(tag, 1.0);
  }
  void run_to(std::int64_t time) {
    while (machine_.now().count() < time) {
      const std::int64_t now = machine_.now().count();
      machine_.step();
      path_[now] = line_of(leader_->setpoint(), kRing);
    }
  }
  /// At a multiple of 100 µs.
  double at(std::int64_t time) {
    run_to(time + 1);
    return path_.at(time);
  }

 private:
  Simulation machine_;
  const Axis* leader_ = nullptr;
  std::map<std::int64_t, double> path_;
};

struct Worst {
  double ramps = 0.0;   // [u of the leading axis]
  double cruise = 0.0;  // the same, where the leading axis has stood at its velocity for long
  std::map<std::string, double> each;
};

/// Runs all controllers through a motion, and compares each follower with the function of the true path.
Worst worst_of(SimulatedSystem& machine, std::int64_t delay, std::chrono::milliseconds cruise) {
  couple(machine);
  TruePath truth;
  const CamFunction* curve = nullptr;
  for (const auto& object : machine.system().controllers[2].project.controller->objects)
    if (object->name == "Curve") curve = &static_cast<const Cam&>(*object).function();
  struct Follower {
    std::size_t controller;
    Axis& axis;
    std::function<double(double)> expected;  // of the leading value on a line
    double steepness;                        // of that function
  };
  const std::vector<Follower> followers = {
      {0, axis_of(machine, 0, "Near"), [](double x) { return x; }, 1.0},
      {1, axis_of(machine, 1, "Seven"), [](double x) { return x * 7.0 / 3.0; }, 7.0 / 3.0},
      {1, axis_of(machine, 1, "Virtual"), nullptr, 1.0},
      {2, axis_of(machine, 2, "OnCam"),
       [curve](double x) { return curve->value(x - std::floor(x / kRing) * kRing).position; }, 2.0},
      {2, axis_of(machine, 2, "Behind"), [](double x) { return -x; }, 1.0}};
  Worst worst;
  const auto look = [&](std::int64_t until, bool cruising) {
    while (machine.now() < until) {
      const std::size_t controller = machine.next();
      const std::int64_t now = machine.now();
      const Controller& its = *machine.system().controllers[controller].project.controller;
      const bool interpolates = its.interpolator_is_due();
      machine.step();
      if (!interpolates) continue;
      for (const Follower& one : followers) {
        if (one.controller != controller || !one.expected) continue;
        const double is = line_of(one.axis.setpoint(), one.axis.modulo().length);
        const double error = std::abs(is - one.expected(truth.at(now - delay))) / one.steepness;
        double& worse = cruising ? worst.cruise : worst.ramps;
        worse = std::max(worse, error);
        worst.each[one.axis.name] = std::max(worst.each[one.axis.name], error);
      }
    }
  };
  const auto command = [&](const char* tag) {
    while (machine.next() != 0) machine.step();
    truth.write_at(machine.now(), tag);
    machine.write(std::string("PLC_1.") + tag, 1.0);
  };
  command("go");
  look(machine.now() + 500 * kMilli, false);
  look(machine.now() + cruise.count() * kMilli, true);
  command("back");
  look(machine.now() + 800 * kMilli, false);
  look(machine.now() + cruise.count() * kMilli / 4, true);
  return worst;
}

/// 10⁴ turns of the leading axis in a soak; here a hundredth.
std::chrono::milliseconds cruise() {
  return std::chrono::milliseconds(test::cases(1000, 100'000));
}

/// With the calculated delays, in phase: nothing but rounding, in the ramps as well.
TEST(SimulatedSystem, LeadsAllFollowersToTheFunctionOfTheDelayedLeadingValue) {
  SimulatedSystem machine(three().path());
  const Worst worst = worst_of(machine, 12 * kMilli, cruise());
  for (const auto& [name, error] : worst.each) std::printf("%s %.3g\n", name.c_str(), error);
  EXPECT_LE(worst.cruise, 1e-9);
  EXPECT_LE(worst.ramps, 1e-9);
  EXPECT_GT(axis_of(machine, 0, "Leader").setpoint().position.turns, test::cases(50, 5000));
  EXPECT_LE(machine.read("PLC_2.Line.StatusExternalLeadingValue.AdjustmentTime"), 0.0);
  EXPECT_LE(machine.read("PLC_3.Line.StatusExternalLeadingValue.AdjustmentTime"), 0.0);
  EXPECT_LE(machine.read("PLC_3.Cascade.StatusExternalLeadingValue.AdjustmentTime"), 0.0);
}

/// Out of phase values are asked for between those of telegrams: within J · h³ / 160 of both interpolations
/// that lie between the leading axis and the follower of the cascade, 1 ms and 2 ms.
TEST(SimulatedSystem, InterpolatesWithinTheWrittenBoundWhereControllersAreOutOfPhase) {
  SimulatedSystem machine(three(kDelay, {"", "700us", "300us"}).path());
  const Worst worst = worst_of(machine, 12 * kMilli, 1000ms);
  for (const auto& [name, error] : worst.each) std::printf("%s %.3g\n", name.c_str(), error);
  EXPECT_LE(worst.cruise, 1e-9);
  const auto bound = [](double h) { return kJerk * h * h * h / 160.0; };
  EXPECT_LE(worst.ramps, bound(0.001) + bound(0.002));
  EXPECT_GT(worst.ramps, 1e-9) << "it is interpolated indeed";
}

/// With D = 0 the value is extrapolated. What was extrapolated by t of a path of jerk J is J · t³ / 6 beside
/// it, and that goes to zero over T = 8 cycles and 4 t: while the acceleration changes J · (t + T)³ / 6 at
/// most.
TEST(SimulatedSystem, ExtrapolatesWithinTheWrittenBoundWithoutDelay) {
  SystemFiles files;
  files.add("PLC_1", leading(0.0));
  ControllerFile other("other", "2ms");
  other.proxy("Line");
  other.axis("Far", kRing);
  other.gear("Far", "Line");
  give_limits(other);
  files.add("PLC_2", other);
  files.area("line", "PLC_1.Leader", {"PLC_2.Line"});
  SimulatedSystem machine(files.path());
  machine.run_for(200ms);
  machine.write("PLC_2.couple", 1.0);
  machine.run_for(200ms);
  ASSERT_EQ(machine.read("PLC_2.gear_Far.InGear"), 1.0);
  machine.write("PLC_1.go", 1.0);
  double worst = 0.0;
  double cruising = 0.0;
  for (int i = 0; i < 1000; ++i) {
    machine.run_for(2ms);
    const double error = std::abs(line_of(axis_of(machine, 0, "Leader").setpoint(), kRing) -
                                  line_of(axis_of(machine, 1, "Far").setpoint(), kRing));
    // The leading axis has had one more tick.
    const double ahead = 0.001 * machine.read("PLC_1.Leader.Velocity");
    (i < 500 ? worst : cruising) = std::max(i < 500 ? worst : cruising, std::abs(error - ahead));
  }
  EXPECT_GT(machine.read("PLC_2.Line.StatusExternalLeadingValue.AdjustmentTime"), 0.0);
  const double t = 0.001;
  const double back = 8 * 0.002 + 4 * t;
  EXPECT_LE(worst, kJerk * std::pow(t + back, 3) / 6.0 + 0.5 * kAcceleration * 1e-6);
  EXPECT_GT(worst, 1e-9);
  EXPECT_LE(cruising, 1e-9);
}

// ---- With a network that is none of the best

/// Every setpoint of every axis, to the bit.
std::uint64_t fingerprint(SimulatedSystem& machine, std::uint64_t before) {
  std::uint64_t hash = before;
  const auto add = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 0x100000001b3u;
  };
  for (const SystemController& controller : machine.system().controllers)
    for (const Axis* const axis : controller.project.controller->axes) {
      add(axis->setpoint().position.value);
      add(axis->setpoint().velocity);
    }
  return hash;
}

SystemFiles lossy(std::uint64_t seed) {
  SystemFiles files = three(0.016);  // a cycle of the slowest more than calculated
  files.json["simulated_network"] = {{"latency", "800us"}, {"jitter", "600us"},  {"loss", 0.01},
                                     {"duplicates", 0.01}, {"reordering", 0.01}, {"seed", seed}};
  return files;
}

struct Lossy {
  std::uint64_t bits = 14695981039346656037u;
  double steepest = 0.0;  // acceleration between two ticks in terms of that of the leading axis
};

/// Latency, jitter, 1 % loss, duplicates, reordering. No follower steps: neither its position beyond what its
/// velocities say, nor its velocity beyond a few times the acceleration of the leading axis.
Lossy run_lossy(std::uint64_t seed, std::chrono::milliseconds time) {
  SimulatedSystem machine(lossy(seed).path());
  couple(machine);
  machine.write("PLC_1.go", 1.0);
  struct Last {
    Setpoint setpoint;
    std::int64_t time = -1;
  };
  std::map<const Axis*, Last> last_of;
  Lossy result;
  const std::int64_t end = machine.now() + time.count() * kMilli;
  bool turned = false;
  while (machine.now() < end) {
    if (!turned && machine.now() > end - time.count() * kMilli / 2) {
      machine.write("PLC_1.back", 1.0);
      turned = true;
    }
    const std::size_t controller = machine.next();
    const std::int64_t now = machine.now();
    const Controller& its = *machine.system().controllers[controller].project.controller;
    const bool interpolates = its.interpolator_is_due();
    machine.step();
    if (!interpolates) continue;
    for (const Axis* const axis : its.axes) {
      if (axis->name == "OnCam") continue;  // its curve has its own accelerations
      const Setpoint& setpoint = axis->setpoint();
      Last& last = last_of[axis];
      if (last.time >= 0) {
        const double h = static_cast<double>(now - last.time) * 1e-9;
        const double ratio = axis->name == "Seven" ? 7.0 / 3.0 : 1.0;
        const double acceleration =
            std::abs(setpoint.velocity - last.setpoint.velocity) / h / ratio / kAcceleration;
        result.steepest = std::max(result.steepest, acceleration);
        const double moved = line_of(setpoint, kRing) - line_of(last.setpoint, kRing);
        const double said = 0.5 * (setpoint.velocity + last.setpoint.velocity) * h;
        EXPECT_NEAR(moved, said, 3.0 * ratio * kAcceleration * h * h)
            << axis->name << " at " << now << " [ns]";
      }
      last = {setpoint, now};
    }
    result.bits = fingerprint(machine, result.bits);
    if (testing::Test::HasFailure()) break;
  }
  for (const char* const proxy : {"PLC_2.Line", "PLC_3.Line", "PLC_3.Cascade"})
    EXPECT_EQ(machine.read(std::string(proxy) + ".ErrorDetail.Number"), 0.0) << proxy;
  EXPECT_GT(machine.lost(), 0u);
  return result;
}

TEST(SimulatedSystem, StepsNoFollowerWhateverItsNetworkDoesToTelegrams) {
  const std::uint64_t seed = test::seed_of_run(7);
  const std::chrono::milliseconds time(test::cases(3000, 300'000));
  const Lossy once = run_lossy(seed, time);
  std::printf("steepest %.3f times the acceleration of the leading axis\n", once.steepest);
  EXPECT_LE(once.steepest, 3.0);
}

TEST(SimulatedSystem, GivesTheSameBitsTwice) {
  EXPECT_EQ(run_lossy(7, 1000ms).bits, run_lossy(7, 1000ms).bits);
  EXPECT_NE(run_lossy(7, 1000ms).bits, run_lossy(8, 1000ms).bits) << "another seed loses other telegrams";
}

// ---- Many

/// One leading axis, 99 proxies on as many controllers, four cascades deep: all followers at the same place.
TEST(SimulatedSystem, LeadsNinetyNineProxiesInFourCascades) {
  constexpr int kDeep = 4;
  SystemFiles files;
  ControllerFile first = leading(0.002 * kDeep);
  files.add("C0", first);
  std::vector<std::vector<std::string>> levels(kDeep);
  for (int i = 1; i < 100; ++i) {
    const int level = (i - 1) % kDeep;
    const bool provides = i <= kDeep && level + 1 < kDeep;  // the first one of each level leads the next one
    const double delay = provides ? 0.002 * (kDeep - 1 - level) : 0.0;
    ControllerFile file("follower");
    file.proxy("Line", 0.1, delay);
    file.axis("Far", kRing);
    file.gear("Far", "Line", 1, 1, provides ? "delayed" : "setpoint");
    if (provides) {
      file.axis("Virtual", kRing);
      file.provide("Virtual", delay);
      file.gear("Virtual", "Line");
    }
    give_limits(file);
    const std::string name = "C" + std::to_string(i);
    files.add(name, file);
    levels[static_cast<std::size_t>(level)].push_back(name + ".Line");
  }
  for (int level = 0; level < kDeep; ++level)
    files.area("level" + std::to_string(level),
               level == 0 ? "C0.Leader" : "C" + std::to_string(level) + ".Virtual",
               levels[static_cast<std::size_t>(level)]);
  SimulatedSystem machine(files.path());
  machine.run_for(100ms);
  for (int i = 0; i < 100; ++i) machine.write("C" + std::to_string(i) + ".couple", 1.0);
  machine.run_for(100ms);
  machine.write("C0.go", 1.0);
  machine.run_for(std::chrono::milliseconds(test::cases(300, 30'000)));
  const double near = line_of(axis_of(machine, 0, "Near").setpoint(), kRing);
  EXPECT_GT(near, 50.0);
  for (std::size_t i = 1; i < 100; ++i)
    EXPECT_NEAR(line_of(axis_of(machine, i, "Far").setpoint(), kRing), near, 1e-9) << i;
}

}  // namespace
}  // namespace lockstep::simulated_system_test
