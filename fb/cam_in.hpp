/// Camming: MC_CamIn.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

/// Couples a following axis to a leading axis through an interpolated cam.
/// @source S7-1500T synchronous operation V7, 12.1.8; 8.4 to 8.8
/// @errors 16#8021 to 16#8024 offsets and scalings; 16#8026 MasterStartDistance; 16#8027 ApplicationMode;
///         16#8034 MasterSyncPosition; 16#8036 SyncProfileReference; 16#8007 SyncDirection; 16#8019 recursive
///         coupling; 16#8076 simulated; 16#808B profile 5 without camming; 16#80AC a cyclic cam that does not
///         close; 16#80AD synchronous position outside of the cam; 16#80E8 cam being interpolated; 16#800F
///         not enabled or MC_Stop active; cam not interpolated: technology alarm 612, 16#8001; following axis
///         not homed: technology alarm 321, 16#8001
struct MC_CamIn final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  lockstep::Cam* Cam{};
  LREAL MasterOffset{};
  LREAL SlaveOffset{};
  LREAL MasterScaling = 1.0;
  LREAL SlaveScaling = 1.0;
  LREAL MasterSyncPosition{};
  DINT SyncProfileReference = 1;
  LREAL MasterStartDistance{};
  LREAL Velocity = -1.0;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  DINT ApplicationMode{};
  DINT SyncDirection = 3;
  BOOL StartSync{};
  BOOL InSync{};
  BOOL EndOfProfile{};

  static constexpr std::string_view kName = "MC_CamIn";
  static constexpr std::string_view kText = "Couples a following axis to a leading axis through a cam.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.8";
  static constexpr Choice kProfiles[] = {
      {0, "in advance, with dynamic parameters"},
      {1, "in advance, over leading value distance"},
      {2, "directly synchronous"},
      {3, "subsequently, over leading value distance"},
      {4, "subsequently, over leading value distance from where the leading value is"},
      {5, "directly synchronous at the end of the active cam"},
      {6, "in advance, over leading value distance from where the leading value is"}};
  static constexpr Choice kModes[] = {
      {0, "once"}, {1, "cyclic"}, {2, "cyclic, each pass appended to the one before"}};
  static constexpr Choice kDirections[] = {
      {1, "positive direction"}, {2, "negative direction"}, {3, "shortest way"}};

  static DINT profile(const Block& block) noexcept {
    return static_cast<const MC_CamIn&>(block).SyncProfileReference;
  }
  static bool over_time(const Block& block) noexcept { return profile(block) == 0; }
  static bool over_distance(const Block& block) noexcept {
    const DINT reference = profile(block);
    return reference == 1 || reference == 3 || reference == 4 || reference == 6;
  }
  static bool has_master_offset(const Block& block) noexcept {
    return over_time(block) || (over_distance(block) && profile(block) != 6);
  }
  static bool has_slave_offset(const Block& block) noexcept {
    return over_time(block) || over_distance(block);
  }
  static bool has_sync_position(const Block& block) noexcept { return profile(block) != 4; }
  static bool has_direction(const Block& block) noexcept;

  static constexpr auto kPins = pins(
      object<&MC_CamIn::Master>("Master", kLeading, "leading axis"),
      object<&MC_CamIn::Slave>("Slave", kSynchronousAxis, "following axis"),
      object<&MC_CamIn::Cam>("Cam", kAnyCam, "cam that is followed"), pin::kExecute,
      in<&MC_CamIn::MasterOffset>("MasterOffset", Unit::kLeading, kFinite,
                                  "profiles 0, 1, 3, 4: shift of the leading values of the cam",
                                  {.error = ErrorId::master_offset, .relevant = &has_master_offset}),
      in<&MC_CamIn::SlaveOffset>("SlaveOffset", Unit::kPosition, kFinite,
                                 "profiles 0, 1, 3, 4, 6: shift of the following values of the cam",
                                 {.error = ErrorId::slave_offset, .relevant = &has_slave_offset}),
      in<&MC_CamIn::MasterScaling>(
          "MasterScaling", Unit::kNone, {-1e12, 1e12, 0.0},
          "scaling of the leading values of the cam; negative: the cam is passed the other way. Its amount "
          "times the length of the cam is at least 1.0E-12, with ApplicationMode 1 and 2 at least 1.0E-6",
          {.error = ErrorId::master_scaling}),
      in<&MC_CamIn::SlaveScaling>("SlaveScaling", Unit::kNone, {-1e12, 1e12},
                                  "scaling of the following values of the cam; 0: they are all 0. Scaled, "
                                  "none is beyond 1.0E12",
                                  {.error = ErrorId::slave_scaling}),
      in<&MC_CamIn::MasterSyncPosition>(
          "MasterSyncPosition", Unit::kLeading, kFinite,
          "from the start of the cam; profiles 0, 1, 6: from where both run synchronously; 3: where "
          "synchronizing begins; 2, 5: place in the cam that belongs to the positions at hand",
          {.error = ErrorId::master_sync_position, .relevant = &has_sync_position}),
      in<&MC_CamIn::SyncProfileReference>("SyncProfileReference", Unit::kNone, kAny, "way of synchronizing",
                                          {.error = ErrorId::sync_profile_reference, .choices = kProfiles}),
      in<&MC_CamIn::MasterStartDistance>(
          "MasterStartDistance", Unit::kLeading, kPositive,
          "profiles 1, 3, 4, 6: leading distance over which the axis is synchronized, > 0",
          {.error = ErrorId::leading_distance, .relevant = &over_distance}),
      pin::velocity<MC_CamIn>(
          "profile 0: velocity of the following axis while synchronizing, above the synchronous one; < 0: "
          "default",
          {.error = ErrorId::velocity, .relevant = &over_time}),
      pin::acceleration<MC_CamIn>({.error = ErrorId::acceleration, .relevant = &over_time}),
      pin::deceleration<MC_CamIn>({.error = ErrorId::deceleration, .relevant = &over_time}),
      pin::jerk<MC_CamIn>({.error = ErrorId::jerk, .relevant = &over_time}),
      in<&MC_CamIn::ApplicationMode>("ApplicationMode", Unit::kNone, kAny, "how the cam is passed",
                                     {.error = ErrorId::application_mode, .choices = kModes}),
      in<&MC_CamIn::SyncDirection>(
          "SyncDirection", Unit::kNone, kAny, "way of a modulo following axis while synchronizing",
          {.error = ErrorId::direction, .choices = kDirections, .relevant = &has_direction}),
      out<&MC_CamIn::StartSync>("StartSync", "the following axis is being synchronized"),
      out<&MC_CamIn::InSync>("InSync", "the following axis moves synchronously"), pin::kBusy,
      pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_CamIn::EndOfProfile>("EndOfProfile",
                                   "an end of the cam has been reached; in cyclic use for one call"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  bool wired() const noexcept override { return Slave != nullptr && Cam != nullptr && Master != nullptr; }
  void show(JobPhase phase) noexcept override;

 private:
  UDINT ends_{};  // of the job, as far as they have been shown
};

}  // namespace lockstep
