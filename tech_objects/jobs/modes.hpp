/// Numbers of the pins that choose a mode or a direction, by what they mean. The pins themselves are of the
/// published types; their declarations say what is permitted.
/// @source S7-1500T synchronous operation V7, 12.1, 12.2; S7-1500T axis functions
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// MC_Power, StartMode.
struct StartMode {
  enum : DINT { without_position_control = 0, position_control = 1 };
};

/// MC_Power, StopMode.
struct PowerStopMode {
  enum : INT { emergency_ramp = 0, quick_stop = 1, maximum_dynamics = 2, coast_down = 3 };
};

/// MC_Stop, Mode.
struct StopMode {
  enum : DINT { emergency_ramp = 0, maximum_dynamics = 2, given_dynamics = 3 };
};

/// MC_MoveAbsolute, Direction.
struct Direction {
  enum : DINT { positive = 1, negative = 2, shortest = 3 };
};

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

/// SyncProfileReference of couplings, ProfileReference of shifts, as far as they have that in common.
struct ProfileReference {
  enum : DINT {
    in_time = 0,       ///< by dynamic values
    over_distance = 1  ///< over a distance of the leading value
  };
};

/// Pin SyncProfileReference of MC_GearInPos (0, 1, 3) and MC_CamIn.
enum class SyncProfileReference : DINT {
  kDynamics = 0,            ///< with the dynamics of the job
  kAhead = 1,               ///< over the leading distance before the synchronous position
  kDirect = 2,              ///< the positions at hand belong together
  kSubsequent = 3,          ///< over the leading distance from the synchronous position on
  kSubsequentFromHere = 4,  ///< … from the present position on
  kAtCamEnd = 5,            ///< at the end of the running cam
  kAheadFromHere = 6        ///< over the leading distance from here on; the cam lies at its end
};

/// Pin ProfileReference of MC_Phasing…, MC_Offset….
enum class ShiftProfileReference : DINT {
  kDynamics = 0,      ///< with the dynamics of the job
  kFromHere = 1,      ///< over the leading distance from here on
  kFromPosition = 2,  ///< over the leading distance from a start position on
  kCancelWaiting = 5  ///< ends what waits
};

/// Pin SyncProfileReference of MC_GearOut and MC_CamOut.
enum class SyncOutProfileReference : DINT {
  kDynamics = 0,      ///< with the dynamics of the job
  kOverDistance = 1,  ///< over the leading distance
  kCancelWaiting = 5  ///< ends what waits
};

/// Pins SyncDirection, SyncOutDirection and Direction of a shift: of the axis, or of the leading value.
enum class PublishedDirection : DINT { kPositive = 1, kNegative = 2, kEither = 3 };

/// Whether the number of a pin is that value.
template <class Published>
constexpr bool is(DINT number, Published value) noexcept {
  return number == static_cast<DINT>(value);
}

}  // namespace lockstep
