// A tick on several processors computes to the bit what it computes on one.
#include <gtest/gtest.h>

#include <random>
#include <tuple>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "scheduler/levels.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::processors_test {
namespace {

using test::Rig;

constexpr std::uint64_t kFirstSeed = 1123;

/// What an axis shows, and what its jobs tell.
auto state_of(const Axis& axis) {
  const AxisData& data = axis.data;
  return std::tuple(data.Position, data.Velocity, data.Acceleration, data.ActualPosition, data.StatusWord,
                    data.StatusSynchronizedMotion.FunctionState, data.ErrorDetail.Number);
}

/// Axes that may follow each other in many ways, some with drives.
struct Machine : Rig {
  static constexpr int kAxes = 200;
  static constexpr int kNeighbours = 3;

  Machine(int processors, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    controller.clock.processors = processors;
    for (int i = 0; i < kAxes; ++i)
      axes.push_back(&axis("Axis" + std::to_string(i),
                           [&](AxisData& data) { data.VirtualAxis.Mode = i % 2 == 0 ? 1 : 0; }));
    for (auto& rule : continuity) rule.velocity = rule.acceleration = false;
    for (int i = 0; i < kAxes; ++i) wire(i, random);
  }

  void wire(int i, std::mt19937_64& random) {
    Axis* const own = axes[static_cast<std::size_t>(i)];
    powers.push_back(&block<MC_Power>());
    powers.back()->Axis = own;
    powers.back()->Enable = true;
    moves.push_back(&block<MC_MoveVelocity>());
    moves.back()->Axis = own;
    halts.push_back(&block<MC_Halt>());
    halts.back()->Axis = own;
    home_in_place(*own);
    for (int n = 0; n < kNeighbours; ++n) {
      // Mostly those in front, at times one behind; few lead many, so that there are levels of all sizes.
      const auto other =
          static_cast<std::size_t>(random() % 4 == 0 ? random() % kAxes : random() % (1 + i / 8));
      if (axes[other] == own) continue;
      lead(*own, *axes[other]);
      auto& gear = block<MC_GearIn>();
      gear.Master = axes[other];
      gear.Slave = own;
      gear.RatioNumerator = static_cast<DINT>(1 + random() % 3);
      gear.RatioDenominator = static_cast<DINT>(1 + random() % 3);
      gears.push_back(&gear);
      auto& at_position = block<MC_GearInPos>();
      at_position.Master = axes[other];
      at_position.Slave = own;
      at_position.RatioNumerator = at_position.RatioDenominator = 1;
      at_position.SyncProfileReference = 1;
      at_position.MasterStartDistance = 20.0;
      gears_at.push_back(&at_position);
    }
  }

  /// Some jobs begin and end, the same in each machine that is asked with the same numbers.
  void act(std::mt19937_64& random) {
    const auto any = [&](auto& blocks) -> auto& {
      return *blocks[random() % blocks.size()];
    };
    for (int n = 0; n < 6; ++n) {
      auto& move = any(moves);
      move.Velocity = static_cast<double>(random() % 400) - 200.0;
      move.Execute = !move.Execute;
      auto& gear = any(gears);
      gear.Execute = !gear.Execute;
      auto& at_position = any(gears_at);
      at_position.MasterSyncPosition =
          at_position.Master == nullptr ? 0.0
                                        : static_cast<const Axis*>(at_position.Master)->data.Position + 40.0;
      at_position.SlaveSyncPosition = static_cast<const Axis*>(at_position.Slave)->data.Position + 30.0;
      at_position.Execute = !at_position.Execute;
    }
    auto& halt = any(halts);
    halt.Execute = !halt.Execute;
    auto& power = any(powers);
    if (random() % 20 == 0) power.Enable = !power.Enable;
  }

  std::vector<Axis*> axes;
  std::vector<MC_Power*> powers;
  std::vector<MC_MoveVelocity*> moves;
  std::vector<MC_Halt*> halts;
  std::vector<MC_GearIn*> gears;
  std::vector<MC_GearInPos*> gears_at;
};

class Processors : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Number, Processors, ::testing::Values(2, 4));

TEST_P(Processors, ChangeNoBit) {
  int followed = 0;
  int waited = 0;
  test::for_each_seed(kFirstSeed, test::cases(2, 200), [&](const test::Case& one) {
    Machine alone(1, one.seed);
    Machine shared(GetParam(), one.seed);
    alone.tick();
    shared.tick();
    shared.controller.employ_processors(GetParam());
    ASSERT_EQ(shared.controller.helping_threads().size(), static_cast<std::size_t>(GetParam() - 1));
    std::mt19937_64 first(one.seed);
    std::mt19937_64 second(one.seed);
    for (int tick = 0; tick < 600; ++tick) {
      alone.act(first);
      shared.act(second);
      alone.tick();
      shared.tick();
      for (std::size_t i = 0; i < alone.axes.size(); ++i) {
        ASSERT_EQ(state_of(*shared.axes[i]), state_of(*alone.axes[i]))
            << alone.axes[i]->name << " in tick " << tick;
        followed += alone.axes[i]->coupled_leading_axis() != nullptr ? 1 : 0;
        waited += alone.axes[i]->awaited_leading_axis() != nullptr ? 1 : 0;
      }
      ASSERT_EQ(shared.controller.counters().alarms, alone.controller.counters().alarms);
    }
  });
  EXPECT_GT(followed, 1000);
  EXPECT_GT(waited, 100);
}

TEST(Processors, AreNotEmployedForAFewAxes) {
  Rig rig;
  rig.controller.clock.processors = 4;
  for (int i = 0; i < 20; ++i) rig.axis("Axis" + std::to_string(i));
  rig.tick();
  rig.controller.employ_processors(4);
  EXPECT_TRUE(rig.controller.helping_threads().empty());
}

/// More threads than processors would wait for each other.
TEST(Processors, AreNoMoreThanTheMachineHas) {
  Machine machine(64, 1);
  machine.tick();
  machine.controller.employ_processors(1);
  EXPECT_TRUE(machine.controller.helping_threads().empty());
  machine.controller.employ_processors(3);
  EXPECT_EQ(machine.controller.helping_threads().size(), 2u);
}

// ---- Levels
// --------------------------------------------------------------------------------------------------

/// Each axis once, in its order within a level, behind what leads it; one that waits by itself.
TEST(Levels, HoldWhatCanBeSteppedSideBySide) {
  Machine machine(1, 7);
  std::mt19937_64 random(7);
  Levels levels;
  levels.reserve(machine.axes.size(), static_cast<std::uint32_t>(machine.axes.back()->number));
  CouplingOrder order;
  order.set_axes(machine.axes);
  std::size_t maximum = 0;
  for (int tick = 0; tick < 300; ++tick) {
    machine.act(random);
    machine.tick();
    order.rebuild();
    levels.rebuild(order.axes());
    std::vector<std::size_t> level_of(machine.axes.size() + 1, SIZE_MAX);
    std::size_t axes = 0;
    for (std::size_t level = 0; level < levels.count(); ++level) {
      ASSERT_FALSE(levels[level].empty());
      for (const Axis* axis : levels[level]) {
        ASSERT_EQ(level_of[static_cast<std::size_t>(axis->number)], SIZE_MAX);
        level_of[static_cast<std::size_t>(axis->number)] = level;
        if (const Axis* leading = axis->coupled_leading_axis(); leading != nullptr) {
          ASSERT_LT(level_of[static_cast<std::size_t>(leading->number)], level) << axis->name;
        }
        if (axis->awaited_leading_axis() != nullptr) {
          ASSERT_EQ(levels[level].size(), 1u) << axis->name;
        }
        ++axes;
      }
    }
    ASSERT_EQ(axes, machine.axes.size());
    maximum = std::max(maximum, levels.count());
  }
  EXPECT_GT(maximum, 3u);
}

}  // namespace
}  // namespace lockstep::processors_test
