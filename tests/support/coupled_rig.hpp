/// Two axes of which the one leads the other, as most tests of synchronous operation begin.
#pragma once

#include <functional>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::test {

inline void line(AxisData& /*data*/) {}

/// A leading and a following axis, each with MC_Power and MC_Home; the leading one is moved by
/// MC_MoveVelocity. Whoever derives from it adds objects and blocks, and calls `begin` once all are there.
struct CoupledRig : Rig {
  using Shape = std::function<void(AxisData&)>;

  explicit CoupledRig(const Shape& leading = line, const Shape& following = line)
      : l(axis("Leading", leading)),
        f(axis("Following", following)),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_l(block<MC_Home>()),
        home_f(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()) {
    lead(f, l);
    power_l.Axis = home_l.Axis = run_l.Axis = &l;
    power_f.Axis = home_f.Axis = &f;
  }

  /// Both are enabled and homed. While it synchronizes over a distance the following axis has no limits of
  /// its own.
  void begin() {
    power_l.Enable = power_f.Enable = true;
    run(3);
    home_l.Execute = home_f.Execute = true;
    run(3);
    continuity[1].highest_acceleration = 1e6;
    continuity[1].highest_jerk = 1e9;
  }

  void start_leading(double velocity) {
    run_l.Velocity = velocity;
    run_l.Execute = false;
    tick();
    run_l.Execute = true;
  }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home_l;
  MC_Home& home_f;
  MC_MoveVelocity& run_l;
};

}  // namespace lockstep::test
