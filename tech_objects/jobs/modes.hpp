/// What the numbers on the pins of synchronous jobs stand for.
/// @source S7-1500T synchronous operation V7, 12.1
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Pin SyncProfileReference of MC_GearInPos (0, 1, 3) and MC_CamIn.
enum class SyncProfileReference : DINT {
  kDynamics = 0,             ///< with the dynamics of the job
  kAhead = 1,                ///< over the leading distance before the synchronous position
  kDirect = 2,               ///< the positions at hand belong together
  kSubsequent = 3,           ///< over the leading distance from the synchronous position on
  kSubsequentFromHere = 4,   ///< … from the present position on
  kAtCamEnd = 5,             ///< at the end of the running cam
  kAheadFromHere = 6         ///< over the leading distance from here on; the cam lies at its end
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
