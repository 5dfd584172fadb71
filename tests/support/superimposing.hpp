/// An axis with something superimposed on its motion, on the bench.
#pragma once

#include <gtest/gtest.h>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::test {

/// An axis with limits that a sum of two motions could exceed, and one that may lead it.
struct Superimposing : Rig {
  Superimposing()
      : leading(axis("Leading", &limit)),
        axis_(axis("Axis", &limit)),
        power_leading(block<MC_Power>()),
        power(block<MC_Power>()),
        run_leading(block<MC_MoveVelocity>()),
        home(block<MC_Home>()),
        run_velocity(block<MC_MoveVelocity>()),
        relative(block<MC_MoveRelative>()),
        absolute(block<MC_MoveAbsolute>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        stop(block<MC_Stop>()),
        gear(block<MC_GearIn>()),
        gear_out(block<MC_GearOut>()),
        offset(block<MC_OffsetRelative>()),
        move(block<MC_MoveSuperimposed>()),
        halt_superimposed(block<MC_HaltSuperimposed>()),
        given(block<MC_MotionInSuperimposed>()) {
    lead(axis_, leading);
    power_leading.Axis = run_leading.Axis = &leading;
    gear.Master = &leading;
    power.Axis = home.Axis = run_velocity.Axis = relative.Axis = absolute.Axis = jog.Axis = halt.Axis =
        &axis_;
    stop.Axis = gear.Slave = gear_out.Slave = offset.Slave = &axis_;
    move.Axis = halt_superimposed.Axis = given.Axis = &axis_;
    for (Continuity& rule : continuity) rule = {true, true, 5000.0, 100000.0};
    power_leading.Enable = power.Enable = home.Execute = true;
    Rig::run(5);
  }

  static void limit(AxisData& data) {
    data.DynamicLimits = {500.0, 500.0, 5000.0, 5000.0, 100000.0};
    data.DynamicDefaults.Jerk = 20000.0;
  }

  double position() const { return axis_.data.Position; }
  double velocity() const { return axis_.data.Velocity; }
  double superimposed() const { return axis_.data.StatusPositioning.SuperimposedDistance; }
  bool shows(StatusBit bit) const { return has_bit(axis_.data.StatusWord, bit); }
  bool shows(Status2Bit bit) const { return has_bit(axis_.data.StatusWord2, bit); }
  bool resting() const { return axis_.setpoint().standing(); }

  void run_at(double velocity) {
    run_velocity.Velocity = velocity;
    run_velocity.Execute = true;
    ASSERT_TRUE(run_until([&] { return run_velocity.InVelocity; }));
  }
  void couple(double velocity) {
    run_leading.Velocity = velocity;
    run_leading.Execute = true;
    ASSERT_TRUE(run_until([&] { return run_leading.InVelocity; }));
    gear.Execute = true;
    ASSERT_TRUE(run_until([&] { return gear.InGear; }));
  }

  Axis& leading;
  Axis& axis_;
  MC_Power& power_leading;
  MC_Power& power;
  MC_MoveVelocity& run_leading;
  MC_Home& home;
  MC_MoveVelocity& run_velocity;
  MC_MoveRelative& relative;
  MC_MoveAbsolute& absolute;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_Stop& stop;
  MC_GearIn& gear;
  MC_GearOut& gear_out;
  MC_OffsetRelative& offset;
  MC_MoveSuperimposed& move;
  MC_HaltSuperimposed& halt_superimposed;
  MC_MotionInSuperimposed& given;
};

}  // namespace lockstep::test
