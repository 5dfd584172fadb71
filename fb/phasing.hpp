/// Leading value offset: MC_PhasingRelative and MC_PhasingAbsolute.
#pragma once

#include "fb/execute_block.hpp"
#include "fb/shift_pins.hpp"

namespace lockstep {

/// Offsets the leading value of a synchronous following axis on top of the offset in effect.
/// @source S7-1500T synchronous operation V7, 12.1.4; 6.2.4
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A an offset runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_PhasingRelative final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  LREAL PhaseShift{};
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT ProfileReference{};
  LREAL PhasingDistance{};
  LREAL StartPosition{};
  DINT Direction = 3;
  LREAL CoveredPhaseShift{};
  BOOL StartPhasing{};

  static constexpr std::string_view kName = "MC_PhasingRelative";
  static constexpr std::string_view kText =
      "Offsets the leading value of a synchronous following axis relatively.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.4";
  static bool over_distance(const Block& block) noexcept {
    return shift_pins::over_distance(static_cast<const MC_PhasingRelative&>(block).ProfileReference);
  }
  static bool from_position(const Block& block) noexcept {
    return static_cast<const MC_PhasingRelative&>(block).ProfileReference == 2;
  }
  static bool over_time(const Block& block) noexcept {
    return static_cast<const MC_PhasingRelative&>(block).ProfileReference == 0;
  }
  static constexpr auto kPins = pins(
      object<&MC_PhasingRelative::Master>("Master", kLeading, "leading axis"),
      object<&MC_PhasingRelative::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_PhasingRelative::PhaseShift>("PhaseShift", Unit::kLeading, kFinite, "offset to add",
                                          {.error = ErrorId::phase_shift}),
      pin::velocity<MC_PhasingRelative>(
          "profile 0: velocity of the following axis for the offset; < 0: default",
          {.error = ErrorId::velocity, .relevant = &over_time}),
      pin::acceleration<MC_PhasingRelative>({.error = ErrorId::acceleration, .relevant = &over_time}),
      pin::deceleration<MC_PhasingRelative>({.error = ErrorId::deceleration, .relevant = &over_time}),
      pin::jerk<MC_PhasingRelative>({.error = ErrorId::jerk, .relevant = &over_time}),
      in<&MC_PhasingRelative::ProfileReference>(
          "ProfileReference", Unit::kNone, kAny, "way of offsetting",
          {.error = ErrorId::profile_reference, .choices = shift_pins::kPhasingProfiles}),
      in<&MC_PhasingRelative::PhasingDistance>(
          "PhasingDistance", Unit::kLeading, shift_pins::kPositive,
          "profiles 1, 2: leading distance over which the offset is made, > 0",
          {.error = ErrorId::phasing_distance, .relevant = &over_distance}),
      in<&MC_PhasingRelative::StartPosition>("StartPosition", Unit::kLeading, kFinite,
                                             "profile 2: leading position from which the offset is made",
                                             {.error = ErrorId::start_position, .relevant = &from_position}),
      in<&MC_PhasingRelative::Direction>(
          "Direction", Unit::kNone, kAny, "profiles 1, 2: direction of the leading value",
          {.error = ErrorId::direction, .choices = shift_pins::kDirections, .relevant = &over_distance}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_PhasingRelative::CoveredPhaseShift>(
          "CoveredPhaseShift", "share of the offset made since the start of the job", Unit::kLeading),
      out<&MC_PhasingRelative::StartPhasing>("StartPhasing", "the leading value is being offset"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override;
};

/// Offsets the leading value of a synchronous following axis to an absolute offset.
/// @source S7-1500T synchronous operation V7, 12.1.5; 6.2.4
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A an offset runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_PhasingAbsolute final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  LREAL PhaseShift{};
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT ProfileReference{};
  LREAL PhasingDistance{};
  LREAL StartPosition{};
  DINT Direction = 3;
  LREAL AbsolutePhaseShift{};
  BOOL StartPhasing{};

  static constexpr std::string_view kName = "MC_PhasingAbsolute";
  static constexpr std::string_view kText =
      "Offsets the leading value of a synchronous following axis absolutely.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.5";
  static bool over_distance(const Block& block) noexcept {
    return shift_pins::over_distance(static_cast<const MC_PhasingAbsolute&>(block).ProfileReference);
  }
  static bool from_position(const Block& block) noexcept {
    return static_cast<const MC_PhasingAbsolute&>(block).ProfileReference == 2;
  }
  static bool over_time(const Block& block) noexcept {
    return static_cast<const MC_PhasingAbsolute&>(block).ProfileReference == 0;
  }
  static constexpr auto kPins = pins(
      object<&MC_PhasingAbsolute::Master>("Master", kLeading, "leading axis"),
      object<&MC_PhasingAbsolute::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_PhasingAbsolute::PhaseShift>("PhaseShift", Unit::kLeading, kFinite, "offset to reach",
                                          {.error = ErrorId::phase_shift}),
      pin::velocity<MC_PhasingAbsolute>(
          "profile 0: velocity of the following axis for the offset; < 0: default",
          {.error = ErrorId::velocity, .relevant = &over_time}),
      pin::acceleration<MC_PhasingAbsolute>({.error = ErrorId::acceleration, .relevant = &over_time}),
      pin::deceleration<MC_PhasingAbsolute>({.error = ErrorId::deceleration, .relevant = &over_time}),
      pin::jerk<MC_PhasingAbsolute>({.error = ErrorId::jerk, .relevant = &over_time}),
      in<&MC_PhasingAbsolute::ProfileReference>(
          "ProfileReference", Unit::kNone, kAny, "way of offsetting",
          {.error = ErrorId::profile_reference, .choices = shift_pins::kPhasingProfiles}),
      in<&MC_PhasingAbsolute::PhasingDistance>(
          "PhasingDistance", Unit::kLeading, shift_pins::kPositive,
          "profiles 1, 2: leading distance over which the offset is made, > 0",
          {.error = ErrorId::phasing_distance, .relevant = &over_distance}),
      in<&MC_PhasingAbsolute::StartPosition>("StartPosition", Unit::kLeading, kFinite,
                                             "profile 2: leading position from which the offset is made",
                                             {.error = ErrorId::start_position, .relevant = &from_position}),
      in<&MC_PhasingAbsolute::Direction>(
          "Direction", Unit::kNone, kAny, "profiles 1, 2: direction of the leading value",
          {.error = ErrorId::direction, .choices = shift_pins::kDirections, .relevant = &over_distance}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_PhasingAbsolute::AbsolutePhaseShift>("AbsolutePhaseShift", "offset reached", Unit::kLeading),
      out<&MC_PhasingAbsolute::StartPhasing>("StartPhasing", "the leading value is being offset"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
