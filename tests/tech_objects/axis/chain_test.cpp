// The chain of a synchronous axis under leading motion at random: whatever the leading axis does and
// whichever shifts and superimposed motions are under way, Position is the function of the same tick's
// values, exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "fb/gear_in.hpp"
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

namespace lockstep::chain_test {
namespace {

using test::Continuity;
using test::Rig;

/// 113 bits: sums of positions and turns are exact in it, quotients far finer than what is compared.
__extension__ using Wide = __float128;

constexpr std::uint64_t kFirstSeed = 20261;
constexpr int kSequences = 1000;
constexpr int kSoakSequences = 100000;
constexpr int kShifts = 1000;
constexpr int kSoakShifts = 100000;
constexpr int kActions = 16;

Wide magnitude(Wide value) {
  return value < 0 ? -value : value;
}
double ulp(double value) {
  const double a = std::abs(value);
  return std::nextafter(a, std::numeric_limits<double>::infinity()) - a;
}
/// Position of an axis with its turns.
Wide unrolled(AxisPosition position, const Modulo& modulo) {
  return static_cast<Wide>(position.value) +
         (modulo.enabled ? static_cast<Wide>(position.turns) * modulo.length : Wide{0});
}

/// A leading and a following axis with everything that acts on the chain between them.
struct Chain : Rig {
  Chain(const Modulo& leading, const Modulo& following, DINT numerator, DINT denominator)
      : l(axis("Leading", [&](AxisData& data) { put(data, leading); })),
        f(axis("Following", [&](AxisData& data) { put(data, following); })),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_l(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        halt_l(block<MC_Halt>()),
        gear(block<MC_GearIn>()),
        phase(block<MC_PhasingRelative>()),
        phase_to(block<MC_PhasingAbsolute>()),
        offset(block<MC_OffsetRelative>()),
        offset_to(block<MC_OffsetAbsolute>()),
        additive(block<MC_LeadingValueAdditive>()),
        superimpose(block<MC_MoveSuperimposed>()),
        halt_superimposed(block<MC_HaltSuperimposed>()) {
    lead(f, l);
    continuity[0].velocity = continuity[1].velocity = false;  // watched here, with what is published
    power_l.Axis = home_l.Axis = run_l.Axis = halt_l.Axis = &l;
    power_f.Axis = additive.Axis = superimpose.Axis = halt_superimposed.Axis = &f;
    gear.Master = phase.Master = phase_to.Master = &l;
    gear.Slave = phase.Slave = phase_to.Slave = offset.Slave = offset_to.Slave = &f;
    gear.RatioNumerator = numerator;
    gear.RatioDenominator = denominator;
    power_l.Enable = power_f.Enable = true;
    Rig::run(3);
  }

  static void put(AxisData& data, const Modulo& modulo) {
    data.Modulo.Enable = modulo.enabled;
    if (!modulo.enabled) return;
    data.Modulo.Length = modulo.length;
    data.Modulo.StartValue = modulo.start;
  }

  /// Effective leading value with its turns, from the published one.
  Wide effective() const {
    const double shown = f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Position;
    if (!l.modulo().enabled) return shown;
    const Wide about = unrolled(l.setpoint().position, l.modulo()) + added;
    const auto turns = static_cast<double>((about - shown) / l.modulo().length);
    return shown + static_cast<Wide>(std::nearbyint(turns)) * l.modulo().length;
  }

  /// The axis has become synchronous: function and following value belong together here.
  void anchor() {
    leading_start = effective();
    following_start = unrolled(f.setpoint().position, f.modulo());
  }

  /// How far Position is from F(EffectiveLeadingValue + PhaseShift) + Offset + superimposed part, in units of
  /// what is permitted. Of the superimposed part the data block shows the size; it has either sign.
  double deviation() const {
    const auto& status = f.data.StatusSynchronizedMotion;
    const auto geared = [&](Wide distance) { return distance * gear.RatioNumerator / gear.RatioDenominator; };
    const Wide leading_part = geared(effective() - leading_start);
    const Wide phase_part = geared(status.PhaseShift);
    const LREAL superimposed = f.data.StatusPositioning.SuperimposedDistance;
    const Wide led = following_start + leading_part + phase_part + status.Offset;
    const Wide position = unrolled(f.setpoint().position, f.modulo());
    const Wide off =
        std::min(magnitude(position - led - superimposed), magnitude(position - led + superimposed));
    // On a ring far from zero a position has no finer steps than those of its own size.
    double largest = std::max({f.modulo().length, std::abs(f.modulo().start), std::abs(f.modulo().end())});
    if (!f.modulo().enabled) {
      largest = 0.0;
      for (const Wide term :
           {following_start, leading_part, phase_part, static_cast<Wide>(status.Offset),
            static_cast<Wide>(superimposed), geared(effective()), geared(leading_start), position})
        largest = std::max(largest, static_cast<double>(magnitude(term)));
    }
    // The shifts are shown rounded; the chain has them with their rounding error.
    const double shown =
        0.5 * (std::abs(ratio()) * ulp(status.PhaseShift) + ulp(status.Offset) + ulp(superimposed));
    return static_cast<double>(off) / (4.0 * ulp(largest) + shown);
  }

  double ratio() const { return static_cast<double>(gear.RatioNumerator) / gear.RatioDenominator; }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home_l;
  MC_MoveVelocity& run_l;
  MC_Halt& halt_l;
  MC_GearIn& gear;
  MC_PhasingRelative& phase;
  MC_PhasingAbsolute& phase_to;
  MC_OffsetRelative& offset;
  MC_OffsetAbsolute& offset_to;
  MC_LeadingValueAdditive& additive;
  MC_MoveSuperimposed& superimpose;
  MC_HaltSuperimposed& halt_superimposed;
  Wide leading_start{};
  Wide following_start{};
  double added = 0.0;  ///< additive leading value of this tick
};

// ---- Sequences at random
// ----------------------------------------------------------------------------------------

struct Seen {
  int ticks = 0, shifted = 0, wraps = 0, homed = 0, added = 0, reversed = 0, superimposed = 0, halted = 0;
  double worst = 0.0;  // deviation, of what is permitted
};

class Sequence {
 public:
  Sequence(std::uint64_t seed, Seen& seen)
      : random_(seed), seen_(seen), chain_(modulo(), modulo(), numerator(), 250 + pick(750)) {
    // With which a shift comes to rest before another one waits.
    auto& limits = chain_.f.data.DynamicLimits;
    limits.MaxAcceleration = limits.MaxDeceleration = 5000.0;
    limits.MaxJerk = 200000.0;
  }

  void run() {
    run_at(uniform(-100.0, 100.0));
    chain_.run(1 + pick(40));
    chain_.gear.Execute = true;
    const bool in_gear = static_cast<bool>(chain_.run_until([&] { return chain_.gear.InGear; }, 4000));
    ASSERT_TRUE(in_gear);
    chain_.anchor();
    for (int i = 0; i < kActions && !::testing::Test::HasFatalFailure(); ++i) {
      act();
      for (int ticks = 5 + pick(150); ticks > 0 && !::testing::Test::HasFatalFailure(); --ticks) tick();
    }
  }

 private:
  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Modulo modulo() {
    constexpr double kLengths[] = {360.0, 100.0 / 3.0, 0.1 * 71.0, 1024.0, 6.283185307179586, 359.9};
    if (chance(0.3)) return {};
    return {true, kLengths[pick(6)], chance(0.5) ? 0.0 : uniform(-200.0, 50.0)};
  }
  DINT numerator() {
    const DINT amount = 1 + pick(997);
    return chance(0.3) ? -amount : amount;
  }

  void run_at(double velocity) {
    chain_.run_l.Velocity = velocity;
    chain_.run_l.Execute = false;
    tick_unwatched();
    chain_.run_l.Execute = true;
  }

  void tick_unwatched() {
    if (chain_.gear.InGear) return tick();
    chain_.tick();
  }

  void act() {
    const int kind = pick(13);
    if (kind == 10) return start(chain_.halt_superimposed);
    if (kind > 10) return superimpose();
    if (kind < 3) return run_at(chance(0.2) ? 0.0 : uniform(-120.0, 120.0));
    if (kind == 3) return start(chain_.halt_l);
    if (kind == 4) return home();
    if (kind == 5) return add();
    if (kind < 8) {
      chance(0.5) ? shift_phase(chain_.phase) : shift_phase(chain_.phase_to);
    } else {
      chance(0.5) ? shift_following(chain_.offset) : shift_following(chain_.offset_to);
    }
  }

  template <class B>
  void start(B& block) {
    block.Execute = false;
    tick();
    block.Execute = true;
  }

  void home() {
    chain_.home_l.Mode = static_cast<INT>(pick(2));
    chain_.home_l.Position = uniform(-300.0, 300.0);
    start(chain_.home_l);
    step_until_ = ticks_ + 2;
    ++seen_.homed;
  }

  void add() {
    chain_.additive.Position = uniform(-50.0, 50.0);
    chain_.additive.Enable = chance(0.7);
    step_until_ = ticks_ + 2;
    ++seen_.added;
  }

  void superimpose() {
    chain_.superimpose.Distance = uniform(-20.0, 20.0);
    chain_.superimpose.VelocityDiff = uniform(5.0, 50.0);
    // Less than what a jerk may make of an acceleration within a tick: without jerk it comes and goes there.
    chain_.superimpose.Acceleration = uniform(50.0, 400.0);
    chain_.superimpose.Deceleration = uniform(50.0, 400.0);
    chain_.superimpose.Jerk = chance(0.3) ? 0.0 : uniform(500.0, 20000.0);
    start(chain_.superimpose);
  }

  template <class B>
  void shift_phase(B& block) {
    block.PhaseShift = uniform(-8.0, 8.0);
    constexpr DINT kProfiles[] = {0, 0, 1, 1, 2, 5};
    block.ProfileReference = kProfiles[pick(6)];
    block.PhasingDistance = uniform(20.0, 60.0);
    block.StartPosition = chain_.l.data.Position + uniform(-5.0, 5.0);
    block.Direction = 1 + pick(3);
    start(block);
  }

  template <class B>
  void shift_following(B& block) {
    block.Offset = uniform(-8.0, 8.0);
    constexpr DINT kProfiles[] = {1, 1, 2, 5};
    block.ProfileReference = kProfiles[pick(4)];
    block.OffsetDistance = uniform(20.0, 60.0);
    block.StartPosition = chain_.l.data.Position + uniform(-5.0, 5.0);
    block.Direction = 1 + pick(3);
    start(block);
  }

  /// A bit for each block that shows a reversal.
  unsigned reversals() const {
    const WORD id = static_cast<WORD>(ErrorId::leading_value_reversed);
    return (chain_.phase.ErrorID == id ? 1u : 0u) | (chain_.phase_to.ErrorID == id ? 2u : 0u) |
           (chain_.offset.ErrorID == id ? 4u : 0u) | (chain_.offset_to.ErrorID == id ? 8u : 0u);
  }

  void tick() {
    const Setpoint before = chain_.f.setpoint();
    const std::int64_t turn = chain_.l.setpoint().position.turns;
    const unsigned had_reversed = reversals();
    const AdditiveRequest& additive = chain_.f.additive_request;
    chain_.added = additive.owner != nullptr ? additive.value.position : 0.0;
    chain_.tick();
    ++ticks_;
    ++seen_.ticks;
    seen_.shifted += chain_.phase.StartPhasing || chain_.phase_to.StartPhasing || chain_.offset.StartOffset ||
                     chain_.offset_to.StartOffset;
    seen_.superimposed += chain_.superimpose.Busy;
    seen_.halted += chain_.halt_superimposed.Busy;
    seen_.wraps += chain_.l.setpoint().position.turns != turn;
    const bool reverses = (reversals() & ~had_reversed) != 0;
    seen_.reversed += reverses;
    ASSERT_TRUE(chain_.gear.InGear);
    const double deviation = chain_.deviation();
    seen_.worst = std::max(seen_.worst, deviation);
    ASSERT_LE(deviation, 1.0) << "off the chain at " << ticks_;
    if (ticks_ <= step_until_ || reverses) return;  // a shift given up by a reversal rests from there on
    expect_no_step(before, chain_.f.setpoint());
  }

  /// Position and velocity are the integrals of what the axis shows, up to a jerk between the ticks.
  void expect_no_step(const Setpoint& before, const Setpoint& now) {
    const double dt = chain_.period();
    const double change = std::abs(now.acceleration - before.acceleration);
    const double highest_jerk = 2e5 * (2.0 + std::abs(chain_.ratio()));
    const double distance = difference(now.position, before.position, chain_.f.modulo()).rounded();
    const double rounding = 8.0 * ulp(std::max(std::abs(now.position.value), chain_.f.modulo().length));
    ASSERT_NEAR(distance, 0.5 * (before.velocity + now.velocity) * dt,
                dt * dt * (change + highest_jerk * dt) + rounding)
        << "step of the position at " << ticks_;
    ASSERT_NEAR(now.velocity - before.velocity, 0.5 * (before.acceleration + now.acceleration) * dt,
                dt * (change + highest_jerk * dt) + 1e-9)
        << "step of the velocity at " << ticks_;
  }

  std::mt19937_64 random_;
  Seen& seen_;
  Chain chain_;
  std::int64_t ticks_ = 0;
  std::int64_t step_until_ = 0;  // homing of the leading axis and additive values are published steps
};

TEST(Chain, IsExactInEveryTickUnderLeadingMotionAtRandom) {
  Seen seen;
  const test::Cases ran = test::for_each_seed(kFirstSeed, test::cases(kSequences, kSoakSequences),
                                              [&](const test::Case& one) { Sequence(one.seed, seen).run(); });
  std::printf(
      "%d ticks, %d in a shift, %d wraps, %d homings, %d additive values, "
      "%d reversals, %d while superimposed, %d of these halting; worst %.2f of what is permitted\n",
      seen.ticks, seen.shifted, seen.wraps, seen.homed, seen.added, seen.reversed, seen.superimposed,
      seen.halted, seen.worst);
  if (ran.alone || HasFailure()) return;
  for (const int happened :
       {seen.shifted, seen.wraps, seen.homed, seen.added, seen.reversed, seen.superimposed, seen.halted})
    EXPECT_GT(happened, ran.count / 10) << "a test of what does not happen";
}

/// A phasing over time is replaced by one over distance while the leading axis stands.
TEST(Chain, AMovingShiftComesToRestWhileTheLeadingValueThatIsToLeadItOnStands) {
  Chain chain({}, {}, 1, 1);
  chain.gear.Execute = true;
  ASSERT_TRUE(chain.run_until([&] { return chain.gear.InGear; }));
  chain.continuity[1] = Continuity{.highest_acceleration = 1e5, .highest_jerk = 1e9};
  chain.phase.PhaseShift = 50.0;
  chain.phase.Execute = true;
  chain.run(100);
  ASSERT_GT(chain.f.data.Velocity, 10.0);
  chain.phase_to.PhaseShift = 20.0;
  chain.phase_to.ProfileReference = 1;
  chain.phase_to.PhasingDistance = 40.0;
  chain.phase_to.Execute = true;
  chain.run(100);
  EXPECT_TRUE(chain.phase.CommandAborted);
  EXPECT_TRUE(chain.phase_to.StartPhasing);
  EXPECT_EQ(chain.f.data.Velocity, 0.0);
  chain.run_l.Velocity = 50.0;
  chain.run_l.Execute = true;
  ASSERT_TRUE(chain.run_until([&] { return chain.phase_to.Done; }));
  EXPECT_EQ(chain.f.data.StatusSynchronizedMotion.PhaseShift, 20.0);
}

/// Profile 5 ends a job that waits while the shift before it has not come to rest yet.
TEST(Chain, AMovingShiftComesToRestAlsoWhenTheJobThatReplacedItIsCancelled) {
  Chain chain({}, {}, 1, 1);
  chain.gear.Execute = true;
  ASSERT_TRUE(chain.run_until([&] { return chain.gear.InGear; }));
  chain.f.data.DynamicLimits.MaxAcceleration = chain.f.data.DynamicLimits.MaxDeceleration = 500.0;
  chain.continuity[1] = Continuity{.highest_acceleration = 1e3, .highest_jerk = 1e9};
  chain.phase.PhaseShift = 50.0;
  chain.phase.Execute = true;
  chain.run(150);
  chain.phase_to.ProfileReference = 2;
  chain.phase_to.PhasingDistance = 40.0;
  chain.phase_to.StartPosition = 500.0;
  chain.phase_to.Execute = true;
  chain.run(5);
  ASSERT_GT(chain.f.data.Velocity, 10.0);
  chain.phase.Execute = false;
  chain.tick();
  chain.phase.ProfileReference = 5;
  chain.phase.Execute = true;
  chain.run(3);
  EXPECT_TRUE(chain.phase.Done);
  EXPECT_TRUE(chain.phase_to.CommandAborted);
  chain.run(500);
  EXPECT_EQ(chain.f.data.Velocity, 0.0);
}

// ---- Sums of shifts
// ---------------------------------------------------------------------------------------------

/// Runs `count` shifts one after another and compares each shown sum with the exact one, rounded.
template <class B>
void expect_exact_sums(Chain& chain, B& block, int count, const LREAL& shown) {
  chain.gear.Execute = true;
  ASSERT_TRUE(chain.run_until([&] { return chain.gear.InGear; }));
  chain.run_l.Velocity = 1000.0;
  chain.run_l.Execute = true;
  ASSERT_TRUE(chain.run_until([&] { return chain.run_l.InVelocity; }));
  Wide exact = 0;
  for (int i = 0; i < count; ++i) {
    block.Execute = true;
    chain.tick();
    for (int k = 0; k < 20 && !block.Done; ++k) chain.tick();
    ASSERT_TRUE(block.Done);
    block.Execute = false;
    chain.tick();
    exact += 0.1;
    ASSERT_EQ(shown, static_cast<double>(exact)) << "after " << i + 1;
  }
}

TEST(Chain, ThePhaseShiftAfterManyShiftsOfATenthIsTheRoundedExactSum) {
  Chain chain({true, 360.0, 0.0}, {true, 100.0 / 3.0, 0.0}, 7, 3);
  chain.phase.PhaseShift = 0.1;
  chain.phase.ProfileReference = 1;
  chain.phase.PhasingDistance = 2.0;
  expect_exact_sums(chain, chain.phase, test::cases(kShifts, kSoakShifts),
                    chain.f.data.StatusSynchronizedMotion.PhaseShift);
}

TEST(Chain, TheOffsetAfterManyShiftsOfATenthIsTheRoundedExactSum) {
  Chain chain({true, 360.0, 0.0}, {}, 7, 3);
  chain.offset.Offset = 0.1;
  chain.offset.ProfileReference = 1;
  chain.offset.OffsetDistance = 2.0;
  expect_exact_sums(chain, chain.offset, test::cases(kShifts, kSoakShifts),
                    chain.f.data.StatusSynchronizedMotion.Offset);
}

// ---- A profile over leading distance
// ----------------------------------------------------------------------------

/// A leading axis at 50 u/s and a following one that is being synchronized over 200 u.
struct Synchronizing : Chain {
  Synchronizing() : Chain({}, {}, 1, 1), pos(block<MC_GearInPos>()) {
    home_in_place(f);
    run(3);
    pos.Master = &l;
    pos.Slave = &f;
    pos.MasterSyncPosition = 300.0;
    pos.MasterStartDistance = 200.0;
    pos.SlaveSyncPosition = 10.0;
    pos.Execute = true;
    run_l.Velocity = 50.0;
    run_l.Execute = true;
    EXPECT_TRUE(run_until([&] { return l.data.Position > 150.0; }));
    EXPECT_TRUE(pos.StartSync);
  }
  void home_leading_by(double distance) {
    home_l.Mode = 1;
    home_l.Position = distance;
    home_l.Execute = true;
    run(2);
  }
  MC_GearInPos& pos;
};

TEST(Profile, OfALeadingAxisHomedForwardsGoesOnAtTheNewPlace) {
  Synchronizing other;
  ASSERT_TRUE(other.run_until([&] { return other.l.data.Position > 250.0; }));
  Synchronizing rig;
  rig.home_leading_by(100.0);
  EXPECT_TRUE(rig.pos.StartSync);
  EXPECT_NEAR(rig.f.data.Position, other.f.data.Position, 0.5);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_EQ(rig.f.data.Position, 10.0 + (rig.l.data.Position - 300.0));
}

TEST(Profile, OfALeadingAxisHomedBackwardsHasReversed) {
  Synchronizing rig;
  rig.home_leading_by(-20.0);
  EXPECT_TRUE(rig.pos.Error);
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 608u);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.data.Velocity == 0.0; }));
}

// ---- Out of a motion beyond the limits
// --------------------------------------------------------------------------

TEST(MC_GearOut, WithDynamicsFromBeyondTheVelocityLimitIsNotFasterThanItWas) {
  Chain rig({}, {}, 2, 1);
  auto& out = rig.block<MC_GearOut>();
  out.Slave = &rig.f;
  out.SyncProfileReference = 0;
  rig.f.data.DynamicLimits.MaxVelocity = rig.f.data.DynamicLimits.Velocity = 80.0;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.run_l.Velocity = 500.0;
  rig.run_l.Acceleration = 100.0;
  rig.run_l.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.f.data.Velocity > 100.0; }));
  ASSERT_GT(rig.f.data.Acceleration, 100.0);
  out.SlavePosition = rig.f.data.Position + 300.0;
  out.Deceleration = 100.0;
  out.Execute = true;
  double fastest = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    if (!out.StartSyncOut && !out.Done) fastest = rig.f.data.Velocity;
    EXPECT_LE(rig.f.data.Velocity, fastest + 0.201) << "the tick in which it begins counts";
    return out.Done;
  }));
  EXPECT_EQ(rig.f.data.Position, out.SlavePosition);
}

}  // namespace
}  // namespace lockstep::chain_test
