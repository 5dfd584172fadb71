/// Positioning and endless motion of a single axis: MC_MoveAbsolute, MC_MoveRelative, MC_MoveVelocity.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Moves the axis to an absolute position.
/// @source S7-1500T axis functions, MC_MoveAbsolute
/// @errors 16#800F not enabled or MC_Stop active; 16#800A BufferMode, also behind a synchronous job; 16#8014
/// a
///         job is buffered already; not homed: technology alarm 321, 16#8001
struct MC_MoveAbsolute final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Position{};
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  INT Direction = 1;
  INT BufferMode{};

  static constexpr std::string_view kName = "MC_MoveAbsolute";
  static constexpr std::string_view kText = "Moves the axis to an absolute position.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MoveAbsolute";
  static constexpr Choice kDirections[] = {
      {1, "positive direction"}, {2, "negative direction"}, {3, "shortest way"}};
  static bool has_modulo(const Block& block) noexcept;
  static constexpr auto kPins =
      pins(pin::axis<MC_MoveAbsolute>(), pin::kExecute,
           in<&MC_MoveAbsolute::Position>("Position", Unit::kPosition, kPositions, "target position",
                                          {.error = ErrorId::position}),
           pin::velocity<MC_MoveAbsolute>("> 0: used; < 0: DynamicDefaults.Velocity; 0 is not permitted"),
           pin::acceleration<MC_MoveAbsolute>(), pin::deceleration<MC_MoveAbsolute>(),
           pin::jerk<MC_MoveAbsolute>(),
           in<&MC_MoveAbsolute::Direction>(
               "Direction", Unit::kNone, kAny, "way to the target on a modulo axis",
               {.error = ErrorId::direction, .choices = kDirections, .relevant = &has_modulo}),
           pin::buffer_mode<MC_MoveAbsolute>(), pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError,
           pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Moves the axis by a distance from its setpoint at the start.
/// @source S7-1500T axis functions, MC_MoveRelative
/// @errors 16#800F not enabled or MC_Stop active; 16#800A BufferMode, also behind a synchronous job; 16#8014
/// a
///         job is buffered already
struct MC_MoveRelative final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Distance{};
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  INT BufferMode{};

  static constexpr std::string_view kName = "MC_MoveRelative";
  static constexpr std::string_view kText = "Moves the axis by a distance from where it is.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MoveRelative";
  static constexpr auto kPins =
      pins(pin::axis<MC_MoveRelative>(), pin::kExecute,
           in<&MC_MoveRelative::Distance>("Distance", Unit::kPosition, kPositions, "signed distance",
                                          {.error = ErrorId::distance}),
           pin::velocity<MC_MoveRelative>("> 0: used; < 0: DynamicDefaults.Velocity; 0 is not permitted"),
           pin::acceleration<MC_MoveRelative>(), pin::deceleration<MC_MoveRelative>(),
           pin::jerk<MC_MoveRelative>(), pin::buffer_mode<MC_MoveRelative>(), pin::kDone, pin::kBusy,
           pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Moves the axis endlessly with a velocity.
/// @source S7-1500T axis functions, MC_MoveVelocity
/// @errors 16#800F not enabled or MC_Stop active; 16#800A BufferMode, also behind a synchronous job; 16#8014
/// a
///         job is buffered already
struct MC_MoveVelocity final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Velocity = 100.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  INT Direction{};
  BOOL Current{};
  BOOL PositionControlled = true;
  INT BufferMode{};
  BOOL InVelocity{};

  static constexpr std::string_view kName = "MC_MoveVelocity";
  static constexpr std::string_view kText = "Moves the axis endlessly with a velocity.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MoveVelocity";
  static constexpr Choice kDirections[] = {
      {0, "the sign of Velocity decides"}, {1, "positive direction"}, {2, "negative direction"}};
  static constexpr auto kPins = pins(
      pin::any_axis<MC_MoveVelocity>(), pin::kExecute,
      in<&MC_MoveVelocity::Velocity>("Velocity", Unit::kVelocity, kFinite,
                                     "velocity; 0 is permitted and brakes; no default for negative values",
                                     {.error = ErrorId::velocity}),
      pin::acceleration<MC_MoveVelocity>(), pin::deceleration<MC_MoveVelocity>(),
      pin::jerk<MC_MoveVelocity>(),
      in<&MC_MoveVelocity::Direction>("Direction", Unit::kNone, kAny,
                                      "direction; with 1 and 2 the amount of Velocity counts",
                                      {.error = ErrorId::direction, .choices = kDirections}),
      in<&MC_MoveVelocity::Current>(
          "Current", Unit::kNone, kAny,
          "TRUE: the velocity at the start is held; Velocity and Direction are ignored"),
      pin::position_controlled<MC_MoveVelocity>(), pin::buffer_mode<MC_MoveVelocity>(),
      out<&MC_MoveVelocity::InVelocity>("InVelocity", "the velocity is reached and held"), pin::kBusy,
      pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
  void show(JobPhase phase) noexcept override { InVelocity = phase == JobPhase::reached; }
};

}  // namespace lockstep
