// What the blocks of synchronous operation show and what the data blocks show, in every tick of jobs at
// random on a chain of three axes: they tell the same, and the terms of the chain add up.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::coupling_status_test {
namespace {

using test::Rig;

constexpr std::uint64_t kFirstSeed = 5100;
constexpr int kSequences = 300;
constexpr int kSoakSequences = 30000;
constexpr int kActions = 40;

/// An axis and the blocks that act on it.
struct Station {
  Station(Rig& rig, Axis& of)
      : axis(of),
        power(rig.block<MC_Power>()),
        home(rig.block<MC_Home>()),
        run(rig.block<MC_MoveVelocity>()),
        move(rig.block<MC_MoveAbsolute>()),
        halt(rig.block<MC_Halt>()),
        stop(rig.block<MC_Stop>()),
        superimpose(rig.block<MC_MoveSuperimposed>()),
        gear(rig.block<MC_GearIn>()),
        pos{&rig.block<MC_GearInPos>(), &rig.block<MC_GearInPos>()},
        velocity(rig.block<MC_GearInVelocity>()),
        phase(rig.block<MC_PhasingRelative>()),
        phase_to(rig.block<MC_PhasingAbsolute>()),
        offset(rig.block<MC_OffsetRelative>()),
        offset_to(rig.block<MC_OffsetAbsolute>()),
        out(rig.block<MC_GearOut>()),
        additive(rig.block<MC_LeadingValueAdditive>()),
        simulation(rig.block<MC_SynchronizedMotionSimulation>()) {
    power.Axis = home.Axis = run.Axis = move.Axis = halt.Axis = stop.Axis = superimpose.Axis = additive.Axis =
        &of;
    gear.Slave = pos[0]->Slave = pos[1]->Slave = velocity.Slave = phase.Slave = phase_to.Slave =
        offset.Slave = offset_to.Slave = out.Slave = simulation.Slave = &of;
  }

  bool bit(StatusBit which) const { return has_bit(axis.data.StatusWord, which); }
  bool bit(Status2Bit which) const { return has_bit(axis.data.StatusWord2, which); }
  bool bit(SynchronizedMotionBit which) const { return has_bit(status().StatusWord, which); }
  const TO_Struct_StatusSynchronizedMotion& status() const { return axis.data.StatusSynchronizedMotion; }

  Axis& axis;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run;
  MC_MoveAbsolute& move;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_MoveSuperimposed& superimpose;
  MC_GearIn& gear;
  MC_GearInPos* pos[2];
  MC_GearInVelocity& velocity;
  MC_PhasingRelative& phase;
  MC_PhasingAbsolute& phase_to;
  MC_OffsetRelative& offset;
  MC_OffsetAbsolute& offset_to;
  MC_GearOut& out;
  MC_LeadingValueAdditive& additive;
  MC_SynchronizedMotionSimulation& simulation;
  AdditiveLeadingValue added;  ///< in this tick
  bool added_before = false;   ///< what Busy was before it: it counts from the tick after its call on
};

struct Seen {
  int synchronous = 0, synchronizing = 0, waiting = 0, leaving = 0, leaving_waits = 0, phasing = 0,
      offsetting = 0, simulated = 0, added = 0;
};

class Sequence {
 public:
  Sequence(std::uint64_t seed, bool told, Seen& seen) : random_(seed), told_(told), seen_(seen) {
    for (const char* name : {"A", "B", "C"}) {
      Axis& axis = rig_.axis(name, [&](AxisData& data) {
        data.Modulo.Enable = chance(0.5);
        data.DynamicDefaults.Velocity = 100.0;
      });
      rig_.continuity.back().velocity = false;
      stations_.emplace_back(rig_, axis);
    }
    for (Station& following : stations_)
      for (Station& leading : stations_)
        if (&following != &leading) rig_.lead(following.axis, leading.axis);
    for (Station& s : stations_) s.power.Enable = true;
    rig_.run(3);
    for (Station& s : stations_) s.home.Execute = true;
    rig_.run(3);
  }

  void run() {
    for (int i = 0; i < kActions && !failed(); ++i) {
      act();
      for (int ticks = 1 + pick(chance(0.2) ? 600 : 100); ticks > 0 && !failed(); --ticks) tick();
    }
  }

 private:
  static int parts() {
    return ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
  }
  bool failed() const { return parts() > parts_before_; }
  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  DINT one_of(std::initializer_list<DINT> values) {
    return values.begin()[static_cast<std::size_t>(pick(static_cast<int>(values.size())))];
  }

  template <class B>
  void start(Station& s, const char* what, B& block) {
    if (told_) std::printf("%lld %s %s\n", ticks_, s.axis.name.c_str(), what);
    if (chance(0.8)) {
      block.Execute = false;
      tick();
    }
    block.Execute = true;
    fresh_ = &block;
  }

  void ratio(DINT& numerator, DINT& denominator) {
    numerator = one_of({-3, -2, -1, 1, 1, 2, 3});
    denominator = one_of({1, 1, 2, 3});
  }

  void act() {
    Station& s = stations_[static_cast<std::size_t>(pick(3))];
    Station* other = &stations_[static_cast<std::size_t>(pick(3))];
    if (other == &s) other = &stations_[0];
    LeadingObject* const master = &other->axis;
    switch (pick(23)) {
      case 0:
      case 1:
      case 2:
        s.run.Velocity = chance(0.2) ? 0.0 : uniform(-150.0, 150.0);
        return start(s, "run", s.run);
      case 3:
        s.move.Position = uniform(-100.0, 100.0);
        return start(s, "move", s.move);
      case 4:
        return start(s, "halt", s.halt);
      case 5:
        s.stop.Execute = !s.stop.Execute && chance(0.4);
        return;
      case 6:
        s.superimpose.Distance = uniform(-20.0, 20.0);
        return start(s, "superimpose", s.superimpose);
      case 7:
      case 8:
      case 9:
        s.gear.Master = master;
        ratio(s.gear.RatioNumerator, s.gear.RatioDenominator);
        return start(s, "gear", s.gear);
      case 10:
      case 11: {
        MC_GearInPos& pos = *s.pos[pick(2)];
        pos.Master = master;
        ratio(pos.RatioNumerator, pos.RatioDenominator);
        pos.SyncProfileReference = one_of({0, 1, 3});
        pos.MasterStartDistance = uniform(1.0, 60.0);
        pos.MasterSyncPosition = other->axis.data.Position + (chance(0.1) ? 0.0 : uniform(-80.0, 80.0));
        pos.SlaveSyncPosition = s.axis.data.Position + (chance(0.1) ? 0.0 : uniform(-80.0, 80.0));
        pos.SyncDirection = one_of({1, 2, 3, 3});
        pos.Velocity = chance(0.5) ? -1.0 : 800.0;
        return start(s, "pos", pos);
      }
      case 12:
        s.velocity.Master = master;
        ratio(s.velocity.RatioNumerator, s.velocity.RatioDenominator);
        s.velocity.PositionControlled = chance(0.7);
        s.velocity.ContinuousUpdate = chance(0.5);
        return start(s, "velocity", s.velocity);
      case 13:
        ratio(s.velocity.RatioNumerator, s.velocity.RatioDenominator);
        return;
      case 14:
        return shift(s, "phase", s.phase, s.phase.PhaseShift, s.phase.PhasingDistance, master,
                     s.phase.Master);
      case 15:
        return shift(s, "phase_to", s.phase_to, s.phase_to.PhaseShift, s.phase_to.PhasingDistance, master,
                     s.phase_to.Master);
      case 16:
        return shift(s, "offset", s.offset, s.offset.Offset, s.offset.OffsetDistance, master, unused_);
      case 17:
        return shift(s, "offset_to", s.offset_to, s.offset_to.Offset, s.offset_to.OffsetDistance, master,
                     unused_);
      case 18:
      case 21:
        s.out.SlavePosition = s.axis.data.Position + std::copysign(uniform(2.0, 30.0), s.axis.data.Velocity);
        s.out.SyncProfileReference = one_of({0, 1, 1, 5});
        s.out.MasterStopDistance = uniform(1.0, 8.0);
        s.out.SyncOutDirection = one_of({1, 2, 3, 3});
        return start(s, "out", s.out);
      case 19:
        s.additive.Position = uniform(-5.0, 5.0);
        s.additive.Enable = chance(0.7);
        return;
      case 20:
        s.simulation.Enable = !s.simulation.Enable && chance(0.5);
        if (told_) std::printf("%lld %s simulation %d\n", ticks_, s.axis.name.c_str(), s.simulation.Enable);
        return;
      default:
        if (chance(0.4)) {
          s.power.Enable = !s.power.Enable;
        } else {
          s.home.Mode = static_cast<INT>(pick(2));
          s.home.Position = uniform(-50.0, 50.0);
          start(s, "home", s.home);
        }
    }
  }

  template <class B>
  void shift(Station& s, const char* what, B& block, LREAL& by, LREAL& distance, LeadingObject* master,
             LeadingObject*& asked) {
    // Mostly by the axis that leads.
    asked = master;
    for (Station& one : stations_)
      if (one.axis.number == s.status().ActualMaster && chance(0.9)) asked = &one.axis;
    by = uniform(-10.0, 10.0);
    distance = uniform(1.0, 60.0);
    block.ProfileReference =
        std::string(what).starts_with("phase") ? one_of({0, 1, 2, 5}) : one_of({1, 2, 5});
    block.StartPosition = uniform(0.0, 360.0);
    if (Station* leading = master_of(s); leading != nullptr && chance(0.7))
      block.StartPosition = leading->axis.data.Position + uniform(-20.0, 20.0);
    block.Direction = one_of({1, 2, 3});
    start(s, what, block);
  }

  Station* master_of(Station& s) {
    for (Station& one : stations_)
      if (one.axis.number == s.status().ActualMaster) return &one;
    return nullptr;
  }

  void tick() {
    for (Station& s : stations_) {
      const AdditiveRequest& request = s.axis.additive_request;
      s.added_before = s.additive.Busy;
      s.added = request.counts ? request.value : AdditiveLeadingValue{};
    }
    rig_.tick();
    ++ticks_;
    for (Station& s : stations_) {
      SCOPED_TRACE(s.axis.name + " at " + std::to_string(ticks_));
      compare_pins(s);
      compare_chain(s);
    }
    fresh_ = nullptr;
  }

  /// A block that shows a state of its job, and the data block of its axis.
  void compare_pins(const Station& s) {
    const auto& status = s.status();
    const bool synchronous = s.bit(StatusBit::Synchronous);
    const bool synchronizing = s.bit(StatusBit::Synchronizing);
    const bool simulated = s.bit(SynchronizedMotionBit::InSimulation);
    const DINT function = status.FunctionState;
    const auto in_effect = [&](bool shown, DINT state) {
      if (shown) {
        EXPECT_EQ(function, state);
        EXPECT_NE(synchronous, simulated);
      }
    };
    in_effect(s.gear.InGear, 1);
    in_effect(s.pos[0]->InSync || s.pos[1]->InSync, 2);
    in_effect(s.velocity.InSync, 6);
    const auto on_the_way = [&](bool shown, DINT state) {
      if (shown) {
        EXPECT_EQ(function, state);
        EXPECT_TRUE(synchronizing);
      }
    };
    on_the_way(s.gear.Busy && !s.gear.InGear && !fresh(s.gear), 1);
    on_the_way(s.pos[0]->StartSync || s.pos[1]->StartSync, 2);
    on_the_way(s.velocity.StartSync, 6);
    for (const MC_GearInPos* pos : s.pos) {
      if (pos->Busy && !pos->StartSync && !pos->InSync && !fresh(*pos)) {
        EXPECT_TRUE(status.WaitingFunctionState == 2 || status.WaitingFunctionState == 4);
        ++seen_.waiting;
      }
    }
    EXPECT_FALSE(s.pos[0]->InSync && s.pos[1]->InSync);
    EXPECT_FALSE(synchronous && synchronizing);
    EXPECT_EQ(function == 0, status.ActualMaster == DB_ANY{} && !s.bit(Status2Bit::DesynchronizingCommand));
    EXPECT_EQ(simulated || synchronous || synchronizing, function != 0 && function != 4);
    if (s.out.StartSyncOut) {
      EXPECT_TRUE(s.bit(Status2Bit::DesynchronizingCommand));
      EXPECT_EQ(function, 4);
      ++seen_.leaving;
    } else if (s.out.Busy && !fresh(s.out)) {
      EXPECT_EQ(status.WaitingFunctionState, 4);
      ++seen_.leaving_waits;
    }
    EXPECT_EQ(s.bit(Status2Bit::DesynchronizingCommand), function == 4);
    compare_shifts(s);
    EXPECT_EQ(s.simulation.InSimulation, simulated);
    EXPECT_EQ(s.added_before, s.bit(SynchronizedMotionBit::LeadingValueAdditiveCommand));
    if (function == 0) {
      EXPECT_EQ(status.PhaseShift, 0.0);
      EXPECT_EQ(status.Offset, 0.0);
      EXPECT_EQ(static_cast<std::uint32_t>(status.StatusWord) & ~16u, 0u);
    }
    EXPECT_TRUE(!s.bit(StatusBit::NonPositionControlled) || s.axis.data.Position == 0.0);
    one_end(s.gear), one_end(*s.pos[0]), one_end(*s.pos[1]), one_end(s.phase), one_end(s.phase_to);
    one_end(s.offset), one_end(s.offset_to), one_end(s.out);
    seen_.synchronous += synchronous;
    seen_.synchronizing += synchronizing;
    seen_.simulated += simulated;
    seen_.added += s.additive.Busy;
  }

  void compare_shifts(const Station& s) {
    const bool phasing = s.phase.StartPhasing || s.phase_to.StartPhasing;
    const bool offsetting = s.offset.StartOffset || s.offset_to.StartOffset;
    EXPECT_TRUE(!phasing || s.bit(StatusBit::PhasingCommand));
    EXPECT_TRUE(!offsetting || s.bit(Status2Bit::OffsetCommand));
    const auto waits = [&](const auto& block, bool runs) { return block.Busy && !runs && !fresh(block); };
    const bool phasing_waits =
        waits(s.phase, s.phase.StartPhasing) || waits(s.phase_to, s.phase_to.StartPhasing);
    const bool offset_waits =
        waits(s.offset, s.offset.StartOffset) || waits(s.offset_to, s.offset_to.StartOffset);
    EXPECT_TRUE(!phasing_waits || s.bit(Status2Bit::PhasingCommandWaiting));
    EXPECT_TRUE(!offset_waits || s.bit(Status2Bit::OffsetCommandWaiting));
    EXPECT_FALSE((phasing || s.bit(StatusBit::PhasingCommand)) && offsetting);
    seen_.phasing += phasing;
    seen_.offsetting += offsetting;
  }

  /// Handed over in this call: the axis takes it over in its next tick.
  template <class B>
  bool fresh(const B& block) const {
    return fresh_ == &block;
  }

  template <class B>
  static void one_end(const B& block) {
    EXPECT_LE(int{block.Busy} + int{block.Done} + int{block.CommandAborted} + int{block.Error}, 1)
        << B::kName;
    EXPECT_EQ(block.Error, block.ErrorID != WORD{}) << B::kName;
  }

  static double off(double a, double b, const Modulo& modulo) {
    return modulo.enabled ? std::abs(std::remainder(a - b, modulo.length)) : std::abs(a - b);
  }

  /// The terms of the chain, as the data blocks show them in this tick.
  void compare_chain(Station& s) {
    if (s.status().FunctionState == 0 || s.status().FunctionState == 4) return;
    Station* const leading = master_of(s);
    ASSERT_NE(leading, nullptr);
    const auto& status = s.status();
    const bool by_velocity = status.FunctionState == 6;
    if (leading->axis.position_controlled() && !left_control_) {
      EXPECT_LT(off(status.EffectiveLeadingValue.Position, leading->axis.data.Position + s.added.position,
                    leading->axis.modulo()),
                1e-8);
    }
    if (!leading->axis.position_controlled()) left_control_ = true;
    EXPECT_LT(off(status.FunctionLeadingValue.Position,
                  status.EffectiveLeadingValue.Position + status.PhaseShift, leading->axis.modulo()),
              1e-8);
    if (!s.bit(StatusBit::Synchronous) || by_velocity) return;
    const double led = status.FunctionFollowingValue.Position + status.Offset;
    const double added = s.axis.data.StatusPositioning.SuperimposedDistance;
    EXPECT_LT(std::min(off(s.axis.data.Position, led + added, s.axis.modulo()),
                       off(s.axis.data.Position, led - added, s.axis.modulo())),
              1e-8);
  }

  std::mt19937_64 random_;
  bool told_;
  Seen& seen_;
  Rig rig_;
  std::vector<Station> stations_;
  LeadingObject* unused_ = nullptr;
  const Block* fresh_ = nullptr;  // started by this tick's call
  long long ticks_ = 0;
  bool left_control_ = false;
  int parts_before_ = parts();
};

TEST(PinsAndDataBlocks, TellTheSameInEveryTickOfRandomJobs) {
  Seen seen;
  const test::Cases ran =
      test::for_each_seed(kFirstSeed, test::cases(kSequences, kSoakSequences),
                          [&](const test::Case& one) { Sequence(one.seed, one.alone, seen).run(); });
  std::printf(
      "ticks synchronous %d, synchronizing %d, waiting %d, leaving %d, waiting to leave %d, phasing %d, "
      "with an offset %d, simulated %d, added %d\n",
      seen.synchronous, seen.synchronizing, seen.waiting, seen.leaving, seen.leaving_waits, seen.phasing,
      seen.offsetting, seen.simulated, seen.added);
  if (ran.alone || HasFailure()) return;
  for (const int happened : {seen.synchronous, seen.synchronizing, seen.waiting, seen.leaving,
                             seen.leaving_waits, seen.phasing, seen.offsetting, seen.simulated, seen.added})
    EXPECT_GT(happened, ran.count) << "a test of what does not happen";
}

}  // namespace
}  // namespace lockstep::coupling_status_test
