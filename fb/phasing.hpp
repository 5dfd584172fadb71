/// Leading value offset: MC_PhasingRelative and MC_PhasingAbsolute.
#pragma once

#include "fb/execute_block.hpp"
#include "fb/shift_pins.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// Offsets the leading value of a synchronous following axis.
struct PhasingBlock : ExecuteBlock {
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
  BOOL StartPhasing{};

  static bool over_time(const Block& block) noexcept {
    return chooses(static_cast<const PhasingBlock&>(block).ProfileReference, ShiftProfileReference::dynamics);
  }
  static constexpr auto phasing_pins(std::string_view meaning, Pin covered) {
    return pins(
        object<&PhasingBlock::Master>("Master", kLeading, "leading axis"),
        object<&PhasingBlock::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
        in<&PhasingBlock::PhaseShift>("PhaseShift", Unit::kLeading, kFinite, meaning,
                                      {.error = ErrorId::phase_shift}),
        pin::velocity<PhasingBlock>("profile 0: velocity of the following axis for the offset; < 0: default",
                                    {.error = ErrorId::velocity, .relevant = &over_time}),
        pin::acceleration<PhasingBlock>({.error = ErrorId::acceleration, .relevant = &over_time}),
        pin::deceleration<PhasingBlock>({.error = ErrorId::deceleration, .relevant = &over_time}),
        pin::jerk<PhasingBlock>({.error = ErrorId::jerk, .relevant = &over_time}),
        shift_pins::profile<PhasingBlock>(shift_pins::kPhasingProfiles),
        shift_pins::distance<&PhasingBlock::PhasingDistance>("PhasingDistance", ErrorId::phasing_distance),
        shift_pins::start_position<PhasingBlock>(), shift_pins::direction<PhasingBlock>(), pin::kDone,
        pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID, covered,
        out<&PhasingBlock::StartPhasing>("StartPhasing", "the leading value is being offset"));
  }

 protected:
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept final { return Slave; }
  void show(JobPhase phase) noexcept override { StartPhasing = phase == JobPhase::active; }
};

/// Adds an offset to the one in effect.
/// @source S7-1500T synchronous operation V7, 12.1.4; 6.2.4
/// @errors 16#80A9 not synchronous, or not with Master; 16#8001 and alarm 601 Master is not interconnected;
///         16#8079 MC_GearInVelocity active; 16#808A an offset runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_PhasingRelative final : PhasingBlock {
  LREAL CoveredPhaseShift{};

  static constexpr std::string_view kName = "MC_PhasingRelative";
  static constexpr std::string_view kText =
      "Offsets the leading value of a synchronous following axis relatively.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.4";
  static constexpr auto kPins = phasing_pins(
      "offset to add",
      lockstep::out<&MC_PhasingRelative::CoveredPhaseShift>(
          "CoveredPhaseShift", "share of the offset made since the start of the job", Unit::kLeading));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void show(JobPhase phase) noexcept override;
};

/// Takes the offset to an absolute one.
/// @source S7-1500T synchronous operation V7, 12.1.5; 6.2.4
/// @errors 16#80A9 not synchronous, or not with Master; 16#8001 and alarm 601 Master is not interconnected;
///         16#8079 MC_GearInVelocity active; 16#808A an offset runs or waits;
///         16#808C the leading value has reversed; 16#8076 simulated; 16#800F not enabled or MC_Stop active
struct MC_PhasingAbsolute final : PhasingBlock {
  LREAL AbsolutePhaseShift{};

  static constexpr std::string_view kName = "MC_PhasingAbsolute";
  static constexpr std::string_view kText =
      "Offsets the leading value of a synchronous following axis absolutely.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.5";
  static constexpr auto kPins =
      phasing_pins("offset to reach", lockstep::out<&MC_PhasingAbsolute::AbsolutePhaseShift>(
                                          "AbsolutePhaseShift", "offset reached", Unit::kLeading));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
