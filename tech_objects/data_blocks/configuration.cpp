/// Declaration of the configuration variables of an axis.
/// @source S7-1500T synchronous operation V7, 13.1
#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"

namespace lockstep {
namespace {

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kSimulationMode[] = {{0, "no simulation, normal operation"}, {1, "simulation mode"}};

constexpr Choice kVirtualAxisMode[] = {{0, "not a virtual axis"},
                                       {1, "axis is always and exclusively operated as a virtual axis"}};

constexpr Choice kActorType[] = {{0, "analog output"}, {1, "PROFIdrive telegram"}};

constexpr Choice kActorMotorType[] = {{0, "rotary motor (standard motor)"}, {1, "linear motor"}};

constexpr Choice kActorInterfaceEnableDriveOutput[] = {{0, "disabled"}, {1, "enabled"}};

constexpr Choice kTorqueLimitingLimitBase[] = {{0, "motor side"}, {1, "load side"}};

constexpr Choice kTorqueLimitingPositionBasedMonitors[] = {{0, "monitoring deactivated"},
                                                           {1, "monitoring activated"}};

constexpr Choice kSensorBacklashDirectionAbsoluteHoming[] = {{0, "positive"}, {1, "negative"}};

constexpr Choice kSensorActiveHomingDirection[] = {{0, "positive homing direction"},
                                                   {1, "negative homing direction"}};

constexpr Choice kUnitsTorqueUnit[] = {{1126, "Nm"},
                                       {1128, "kNm"},
                                       {1529, "lbf in (pound-force inch)"},
                                       {1530, "lbf ft"},
                                       {1531, "ozf in (ounce-force inch)"},
                                       {1532, "ozf ft"},
                                       {1533, "pdl in (poundal inch)"},
                                       {1534, "pdl ft"}};

constexpr Choice kUnitsForceUnit[] = {{1120, "N"},
                                      {1122, "kN"},
                                      {1094, "lbf (pound-force)"},
                                      {1093, "ozf (ounce-force)"},
                                      {1535, "pdl (poundals)"}};

constexpr Choice kPositionLimitsSWActive[] = {{0, "monitoring deactivated"}, {1, "monitoring activated"}};

constexpr Choice kPositionLimitsSWLimitReachedBehavior[] = {{0, "stop with maximum dynamic values"},
                                                            {1, "stop with current dynamic values"}};

constexpr Choice kPositionLimitsSWLimitExceededBehavior[] = {{0, "lock axis"},
                                                             {1, "emergency stop, axis enable is kept"}};

constexpr Choice kPositionLimitsHWMinSwitchLevel[] = {{0, "lower level (low active)"},
                                                      {1, "upper level (high active)"}};

constexpr Choice kPositionLimitsHWMode[] = {{0, "switch cannot be overrun"}, {1, "switch can be overrun"}};

constexpr Choice kHomingApproachDirection[] = {{0, "positive direction"}, {1, "negative direction"}};

constexpr Choice kPositionControlEnableDSC[] = {{0, "DSC deactivated"}, {1, "DSC activated"}};

constexpr Choice kPositionControlControlDifferenceQuantizationMode[] = {
    {0, "no quantization"},
    {1, "quantization corresponding to the encoder resolution"},
    {2, "quantization to a direct value"}};

constexpr Choice kPositionControlVelocityModePowerOn[] = {
    {0, "velocity is set to 0 with the maximum dynamic values of the axis (ramp)"},
    {1, "velocity is set to 0 immediately, without ramp"}};

constexpr Choice kSetpointFilterDynamicFilterMode[] = {{0, "dynamic filter not effective"},
                                                       {1, "PT1/PT2 filter + dead time"}};

constexpr Choice kFollowingErrorEnableMonitoring[] = {{0, "following-error monitoring deactivated"},
                                                      {1, "following-error monitoring activated"}};

using Data = AxisData;

constexpr Variable kVariables[] = {
    VARIABLE(Simulation.Mode, RES, kNone, between(0.0, 1.0), "simulation mode", .choices = kSimulationMode),
    VARIABLE(VirtualAxis.Mode, RON, kNone, between(0.0, 1.0), "virtual axis", .choices = kVirtualAxisMode),
    VARIABLE(Actor.Type, RON, kNone, between(0.0, 1.0), "drive connection", .choices = kActorType,
             .later = true),
    VARIABLE(Actor.InverseDirection, RES, kNone, kAny, "inversion of the setpoint",
             .choices = kActorInverseDirection),
    VARIABLE(Actor.DataAdaption, RES, kNone, between(0.0, 1.0),
             "automatic transfer of the drive values reference speed, maximum speed and reference torque",
             .choices = kActorDataAdaption, .later = true),
    VARIABLE(Actor.Efficiency, RES, kNone, between(0.0, 1.0),
             "efficiency of the mechanics (gear and leadscrew)"),
    VARIABLE(Actor.MotorType, RES, kNone, between(0.0, 1.0), "motor type", .choices = kActorMotorType),
    VARIABLE(Actor.Interface.AddressIn, RON, kNone, between(0.0, 65535.0),
             "input address of the PROFIdrive telegram", .later = true),
    VARIABLE(Actor.Interface.AddressOut, RON, kNone, between(0.0, 65535.0),
             "output address of the PROFIdrive telegram or of the analog setpoint", .later = true),
    VARIABLE(Actor.Interface.EnableDriveOutput, RES, kNone, kAny, "'enable output' for analog drives",
             .choices = kActorInterfaceEnableDriveOutput, .later = true),
    VARIABLE(Actor.Interface.EnableDriveOutputAddress, RON, kNone, between(0.0, 65535.0),
             "address of the 'enable output' for analog setpoint", .later = true),
    VARIABLE(Actor.Interface.DriveReadyInput, RES, kNone, kAny,
             "'ready input' for analog drives; the analog drive reports that it is ready to accept speed "
             "setpoints",
             .choices = kActorInterfaceEnableDriveOutput, .later = true),
    VARIABLE(Actor.Interface.DriveReadyInputAddress, RON, kNone, between(0.0, 65535.0),
             "address of the ready input for analog setpoint (the manual calls it 'enable input' here)",
             .later = true),
    VARIABLE(Actor.Interface.EnableTorqueData, RES, kNone, kAny, "torque data (supplementary telegram)",
             .choices = kActorInterfaceEnableDriveOutput),
    VARIABLE(Actor.Interface.TorqueDataAddressIn, RON, kNone, between(0.0, 65535.0),
             "input address of the supplementary telegram", .later = true),
    VARIABLE(Actor.Interface.TorqueDataAddressOut, RON, kNone, between(0.0, 65535.0),
             "output address of the supplementary telegram", .later = true),
    VARIABLE(Actor.DriveParameter.ReferenceSpeed, RES, kSpeed, between(0.0, 1e12),
             "reference value (100 %) for the speed setpoint (N-set) of the drive", .later = true),
    VARIABLE(Actor.DriveParameter.MaxSpeed, RES, kSpeed, between(0.0, 1e12),
             "maximum value of the speed setpoint (N-set) of the drive"),
    VARIABLE(Actor.DriveParameter.ReferenceTorque, RES, kTorque, between(0.0, 1e12),
             "reference value (100 %) for the drive torque", .later = true),
    VARIABLE(Actor.LinearMotorDriveParameter.ReferenceVelocity, RES, kVelocity, between(0.0, 1e12),
             "reference value (100 %) for the velocity setpoint (N-set) of the drive", .later = true),
    VARIABLE(Actor.LinearMotorDriveParameter.MaxVelocity, RES, kVelocity, between(0.0, 1e12),
             "maximum value of the velocity setpoint of the drive"),
    VARIABLE(Actor.LinearMotorDriveParameter.ReferenceForce, RES, kForce, between(0.0, 1e12),
             "reference value (100 %) for the force of the drive", .later = true),
    VARIABLE(TorqueLimiting.LimitBase, RES, kNone, between(0.0, 1.0),
             "side at which torque limiting is referenced", .choices = kTorqueLimitingLimitBase),
    VARIABLE(TorqueLimiting.PositionBasedMonitors, RES, kNone, between(0.0, 1.0),
             "positioning and following-error monitoring during torque limiting",
             .choices = kTorqueLimitingPositionBasedMonitors),
    VARIABLE(TorqueLimiting.LimitDefaults.Torque, CAL, kTorque, between(0.0, 1e12), "limiting torque"),
    VARIABLE(TorqueLimiting.LimitDefaults.Force, CAL, kForce, between(0.0, 1e12), "limiting force"),
    VARIABLE(Clamping.FollowingErrorDeviation, DIR, kPosition, between(0.001, 1e12),
             "following-error value from which on the fixed stop is recognised"),
    VARIABLE(Clamping.PositionTolerance, DIR, kPosition, between(0.001, 1e12),
             "position tolerance of clamping monitoring"),
    ELEMENTS(Sensor, Existent, RON, kNone, kAny, "shows which encoders have been created"),
    ELEMENTS(Sensor, Type, RON, kNone, between(0.0, 2.0), "encoder type", .choices = kSensorType),
    ELEMENTS(Sensor, InverseDirection, RES, kNone, kAny, "inversion of the actual value",
             .choices = kActorInverseDirection),
    ELEMENTS(Sensor, System, RES, kNone, between(0.0, 1.0), "encoder system", .choices = kSensorSystem,
             .later = true),
    ELEMENTS(Sensor, MountingMode, RES, kNone, between(0.0, 2.0), "mounting type of the encoder",
             .choices = kSensorMountingMode, .later = true),
    ELEMENTS(Sensor, DataAdaption, RES, kNone, between(0.0, 1.0),
             "automatic transfer of the drive values reference speed, maximum speed and reference torque in "
             "the device",
             .choices = kActorDataAdaption, .later = true),
    ELEMENTS(Sensor, ActualVelocityMode, RES, kNone, between(0.0, 1.0),
             "how the actual speed/velocity is computed", .choices = kSensorActualVelocityMode,
             .later = true),
    ELEMENTS(Sensor, Interface.AddressIn, RON, kNone, between(0.0, 65535.0),
             "input address of the PROFIdrive telegram", .later = true),
    ELEMENTS(Sensor, Interface.AddressOut, RON, kNone, between(0.0, 65535.0),
             "output address of the PROFIdrive telegram", .later = true),
    ELEMENTS(Sensor, Interface.Number, RON, kNone, between(1.0, 2.0), "number of the encoder in the telegram",
             .later = true),
    ELEMENTS(Sensor, Parameter.Resolution, RES, kPosition, between(1e-12, 1e12),
             "resolution of a linear encoder (distance between two encoder marks)", .later = true),
    ELEMENTS(Sensor, Parameter.StepsPerRevolution, RES, kNone, between(1.0, 8388608.0),
             "increments per encoder revolution of a rotary encoder", .later = true),
    ELEMENTS(Sensor, Parameter.FineResolutionXist1, RES, kNone, between(0.0, 31.0),
             "number of bits of the fine resolution in Gx_XIST1 (cyclic actual encoder value)",
             .later = true),
    ELEMENTS(Sensor, Parameter.FineResolutionXist2, RES, kNone, between(0.0, 31.0),
             "number of bits of the fine resolution in Gx_XIST2 (absolute encoder value)", .later = true),
    ELEMENTS(Sensor, Parameter.DeterminableRevolutions, RES, kNone, between(0.0, 8388608.0),
             "number of distinguishable encoder revolutions of a multiturn absolute encoder", .later = true),
    ELEMENTS(Sensor, Parameter.DistancePerRevolution, RES, kPosition, between(0.0, 1e12),
             "load travel per encoder revolution for an externally mounted encoder", .later = true),
    ELEMENTS(Sensor, Parameter.BehaviorGx_XIST1, RES, kNone, kAny, "evaluation of the Gx_XIST1 bits",
             .choices = kSensorParameterBehaviorGxXIST1, .later = true),
    ELEMENTS(Sensor, Parameter.ReferenceSpeed, RES, kSpeed, between(0.0, 1e12),
             "reference speed for NIST in the PROFIdrive telegram for a rotary encoder; only relevant with "
             "ActualVelocityMode = 1",
             .later = true),
    ELEMENTS(Sensor, Parameter.ReferenceVelocity, RES, kVelocity, between(0.0, 1e12),
             "reference velocity for NIST in the PROFIdrive telegram for a linear encoder; only relevant "
             "with ActualVelocityMode = 1",
             .later = true),
    ELEMENTS(Sensor, Backlash.Enable, DIR, kNone, kAny, "activates backlash compensation",
             .choices = kActorInterfaceEnableDriveOutput),
    ELEMENTS(Sensor, Backlash.Size, DIR, kPosition, between(0.0, 1e12), "size of the backlash"),
    ELEMENTS(Sensor, Backlash.Velocity, DIR, kVelocity, between(0.0, 1e12),
             "velocity for travelling out of the backlash"),
    ELEMENTS(Sensor, Backlash.DirectionAbsoluteHoming, DIR, kNone, between(0.0, 1.0),
             "direction of travel during or before absolute encoder adjustment",
             .choices = kSensorBacklashDirectionAbsoluteHoming),
    ELEMENTS(Sensor, ActiveHoming.Mode, RES, kNone, between(0.0, 2.0), "homing mode",
             .choices = kSensorActiveHomingMode),
    ELEMENTS(Sensor, ActiveHoming.SideInput, CAL, kNone, kAny, "side of the digital input for active homing",
             .choices = kSensorActiveHomingSideInput),
    ELEMENTS(Sensor, ActiveHoming.Direction, CAL, kNone, between(0.0, 1.0),
             "homing direction / direction of approach to the reference mark",
             .choices = kSensorActiveHomingDirection),
    ELEMENTS(Sensor, ActiveHoming.DigitalInputAddress, RON, kNone, between(0.0, 65535.0),
             "address of the digital input"),
    ELEMENTS(Sensor, ActiveHoming.HomePositionOffset, CAL, kPosition, between(-1e12, 1e12),
             "home position offset"),
    ELEMENTS(Sensor, ActiveHoming.SwitchLevel, RES, kNone, kAny,
             "signal level at the digital input when the reference mark has been approached",
             .choices = kSensorActiveHomingSwitchLevel),
    ELEMENTS(Sensor, PassiveHoming.Mode, RES, kNone, between(0.0, 2.0), "homing mode",
             .choices = kSensorActiveHomingMode),
    ELEMENTS(Sensor, PassiveHoming.SideInput, CAL, kNone, kAny,
             "side of the digital input for passive homing", .choices = kSensorActiveHomingSideInput),
    ELEMENTS(Sensor, PassiveHoming.Direction, CAL, kNone, between(0.0, 2.0),
             "homing direction / direction of approach to the reference mark",
             .choices = kSensorPassiveHomingDirection),
    ELEMENTS(Sensor, PassiveHoming.DigitalInputAddress, RON, kNone, between(0.0, 65535.0),
             "address of the digital input"),
    ELEMENTS(Sensor, PassiveHoming.SwitchLevel, RES, kNone, kAny,
             "signal level at the digital input when the reference mark has been approached",
             .choices = kSensorActiveHomingSwitchLevel),
    ELEMENTS(CrossPlcSynchronousOperation.Interface, EnableLeadingValueOutput, RON, kNone, kAny,
             "provide a cross-PLC leading value", .choices = kActorInverseDirection),
    ELEMENTS(CrossPlcSynchronousOperation.Interface, AddressOut, RON, kNone, kAny,
             "output address of the leading-value telegram", .later = true),
    VARIABLE(CrossPlcSynchronousOperation.LocalLeadingValueDelayTime, RES, kSeconds,
             between(0.0, 1000000000.0),
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
    VARIABLE(LoadGear.Numerator, RES, kNone, between(1.0, 4294967295.0), "load gear numerator"),
    VARIABLE(LoadGear.Denominator, RES, kNone, between(1.0, 4294967295.0), "load gear denominator"),
    VARIABLE(Properties.MotionType, RON, kNone, between(0.0, 1.0), "shows the axis or motion type",
             .choices = kPropertiesMotionType),
    VARIABLE(Units.LengthUnit, RON, kNone, kAny, "unit for position", .choices = kUnitsLengthUnit),
    VARIABLE(Units.VelocityUnit, RON, kNone, kAny, "unit for velocity", .choices = kUnitsVelocityUnit,
             .later = true),
    VARIABLE(Units.TimeUnit, RON, kNone, kAny, "unit for time", .choices = kUnitsTimeUnit, .later = true),
    VARIABLE(Units.TorqueUnit, RON, kNone, kAny, "unit for torque", .choices = kUnitsTorqueUnit),
    VARIABLE(Units.ForceUnit, RON, kNone, kAny, "unit for force", .choices = kUnitsForceUnit),
    VARIABLE(Units.UnitFactor, RON, kNone, kAny,
             "factor for the internal conversion with the high-resolution units", .later = true),
    VARIABLE(Mechanics.LeadScrew, RES, kPosition, between(1e-12, 1e12), "leadscrew pitch"),
    VARIABLE(Modulo.Enable, RES, kNone, kAny, "modulo conversion", .choices = kModuloEnable),
    VARIABLE(Modulo.Length, RES, kPosition, between(0.001, 1e12), "modulo length"),
    VARIABLE(Modulo.StartValue, RES, kPosition, between(-1e12, 1e12), "modulo start value"),
    VARIABLE(DynamicLimits.MaxVelocity, RES, kVelocity, between(0.0, 1e12),
             "maximum admissible velocity of the axis"),
    VARIABLE(DynamicLimits.Velocity, DIR, kVelocity, between(0.0, 1e12),
             "currently applicable maximum velocity of the axis; the minimum of MaxVelocity and Velocity is "
             "effective"),
    VARIABLE(DynamicLimits.MaxAcceleration, DIR, kAcceleration, between(0.0, 277777777.777778),
             "maximum admissible acceleration of the axis"),
    VARIABLE(DynamicLimits.MaxDeceleration, DIR, kAcceleration, between(0.0, 277777777.777778),
             "maximum admissible deceleration of the axis"),
    VARIABLE(DynamicLimits.MaxJerk, DIR, kJerk, between(0.0, 4629629.629),
             "maximum admissible jerk at the axis"),
    VARIABLE(DynamicDefaults.Velocity, CAL, kVelocity, between(0.0, 1e12), "default velocity"),
    VARIABLE(DynamicDefaults.Acceleration, CAL, kAcceleration, between(0.0, 277777777.777778),
             "default acceleration"),
    VARIABLE(DynamicDefaults.Deceleration, CAL, kAcceleration, between(0.0, 277777777.777778),
             "default deceleration"),
    VARIABLE(DynamicDefaults.Jerk, CAL, kJerk, between(0.0, 4629629.629), "default jerk"),
    VARIABLE(DynamicDefaults.EmergencyDeceleration, DIR, kAcceleration, between(0.0, 277777777.777778),
             "emergency-stop deceleration"),
    VARIABLE(PositionLimits_SW.Active, DIR, kNone, kAny, "activation of the monitoring",
             .choices = kPositionLimitsSWActive),
    VARIABLE(PositionLimits_SW.MinPosition, DIR, kPosition, between(-1e12, 1e12),
             "position of the negative software limit switch"),
    VARIABLE(PositionLimits_SW.MaxPosition, DIR, kPosition, between(-1e12, 1e12),
             "position of the positive software limit switch (MaxPosition > MinPosition)"),
    VARIABLE(PositionLimits_SW.LimitReachedBehavior, RES, kNone, between(0.0, 1.0),
             "alarm reaction when a software limit switch is approached with a single-axis job",
             .choices = kPositionLimitsSWLimitReachedBehavior),
    VARIABLE(PositionLimits_SW.LimitExceededBehavior, RES, kNone, between(0.0, 1.0),
             "alarm reaction when a software limit switch is overrun",
             .choices = kPositionLimitsSWLimitExceededBehavior),
    VARIABLE(PositionLimits_HW.Active, RES, kNone, kAny,
             "activation of the monitoring; switches both the negative and the positive hardware limit "
             "switch on or off",
             .choices = kPositionLimitsSWActive),
    VARIABLE(PositionLimits_HW.MinSwitchLevel, RES, kNone, kAny,
             "level that activates the negative hardware limit switch",
             .choices = kPositionLimitsHWMinSwitchLevel),
    VARIABLE(PositionLimits_HW.MinSwitchAddress, RES, kNone, between(0.0, 65535.0),
             "address of the negative hardware limit switch"),
    VARIABLE(PositionLimits_HW.MaxSwitchLevel, RES, kNone, kAny,
             "level that activates the positive hardware limit switch",
             .choices = kPositionLimitsHWMinSwitchLevel),
    VARIABLE(PositionLimits_HW.MaxSwitchAddress, RES, kNone, between(0.0, 65535.0),
             "address of the positive hardware limit switch"),
    VARIABLE(PositionLimits_HW.Mode, RES, kNone, between(0.0, 1.0), "type of the hardware limit switches",
             .choices = kPositionLimitsHWMode),
    VARIABLE(PositionLimits_HW.ApproachBehavior, RES, kNone, between(0.0, 1.0),
             "alarm reaction when a hardware limit switch is approached",
             .choices = kPositionLimitsSWLimitExceededBehavior),
    VARIABLE(Homing.AutoReversal, RES, kNone, kAny, "reversal at the hardware limit switches",
             .choices = kActorInverseDirection),
    VARIABLE(Homing.ApproachDirection, CAL, kNone, kAny, "direction of approach to the homing switch",
             .choices = kHomingApproachDirection),
    VARIABLE(Homing.ApproachVelocity, CAL, kVelocity, between(0.0, 360000.0),
             "approach velocity: velocity during active homing with which the reference cam and the "
             "reference point are approached"),
    VARIABLE(Homing.ReferencingVelocity, CAL, kVelocity, between(0.0, 36000.0),
             "homing velocity: velocity during active homing with which the reference point position is "
             "travelled to"),
    VARIABLE(Homing.HomePosition, CAL, kPosition, between(-1e12, 1e12), "home position"),
    VARIABLE(Override.Velocity, DIR, kPercent, between(0.0, 200.0),
             "velocity or speed override: percentage correction of the velocity/speed"),
    VARIABLE(PositionControl.Kv, DIR, kPerSecond, between(0.0, 2147480.0),
             "proportional gain of position control (Kv > 0.0)"),
    VARIABLE(PositionControl.Kpc, DIR, kPercent, between(0.0, 150.0),
             "velocity precontrol of position control"),
    VARIABLE(PositionControl.EnableDSC, RES, kNone, kAny, "Dynamic Servo Control (DSC)",
             .choices = kPositionControlEnableDSC),
    VARIABLE(PositionControl.SmoothingTimeByChangeDifference, DIR, kSeconds, between(0.0, 1e12),
             "smoothing time of the manipulated variable at switchovers (encoder, Kv, emergency-stop ramp)"),
    VARIABLE(PositionControl.InitialOperativeSensor, RES, kNone, between(1.0, 4.0),
             "sensor (number 1 to 4) in effect after initialisation of the axis"),
    VARIABLE(PositionControl.ControlDifferenceQuantization.Mode, RES, kNone, kAny,
             "type of quantization for a drive with stepper-motor interface",
             .choices = kPositionControlControlDifferenceQuantizationMode, .later = true),
    VARIABLE(PositionControl.ControlDifferenceQuantization.Value, RES, kPosition, between(0.001, 1e12),
             "value of the quantization; used when Mode = 2 (quantization to a direct value)", .later = true),
    VARIABLE(PositionControl.VelocityModePowerOn, RES, kNone, between(0.0, 1.0),
             "behaviour of the velocity setpoint when the axis is enabled",
             .choices = kPositionControlVelocityModePowerOn),
    VARIABLE(SetpointFilter.DynamicFilter.Mode, RES, kNone, kAny, "mode of the dynamic filter",
             .choices = kSetpointFilterDynamicFilterMode),
    VARIABLE(SetpointFilter.DynamicFilter.T1, DIR, kSeconds, between(0.0, 1e12),
             "first time constant of the PT2 filter"),
    VARIABLE(SetpointFilter.DynamicFilter.T2, DIR, kSeconds, between(0.0, 1e12),
             "second time constant of the PT2 filter"),
    VARIABLE(SetpointFilter.DynamicFilter.Tt, DIR, kSeconds, between(0.0, 1e12),
             "additional dead time of the dynamic filter"),
    VARIABLE(DynamicAxisModel.VelocityTimeConstant, DIR, kSeconds, between(0.0, 1e12),
             "substitute time of the speed control loop"),
    VARIABLE(DynamicAxisModel.AdditionalPositionTimeConstant, DIR, kSeconds, between(0.0, 1e12),
             "additive substitute time of the position control loop"),
    VARIABLE(FollowingError.EnableMonitoring, RES, kNone, kAny, "activation of following-error monitoring",
             .choices = kFollowingErrorEnableMonitoring),
    VARIABLE(FollowingError.MinValue, DIR, kPosition, between(0.0, 1e12),
             "admissible following error at velocities below MinVelocity"),
    VARIABLE(FollowingError.MaxValue, DIR, kPosition, between(0.0, 1e12),
             "maximum admissible following error that may be reached at maximum velocity"),
    VARIABLE(FollowingError.MinVelocity, DIR, kVelocity, between(0.0, 1e12),
             "below this velocity MinValue is admissible and kept constant"),
    VARIABLE(FollowingError.WarningLevel, DIR, kPercent, between(0.0, 100.0),
             "warning level as a percentage of the maximum admissible following error"),
    VARIABLE(
        FollowingError.AdditionalSetpointDelayTime, DIR, kSeconds, between(0.0, 1e12),
        "time constant of an additional delay of the position setpoint for computing the following error"),
    VARIABLE(PositioningMonitoring.ToleranceTime, DIR, kSeconds, between(0.0, 1e12),
             "tolerance time: maximum duration from reaching setpoint velocity zero until entry into the "
             "positioning window"),
    VARIABLE(PositioningMonitoring.MinDwellTime, DIR, kSeconds, between(0.0, 1e12),
             "minimum dwell time in the positioning window"),
    VARIABLE(PositioningMonitoring.Window, DIR, kPosition, between(0.0, 1e12), "positioning window"),
    VARIABLE(StandstillSignal.VelocityThreshold, DIR, kVelocity, between(0.0, 1e12),
             "velocity threshold; falling below it starts the minimum dwell time"),
    VARIABLE(StandstillSignal.MinDwellTime, DIR, kSeconds, between(0.0, 1e12), "minimum dwell time"),
    VARIABLE(
        Synchronization.MasterReversionTolerance, RES, kNone, between(0.0, 1e12),
        "leading distance by which the leading value may reverse without alarm 608; Lockstep's own variable"),
};

}  // namespace

const DataBlock& axis_data_block() noexcept {
  static const DataBlock kBlock{kVariables, axis_status_variables()};
  return kBlock;
}

}  // namespace lockstep
