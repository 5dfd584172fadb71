/// Which limits of an axis a setpoint of a synchronous motion exceeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tech_objects/axis/status_words.hpp"

namespace lockstep::status_words {

/// Share of the highest velocity by which the difference of two may be rounded up.
inline constexpr double kRounding = 1e-13;

/// A setpoint, the one before it, and what limits the axis.
struct Excess {
  const Setpoint& now;
  const Setpoint& last;
  const TO_Struct_DynamicLimits& limits;
  double period;

  /// Which limits the setpoint exceeds: none, most of the time.
  std::uint32_t bits() const noexcept {
    const double steepest = std::min(limits.MaxAcceleration, limits.MaxDeceleration);
    const double change = now.velocity - last.velocity;
    const bool within = std::abs(now.velocity) <= limits.MaxVelocity &&
                        std::abs(now.acceleration) <= steepest && std::abs(change) <= steepest * period;
    return within ? 0 : bits_beyond_limits();
  }

  std::uint32_t bits_beyond_limits() const noexcept {
    const double push = now.velocity < 0.0 ? -now.acceleration : now.acceleration;
    // A velocity may step where the acceleration of the function does not tell: with a changed ratio, at a
    // corner of a cam.
    const double change = now.velocity - last.velocity;
    const double gained = sign(now.velocity) * change;
    const double lost = -sign(last.velocity) * change;
    const double rounding = kRounding * limits.MaxVelocity;
    const bool too_quick =
        push > limits.MaxAcceleration || gained - rounding > limits.MaxAcceleration * period;
    const bool too_hard = -push > limits.MaxDeceleration || lost - rounding > limits.MaxDeceleration * period;
    return when(std::abs(now.velocity) > limits.MaxVelocity, SynchronizedMotionBit::MaxVelocityExceeded) |
           when(too_quick, SynchronizedMotionBit::MaxAccelerationExceeded) |
           when(too_hard, SynchronizedMotionBit::MaxDecelerationExceeded);
  }
};

}  // namespace lockstep::status_words
