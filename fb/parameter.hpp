/// Changing settings of an axis at run time: MC_WriteParameter, MC_SetSensor.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// Writes a configuration value that may change at run time.
/// @source S7-1500T axis functions, MC_WriteParameter
/// @errors 16#805A no such parameter; 16#805B no hardware limit switches; 16#805C not a value of its type;
/// 16#805D communication times, which a drive of this controller does not have
struct MC_WriteParameter final : ExecuteBlock {
  LeadingObject* Axis{};
  DINT ParameterNumber{};
  LREAL Value{};

  static constexpr std::string_view kName = "MC_WriteParameter";
  static constexpr std::string_view kText = "Changes selected configuration values at run time.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_WriteParameter";
  static constexpr auto kPins = pins(
      object<&MC_WriteParameter::Axis>("Axis", kPowered, "object whose value is written"), pin::kExecute,
      in<&MC_WriteParameter::ParameterNumber>("ParameterNumber", Unit::kNone, kAny,
                                              "1000: PositionLimits_HW.Active; 1010 to 1012: "
                                              "communication times, which are refused",
                                              {.error = ErrorId::parameter_number}),
      in<&MC_WriteParameter::Value>("Value", Unit::kNone, kFinite, "value to write; of a BOOL 0.0 or 1.0",
                                    {.error = ErrorId::parameter_type}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
  void hand_over(Job& job) noexcept override;

 private:
  /// Why there is no such value to write.
  ErrorId refusal() const noexcept;
};

/// Switches an axis to another of its encoders, or hands a position over from one to the other.
/// @source S7-1500T axis functions, MC_SetSensor
/// @errors 16#8050 Sensor; 16#8051 ReferenceSensor; 16#8016 its values are not valid; 16#8074 MC_Home runs
struct MC_SetSensor final : ExecuteBlock {
  lockstep::Axis* Axis{};
  INT Sensor = 1;
  DINT Mode{};
  INT ReferenceSensor = 1;

  static constexpr std::string_view kName = "MC_SetSensor";
  static constexpr std::string_view kText = "Switches an axis to another of its encoders.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_SetSensor";
  static constexpr Choice kModes[] = {{0, "switch over, the actual position goes along"},
                                      {1, "switch over, the difference becomes a control deviation"},
                                      {2, "no switch-over: actual position of the axis copied to Sensor"},
                                      {3, "no switch-over: position of ReferenceSensor copied to Sensor"}};
  static constexpr bool copies_from_reference(const Block& block) noexcept {
    return chooses(static_cast<const MC_SetSensor&>(block).Mode, SetSensorMode::copy_from_reference);
  }
  static constexpr auto kPins = pins(
      object<&MC_SetSensor::Axis>("Axis", kAnyAxis, "axis that has the encoders"), pin::kExecute,
      in<&MC_SetSensor::Sensor>("Sensor", Unit::kNone, Range{1, 4}, "encoder, 1 to 4",
                                {.error = ErrorId::sensor}),
      in<&MC_SetSensor::Mode>("Mode", Unit::kNone, kAny, "what happens",
                              {.error = ErrorId::mode, .choices = kModes}),
      in<&MC_SetSensor::ReferenceSensor>(
          "ReferenceSensor", Unit::kNone, Range{1, 4}, "Mode 3: encoder whose position is taken, not Sensor",
          {.error = ErrorId::reference_sensor, .relevant = &copies_from_reference}),
      pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
