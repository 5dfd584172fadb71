/// Velocity synchronous operation: MC_GearInVelocity.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Couples the velocity of a following axis to that of a leading axis; the ratio may change while it runs.
/// @source S7-1500T synchronous operation V7, 12.1.3; 7
/// @errors 16#8017, 16#8018 ratio; 16#8019 recursive coupling; 16#8076 simulated;
///         16#800F not enabled or MC_Stop active
struct MC_GearInVelocity final : ExecuteBlock {
  LeadingObject* Master{};
  Axis* Slave{};
  BOOL ContinuousUpdate{};
  DINT RatioNumerator = 1;
  DINT RatioDenominator = 1;
  LREAL Acceleration = -1.0;
  LREAL Deceleration = -1.0;
  LREAL Jerk = -1.0;
  BOOL PositionControlled{};
  BOOL StartSync{};
  BOOL InSync{};
  BOOL ContinuousUpdateActive{};

  static constexpr std::string_view kName = "MC_GearInVelocity";
  static constexpr std::string_view kText =
      "Couples the velocity of a following axis to that of a leading axis with a ratio that may change.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.1.3";
  static constexpr auto kPins = pins(
      object<&MC_GearInVelocity::Master>("Master", kLeading, "leading axis"),
      object<&MC_GearInVelocity::Slave>("Slave", kSynchronousAxis, "following axis"), pin::kExecute,
      in<&MC_GearInVelocity::ContinuousUpdate>("ContinuousUpdate", Unit::kNone, kAny,
                                               "TRUE: changes of the ratio count while the job runs"),
      in<&MC_GearInVelocity::RatioNumerator>(
          "RatioNumerator", Unit::kNone, {-2147483648.0, 2147483647.0, 0.0},
          "numerator of the ratio; its sign gives the direction", {.error = ErrorId::ratio_numerator}),
      in<&MC_GearInVelocity::RatioDenominator>("RatioDenominator", Unit::kNone, {1.0, 2147483647.0},
                                               "denominator of the ratio",
                                               {.error = ErrorId::ratio_denominator}),
      pin::acceleration<MC_GearInVelocity>(), pin::deceleration<MC_GearInVelocity>(),
      pin::jerk<MC_GearInVelocity>(), pin::position_controlled<MC_GearInVelocity>(),
      out<&MC_GearInVelocity::StartSync>("StartSync", "the following axis is being synchronized"),
      out<&MC_GearInVelocity::InSync>("InSync", "the following axis moves with the velocity of the function"),
      out<&MC_GearInVelocity::ContinuousUpdateActive>("ContinuousUpdateActive", "changes of the ratio count"),
      pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  Axis* target() const noexcept override { return Slave; }
  void show(JobPhase phase) noexcept override;

 private:
  void update_ratio() noexcept;
};

}  // namespace lockstep
