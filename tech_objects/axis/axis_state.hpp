/// States of an axis that the orders of several families look at.
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/synchronous/leading_source.hpp"

namespace lockstep {

class Cam;
class LeadingObject;

using PowerState = LeadingSource::PowerState;

/// What generates the setpoint of an axis.
enum class AxisMotion : std::uint8_t {
  none,
  single_axis,
  given,
  synchronizing,
  synchronous,
  desynchronizing
};
/// Whether another object leads the axis.
constexpr bool led(AxisMotion motion) noexcept {
  return motion >= AxisMotion::synchronizing;
}

enum class EmergencyRamp : std::uint8_t { none, due, running };

/// What leads an axis; nullptr without coupling, and without cam.
struct Coupled {
  LeadingObject* leading = nullptr;
  Cam* cam = nullptr;
};

/// Values of Units.VelocityUnit of a speed axis.
inline constexpr UDINT kTurnsPerSecond = 1082;
inline constexpr UDINT kTurnsPerMinute = 1083;

/// Whether a velocity [u/s] is one beyond the standstill signal.
inline bool moving(double velocity, const AxisData& data) noexcept {
  return std::abs(velocity) > data.StandstillSignal.VelocityThreshold;
}

}  // namespace lockstep
