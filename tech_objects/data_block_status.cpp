/// Declaration of the variables that the runtime computes.
/// @source S7-1500T synchronous operation V7, 13.1
#include "tech_objects/data_block_declaration.hpp"

namespace lockstep {
namespace {

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kStatusDriveDisabled[] = {{0, "drive not switched off"}, {1, "drive switched off"}};

constexpr Choice kStatusDriveInOperation[] = {{0, "drive not ready; setpoints are not executed"},
                                              {1, "drive ready; setpoints can be executed"}};

constexpr Choice kStatusDriveCommunicationOK[] = {
    {0, "cyclic communication not established or fault ZSW1.X3 (FaultPresent) pending"},
    {1, "cyclic communication OK and no fault in effect"}};

constexpr Choice kStatusDriveError[] = {{0, "no error at the drive"}, {1, "error at the drive"}};

constexpr Choice kStatusDriveAdaptionState[] = {
    {0, "NOT_ADAPTED: data not transferred"},
    {1, "IN_ADAPTION: data transfer in progress"},
    {2, "ADAPTED: data transfer complete"},
    {3, "NOT_APPLICABLE: data transfer not selected or not possible"},
    {4, "ADAPTION_ERROR: error during data transfer"}};

constexpr Choice kStatusSensorState[] = {
    {0, "NOT_VALID: not valid"}, {1, "WAITING_FOR_VALID: waiting for status 'valid'"}, {2, "VALID: valid"}};

constexpr Choice kStatusSensorCommunicationOK[] = {{0, "not established"}, {1, "established"}};

constexpr Choice kStatusSensorError[] = {{0, "no error in the measuring system"},
                                         {1, "error in the measuring system"}};

constexpr Choice kStatusSensorControl[] = {{0, "encoder is not active"}, {1, "encoder is active"}};

constexpr Choice kStatusSensorAdjusted[] = {{0, "encoder not homed"},
                                            {1,
                                             "encoder homed by active homing, passive homing, absolute "
                                             "encoder adjustment or incremental encoder adjustment"}};

constexpr Choice kStatusSynchronizedMotionFunctionState[] = {
    {0, "no synchronous operation active"},
    {1, "gearing (MC_GearIn)"},
    {2, "gearing with specified synchronous positions (MC_GearInPos)"},
    {3, "camming (MC_CamIn)"},
    {4, "desynchronising gearing (MC_GearOut)"},
    {5, "desynchronising camming (MC_CamOut)"},
    {6, "velocity gearing (MC_GearInVelocity)"}};

constexpr Choice kStatusSynchronizedMotionWaitingFunctionState[] = {
    {0, "no synchronous operation waiting"},
    {1, "reserved"},
    {2, "GearInPosWaiting: gearing with specified synchronous positions waiting (MC_GearInPos)"},
    {3, "CamInWaiting: camming waiting (MC_CamIn)"},
    {4, "GearOutWaiting: desynchronisation of gearing waiting (MC_GearOut)"},
    {5, "CamOutWaiting: desynchronisation of camming waiting (MC_CamOut)"}};

constexpr Choice kStatusSynchronizedMotionActualMaster[] = {{0, "synchronous operation inactive"}};

constexpr Choice kStatusTorqueDataCommandAdditiveTorqueActive[] = {{0, "inactive"}, {1, "active"}};

constexpr Choice kStatusMotionInFunctionState[] = {
    {0, "no MotionIn function active"}, {1, "MC_MotionInVelocity active"}, {2, "MC_MotionInPosition active"}};

constexpr Choice kErrorDetailReaction[] = {{0, "no reaction"},
                                           {1, "stop with current dynamic values"},
                                           {2, "stop with maximum dynamic values"},
                                           {3, "stop with emergency-stop ramp"},
                                           {4, "remove enable"},
                                           {5, "track setpoints"}};

constexpr Variable kVariables[] = {
    VARIABLE(Position, RON, kPosition, kAny, "setpoint position"),
    VARIABLE(Velocity, RON, kVelocity, kAny, "setpoint velocity / setpoint speed"),
    VARIABLE(ActualPosition, RON, kPosition, kAny, "actual position"),
    VARIABLE(ActualVelocity, RON, kVelocity, kAny, "actual velocity"),
    VARIABLE(ActualSpeed, RON, kSpeed, kAny, "actual speed, content depends on the kind of drive"),
    VARIABLE(Acceleration, RON, kAcceleration, kAny, "setpoint acceleration"),
    VARIABLE(ActualAcceleration, RON, kAcceleration, kAny, "actual acceleration"),
    VARIABLE(OperativeSensor, RON, kNone, between(1.0, 4.0),
             "number of the encoder that is operatively in effect"),
    VARIABLE(ModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "modulo cycle count of the setpoint"),
    VARIABLE(ActualModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "modulo cycle count of the actual value"),
    VARIABLE(VelocitySetpoint, RON, kVelocity, between(-1e12, 1e12),
             "velocity/speed setpoint that is output (to the drive)"),
    VARIABLE(StatusPositioning.Distance, RON, kPosition, between(-1e12, 1e12),
             "distance to the target position"),
    VARIABLE(StatusPositioning.TargetPosition, RON, kPosition, between(-1e12, 1e12), "target position"),
    VARIABLE(StatusPositioning.TargetPositionModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "number of modulo cycles to the target position for positioning motions"),
    VARIABLE(StatusPositioning.FollowingError, RON, kPosition, between(-1e12, 1e12),
             "current following error"),
    VARIABLE(StatusPositioning.SetpointExecutionTime, RON, kSeconds, between(0.0, 1e12),
             "setpoint execution time of the axis (results from T_Ipo, T_vtc or 1/kv, T_Send and T_O of the "
             "axis)"),
    VARIABLE(
        StatusPositioning.SuperimposedDistance, RON, kPosition, between(0.0, 1e12),
        "distance travelled by superimposed motion; reset when base and superimposed motion are complete",
        .later = true),
    VARIABLE(StatusDrive.Disabled, RON, kNone, kAny, "drive switched off", .choices = kStatusDriveDisabled),
    VARIABLE(StatusDrive.InOperation, RON, kNone, kAny, "operational status of the drive",
             .choices = kStatusDriveInOperation),
    VARIABLE(StatusDrive.CommunicationOK, RON, kNone, kAny,
             "cyclic bus communication between controller and drive", .choices = kStatusDriveCommunicationOK),
    VARIABLE(StatusDrive.Error, RON, kNone, kAny, "drive error", .choices = kStatusDriveError),
    VARIABLE(StatusDrive.AdaptionState, RON, kNone, between(0.0, 4.0),
             "status of the automatic transfer of the drive parameters", .choices = kStatusDriveAdaptionState,
             .later = true),
    VARIABLE(StatusServo.BalancedPosition, RON, kPosition, kAny,
             "position setpoint after the balancing filter"),
    VARIABLE(StatusServo.ControlDifference, RON, kPosition, kAny, "control difference"),
    VARIABLE(StatusServo.PositionAfterDynamicFilter, RON, kPosition, kAny,
             "position setpoint after the dynamic filter"),
    VARIABLE(StatusProvidedLeadingValue.DelayedLeadingValue.Position, RON, kPosition, between(-1e12, 1e12),
             "position", .later = true),
    VARIABLE(StatusProvidedLeadingValue.DelayedLeadingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity", .later = true),
    VARIABLE(StatusProvidedLeadingValue.DelayedLeadingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration", .later = true),
    ELEMENTS(StatusSensor, State, RON, kNone, between(0.0, 2.0), "status of the actual encoder value",
             .choices = kStatusSensorState),
    ELEMENTS(StatusSensor, CommunicationOK, RON, kNone, kAny,
             "cyclic bus communication between controller and encoder",
             .choices = kStatusSensorCommunicationOK, .later = true),
    ELEMENTS(StatusSensor, Error, RON, kNone, kAny, "error in the measuring system",
             .choices = kStatusSensorError, .later = true),
    ELEMENTS(StatusSensor, AbsEncoderOffset, RON, kPosition, kAny,
             "home position offset to the value of an absolute encoder; stored retentively in the CPU"),
    ELEMENTS(StatusSensor, Control, RON, kNone, kAny, "encoder activity", .choices = kStatusSensorControl,
             .later = true),
    ELEMENTS(StatusSensor, Position, RON, kPosition, kAny, "encoder position"),
    ELEMENTS(StatusSensor, Velocity, RON, kVelocity, kAny, "encoder velocity"),
    ELEMENTS(StatusSensor, AdaptionState, RON, kNone, between(0.0, 4.0),
             "status of the automatic transfer of the encoder parameters",
             .choices = kStatusDriveAdaptionState, .later = true),
    ELEMENTS(StatusSensor, ModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "number of modulo cycles", .later = true),
    ELEMENTS(StatusSensor, Adjusted, RON, kNone, between(0.0, 1.0), "homing status of the encoder",
             .choices = kStatusSensorAdjusted),
    VARIABLE(StatusExtrapolation.FilteredPosition, RON, kPosition, between(-1e12, 1e12),
             "position after the position filter"),
    VARIABLE(StatusExtrapolation.FilteredVelocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity after velocity filter and tolerance band"),
    VARIABLE(StatusExtrapolation.ExtrapolatedPosition, RON, kPosition, between(-1e12, 1e12),
             "extrapolated position"),
    VARIABLE(StatusExtrapolation.ExtrapolatedVelocity, RON, kVelocity, between(-1e12, 1e12),
             "extrapolated velocity"),
    VARIABLE(StatusSynchronizedMotion.FunctionState, RON, kNone, between(0.0, 6.0),
             "which synchronous operation function is active",
             .choices = kStatusSynchronizedMotionFunctionState),
    VARIABLE(StatusSynchronizedMotion.WaitingFunctionState, RON, kNone, between(0.0, 5.0),
             "which synchronous operation function is waiting",
             .choices = kStatusSynchronizedMotionWaitingFunctionState),
    VARIABLE(StatusSynchronizedMotion.PhaseShift, RON, kLeading, between(-1e12, 1e12),
             "current absolute leading-value offset of an MC_PhasingAbsolute or MC_PhasingRelative job"),
    VARIABLE(StatusSynchronizedMotion.ActualMaster, RON, kNone, between(0.0, 65535.0),
             "number of the technology data block of the leading axis in use; shown from the start of a "
             "synchronous operation job",
             .choices = kStatusSynchronizedMotionActualMaster),
    VARIABLE(StatusSynchronizedMotion.ActualCam, RON, kNone, between(0.0, 65535.0),
             "cam currently used for camming", .later = true),
    VARIABLE(StatusSynchronizedMotion.MasterOffset, RON, kLeading, between(-1e12, 1e12),
             "current offset of the leading-value range of the cam, from an MC_CamIn job", .later = true),
    VARIABLE(StatusSynchronizedMotion.MasterScaling, RON, kNone, between(-1e12, 1e12),
             "current scaling of the leading-value range of the cam, from an MC_CamIn job", .later = true),
    VARIABLE(StatusSynchronizedMotion.SlaveOffset, RON, kPosition, between(-1e12, 1e12),
             "current offset of the following-value range of the cam, from an MC_CamIn job", .later = true),
    VARIABLE(StatusSynchronizedMotion.SlaveScaling, RON, kNone, between(-1e12, 1e12),
             "current scaling of the following-value range of the cam, from an MC_CamIn job", .later = true),
    VARIABLE(StatusSynchronizedMotion.Offset, RON, kPosition, between(-1e12, 1e12),
             "following-value offset in effect, including SlaveOffset of a cam job"),
    VARIABLE(StatusSynchronizedMotion.EffectiveLeadingValue.Position, RON, kLeading, between(-1e12, 1e12),
             "position"),
    VARIABLE(StatusSynchronizedMotion.EffectiveLeadingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    VARIABLE(StatusSynchronizedMotion.EffectiveLeadingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    VARIABLE(StatusSynchronizedMotion.FunctionLeadingValue.Position, RON, kLeading, between(-1e12, 1e12),
             "position"),
    VARIABLE(StatusSynchronizedMotion.FunctionFollowingValue.Position, RON, kPosition, between(-1e12, 1e12),
             "position"),
    VARIABLE(StatusSynchronizedMotion.FunctionFollowingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    VARIABLE(StatusSynchronizedMotion.FunctionFollowingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    VARIABLE(StatusSynchronizedMotion.StatusWord, RON, kNone, kAny,
             "status information of synchronous operation", .bits = &kSynchronizedMotionBitNames),
    VARIABLE(StatusKinematicsMotion, RON, kNone, kAny, "status information of the technology object",
             .bits = &kKinematicsMotionBitNames, .later = true),
    VARIABLE(StatusTorqueData.CommandAdditiveTorqueActive, RON, kNone, between(0.0, 1.0),
             "additive setpoint torque", .choices = kStatusTorqueDataCommandAdditiveTorqueActive,
             .later = true),
    VARIABLE(StatusTorqueData.CommandTorqueRangeActive, RON, kNone, between(0.0, 1.0), "torque limits B+, B-",
             .choices = kStatusTorqueDataCommandAdditiveTorqueActive, .later = true),
    VARIABLE(StatusTorqueData.ActualTorque, RON, kTorque, between(-1e12, 1e12), "actual torque of the axis",
             .later = true),
    VARIABLE(StatusMotionIn.FunctionState, RON, kNone, between(0.0, 2.0), "active MotionIn function",
             .choices = kStatusMotionInFunctionState, .later = true),
    VARIABLE(StatusMotionIn.StatusWord, RON, kNone, kAny,
             "status information of MotionIn (no description printed)", .bits = &kMotionInBitNames,
             .later = true),
    VARIABLE(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kStatusBitNames),
    VARIABLE(StatusWord2, RON, kNone, kAny, "status information of the technology object (second word)",
             .bits = &kStatus2BitNames),
    VARIABLE(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kErrorBitNames),
    VARIABLE(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    VARIABLE(ErrorDetail.Reaction, RON, kNone, between(0.0, 5.0), "effective alarm reaction",
             .choices = kErrorDetailReaction),
    VARIABLE(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kWarningBitNames),
};

}  // namespace

std::span<const Variable> status_variables() noexcept {
  return kVariables;
}

}  // namespace lockstep
