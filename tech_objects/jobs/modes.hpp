/// Numbers of the pins that choose a mode or a direction, by what they mean. The pins themselves are of the
/// published types; their declarations say what is permitted.
/// @source S7-1500T synchronous operation V7, 12.1, 12.2; S7-1500T axis functions
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Whether the number on a pin is that of a mode, profile or direction.
template <class Mode>
constexpr bool chooses(DINT pin, Mode mode) noexcept {
  return pin == static_cast<DINT>(mode);
}

/// MC_Power, StartMode.
enum class StartMode : DINT { without_position_control = 0, position_control = 1 };

/// MC_Power, StopMode.
enum class PowerStopMode : INT { emergency_ramp = 0, quick_stop = 1, maximum_dynamics = 2, coast_down = 3 };

/// MC_Stop, Mode.
enum class StopMode : DINT { emergency_ramp = 0, maximum_dynamics = 2, given_dynamics = 3 };

/// MC_SetSensor, Mode.
enum class SetSensorMode : DINT {
  switch_aligned = 0,      ///< the actual position goes along
  switch_as_it_is = 1,     ///< the difference becomes a control deviation
  copy_from_axis = 2,      ///< no switch-over
  copy_from_reference = 3  ///< no switch-over
};

/// MC_TorqueLimiting, Mode.
enum class TorqueLimitingMode : DINT { limiting = 0, fixed_stop_detection = 1 };

/// MC_OutputCam, Mode.
enum class OutputCamMode : DINT { normal = 1, inverted = 2, always_on = 3 };

/// MC_CamTrack, Mode.
enum class CamTrackMode : DINT {
  at_once = 0,     ///< changes and the end count at once
  next_track = 1,  ///< changes and the end count when the track is over
  always_on = 2
};

/// MC_MoveAbsolute, MC_MoveVelocity (0: by the sign of the velocity), Direction.
enum class Direction : DINT { positive = 1, negative = 2, shortest = 3 };

/// MC_Home, Mode.
enum class HomeMode : DINT {
  direct_absolute = 0,
  direct_relative = 1,
  passive = 2,  ///< HomingDone stays until the mark
  active = 3,
  active_configured = 5,         ///< to Homing.HomePosition
  adjust_absolute_relative = 6,  ///< an absolute encoder, by a distance
  adjust_absolute = 7,           ///< an absolute encoder, to a position
  passive_resetting = 8,         ///< HomingDone falls at the begin
  cancel_passive = 9,
  passive_configured = 10,  ///< to Homing.HomePosition
  setpoint = 11,
  setpoint_relative = 12,
  adjust_incremental = 13
};

/// MC_MeasuringInput (all), MC_MeasuringInputCyclic (up to `both`), Mode.
enum class MeasuringMode : DINT {
  rising = 0,
  falling = 1,
  both = 2,
  rising_then_falling = 3,
  falling_then_rising = 4
};

/// Pin SyncProfileReference of MC_GearInPos (0, 1, 3) and MC_CamIn.
enum class SyncProfileReference : DINT {
  dynamics = 0,              ///< with the dynamics of the job
  ahead = 1,                 ///< over the leading distance before the synchronous position
  direct = 2,                ///< the positions at hand belong together
  subsequent = 3,            ///< over the leading distance from the synchronous position on
  subsequent_from_here = 4,  ///< over the leading distance from the present position on
  at_cam_end = 5,            ///< at the end of the running cam
  ahead_from_here = 6        ///< over the leading distance from here on; the cam lies at its end
};

/// Pin ProfileReference of MC_Phasing…, MC_Offset….
enum class ShiftProfileReference : DINT {
  dynamics = 0,       ///< with the dynamics of the job
  from_here = 1,      ///< over the leading distance from here on
  from_position = 2,  ///< over the leading distance from a start position on
  cancel_waiting = 5  ///< ends what waits
};

/// Pin SyncProfileReference of MC_GearOut and MC_CamOut.
enum class SyncOutProfileReference : DINT {
  dynamics = 0,       ///< with the dynamics of the job
  over_distance = 1,  ///< over the leading distance
  cancel_waiting = 5  ///< ends what waits
};

/// Pins SyncDirection, SyncOutDirection and Direction of a shift: of the axis, or of the leading value; and
/// Direction of MC_OutputCam.
enum class PublishedDirection : DINT { positive = 1, negative = 2, either = 3 };

/// MC_CopyCamData, Mode.
enum class CamCopyMode : DINT {
  invalidate = 0,  ///< what was in the cam is valid no more
  keep = 1         ///< what was in the cam stays valid
};

/// Pin ApplicationMode of MC_CamIn.
enum class CamApplicationMode : DINT {
  once = 0,     ///< from end to end
  cyclic = 1,   ///< again and again, over the same following values
  appended = 2  ///< again and again, each pass begins where the one before has ended
};

}  // namespace lockstep
