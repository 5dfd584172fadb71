/// Setpoints from the program: MC_MotionInVelocity, MC_MotionInPosition.
#pragma once

#include "fb/enable_block.hpp"

namespace lockstep {

/// Gives the axis velocity and acceleration in every call, without profile or limits. Values that are not
/// permitted stop it with maximum dynamics.
/// @source S7-1500T axis functions, MC_MotionInVelocity
/// @errors 16#800F not enabled or MC_Stop active
struct MC_MotionInVelocity final : EnableBlock {
  lockstep::Axis* Axis{};
  LREAL Velocity{};
  LREAL Acceleration{};
  BOOL PositionControlled = true;

  static constexpr std::string_view kName = "MC_MotionInVelocity";
  static constexpr std::string_view kText = "Gives the axis a velocity in every call.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MotionInVelocity";
  static constexpr auto kPins =
      pins(pin::any_axis<MC_MotionInVelocity>(), pin::kEnable,
           in<&MC_MotionInVelocity::Velocity>("Velocity", Unit::kVelocity, kGiven, "velocity setpoint",
                                              {.error = ErrorId::velocity}),
           in<&MC_MotionInVelocity::Acceleration>("Acceleration", Unit::kAcceleration, kGiven,
                                                  "acceleration from which a job that takes over goes on",
                                                  {.error = ErrorId::acceleration}),
           pin::position_controlled<MC_MotionInVelocity>(), pin::kBusy, pin::kCommandAborted, pin::kError,
           pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Gives the axis position, velocity and acceleration in every call, without profile or limits. They have to
/// fit each other. Values that are not permitted stop it with maximum dynamics.
/// @source S7-1500T axis functions, MC_MotionInPosition
/// @errors 16#800F not enabled or MC_Stop active
struct MC_MotionInPosition final : EnableBlock {
  lockstep::Axis* Axis{};
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};

  static constexpr std::string_view kName = "MC_MotionInPosition";
  static constexpr std::string_view kText = "Gives the axis a position in every call.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MotionInPosition";
  static constexpr auto kPins =
      pins(pin::axis<MC_MotionInPosition>(), pin::kEnable,
           in<&MC_MotionInPosition::Position>("Position", Unit::kPosition, kGiven,
                                              "position setpoint; on a modulo axis on the turn next to it",
                                              {.error = ErrorId::position}),
           in<&MC_MotionInPosition::Velocity>("Velocity", Unit::kVelocity, kGiven,
                                              "velocity setpoint; has to fit Position",
                                              {.error = ErrorId::velocity}),
           in<&MC_MotionInPosition::Acceleration>("Acceleration", Unit::kAcceleration, kGiven,
                                                  "acceleration from which a job that takes over goes on",
                                                  {.error = ErrorId::acceleration}),
           pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
