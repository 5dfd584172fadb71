// Rules of couplings that hold for all of their kinds: who may lead, which limits count in which phase, which
// direction a job asks for, and what goes on when the leading axis is another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::coupling_rules_test {
namespace {

using test::Rig;

void line(AxisData& /*data*/) {}
void ring(AxisData& data) {
  data.Modulo.Enable = true;
}
bool bit2(const Axis& axis, Status2Bit which) {
  return has_bit(axis.data.StatusWord2, which);
}

/// Two axes that may lead, and one that follows.
struct Coupled : Rig {
  using Configure = std::function<void(AxisData&)>;

  explicit Coupled(const Configure& leading = line, const Configure& following = line)
      : l(axis("Leading", leading)),
        m(axis("Another", leading)),
        f(axis("Following", following)),
        power_f(power(f)),
        run_l(block<MC_MoveVelocity>()),
        run_m(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        velocity(block<MC_GearInVelocity>()),
        out(block<MC_GearOut>()),
        phase(block<MC_PhasingAbsolute>()),
        offset(block<MC_OffsetAbsolute>()),
        additive(block<MC_LeadingValueAdditive>()) {
    lead(f, l);
    lead(f, m);
    power(l), power(m);
    run_l.Axis = &l;
    run_m.Axis = &m;
    additive.Axis = &f;
    gear.Master = pos.Master = velocity.Master = phase.Master = &l;
    gear.Slave = pos.Slave = velocity.Slave = out.Slave = phase.Slave = offset.Slave = &f;
    velocity.PositionControlled = true;
    home_in_place(f);
    Rig::run(30);
    continuity[2].highest_acceleration = 1e6;
    continuity[2].highest_jerk = 1e9;
  }

  MC_Power& power(Axis& of) {
    auto& made = block<MC_Power>();
    made.Axis = &of;
    made.Enable = true;
    return made;
  }
  template <class B>
  void start(B& job) {
    job.Execute = false;
    tick();
    job.Execute = true;
  }
  void run_at(MC_MoveVelocity& run, double speed) {
    run.Velocity = speed;
    start(run);
    ASSERT_TRUE(run_until([&] { return run.InVelocity; }));
  }
  const TO_Struct_StatusSynchronizedMotion& status() const { return f.data.StatusSynchronizedMotion; }
  bool shows(SynchronizedMotionBit which) const { return has_bit(status().StatusWord, which); }

  Axis& l;
  Axis& m;
  Axis& f;
  MC_Power& power_f;
  MC_MoveVelocity& run_l;
  MC_MoveVelocity& run_m;
  MC_GearIn& gear;
  MC_GearInPos& pos;
  MC_GearInVelocity& velocity;
  MC_GearOut& out;
  MC_PhasingAbsolute& phase;
  MC_OffsetAbsolute& offset;
  MC_LeadingValueAdditive& additive;
};

// ---- Who leads
// --------------------------------------------------------------------------------------------------

TEST(PositioningAxis, LeadsSeveralAxesByEveryKindOfGear) {
  Rig rig;
  Axis& leading = rig.controller.add_axis(ObjectKind::TO_PositioningAxis, "Leading");
  leading.data.VirtualAxis.Mode = 1;
  rig.continuity.emplace_back();
  Axis* following[] = {&rig.axis("One"), &rig.axis("Two"), &rig.axis("Three")};
  auto& run = rig.block<MC_MoveVelocity>();
  auto& gear = rig.block<MC_GearIn>();
  auto& pos = rig.block<MC_GearInPos>();
  auto& velocity = rig.block<MC_GearInVelocity>();
  for (Axis* axis : {&leading, following[0], following[1], following[2]}) {
    auto& power = rig.block<MC_Power>();
    power.Axis = axis;
    power.Enable = true;
    if (axis != &leading) rig.lead(*axis, leading);
  }
  run.Axis = &leading;
  gear.Master = pos.Master = velocity.Master = &leading;
  gear.Slave = following[0];
  pos.Slave = following[1];
  velocity.Slave = following[2];
  gear.RatioNumerator = -2;
  pos.RatioNumerator = 3;
  pos.MasterSyncPosition = 60.0;
  pos.SlaveSyncPosition = 25.0;
  pos.MasterStartDistance = 40.0;
  velocity.RatioDenominator = 4;
  rig.continuity[2].highest_jerk = 1e8;
  rig.home_in_place(*following[1]);
  rig.run(5);
  run.Velocity = 50.0;
  run.Execute = gear.Execute = pos.Execute = velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return gear.InGear && pos.InSync && velocity.InSync; }));
  run.Execute = false;
  rig.tick();
  run.Velocity = -20.0;
  run.Execute = true;
  const double at_gear = following[0]->data.Position + 2.0 * leading.data.Position;
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    const double led = leading.data.Position;
    ASSERT_NEAR(following[0]->data.Position, at_gear - 2.0 * led, 1e-10);
    ASSERT_NEAR(following[1]->data.Position, 25.0 + 3.0 * (led - 60.0), 1e-10);
    ASSERT_EQ(following[2]->data.Velocity, leading.data.Velocity / 4.0);
    for (const Axis* axis : following)
      ASSERT_EQ(axis->data.StatusSynchronizedMotion.ActualMaster, leading.number);
  }
}

TEST(RecursiveCoupling, IsRefusedThroughSeveralAxesWhateverKindOfGearWouldCloseIt) {
  for (const int kind : {0, 1, 2}) {
    Rig rig;
    Axis* axes[] = {&rig.axis("A"), &rig.axis("B"), &rig.axis("C"), &rig.axis("D")};
    MC_GearIn* gears[4];
    for (std::size_t i = 0; i < 4; ++i) {
      auto& power = rig.block<MC_Power>();
      power.Axis = axes[i];
      power.Enable = true;
      Axis& master = *axes[(i + 3) % 4];
      rig.lead(*axes[i], master);
      gears[i] = &rig.block<MC_GearIn>();
      gears[i]->Slave = axes[i];
      gears[i]->Master = &master;
    }
    auto& pos = rig.block<MC_GearInPos>();
    auto& velocity = rig.block<MC_GearInVelocity>();
    pos.Slave = velocity.Slave = axes[0];
    pos.Master = velocity.Master = axes[3];
    rig.home_in_place(*axes[0]);
    rig.run(5);
    gears[1]->Execute = gears[2]->Execute = gears[3]->Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return gears[1]->InGear && gears[2]->InGear && gears[3]->InGear; }));
    if (kind == 0) gears[0]->Execute = true;
    if (kind == 1) pos.Execute = true;  // both stand on their positions: active at once
    if (kind == 2) velocity.Execute = true;
    rig.run(4);
    const WORD shown = kind == 0 ? gears[0]->ErrorID : kind == 1 ? pos.ErrorID : velocity.ErrorID;
    EXPECT_EQ(shown, static_cast<WORD>(0x8019)) << kind;
    EXPECT_TRUE(gears[1]->InGear && gears[2]->InGear && gears[3]->InGear) << kind;
  }
}

TEST(RecursiveCoupling, OfTwoAxesInOneTickIsRefusedToOneOfThem) {
  Rig rig;
  Axis* axes[] = {&rig.axis("A"), &rig.axis("B")};
  MC_GearIn* gears[2];
  for (std::size_t i = 0; i < 2; ++i) {
    auto& power = rig.block<MC_Power>();
    power.Axis = axes[i];
    power.Enable = true;
    rig.lead(*axes[i], *axes[1 - i]);
    gears[i] = &rig.block<MC_GearIn>();
    gears[i]->Slave = axes[i];
    gears[i]->Master = axes[1 - i];
  }
  rig.run(5);
  gears[0]->Execute = gears[1]->Execute = true;
  rig.run(3);
  EXPECT_NE(gears[0]->InGear, gears[1]->InGear);
  EXPECT_TRUE(gears[0]->ErrorID == static_cast<WORD>(0x8019) ||
              gears[1]->ErrorID == static_cast<WORD>(0x8019));
}

// ---- Limits
// -----------------------------------------------------------------------------------------------------

TEST(LimitsOfACoupling, CountUntilItIsSynchronousAndAgainOnceItIsOverridden) {
  Coupled rig(line, [](AxisData& data) {
    data.DynamicLimits.MaxVelocity = 100.0;
    data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = 500.0;
    data.DynamicLimits.MaxJerk = 20000.0;
  });
  rig.run_at(rig.run_l, 30.0);
  rig.gear.RatioNumerator = 3;
  rig.gear.Acceleration = 5000.0;  // is cut to the limit
  rig.gear.Jerk = 1e6;
  rig.continuity[2].highest_acceleration = 500.0;
  rig.continuity[2].highest_jerk = 20000.0;
  rig.start(rig.gear);
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  EXPECT_FALSE(rig.shows(SynchronizedMotionBit::MaxVelocityExceeded));
  rig.continuity[2].highest_acceleration = 1e5;
  rig.continuity[2].highest_jerk = 1e8;
  rig.run_at(rig.run_l, 60.0);
  EXPECT_EQ(rig.f.data.Velocity, 180.0);
  EXPECT_TRUE(rig.shows(SynchronizedMotionBit::MaxVelocityExceeded));
  EXPECT_FALSE(rig.shows(SynchronizedMotionBit::MaxAccelerationExceeded));
  auto& run_f = rig.block<MC_MoveVelocity>();
  run_f.Axis = &rig.f;
  run_f.Velocity = 1000.0;
  rig.continuity[2].highest_acceleration = 500.0;
  rig.continuity[2].highest_jerk = 20000.0;
  rig.start(run_f);
  ASSERT_TRUE(rig.run_until([&] { return run_f.InVelocity; }));
  EXPECT_EQ(rig.f.data.Velocity, 100.0);
  EXPECT_TRUE(rig.gear.CommandAborted);
  EXPECT_FALSE(rig.shows(SynchronizedMotionBit::MaxVelocityExceeded));
}

TEST(LimitsOfACoupling, OfTheDriveCutItsVelocityAndNotThePosition) {
  Coupled rig(line, [](AxisData& data) {
    data.VirtualAxis.Mode = 0;
    data.Actor.DriveParameter.MaxSpeed = 600.0;  // 100 u/s
    data.FollowingError.EnableMonitoring = false;
  });
  rig.gear.RatioNumerator = 3;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  const double apart = rig.f.data.Position - 3.0 * rig.l.data.Position;
  rig.run_l.Velocity = 50.0;
  rig.run_l.Execute = true;
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.f.data.Position - 3.0 * rig.l.data.Position, apart, 1e-10);
    ASSERT_LE(std::abs(rig.f.data.VelocitySetpoint), 100.0 * (1.0 + 1e-12));
  }
  EXPECT_EQ(rig.f.data.Velocity, 150.0);
  EXPECT_NEAR(rig.f.data.ActualVelocity, 100.0, 1.0);
  EXPECT_GT(rig.f.data.StatusPositioning.FollowingError, 10.0);
  EXPECT_TRUE(rig.gear.InGear);
}

/// No rule forbids its leading value to reverse: only gears by position and cams have one.
TEST(MC_GearInVelocity, SynchronizesToALeadingAxisThatReversesMeanwhile) {
  for (const double jerk : {0.0, 5000.0}) {
    Coupled rig;
    rig.run_at(rig.run_l, 300.0);
    rig.velocity.RatioNumerator = 2;
    rig.velocity.Acceleration = rig.velocity.Deceleration = 400.0;
    rig.velocity.Jerk = jerk;
    rig.continuity[2] = {.acceleration = jerk > 0.0, .highest_acceleration = 400.0, .highest_jerk = 5000.0};
    rig.start(rig.velocity);
    rig.run(300);
    ASSERT_TRUE(rig.velocity.StartSync);
    rig.run_at(rig.run_l, -300.0);
    EXPECT_FALSE(rig.velocity.Error);
    EXPECT_EQ(rig.f.pending_alarm(), 0);
    EXPECT_TRUE(rig.velocity.StartSync);
    ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
    EXPECT_EQ(rig.f.data.Velocity, -600.0);
  }
}

// ---- Directions
// -------------------------------------------------------------------------------------------------

class Directions : public ::testing::TestWithParam<std::tuple<bool, DINT, DINT, int>> {};

/// The leading value first moves against the direction that is asked for, then in it.
TEST_P(Directions, OfAShiftAreThoseInWhichTheLeadingValueMoves) {
  const auto [on_ring, profile, direction, ratio] = GetParam();
  for (const bool phasing : {true, false}) {
    Coupled rig(on_ring ? ring : line, on_ring ? ring : line);
    rig.gear.RatioNumerator = ratio;
    rig.gear.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
    const double distance = direction == 1 ? 1.0 : -1.0;
    const double start = profile == 2 ? distance * 330.0 : -distance * 100.0;
    rig.phase.PhaseShift = rig.offset.Offset = 20.0;
    rig.phase.PhasingDistance = rig.offset.OffsetDistance = 60.0;
    rig.phase.StartPosition = rig.offset.StartPosition = on_ring ? start + 720.0 : start;
    rig.phase.ProfileReference = rig.offset.ProfileReference = profile;
    rig.phase.Direction = rig.offset.Direction = direction;
    rig.run_at(rig.run_l, -distance * 100.0);
    (phasing ? rig.phase.Execute : rig.offset.Execute) = true;
    ASSERT_TRUE(rig.run_until([&] {
      const AxisPosition there = rig.l.setpoint().position;
      return difference(there, {}, rig.l.modulo()).rounded() * distance <= -400.0;
    }));
    const auto runs = [&] { return phasing ? rig.phase.StartPhasing : rig.offset.StartOffset; };
    const auto waits = [&] {
      return bit2(rig.f, phasing ? Status2Bit::PhasingCommandWaiting : Status2Bit::OffsetCommandWaiting);
    };
    EXPECT_TRUE(waits() && !runs()) << phasing;
    EXPECT_EQ(phasing ? rig.status().PhaseShift : rig.status().Offset, 0.0);
    rig.run_l.Velocity = distance * 100.0;
    rig.start(rig.run_l);
    ASSERT_TRUE(rig.run_until([&] { return runs(); }));
    EXPECT_FALSE(waits());
    EXPECT_GT(distance * rig.l.data.Velocity, 0.0);
    const double begun = difference(rig.l.setpoint().position, {}, rig.l.modulo()).rounded();
    if (profile == 2) {
      const double place = on_ring ? std::remainder(begun - start, 360.0) : begun - start;
      EXPECT_NEAR(place, 0.0, 0.11) << phasing << " " << begun;
    }
    ASSERT_TRUE(rig.run_until([&] { return phasing ? rig.phase.Done : rig.offset.Done; }));
    const double ended = difference(rig.l.setpoint().position, {}, rig.l.modulo()).rounded();
    EXPECT_NEAR(std::abs(ended - begun), 60.0, 0.21) << phasing;
    EXPECT_EQ(phasing ? rig.status().PhaseShift : rig.status().Offset, 20.0);
    const double following = difference(rig.f.setpoint().position, {}, rig.f.modulo()).rounded();
    EXPECT_NEAR(following, phasing ? ratio * (ended + 20.0) : ratio * ended + 20.0, 1e-9) << phasing;
  }
}

/// MC_GearOut waits while the following axis moves against SyncOutDirection.
TEST_P(Directions, OfMC_GearOutAreThoseInWhichTheFollowingAxisMoves) {
  const auto [on_ring, profile, direction, ratio] = GetParam();
  const double beyond = 1500.0 * std::abs(ratio);
  Coupled rig(on_ring ? ring : line, on_ring ? ring : line);
  rig.gear.RatioNumerator = ratio;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  const double distance = direction == 1 ? 1.0 : -1.0;  // of the following axis
  const double led = ratio > 0 ? distance : -distance;
  rig.out.SyncProfileReference = profile - 1;  // 0, 1
  rig.out.SyncOutDirection = direction;
  rig.out.SlavePosition = on_ring ? 45.0 : distance * 45.0;
  rig.out.MasterStopDistance = 700.0;  // several turns of the following axis
  rig.out.Deceleration = 10.0;
  rig.run_at(rig.run_l, -led * 100.0);
  rig.start(rig.out);
  ASSERT_TRUE(rig.run_until([&] {
    const AxisPosition there = rig.f.setpoint().position;
    return difference(there, {}, rig.f.modulo()).rounded() * distance <= -beyond;
  }));
  EXPECT_TRUE(rig.out.Busy && !rig.out.StartSyncOut && rig.gear.InGear);
  rig.run_l.Velocity = led * 100.0;
  rig.start(rig.run_l);
  ASSERT_TRUE(rig.run_until([&] { return rig.out.StartSyncOut; }));
  double last = difference(rig.f.setpoint().position, {}, rig.f.modulo()).rounded();
  const double begun = last;
  ASSERT_TRUE(rig.run_until(
      [&] {
        const double now = difference(rig.f.setpoint().position, {}, rig.f.modulo()).rounded();
        EXPECT_GE((now - last) * distance, -1e-9);
        last = now;
        return rig.out.Done;
      },
      200000));
  EXPECT_EQ(rig.f.data.Position, rig.out.SlavePosition);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  EXPECT_GT(std::abs(last - begun), 340.0);
  EXPECT_TRUE(rig.gear.CommandAborted);
}

INSTANTIATE_TEST_SUITE_P(Both, Directions,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(1, 2),
                                            ::testing::Values(1, 2), ::testing::Values(1, -2)));

// ---- Another leading axis
// ---------------------------------------------------------------------------------------

/// From whatever state: waiting, synchronizing or synchronous with the first one.
TEST(AnotherLeadingAxis, IsTakenOnTheFlyFromEveryStateByEveryKindOfGear) {
  for (const int state : {0, 1, 2}) {
    for (const int kind : {0, 1, 2}) {
      SCOPED_TRACE(std::to_string(state) + std::to_string(kind));
      Coupled rig;
      rig.continuity[2].highest_acceleration = 2e4;
      rig.run_at(rig.run_l, 40.0);
      rig.run_at(rig.run_m, -70.0);
      rig.pos.MasterSyncPosition = rig.l.data.Position + 100.0;
      rig.pos.MasterStartDistance = 60.0;
      rig.pos.SlaveSyncPosition = 30.0;
      rig.start(rig.pos);
      rig.run(3);
      ASSERT_TRUE(state == 0 || rig.run_until([&] { return rig.pos.StartSync; }));
      if (state == 1) rig.run(700);
      ASSERT_TRUE(state < 2 || rig.run_until([&] { return rig.pos.InSync; }));
      rig.additive.Enable = true;
      auto& other = rig.block<MC_GearInPos>();
      other.Slave = &rig.f;
      other.Master = rig.gear.Master = rig.velocity.Master = &rig.m;
      other.RatioNumerator = rig.gear.RatioNumerator = rig.velocity.RatioNumerator = -2;
      other.MasterSyncPosition = rig.m.data.Position - 150.0;
      other.MasterStartDistance = 80.0;
      other.SlaveSyncPosition = 10.0;
      if (kind == 0) rig.start(rig.gear);
      if (kind == 1) rig.start(other);
      if (kind == 2) rig.start(rig.velocity);
      rig.run(2);
      // One that waits replaces what waits, and leaves what is active until it becomes active itself.
      EXPECT_EQ(rig.pos.CommandAborted, kind != 1 || state == 0);
      if (kind == 1) {
        EXPECT_EQ(rig.status().WaitingFunctionState, 2);
      } else {
        EXPECT_EQ(rig.status().ActualMaster, rig.m.number);
      }
      ASSERT_TRUE(rig.run_until([&] {
        return kind == 0 ? rig.gear.InGear : kind == 1 ? other.InSync : rig.velocity.InSync;
      }));
      EXPECT_TRUE(rig.pos.CommandAborted);
      EXPECT_EQ(rig.status().ActualMaster, rig.m.number);
      EXPECT_EQ(rig.f.data.Velocity, 140.0);
      EXPECT_TRUE(rig.additive.Busy && rig.shows(SynchronizedMotionBit::LeadingValueAdditiveCommand));
      if (kind == 1) {
        EXPECT_NEAR(rig.f.data.Position, 10.0 - 2.0 * (rig.m.data.Position - other.MasterSyncPosition),
                    1e-10);
      }
    }
  }
}

// ---- The additive leading value
// ---------------------------------------------------------------------------------

/// It moves the start of synchronizing, and what is synchronous at the place of the effective leading value.
TEST(AdditiveLeadingValues, CountForTheStartOfEveryProfileAndForGearOut) {
  for (const DINT profile : {0, 1, 3}) {
    Coupled rig;
    rig.continuity[2].highest_acceleration = 2e4;
    rig.additive.Position = 25.0;
    rig.additive.Enable = true;
    rig.run_at(rig.run_l, 50.0);
    rig.pos.SyncProfileReference = profile;
    rig.pos.MasterSyncPosition = rig.l.data.Position + 200.0;
    rig.pos.MasterStartDistance = 60.0;
    rig.pos.SlaveSyncPosition = 40.0;
    rig.start(rig.pos);
    ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }));
    const double start = rig.pos.MasterSyncPosition - (profile == 1 ? 60.0 : 0.0);
    EXPECT_NEAR(rig.l.data.Position, start - 25.0, profile == 0 ? 60.0 : 0.06) << profile;
    ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
    const double joined = rig.pos.MasterSyncPosition + (profile == 3 ? 60.0 : 0.0);
    EXPECT_NEAR(rig.l.data.Position, joined - 25.0, 0.06) << profile;
    EXPECT_NEAR(rig.f.data.Position, 40.0 + rig.l.data.Position + 25.0 - rig.pos.MasterSyncPosition, 1e-10);
    EXPECT_EQ(rig.status().EffectiveLeadingValue.Position, rig.l.data.Position + 25.0);
    rig.out.SlavePosition = rig.f.data.Position + 150.0;
    rig.out.MasterStopDistance = 80.0;
    rig.start(rig.out);
    ASSERT_TRUE(rig.run_until([&] { return rig.out.StartSyncOut; }));
    EXPECT_TRUE(rig.additive.Busy);
    EXPECT_EQ(rig.status().EffectiveLeadingValue.Position, rig.l.data.Position + 25.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.out.Done; }));
    EXPECT_EQ(rig.f.data.Position, rig.out.SlavePosition);
    EXPECT_TRUE(rig.shows(SynchronizedMotionBit::LeadingValueAdditiveCommand));
  }
}

/// A leading value that stands, moved by the additive one alone, synchronizes and desynchronizes.
TEST(AdditiveLeadingValues, LeadAlone) {
  Coupled rig;
  rig.continuity[2].highest_acceleration = 2e4;
  rig.pos.MasterSyncPosition = 100.0;
  rig.pos.MasterStartDistance = 60.0;
  rig.pos.SlaveSyncPosition = 40.0;
  rig.pos.Execute = true;
  rig.additive.Enable = true;
  const auto push = [&](const auto& until) {
    rig.additive.Velocity = 50.0;
    return rig.run_until([&] {
      rig.additive.Position += 0.05;
      return until();
    });
  };
  ASSERT_TRUE(push([&] { return rig.pos.InSync; }));
  EXPECT_NEAR(rig.f.data.Position, 40.0 + rig.status().EffectiveLeadingValue.Position - 100.0, 1e-10);
  EXPECT_NEAR(rig.status().EffectiveLeadingValue.Position, 100.0, 0.1);
  rig.phase.PhaseShift = 5.0;
  rig.phase.ProfileReference = 1;
  rig.phase.PhasingDistance = 10.0;
  rig.phase.Execute = true;
  ASSERT_TRUE(push([&] { return rig.phase.Done; }));
  EXPECT_NEAR(rig.f.data.Position, 45.0 + rig.status().EffectiveLeadingValue.Position - 100.0, 1e-10);
  rig.out.SlavePosition = rig.f.data.Position + 100.0;
  rig.out.MasterStopDistance = 50.0;
  rig.out.Execute = true;
  ASSERT_TRUE(push([&] { return rig.out.Done; }));
  EXPECT_EQ(rig.f.data.Position, rig.out.SlavePosition);
}

}  // namespace
}  // namespace lockstep::coupling_rules_test
