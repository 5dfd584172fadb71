/// Backlash compensation of an axis with a drive.
/// @source S7-1500T axis functions, backlash compensation; synchronous operation V7, 13.1.12
/// (Sensor.Backlash)
#pragma once

#include <cstdint>

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// The play between motor and load: when the setpoint turns round, the motor passes it before the load
/// follows. Meanwhile the actual position stands. The cycle's thread.
class Backlash {
 public:
  /// One servo cycle while the encoder of the motor controls the position.
  /// @param velocity of the setpoint [u/s]  @param cycle of the servo [s]
  /// @return velocity that is added to pass the play [u/s]
  double pass(const TO_Struct_Backlash& settings, double velocity, double cycle) noexcept;

  /// Whether the play was being passed in the last cycle.
  bool passing() const noexcept { return passing_; }
  /// Distance that the motor has made and the load has not [u]; 0 while compensation is off.
  double passed(const TO_Struct_Backlash& settings) const noexcept { return settings.Enable ? passed_ : 0.0; }

 private:
  double passed_ = 0.0;        // 0, or ∓Size, or on the way there [u]
  std::int8_t direction_ = 0;  // of the last motion; 0: none yet
  bool passing_ = false;
};

}  // namespace lockstep
