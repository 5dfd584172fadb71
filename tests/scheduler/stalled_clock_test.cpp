// A run in real time whose clock stalls: what a late computer does to the machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "scheduler/real_time.hpp"
#include "tests/support/property.hpp"

namespace lockstep::stalled_clock_test {
namespace {

constexpr std::int64_t kCycle = 1'000'000;  // [ns]
constexpr double kSpeed = 1000.0;           // [u/s]
constexpr int kTicks = 2400;

/// A conveyor and an axis in gear with it, both with drives whose following errors are watched.
class Line {
 public:
  explicit Line(int ratio) {
    controller.clock = {kCycle, ratio};
    Axis& conveyor = driven("Conveyor");
    Axis& roll = driven("Roll");
    roll.leading_values.push_back({&conveyor, Coupling::setpoint});
    run_ = &block<MC_MoveVelocity>();
    run_->Axis = &conveyor;
    run_->Velocity = kSpeed;
    run_->Acceleration = run_->Deceleration = 4000.0;
    gear_ = &block<MC_GearIn>();
    gear_->Master = &conveyor;
    gear_->Slave = &roll;
    gear_->RatioNumerator = 3;
    gear_->RatioDenominator = 2;
    controller.finish();
  }

  /// What a program asks for before the given executed tick: couple, run, run back.
  void ask(int tick) {
    gear_->Execute = tick >= 300;
    if (tick == 600 || tick == 1500) run_->Execute = false;
    if (tick == 1500) run_->Velocity = -0.5 * kSpeed;
    if (tick == 601 || tick == 1501) run_->Execute = true;
  }
  void call_blocks() {
    for (auto& block : blocks_) block->call(controller.now());
  }

  /// What the axes do and show.
  auto state() const { return std::pair(state_of(*controller.axes[0]), state_of(*controller.axes[1])); }

  Controller controller;

 private:
  static std::tuple<double, double, double, double, double, std::uint32_t> state_of(const Axis& axis) {
    return {axis.data.Position,
            axis.data.ActualPosition,
            axis.data.ActualVelocity,
            axis.data.VelocitySetpoint,
            axis.data.StatusPositioning.FollowingError,
            axis.data.ErrorDetail.Number};
  }

  Axis& driven(const char* name) {
    Axis& axis = controller.add_axis(ObjectKind::TO_SynchronousAxis, name);
    axis.drive_settings = {.time_constant = 0.003, .dead_time = 0.002};
    axis.data.FollowingError.EnableMonitoring = true;
    axis.data.FollowingError.MinValue = axis.data.FollowingError.MaxValue = 40.0;
    auto& power = block<MC_Power>();
    power.Axis = &axis;
    power.Enable = true;
    return axis;
  }

  template <class B>
  B& block() {
    auto made = std::make_unique<B>();
    B& reference = *made;
    blocks_.push_back(std::move(made));
    return reference;
  }

  std::vector<std::unique_ptr<Block>> blocks_;
  MC_MoveVelocity* run_ = nullptr;
  MC_GearIn* gear_ = nullptr;
};

/// A clock whose sleeper wakes late at times, and of whose ticks some are held up.
class StalledClock final : public WaitingClock {
 public:
  StalledClock(std::uint64_t seed, std::function<void()> between_ticks)
      : random_(seed), between_ticks_(std::move(between_ticks)) {}

  std::int64_t now() noexcept override {
    if (std::exchange(in_tick_, false)) time_ += stall();
    if (std::exchange(woken_, false)) in_tick_ = true;
    return time_;
  }
  void sleep_until(std::int64_t due) noexcept override {
    between_ticks_();
    if (first_ < 0) first_ = due;
    on_grid_ = on_grid_ && (due - first_) % kCycle == 0 && due > last_;
    made_up_ = made_up_ || due < time_;
    last_ = due;
    const std::int64_t late = stall();
    latest_ = std::max(latest_, late);
    time_ = std::max(time_, due) + late;
    woken_ = true;
  }

  /// Whether all ticks were on the grid, each in a cycle of its own.
  bool on_grid() const { return on_grid_; }
  /// Whether one began whose time had passed before the one before it was over.
  bool made_up() const { return made_up_; }
  std::int64_t latest() const { return latest_; }

 private:
  /// Mostly nothing or less than a cycle, at times 1 to 100 ms.
  std::int64_t stall() {
    const std::uint64_t kind = random_() % 60;
    if (kind == 0) return 1'000'000 + static_cast<std::int64_t>(random_() % 99'000'001);
    return kind < 10 ? static_cast<std::int64_t>(random_() % 400'000) : 20'000;
  }

  std::mt19937_64 random_;
  std::function<void()> between_ticks_;
  std::int64_t time_ = 5'000'000'000;
  std::int64_t first_ = -1, last_ = -1, latest_ = 0;
  bool woken_ = false, in_tick_ = false, on_grid_ = true, made_up_ = false;
};

class StalledRun : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, StalledRun, ::testing::Values(1, 2, 3, 4, 8, 16, 32));

/// So neither following errors nor velocities are higher, and no setpoint goes farther in a tick.
TEST_P(StalledRun, DoesInEachOfItsTicksWhatOneWithoutStallsDoes) {
  test::for_each_seed(1, test::cases(2, 100), [](const test::Case& one) {
    Line undisturbed(GetParam());
    Line late(GetParam());
    RealTimeRun* run = nullptr;
    int ticks = 0;
    int differing = -1;  // the first tick that does
    double fastest = 0.0;
    StalledClock clock(one.seed, [&] {
      if (ticks > kTicks) return;
      late.call_blocks();
      if (differing < 0 && ticks > 0 && late.state() != undisturbed.state()) differing = ticks - 1;
      fastest = std::max(fastest, std::abs(late.controller.axes[1]->data.ActualVelocity));
      late.ask(ticks);
      undisturbed.ask(ticks);
      undisturbed.controller.tick();
      undisturbed.call_blocks();
      if (++ticks > kTicks) run->stop();
    });
    RealTimeRun real_time(late.controller, OverrunPolicy::report, -1, -1, clock);
    run = &real_time;
    undisturbed.call_blocks();
    real_time.start();
    real_time.wait();
    EXPECT_GT(ticks, kTicks);
    EXPECT_EQ(differing, -1);
    EXPECT_GT(fastest, 1.4 * kSpeed);
    EXPECT_TRUE(clock.on_grid());
    EXPECT_FALSE(clock.made_up());
    EXPECT_EQ(real_time.status().worst_lateness.load(), clock.latest());
    EXPECT_GT(real_time.status().missed_ticks.load(), 1000u);
    EXPECT_EQ(real_time.status().missed_ticks.load(), late.controller.counters().missed_ticks);
  });
}

}  // namespace
}  // namespace lockstep::stalled_clock_test
