/// The temperature of a motor as it is calculated from its current.
/// @source LinMot release 1.3 addendum, 6.4 (Drive Too Hot Calculated); the model is this program's
#pragma once

#include "tech_objects/arithmetic/decay.hpp"

namespace lockstep::linmot {

/// What a motor bears. 100 % is what its nominal current heats it to in the end.
struct ThermalSettings {
  double nominal_current = 0.0;  ///< [A] that it bears for ever; 0: nothing is calculated
  double time_constant = 60.0;   ///< [s] > 0
  double warn = 90.0;            ///< [%] above which there is a warning
  double error = 100.0;          ///< [%] above which there is an error

  bool calculates() const noexcept { return nominal_current > 0.0; }
};

/// A lag of first order behind the square of the current. The cycle's thread.
class Thermal {
 public:
  /// While loading: cold. @param tick servo cycle [s]  @param cycles control cycles in it
  void configure(const ThermalSettings& settings, double tick, int cycles) noexcept {
    heat_ = sum_ = 0.0;
    calculates_ = settings.calculates();
    share_ = decay_within(tick / settings.time_constant);
    scale_ =
        settings.calculates() ? 100.0 / (settings.nominal_current * settings.nominal_current) / cycles : 0.0;
  }
  /// In each control cycle. @param current [A]
  void add(double current) noexcept { sum_ += current * current; }
  /// At the end of a servo tick.
  void tick() noexcept {
    heat_ += share_ * (scale_ * sum_ - heat_);
    sum_ = 0.0;
  }
  /// Else it stays cold, and neither currents nor ticks count.
  bool calculates() const noexcept { return calculates_; }
  double heat() const noexcept { return heat_; }  ///< [%]

 private:
  double heat_ = 0.0, sum_ = 0.0, share_ = 0.0, scale_ = 0.0;
  bool calculates_ = false;
};

}  // namespace lockstep::linmot
