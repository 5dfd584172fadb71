/// Jogging: MC_MoveJog.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Moves the axis while an input is held.
/// @source S7-1500T axis functions, MC_MoveJog
/// @errors 16#8007 both inputs TRUE: the axis brakes; 16#800F not enabled or MC_Stop active
struct MC_MoveJog final : Block {
  lockstep::Axis* Axis{};
  BOOL JogForward{};
  BOOL JogBackward{};
  LREAL Velocity = 100.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL PositionControlled = true;
  BOOL InVelocity{};
  BOOL Busy{};
  BOOL CommandAborted{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_MoveJog";
  static constexpr std::string_view kText = "Moves the axis while an input is held.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_MoveJog";
  static constexpr auto kPins =
      pins(pin::any_axis<MC_MoveJog>(),
           in<&MC_MoveJog::JogForward>("JogForward", Unit::kNone, kAny, "TRUE: move in positive direction"),
           in<&MC_MoveJog::JogBackward>("JogBackward", Unit::kNone, kAny, "TRUE: move in negative direction"),
           in<&MC_MoveJog::Velocity>("Velocity", Unit::kVelocity, kFinite,
                                     "velocity; of a negative value the amount counts",
                                     {.error = ErrorId::velocity}),
           pin::acceleration<MC_MoveJog>(), pin::deceleration<MC_MoveJog>(), pin::jerk<MC_MoveJog>(),
           pin::position_controlled<MC_MoveJog>(),
           out<&MC_MoveJog::InVelocity>("InVelocity", "the velocity is reached and held"),
           out<&MC_MoveJog::Busy>("Busy", "the job is in process, until standstill after release"),
           out<&MC_MoveJog::CommandAborted>("CommandAborted", "another job or disabling has ended the job"),
           out<&MC_MoveJog::Error>("Error", "the job was rejected or has failed; ErrorID tells why"),
           out<&MC_MoveJog::ErrorID>("ErrorID", "identifier of the error"));

 private:
  ErrorId check() const noexcept;
  void update(int direction) noexcept;
  void brake(ErrorId error) noexcept;

  Job job_{};
  ErrorId error_ = ErrorId::none;
  bool released_ = true;  // both inputs have been FALSE since the last job ended
  bool aborted_ = false;
};

}  // namespace lockstep
