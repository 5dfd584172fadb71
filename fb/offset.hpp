/// Following value offset: MC_OffsetRelative and MC_OffsetAbsolute.
#pragma once

#include "fb/execute_block.hpp"
#include "fb/shift_pins.hpp"

namespace lockstep {

/// Offsets the following value of a synchronous following axis.
struct OffsetBlock : ExecuteBlock {
  Axis* Slave{};
  LREAL Offset{};
  DINT ProfileReference = 1;
  LREAL OffsetDistance{};
  LREAL StartPosition{};
  DINT Direction = 3;
  BOOL StartOffset{};

  static constexpr auto offset_pins(std::string_view meaning, Pin covered) {
    return pins(
        object<&OffsetBlock::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
        in<&OffsetBlock::Offset>("Offset", Unit::kPosition, kFinite, meaning, {.error = ErrorId::offset}),
        shift_pins::profile<OffsetBlock>(shift_pins::kOffsetProfiles),
        shift_pins::distance<&OffsetBlock::OffsetDistance>("OffsetDistance", ErrorId::offset_distance),
        shift_pins::start_position<OffsetBlock>(), shift_pins::direction<OffsetBlock>(), pin::kDone,
        pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID, covered,
        out<&OffsetBlock::StartOffset>("StartOffset", "the following value is being offset"));
  }

 protected:
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept final { return Slave; }
  void show(JobPhase phase) noexcept override { StartOffset = phase == JobPhase::active; }
};

/// Adds an offset to the one in effect.
/// @source S7-1500T synchronous operation V7, 12.1.6; 6.2.5
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A phasing runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_OffsetRelative final : OffsetBlock {
  LREAL CoveredOffset{};

  static constexpr std::string_view kName = "MC_OffsetRelative";
  static constexpr std::string_view kText =
      "Offsets the following value of a synchronous following axis relatively.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.6";
  static constexpr auto kPins = offset_pins(
      "offset to add",
      lockstep::out<&MC_OffsetRelative::CoveredOffset>(
          "CoveredOffset", "share of the offset made since the start of the job", Unit::kPosition));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void show(JobPhase phase) noexcept override;
};

/// Takes the offset to an absolute one.
/// @source S7-1500T synchronous operation V7, 12.1.7; 6.2.5
/// @errors 16#80A9 not synchronous; 16#8079 MC_GearInVelocity active; 16#808A phasing runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_OffsetAbsolute final : OffsetBlock {
  LREAL AbsoluteOffset{};

  static constexpr std::string_view kName = "MC_OffsetAbsolute";
  static constexpr std::string_view kText =
      "Offsets the following value of a synchronous following axis absolutely.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.7";
  static constexpr auto kPins = offset_pins(
      "offset to reach",
      lockstep::out<&MC_OffsetAbsolute::AbsoluteOffset>("AbsoluteOffset", "offset reached", Unit::kPosition));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
