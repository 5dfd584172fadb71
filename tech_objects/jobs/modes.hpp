/// Published values of the pins that choose a mode or a direction. They compare with the pins' own type.
/// @source S7-1500T synchronous operation V7, 12.1, 12.2; S7-1500T axis functions
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// MC_Power.StartMode.
enum StartMode : DINT { kStartWithoutPositionControl = 0, kStartWithPositionControl = 1 };

/// MC_Power.StopMode.
enum PowerStopMode : INT {
  kPowerEmergencyRamp = 0,
  kPowerQuickStop = 1,
  kPowerMaximumDynamics = 2,
  kPowerCoastDown = 3
};

/// MC_Stop.Mode.
enum StopMode : DINT { kStopEmergencyRamp = 0, kStopMaximumDynamics = 2, kStopGivenDynamics = 3 };

/// MC_Reset.Restart as a job has it.
enum ResetMode : DINT { kAcknowledge = 0, kRestart = 1 };

/// Direction of MC_MoveAbsolute and others.
enum Direction : DINT { kPositiveDirection = 1, kNegativeDirection = 2, kShortestDirection = 3 };

/// MC_Home.Mode.
enum HomeMode : DINT {
  kHomeDirectAbsolute = 0,
  kHomeDirectRelative = 1,
  kHomePassive = 2,  ///< HomingDone stays until the mark
  kHomeActive = 3,
  kHomeActiveConfigured = 5,    ///< to Homing.HomePosition
  kAdjustAbsoluteRelative = 6,  ///< absolute encoder, by a distance
  kAdjustAbsolute = 7,          ///< absolute encoder, to a position
  kHomePassiveResetting = 8,    ///< HomingDone falls at the begin
  kHomeCancelPassive = 9,
  kHomePassiveConfigured = 10,  ///< to Homing.HomePosition
  kHomeSetpoint = 11,
  kHomeSetpointRelative = 12,
  kAdjustIncremental = 13
};

/// MC_PhasingAbsolute and others, MC_GearInPos, MC_CamIn: SyncProfileReference, ProfileReference.
enum ProfileReference : DINT {
  kProfileInTime = 0,        ///< by dynamic values
  kProfileOverDistance = 1,  ///< over a distance of the leading value
};

}  // namespace lockstep
