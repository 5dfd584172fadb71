// Ticks that a machine misses: they make it slower, and never faster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::late_ticks_test {
namespace {

using test::Rig;

constexpr double kSpeed = 1000.0;  // [u/s]

void driven(AxisData& data) {
  data.VirtualAxis.Mode = 0;
  data.FollowingError.EnableMonitoring = true;
  data.FollowingError.MinValue = data.FollowingError.MaxValue = 40.0;
}

/// A driven conveyor; an axis in gear with its setpoint, one with its actual value, one with an encoder on
/// its load. All followers have drives.
struct Line : Rig {
  explicit Line(int ratio)
      : Rig(1'000'000, ratio),
        conveyor(axis("Conveyor", driven)),
        encoder(
            static_cast<ExternalEncoder&>(controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"))),
        run_conveyor(block<MC_MoveVelocity>()) {
    conveyor.drive_settings = {.time_constant = 0.003, .dead_time = 0.002};
    encoder.source_settings.follows = &conveyor;
    run_conveyor.Axis = &conveyor;
    run_conveyor.Velocity = kSpeed;
    run_conveyor.Acceleration = run_conveyor.Deceleration = 4000.0;
    enable(conveyor);
    follow(axis("BySetpoint", driven), conveyor, Coupling::setpoint);
    follow(axis("ByActualValue", driven), conveyor, Coupling::actual);
    follow(axis("ByEncoder", driven), encoder, Coupling::actual);
    for (auto& rule : continuity) rule.velocity = false;  // what an encoder shows is no profile
  }

  void enable(Axis& axis) {
    auto& power = block<MC_Power>();
    power.Axis = &axis;
    power.Enable = true;
  }
  void follow(Axis& follower, LeadingObject& leading, Coupling coupling) {
    follower.drive_settings = {.time_constant = 0.002, .dead_time = 0.0015};
    follower.leading_values.push_back({&leading, coupling});
    enable(follower);
    auto& gear = block<MC_GearIn>();
    gear.Master = &leading;
    gear.Slave = &follower;
    gear.RatioNumerator = 3;
    gear.RatioDenominator = 2;
    gears.push_back(&gear);
  }

  /// Executed ticks, with what a program would do at them: couple, run, another velocity, stop.
  void tick_with_program() {
    const int now = ticks++;
    for (MC_GearIn* gear : gears) gear->Execute = now >= 400;
    if (now == 800 || now == 1600 || now == 2400) run_conveyor.Execute = false;
    if (now == 1600) run_conveyor.Velocity = -0.5 * kSpeed;
    if (now == 2400) run_conveyor.Velocity = 0.0;
    if (now == 801 || now == 1601 || now == 2401) run_conveyor.Execute = true;
    tick();
  }

  Axis& conveyor;
  ExternalEncoder& encoder;
  MC_MoveVelocity& run_conveyor;
  std::vector<MC_GearIn*> gears;
  int ticks = 0;
};

/// What an axis does and shows in a tick.
auto state_of(const Axis& axis) {
  return std::tuple(axis.data.Position, axis.data.Velocity, axis.data.ActualPosition,
                    axis.data.ActualVelocity, axis.data.VelocitySetpoint,
                    axis.data.StatusPositioning.FollowingError, axis.data.ErrorDetail.Number);
}

class LateTicks : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, LateTicks, ::testing::Values(1, 2, 3, 4, 8, 16, 32));

/// Every executed tick does what it would have done, so no following error and no velocity is higher.
TEST_P(LateTicks, LeaveDrivesGearsAndEncodersWhatTheyAreWithoutThem) {
  test::for_each_seed(1, test::cases(4, 200), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    std::uniform_int_distribution<int> stall(1, 100);  // [ms]
    std::uniform_int_distribution<int> executed(1, 60);
    Line undisturbed(GetParam());
    Line late(GetParam());
    double fastest = 0.0;
    int next = executed(random);
    for (int i = 0; i < 3200; ++i) {
      undisturbed.tick_with_program();
      late.tick_with_program();
      for (std::size_t k = 0; k < late.controller.axes.size(); ++k)
        ASSERT_EQ(state_of(*late.controller.axes[k]), state_of(*undisturbed.controller.axes[k]))
            << late.controller.axes[k]->name << " in executed tick " << i;
      fastest = std::max(fastest, std::abs(late.controller.axes[1]->data.ActualVelocity));
      if (--next > 0) continue;
      late.controller.skip(stall(random));
      next = executed(random);
    }
    EXPECT_GT(fastest, 1.4 * kSpeed);
    EXPECT_GT(late.controller.counters().missed_ticks, 3200u);
  });
}

/// The interpolator runs after as many executed ticks as ever, wherever on the grid they are.
TEST_P(LateTicks, LeaveEachInterpolatorCycleItsServoTicks) {
  const auto ratio = static_cast<std::uint64_t>(GetParam());
  Rig rig(1'000'000, GetParam());
  rig.axis("Axis");
  std::mt19937_64 random(7);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    rig.tick();
    ASSERT_EQ(rig.controller.counters().interpolator_ticks, i / ratio + 1);
    if (random() % 3 == 0) rig.controller.skip(static_cast<std::int64_t>(random() % 100));
  }
}

/// An encoder whose values come from elsewhere has gone on meanwhile: by a longer distance, in a longer time.
TEST_P(LateTicks, DoNotMakeAForeignEncoderFaster) {
  Rig rig(1'000'000, GetParam());
  auto& encoder =
      static_cast<ExternalEncoder&>(rig.controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"));
  Tag tag;
  tag.name = "signal";
  tag.type = Type::LREAL;
  encoder.source_settings.signal = rig.controller.add_tag(std::move(tag)).signal;
  std::mt19937_64 random(11);
  for (int i = 0; i < 4000; ++i) {
    Value value{};
    value.r = kSpeed * 1e-9 * static_cast<double>(rig.controller.now());
    encoder.source_settings.signal.store(value);
    rig.tick();
    if (i <= 2 * GetParam()) continue;  // the first velocities are those from rest
    ASSERT_NEAR(encoder.data.ActualVelocity, kSpeed, 1e-6) << "tick " << i;
    if (random() % 50 == 0) rig.controller.skip(1 + static_cast<std::int64_t>(random() % 100));
  }
  EXPECT_GT(rig.controller.counters().missed_ticks, 0u);
}

}  // namespace
}  // namespace lockstep::late_ticks_test
