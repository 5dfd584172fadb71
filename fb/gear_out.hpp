/// Desynchronizing: MC_GearOut.
#pragma once

#include <limits>

#include "fb/execute_block.hpp"

namespace lockstep {

/// Ends gearing: an active gear is left so that the following axis comes to rest at a given position; a
/// waiting one is cancelled.
/// @source S7-1500T synchronous operation V7, 12.1.10; 6.2.6
/// @errors 16#8077 no gear runs or waits; 16#8079 MC_GearInVelocity active; 16#8076 simulated;
///         16#800F not enabled or MC_Stop active
struct MC_GearOut final : ExecuteBlock {
  Axis* Slave{};
  LREAL SlavePosition{};
  DINT SyncProfileReference = 1;
  LREAL MasterStopDistance{};
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT SyncOutDirection = 3;
  BOOL StartSyncOut{};

  static constexpr std::string_view kName = "MC_GearOut";
  static constexpr std::string_view kText =
      "Leaves a gear so that the axis comes to rest at a given position.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.10";
  static constexpr Choice kProfiles[] = {
      {0, "with dynamic parameters"}, {1, "over leading value distance"}, {5, "only cancel waiting gearing"}};
  static constexpr Choice kDirections[] = {{1, "while the following axis moves in positive direction"},
                                           {2, "while the following axis moves in negative direction"},
                                           {3, "in the current direction of the following axis"}};
  static bool over_time(const Block& block) noexcept {
    return static_cast<const MC_GearOut&>(block).SyncProfileReference == 0;
  }
  static bool over_distance(const Block& block) noexcept {
    return static_cast<const MC_GearOut&>(block).SyncProfileReference == 1;
  }
  static bool leaves(const Block& block) noexcept { return over_time(block) || over_distance(block); }

  static constexpr auto kPins =
      pins(object<&MC_GearOut::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
           in<&MC_GearOut::SlavePosition>("SlavePosition", Unit::kPosition, kFinite, "stop position",
                                          {.error = ErrorId::slave_position}),
           in<&MC_GearOut::SyncProfileReference>(
               "SyncProfileReference", Unit::kNone, kAny, "way of desynchronizing",
               {.error = ErrorId::sync_profile_reference, .choices = kProfiles}),
           in<&MC_GearOut::MasterStopDistance>(
               "MasterStopDistance", Unit::kLeading, {std::numeric_limits<double>::min(), kFinite.highest},
               "profile 1: leading distance over which the axis comes to rest, > 0",
               {.error = ErrorId::leading_distance, .relevant = &over_distance}),
           pin::deceleration<MC_GearOut>({.error = ErrorId::deceleration, .relevant = &over_time}),
           pin::jerk<MC_GearOut>({.error = ErrorId::jerk, .relevant = &over_time}),
           in<&MC_GearOut::SyncOutDirection>(
               "SyncOutDirection", Unit::kNone, kAny, "direction of desynchronizing",
               {.error = ErrorId::direction, .choices = kDirections, .relevant = &leaves}),
           out<&MC_GearOut::StartSyncOut>("StartSyncOut", "the following axis is being desynchronized"),
           pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override { StartSyncOut = phase == JobPhase::active; }
};

}  // namespace lockstep
