/// Forces of an axis: what the torque blocks want of its drive.
/// @source S7-1500T axis functions, force and torque limiting, torque data
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

/// What MC_TorqueLimiting wants; written by the one instance that has claimed it.
struct TorqueLimitingRequest {
  const void* owner = nullptr;  ///< nullptr: not active
  LREAL limit = -1.0;           ///< < 0: TorqueLimiting.LimitDefaults
  TorqueLimitingMode mode{};
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

/// The requests of the torque blocks, which write them only when nothing is refused, and what becomes of
/// them. Seldom of account: kept apart from what an axis touches in every cycle. The cycle's thread.
class AxisForces {
 public:
  TorqueLimitingRequest limiting;
  TorqueRangeRequest range;
  TorqueAdditiveRequest additive;

  /// Limiting and range exclude each other; a fixed stop is detected of an enabled axis only.
  ErrorId limiting_refusal(TorqueLimitingMode mode, bool enabled) const noexcept;
  ErrorId range_refusal() const noexcept;

  /// Whether the drive has to be told of something, or that there is nothing any more.
  bool due() const noexcept { return active() || told_; }
  bool limited() const noexcept { return limiting.owner != nullptr || range.owner != nullptr; }
  bool detects_fixed_stop() const noexcept;
  /// Whether what goes by the distance from the setpoint is not watched, since the axis may never get there.
  bool position_monitoring_off(const AxisData& settings) const noexcept;

  /// One interpolator cycle: what the drive is told, in the direction of the axis.
  /// @param enabled whether the axis is: nothing is added while it is not
  TorqueCommand command(const AxisData& settings, bool enabled) noexcept;
  /// @param torque at the motor; without a meaning, if the drive does not tell it or is off
  void watch_limitation(double torque, bool known) noexcept;
  /// Whether the drive makes at least 90 % of the torque that MC_TorqueLimiting permits.
  bool in_limitation() const noexcept { return in_limitation_; }

  /// In StatusWord and StatusTorqueData. @param clamped whether the axis is held at a fixed stop
  void show(AxisData& data, bool clamped) const noexcept;

 private:
  bool active() const noexcept { return limited() || additive.owner != nullptr; }
  double limit_at_motor(const AxisData& settings) const noexcept;
  TorqueBand band(const AxisData& settings) const noexcept;

  bool told_ = false;  // to the drive and in the data block: something that is not the usual
  bool in_limitation_ = false;
  double upper_ = 0.0;  // of the band that the drive has been told last
};

}  // namespace lockstep
