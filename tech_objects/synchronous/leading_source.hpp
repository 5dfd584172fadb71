/// What leads, as the chain of a synchronous motion sees it.
/// @source S7-1500T synchronous operation V7, 5.2, 5.3
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// How a leading value is taken from its source.
enum class Coupling : std::uint8_t {
  setpoint,  ///< the setpoint of the same tick
  actual,    ///< the extrapolated actual value
  delayed    ///< the leading value as it is provided to other controllers, delayed until they have it
};

/// What axes see that have followed the position of an axis when that left position control: zero, and once
/// position control has been taken up again a distance from there back to the setpoint.
struct UncontrolledLead {
  std::uint32_t times = 0;  ///< how often position control has been left
  AxisPosition zero;        ///< on the turn of the time; on that of its end once it has ended
  bool returning = false;   ///< position control is there again
  Setpoint now;             ///< while returning, at this tick and one before
  Setpoint last;
};

/// The leading values of one source, now and one interpolator tick ago; whoever leads derives from it and
/// writes them before those that follow are stepped. Thread: the cycle.
class LeadingSource {
 public:
  /// `drive_stops`: switched off, and the drive comes to rest by itself.
  enum class PowerState : std::uint8_t { off, switching_on, drive_stops, on, braking };

  Modulo modulo() const noexcept { return modulo_; }

  /// Whether an axis coupled like this sees what `leading_state` tells: the actual value, or the setpoint as
  /// it is. Else it has to look at `led_setpoint` and `uncontrolled_lead`, or at the names of positions.
  bool leads_as_it_is(Coupling coupling) const noexcept {
    if (coupling != Coupling::setpoint) return coupling == Coupling::actual;
    return position_controlled_ && !handing_over_;
  }
  /// What a following axis sees, now and one interpolator tick ago.
  const Setpoint& leading_state(Coupling coupling) const noexcept {
    if (coupling == Coupling::setpoint) return setpoint_;
    return coupling == Coupling::actual ? leading_actual_ : delayed_;
  }
  const Setpoint& last_leading_state(Coupling coupling) const noexcept {
    if (coupling == Coupling::setpoint) return last_setpoint_;
    return coupling == Coupling::actual ? last_leading_actual_ : last_delayed_;
  }

  /// The setpoint without the steps that it makes where it goes over to another course, now and one tick ago.
  const Setpoint& led_setpoint() const noexcept { return handing_over_ ? led_ : setpoint_; }
  const Setpoint& last_led_setpoint() const noexcept { return handing_over_ ? last_led_ : last_setpoint_; }
  const UncontrolledLead& uncontrolled_lead() const noexcept { return uncontrolled_; }

  /// By how much homing has changed the names of positions since the start [u].
  DoubleDouble renamed() const noexcept { return renamed_; }
  /// Whether an axis coupled like this goes on with the names of positions that it began with, so that it
  /// does not move where they change: where the value comes from another controller, or goes there as well.
  bool keeps_names(Coupling coupling) const noexcept {
    return coupling == Coupling::delayed || led_from_elsewhere_;
  }

  /// The setpoint of the last interpolator tick, and the one before it.
  const Setpoint& setpoint() const noexcept { return setpoint_; }
  const Setpoint& last_setpoint() const noexcept { return last_setpoint_; }
  bool position_controlled() const noexcept { return position_controlled_; }

  /// Whether a drive is not led by the setpoint, which tracks the actual value then.
  bool setpoint_is_actual() const noexcept { return power_state_ < PowerState::on; }

 protected:
  Setpoint leading_actual_;
  Setpoint last_leading_actual_;
  Setpoint led_;
  Setpoint last_led_;
  UncontrolledLead uncontrolled_;
  Setpoint delayed_;
  Setpoint last_delayed_;
  DoubleDouble renamed_;
  bool led_from_elsewhere_ = false;

  // From here on, and on in whoever derives from it, what every interpolator cycle touches.
  alignas(kCacheLine) Setpoint setpoint_;
  Setpoint last_setpoint_;
  Modulo modulo_;
  bool position_controlled_ = true;
  bool handing_over_ = false;  // axes that follow the setpoint have to look closely: they see another one, or
                               // other names
  PowerState power_state_ = PowerState::off;
};

}  // namespace lockstep
