/// Enabling and resetting technology objects: MC_Power and MC_Reset.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Enables or disables an axis or encoder. One instance per object.
/// @source S7-1500T axis functions, MC_Power
/// @errors 16#800A StartMode; 16#800B StopMode; 16#800C a second instance; 16#8001 while an alarm has removed
/// the enable
struct MC_Power final : Block {
  LeadingObject* Axis{};
  BOOL Enable{};
  DINT StartMode = 1;
  INT StopMode{};
  BOOL Status{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_Power";
  static constexpr std::string_view kText = "Enables or disables an axis or an external encoder.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Power";
  static constexpr Choice kStartModes[] = {{0, "without position control"}, {1, "with position control"}};
  static constexpr Choice kStopModes[] = {{0, "emergency stop ramp: DynamicDefaults.EmergencyDeceleration"},
                                          {1, "quick stop: speed setpoint 0, ramp of the drive"},
                                          {2, "maximum dynamics: DynamicLimits.MaxDeceleration and MaxJerk"},
                                          {3, "coast down"}};
  static constexpr auto kPins =
      pins(object<&MC_Power::Axis>("Axis", kPowered, "axis or encoder that is enabled"),
           in<&MC_Power::Enable>("Enable", Unit::kNone, kAny, "TRUE: enable; FALSE: stop and disable"),
           in<&MC_Power::StartMode>("StartMode", Unit::kNone, kAny, "control mode taken at enabling",
                                    {.error = ErrorId::mode, .choices = kStartModes}),
           in<&MC_Power::StopMode>("StopMode", Unit::kNone, kAny, "how a moving axis stops when Enable falls",
                                   {.error = ErrorId::stop_mode, .choices = kStopModes}),
           out<&MC_Power::Status>("Status", "the axis is enabled and takes jobs"),
           out<&MC_Power::Busy>("Busy", "the job is in process, until the axis is disabled completely"),
           out<&MC_Power::Error>("Error", "the job was rejected, or an alarm has removed the enable"),
           out<&MC_Power::ErrorID>("ErrorID", "identifier of the error"));

 private:
  struct Modes {
    DINT start;
    INT stop;
    bool operator==(const Modes&) const = default;
  };

  /// Whether the inputs are those that the table of pins has permitted, and the object is this instance's.
  bool in_charge() const noexcept;
  ErrorId take_charge() noexcept;
  void call_without_charge() noexcept;

  Modes permitted_{-1, -1};  // looked up again only when they change
};

/// Acknowledges technology alarms, or restarts a technology object.
/// @source S7-1500T axis functions, MC_Reset
/// @errors 16#800E restart of an enabled axis; restart of a cam: 16#80AB in use, 16#80E7 being copied into,
/// 16#80E8
///         being interpolated, 16#800D restarting already, 16#80AC start values that make no curve
struct MC_Reset final : ExecuteBlock {
  TechnologyObject* Axis{};
  BOOL Restart{};

  static constexpr std::string_view kName = "MC_Reset";
  static constexpr std::string_view kText = "Acknowledges alarms of a technology object, or restarts it.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Reset";
  static constexpr auto kPins = pins(
      object<&MC_Reset::Axis>("Axis", kResettable, "object that is acknowledged or restarted"), pin::kExecute,
      in<&MC_Reset::Restart>("Restart", Unit::kNone, kAny,
                             "TRUE: take over the start values anew; an axis or encoder has to be disabled, "
                             "a cam must not be in use"),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
