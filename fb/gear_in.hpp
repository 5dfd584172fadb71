/// Gearing: MC_GearIn and MC_GearInPos.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// Couples a following axis to a leading axis with a fixed ratio, without given synchronous positions.
/// @source S7-1500T synchronous operation V7, 12.1.1; 6.1
/// @errors 16#8017, 16#8018 ratio; 16#8019 recursive coupling; 16#800F not enabled or MC_Stop active
struct MC_GearIn final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  DINT RatioNumerator = 1;
  DINT RatioDenominator = 1;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL InGear{};

  static constexpr std::string_view kName = "MC_GearIn";
  static constexpr std::string_view kText = "Couples a following axis to a leading axis with a gear ratio.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.1";
  static constexpr auto kPins = pins(
      object<&MC_GearIn::Master>("Master", kLeading, "leading axis"),
      object<&MC_GearIn::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_GearIn::RatioNumerator>("RatioNumerator", Unit::kNone, {-2147483648.0, 2147483647.0, 0.0},
                                     "numerator of the ratio; its sign gives the direction",
                                     {.error = ErrorId::ratio_numerator}),
      in<&MC_GearIn::RatioDenominator>("RatioDenominator", Unit::kNone, {1.0, 2147483647.0},
                                       "denominator of the ratio", {.error = ErrorId::ratio_denominator}),
      pin::acceleration<MC_GearIn>(), pin::deceleration<MC_GearIn>(), pin::jerk<MC_GearIn>(),
      out<&MC_GearIn::InGear>("InGear", "the following axis moves synchronously"), pin::kBusy,
      pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override { InGear = phase == JobPhase::reached; }
};

/// Couples a following axis to a leading axis with a fixed ratio and given synchronous positions.
/// @source S7-1500T synchronous operation V7, 12.1.2; 6.2
/// @errors 16#8017, 16#8018 ratio; 16#8034, 16#8035 synchronous positions; 16#8036 SyncProfileReference;
///         16#8026 MasterStartDistance; 16#8007 SyncDirection; 16#8019 recursive coupling;
///         16#800F not enabled or MC_Stop active; following axis not homed: technology alarm 321, 16#8001
struct MC_GearInPos final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  DINT RatioNumerator = 1;
  DINT RatioDenominator = 1;
  LREAL MasterSyncPosition{};
  LREAL SlaveSyncPosition{};
  DINT SyncProfileReference = 1;
  LREAL MasterStartDistance = 1.0;
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT SyncDirection = 3;
  BOOL StartSync{};
  BOOL InSync{};

  static constexpr std::string_view kName = "MC_GearInPos";
  static constexpr std::string_view kText =
      "Couples a following axis to a leading axis with a gear ratio and given synchronous positions.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.2";
  static constexpr Choice kProfiles[] = {{0, "in advance, with dynamic parameters"},
                                         {1, "in advance, over leading value distance"},
                                         {3, "subsequently, over leading value distance"}};
  static constexpr Choice kDirections[] = {
      {1, "positive direction"}, {2, "negative direction"}, {3, "shortest way"}};
  static bool over_time(const Block& block) noexcept {
    return chooses(static_cast<const MC_GearInPos&>(block).SyncProfileReference,
                   lockstep::SyncProfileReference::dynamics);
  }
  static bool over_distance(const Block& block) noexcept { return !over_time(block); }
  static bool following_modulo(const Block& block) noexcept;

  static constexpr auto kPins = pins(
      object<&MC_GearInPos::Master>("Master", kLeading, "leading axis"),
      object<&MC_GearInPos::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_GearInPos::RatioNumerator>("RatioNumerator", Unit::kNone, {-2147483648.0, 2147483647.0, 0.0},
                                        "numerator of the ratio; its sign gives the direction",
                                        {.error = ErrorId::ratio_numerator}),
      in<&MC_GearInPos::RatioDenominator>("RatioDenominator", Unit::kNone, {1.0, 2147483647.0},
                                          "denominator of the ratio", {.error = ErrorId::ratio_denominator}),
      in<&MC_GearInPos::MasterSyncPosition>(
          "MasterSyncPosition", Unit::kLeading, kFinite,
          "profiles 0, 1: leading position from which both run synchronously; 3: where synchronizing begins",
          {.error = ErrorId::master_sync_position}),
      in<&MC_GearInPos::SlaveSyncPosition>("SlaveSyncPosition", Unit::kPosition, kPositions,
                                           "following position that belongs to MasterSyncPosition",
                                           {.error = ErrorId::slave_sync_position}),
      in<&MC_GearInPos::SyncProfileReference>(
          "SyncProfileReference", Unit::kNone, kAny, "way of synchronizing",
          {.error = ErrorId::sync_profile_reference, .choices = kProfiles}),
      in<&MC_GearInPos::MasterStartDistance>(
          "MasterStartDistance", Unit::kLeading, kPositive,
          "profiles 1, 3: leading distance over which the axis is synchronized, > 0; with 1 the leading axis "
          "has to be farther than that from MasterSyncPosition when the job begins",
          {.error = ErrorId::leading_distance, .relevant = &over_distance}),
      pin::velocity<MC_GearInPos>(
          "profile 0: velocity of the following axis while synchronizing, above the synchronous one; < 0: "
          "default",
          {.error = ErrorId::velocity, .relevant = &over_time}),
      pin::acceleration<MC_GearInPos>({.error = ErrorId::acceleration, .relevant = &over_time}),
      pin::deceleration<MC_GearInPos>({.error = ErrorId::deceleration, .relevant = &over_time}),
      pin::jerk<MC_GearInPos>({.error = ErrorId::jerk, .relevant = &over_time}),
      in<&MC_GearInPos::SyncDirection>(
          "SyncDirection", Unit::kNone, kAny, "way of a modulo following axis while synchronizing",
          {.error = ErrorId::direction, .choices = kDirections, .relevant = &following_modulo}),
      out<&MC_GearInPos::StartSync>("StartSync", "the following axis is being synchronized"),
      out<&MC_GearInPos::InSync>("InSync", "the following axis moves synchronously"), pin::kBusy,
      pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override {
    StartSync = phase == JobPhase::active;
    InSync = phase == JobPhase::reached;
  }
};

}  // namespace lockstep
