/// Position controller of an axis that counts: PID on the following error, with feed-forward of velocity and
/// acceleration, to a reference of so many parts of full scale.
/// @source MCO 305 Design Guide, PID controller: 32-60 to 32-72; MG.33.L5.03: KILIMTIME
#pragma once

#include <algorithm>
#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/arithmetic/seldom_cut.hpp"

namespace lockstep {

/// In qc and ms; what is not printed is a decision (README of `mco305`).
struct CountControllerSettings {
  double bandwidth = 1000.0;           ///< BANDWIDTH [1/1000 of full scale], of the three parts together
  std::int64_t idle_below = 0;         ///< REGWMIN [qc]: a smaller error switches the controller off …
  std::int64_t active_above = 0;       ///< REGWMAX [qc]: … until it is larger than this; 0: never
  std::int32_t integral_time = 0;      ///< KILIMTIME [ms]: > 0 in motion only, < 0 at standstill only; fades
  double proportional = 0.0;           ///< KPROP, per qc
  double derivative = 0.0;             ///< KDER, per qc/ms of the actual value
  double integral = 0.0;               ///< KINT, per summed qc
  double integral_limit = 0.0;         ///< KILIM, of the sum [qc]; 0: no integral part
  double velocity_precontrol = 0.0;    ///< FFVEL, per qc/ms
  double acceleration_precontrol = 0;  ///< FFACC, per qc/ms²
  double scale = 1.0;
};

/// One axis; `step` once per sampling period.
class CountController {
 public:
  static constexpr double kFullScale = 1'048'575.0;

  /// What it goes by from now on.
  void set(const CountControllerSettings& settings) noexcept {
    settings_ = settings;
    band_ = kFullScale * settings.bandwidth / 1000.0;
    plain_ = settings.active_above <= 0 && settings.integral_time == 0;
    still_ = false;
  }
  void reset() noexcept {
    sum_ = 0.0;
    idle_ = false;
    begun_ = false;
    still_ = false;
    fade_ = 0.0;
  }
  /// @param velocity, acceleration of the setpoint [qc/ms], [qc/ms²]  @param period [ms] ≥ 1
  /// @return the reference, -kFullScale to kFullScale
  double step(double setpoint, double actual, double velocity, double acceleration, double period) noexcept {
    const auto at_rest = [=]() noexcept { return same_bits({velocity, acceleration}, {0.0, 0.0}); };
    if (still_ && at_rest() && same_bits({setpoint, actual}, {last_setpoint_, last_})) return reference_;
    const double error = setpoint - actual;
    const double moved = begun_ ? actual - last_ : 0.0;
    last_setpoint_ = setpoint;
    last_ = actual;
    begun_ = true;
    const double sum_before = sum_;
    double limit = settings_.integral_limit;
    if (plain_) [[likely]] {
      idle_ = false;
    } else {
      if (rests_within(error)) return 0.0;
      limit *= faded(settings_.integral_time, velocity, period);
    }
    sum_ = std::clamp(sum_ + error, -limit, limit);
    const double pid = settings_.scale * (settings_.proportional * error + settings_.integral * sum_ -
                                          settings_.derivative * moved);
    const double precontrol = settings_.scale * (settings_.velocity_precontrol * velocity +
                                                 settings_.acceleration_precontrol * acceleration);
    reference_ = seldom_cut(seldom_cut(pid, band_) + precontrol, kFullScale);
    still_ = moved == 0.0 && at_rest() && plain_ && same_bits({sum_, 0.0}, {sum_before, 0.0});
    return reference_;
  }
  /// POSFLOAT: the error is within the control window.
  bool idle() const noexcept { return idle_; }

 private:
  // The control window: whether it is switched off.
  bool rests_within(double error) noexcept {
    idle_ = idle_ && settings_.active_above > 0;
    if (settings_.active_above <= 0) return false;
    const double distance = error < 0.0 ? -error : error;
    if (distance > static_cast<double>(settings_.active_above)) idle_ = false;
    if (distance < static_cast<double>(settings_.idle_below)) idle_ = true;
    if (idle_) sum_ = 0.0;
    return idle_;
  }
  // What part of its limit the sum may have, 0 to 1.
  double faded(std::int32_t time, double velocity, double period) noexcept {
    if (time == 0) return 1.0;
    const bool moves = velocity != 0.0;
    const double change = period / static_cast<double>(time < 0 ? -time : time);
    fade_ = std::clamp(fade_ + (moves == (time > 0) ? change : -change), 0.0, 1.0);
    return fade_;
  }

  // For the cache: seldom of account, then what a step needs, and at the end what one at rest does.
  double fade_ = 0.0;
  CountControllerSettings settings_;
  double band_ = kFullScale, sum_ = 0.0;
  double reference_ = 0.0, last_setpoint_ = 0.0, last_ = 0.0;
  bool idle_ = false, begun_ = false;
  bool plain_ = true;   // neither the control window nor KILIMTIME counts
  bool still_ = false;  // with the same again, at rest, the next step gives the same and changes nothing
};

}  // namespace lockstep
