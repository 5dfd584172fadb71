/// Declaration of the variables of an external encoder.
/// @source S7-1500/S7-1500T axis functions, tags of the technology object external encoder
#include "tech_objects/data_blocks/encoder.hpp"

#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

using Data = ExternalEncoderData;

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kErrorDetailReaction[] = {{0, "no reaction"}, {10, "encoder processing ends"}};

constexpr Variable kConfiguration[] = {
    VARIABLE(Sensor.Type, RON, kNone, between(0.0, 2.0), "encoder type", .choices = kSensorType,
             .later = true),
    VARIABLE(Sensor.InverseDirection, RES, kNone, kAny, "inversion of the actual value",
             .choices = kActorInverseDirection),
    VARIABLE(Sensor.System, RES, kNone, between(0.0, 1.0), "encoder system", .choices = kSensorSystem,
             .later = true),
    VARIABLE(Sensor.MountingMode, RES, kNone, between(0.0, 2.0), "mounting type of the encoder",
             .choices = kSensorMountingMode, .later = true),
    VARIABLE(Sensor.DataAdaption, RES, kNone, between(0.0, 1.0),
             "automatic transfer of the drive values reference speed, maximum speed and reference torque in "
             "the device",
             .choices = kActorDataAdaption, .later = true),
    VARIABLE(Sensor.ActualVelocityMode, RES, kNone, between(0.0, 1.0),
             "how the actual speed/velocity is computed", .choices = kSensorActualVelocityMode,
             .later = true),
    VARIABLE(Sensor.Interface.AddressIn, RON, kNone, between(0.0, 65535.0),
             "input address of the PROFIdrive telegram", .later = true),
    VARIABLE(Sensor.Interface.AddressOut, RON, kNone, between(0.0, 65535.0),
             "output address of the PROFIdrive telegram", .later = true),
    VARIABLE(Sensor.Interface.Number, RON, kNone, between(1.0, 2.0), "number of the encoder in the telegram",
             .later = true),
    VARIABLE(Sensor.Parameter.Resolution, RES, kPosition, between(-1e12, 1e12),
             "resolution of a linear encoder (distance between two encoder marks)", .later = true),
    VARIABLE(Sensor.Parameter.StepsPerRevolution, RES, kNone, between(1.0, 8388608.0),
             "increments per encoder revolution of a rotary encoder", .later = true),
    VARIABLE(Sensor.Parameter.FineResolutionXist1, RES, kNone, between(0.0, 31.0),
             "number of bits of the fine resolution in Gx_XIST1 (cyclic actual encoder value)",
             .later = true),
    VARIABLE(Sensor.Parameter.FineResolutionXist2, RES, kNone, between(0.0, 31.0),
             "number of bits of the fine resolution in Gx_XIST2 (absolute encoder value)", .later = true),
    VARIABLE(Sensor.Parameter.DeterminableRevolutions, RES, kNone, between(0.0, 8388608.0),
             "number of distinguishable encoder revolutions of a multiturn absolute encoder", .later = true),
    VARIABLE(Sensor.Parameter.DistancePerRevolution, RES, kPosition, between(0.0, 1e12),
             "load travel per encoder revolution for an externally mounted encoder", .later = true),
    VARIABLE(Sensor.Parameter.BehaviorGx_XIST1, RES, kNone, kAny, "evaluation of the Gx_XIST1 bits",
             .choices = kSensorParameterBehaviorGxXIST1, .later = true),
    VARIABLE(Sensor.Parameter.ReferenceSpeed, RES, kSpeed, between(0.0, 1e12),
             "reference speed for NIST in the PROFIdrive telegram for a rotary encoder; only relevant with "
             "ActualVelocityMode = 1",
             .later = true),
    VARIABLE(Sensor.Parameter.ReferenceVelocity, RES, kVelocity, between(0.0, 1e12),
             "reference velocity for NIST in the PROFIdrive telegram for a linear encoder; only relevant "
             "with ActualVelocityMode = 1",
             .later = true),
    VARIABLE(Sensor.PassiveHoming.Mode, RES, kNone, between(0.0, 2.0), "homing mode",
             .choices = kSensorActiveHomingMode),
    VARIABLE(Sensor.PassiveHoming.SideInput, CAL, kNone, kAny, "side of the digital input for passive homing",
             .choices = kSensorActiveHomingSideInput),
    VARIABLE(Sensor.PassiveHoming.Direction, CAL, kNone, between(0.0, 2.0),
             "homing direction / direction of approach to the reference mark",
             .choices = kSensorPassiveHomingDirection),
    VARIABLE(Sensor.PassiveHoming.DigitalInputAddress, RON, kNone, between(0.0, 65535.0),
             "address of the digital input"),
    VARIABLE(Sensor.PassiveHoming.SwitchLevel, RON, kNone, kAny,
             "signal level at the digital input when the reference mark has been approached",
             .choices = kSensorActiveHomingSwitchLevel),
    ELEMENTS(CrossPlcSynchronousOperation.Interface, EnableLeadingValueOutput, RON, kNone, kAny,
             "provide a cross-PLC leading value", .choices = kActorInverseDirection),
    ELEMENTS(CrossPlcSynchronousOperation.Interface, AddressOut, RON, kNone, kAny,
             "output address of the leading-value telegram", .later = true),
    VARIABLE(CrossPlcSynchronousOperation.LocalLeadingValueDelayTime, RES, kSeconds, between(0.0, 1e9),
             "delay time of the leading-value output at the local following axes"),
    COMPUTED(Extrapolation.LeadingAxisDependentTime, RON, kSeconds, kAny,
             "leading-axis part of the extrapolation time: acquisition + interpolator cycle + filter times "
             "T1 + T2"),
    VARIABLE(Extrapolation.FollowingAxisDependentTime, DIR, kSeconds, between(0.0, 1e12),
             "share of the extrapolation time caused by the following axis"),
    VARIABLE(Extrapolation.Settings.SystemDefinedExtrapolation, RES, kNone, between(0.0, 1.0),
             "leading-axis-dependent time", .choices = kExtrapolationSettingsSystemDefinedExtrapolation),
    VARIABLE(Extrapolation.Settings.ExtrapolatedVelocityMode, RES, kNone, between(0.0, 1.0),
             "velocity value that is effective for the synchronous operation function",
             .choices = kExtrapolationSettingsExtrapolatedVelocityMode),
    VARIABLE(Extrapolation.PositionFilter.T1, DIR, kSeconds, between(0.0, 1e12),
             "position filter time constant T1"),
    VARIABLE(Extrapolation.PositionFilter.T2, DIR, kSeconds, between(0.0, 1e12),
             "position filter time constant T2"),
    VARIABLE(Extrapolation.VelocityFilter.T1, DIR, kSeconds, between(0.0, 1e12),
             "velocity filter time constant T1"),
    VARIABLE(Extrapolation.VelocityFilter.T2, DIR, kSeconds, between(0.0, 1e12),
             "velocity filter time constant T2"),
    VARIABLE(Extrapolation.VelocityTolerance.Range, DIR, kVelocity, between(0.0, 1e12),
             "width of the tolerance band for the velocity"),
    VARIABLE(Extrapolation.Hysteresis.Value, DIR, kLeading, between(0.0, 1e12),
             "hysteresis of the extrapolated position value"),
    VARIABLE(LoadGear.Numerator, RES, kNone, between(1.0, 4294967295.0), "load gear numerator",
             .later = true),
    VARIABLE(LoadGear.Denominator, RES, kNone, between(1.0, 4294967295.0), "load gear denominator",
             .later = true),
    VARIABLE(Properties.MotionType, RON, kNone, between(0.0, 1.0), "shows the axis or motion type",
             .choices = kPropertiesMotionType, .later = true),
    VARIABLE(Mechanics.LeadScrew, RES, kPosition, between(1e-12, 1e12), "leadscrew pitch", .later = true),
    VARIABLE(Modulo.Enable, RES, kNone, kAny, "modulo conversion", .choices = kModuloEnable),
    VARIABLE(Modulo.Length, RES, kPosition, between(0.001, 1e12), "modulo length"),
    VARIABLE(Modulo.StartValue, RES, kPosition, between(-1e12, 1e12), "modulo start value"),
    VARIABLE(Homing.HomePosition, CAL, kPosition, between(-1e12, 1e12), "home position"),
    VARIABLE(Units.LengthUnit, RON, kNone, kAny, "unit for position", .choices = kUnitsLengthUnit,
             .later = true),
    VARIABLE(Units.TimeUnit, RON, kNone, kAny, "unit for time", .choices = kUnitsTimeUnit, .later = true),
    VARIABLE(Units.VelocityUnit, RON, kNone, kAny, "unit for velocity", .choices = kUnitsVelocityUnit,
             .later = true),
    VARIABLE(StandstillSignal.VelocityThreshold, DIR, kVelocity, between(0.0, 1e12),
             "velocity threshold; falling below it starts the minimum dwell time"),
    VARIABLE(StandstillSignal.MinDwellTime, DIR, kSeconds, between(0.0, 1e12), "minimum dwell time"),
};

constexpr Variable kStatus[] = {
    COMPUTED(ActualPosition, RON, kPosition, kAny, "actual position"),
    COMPUTED(ActualVelocity, RON, kVelocity, kAny, "actual velocity"),
    COMPUTED(ActualAcceleration, RON, kAcceleration, kAny, "actual acceleration"),
    COMPUTED(ActualModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "modulo cycle count of the actual value"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Position, RON, kPosition, between(-1e12, 1e12),
             "position"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    COMPUTED(StatusExtrapolation.FilteredPosition, RON, kPosition, between(-1e12, 1e12),
             "position after the position filter"),
    COMPUTED(StatusExtrapolation.FilteredVelocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity after velocity filter and tolerance band"),
    COMPUTED(StatusExtrapolation.ExtrapolatedPosition, RON, kPosition, between(-1e12, 1e12),
             "extrapolated position"),
    COMPUTED(StatusExtrapolation.ExtrapolatedVelocity, RON, kVelocity, between(-1e12, 1e12),
             "extrapolated velocity"),
    COMPUTED(StatusSensor.State, RON, kNone, between(0.0, 2.0), "status of the actual encoder value",
             .choices = kStatusSensorState),
    COMPUTED(StatusSensor.CommunicationOK, RON, kNone, kAny,
             "cyclic bus communication between controller and encoder",
             .choices = kStatusSensorCommunicationOK),
    COMPUTED(StatusSensor.Error, RON, kNone, kAny, "error in the measuring system",
             .choices = kStatusSensorError),
    COMPUTED(StatusSensor.AbsEncoderOffset, RON, kPosition, kAny,
             "home position offset to the value of an absolute encoder; stored retentively in the CPU",
             .later = true),
    COMPUTED(StatusSensor.Control, RON, kNone, kAny, "encoder activity", .choices = kStatusSensorControl),
    COMPUTED(StatusSensor.Position, RON, kPosition, kAny, "encoder position"),
    COMPUTED(StatusSensor.Velocity, RON, kVelocity, kAny, "encoder velocity"),
    COMPUTED(StatusSensor.AdaptionState, RON, kNone, between(0.0, 4.0),
             "status of the automatic transfer of the encoder parameters",
             .choices = kStatusDriveAdaptionState, .later = true),
    COMPUTED(StatusSensor.ModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "number of modulo cycles"),
    COMPUTED(StatusSensor.Adjusted, RON, kNone, between(0.0, 1.0), "homing status of the encoder",
             .choices = kStatusSensorAdjusted),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kEncoderStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kEncoderErrorBitNames),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kEncoderWarningBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 10.0), "effective alarm reaction",
             .choices = kErrorDetailReaction),
};

}  // namespace

const DataBlock& encoder_data_block() noexcept {
  static constexpr DataBlock block{kConfiguration, kStatus};
  return block;
}

}  // namespace lockstep
