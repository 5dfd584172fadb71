/// An axis with software limits on the bench, beside one that may lead it.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/jog.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::test {

using Configure = std::function<void(AxisData&)>;

inline constexpr double kRounding = 1e-9;  ///< [u] what a position may be off by rounding

inline void use_limits(AxisData& data, double minimum, double maximum) {
  data.PositionLimits_SW.Active = true;
  data.PositionLimits_SW.MinPosition = minimum;
  data.PositionLimits_SW.MaxPosition = maximum;
}

inline void within_a_hundred(AxisData& data) {
  use_limits(data, -100.0, 100.0);
}

/// A leading axis without and a following axis with limits, both enabled and homed at 0.
struct Limited : Rig {
  explicit Limited(int ratio = 1, bool driven = false, const Configure& configure = within_a_hundred)
      : Rig(1'000'000, ratio),
        l(axis("Leading")),
        a(axis("Limited",
               [&](AxisData& data) {
                 if (driven) drive(data);
                 configure(data);
               })),
        power_l(block<MC_Power>()),
        run_l(block<MC_MoveVelocity>()),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        move(block<MC_MoveAbsolute>()),
        relative(block<MC_MoveRelative>()),
        run_a(block<MC_MoveVelocity>()),
        jog(block<MC_MoveJog>()),
        halt(block<MC_Halt>()),
        gear(block<MC_GearIn>()),
        reset(block<MC_Reset>()) {
    a.drive_settings = {.time_constant = 0.002, .dead_time = 0.001, .resolution = 0.0};
    lead(a, l);
    power_l.Axis = run_l.Axis = &l;
    power.Axis = home.Axis = &a;
    reset.Axis = &a;
    move.Axis = relative.Axis = run_a.Axis = jog.Axis = halt.Axis = &a;
    gear.Master = &l;
    gear.Slave = &a;
    power_l.Enable = power.Enable = true;
    run(10 * ratio);
    home.Execute = true;
    run(10 * ratio);
  }

  static void drive(AxisData& data) {
    data.VirtualAxis.Mode = 0;
    data.PositionControl.Kv = 40.0;
  }

  double position() const { return a.setpoint().position.value; }

  /// Asserts over a time that the setpoint stays on its side of both limits.
  void run_within(int ticks, double minimum = -100.0, double maximum = 100.0) {
    for (int i = 0; i < ticks; ++i) {
      tick();
      ASSERT_LE(position(), maximum + kRounding) << "at " << controller.now();
      ASSERT_GE(position(), minimum - kRounding) << "at " << controller.now();
    }
  }

  void acknowledge() {
    reset.Execute = false;
    run(40);
    reset.Execute = true;
    run(40);
    ASSERT_TRUE(reset.Done);
  }

  Axis& l;
  Axis& a;
  MC_Power& power_l;
  MC_MoveVelocity& run_l;
  MC_Power& power;
  MC_Home& home;
  MC_MoveAbsolute& move;
  MC_MoveRelative& relative;
  MC_MoveVelocity& run_a;
  MC_MoveJog& jog;
  MC_Halt& halt;
  MC_GearIn& gear;
  MC_Reset& reset;
};

}  // namespace lockstep::test
