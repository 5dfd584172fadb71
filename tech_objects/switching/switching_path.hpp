/// The path of an axis or encoder through a servo cycle, as output cams see it.
/// @source S7-1500/S7-1500T measuring input and output cam functions, output cam
#pragma once

#include <array>
#include <cstdint>

#include "tech_objects/objects/load_position.hpp"

namespace lockstep {

/// A straight piece of path.
struct Stretch {
  double from_time = 0.0;      ///< [s] since the start of the run
  double to_time = 0.0;        ///< [s]
  double from = 0.0;           ///< [u] on a line that is continuous within the stretch
  double to = 0.0;             ///< [u]
  double from_velocity = 0.0;  ///< [u/s]
  double to_velocity = 0.0;    ///< [u/s]

  /// The part between two places of it, 0 to 1.
  Stretch part(double begin, double end) const noexcept;
  Stretch shifted(double by) const noexcept;
};

/// Position, velocity and direction in servo cycles: where the path of each began and ended, and from where
/// on it counts after a reversal. Thread: the cycle.
class SwitchingPath {
 public:
  /// @param actual whether the actual position counts, else the setpoint
  void watch(const LeadingObject& object, bool actual, double servo_period, int ratio) noexcept;

  /// Once in each servo tick, behind the object's own.
  /// @param now of the tick [ns]  @param hysteresis [u] ≥ 0
  void servo(std::int64_t now, double hysteresis) noexcept;
  void interpolated() noexcept { load_.interpolated(); }
  /// The next servo tick has no path behind it: where it is found is where it begins.
  void begin_anew() noexcept { begun_ = false; }

  /// Whether there is a path behind this tick.
  bool moved() const noexcept { return stretched_; }
  /// The path of this servo cycle; its end is the position as it is called now.
  const Stretch& stretch() const noexcept { return stretch_; }
  /// By how much positions are called otherwise than at the end of the cycle before [u]: homing, and the wrap
  /// of a ring.
  double renamed() const noexcept { return renamed_; }
  /// Those whole turns of a ring are left out.
  double jumped() const noexcept { return jumped_; }
  double position() const noexcept { return stretch_.to; }   ///< [u]
  double time() const noexcept { return stretch_.to_time; }  ///< of this tick [s]
  /// 1, -1; 0: it has not moved yet.
  int direction() const noexcept { return direction_; }
  /// Part of the cycle from which on positions count; more than 1: held within the hysteresis.
  double free_from() const noexcept { return free_from_; }
  Modulo modulo() const noexcept { return object_->modulo(); }

 private:
  double velocity(std::int64_t now) noexcept;
  void connect(double before, double distance) noexcept;
  void turn(double distance, double hysteresis) noexcept;

  struct Sample {
    std::int64_t time;
    DoubleDouble line;
  };
  static constexpr std::size_t kSamples = 33;  // an interpolator cycle of 32 servo cycles

  const LeadingObject* object_ = nullptr;
  std::size_t ratio_ = 1;
  LoadPosition load_;
  bool begun_ = false;
  bool stretched_ = false;
  Stretch stretch_;
  double renamed_ = 0.0;
  double jumped_ = 0.0;
  int direction_ = 0;
  double back_ = 0.0;  // from the furthest place in the direction [u]; without direction: the distance made
  double free_from_ = 0.0;
  std::array<Sample, kSamples> samples_{};
  std::size_t count_ = 0;
};

}  // namespace lockstep
