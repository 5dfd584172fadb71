/// Following value offset: MC_OffsetRelative and MC_OffsetAbsolute.
#pragma once

#include "fb/execute_block.hpp"
#include "fb/shift_pins.hpp"

namespace lockstep {

/// Offsets the following value of a synchronous following axis on top of the offset in effect.
/// @source S7-1500T synchronous operation V7, 12.1.6; 6.2.5
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A phasing runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_OffsetRelative final : ExecuteBlock {
  Axis* Slave{};
  LREAL Offset{};
  DINT ProfileReference = 1;
  LREAL OffsetDistance{};
  LREAL StartPosition{};
  DINT Direction = 3;
  LREAL CoveredOffset{};
  BOOL StartOffset{};

  static constexpr std::string_view kName = "MC_OffsetRelative";
  static constexpr std::string_view kText =
      "Offsets the following value of a synchronous following axis relatively.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.6";
  static bool over_distance(const Block& block) noexcept {
    return shift_pins::over_distance(static_cast<const MC_OffsetRelative&>(block).ProfileReference);
  }
  static bool from_position(const Block& block) noexcept {
    return static_cast<const MC_OffsetRelative&>(block).ProfileReference == 2;
  }
  static constexpr auto kPins = pins(
      object<&MC_OffsetRelative::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_OffsetRelative::Offset>("Offset", Unit::kPosition, kFinite, "offset to add",
                                     {.error = ErrorId::offset}),
      in<&MC_OffsetRelative::ProfileReference>(
          "ProfileReference", Unit::kNone, kAny, "way of offsetting",
          {.error = ErrorId::profile_reference, .choices = shift_pins::kOffsetProfiles}),
      in<&MC_OffsetRelative::OffsetDistance>(
          "OffsetDistance", Unit::kLeading, shift_pins::kPositive,
          "profiles 1, 2: leading distance over which the offset is made, > 0",
          {.error = ErrorId::offset_distance, .relevant = &over_distance}),
      in<&MC_OffsetRelative::StartPosition>("StartPosition", Unit::kLeading, kFinite,
                                            "profile 2: leading position from which the offset is made",
                                            {.error = ErrorId::start_position, .relevant = &from_position}),
      in<&MC_OffsetRelative::Direction>(
          "Direction", Unit::kNone, kAny, "profiles 1, 2: direction of the leading value",
          {.error = ErrorId::direction, .choices = shift_pins::kDirections, .relevant = &over_distance}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_OffsetRelative::CoveredOffset>(
          "CoveredOffset", "share of the offset made since the start of the job", Unit::kPosition),
      out<&MC_OffsetRelative::StartOffset>("StartOffset", "the following value is being offset"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override;
};

/// Offsets the following value of a synchronous following axis to an absolute offset.
/// @source S7-1500T synchronous operation V7, 12.1.7; 6.2.5
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A phasing runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_OffsetAbsolute final : ExecuteBlock {
  Axis* Slave{};
  LREAL Offset{};
  DINT ProfileReference = 1;
  LREAL OffsetDistance{};
  LREAL StartPosition{};
  DINT Direction = 3;
  LREAL AbsoluteOffset{};
  BOOL StartOffset{};

  static constexpr std::string_view kName = "MC_OffsetAbsolute";
  static constexpr std::string_view kText =
      "Offsets the following value of a synchronous following axis absolutely.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.7";
  static bool over_distance(const Block& block) noexcept {
    return shift_pins::over_distance(static_cast<const MC_OffsetAbsolute&>(block).ProfileReference);
  }
  static bool from_position(const Block& block) noexcept {
    return static_cast<const MC_OffsetAbsolute&>(block).ProfileReference == 2;
  }
  static constexpr auto kPins = pins(
      object<&MC_OffsetAbsolute::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_OffsetAbsolute::Offset>("Offset", Unit::kPosition, kFinite, "offset to reach",
                                     {.error = ErrorId::offset}),
      in<&MC_OffsetAbsolute::ProfileReference>(
          "ProfileReference", Unit::kNone, kAny, "way of offsetting",
          {.error = ErrorId::profile_reference, .choices = shift_pins::kOffsetProfiles}),
      in<&MC_OffsetAbsolute::OffsetDistance>(
          "OffsetDistance", Unit::kLeading, shift_pins::kPositive,
          "profiles 1, 2: leading distance over which the offset is made, > 0",
          {.error = ErrorId::offset_distance, .relevant = &over_distance}),
      in<&MC_OffsetAbsolute::StartPosition>("StartPosition", Unit::kLeading, kFinite,
                                            "profile 2: leading position from which the offset is made",
                                            {.error = ErrorId::start_position, .relevant = &from_position}),
      in<&MC_OffsetAbsolute::Direction>(
          "Direction", Unit::kNone, kAny, "profiles 1, 2: direction of the leading value",
          {.error = ErrorId::direction, .choices = shift_pins::kDirections, .relevant = &over_distance}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_OffsetAbsolute::AbsoluteOffset>("AbsoluteOffset", "offset reached", Unit::kPosition),
      out<&MC_OffsetAbsolute::StartOffset>("StartOffset", "the following value is being offset"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
