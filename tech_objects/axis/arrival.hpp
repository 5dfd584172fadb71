/// Whether a positioning, or a stop, has arrived.
/// @source S7-1500T axis functions, positioning monitoring
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// Counts the ticks since the setpoint has reached its target, and those within the window. Thread: the
/// cycle.
class Arrival {
 public:
  enum class Verdict : std::uint8_t { in_progress, arrived, missed };

  /// @param period of the interpolator [s]
  void configure(double period) noexcept { period_ = period; }
  /// Whether the position was in the window at the last look.
  bool in_window() const noexcept { return in_window_ > 0; }
  /// A motion begins.
  void begin() noexcept { in_window_ = since_target_ = 0; }

  /// Each tick from the target on. Arrived once the actual position has stayed in the window for the dwell
  /// time; missed if it does not come there within the tolerance time, or leaves it within the dwell time.
  /// @param distance of the actual position from the target [u] ≥ 0  @param monitored whether it may be
  /// missed
  Verdict watch_position(double distance, const TO_Struct_PositionMonitoring& settings,
                         bool monitored) noexcept {
    ++since_target_;
    if (distance > settings.Window && in_window_ > 0 && monitored) return Verdict::missed;
    in_window_ = distance <= settings.Window ? in_window_ + 1 : 0;
    if (in_window_ > ticks_of(settings.MinDwellTime)) return Verdict::arrived;
    const bool late = in_window_ == 0 && since_target_ > ticks_of(settings.ToleranceTime);
    return late && monitored ? Verdict::missed : Verdict::in_progress;
  }

  /// Each tick from the end of a stop on, where the velocity counts. @param dwell_time [s]; 0: arrived as
  /// soon as the axis stands
  Verdict watch_rest(bool stands, bool dwells, double dwell_time) noexcept {
    in_window_ = stands ? in_window_ + 1 : 0;
    const bool arrived = stands && !(dwells && in_window_ <= ticks_of(dwell_time));
    return arrived ? Verdict::arrived : Verdict::in_progress;
  }

 private:
  std::int64_t ticks_of(double seconds) const noexcept {
    return static_cast<std::int64_t>(std::ceil(seconds / period_ - 1e-9));
  }

  double period_ = 0.001;  // [s]
  std::int64_t in_window_ = 0;
  std::int64_t since_target_ = 0;
};

}  // namespace lockstep
