/// Bringing an axis to rest: MC_Halt and MC_Stop.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// Brakes the axis to standstill; another motion job may take over at any time.
/// @source S7-1500T axis functions, MC_Halt
/// @errors 16#800F not enabled or MC_Stop active
struct MC_Halt final : ExecuteBlock {
  lockstep::Axis* Axis{};
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL AbortAcceleration{};
  INT BufferMode{};

  static constexpr std::string_view kName = "MC_Halt";
  static constexpr std::string_view kText = "Brakes the axis to standstill.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Halt";
  static constexpr auto kPins =
      pins(pin::any_axis<MC_Halt>(), pin::kExecute, pin::deceleration<MC_Halt>(), pin::jerk<MC_Halt>(),
           pin::abort_acceleration<MC_Halt>(), pin::buffer_mode<MC_Halt>(), pin::kDone, pin::kBusy,
           pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
};

/// Stops every motion of the axis and locks it against new motion jobs while Execute is TRUE.
/// @source S7-1500T axis functions, MC_Stop
/// @errors 16#800F not enabled
struct MC_Stop final : ExecuteBlock {
  lockstep::Axis* Axis{};
  DINT Mode{};
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL AbortAcceleration{};

  static constexpr std::string_view kName = "MC_Stop";
  static constexpr std::string_view kText =
      "Stops every motion of the axis and blocks new ones while Execute is TRUE.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Stop";
  static constexpr Choice kModes[] = {
      {0, "emergency stop: DynamicDefaults.EmergencyDeceleration, no jerk limit"},
      {2, "maximum dynamics: DynamicLimits.MaxDeceleration and MaxJerk"},
      {3, "Deceleration and Jerk of the block"}};
  static bool given_dynamics(const Block& block) noexcept {
    return chooses(static_cast<const MC_Stop&>(block).Mode, StopMode::given_dynamics);
  }
  static constexpr auto kPins = pins(
      pin::any_axis<MC_Stop>(), pin::kExecute,
      in<&MC_Stop::Mode>("Mode", Unit::kNone, kAny, "stop ramp", {.error = ErrorId::mode, .choices = kModes}),
      pin::deceleration<MC_Stop>({.error = ErrorId::deceleration, .relevant = &given_dynamics}),
      pin::jerk<MC_Stop>({.error = ErrorId::jerk, .relevant = &given_dynamics}),
      pin::abort_acceleration<MC_Stop>(), pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError,
      pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  lockstep::Axis* target() const noexcept override { return Axis; }
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
