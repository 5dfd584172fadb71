/// Acting on the leading value of a following axis: MC_LeadingValueAdditive, MC_SynchronizedMotionSimulation.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Adds position, velocity and acceleration to the leading value that a following axis sees, without any
/// limiting. Values that are not finite show an error, and the last finite ones go on. While the axis is
/// neither enabled nor simulated they do not count; they do, without a new edge, once it is. Another instance
/// that begins and a restart of the axis end the job until Enable falls.
/// @source S7-1500T synchronous operation V7, 12.1.12; 9.2
/// @errors 16#800F not enabled and not simulated, as long as that lasts
struct MC_LeadingValueAdditive final : Block {
  lockstep::Axis* Axis{};
  BOOL Enable{};
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_LeadingValueAdditive";
  static constexpr std::string_view kText = "Adds values to the leading value that a following axis sees.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.12";
  static constexpr auto kPins = pins(
      object<&MC_LeadingValueAdditive::Axis>("Axis", kSynchronousAxis, "following axis"),
      in<&MC_LeadingValueAdditive::Enable>("Enable", Unit::kNone, kAny, "TRUE: the values count"),
      in<&MC_LeadingValueAdditive::Position>("Position", Unit::kLeading, kFinite, "additive position",
                                             {.error = ErrorId::position}),
      in<&MC_LeadingValueAdditive::Velocity>("Velocity", Unit::kVelocity, kFinite, "additive velocity",
                                             {.error = ErrorId::velocity}),
      in<&MC_LeadingValueAdditive::Acceleration>("Acceleration", Unit::kAcceleration, kFinite,
                                                 "additive acceleration", {.error = ErrorId::acceleration}),
      out<&MC_LeadingValueAdditive::Busy>("Busy", "the values count"),
      out<&MC_LeadingValueAdditive::Error>("Error", "the job was rejected, or a value is not permitted"),
      out<&MC_LeadingValueAdditive::ErrorID>("ErrorID", "identifier of the error"));

 private:
  ErrorId act_on(AdditiveRequest& request, ErrorId error) noexcept;

  bool begun_ = false;
};

/// Keeps a synchronous motion alive without the axis, so that it can be moved or disabled meanwhile.
/// @source S7-1500T synchronous operation V7, 12.1.9; 9.1
/// @errors 16#8075 not synchronous, or the leading axis moves; at the end 16#8009 the setpoints do not agree,
///         16#800F not enabled or MC_Stop active
struct MC_SynchronizedMotionSimulation final : Block {
  Axis* Slave{};
  BOOL Enable{};
  BOOL InSimulation{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_SynchronizedMotionSimulation";
  static constexpr std::string_view kText =
      "Keeps a synchronous motion alive while the axis is moved or disabled.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.9";
  static constexpr auto kPins =
      pins(object<&MC_SynchronizedMotionSimulation::Slave>("Slave", kSynchronousAxis, "following axis"),
           in<&MC_SynchronizedMotionSimulation::Enable>(
               "Enable", Unit::kNone, kAny, "TRUE: simulate; FALSE: the setpoints of the gear count again"),
           out<&MC_SynchronizedMotionSimulation::InSimulation>("InSimulation",
                                                               "the synchronous motion is simulated"),
           out<&MC_SynchronizedMotionSimulation::Busy>("Busy", "the job is in process"),
           out<&MC_SynchronizedMotionSimulation::Error>("Error", "the simulation cannot begin or end"),
           out<&MC_SynchronizedMotionSimulation::ErrorID>("ErrorID", "identifier of the error"));
};

}  // namespace lockstep
