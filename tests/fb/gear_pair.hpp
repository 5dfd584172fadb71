/// A leading and a following axis: a rig of the tests of gearing.
#pragma once

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/stop.hpp"
#include "tests/support/coupled_rig.hpp"

namespace lockstep::test {

struct GearPair : CoupledRig {
  explicit GearPair(const Shape& leading = line, const Shape& following = line)
      : CoupledRig(leading, following),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        move_f(block<MC_MoveVelocity>()),
        halt_f(block<MC_Halt>()) {
    move_f.Axis = halt_f.Axis = &f;
    gear.Master = pos.Master = &l;
    gear.Slave = pos.Slave = &f;
    begin();
  }

  double following_minus_function(double numerator, double denominator, double l0, double f0) const {
    const double distances = numerator / denominator * (l.setpoint().position.value - l0) + f0;
    return f.setpoint().position.value - distances;
  }

  MC_GearIn& gear;
  MC_GearInPos& pos;
  MC_MoveVelocity& move_f;
  MC_Halt& halt_f;
};

}  // namespace lockstep::test
