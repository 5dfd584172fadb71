/// Motion on top of the base motion of an axis: MC_MoveSuperimposed, MC_HaltSuperimposed,
/// MC_MotionInSuperimposed.
#pragma once

#include "fb/enable_block.hpp"
#include "fb/execute_block.hpp"

namespace lockstep {

/// Adds a relative positioning to the base motion, which goes on untouched; without one it moves the axis
/// itself.
/// @source S7-1500T axis functions, MC_MoveSuperimposed
/// @errors 16#800F not enabled or MC_Stop active; 16#8079 velocity synchronous operation without position
///         control
struct MC_MoveSuperimposed final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Distance{};
  LREAL VelocityDiff = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;

  static constexpr std::string_view kName = "MC_MoveSuperimposed";
  static constexpr std::string_view kText = "Adds a relative positioning to the motion of the axis.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MoveSuperimposed";
  static constexpr auto kPins =
      pins(pin::axis<MC_MoveSuperimposed>(), pin::kExecute,
           in<&MC_MoveSuperimposed::Distance>("Distance", Unit::kPosition, kPositions,
                                              "signed distance, on top of the base motion",
                                              {.error = ErrorId::distance}),
           in<&MC_MoveSuperimposed::VelocityDiff>(
               "VelocityDiff", Unit::kVelocity, kNotZero,
               "greatest deviation from the velocity of the base motion; > 0: used; < 0: "
               "DynamicDefaults.Velocity; 0 is not permitted",
               {.error = ErrorId::velocity}),
           pin::acceleration<MC_MoveSuperimposed>(), pin::deceleration<MC_MoveSuperimposed>(),
           pin::jerk<MC_MoveSuperimposed>(), pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError,
           pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Brings the superimposed part of the motion to rest; the base motion goes on. Done at once if nothing
/// moves.
/// @source S7-1500T axis functions, MC_HaltSuperimposed
/// @errors 16#800F not enabled or MC_Stop active; 16#8079 velocity synchronous operation without position
///         control
struct MC_HaltSuperimposed final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL AbortAcceleration{};

  static constexpr std::string_view kName = "MC_HaltSuperimposed";
  static constexpr std::string_view kText = "Stops what is superimposed on the motion of the axis.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_HaltSuperimposed";
  static constexpr auto kPins =
      pins(pin::axis<MC_HaltSuperimposed>(), pin::kExecute, pin::deceleration<MC_HaltSuperimposed>(),
           pin::jerk<MC_HaltSuperimposed>(), pin::abort_acceleration<MC_HaltSuperimposed>(), pin::kDone,
           pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Adds the given values to the setpoint of the base motion in every call, without profile or limits.
/// Distance counts from where the axis is at the start. Values that are not permitted stop the added motion
/// with maximum dynamics.
/// @source S7-1500T axis functions, MC_MotionInSuperimposed
/// @errors 16#800F not enabled or MC_Stop active; 16#8071 not position-controlled; 16#8079 velocity
/// synchronous
///         operation without position control
struct MC_MotionInSuperimposed final : EnableBlock {
  lockstep::Axis* Axis{};
  LREAL Distance{};
  LREAL VelocityDiff{};
  LREAL AccelerationDiff{};

  static constexpr std::string_view kName = "MC_MotionInSuperimposed";
  static constexpr std::string_view kText = "Adds given values to the setpoint of the axis in every call.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MotionInSuperimposed";
  static constexpr auto kPins =
      pins(pin::axis<MC_MotionInSuperimposed>(), pin::kEnable,
           in<&MC_MotionInSuperimposed::Distance>("Distance", Unit::kPosition, kGiven,
                                                  "added to the position; counts from the start on",
                                                  {.error = ErrorId::distance}),
           in<&MC_MotionInSuperimposed::VelocityDiff>("VelocityDiff", Unit::kVelocity, kGiven,
                                                      "added to the velocity; has to fit Distance",
                                                      {.error = ErrorId::velocity}),
           in<&MC_MotionInSuperimposed::AccelerationDiff>(
               "AccelerationDiff", Unit::kAcceleration, kGiven,
               "acceleration from which a job that takes over goes on", {.error = ErrorId::acceleration}),
           pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
