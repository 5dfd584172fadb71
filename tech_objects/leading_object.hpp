/// What may lead a following axis, and what the following axis sees of it.
/// @source S7-1500T synchronous operation V7, 5.2
#pragma once

#include <cstdint>
#include <string>

#include "tech_objects/axis_position.hpp"
#include "tech_objects/extrapolation.hpp"
#include "tech_objects/setpoint.hpp"
#include "tech_objects/technology_object.hpp"

namespace lockstep {

/// How a leading value is taken from its source.
enum class Coupling : std::uint8_t {
  setpoint,  ///< the setpoint of the same tick
  actual     ///< the extrapolated actual value
};

/// A technology object with a position that following axes follow. It is stepped before them. The functions
/// below run in the thread of the cycle.
class LeadingObject : public TechnologyObject {
 public:
  using TechnologyObject::TechnologyObject;

  Modulo modulo() const noexcept { return modulo_; }

  /// What a following axis sees, now and one interpolator tick ago.
  Setpoint leading_state(Coupling coupling) const noexcept {
    if (coupling == Coupling::actual) return leading_actual_;
    if (position_controlled_) return setpoint_;
    return {};  // [1173-1175]: without position control the leading setpoint is zero
  }
  Setpoint last_leading_state(Coupling coupling) const noexcept {
    if (coupling == Coupling::actual) return last_leading_actual_;
    if (position_controlled_) return last_setpoint_;
    return {};
  }

  /// The setpoint of the last interpolator tick, and the one before it.
  const Setpoint& setpoint() const noexcept { return setpoint_; }
  const Setpoint& last_setpoint() const noexcept { return last_setpoint_; }
  bool position_controlled() const noexcept { return position_controlled_; }

  /// Whether it stands, so that a coupling may be taken over to its simulation.
  virtual bool leading_value_stands() const noexcept = 0;

  /// Raised by a restart, after which positions may be on another ring; the cycle tells those that follow.
  bool restarted = false;

  /// Load time: somebody follows the actual value, which has to be extrapolated from then on.
  void lead_by_actual_value() noexcept { leads_by_actual_value_ = true; }

 protected:
  /// Takes the start values over; positions have to be configured.
  void configure_leading(double period, TO_Struct_Extrapolation& settings) noexcept;
  void reset_leading(AxisPosition actual) noexcept;
  /// One interpolator tick of the actual value.
  void extrapolate(AxisPosition actual, double velocity, const TO_Struct_Extrapolation& settings) noexcept;
  void shift_leading(double by) noexcept;
  void publish_extrapolation(TO_Struct_Extrapolation& settings,
                             TO_Struct_StatusExtrapolation& status) const noexcept;
  bool leads_by_actual_value() const noexcept { return leads_by_actual_value_; }

  // Hot: touched in every interpolator cycle.
  Setpoint setpoint_;
  Setpoint last_setpoint_;
  Modulo modulo_;
  bool position_controlled_ = true;

 private:
  bool leads_by_actual_value_ = false;
  Setpoint leading_actual_;
  Setpoint last_leading_actual_;
  Extrapolation extrapolation_;
};

}  // namespace lockstep
