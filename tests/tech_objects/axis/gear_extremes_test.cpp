// A gear over a thousand million turns, and a chain of a thousand axes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::gear_extremes_test {
namespace {

using test::Rig;

/// 113 bits: the turns of this test and their fractions are exact in it.
__extension__ using Wide = __float128;

Wide unrolled(const Axis& axis) {
  const AxisPosition& position = axis.setpoint().position;
  return static_cast<Wide>(position.value) + static_cast<Wide>(position.turns) * axis.modulo().length;
}

TEST(GearWithARatioOf355To113, IsExactOverAThousandMillionLeadingTurns) {
  constexpr double kFastest = 1e9;  // [u/s]
  const auto ring = [](double length) {
    return [length](AxisData& data) {
      data.Modulo = {true, length, 0.0};
      data.DynamicLimits = {1e12, 1e12, 2.7e8, 2.7e8, 0.0};
      data.DynamicDefaults = {kFastest, 2.7e8, 2.7e8, 0.0, 2.7e8};
    };
  };
  Rig rig;
  Axis& leading = rig.axis("Leading", ring(1.0));
  Axis& following = rig.axis("Following", ring(360.0));
  rig.continuity[0].velocity = rig.continuity[1].velocity = false;  // several turns in a tick
  rig.lead(following, leading);
  auto& power_l = rig.block<MC_Power>();
  auto& power_f = rig.block<MC_Power>();
  auto& gear = rig.block<MC_GearIn>();
  auto& run = rig.block<MC_MoveVelocity>();
  power_l.Axis = run.Axis = &leading;
  power_f.Axis = &following;
  gear.Master = &leading;
  gear.Slave = &following;
  gear.RatioNumerator = 355;
  gear.RatioDenominator = 113;
  power_l.Enable = power_f.Enable = true;
  rig.run(3);
  gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return gear.InGear; }, 10));
  const Wide leading_start = unrolled(leading);
  const Wide following_start = unrolled(following);
  run.Velocity = kFastest;
  run.Execute = true;
  const double permitted = 4.0 * (std::nextafter(360.0, 1e3) - 360.0);
  double worst = 0.0;
  int ticks = 0;
  for (; leading.setpoint().position.turns < 1'000'000'000; ++ticks) {
    ASSERT_LT(ticks, 10'000);
    rig.tick();
    ASSERT_TRUE(gear.InGear);
    const Wide expected = following_start + (unrolled(leading) - leading_start) * 355 / 113;
    const Wide off = unrolled(following) - expected;
    worst = std::max(worst, static_cast<double>(off < 0 ? -off : off));
  }
  EXPECT_LE(worst, permitted);
  EXPECT_GT(following.setpoint().position.turns, 8'000'000);
  std::printf("%d ticks, %lld turns, worst deviation %g of %g\n", ticks,
              static_cast<long long>(leading.setpoint().position.turns), worst, permitted);
}

TEST(AChainOfAThousandAxes, FollowsInTheSameTick) {
  constexpr std::size_t kAxes = 1000;
  Rig rig;
  std::vector<Axis*> axes;
  for (std::size_t i = 0; i < kAxes; ++i) axes.push_back(&rig.axis("A" + std::to_string(i)));
  // The last one made leads, so that the order of making is the wrong one.
  std::vector<MC_GearIn*> gears;
  for (std::size_t i = 0; i < kAxes; ++i) {
    auto& power = rig.block<MC_Power>();
    power.Axis = axes[i];
    power.Enable = true;
    if (i + 1 == kAxes) continue;
    rig.lead(*axes[i], *axes[i + 1]);
    auto& gear = rig.block<MC_GearIn>();
    gear.Master = axes[i + 1];
    gear.Slave = axes[i];
    gear.RatioNumerator = i % 2 == 0 ? 1 : -1;
    gears.push_back(&gear);
  }
  auto& run = rig.block<MC_MoveVelocity>();
  run.Axis = axes.back();
  rig.run(3);
  for (MC_GearIn* gear : gears) gear->Execute = true;
  rig.run(3);
  for (MC_GearIn* gear : gears) ASSERT_TRUE(gear->InGear);
  run.Velocity = 300.0;
  run.Execute = true;
  for (int tick = 0; tick < 300; ++tick) {
    rig.tick();
    double expected = axes.back()->data.Position;
    for (std::size_t i = kAxes - 1; i-- > 0;) {
      if (i % 2 != 0) expected = -expected;
      ASSERT_EQ(axes[i]->data.Position, expected) << "axis " << i << " at tick " << tick;
    }
  }
  EXPECT_GT(axes.back()->data.Position, 1.0);
}

}  // namespace
}  // namespace lockstep::gear_extremes_test
