/// Torque and force of a drive: MC_TorqueLimiting, MC_TorqueRange, MC_TorqueAdditive.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// What the torque blocks share. A rising edge of Enable claims a function of the axis, whose inputs count in
/// every call; the falling edge lets it go. One instance per function and axis. While an input is not
/// permitted the last permitted ones go on, with Error.
class TorqueBlock : public Block {
 public:
  lockstep::Axis* Axis{};
  BOOL Enable{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept final;

 protected:
  virtual std::span<const Pin> pin_table() const noexcept = 0;
  /// The instance that has claimed the function.
  virtual const void*& owner() const noexcept = 0;
  /// Why the axis does not let the function begin.
  virtual ErrorId refusal() const noexcept = 0;
  /// Why it cannot act just now, though it goes on.
  virtual ErrorId pause() const noexcept { return ErrorId::none; }
  /// Why it cannot end.
  virtual ErrorId hold() const noexcept { return ErrorId::none; }
  /// Writes the inputs, which are permitted.
  virtual void request() const noexcept = 0;
  virtual void show(bool /*active*/) noexcept {}
  /// Inputs of which each is permitted, but not together.
  virtual ErrorId check_together() const noexcept { return ErrorId::none; }

 private:
  ErrorId check_inputs() const noexcept;
  ErrorId enabled(bool rising) noexcept;
  ErrorId disabled() noexcept;

  bool last_enable_ = false;
  ErrorId rejected_ = ErrorId::none;  // until Enable falls
};

namespace pin {

inline constexpr Range kTorques{-1e12, 1e12};
inline constexpr Pin kTorqueAxis =
    object<&TorqueBlock::Axis>("Axis", kAnyDrivenAxis, "axis on whose drive it acts");
inline constexpr Pin kTorqueEnable = in<&TorqueBlock::Enable>(
    "Enable", Unit::kNone, kAny, "TRUE: the function is on; its inputs count in every call");
inline constexpr Pin kTorqueBusy = out<&TorqueBlock::Busy>("Busy", "the function is active");
inline constexpr Pin kTorqueError =
    out<&TorqueBlock::Error>("Error", "the function was rejected, or an input is not permitted");
inline constexpr Pin kTorqueErrorID = out<&TorqueBlock::ErrorID>("ErrorID", "identifier of the error");

}  // namespace pin

/// Limits the torque of the drive (Mode 0), or detects a fixed stop as well and clamps the axis there
/// (Mode 1). It stays active through alarms while Enable is TRUE.
/// @source S7-1500T axis functions, MC_TorqueLimiting
/// @errors 16#8044 no drive; 16#804E MC_TorqueRange is active; 16#800F Mode 1 on a disabled axis; 16#800A
/// Mode 1 on a speed axis, which has no following error; 16#8046 Enable falls while the axis is clamped;
/// 16#800C a second instance
struct MC_TorqueLimiting final : TorqueBlock {
  LREAL Limit = -1.0;
  DINT Mode{};
  BOOL InClamping{};
  BOOL InLimitation{};

  static constexpr std::string_view kName = "MC_TorqueLimiting";
  static constexpr std::string_view kText = "Limits the torque of a drive, or detects a fixed stop.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_TorqueLimiting";
  static constexpr Choice kModes[] = {{0, "limiting of force or torque"},
                                      {1, "fixed stop detection, with limiting"}};
  static constexpr auto kPins =
      pins(pin::kTorqueAxis, pin::kTorqueEnable,
           in<&MC_TorqueLimiting::Limit>(
               "Limit", Unit::kTorque, kFinite,
               "≥ 0: the amount that is permitted, at motor or load by TorqueLimiting.LimitBase; < 0: "
               "TorqueLimiting.LimitDefaults",
               {.error = ErrorId::torque_limit}),
           in<&MC_TorqueLimiting::Mode>("Mode", Unit::kNone, kAny, "function",
                                        {.error = ErrorId::mode, .choices = kModes}),
           out<&MC_TorqueLimiting::InClamping>(
               "InClamping", "the axis is held at the fixed stop, within Clamping.PositionTolerance"),
           out<&MC_TorqueLimiting::InLimitation>("InLimitation",
                                                 "the drive makes at least 90 % of the permitted torque"),
           pin::kTorqueBusy, pin::kTorqueError, pin::kTorqueErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  const void*& owner() const noexcept override { return Axis->forces().limiting.owner; }
  ErrorId refusal() const noexcept override {
    return Axis->torque_limiting_refusal(static_cast<TorqueLimitingMode>(Mode));
  }
  ErrorId check_together() const noexcept override;
  ErrorId hold() const noexcept override;
  void request() const noexcept override;
  void show(bool active) noexcept override;
};

/// Gives the torque of the drive an upper and a lower limit.
/// @source S7-1500T axis functions, MC_TorqueRange
/// @errors 16#804F no torque data; 16#804E MC_TorqueLimiting is active; 16#804D UpperLimit ≤ LowerLimit;
/// 16#800C a second instance
struct MC_TorqueRange final : TorqueBlock {
  LREAL UpperLimit = 1e12;
  LREAL LowerLimit = -1e12;

  static constexpr std::string_view kName = "MC_TorqueRange";
  static constexpr std::string_view kText = "Gives the torque of a drive an upper and a lower limit.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_TorqueRange";
  static constexpr auto kPins =
      pins(pin::kTorqueAxis, pin::kTorqueEnable,
           in<&MC_TorqueRange::UpperLimit>("UpperLimit", Unit::kTorque, pin::kTorques,
                                           "highest torque of the motor, above LowerLimit",
                                           {.error = ErrorId::upper_torque_limit}),
           in<&MC_TorqueRange::LowerLimit>("LowerLimit", Unit::kTorque, pin::kTorques,
                                           "lowest torque of the motor, below UpperLimit",
                                           {.error = ErrorId::lower_torque_limit}),
           pin::kTorqueBusy, pin::kTorqueError, pin::kTorqueErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  const void*& owner() const noexcept override { return Axis->forces().range.owner; }
  ErrorId refusal() const noexcept override { return Axis->torque_range_refusal(); }
  ErrorId check_together() const noexcept override;
  void request() const noexcept override;
};

/// Adds to the torque that the drive makes; nothing while the axis is disabled.
/// @source S7-1500T axis functions, MC_TorqueAdditive
/// @errors 16#804F no torque data; 16#800F not enabled; 16#800C a second instance
struct MC_TorqueAdditive final : TorqueBlock {
  LREAL Value{};

  static constexpr std::string_view kName = "MC_TorqueAdditive";
  static constexpr std::string_view kText = "Adds to the torque that a drive makes.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_TorqueAdditive";
  static constexpr auto kPins =
      pins(pin::kTorqueAxis, pin::kTorqueEnable,
           in<&MC_TorqueAdditive::Value>("Value", Unit::kTorque, pin::kTorques, "torque of the motor, signed",
                                         {.error = ErrorId::additive_torque}),
           pin::kTorqueBusy, pin::kTorqueError, pin::kTorqueErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  const void*& owner() const noexcept override { return Axis->forces().additive.owner; }
  ErrorId refusal() const noexcept override { return Axis->torque_additive_refusal(); }
  ErrorId pause() const noexcept override { return Axis->torque_additive_refusal(); }
  void request() const noexcept override;
};

}  // namespace lockstep
