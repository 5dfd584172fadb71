/// Desynchronizing: MC_GearOut and MC_CamOut.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// Ends synchronous operation: an active job is left so that the following axis comes to rest at a given
/// position; a waiting one is cancelled.
struct SyncOutBlock : ExecuteBlock {
  Axis* Slave{};
  LREAL SlavePosition{};
  DINT SyncProfileReference = 1;
  LREAL MasterStopDistance{};
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT SyncOutDirection = 3;
  BOOL StartSyncOut{};

  static constexpr Choice kProfiles[] = {
      {0, "with dynamic parameters"}, {1, "over leading value distance"}, {5, "only cancel a waiting job"}};
  static constexpr Choice kDirections[] = {{1, "while the following axis moves in positive direction"},
                                           {2, "while the following axis moves in negative direction"},
                                           {3, "in the current direction of the following axis"}};
  static bool over_time(const Block& block) noexcept {
    return chooses(static_cast<const SyncOutBlock&>(block).SyncProfileReference,
                   SyncOutProfileReference::dynamics);
  }
  static bool over_distance(const Block& block) noexcept {
    return chooses(static_cast<const SyncOutBlock&>(block).SyncProfileReference,
                   SyncOutProfileReference::over_distance);
  }
  static bool leaves(const Block& block) noexcept { return over_time(block) || over_distance(block); }

  static constexpr auto kPins =
      pins(object<&SyncOutBlock::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
           in<&SyncOutBlock::SlavePosition>("SlavePosition", Unit::kPosition, kPositions, "stop position",
                                            {.error = ErrorId::slave_position}),
           in<&SyncOutBlock::SyncProfileReference>(
               "SyncProfileReference", Unit::kNone, kAny, "way of desynchronizing",
               {.error = ErrorId::sync_profile_reference, .choices = kProfiles}),
           in<&SyncOutBlock::MasterStopDistance>(
               "MasterStopDistance", Unit::kLeading, kPositive,
               "profile 1: leading distance over which the axis comes to rest, > 0",
               {.error = ErrorId::leading_distance, .relevant = &over_distance}),
           pin::deceleration<SyncOutBlock>({.error = ErrorId::deceleration, .relevant = &over_time}),
           pin::jerk<SyncOutBlock>({.error = ErrorId::jerk, .relevant = &over_time}),
           in<&SyncOutBlock::SyncOutDirection>(
               "SyncOutDirection", Unit::kNone, kAny, "direction of desynchronizing",
               {.error = ErrorId::direction, .choices = kDirections, .relevant = &leaves}),
           out<&SyncOutBlock::StartSyncOut>("StartSyncOut", "the following axis is being desynchronized"),
           pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept final { return kPins; }
  void request(Job& job) const noexcept final;
  Axis* target() const noexcept final { return Slave; }
  void show(JobPhase phase) noexcept final { StartSyncOut = phase == JobPhase::active; }

  /// MC_GearOut or MC_CamOut.
  virtual JobKind kind() const noexcept = 0;
};

/// Leaves a gear.
/// @source S7-1500T synchronous operation V7, 12.1.10; 6.2.6
/// @errors 16#8077 no gear runs or waits; 16#8079 MC_GearInVelocity active; 16#8076 simulated;
///         16#800F not enabled or MC_Stop active
struct MC_GearOut final : SyncOutBlock {
  static constexpr std::string_view kName = "MC_GearOut";
  static constexpr std::string_view kText =
      "Leaves a gear so that the axis comes to rest at a given position.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.10";

 protected:
  JobKind kind() const noexcept override { return JobKind::MC_GearOut; }
};

/// Leaves a cam.
/// @source S7-1500T synchronous operation V7, 12.1.11; 8.13
/// @errors 16#8078 no cam runs or waits; 16#8079 MC_GearInVelocity active; 16#8076 simulated;
///         16#800F not enabled or MC_Stop active
struct MC_CamOut final : SyncOutBlock {
  static constexpr std::string_view kName = "MC_CamOut";
  static constexpr std::string_view kText =
      "Leaves a cam so that the axis comes to rest at a given position.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.11";

 protected:
  JobKind kind() const noexcept override { return JobKind::MC_CamOut; }
};

}  // namespace lockstep
