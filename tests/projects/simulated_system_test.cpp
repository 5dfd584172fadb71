// Followers on several controllers: where they are is the function of the leading value of the delay ago.
// The leading axis is compared with its path as computed by hand.
#include "projects/system/simulated_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/support/seeds.hpp"
#include "three_controllers.hpp"

namespace lockstep::simulated_system_test {
namespace {

using namespace std::chrono_literals;
using test::apply_calculated_delays;
using test::axis_of;
using test::ControllerFile;
using test::couple;
using test::Followed;
using test::followers_of;
using test::kAcceleration;
using test::kJerk;
using test::kMilli;
using test::kRing;
using test::leading;
using test::line_of;
using test::PathByHand;
using test::SystemFiles;
using test::three;

/// Largest difference of a follower from its function, in [u] of the leading axis: over all of the motion,
/// and where the leading axis has had its velocity for long.
struct Worst {
  std::map<std::string, double> ramps;
  std::map<std::string, double> cruise;

  static double of(const std::map<std::string, double>& all) {
    double largest = 0.0;
    for (const auto& [name, error] : all) largest = std::max(largest, error);
    return largest;
  }
};

/// Runs all controllers through a motion with jerk, forwards and backwards, and looks at each follower in
/// each of its application cycles.
class Motion {
 public:
  Motion(SimulatedSystem& machine, std::int64_t delay)
      : machine_(machine), delay_(delay), followers_(followers_of(machine)) {}

  /// @param cruise forwards; backwards a quarter of it
  Worst run(std::chrono::milliseconds cruise) {
    couple(machine_);
    change("go", test::kSpeed);
    look(500 * kMilli, worst_.ramps);
    look(cruise.count() * kMilli, worst_.cruise);
    change("back", test::kBackwards);
    look(800 * kMilli, worst_.ramps);
    look(cruise.count() * kMilli / 4, worst_.cruise);
    return worst_;
  }
  /// Rounds that the leading axis has made, forwards and backwards.
  double rounds() const { return rounds_; }

 private:
  /// Before a tick of the leading controller, from whose time on the job moves its axis.
  void change(const char* tag, double velocity) {
    while (machine_.next() != 0) machine_.step();
    machine_.write(std::string("PLC_1.") + tag, 1.0);
    path_.change(machine_.now(), velocity);
  }

  void look(std::int64_t time, std::map<std::string, double>& worst) {
    const std::int64_t begin = machine_.now();
    while (machine_.now() < begin + time) {
      const std::size_t controller = machine_.next();
      const std::int64_t now = machine_.now();
      const bool interpolates =
          machine_.system().controllers[controller].project.controller->interpolator_is_due();
      machine_.step();
      if (!interpolates) continue;
      for (const Followed& one : followers_) {
        if (one.controller != controller || one.name == "Virtual") continue;
        const Axis& axis = axis_of(machine_, controller, one.name);
        const double expected = one.function(path_.position(now - delay_));
        const double error = std::abs(line_of(axis.setpoint(), axis.modulo().length) - expected);
        worst[one.name] = std::max(worst[one.name], error / one.steepness);
      }
    }
    rounds_ += std::abs(path_.position(machine_.now()) - path_.position(begin)) / kRing;
  }

  SimulatedSystem& machine_;
  const std::int64_t delay_;  // [ns]
  const std::vector<Followed> followers_;
  PathByHand path_;
  Worst worst_;
  double rounds_ = 0.0;
};

/// 10⁴ rounds of the leading axis in a soak; here a hundredth.
std::chrono::milliseconds cruise() {
  return std::chrono::milliseconds(test::cases(1000, 100'000));
}

void expect_interpolation(SimulatedSystem& machine) {
  for (const char* const proxy : {"PLC_2.Line", "PLC_3.Line", "PLC_3.Cascade"}) {
    EXPECT_LE(machine.read(std::string(proxy) + ".StatusExternalLeadingValue.AdjustmentTime"), 0.0) << proxy;
    EXPECT_EQ(machine.read(std::string(proxy) + ".ErrorDetail.Number"), 0.0) << proxy;
  }
}

/// With the delays as `lockstep connections` computes them, in phase: nothing but rounding, in the ramps as
/// well.
TEST(SimulatedSystem, LeadsAllFollowersToTheFunctionOfTheDelayedLeadingValue) {
  const SystemFiles files = three(0.0, 0.0);
  const std::int64_t delay = apply_calculated_delays(files);
  EXPECT_EQ(delay, 12 * kMilli) << "2 × 2 ms and the 2 × 4 ms of the cascade";
  SimulatedSystem machine(files.path());
  Motion motion(machine, delay);
  const Worst worst = motion.run(cruise());
  for (const auto& [name, error] : worst.ramps)
    std::printf("%s %.3g, cruising %.3g\n", name.c_str(), error, worst.cruise.at(name));
  EXPECT_LE(Worst::of(worst.cruise), 1e-9);
  EXPECT_LE(Worst::of(worst.ramps), 1e-9);
  EXPECT_GE(motion.rounds(), test::cases(100, 10'000));
  expect_interpolation(machine);
}

/// Bounds of the interpolation between values h [s] apart of a path whose jerk is J: of position, velocity
/// and acceleration (tech_objects/leading_values/README.md).
double of_position(double h) {
  return kJerk * h * h * h / 160.0;
}
double of_velocity(double h) {
  return kJerk * h * h / 45.0;
}
double of_acceleration(double h) {
  return kJerk * h / 4.8;
}
/// What is interpolated between values h apart that have been interpolated themselves, between values g
/// apart: the error of its own, and those of the values by their weights.
double of_cascade(double g, double h) {
  return of_position(h) + of_position(g) + 0.3125 * h * of_velocity(g) + 0.03125 * h * h * of_acceleration(g);
}

class OutOfPhase : public testing::TestWithParam<std::vector<std::string>> {};

/// Values are asked for between those of telegrams: 1 ms apart those of the leading axis, 2 ms those of the
/// cascade.
TEST_P(OutOfPhase, IsInterpolatedWithinTheWrittenBound) {
  const SystemFiles files = three(0.0, 0.0, GetParam());
  const std::int64_t delay = apply_calculated_delays(files);
  SimulatedSystem machine(files.path());
  const Worst worst = Motion(machine, delay).run(1000ms);
  EXPECT_LE(Worst::of(worst.cruise), 1e-9);
  for (const auto& [name, bound] : {std::pair{"Near", 1e-9},
                                    {"Seven", of_position(0.001) + 1e-9},
                                    {"OnCam", of_position(0.001) + 1e-9},
                                    {"Behind", of_cascade(0.001, 0.002) + 1e-9}}) {
    std::printf("%s %.3g of %.3g\n", name, worst.ramps.at(name), bound);
    EXPECT_LE(worst.ramps.at(name), bound) << name;
  }
  EXPECT_GT(worst.ramps.at("Behind"), 1e-8) << "it is interpolated indeed";
  expect_interpolation(machine);
}

INSTANTIATE_TEST_SUITE_P(Phases, OutOfPhase,
                         testing::Values(std::vector<std::string>{"", "700us", "300us"},
                                         std::vector<std::string>{"500us", "", "250us"},
                                         std::vector<std::string>{"900us", "1300us", "100us"}));

/// What was extrapolated by t of a path of jerk J is J · t³ / 6 beside it, and that goes to zero over
/// T = 8 cycles and 4 t; meanwhile there is more of it. All of it is no more than J · (t + T)³ / 30.
double of_extrapolation(double t, double cycle) {
  const double back = 8.0 * cycle + 4.0 * t;
  return kJerk * std::pow(t + back, 3) / 30.0;
}

class WithoutDelay : public testing::TestWithParam<const char*> {};

/// D = 0: the value is extrapolated.
TEST_P(WithoutDelay, IsExtrapolatedWithinTheWrittenBound) {
  SystemFiles files;
  files.add("PLC_1", leading(0.0));
  ControllerFile other("other", GetParam());
  other.proxy("Line");
  other.axis("Far", kRing);
  other.gear("Far", "Line");
  give_limits(other);
  files.add("PLC_2", other);
  files.area("line", "PLC_1.Leader", {"PLC_2.Line"});
  SimulatedSystem machine(files.path());
  const Axis& far = axis_of(machine, 1, "Far");
  const double cycle =
      1e-9 * static_cast<double>(machine.system().controllers[1].project.controller->clock.servo_cycle);
  machine.run_for(200ms);
  machine.write("PLC_2.couple", 1.0);
  machine.run_for(200ms);
  ASSERT_EQ(machine.read("PLC_2.gear_Far.InGear"), 1.0);
  PathByHand path;
  double worst = 0.0;
  double cruising = 0.0;
  double extrapolated = 0.0;
  const auto look = [&](std::int64_t time, double& largest) {
    for (const std::int64_t end = machine.now() + time; machine.now() < end;) {
      const std::size_t controller = machine.next();
      const std::int64_t now = machine.now();
      machine.step();
      if (controller != 1) continue;
      largest = std::max(largest, std::abs(line_of(far.setpoint(), kRing) - path.position(now)));
      extrapolated =
          std::max(extrapolated, machine.read("PLC_2.Line.StatusExternalLeadingValue.AdjustmentTime"));
    }
  };
  for (const auto& [tag, velocity] : {std::pair{"go", test::kSpeed}, {"back", test::kBackwards}}) {
    while (machine.next() != 0) machine.step();
    machine.write(std::string("PLC_1.") + tag, 1.0);
    path.change(machine.now(), velocity);
    look(800 * kMilli, worst);
    look(500 * kMilli, cruising);
  }
  EXPECT_NEAR(extrapolated, 0.001, 1e-9) << "by a cycle of the source";
  const double bound = of_extrapolation(extrapolated, std::max(cycle, 0.001));
  std::printf("%.3g of %.3g, cruising %.3g\n", worst, bound, cruising);
  EXPECT_LE(worst, bound);
  EXPECT_GT(worst, bound / 100.0) << "the formula tells nothing";
  EXPECT_LE(cruising, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Cycles, WithoutDelay, testing::Values("1ms", "2ms", "4ms"));

/// Between the proxy and the virtual axis that passes the value on there is another axis: with the delays
/// that are computed what follows behind the cascade is where the local follower is.
TEST(SimulatedSystem, LeadsWhatFollowsTwoHopsBehindAProxyToTheSamePlace) {
  SystemFiles files;
  files.add("PLC_1", leading(0.0));
  ControllerFile middle("middle", "2ms");
  middle.proxy("Line", 0.1);
  for (const char* const axis : {"Draw", "Virtual"}) middle.axis(axis, kRing);
  middle.gear("Draw", "Line");
  middle.gear("Virtual", "Draw");
  middle.provide("Virtual", 0.0);
  give_limits(middle);
  files.add("PLC_2", middle);
  ControllerFile far("far", "4ms");
  far.proxy("Line");
  far.axis("Far", kRing);
  far.gear("Far", "Line");
  give_limits(far);
  files.add("PLC_3", far);
  files.area("line", "PLC_1.Leader", {"PLC_2.Line"});
  files.area("cascade", "PLC_2.Virtual", {"PLC_3.Line"});
  EXPECT_EQ(apply_calculated_delays(files), 12 * kMilli);
  SimulatedSystem machine(files.path());
  machine.run_for(200ms);
  for (const char* const controller : {"PLC_1", "PLC_2", "PLC_3"})
    machine.write(std::string(controller) + ".couple", 1.0);
  machine.run_for(200ms);
  machine.write("PLC_1.go", 1.0);
  const Axis& near = axis_of(machine, 0, "Near");
  const Axis& behind = axis_of(machine, 2, "Far");
  std::vector<double> path;  // of the local follower, by milliseconds
  const std::int64_t begin = machine.now();
  double worst = 0.0;
  while (machine.now() < begin + 800 * kMilli) {
    const std::size_t controller = machine.next();
    machine.step();
    if (controller == 0) path.push_back(line_of(near.setpoint(), kRing));
    if (controller == 2 && !path.empty())
      worst = std::max(worst, std::abs(line_of(behind.setpoint(), kRing) - path.back()));
  }
  EXPECT_GT(path.back(), 100.0);
  EXPECT_LE(worst, 1e-9);
}

/// A cascade that loses its leading value comes to rest, and who follows it follows that, without an alarm.
TEST(SimulatedSystem, BringsWhatFollowsACascadeToRestWhereThatIsLost) {
  SystemFiles files = three(0.012, 0.008);
  SimulatedSystem machine(files.path());
  couple(machine);
  machine.write("PLC_1.go", 1.0);
  machine.run_for(1000ms);
  const Axis& virtual_axis = axis_of(machine, 1, "Virtual");
  const Axis& behind = axis_of(machine, 2, "Behind");
  ASSERT_NEAR(machine.read("PLC_3.Behind.Velocity"), -1000.0, 1e-6);
  // From now on a controller sends that has been started anew.
  LeadingAxisProxy& proxy = test::proxy_of(machine, 1, "Line");
  LeadingValueTelegram telegram;
  telegram.sequence = 1;
  telegram.run = 5;
  telegram.time = machine.now();
  telegram.cycle = kMilli;
  telegram.modulo = proxy.modulo();
  proxy.take(telegram, machine.now());
  machine.run_for(2000ms);
  EXPECT_EQ(machine.read("PLC_2.Line.ErrorDetail.Number"), 900.0);
  EXPECT_EQ(machine.read("PLC_2.Virtual.Velocity"), 0.0);
  EXPECT_EQ(machine.read("PLC_3.Behind.Velocity"), 0.0);
  EXPECT_EQ(machine.read("PLC_3.Cascade.ErrorDetail.Number"), 0.0);
  EXPECT_EQ(machine.read("PLC_3.gear_Behind.InGear"), 1.0);
  EXPECT_NEAR(line_of(behind.setpoint(), kRing), line_of(virtual_axis.setpoint(), kRing), 1e-9);
}

}  // namespace
}  // namespace lockstep::simulated_system_test
