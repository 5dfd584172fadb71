/// Numbers that variables of the data blocks have, by what they mean. The variables themselves are of the
/// published types, so that any number may be written to them; the declarations say what is permitted.
/// @source S7-1500T synchronous operation V7, 13.1; S7-1500T axis functions
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Actor.MotorType.
struct MotorType {
  enum : DINT { rotary = 0, linear = 1 };
};

/// Properties.MotionType.
struct MotionType {
  enum : DINT { linear = 0, rotary = 1 };
};

/// VirtualAxis.Mode, Simulation.Mode.
struct Activation {
  enum : UDINT { not_active = 0, active = 1 };
};

/// Sensor[].Type.
struct SensorType {
  enum : DINT { INCREMENTAL = 0, ABSOLUTE = 1, CYCLIC_ABSOLUTE = 2 };
};

/// Sensor[].Backlash.DirectionAbsoluteHoming.
struct BacklashDirection {
  enum : DINT { positive = 0, negative = 1 };
};

/// StatusSensor[].State, as far as it is in use.
struct SensorState {
  enum : DINT { not_valid = 0, valid = 2 };
};

/// TorqueLimiting.LimitBase.
struct LimitBase {
  enum : DINT { motor_side = 0, load_side = 1 };
};

/// TorqueLimiting.PositionBasedMonitors.
struct PositionBasedMonitors {
  enum : DINT { deactivated = 0, activated = 1 };
};

/// Sensor[].ActiveHoming.Direction.
struct HomingDirection {
  enum : DINT { positive = 0, negative = 1 };
};

/// Extrapolation.Settings.ExtrapolatedVelocityMode.
struct ExtrapolatedVelocityMode {
  enum : DINT { filtered = 0, by_differentiation = 1 };
};

/// PositionControl.VelocityModePowerOn.
struct VelocityModePowerOn {
  enum : DINT { ramp = 0, at_once = 1 };
};

/// PositionLimits_SW.LimitReachedBehavior.
struct LimitReachedBehavior {
  enum : DINT { maximum_dynamics = 0, current_dynamics = 1 };
};

/// PositionLimits_SW.LimitExceededBehavior.
struct LimitExceededBehavior {
  enum : DINT { lock_axis = 0, emergency_stop = 1 };
};

/// PositionLimits_HW.Mode.
struct LimitSwitchMode {
  enum : DINT { cannot_be_overrun = 0, can_be_overrun = 1 };
};

/// PositionLimits_HW.ApproachBehavior.
struct ApproachBehavior {
  enum : DINT { lock_axis = 0, keep_enable = 1 };
};

/// SetpointFilter.DynamicFilter.Mode.
struct DynamicFilterMode {
  enum : DINT { not_effective = 0, filter_and_dead_time = 1 };
};

/// Parameter.PositionType of output cams and cam tracks.
struct PositionType {
  enum : DINT { setpoint = 0, actual_position = 1 };
};

/// Parameter.OutputCamType.
struct OutputCamType {
  enum : DINT { distance = 0, time = 1, switching = 2 };
};

/// Parameter.CamTrackType.
struct CamTrackType {
  enum : DINT { distance = 0, time = 1 };
};

/// Parameter.MeasuringInputType.
struct MeasuringInputType {
  enum : DINT { time_stamp = 0, telegram = 1, other_input = 2 };
};

}  // namespace lockstep
