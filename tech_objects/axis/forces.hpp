/// Forces of an axis: what the torque blocks want of its drive, and the fixed stop at which it is clamped.
#pragma once

#include <cstdint>
#include <limits>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What MC_TorqueLimiting wants; written by the one instance that has claimed it.
struct TorqueLimitingRequest {
  const void* owner = nullptr;  ///< nullptr: not active
  LREAL limit = -1.0;           ///< < 0: TorqueLimiting.LimitDefaults
  DINT mode{};                  ///< 0 limiting, 1 fixed stop detection
};
/// What MC_TorqueRange wants.
struct TorqueRangeRequest {
  const void* owner = nullptr;
  LREAL lower = -1e12;  ///< at the motor
  LREAL upper = 1e12;
};
/// What MC_TorqueAdditive wants.
struct TorqueAdditiveRequest {
  const void* owner = nullptr;
  LREAL value{};  ///< at the motor
};

/// Seldom of account: kept apart from what an axis touches in every cycle.
struct AxisForces {
  TorqueLimitingRequest limiting;
  TorqueRangeRequest range;
  TorqueAdditiveRequest additive;

  // Written by the axis.
  bool in_limitation = false;
  bool in_clamping = false;    // held at the stop, within Clamping.PositionTolerance
  bool command_shown = false;  // to the drive and in the data block: something that is not the usual
  std::int8_t stop_side = 0;   // in which direction a fixed stop has been found; 0: none
  AxisPosition clamped_at;     // actual position when it was

  bool active() const noexcept {
    return limiting.owner != nullptr || range.owner != nullptr || additive.owner != nullptr;
  }
  bool limited() const noexcept { return limiting.owner != nullptr || range.owner != nullptr; }
};

}  // namespace lockstep
