// MC_SynchronizedMotionSimulation: what it keeps of the coupling, and what stands in the way of its end.
#include <gtest/gtest.h>

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
#include "tests/support/rig.hpp"

namespace lockstep::coupling_simulation_test {
namespace {

using test::Rig;

bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}

/// A leading axis and a following one, whose coupling can be simulated.
struct Simulated : Rig {
  explicit Simulated(bool driven = false)
      : l(axis("Leading")),
        f(axis("Following",
               [&](AxisData& data) {
                 data.PositioningMonitoring.Window = 0.01;
                 if (!driven) return;
                 data.VirtualAxis.Mode = 0;
                 data.PositionControl.Kv = 40.0;
               })),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_f(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        halt_l(block<MC_Halt>()),
        run_f(block<MC_MoveVelocity>()),
        halt_f(block<MC_Halt>()),
        stop_f(block<MC_Stop>()),
        move_f(block<MC_MoveAbsolute>()),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        velocity(block<MC_GearInVelocity>()),
        phase(block<MC_PhasingRelative>()),
        offset(block<MC_OffsetRelative>()),
        simulation(block<MC_SynchronizedMotionSimulation>()) {
    f.drive_settings = {.time_constant = 0.002, .dead_time = 0.001, .resolution = 0.0};
    lead(f, l);
    power_l.Axis = run_l.Axis = halt_l.Axis = &l;
    power_f.Axis = home_f.Axis = run_f.Axis = halt_f.Axis = stop_f.Axis = move_f.Axis = &f;
    gear.Master = pos.Master = velocity.Master = phase.Master = &l;
    gear.Slave = pos.Slave = velocity.Slave = phase.Slave = offset.Slave = simulation.Slave = &f;
    velocity.PositionControlled = true;
    power_l.Enable = power_f.Enable = true;
    Rig::run(20);
    home_f.Execute = true;
    Rig::run(20);
    home_f.Execute = false;
    continuity[1].highest_acceleration = 1e4;
    continuity[1].highest_jerk = 1e8;
  }

  template <class B>
  void start(B& job) {
    job.Execute = false;
    tick();
    job.Execute = true;
  }
  void lead_at(double speed) {
    run_l.Velocity = speed;
    start(run_l);
    ASSERT_TRUE(run_until([&] { return run_l.InVelocity; }));
  }
  void stand() {
    start(halt_l);
    ASSERT_TRUE(run_until([&] { return halt_l.Done; }));
  }
  void simulate() {
    simulation.Enable = true;
    run(2);
    ASSERT_TRUE(simulation.InSimulation);
  }
  const TO_Struct_StatusSynchronizedMotion& status() const { return f.data.StatusSynchronizedMotion; }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home_f;
  MC_MoveVelocity& run_l;
  MC_Halt& halt_l;
  MC_MoveVelocity& run_f;
  MC_Halt& halt_f;
  MC_Stop& stop_f;
  MC_MoveAbsolute& move_f;
  MC_GearIn& gear;
  MC_GearInPos& pos;
  MC_GearInVelocity& velocity;
  MC_PhasingRelative& phase;
  MC_OffsetRelative& offset;
  MC_SynchronizedMotionSimulation& simulation;
};

TEST(EndOfASimulation, IsRefusedWhileMC_StopLocksTheAxis) {
  Simulated rig;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.simulate();
  rig.stop_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.stop_f.Done; }));
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_TRUE(rig.simulation.InSimulation);
  EXPECT_EQ(rig.simulation.ErrorID, static_cast<WORD>(ErrorId::locked));
  EXPECT_TRUE(rig.gear.InGear);
  rig.lead_at(50.0);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  rig.stand();
  rig.stop_f.Execute = false;
  auto& back = rig.block<MC_MoveAbsolute>();
  back.Axis = &rig.f;
  back.Position = rig.status().FunctionFollowingValue.Position;
  rig.run(2);
  back.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return !rig.simulation.InSimulation; }));
  EXPECT_FALSE(rig.simulation.Error);
  rig.run(1);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
}

TEST(EndOfASimulation, PutsThePositionControlOfTheCouplingBack) {
  for (const bool driven : {false, true}) {
    Simulated rig(driven);
    rig.gear.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
    rig.simulate();
    rig.run_f.Velocity = 20.0;
    rig.run_f.PositionControlled = false;
    rig.start(rig.run_f);
    rig.run(500);
    rig.start(rig.halt_f);
    ASSERT_TRUE(rig.run_until([&] { return rig.halt_f.Done; }));
    ASSERT_TRUE(bit(rig.f, StatusBit::NonPositionControlled));
    rig.run(100);
    const double away = rig.f.data.ActualPosition;
    rig.simulation.Enable = false;
    auto& to = rig.block<MC_MoveRelative>();
    to.Axis = &rig.l;
    to.Distance = away;
    to.Execute = true;
    rig.continuity[1].velocity = false;  // the setpoint begins anew where the axis is
    ASSERT_TRUE(rig.run_until([&] {
      EXPECT_NEAR(rig.f.data.ActualPosition, away, 1e-3) << driven;
      EXPECT_TRUE(rig.gear.InGear);
      return !rig.simulation.InSimulation;
    })) << driven;
    rig.run(2);
    rig.continuity[1].velocity = true;
    EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
    EXPECT_FALSE(bit(rig.f, StatusBit::NonPositionControlled)) << driven;
    rig.run(100);
    EXPECT_NEAR(rig.f.data.ActualPosition, away, 0.02) << driven;
    rig.lead_at(40.0);
    EXPECT_EQ(rig.f.data.Position, rig.l.data.Position) << driven;
  }
}

TEST(SimulationOfAVelocityGear, EndsWhereverTheAxisHasComeMeanwhile) {
  for (const bool controlled : {true, false}) {
    Simulated rig;
    rig.velocity.PositionControlled = controlled;
    rig.velocity.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
    rig.simulate();
    rig.lead_at(50.0);
    rig.stand();
    if (controlled) {
      rig.move_f.Position = -20.0;
      rig.move_f.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return rig.move_f.Done; }));
    }
    rig.simulation.Enable = false;
    rig.run(2);
    EXPECT_FALSE(rig.simulation.InSimulation) << controlled;
    EXPECT_FALSE(rig.simulation.Error) << controlled;
    EXPECT_TRUE(rig.velocity.InSync);
    rig.lead_at(30.0);
    EXPECT_EQ(rig.f.data.Velocity, 30.0);
    EXPECT_EQ(bit(rig.f, StatusBit::NonPositionControlled), !controlled);
  }
}

TEST(SimulationOfAVelocityGear, TakesChangesOfTheRatio) {
  Simulated rig;
  rig.velocity.ContinuousUpdate = true;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  rig.simulate();
  rig.lead_at(50.0);
  rig.velocity.RatioNumerator = -3;
  rig.run(2);
  EXPECT_TRUE(rig.velocity.ContinuousUpdateActive);
  EXPECT_EQ(rig.status().FunctionFollowingValue.Velocity, -150.0);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
}

TEST(SimulationOfAGear, CarriesAShiftOnOverTheLeadingDistance) {
  Simulated rig;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.offset.Offset = 10.0;
  rig.offset.ProfileReference = 2;
  rig.offset.StartPosition = 20.0;
  rig.offset.OffsetDistance = 30.0;
  rig.offset.Execute = true;
  rig.run(2);
  rig.simulate();
  EXPECT_TRUE(rig.offset.Busy);
  rig.lead_at(50.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.data.Position > 60.0; }));
  EXPECT_TRUE(rig.offset.Done);
  EXPECT_EQ(rig.status().Offset, 10.0);
  EXPECT_EQ(rig.f.data.Position, 0.0);
  rig.stand();
  rig.move_f.Position = rig.l.data.Position + 10.0;
  rig.move_f.Execute = true;
  rig.simulation.Enable = false;
  ASSERT_TRUE(rig.run_until([&] { return !rig.simulation.InSimulation; }));
  rig.run(1);
  EXPECT_DOUBLE_EQ(rig.f.data.Position, rig.l.data.Position + 10.0);
}

TEST(SimulationOfAGear, CarriesAPhaseShiftOnThatBeganInTheSameTick) {
  Simulated rig;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.phase.PhaseShift = 10.0;
  rig.phase.Execute = true;
  rig.simulate();
  ASSERT_TRUE(rig.run_until([&] { return rig.phase.Done; }));
  EXPECT_EQ(rig.status().PhaseShift, 10.0);
  EXPECT_EQ(rig.status().FunctionFollowingValue.Position, 10.0);
  EXPECT_EQ(rig.f.data.Position, 0.0);
}

TEST(SimulationOfAGear, LeavesAShiftWhereTheEndOfItsJobHasIt) {
  for (const bool by_disabling : {false, true}) {
    Simulated rig;
    rig.gear.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
    rig.phase.PhaseShift = 10.0;
    rig.phase.Velocity = 20.0;
    rig.phase.Execute = true;
    rig.simulate();
    rig.run(300);
    EXPECT_NE(rig.status().FunctionFollowingValue.Velocity, 0.0);
    rig.move_f.Position = 3.0;
    if (by_disabling)
      rig.power_f.Enable = false;
    else
      rig.move_f.Execute = true;
    rig.run(3);
    EXPECT_TRUE(rig.phase.CommandAborted) << by_disabling;
    const double covered = rig.status().PhaseShift;
    EXPECT_GT(covered, 0.0);
    EXPECT_EQ(rig.status().FunctionFollowingValue.Velocity, 0.0) << by_disabling;
    rig.power_f.Enable = true;
    rig.run(1000);
    EXPECT_EQ(rig.status().PhaseShift, covered);
    rig.move_f.Execute = false;
    rig.run(1);
    rig.move_f.Position = covered;
    rig.move_f.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move_f.Done; }));
    rig.simulation.Enable = false;
    rig.run(2);
    EXPECT_FALSE(rig.simulation.InSimulation) << by_disabling;
  }
}

TEST(SimulationOfAGear, IsRenamedWithTheAxisByHoming) {
  Simulated rig;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.simulate();
  rig.home_f.Position = 8.0;
  rig.continuity[1].homing = true;
  rig.continuity[1].velocity = false;
  rig.home_f.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.f.data.Position, 8.0);
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.simulation.InSimulation);
  EXPECT_EQ(rig.f.data.Position, 8.0);
}

// ---- What begins it, what it forbids, what it leaves
// -----------------------------------------------------------------------------------------------------------

TEST(BeginOfASimulation, NeedsACouplingThatIsSynchronousAndALeadingAxisThatStands) {
  Simulated rig;
  const auto refused = [&] {
    rig.run(2);
    return !rig.simulation.InSimulation && !rig.simulation.Busy &&
           rig.simulation.ErrorID == static_cast<WORD>(0x8075) &&
           !has_bit(rig.status().StatusWord, SynchronizedMotionBit::InSimulation);
  };
  rig.simulation.Enable = true;
  EXPECT_TRUE(refused());  // no coupling
  rig.pos.MasterSyncPosition = 50.0;
  rig.pos.MasterStartDistance = 40.0;
  rig.pos.SlaveSyncPosition = 20.0;
  rig.pos.Execute = true;
  EXPECT_TRUE(refused());  // one that waits
  rig.run_l.Velocity = 60.0;
  rig.start(rig.run_l);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }));
  EXPECT_TRUE(refused());
  rig.stand();
  EXPECT_TRUE(rig.pos.StartSync);
  EXPECT_TRUE(refused());  // one that is being synchronized, though the leading axis stands
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.simulation.Error);
  rig.lead_at(60.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  rig.simulation.Enable = true;
  EXPECT_TRUE(refused());  // the leading axis moves
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  rig.simulation.Enable = false;
  rig.stand();
  rig.simulate();
  EXPECT_TRUE(rig.simulation.Busy);
  EXPECT_TRUE(rig.pos.InSync);
  EXPECT_EQ(rig.status().FunctionState, 2);
}

TEST(SimulationOfACoupling, RejectsAllSynchronousJobsButTheAdditiveLeadingValue) {
  Simulated rig;
  auto& gear = rig.block<MC_GearIn>();
  auto& velocity = rig.block<MC_GearInVelocity>();
  auto& phase_to = rig.block<MC_PhasingAbsolute>();
  auto& offset_to = rig.block<MC_OffsetAbsolute>();
  auto& out = rig.block<MC_GearOut>();
  auto& additive = rig.block<MC_LeadingValueAdditive>();
  gear.Master = velocity.Master = phase_to.Master = &rig.l;
  gear.Slave = velocity.Slave = phase_to.Slave = offset_to.Slave = out.Slave = &rig.f;
  additive.Axis = &rig.f;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.simulate();
  out.MasterStopDistance = rig.offset.OffsetDistance = offset_to.OffsetDistance = 1.0;
  gear.Execute = velocity.Execute = phase_to.Execute = offset_to.Execute = out.Execute = true;
  rig.pos.Execute = rig.phase.Execute = rig.offset.Execute = true;
  additive.Position = 7.0;
  additive.Enable = true;
  rig.run(3);
  for (const WORD id : {gear.ErrorID, velocity.ErrorID, phase_to.ErrorID, offset_to.ErrorID, out.ErrorID,
                        rig.pos.ErrorID, rig.phase.ErrorID, rig.offset.ErrorID})
    EXPECT_EQ(id, static_cast<WORD>(0x8076));
  EXPECT_TRUE(rig.gear.InGear && rig.simulation.InSimulation && additive.Busy);
  EXPECT_EQ(rig.status().EffectiveLeadingValue.Position, 7.0);
  EXPECT_EQ(rig.status().FunctionFollowingValue.Position, 7.0);
  EXPECT_EQ(rig.f.data.Position, 0.0);
  rig.power_f.Enable = false;
  rig.run(20);
  EXPECT_TRUE(additive.Busy);  // published: enabled or in simulation
}

TEST(SimulationOfACoupling, OutlastsDisablingAndStopsOfBothAxesAndEndsWithARestart) {
  Simulated rig;
  auto& stop_l = rig.block<MC_Stop>();
  auto& reset = rig.block<MC_Reset>();
  stop_l.Axis = &rig.l;
  reset.Axis = &rig.f;
  reset.Restart = true;
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  rig.simulate();
  stop_l.Execute = rig.stop_f.Execute = true;
  rig.run(20);
  rig.power_l.Enable = rig.power_f.Enable = false;
  rig.run(20);
  EXPECT_TRUE(rig.simulation.InSimulation && rig.velocity.InSync);
  EXPECT_FALSE(bit(rig.f, StatusBit::Synchronous));
  reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return reset.Done; }));
  rig.run(2);
  EXPECT_FALSE(rig.simulation.InSimulation);
  EXPECT_TRUE(rig.velocity.CommandAborted);
  EXPECT_EQ(rig.status().FunctionState, 0);
  EXPECT_EQ(rig.status().StatusWord, DWORD{});
}

TEST(SimulationOfACoupling, LetsASuperimposedMotionGoOn) {
  Simulated rig;
  auto& superimpose = rig.block<MC_MoveSuperimposed>();
  superimpose.Axis = &rig.f;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  superimpose.Distance = 30.0;
  superimpose.VelocityDiff = 20.0;
  superimpose.Execute = true;
  rig.run(300);
  const double begun = rig.f.data.Position;
  EXPECT_GT(begun, 1.0);
  rig.simulate();
  EXPECT_GT(rig.f.data.Velocity, 10.0);
  rig.run(200);
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.simulation.InSimulation);
  ASSERT_TRUE(rig.run_until([&] { return superimpose.Done; }));
  EXPECT_DOUBLE_EQ(rig.f.data.Position, 30.0);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
}

TEST(SimulationOfMC_GearInPos, IsNotRenamedByHomingAsTheGearIsNot) {
  Simulated rig;
  rig.pos.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  rig.simulate();
  rig.home_f.Position = 8.0;
  rig.home_f.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.home_f.ErrorID, static_cast<WORD>(0x80A1));
  EXPECT_EQ(rig.f.data.Position, 0.0);
}

}  // namespace
}  // namespace lockstep::coupling_simulation_test
