/// The V/A limiter: a demand becomes a motion of limited velocity and acceleration.
/// @source LinMot release 1.3 addendum, 6.4 (Filter Parameter), 7.3
#pragma once

#include <cstddef>
#include <cstdint>

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/profile/profile.hpp"

namespace lockstep::linmot {

/// Velocity [mm/s] and acceleration [mm/s²], both > 0.
struct Limits {
  double velocity = 781.25;
  double acceleration = 30517.578125;
  bool operator==(const Limits&) const = default;
};

/// Trapezoids, planned anew when demand or limits change, from the present setpoint and its velocity, and
/// evaluated in closed form. The cycle's thread.
class Limiter {
 public:
  /// @param cycle [s] > 0
  void configure(double cycle) noexcept { cycle_ = cycle; }
  /// Rests at a position, or goes on from there with a velocity.
  void begin(double position, double velocity = 0.0) noexcept;
  void go_to(double target, const Limits& limits) noexcept;
  /// Brakes with an acceleration; the target is where it then stands.
  void stop(double acceleration) noexcept;
  /// Other limits for the motion that is under way.
  void limit(const Limits& limits) noexcept;
  /// Turns to a velocity [mm/s], and goes on with it.
  void run(double velocity, const Limits& limits) noexcept;

  /// The setpoint of a control cycle, which is then over.
  LoopSetpoint step() noexcept {
    if (resting_) return {target_, 0.0, 0.0};
    const double time = static_cast<double>(cycles_) * cycle_;
    const bool over = time >= profile_.duration();
    if (over && !endless_) {
      resting_ = true;
      return {target_, 0.0, 0.0};
    }
    const MotionState now = over || cycles_ == 0 ? profile_.at(time) : phase_at(time).at(time);
    ++cycles_;
    return {now.position, now.velocity, now.acceleration};
  }
  bool at_end() const noexcept { return resting_; }
  double target() const noexcept { return target_; }                                 ///< [mm]
  double duration() const noexcept { return resting_ ? 0.0 : profile_.duration(); }  ///< [s] of the motion

 private:
  MotionState state() const noexcept;
  void restart() noexcept {
    cycles_ = 0;
    phase_ = 0;
  }
  /// Time only goes on: the phase is that of the last cycle, or a later one.
  const Profile::Phase& phase_at(double time) noexcept {
    const auto phases = profile_.phases();
    while (phase_ + 1 < phases.size() && time >= phases[phase_ + 1].begin) ++phase_;
    return phases[phase_];
  }

  Profile profile_;
  std::int64_t cycles_ = 0;  // since its begin
  std::size_t phase_ = 0;    // of the last cycle
  double cycle_ = 1e-4;
  double target_ = 0.0;
  Limits limits_;
  bool resting_ = true;
  bool endless_ = false;  // it is a velocity that is gone to
};

}  // namespace lockstep::linmot
