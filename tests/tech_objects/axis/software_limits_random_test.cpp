// Software limit switches under random jobs.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/limited_axis.hpp"
#include "tests/support/property.hpp"

namespace lockstep::software_limits_random_test {
namespace {

using test::kRounding;
using test::Limited;
using test::use_limits;

/// Random jobs, gears included, on an axis with limits.
class RandomJobs {
 public:
  explicit RandomJobs(std::uint64_t seed)
      : random_(seed), rig_(chance(0.5) ? 1 : 4, chance(0.3), [this](AxisData& data) { configure(data); }) {
    rig_.continuity[1].acceleration = false;
    rig_.continuity[1].highest_acceleration = 1e6;
    rig_.continuity[0].acceleration = false;
  }

  /// How far the setpoint has been outside at most [u].
  double run() {
    for (int i = 0; i < 12; ++i) {
      act();
      for (int ticks = pick(600); ticks > 0; --ticks) tick();
      if (rig_.a.pending_alarm() != 0 && chance(0.7)) reset();
      if (chance(0.8)) rig_.power.Enable = true;
    }
    return furthest_;
  }
  bool passed() const { return passed_; }
  bool alarmed() const { return alarmed_; }

 private:
  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void configure(AxisData& data) {
    minimum_ = uniform(-200.0, -5.0);
    maximum_ = uniform(5.0, 200.0);
    lowest_ = minimum_;
    highest_ = maximum_;
    use_limits(data, minimum_, maximum_);
    data.PositionLimits_SW.LimitReachedBehavior = pick(2);
    data.PositionLimits_SW.LimitExceededBehavior = pick(2);
    data.DynamicLimits.MaxDeceleration = uniform(1500.0, 20000.0);
    data.DynamicLimits.MaxAcceleration = uniform(1500.0, 20000.0);
    data.DynamicLimits.MaxJerk = uniform(20000.0, 1e6);
    data.DynamicDefaults.EmergencyDeceleration = uniform(1000.0, 50000.0);
  }

  void tick() {
    const double last = rig_.position();
    const bool before = controlled_;
    rig_.tick();
    controlled_ = rig_.a.enabled() || (controlled_ && !rig_.a.off());
    alarmed_ = alarmed_ || rig_.a.pending_alarm() == 533;
    passed_ = passed_ || rig_.a.pending_alarm() == 534;
    if (!before || !controlled_) {
      // Switched off it goes where the drive runs out to; from there it may only come back.
      highest_ = std::max(maximum_, rig_.position());
      lowest_ = std::min(minimum_, rig_.position());
      return;
    }
    furthest_ = std::max({furthest_, rig_.position() - highest_, lowest_ - rig_.position()});
    if (last <= maximum_) highest_ = maximum_;
    if (last >= minimum_) lowest_ = minimum_;
  }

  template <class B>
  void start(B& block) {
    block.Execute = false;
    tick();
    block.Execute = true;
  }
  template <class B>
  void set_dynamics(B& block) {
    if constexpr (requires { block.Acceleration; }) block.Acceleration = uniform(200.0, 10000.0);
    block.Deceleration = uniform(200.0, 10000.0);
    block.Jerk = chance(0.3) ? 0.0 : uniform(2000.0, 500000.0);
  }

  void act() {
    switch (pick(10)) {
      case 0:
        rig_.move.Position = chance(0.3) ? maximum_ : uniform(-300.0, 300.0);
        rig_.move.Velocity = uniform(5.0, 800.0);
        set_dynamics(rig_.move);
        return start(rig_.move);
      case 1:
        rig_.relative.Distance = uniform(-300.0, 300.0);
        rig_.relative.Velocity = uniform(5.0, 800.0);
        set_dynamics(rig_.relative);
        return start(rig_.relative);
      case 2:
      case 3:
        rig_.run_a.Velocity = uniform(-800.0, 800.0);
        set_dynamics(rig_.run_a);
        return start(rig_.run_a);
      case 4:
        rig_.jog.Velocity = uniform(0.0, 500.0);
        rig_.jog.JogForward = chance(0.5);
        rig_.jog.JogBackward = !rig_.jog.JogForward && chance(0.5);
        return;
      case 5:
        set_dynamics(rig_.halt);
        return start(rig_.halt);
      case 6:
        rig_.run_l.Velocity = uniform(-300.0, 300.0);
        start(rig_.run_l);
        rig_.gear.RatioNumerator = pick(2) * 2 - 1;
        set_dynamics(rig_.gear);
        return start(rig_.gear);
      case 7:
        rig_.run_l.Velocity = uniform(-300.0, 300.0);
        set_dynamics(rig_.run_l);
        return start(rig_.run_l);
      case 8:
        rig_.a.data.Override.Velocity = uniform(0.0, 200.0);
        return;
      default:
        rig_.power.StopMode = chance(0.5) ? INT{0} : INT{2};
        rig_.power.Enable = !rig_.power.Enable || chance(0.3);
        return;
    }
  }

  void reset() {
    start(rig_.reset);
    rig_.jog.JogForward = rig_.jog.JogBackward = false;
  }

  std::mt19937_64 random_;
  double minimum_ = 0.0;
  double maximum_ = 0.0;
  double lowest_ = 0.0;  // what is permitted now
  double highest_ = 0.0;
  double furthest_ = 0.0;
  bool controlled_ = true;
  bool alarmed_ = false;
  bool passed_ = false;
  Limited rig_;
};

TEST(SoftwareLimits, AreNeverLeftByRandomJobs) {
  constexpr std::uint64_t kFirstSeed = 533;
  int alarmed = 0;
  double furthest = 0.0;
  const test::Cases ran =
      test::for_each_seed(kFirstSeed, test::cases(1000, 100000), [&](const test::Case& one) {
        RandomJobs jobs(one.seed);
        const double outside = jobs.run();
        furthest = std::max(furthest, outside);
        EXPECT_LE(outside, kRounding);
        EXPECT_FALSE(jobs.passed());
        if (jobs.alarmed()) ++alarmed;
      });
  std::printf("%d of them to a limit, at most %g outside\n", alarmed, furthest);
  if (ran.alone) return;
  EXPECT_GT(alarmed, ran.count / 2);
}

}  // namespace
}  // namespace lockstep::software_limits_random_test
