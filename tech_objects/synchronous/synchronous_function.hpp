/// The middle of the chain: effective leading value → + phase shift → function (gear | cam).
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/synchronous/cam_coupling.hpp"
#include "tech_objects/synchronous/gear_function.hpp"
#include "tech_objects/synchronous/request.hpp"
#include "tech_objects/synchronous/shift.hpp"

namespace lockstep {

/// A gear or a cam, and the value that it has in this tick. Thread: the cycle.
class SynchronousFunction {
 public:
  void configure(const Modulo& following) noexcept { following_ = following; }

  /// Another one, which is not placed yet.
  void couple(const CouplingRequest& request, const Modulo& leading) noexcept {
    curve_ = request.curve;
    ratio_ = request.ratio;
    coupled_ratio_ = request.ratio.rounded();
    leading_ = leading;
  }
  void end() noexcept { curve_ = nullptr; }

  bool is_cam() const noexcept { return curve_ != nullptr; }
  CamCoupling& cam() noexcept { return cam_; }
  const CamCoupling& cam() const noexcept { return cam_; }

  const GearFunction& gear() const noexcept { return gear_; }
  AxisPosition gear_value(AxisPosition leading) noexcept { return gear_.value(leading); }
  /// Ratio of the gear when it was coupled.
  double ratio() const noexcept { return coupled_ratio_; }
  /// Both positions belong together from now on.
  void place_gear(AxisPosition leading, AxisPosition following) noexcept {
    gear_.set(ratio_.numerator, ratio_.denominator, leading, following, leading_, following_);
    geared_phase_.forget();
  }
  /// Another ratio, of a gear that is not placed.
  void change_ratio(const GearRatio& ratio) noexcept {
    if (ratio == ratio_) return;
    ratio_ = ratio;
    place_gear({}, {});
  }

  /// The following side is called otherwise by so many turns, or the leading side.
  void turn_following(std::int64_t turns) noexcept {
    value_.position.turns += turns;
    add_turns(turns);
  }
  void turn_leading(std::int64_t turns) noexcept {
    if (is_cam())
      cam_.add_leading_turns(turns);
    else
      gear_.add_leading_turns(turns);
  }

  /// The value of this tick, also to `result`. Written value by value: copying a whole setpoint would make
  /// the processor wait until its parts have left for memory.
  void evaluate(const Setpoint& leading, Setpoint& result) noexcept {
    if (is_cam()) return evaluate_cam(leading, result);
    show(gear_.value(leading.position), gear_.velocity(leading.velocity),
         gear_.acceleration(leading.acceleration), result);
  }
  /// The value of this tick alone.
  void evaluate(const Setpoint& leading) noexcept { evaluate(leading, value_); }
  /// With a phase shift. Its share is added behind a gear, where nothing is rounded in between.
  void evaluate(const Setpoint& leading, const Shift& phase) noexcept {
    if (is_cam()) return evaluate_cam(shifted(leading, phase), value_);
    const AxisPosition unshifted = gear_.value(leading.position);
    const AxisPosition position =
        advanced(unshifted, geared_phase_.of(phase.value(), gear_.ratio()), following_);
    double velocity = gear_.velocity(leading.velocity);
    double acceleration = gear_.acceleration(leading.acceleration);
    if (phase.moves()) {
      velocity += gear_.velocity(phase.velocity());
      acceleration += gear_.acceleration(phase.acceleration());
    }
    show(position, velocity, acceleration, value_);
  }

  const Setpoint& value() const noexcept { return value_; }
  /// What stands for it, while the axis is on its way in or out.
  void show(const Setpoint& value) noexcept { value_ = value; }
  /// The axis has another name for every position [u].
  void shift_shown(double by) noexcept { value_.position = advanced(value_.position, by, following_); }

  const Modulo& following() const noexcept { return following_; }

 private:
  /// A phase shift behind the gear; most of the time it is that of the tick before.
  class GearedPhase {
   public:
    const DoubleDouble& of(const DoubleDouble& phase, const DoubleDouble& ratio) noexcept {
      if (!known_ || !same_bits(phase, phase_)) renew(phase, ratio);
      return product_;
    }
    /// The gear has changed.
    void forget() noexcept { known_ = false; }

   private:
    [[gnu::noinline]] void renew(const DoubleDouble& phase, const DoubleDouble& ratio) noexcept {
      known_ = true;
      phase_ = phase;
      product_ = ratio * phase;
    }

    bool known_ = false;
    DoubleDouble phase_;
    DoubleDouble product_;
  };

  void evaluate_cam(const Setpoint& leading, Setpoint& result) noexcept;
  Setpoint shifted(const Setpoint& leading, const Shift& phase) const noexcept {
    return {advanced(leading.position, phase.value(), leading_), leading.velocity + phase.velocity(),
            leading.acceleration + phase.acceleration()};
  }
  void add_turns(std::int64_t turns) noexcept {
    if (is_cam())
      cam_.add_turns(turns);
    else
      gear_.add_turns(turns);
  }
  void show(AxisPosition position, double velocity, double acceleration, Setpoint& result) noexcept {
    result.position.turns = value_.position.turns = position.turns;
    result.position.value = value_.position.value = position.value;
    result.velocity = value_.velocity = velocity;
    result.acceleration = value_.acceleration = acceleration;
  }

  // What every cycle touches first.
  Setpoint value_;
  const CamFunction* curve_ = nullptr;  // nullptr: a gear
  Modulo following_;
  GearFunction gear_;
  CamCoupling cam_;
  GearedPhase geared_phase_;
  Modulo leading_;
  GearRatio ratio_;
  double coupled_ratio_ = 1.0;
};

}  // namespace lockstep
