/// Position loop that asks for a current: PD or PID with feed-forward of friction and acceleration, as the
/// servo controllers of linear motors have it.
/// @source LinMot release 1.3 addendum, 6.4 (Control Parameters), 7.1, 7.2
#pragma once

#include <algorithm>
#include <limits>

namespace lockstep {

/// Gains. Positions in mm; the other units are those in which such controllers state them.
struct CurrentLoopSettings {
  double proportional = 0.0;     ///< P [A/mm] ≥ 0
  double derivative = 0.0;       ///< D [A/(m/s)] ≥ 0
  double integral = 0.0;         ///< I [A/(mm s)] ≥ 0; 0: no integral part
  double friction = 0.0;         ///< FF Friction [A] ≥ 0, in the direction of the setpoint's motion
  double acceleration = 0.0;     ///< FF Acceleration [mA/(m/s²)], while the setpoint becomes faster
  double deceleration = 0.0;     ///< FF Deceleration [mA/(m/s²)], while it becomes slower
  double offset = 0.0;           ///< Current Offset [A]
  double maximum_current = 0.0;  ///< [A] > 0

  bool operator==(const CurrentLoopSettings&) const = default;
};

/// Currents that are permitted [A]: lower ≤ upper.
struct CurrentBand {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// A setpoint of the position loop: [mm], [mm/s], [mm/s²].
struct LoopSetpoint {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// One motor; `step` once per control cycle. The velocity is the difference of the last two positions.
/// Deterministic, additions and multiplications alone. The cycle's thread.
class CurrentLoop {
 public:
  /// @param cycle [s] > 0. What the integral part has gathered stays: gains may change at run time.
  void configure(const CurrentLoopSettings& settings, double cycle) noexcept {
    constexpr double kMillimetres = 1e-3, kMilliamperes = 1e-3;
    proportional_ = settings.proportional;
    derivative_per_cycle_ = settings.derivative * kMillimetres / cycle;
    derivative_ = settings.derivative * kMillimetres;
    integral_per_cycle_ = settings.integral * cycle;
    friction_ = settings.friction;
    acceleration_ = settings.acceleration * kMilliamperes * kMillimetres;
    deceleration_ = settings.deceleration * kMilliamperes * kMillimetres;
    offset_ = settings.offset;
    maximum_ = settings.maximum_current;
  }
  /// Begins anew at a position that rests [mm].
  void reset(double actual) noexcept {
    last_ = actual;
    sum_ = 0.0;
    excess_ = 0.0;
  }

  /// @param additive current that is added before the limits [A]
  /// @return the current [A], within ±maximum_current and the band; a band that leaves nothing of that gives
  /// the end of it that is nearer to 0
  double step(const LoopSetpoint& setpoint, double actual, const CurrentBand& band,
              double additive = 0.0) noexcept {
    const double lower = std::clamp(band.lower, -maximum_, maximum_);
    const double upper = std::clamp(band.upper, lower, maximum_);
    return step_within(setpoint, actual, additive, lower, upper);
  }
  /// One step where nothing limits or adds but the settings. @return the current [A], within ±maximum_current
  double step(const LoopSetpoint& setpoint, double actual) noexcept {
    return step_within(setpoint, actual, 0.0, -maximum_, maximum_);
  }
  /// [A] By what the last step asked for more than it was permitted; its sign says in which direction.
  double excess() const noexcept { return excess_; }

 private:
  static double sign(double value) noexcept { return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0; }

  double step_within(const LoopSetpoint& setpoint, double actual, double additive, double lower,
                     double upper) noexcept {
    const double error = setpoint.position - actual;
    const double moved = actual - last_;
    last_ = actual;
    const bool slower = setpoint.acceleration * setpoint.velocity < 0.0;
    const double asked = additive + offset_ + proportional_ * error + derivative_ * setpoint.velocity -
                         derivative_per_cycle_ * moved + sum_ + sign(setpoint.velocity) * friction_ +
                         setpoint.acceleration * (slower ? deceleration_ : acceleration_);
    const double current = std::clamp(asked, lower, upper);
    excess_ = asked - current;
    // At its limit the integral part stands, but for the way back.
    if (!(excess_ * error > 0.0)) sum_ += integral_per_cycle_ * error;
    return current;
  }

  double proportional_ = 0.0, derivative_ = 0.0, derivative_per_cycle_ = 0.0, integral_per_cycle_ = 0.0;
  double friction_ = 0.0, acceleration_ = 0.0, deceleration_ = 0.0, offset_ = 0.0, maximum_ = 0.0;
  double last_ = 0.0, sum_ = 0.0, excess_ = 0.0;
};

}  // namespace lockstep
