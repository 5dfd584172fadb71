/// What axes that follow the setpoint see of it where it goes over from one course to another.
#pragma once

#include "tech_objects/axis/course_hand_over.hpp"
#include "tech_objects/axis/motion_limits.hpp"
#include "tech_objects/synchronous/leading_source.hpp"

namespace lockstep {

/// Where the setpoint is, and what of the axis those see that follow it.
struct HandOverParts {
  const AxisData& data;
  const MotionLimits& limits_;
  const Setpoint& setpoint_;
  const Setpoint& last_setpoint_;
  const Modulo& modulo_;
  const double& period_;
  bool& position_controlled_;
  bool& handing_over_;
  bool& control_switched_;
  Setpoint& led_;
  Setpoint& last_led_;
  UncontrolledLead& uncontrolled_;
};

/// It goes over to the actual value of an axis that is switched off, and back; to the emergency ramp; and
/// where position control is taken up again, without which they see zero. For them there is no step: what
/// they see goes on from where it has been and comes over with maximum dynamics. Thread: the cycle.
class HandOverOrders : private HandOverParts {
 public:
  explicit HandOverOrders(const HandOverParts& parts) noexcept : HandOverParts(parts) {}

  void configure(double period) noexcept { course_.configure(period); }

  /// @param seen what following axes have seen last  @param now where the setpoint goes on from, at that tick
  void begin(const Setpoint& seen, const Setpoint& now) noexcept;
  /// Position control on or off, from the last setpoint on.
  void switch_position_control(bool on) noexcept;
  /// Whether it has been switched in this tick.
  bool switched() const noexcept { return control_switched_; }

  /// The setpoint is about to become the actual value of an axis that is switched off.
  void make_due(bool due) noexcept { course_.make_due(due); }
  bool due() const noexcept { return course_.due(); }
  /// It has just done so, or that value has been given another name.
  void to_actual() noexcept;

  /// Each tick while it lasts, after the setpoint of the tick.
  void step() noexcept;
  bool finished() const noexcept { return course_.finished(); }
  /// The setpoint as following axes see it.
  const Setpoint& led_setpoint() const noexcept { return handing_over_ ? led_ : setpoint_; }

  /// Positions have other names [u].
  void shift(double by) noexcept;

 private:
  Dynamics dynamics() const noexcept;
  void lead_by(const Setpoint& led) noexcept;
  void lead_with_zero() noexcept;
  bool takes_switch_back() noexcept;

  CourseHandOver course_;
  UncontrolledLead before_switch_;
};

}  // namespace lockstep
