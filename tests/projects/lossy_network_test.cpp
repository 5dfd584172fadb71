// Followers on several controllers over a network that delays, loses, doubles and reorders telegrams: none of
// them steps, none is further from the true path than is written, and all of it is the same twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "tests/support/seeds.hpp"
#include "three_controllers.hpp"

namespace lockstep::lossy_network_test {
namespace {

using namespace std::chrono_literals;
using test::apply_calculated_delays;
using test::axis_of;
using test::couple;
using test::Followed;
using test::followers_of;
using test::kAcceleration;
using test::kJerk;
using test::kMilli;
using test::kRing;
using test::line_of;
using test::PathByHand;
using test::proxy_of;
using test::SystemFiles;
using test::SystemJson;
using test::three;

/// A proxy as it is watched.
struct Watched {
  std::size_t controller;
  std::string name;
  double cycle;  // the longer one of source and receiver [s]
  Setpoint last{};
  std::int64_t time = -1;   // of `last` [ns]
  double extrapolated = 0;  // by how much at most [s]
  double furthest = 0;      // from the true path [u]
  double steepest = 0;      // change of its velocity [u/s²]
  double torn = 0;          // by how much its position has moved beside its velocities, over h² [u/s²]
};

/// What came of a run.
struct Outcome {
  std::vector<Watched> proxies;
  double off_function = 0;  // of a follower from the function of what its proxy gives [u of the leading axis]
  std::uint64_t bits = 14695981039346656037u;
  std::uint64_t lost = 0;
};

class Run {
 public:
  Run(const SystemFiles& files, std::int64_t delay)
      : machine_(files.path()), delay_(delay), followers_(followers_of(machine_)) {
    outcome_.proxies = {{1, "Line", 0.002}, {2, "Line", 0.004}, {2, "Cascade", 0.004}};
  }

  /// Half of the time forwards, half backwards.
  Outcome run(std::chrono::milliseconds time) {
    couple(machine_);
    change("go", test::kSpeed);
    look(time.count() * kMilli / 2);
    change("back", test::kBackwards);
    look(time.count() * kMilli / 2);
    for (const Watched& one : outcome_.proxies)
      EXPECT_EQ(proxy_of(machine_, one.controller, one.name).data.ErrorDetail.Number, 0u) << one.name;
    outcome_.lost = machine_.lost();
    return outcome_;
  }

 private:
  void change(const char* tag, double velocity) {
    while (machine_.next() != 0) machine_.step();
    machine_.write(std::string("PLC_1.") + tag, 1.0);
    path_.change(machine_.now(), velocity);
  }

  void look(std::int64_t time) {
    const std::int64_t end = machine_.now() + time;
    while (machine_.now() < end) {
      const std::size_t controller = machine_.next();
      const std::int64_t now = machine_.now();
      const bool interpolates =
          machine_.system().controllers[controller].project.controller->interpolator_is_due();
      machine_.step();
      if (!interpolates) continue;
      for (Watched& one : outcome_.proxies)
        if (one.controller == controller) watch(one, now);
      for (const Followed& one : followers_)
        if (one.controller == controller && !one.proxy.empty()) hold(one);
      add_bits(controller);
    }
  }

  void watch(Watched& one, std::int64_t now) {
    const LeadingAxisProxy& proxy = proxy_of(machine_, one.controller, one.name);
    const Setpoint& here = proxy.setpoint();
    // The one before the cascade is ahead by its delay.
    const std::int64_t ahead = std::llround(proxy.data.Parameter.LocalLeadingValueDelayTime * 1e9);
    const double truth = path_.position(now - delay_ + ahead) * (one.name == "Cascade" ? -1.0 : 1.0);
    one.furthest = std::max(one.furthest, std::abs(line_of(here, kRing) - truth));
    one.extrapolated = std::max(one.extrapolated, proxy.data.StatusExternalLeadingValue.AdjustmentTime);
    if (one.time >= 0) {
      const double h = static_cast<double>(now - one.time) * 1e-9;
      one.steepest = std::max(one.steepest, std::abs(here.velocity - one.last.velocity) / h);
      const double moved = line_of(here, kRing) - line_of(one.last, kRing);
      const double said = 0.5 * (here.velocity + one.last.velocity) * h;
      one.torn = std::max(one.torn, std::abs(moved - said) / (h * h));
    }
    one.last = here;
    one.time = now;
  }

  /// A follower is where the function of what its proxy gives is, in the same tick.
  void hold(const Followed& one) {
    const Axis& axis = axis_of(machine_, one.controller, one.name);
    const LeadingAxisProxy& proxy = proxy_of(machine_, one.controller, one.proxy);
    const Setpoint& leads = one.name == "Seven" ? proxy.leading_state(Coupling::delayed) : proxy.setpoint();
    double expected = line_of(leads, kRing);
    // That of the cascade is mirrored already.
    if (one.name != "Behind") expected = one.function(expected);
    const double error = std::abs(line_of(axis.setpoint(), axis.modulo().length) - expected);
    outcome_.off_function = std::max(outcome_.off_function, error / one.steepness);
  }

  /// Every setpoint of every axis of a controller, to the bit.
  void add_bits(std::size_t controller) {
    for (const Axis* const axis : machine_.system().controllers[controller].project.controller->axes)
      for (const double value : {axis->setpoint().position.value, axis->setpoint().velocity}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        outcome_.bits = (outcome_.bits ^ bits) * 0x100000001b3u;
      }
  }

  SimulatedSystem machine_;
  const std::int64_t delay_;  // [ns]
  const std::vector<Followed> followers_;
  PathByHand path_;
  Outcome outcome_;
};

/// The delays are those that `lockstep connections` computes, and a cycle of the slowest more if asked.
Outcome outcome_of(const SystemJson& network, std::uint64_t seed, std::chrono::milliseconds time) {
  SystemFiles files = three(0.0, 0.0);
  files.json["simulated_network"] = network;
  files.json["simulated_network"]["seed"] = seed;
  const std::int64_t delay = apply_calculated_delays(files);
  return Run(files, delay).run(time);
}

/// What is written (tech_objects/leading_values/README.md) of a value that has been extrapolated by up to t,
/// or has met a gap of telegrams as long as that: it is no further from the path than J · (t + T)³ / 30, with
/// T = 8 cycles + 4 t, and its acceleration no further than J · (t + T) / 2. Behind four cycles of the source
/// the acceleration is given up: that is one more.
void expect_written_bounds(const Outcome& outcome) {
  for (const Watched& one : outcome.proxies) {
    SCOPED_TRACE(std::to_string(one.controller + 1) + "." + one.name);
    const double t = std::max(one.extrapolated, one.cycle);
    const double span = t + 8.0 * one.cycle + 4.0 * t;
    const double acceleration = kAcceleration + kJerk * span / 2.0;
    std::printf("%zu.%s: extrapolated by %.3f ms, %.3g u of %.3g, %.3g u/s² of %.3g\n", one.controller + 1,
                one.name.c_str(), one.extrapolated * 1e3, one.furthest, kJerk * std::pow(span, 3) / 30.0,
                one.steepest, acceleration);
    EXPECT_LE(one.furthest, kJerk * std::pow(span, 3) / 30.0);
    EXPECT_LE(one.steepest, acceleration);
    EXPECT_LE(one.torn, acceleration / 4.0);
  }
  EXPECT_LE(outcome.off_function, 1e-9);
}

struct Network {
  const char* what;
  const char* json;
};

class LossyNetworks : public testing::TestWithParam<Network> {};

TEST_P(LossyNetworks, StepNoFollower) {
  const std::uint64_t seed = test::seed_of_run(7);
  const std::chrono::milliseconds time(test::cases(4000, 300'000));
  const Outcome outcome = outcome_of(SystemJson::parse(GetParam().json), seed, time);
  expect_written_bounds(outcome);
}

INSTANTIATE_TEST_SUITE_P(
    Each, LossyNetworks,
    testing::Values(Network{"latency", R"({ "latency": "1500us" })"},
                    Network{"jitter", R"({ "latency": "800us", "jitter": "800us" })"},
                    Network{"loss", R"({ "latency": "300us", "loss": 0.01 })"},
                    Network{"much loss", R"({ "latency": "300us", "loss": 0.1 })"},
                    Network{"duplicates", R"({ "latency": "300us", "jitter": "200us", "duplicates": 0.05 })"},
                    Network{"reordering", R"({ "latency": "300us", "reordering": 0.05 })"},
                    Network{"too late", R"({ "latency": "6ms", "jitter": "2ms" })"},
                    Network{"all", R"({ "latency": "800us", "jitter": "600us", "loss": 0.01,
                                        "duplicates": 0.01, "reordering": 0.01 })"}),
    [](const auto& each) {
      std::string name = each.param.what;
      std::ranges::replace(name, ' ', '_');
      return name;
    });

TEST(LossyNetwork, GivesTheSameBitsTwice) {
  const SystemJson all = SystemJson::parse(
      R"({ "latency": "800us", "jitter": "600us", "loss": 0.01, "duplicates": 0.01, "reordering": 0.01 })");
  const Outcome once = outcome_of(all, 7, 1600ms);
  EXPECT_EQ(once.bits, outcome_of(all, 7, 1600ms).bits);
  EXPECT_NE(once.bits, outcome_of(all, 8, 1600ms).bits) << "another seed loses other telegrams";
  EXPECT_GT(once.lost, 0u);
}

}  // namespace
}  // namespace lockstep::lossy_network_test
