// MC_GearOut where the axis does not simply move on by its gear.
#include <gtest/gtest.h>

#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::gear_out_test {
namespace {

using test::Rig;

constexpr double kRing = 90.0;  // [u]

struct Geared : Rig {
  explicit Geared(bool ring = false)
      : l(axis("Leading")),
        f(axis("Following",
               [ring](AxisData& data) {
                 data.Modulo = {ring, kRing, 0.0};
               })),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        run_l(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        phase(block<MC_PhasingRelative>()),
        superimpose(block<MC_MoveSuperimposed>()),
        out(block<MC_GearOut>()) {
    lead(f, l);
    continuity[1].acceleration = false;
    continuity[1].highest_acceleration = 2.0e4;
    power_l.Axis = run_l.Axis = &l;
    power_f.Axis = superimpose.Axis = &f;
    gear.Master = phase.Master = &l;
    gear.Slave = phase.Slave = out.Slave = &f;
    power_l.Enable = power_f.Enable = true;
    run(5);
    gear.Execute = true;
    run(5);
    out.SyncProfileReference = 1;
    out.MasterStopDistance = 50.0;
  }
  void run_leading(double velocity, int ticks) {
    run_l.Velocity = velocity;
    run_l.Acceleration = 1000.0;
    run_l.Jerk = 0.0;
    run_l.Execute = false;
    run(1);
    run_l.Execute = true;
    run(ticks);
  }
  /// To its end, without turning back.
  void desynchronize(int maximum) {
    out.Execute = true;
    for (int i = 0; i < maximum && !out.Done; ++i) {
      tick();  // the rig looks for steps
      const double velocity = f.setpoint().velocity;
      ASSERT_TRUE(!out.StartSyncOut || velocity >= -1e-9) << i << " " << velocity;
    }
    ASSERT_TRUE(out.Done);
    EXPECT_EQ(f.data.Position, out.SlavePosition);
    EXPECT_TRUE(f.setpoint().standing());
  }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_MoveVelocity& run_l;
  MC_GearIn& gear;
  MC_PhasingRelative& phase;
  MC_MoveSuperimposed& superimpose;
  MC_GearOut& out;
};

TEST(MC_GearOutOverADistance, DoesNotBeginWhileTheLeadingValueStands) {
  Geared rig;
  rig.phase.PhaseShift = 100.0;  // carries the axis past the start position at 25, by itself
  rig.phase.Velocity = 50.0;
  rig.phase.Execute = true;
  rig.out.SlavePosition = 50.0;
  rig.out.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.phase.Done; }));  // the rig looks for steps
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 4);
  EXPECT_TRUE(rig.gear.InGear);
  rig.run_leading(-100.0, 0);  // and past it the other way
  ASSERT_TRUE(rig.run_until([&] { return rig.out.Done; }));
  EXPECT_EQ(rig.f.data.Position, 50.0);
}

/// It waits until the superimposed motion has come down to the leading value.
TEST(MC_GearOutOverADistance, IsNoThrowWhereTheLeadingValueCreeps) {
  Geared rig(true);
  rig.run_leading(0.5, 100);
  rig.superimpose.Distance = 200.0;
  rig.superimpose.VelocityDiff = 50.0;
  rig.superimpose.Execute = true;
  rig.out.SlavePosition = 70.0;
  rig.out.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.superimpose.Done || rig.superimpose.CommandAborted; }));
  EXPECT_GT(difference(rig.f.setpoint().position, {}, rig.f.modulo()).rounded(), 190.0);
  EXPECT_LT(rig.f.setpoint().velocity, 2.6);
  rig.run_leading(100.0, 0);
  rig.desynchronize(4000);
}

/// Whether what is superimposed speeds up, holds or slows down when the start is met.
TEST(MC_GearOutOverADistance, DoesNotPassTheStopPositionBesideSuperimposedMotion) {
  for (int tenths = 300; tenths < 2000; tenths += 17) {
    SCOPED_TRACE(tenths);
    Geared rig;
    rig.run_leading(100.0, 300);
    rig.superimpose.Distance = 60.0;
    rig.superimpose.VelocityDiff = 90.0;
    rig.superimpose.Jerk = 0.0;
    rig.superimpose.Execute = true;
    rig.out.SlavePosition = rig.f.data.Position + 0.1 * tenths;
    rig.desynchronize(4000);
  }
}

/// The faster it gets the more way braking takes, by more than the axis comes nearer meanwhile.
TEST(MC_GearOutByDynamics, MeetsItsStartWhileTheAxisAcceleratesFasterThanItWillBrake) {
  for (int tenths = 400; tenths < 2000; tenths += 17) {
    SCOPED_TRACE(tenths);
    Geared rig;
    rig.run_leading(300.0, 20);
    rig.out.SyncProfileReference = 0;
    rig.out.Deceleration = 100.0;
    rig.out.SlavePosition = 0.1 * tenths;
    rig.desynchronize(20000);
  }
}

/// An acceleration of the gear is run down with as much jerk as the velocity limit asks for.
TEST(MC_GearOutByDynamics, KeepsBelowTheVelocityLimitFromAStrongAcceleration) {
  for (int position = 700; position < 6000; position += 60) {
    SCOPED_TRACE(position);
    Geared rig;
    rig.f.data.DynamicLimits.MaxVelocity = 500.0;
    rig.gear.RatioNumerator = 10;
    rig.gear.Execute = false;
    rig.run(1);
    rig.gear.Execute = true;
    rig.run(5);
    rig.out.SyncProfileReference = 0;
    rig.out.Jerk = 20000.0;
    rig.out.SlavePosition = position;
    rig.run_leading(40.0, 10);
    rig.out.Execute = true;
    for (int i = 0; i < 20000 && !rig.out.Done; ++i) {
      rig.tick();
      ASSERT_LE(rig.f.setpoint().velocity, 500.0 * (1.0 + 1e-9)) << i;
    }
    EXPECT_TRUE(rig.out.Done);
    EXPECT_EQ(rig.f.data.Position, position);
  }
}

}  // namespace
}  // namespace lockstep::gear_out_test
