// The example projects on a machine that is late: no axis gets faster by it, or farther behind its setpoint.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tests/support/property.hpp"

namespace lockstep::late_examples_test {
namespace {

/// Stimuli and programs run by the clock: they ask for the same motions somewhere else.
constexpr double kOtherMotion = 1.1;

/// What was highest in a run, of one axis.
struct Highest {
  double following_error = 0.0;  // [u]
  double velocity = 0.0;         // actual one [u/s]
  std::set<std::uint32_t> alarms;
};

struct Example {
  const char* project;
  int seconds;  // of virtual time
};

/// A run of an example with its stimuli; after each tick `stall` tells how many are missed.
template <class Stall>
std::vector<Highest> run(const Example& example, Stall stall) {
  Simulation machine(std::string(LOCKSTEP_SOURCE_DIR "/projects/") + example.project + "/project.json");
  Controller& controller = *machine.project().controller;
  std::vector<Highest> highest(controller.axes.size());
  while (machine.now() < std::chrono::seconds(example.seconds)) {
    machine.step();
    for (std::size_t i = 0; i < highest.size(); ++i) {
      const AxisData& data = controller.axes[i]->data;
      Highest& of_axis = highest[i];
      of_axis.following_error =
          std::max(of_axis.following_error, std::abs(data.StatusPositioning.FollowingError));
      of_axis.velocity = std::max(of_axis.velocity, std::abs(data.ActualVelocity));
      of_axis.alarms.insert(data.ErrorDetail.Number);
    }
    if (const std::int64_t missed = stall(); missed > 0) controller.skip(missed);
  }
  return highest;
}

class LateExamples : public ::testing::TestWithParam<Example> {};

TEST_P(LateExamples, GetNeitherFasterNorFartherBehind) {
  const std::vector<Highest> undisturbed = run(GetParam(), [] { return 0; });
  test::for_each_seed(1, test::cases(3, 100), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_int_distribution<std::int64_t> stall(1, 100);
    const std::vector<Highest> late =
        run(GetParam(), [&]() -> std::int64_t { return random() % 200 == 0 ? stall(random) : 0; });
    for (std::size_t i = 0; i < late.size(); ++i) {
      SCOPED_TRACE("axis " + std::to_string(i + 1));
      EXPECT_LE(late[i].following_error, undisturbed[i].following_error * kOtherMotion + 1e-9);
      EXPECT_LE(late[i].velocity, undisturbed[i].velocity * kOtherMotion + 1e-9);
      for (const std::uint32_t alarm : late[i].alarms)
        EXPECT_TRUE(undisturbed[i].alarms.contains(alarm)) << "alarm " << alarm;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Examples, LateExamples,
                         ::testing::Values(Example{"01_positioning", 5}, Example{"02_rotary_knife", 5},
                                           Example{"03_line_shaft", 5}, Example{"04_cross_cutter", 5},
                                           Example{"05_press_feeder", 8}, Example{"06_encoder_conveyor", 8},
                                           Example{"07_emergency_door", 16}, Example{"08_filling_line", 11},
                                           Example{"09_flying_saw", 12}, Example{"10_fixed_stop", 16},
                                           Example{"11_pick_and_place", 8}, Example{"14_twelve_stations", 7}),
                         [](const auto& example) { return std::string(example.param.project); });

}  // namespace
}  // namespace lockstep::late_examples_test
