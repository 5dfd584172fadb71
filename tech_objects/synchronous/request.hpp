/// What is asked of a synchronous motion, and why it may be refused.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/cam/motion.hpp"
#include "tech_objects/synchronous/leading_source.hpp"
#include "tech_objects/synchronous/sync_profile.hpp"

namespace lockstep {

/// Numerator / denominator of a gear; the denominator is not 0.
struct GearRatio {
  std::int32_t numerator = 1;
  std::int32_t denominator = 1;

  double rounded() const noexcept {
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  }
  bool operator==(const GearRatio&) const = default;
};

/// Where and how a following axis joins its function.
enum class SyncStartRule : std::uint8_t {
  dynamics,              ///< planned in time, so that it ends in the synchronous position
  ahead,                 ///< over the leading distance before the synchronous position
  direct,                ///< the positions at hand belong together
  subsequent,            ///< over the leading distance behind the synchronous position
  subsequent_from_here,  ///< over the leading distance from here on; the cam lies where its offset has it
  at_cam_end,            ///< where the cam that is followed ends
  ahead_from_here        ///< over the leading distance from here on; the cam is placed at its end
};

/// Why it is refused.
enum class SyncRefusal : std::uint8_t {
  none,
  leading_distance,   ///< too short, or so long that the function is over before
  direction,          ///< the axis, or the function, moves against SyncDirection
  velocity,           ///< the synchronous velocity is beyond that of the request
  leading_scaling,    ///< a pass too short to be told from a step
  following_scaling,  ///< following positions beyond all that an axis can take
  leading_offset,     ///< a synchronous position beyond that
  following_offset,   ///< an offset beyond that
  cam_not_closed,     ///< a cyclic cam whose ends lie apart
  outside_cam,        ///< the synchronous position is none of the cam
  no_cam_followed     ///< there is no cam at whose end it could begin
};

/// A coupling: to what, how it synchronizes, and the function that then holds.
struct CouplingRequest {
  const LeadingSource* source = nullptr;
  Coupling coupling = Coupling::setpoint;
  bool velocity_only = false;  ///< the velocity is followed, whatever the position
  Dynamics dynamics;           ///< of the following axis
  GearRatio ratio;
  const CamFunction* curve = nullptr;  ///< followed in place of a gear; stays as it is meanwhile

  // At positions of both axes.
  SyncStartRule start{};
  SyncDirection direction = SyncDirection::kShortestPath;
  double leading_position = 0.0;    ///< synchronous position [leading u]; of a cam: from its start
  double following_position = 0.0;  ///< synchronous position [u]; not of a cam
  double leading_distance = 0.0;    ///< [leading u] > 0

  // Of a cam.
  CamUse use;
  double leading_offset = 0.0;    ///< [leading u]
  double following_offset = 0.0;  ///< [u]
};

/// Out of a synchronous motion, to rest at a position.
struct LeavingRequest {
  bool over_distance = false;                              ///< over a leading distance, else planned in time
  SyncDirection direction = SyncDirection::kShortestPath;  ///< in which the axis has to move
  double position = 0.0;                                   ///< where it rests [u]
  double distance = 0.0;                                   ///< [leading u] > 0, over a distance
};

}  // namespace lockstep
