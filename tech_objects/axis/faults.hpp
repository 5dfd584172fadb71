/// What goes wrong at drive and encoder of an axis: alarms and their acknowledgement.
/// @source S7-1500T alarms 411, 421, 431; PROFIdrive state machine
#pragma once

#include "tech_objects/axis/attention.hpp"
#include "tech_objects/axis/reactions.hpp"
#include "tech_objects/axis/sensors.hpp"

namespace lockstep {

/// The drive, its encoder, and whom their failure concerns.
struct FaultParts {
  AxisData& data;
  const PowerRequest& power;
  const PowerState& power_state_;
  const std::unique_ptr<Drive>& drive_;
  bool& drive_in_trouble_;
  const AxisPosition& actual_;
  Encoders& encoders_;
  bool& homed_;
  Attention& attention;
  DriveControl& drive_control_;
  SensorOrders& sensors_;
  Reactions& reactions_;
};

/// Thread: the cycle.
class DriveFaults : private FaultParts {
 public:
  explicit DriveFaults(const FaultParts& parts) noexcept : FaultParts(parts) {}

  /// Each servo cycle in which the drive reports something wrong, and the one in which that ends.
  void watch(const DriveActual& now) noexcept;
  /// MC_Reset at the drive. What is still wrong is told again at once.
  void acknowledge() noexcept;

 private:
  void raise_alarms(const DriveActual& now) noexcept;
  void lose_sensor() noexcept;
  void regain_sensor() noexcept;
};

}  // namespace lockstep
