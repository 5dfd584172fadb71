// Synchronous operation beyond the gear itself: shifts, desynchronizing, velocity gears, additive leading
// value, simulation, and the published steps.
#include <gtest/gtest.h>

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
#include "tests/support/coupled_rig.hpp"

namespace lockstep::synchronous_test {
namespace {

using test::CoupledRig;
using test::line;

void ring(AxisData& data) {
  data.Modulo.Enable = true;
}
bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}
bool bit2(const Axis& axis, Status2Bit which) {
  return has_bit(axis.data.StatusWord2, which);
}

/// A leading axis and a following one that is in gear with it, 3:2.
struct Geared : CoupledRig {
  explicit Geared(const Shape& kind = line)
      : CoupledRig(kind, kind),
        other(axis("Other")),
        gear(block<MC_GearIn>()),
        phase(block<MC_PhasingRelative>()),
        phase_to(block<MC_PhasingAbsolute>()),
        offset(block<MC_OffsetRelative>()),
        offset_to(block<MC_OffsetAbsolute>()),
        out(block<MC_GearOut>()),
        additive(block<MC_LeadingValueAdditive>()),
        simulation(block<MC_SynchronizedMotionSimulation>()),
        velocity(block<MC_GearInVelocity>()),
        move_f(block<MC_MoveAbsolute>()) {
    lead(f, other);
    move_f.Axis = additive.Axis = &f;
    gear.Master = phase.Master = phase_to.Master = velocity.Master = &l;
    gear.Slave = phase.Slave = phase_to.Slave = offset.Slave = offset_to.Slave = out.Slave =
        simulation.Slave = velocity.Slave = &f;
    begin();
    gear.RatioNumerator = 3;
    gear.RatioDenominator = 2;
  }

  void engage() {
    gear.Execute = true;
    ASSERT_TRUE(run_until([&] { return gear.InGear; }));
  }

  void start_leading(double speed) {
    CoupledRig::start_leading(speed);
    ASSERT_TRUE(run_until([&] { return run_l.InVelocity; }));
  }

  /// Distance of the following position from F(L + PhaseShift) + Offset by the values that the data block
  /// shows.
  double off_chain() const {
    const auto& status = f.data.StatusSynchronizedMotion;
    const double value = 1.5 * (status.EffectiveLeadingValue.Position + status.PhaseShift) + status.Offset;
    return f.data.Position - value;
  }

  Axis& other;  ///< might lead as well
  MC_GearIn& gear;
  MC_PhasingRelative& phase;
  MC_PhasingAbsolute& phase_to;
  MC_OffsetRelative& offset;
  MC_OffsetAbsolute& offset_to;
  MC_GearOut& out;
  MC_LeadingValueAdditive& additive;
  MC_SynchronizedMotionSimulation& simulation;
  MC_GearInVelocity& velocity;
  MC_MoveAbsolute& move_f;
};

// ---- Phasing and offset
// -----------------------------------------------------------------------------------------

TEST(MC_PhasingRelative, WithDynamicsShiftsTheLeadingValueAndKeepsTheChain) {
  Geared rig;
  rig.continuity[1].highest_acceleration = 1000.0;  // the defaults of the axis; the leading axis is even
  rig.continuity[1].highest_jerk = 10000.0;
  rig.engage();
  rig.continuity[1].highest_acceleration = 1600.0;  // the gear follows the run-up of the leading axis
  rig.continuity[1].highest_jerk = 16000.0;
  rig.start_leading(50.0);
  rig.continuity[1].highest_acceleration = 1000.0;
  rig.continuity[1].highest_jerk = 10000.0;
  rig.phase.PhaseShift = 30.0;
  rig.phase.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.phase.StartPhasing);
  EXPECT_TRUE(bit(rig.f, StatusBit::PhasingCommand));
  EXPECT_TRUE(rig.gear.InGear);
  ASSERT_TRUE(rig.run_until([&] {
    EXPECT_NEAR(rig.off_chain(), 0.0, 1e-9);
    return rig.phase.Done;
  }));
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.PhaseShift, 30.0);
  EXPECT_EQ(rig.phase.CoveredPhaseShift, 30.0);
  EXPECT_FALSE(bit(rig.f, StatusBit::PhasingCommand));
  EXPECT_NEAR(rig.off_chain(), 0.0, 1e-9);
}

TEST(MC_PhasingAbsolute, OverALeadingDistanceFromAPositionWaitsThenShiftsExactly) {
  Geared rig;
  rig.engage();
  rig.phase_to.PhaseShift = -12.0;
  rig.phase_to.ProfileReference = 2;
  rig.phase_to.PhasingDistance = 40.0;
  rig.phase_to.StartPosition = 100.0;
  rig.phase_to.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.phase_to.Busy);
  EXPECT_FALSE(rig.phase_to.StartPhasing);
  EXPECT_TRUE(bit2(rig.f, Status2Bit::PhasingCommandWaiting));
  rig.run_l.Velocity = 80.0;
  rig.run_l.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.phase_to.StartPhasing; }));
  EXPECT_NEAR(rig.l.data.Position, 100.0, 0.2);
  ASSERT_TRUE(rig.run_until([&] { return rig.phase_to.Done; }));
  EXPECT_NEAR(rig.l.data.Position, 140.0, 0.2);
  EXPECT_EQ(rig.phase_to.AbsolutePhaseShift, -12.0);
  EXPECT_NEAR(rig.off_chain(), 0.0, 1e-9);
}

TEST(MC_PhasingRelative, ReversalOverADistanceEndsIt16808C) {
  Geared rig;
  rig.engage();
  rig.start_leading(50.0);
  rig.phase.PhaseShift = 20.0;
  rig.phase.ProfileReference = 1;
  rig.phase.PhasingDistance = 500.0;
  rig.phase.Execute = true;
  rig.run(1000);
  EXPECT_TRUE(rig.phase.StartPhasing);
  rig.start_leading(-50.0);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x808C));
  const double covered = rig.f.data.StatusSynchronizedMotion.PhaseShift;
  EXPECT_GT(covered, 0.0);
  EXPECT_LT(covered, 20.0);
  rig.run(100);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.PhaseShift, covered);
  EXPECT_TRUE(rig.gear.InGear);
}

TEST(MC_OffsetRelative, OverALeadingDistanceIsContinuousAndExact) {
  Geared rig;
  rig.engage();
  rig.start_leading(50.0);
  rig.offset.Offset = 10.0;
  rig.offset.OffsetDistance = 60.0;
  rig.offset.Execute = true;
  rig.continuity[1].highest_acceleration = 200.0;
  rig.continuity[1].highest_jerk = 2000.0;
  rig.run(3);
  EXPECT_TRUE(rig.offset.StartOffset);
  EXPECT_TRUE(bit2(rig.f, Status2Bit::OffsetCommand));
  ASSERT_TRUE(rig.run_until([&] { return rig.offset.Done; }));
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.Offset, 10.0);
  EXPECT_EQ(rig.offset.CoveredOffset, 10.0);
  EXPECT_NEAR(rig.off_chain(), 0.0, 1e-9);
}

TEST(MC_OffsetRelative, TenThousandOffsetsOfATenthAddUpExactly) {
  Geared rig;
  rig.engage();
  rig.start_leading(1000.0);
  rig.offset.Offset = 0.1;
  rig.offset.OffsetDistance = 2.0;
  for (int i = 0; i < 10000; ++i) {
    rig.offset.Execute = true;
    rig.tick();
    for (int k = 0; k < 20 && !rig.offset.Done; ++k) rig.tick();
    ASSERT_TRUE(rig.offset.Done);
    rig.offset.Execute = false;
    rig.tick();
  }
  // The correctly rounded sum of ten thousand times the double nearest to 0.1.
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.Offset, 1000.0);
}

TEST(Shifts, ExcludeEachOther) {
  Geared rig;
  rig.engage();
  rig.start_leading(50.0);
  rig.offset.Offset = 10.0;
  rig.offset.OffsetDistance = 600.0;
  rig.offset.Execute = true;
  rig.run(5);
  rig.phase.PhaseShift = 1.0;
  rig.phase.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x808A));
  EXPECT_TRUE(rig.offset.StartOffset);
}

TEST(Shifts, NeedASynchronousAxis) {
  Geared rig;
  rig.phase.Execute = rig.offset.Execute = true;
  rig.offset.OffsetDistance = 1.0;
  rig.run(3);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x80A9));
  EXPECT_EQ(rig.offset.ErrorID, static_cast<WORD>(0x80A9));
}

TEST(Phasing, NeedsTheLeadingAxisThatIsInEffect) {
  for (const bool absolute : {false, true}) {
    Geared rig;
    PhasingBlock& phase =
        absolute ? static_cast<PhasingBlock&>(rig.phase_to) : static_cast<PhasingBlock&>(rig.phase);
    rig.engage();
    phase.Master = &rig.other;
    phase.PhaseShift = 30.0;
    phase.Execute = true;
    rig.run(3);
    EXPECT_EQ(phase.ErrorID, static_cast<WORD>(0x80A9));
    EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.PhaseShift, 0.0);
    EXPECT_EQ(rig.f.pending_alarm(), 0);
    EXPECT_TRUE(rig.gear.InGear);
    phase.Execute = false;
    rig.run(1);
    phase.Master = &rig.l;
    phase.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return phase.Done; }));
    EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.PhaseShift, 30.0);
  }
}

TEST(Phasing, OfALeadingAxisThatIsNotInterconnectedRaisesAlarm601) {
  Geared rig;
  rig.engage();
  rig.f.leading_values.pop_back();
  rig.phase.Master = &rig.other;
  rig.phase.PhaseShift = 30.0;
  rig.phase.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x8001));
  EXPECT_EQ(rig.f.pending_alarm(), 601);
  EXPECT_TRUE(has_bit(rig.f.data.ErrorWord, ErrorBit::SynchronousError));
  EXPECT_EQ(rig.f.data.Position, 0.0);
}

TEST(Shifts, ProfileFiveCancelsAWaitingJobOnly) {
  Geared rig;
  rig.engage();
  rig.offset.Offset = 10.0;
  rig.offset.ProfileReference = 2;
  rig.offset.StartPosition = 1000.0;
  rig.offset.OffsetDistance = 10.0;
  rig.offset.Execute = true;
  rig.run(3);
  EXPECT_TRUE(bit2(rig.f, Status2Bit::OffsetCommandWaiting));
  rig.offset_to.ProfileReference = 5;
  rig.offset_to.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.offset_to.Done);
  EXPECT_TRUE(rig.offset.CommandAborted);
}

TEST(Shifts, AreResetWhenTheGearIsOverridden) {
  Geared rig;
  rig.engage();
  rig.start_leading(50.0);
  rig.phase.PhaseShift = 5.0;
  rig.phase.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.phase.Done; }));
  rig.gear.Execute = false;
  rig.tick();
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.run(2);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.PhaseShift, 0.0);
}

TEST(Shifts, AreResetWhereverTheGearEnds) {
  for (const int how : {0, 1, 2, 3, 4, 5}) {
    Geared rig;
    auto& halt = rig.block<MC_Halt>();
    halt.Axis = &rig.f;
    rig.engage();
    rig.start_leading(50.0);
    rig.offset.Offset = 7.0;
    rig.offset.OffsetDistance = 10.0;
    rig.offset.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.offset.Done; }));
    rig.phase.PhaseShift = 500.0;
    rig.phase.Execute = true;
    rig.run(500);
    const auto& status = rig.f.data.StatusSynchronizedMotion;
    EXPECT_GT(status.PhaseShift, 1.0);
    EXPECT_EQ(status.Offset, 7.0);
    rig.out.SyncProfileReference = how;  // 0, 1
    rig.out.MasterStopDistance = 20.0;
    rig.out.SlavePosition = rig.f.data.Position + 400.0;
    rig.out.Execute = how < 2;
    halt.Execute = how == 2;
    rig.move_f.Execute = how == 3;
    rig.power_f.Enable = how != 4;
    if (how == 5) rig.f.raise(alarm::kSynchronizing);
    ASSERT_TRUE(rig.run_until([&] { return status.FunctionState != 1; }));
    EXPECT_EQ(status.PhaseShift, 0.0) << how;
    EXPECT_EQ(status.Offset, 0.0) << how;
    EXPECT_TRUE(rig.phase.CommandAborted || rig.phase.Error) << how;
    if (how == 1) {
      EXPECT_EQ(status.FunctionLeadingValue.Position, status.EffectiveLeadingValue.Position);
    }
    rig.run(3000);
    EXPECT_EQ(status.PhaseShift, 0.0) << how;
    EXPECT_TRUE(how > 1 || rig.out.Done) << how;
  }
}

// ---- MC_GearOut
// -------------------------------------------------------------------------------------------------

class MC_GearOutWays : public ::testing::TestWithParam<std::tuple<bool, DINT, double>> {};

TEST_P(MC_GearOutWays, ComesToRestExactlyAtSlavePosition) {
  const auto [modulo, profile, velocity] = GetParam();
  Geared rig(modulo ? ring : line);
  rig.engage();
  rig.start_leading(velocity);
  rig.out.SlavePosition = modulo ? 200.0 : velocity > 0 ? 1200.0 : -1200.0;
  rig.out.SyncProfileReference = profile;
  rig.out.MasterStopDistance = 90.0;
  rig.out.Deceleration = 2000.0;
  rig.out.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.out.Busy);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 4);
  ASSERT_TRUE(rig.run_until([&] { return rig.out.StartSyncOut; }));
  rig.run(1);
  EXPECT_TRUE(rig.gear.CommandAborted);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 4);
  EXPECT_TRUE(bit2(rig.f, Status2Bit::DesynchronizingCommand));
  EXPECT_FALSE(bit(rig.f, StatusBit::Synchronous));
  ASSERT_TRUE(rig.run_until([&] { return rig.out.Done; }));
  EXPECT_EQ(rig.f.data.Position, rig.out.SlavePosition);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 0);
  EXPECT_TRUE(bit(rig.f, StatusBit::Standstill));
}

INSTANTIATE_TEST_SUITE_P(Ways, MC_GearOutWays,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(0, 1),
                                            ::testing::Values(150.0, -150.0)));

TEST(MC_GearOut, WithoutAGearIsRejected) {
  Geared rig;
  rig.out.MasterStopDistance = 1.0;
  rig.out.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.out.ErrorID, static_cast<WORD>(0x8077));
}

TEST(MC_GearOut, ProfileFiveCancelsAWaitingGearAndLeavesAnActiveOne) {
  Geared rig;
  rig.engage();
  auto& pos = rig.block<MC_GearInPos>();
  pos.Master = &rig.l;
  pos.Slave = &rig.f;
  pos.MasterSyncPosition = 500.0;
  pos.Execute = true;
  rig.run(3);
  rig.out.SyncProfileReference = 5;
  rig.out.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.out.Done);
  EXPECT_TRUE(pos.CommandAborted);
  EXPECT_TRUE(rig.gear.InGear);
}

// ---- MC_GearInVelocity
// ------------------------------------------------------------------------------------------

/// Function diagram GearInVelocity-1.
TEST(MC_GearInVelocity, FollowsAChangingRatioWhileContinuousUpdateIsActive) {
  Geared rig;
  rig.start_leading(40.0);
  rig.velocity.ContinuousUpdate = true;
  rig.velocity.PositionControlled = true;
  rig.velocity.RatioNumerator = 2;
  rig.velocity.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.velocity.StartSync);
  EXPECT_TRUE(rig.velocity.ContinuousUpdateActive);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 6);
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  EXPECT_EQ(rig.f.data.Velocity, 80.0);
  rig.continuity[1].velocity = false;  // the velocity changes directly with the ratio
  rig.velocity.RatioDenominator = 4;
  rig.run(2);
  EXPECT_EQ(rig.f.data.Velocity, 20.0);
  EXPECT_TRUE(rig.velocity.InSync);
  rig.velocity.RatioDenominator = 0;
  rig.run(2);
  EXPECT_EQ(rig.velocity.ErrorID, static_cast<WORD>(0x8018));
  EXPECT_EQ(rig.f.data.Velocity, 20.0);
  rig.velocity.RatioDenominator = 4;
  rig.velocity.ContinuousUpdate = false;
  rig.run(2);
  EXPECT_FALSE(rig.velocity.ContinuousUpdateActive);
  rig.velocity.RatioDenominator = 1;
  rig.velocity.ContinuousUpdate = true;
  rig.run(2);
  EXPECT_FALSE(rig.velocity.ContinuousUpdateActive);
  EXPECT_EQ(rig.f.data.Velocity, 20.0);
  rig.velocity.Execute = false;
  rig.run(1);
  rig.velocity.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.velocity.StartSync);
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  EXPECT_EQ(rig.f.data.Velocity, 80.0);
}

TEST(MC_GearInVelocity, AStepOfTheRatioBeyondTheLimitsShowsInTheStatusWord) {
  Geared rig;
  rig.f.data.DynamicLimits.MaxAcceleration = 2000.0;
  rig.f.data.DynamicLimits.MaxDeceleration = 1500.0;
  const auto shows = [&](bool acceleration, bool deceleration) {
    const DWORD word = rig.f.data.StatusSynchronizedMotion.StatusWord;
    return has_bit(word, SynchronizedMotionBit::MaxAccelerationExceeded) == acceleration &&
           has_bit(word, SynchronizedMotionBit::MaxDecelerationExceeded) == deceleration;
  };
  rig.velocity.ContinuousUpdate = true;
  rig.velocity.PositionControlled = true;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  rig.start_leading(1.0);
  rig.continuity[1].velocity = false;
  const auto change_to = [&](DINT ratio) {
    rig.velocity.RatioNumerator = ratio;
    rig.run(2);  // a call of the block, and a tick of the axis
    EXPECT_EQ(rig.f.data.Velocity, ratio);
  };
  change_to(2);  // by 1000 u/s²
  EXPECT_TRUE(shows(false, false));
  change_to(5);
  EXPECT_TRUE(shows(true, false));
  rig.run(1);
  EXPECT_TRUE(shows(false, false));
  change_to(3);
  EXPECT_TRUE(shows(false, true));
  change_to(-3);
  EXPECT_TRUE(shows(true, true));
  change_to(-1);
  EXPECT_TRUE(shows(false, true));
}

TEST(MC_GearInVelocity, WithoutPositionControlShowsPositionZero) {
  Geared rig;
  rig.start_leading(40.0);
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  EXPECT_TRUE(bit(rig.f, StatusBit::NonPositionControlled));
  EXPECT_EQ(rig.f.data.Position, 0.0);
  rig.phase.Execute = true;
  rig.out.MasterStopDistance = 1.0;
  rig.out.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x8079));
  EXPECT_EQ(rig.out.ErrorID, static_cast<WORD>(0x8079));
}

// ---- Leading value
// ----------------------------------------------------------------------------------------------

TEST(MC_LeadingValueAdditive, AddsToTheLeadingValueDirectlyAndIsAStepOfItsSize) {
  Geared rig;
  rig.engage();
  rig.continuity[1].velocity = false;  // published step
  const double before = rig.f.data.Position;
  rig.additive.Position = 4.0;
  rig.additive.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.additive.Busy);
  EXPECT_DOUBLE_EQ(rig.f.data.Position - before, 6.0);
  EXPECT_DOUBLE_EQ(rig.f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Position,
                   rig.l.data.Position + 4.0);
  EXPECT_TRUE(has_bit(rig.f.data.StatusSynchronizedMotion.StatusWord,
                      SynchronizedMotionBit::LeadingValueAdditiveCommand));
  rig.additive.Position = std::nan("");
  rig.run(2);
  EXPECT_TRUE(rig.additive.Error);
  EXPECT_DOUBLE_EQ(rig.f.data.Position - before, 6.0);
  rig.additive.Enable = false;
  rig.run(2);
  EXPECT_DOUBLE_EQ(rig.f.data.Position, before);
}

TEST(MC_LeadingValueAdditive, CountsOnceTheAxisIsEnabledAndNotWhileItIsNot) {
  Geared rig;
  const auto shown = [&] {
    return has_bit(rig.f.data.StatusSynchronizedMotion.StatusWord,
                   SynchronizedMotionBit::LeadingValueAdditiveCommand);
  };
  const auto refused = [&] {
    return rig.additive.ErrorID == static_cast<WORD>(0x800F) && !rig.additive.Busy && !shown();
  };
  rig.power_f.Enable = false;
  rig.run(5);
  rig.additive.Position = 4.0;
  rig.additive.Enable = true;
  rig.run(3);
  EXPECT_TRUE(refused());
  for (int time = 0; time < 2; ++time) {
    rig.power_f.Enable = true;
    rig.run(5);
    EXPECT_TRUE(rig.additive.Busy && !rig.additive.Error && shown());
    rig.engage();
    EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Position, 4.0);
    rig.gear.Execute = false;
    rig.power_f.Enable = false;
    rig.run(5);
    EXPECT_TRUE(refused());
  }
  rig.additive.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.additive.Error);
}

TEST(MC_LeadingValueAdditive, BeginsWithTheFirstInputsThatArePermitted) {
  Geared rig;
  rig.additive.Position = std::nan("");
  rig.additive.Enable = true;
  rig.run(2);
  EXPECT_EQ(rig.additive.ErrorID, static_cast<WORD>(0x8009));
  rig.additive.Position = 4.0;
  rig.run(2);
  EXPECT_TRUE(rig.additive.Busy);
}

TEST(MC_LeadingValueAdditive, IsEndedByAnotherInstanceAndByARestart) {
  Geared rig;
  auto& other = rig.block<MC_LeadingValueAdditive>();
  auto& reset = rig.block<MC_Reset>();
  other.Axis = &rig.f;
  reset.Axis = &rig.f;
  reset.Restart = true;
  rig.additive.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.additive.Busy);
  other.Enable = true;
  rig.run(2);
  EXPECT_TRUE(other.Busy && !rig.additive.Busy && !rig.additive.Error);
  rig.power_f.Enable = false;
  rig.run(5);
  EXPECT_TRUE(other.Error && !rig.additive.Error);
  reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return reset.Done; }));
  rig.power_f.Enable = true;
  rig.run(5);
  EXPECT_FALSE(other.Busy || other.Error || rig.additive.Busy || rig.additive.Error);
  other.Enable = false;
  rig.run(1);
  other.Enable = true;
  rig.run(2);
  EXPECT_TRUE(other.Busy);
}

TEST(MC_SynchronizedMotionSimulation, KeepsTheGearWhileTheAxisMovesAndIsDisabled) {
  Geared rig;
  rig.engage();
  rig.simulation.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.simulation.InSimulation);
  EXPECT_TRUE(rig.gear.InGear);
  EXPECT_FALSE(bit(rig.f, StatusBit::Synchronous));
  rig.move_f.Position = 77.0;
  rig.move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move_f.Done; }));
  EXPECT_TRUE(rig.gear.InGear);
  rig.phase.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.phase.ErrorID, static_cast<WORD>(0x8076));
  rig.power_f.Enable = false;
  rig.run(50);
  EXPECT_TRUE(rig.gear.InGear);
  rig.power_f.Enable = true;
  rig.run(3);
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_TRUE(rig.simulation.Error);
  EXPECT_TRUE(rig.simulation.InSimulation);
  rig.move_f.Execute = false;
  rig.run(1);
  rig.move_f.Position = 0.0;
  rig.move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return !rig.simulation.InSimulation; }));
  EXPECT_TRUE(rig.gear.InGear);
  rig.run(2);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  rig.start_leading(50.0);
  EXPECT_EQ(rig.f.data.Velocity, 75.0);
}

TEST(MC_SynchronizedMotionSimulation, IsNotEndedByALeadingAxisThatPassesThePlace) {
  Geared rig;
  rig.continuity[1].highest_acceleration = 1e4;  // more than either axis is told to do
  auto& back = rig.block<MC_MoveAbsolute>();
  back.Axis = &rig.l;
  rig.engage();
  rig.simulation.Enable = true;
  rig.run(2);
  rig.start_leading(60.0);
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_EQ(rig.simulation.ErrorID, static_cast<WORD>(0x8009));
  rig.start_leading(-60.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.data.Position < -20.0; }));
  EXPECT_TRUE(rig.simulation.InSimulation);
  EXPECT_EQ(rig.f.data.Position, 0.0);
  back.Execute = true;  // to rest where the gear has the axis
  ASSERT_TRUE(rig.run_until([&] { return back.Done; }));
  EXPECT_FALSE(rig.simulation.InSimulation);
  EXPECT_FALSE(rig.simulation.Error);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
}

TEST(MC_SynchronizedMotionSimulation, EndsOnARingAfterAnyNumberOfTurns) {
  for (const double distance : {720.0, -720.0, 720.0 + 0.2, -720.0 - 0.2}) {
    Geared rig(ring);
    auto& turn = rig.block<MC_MoveRelative>();
    turn.Axis = &rig.l;
    turn.Distance = distance;
    turn.Velocity = 2000.0;
    rig.engage();
    rig.simulation.Enable = true;
    rig.run(2);
    turn.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return turn.Done; }));
    rig.simulation.Enable = false;
    rig.run(2);
    EXPECT_FALSE(rig.simulation.InSimulation) << distance;
    EXPECT_FALSE(rig.simulation.Error) << distance;
    // The axis has made none of the turns of its function; what is left is within the positioning window.
    const AxisPosition& there = rig.f.setpoint().position;
    const double left = distance - std::copysign(720.0, distance);
    EXPECT_NEAR(difference(there, {}, rig.f.modulo()).rounded(), 1.5 * left, 1e-9) << distance;
    rig.start_leading(100.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.f.data.ModuloCycle == 3; }));
    EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  }
}

TEST(MC_SynchronizedMotionSimulation, IsShownNoLongerOnceAnAlarmHasEndedIt) {
  Geared rig;
  rig.engage();
  rig.simulation.Enable = true;
  rig.run(2);
  const auto& status = rig.f.data.StatusSynchronizedMotion;
  EXPECT_TRUE(has_bit(status.StatusWord, SynchronizedMotionBit::InSimulation));
  rig.f.raise(601);
  rig.run(2);
  EXPECT_FALSE(rig.simulation.InSimulation);
  EXPECT_FALSE(has_bit(status.StatusWord, SynchronizedMotionBit::InSimulation));
  EXPECT_EQ(status.FunctionState, 0);
}

// ---- Published steps
// --------------------------------------------------------------------------------------------

TEST(PublishedStep, HomingTheLeadingAxisStepsTheFollowingOneByTheRatio) {
  Geared rig;
  rig.engage();
  rig.home_l.Execute = false;
  rig.run(1);
  rig.continuity[0].velocity = rig.continuity[1].velocity = false;
  rig.home_l.Position = 8.0;
  rig.home_l.Execute = true;
  rig.run(2);
  EXPECT_DOUBLE_EQ(rig.f.data.Position, 12.0);
  EXPECT_TRUE(rig.gear.InGear);
}

TEST(PublishedStep, ALeadingAxisLeavingPositionControlHasLeadingSetpointZero) {
  Geared rig;
  rig.engage();
  rig.start_leading(40.0);
  rig.run(1000);
  const double position = rig.f.data.Position;
  EXPECT_GT(position, 10.0);
  rig.continuity[1].velocity = false;
  rig.run_l.PositionControlled = false;
  rig.run_l.Execute = false;
  rig.run(1);
  rig.run_l.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.f.data.Position, 0.0);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
}

TEST(PublishedStep, AFollowingAxisMovingWhenAStandingLeadingAxisStartsAProfileLosesItsVelocity) {
  Geared rig;
  auto& pos = rig.block<MC_GearInPos>();
  auto& free = rig.block<MC_MoveVelocity>();
  pos.Master = &rig.l;
  pos.Slave = &rig.f;
  free.Axis = &rig.f;
  free.Velocity = 25.0;
  free.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return free.InVelocity; }));
  pos.SyncProfileReference = 3;
  pos.MasterStartDistance = 100.0;
  pos.SlaveSyncPosition = 50.0;
  pos.Execute = true;  // the leading axis stands at MasterSyncPosition
  rig.run(2);
  rig.continuity[1].velocity = false;
  rig.run_l.Velocity = 10.0;
  rig.run_l.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return pos.StartSync; }));
  EXPECT_NEAR(rig.f.data.Velocity, 0.0, 0.1);  // the whole velocity, and no more
}

}  // namespace
}  // namespace lockstep::synchronous_test
