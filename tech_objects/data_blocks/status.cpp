/// Declaration of the variables that the runtime computes.
/// @source S7-1500T synchronous operation V7, 13.1
#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"

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

using Data = AxisData;

constexpr Variable kVariables[] = {
    COMPUTED(Position, RON, kPosition, kAny, "setpoint position"),
    COMPUTED(Velocity, RON, kVelocity, kAny, "setpoint velocity / setpoint speed"),
    COMPUTED(ActualPosition, RON, kPosition, kAny, "actual position"),
    COMPUTED(ActualVelocity, RON, kVelocity, kAny, "actual velocity"),
    COMPUTED(ActualSpeed, RON, kSpeed, kAny, "actual speed, content depends on the kind of drive"),
    COMPUTED(Acceleration, RON, kAcceleration, kAny, "setpoint acceleration"),
    COMPUTED(ActualAcceleration, RON, kAcceleration, kAny, "actual acceleration"),
    COMPUTED(OperativeSensor, RON, kNone, between(1.0, 4.0),
             "number of the encoder that is operatively in effect"),
    COMPUTED(ModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "modulo cycle count of the setpoint"),
    COMPUTED(ActualModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "modulo cycle count of the actual value"),
    COMPUTED(VelocitySetpoint, RON, kVelocity, between(-1e12, 1e12),
             "velocity/speed setpoint that is output (to the drive)"),
    COMPUTED(StatusPositioning.Distance, RON, kPosition, between(-1e12, 1e12),
             "distance to the target position"),
    COMPUTED(StatusPositioning.TargetPosition, RON, kPosition, between(-1e12, 1e12), "target position"),
    COMPUTED(StatusPositioning.TargetPositionModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
             "number of modulo cycles to the target position for positioning motions"),
    COMPUTED(StatusPositioning.FollowingError, RON, kPosition, between(-1e12, 1e12),
             "current following error"),
    COMPUTED(StatusPositioning.SetpointExecutionTime, RON, kSeconds, between(0.0, 1e12),
             "setpoint execution time of the axis (results from T_Ipo, T_vtc or 1/kv, T_Send and T_O of the "
             "axis)"),
    COMPUTED(
        StatusPositioning.SuperimposedDistance, RON, kPosition, between(0.0, 1e12),
        "distance travelled by superimposed motion; reset when base and superimposed motion are complete"),
    COMPUTED(StatusDrive.Disabled, RON, kNone, kAny, "drive switched off", .choices = kStatusDriveDisabled),
    COMPUTED(StatusDrive.InOperation, RON, kNone, kAny, "operational status of the drive",
             .choices = kStatusDriveInOperation),
    COMPUTED(StatusDrive.CommunicationOK, RON, kNone, kAny,
             "cyclic bus communication between controller and drive", .choices = kStatusDriveCommunicationOK),
    COMPUTED(StatusDrive.Error, RON, kNone, kAny, "drive error", .choices = kStatusDriveError),
    COMPUTED(StatusDrive.AdaptionState, RON, kNone, between(0.0, 4.0),
             "status of the automatic transfer of the drive parameters", .choices = kStatusDriveAdaptionState,
             .later = true),
    COMPUTED(StatusServo.BalancedPosition, RON, kPosition, kAny,
             "position setpoint after the balancing filter"),
    COMPUTED(StatusServo.ControlDifference, RON, kPosition, kAny, "control difference"),
    COMPUTED(StatusServo.PositionAfterDynamicFilter, RON, kPosition, kAny,
             "position setpoint after the dynamic filter"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Position, RON, kPosition, between(-1e12, 1e12),
             "position"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    COMPUTED(StatusProvidedLeadingValue.DelayedLeadingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    COMPUTED_ELEMENTS(StatusSensor, State, RON, kNone, between(0.0, 2.0),
                      "status of the actual encoder value", .choices = kStatusSensorState),
    COMPUTED_ELEMENTS(StatusSensor, CommunicationOK, RON, kNone, kAny,
                      "cyclic bus communication between controller and encoder",
                      .choices = kStatusSensorCommunicationOK),
    COMPUTED_ELEMENTS(StatusSensor, Error, RON, kNone, kAny, "error in the measuring system",
                      .choices = kStatusSensorError),
    COMPUTED_ELEMENTS(
        StatusSensor, AbsEncoderOffset, RON, kPosition, kAny,
        "home position offset to the value of an absolute encoder; stored retentively in the CPU"),
    COMPUTED_ELEMENTS(StatusSensor, Control, RON, kNone, kAny, "encoder activity",
                      .choices = kStatusSensorControl),
    COMPUTED_ELEMENTS(StatusSensor, Position, RON, kPosition, kAny, "encoder position"),
    COMPUTED_ELEMENTS(StatusSensor, Velocity, RON, kVelocity, kAny, "encoder velocity"),
    COMPUTED_ELEMENTS(StatusSensor, AdaptionState, RON, kNone, between(0.0, 4.0),
                      "status of the automatic transfer of the encoder parameters",
                      .choices = kStatusDriveAdaptionState, .later = true),
    COMPUTED_ELEMENTS(StatusSensor, ModuloCycle, RON, kNone, between(-2147483648.0, 2147483647.0),
                      "number of modulo cycles"),
    COMPUTED_ELEMENTS(StatusSensor, Adjusted, RON, kNone, between(0.0, 1.0), "homing status of the encoder",
                      .choices = kStatusSensorAdjusted),
    COMPUTED(StatusExtrapolation.FilteredPosition, RON, kPosition, between(-1e12, 1e12),
             "position after the position filter"),
    COMPUTED(StatusExtrapolation.FilteredVelocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity after velocity filter and tolerance band"),
    COMPUTED(StatusExtrapolation.ExtrapolatedPosition, RON, kPosition, between(-1e12, 1e12),
             "extrapolated position"),
    COMPUTED(StatusExtrapolation.ExtrapolatedVelocity, RON, kVelocity, between(-1e12, 1e12),
             "extrapolated velocity"),
    COMPUTED(StatusSynchronizedMotion.FunctionState, RON, kNone, between(0.0, 6.0),
             "which synchronous operation function is active",
             .choices = kStatusSynchronizedMotionFunctionState),
    COMPUTED(StatusSynchronizedMotion.WaitingFunctionState, RON, kNone, between(0.0, 5.0),
             "which synchronous operation function is waiting",
             .choices = kStatusSynchronizedMotionWaitingFunctionState),
    COMPUTED(StatusSynchronizedMotion.PhaseShift, RON, kLeading, between(-1e12, 1e12),
             "current absolute leading-value offset of an MC_PhasingAbsolute or MC_PhasingRelative job"),
    COMPUTED(StatusSynchronizedMotion.ActualMaster, RON, kNone, between(0.0, 65535.0),
             "number of the technology data block of the leading axis in use; shown from the start of a "
             "synchronous operation job",
             .choices = kStatusSynchronizedMotionActualMaster),
    COMPUTED(StatusSynchronizedMotion.ActualCam, RON, kNone, between(0.0, 65535.0),
             "cam currently used for camming"),
    COMPUTED(StatusSynchronizedMotion.MasterOffset, RON, kLeading, between(-1e12, 1e12),
             "current offset of the leading-value range of the cam, from an MC_CamIn job"),
    COMPUTED(StatusSynchronizedMotion.MasterScaling, RON, kNone, between(-1e12, 1e12),
             "current scaling of the leading-value range of the cam, from an MC_CamIn job"),
    COMPUTED(StatusSynchronizedMotion.SlaveOffset, RON, kPosition, between(-1e12, 1e12),
             "current offset of the following-value range of the cam, from an MC_CamIn job"),
    COMPUTED(StatusSynchronizedMotion.SlaveScaling, RON, kNone, between(-1e12, 1e12),
             "current scaling of the following-value range of the cam, from an MC_CamIn job"),
    COMPUTED(StatusSynchronizedMotion.Offset, RON, kPosition, between(-1e12, 1e12),
             "following-value offset in effect, including SlaveOffset of a cam job"),
    COMPUTED(StatusSynchronizedMotion.EffectiveLeadingValue.Position, RON, kLeading, between(-1e12, 1e12),
             "position"),
    COMPUTED(StatusSynchronizedMotion.EffectiveLeadingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    COMPUTED(StatusSynchronizedMotion.EffectiveLeadingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    COMPUTED(StatusSynchronizedMotion.FunctionLeadingValue.Position, RON, kLeading, between(-1e12, 1e12),
             "position"),
    COMPUTED(StatusSynchronizedMotion.FunctionFollowingValue.Position, RON, kPosition, between(-1e12, 1e12),
             "position"),
    COMPUTED(StatusSynchronizedMotion.FunctionFollowingValue.Velocity, RON, kVelocity, between(-1e12, 1e12),
             "velocity"),
    COMPUTED(StatusSynchronizedMotion.FunctionFollowingValue.Acceleration, RON, kAcceleration,
             between(-1e12, 1e12), "acceleration"),
    COMPUTED(StatusSynchronizedMotion.StatusWord, RON, kNone, kAny,
             "status information of synchronous operation", .bits = &kSynchronizedMotionBitNames),
    COMPUTED(StatusKinematicsMotion, RON, kNone, kAny, "status information of the technology object",
             .bits = &kKinematicsMotionBitNames, .later = true),
    COMPUTED(StatusTorqueData.CommandAdditiveTorqueActive, RON, kNone, between(0.0, 1.0),
             "additive setpoint torque", .choices = kStatusTorqueDataCommandAdditiveTorqueActive),
    COMPUTED(StatusTorqueData.CommandTorqueRangeActive, RON, kNone, between(0.0, 1.0), "torque limits B+, B-",
             .choices = kStatusTorqueDataCommandAdditiveTorqueActive),
    COMPUTED(StatusTorqueData.ActualTorque, RON, kTorque, between(-1e12, 1e12), "actual torque of the axis"),
    COMPUTED(StatusMotionIn.FunctionState, RON, kNone, between(0.0, 2.0), "active MotionIn function",
             .choices = kStatusMotionInFunctionState),
    COMPUTED(StatusMotionIn.StatusWord, RON, kNone, kAny,
             "status information of MotionIn (no description printed)", .bits = &kMotionInBitNames),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kStatusBitNames),
    COMPUTED(StatusWord2, RON, kNone, kAny, "status information of the technology object (second word)",
             .bits = &kStatus2BitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kErrorBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 5.0), "effective alarm reaction",
             .choices = kErrorDetailReaction),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kWarningBitNames),
};

}  // namespace

std::span<const Variable> axis_status_variables() noexcept {
  return kVariables;
}

}  // namespace lockstep
