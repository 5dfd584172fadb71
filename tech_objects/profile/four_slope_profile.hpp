/// Motion of a counted axis within a velocity, an acceleration, a deceleration and four slopes between them:
/// to a velocity or to a position, from any state. A slope of 0 is a jump, so a trapezoid is the case of four
/// zeros. Time in ms, positions in any unit.
/// @source MCO 305 Design Guide, limited jerk; RAMPTYPE
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lockstep {

class FourSlopePlan;

/// What a motion may do, in both directions.
struct FourSlopeLimits {
  double velocity = 0.0;      ///< [u/ms] ≥ 0
  double acceleration = 1.0;  ///< [u/ms²] > 0, of what becomes faster
  double deceleration = 1.0;  ///< [u/ms²] > 0, of what becomes slower
  /// [ms³/u] ≥ 0, the inverse of the jerks: acceleration rises, falls, deceleration rises, falls. 0: at once.
  std::array<double, 4> slopes{};
  bool sinusoidal = false;  ///< the acceleration of a ramp is a half sine; needs slopes of 0
  bool reverses = true;     ///< false: the velocity does not become negative
};

/// Where a motion is.
struct FourSlopeState {
  double position = 0.0;      ///< [u]
  double velocity = 0.0;      ///< [u/ms]
  double acceleration = 0.0;  ///< [u/ms²]
};

/// What is going on, in the numbers of SYSVAR 4275.
enum class SlopePhase : std::uint8_t {
  acceleration_rises = 1,
  acceleration = 2,
  acceleration_falls = 3,
  constant = 4,
  deceleration_rises = 5,
  deceleration = 6,
  deceleration_falls = 7,
  end = 8,
  start = 9,
  acceleration_too_high = 10,
  acceleration_too_low = 11,
  velocity_too_high_rises = 12,
  velocity_too_high = 13,
  velocity_too_high_falls = 14,
  reversal = 15
};

/// Neither allocates nor throws; a plan is made at once, in bounded time.
class FourSlopeProfile {
 public:
  /// Stands at a position.
  void stand(double position) noexcept;
  /// Is where somebody else leads it, until it is told to move by itself.
  void lead(const FourSlopeState& to) noexcept {
    count_ = current_ = 0;
    now_ = to;
    led_ = true;
    phase_ = SlopePhase::constant;
  }
  /// From a state to a velocity, cut to the limits, which is then kept.
  void to_velocity(const FourSlopeState& from, double velocity, const FourSlopeLimits& limits) noexcept;
  /// From a state to rest at a target, which is met exactly.
  void to_position(const FourSlopeState& from, double target, const FourSlopeLimits& limits) noexcept;

  /// Goes on by some time [ms] ≥ 0.
  const FourSlopeState& step(double time) noexcept {
    if (phase_ == SlopePhase::end) return now_;  // it stands
    if (over()) return keep_velocity(time);
    time_ += time;
    if (!straight_ || time_ >= segment_.duration) return go_on();
    now_.position = origin_ + segment_.begin.position + time_ * segment_.begin.velocity;
    return now_;
  }
  const FourSlopeState& state() const noexcept { return now_; }
  /// Whether the end is reached: at rest, or at the velocity.
  bool over() const noexcept { return current_ == count_; }
  SlopePhase phase() const noexcept { return phase_; }

  /// Length of a stop from a velocity and an acceleration, signed [u].
  static double stop_path(double velocity, double acceleration, const FourSlopeLimits& limits) noexcept;

  static constexpr std::size_t kMaximumSegments = 24;

 private:
  friend class FourSlopePlan;
  struct Segment {
    FourSlopeState begin;
    double duration = 0.0;
    double jerk = 0.0;
    SlopePhase phase = SlopePhase::end;
  };

  void begin(const FourSlopeState& from, const FourSlopeLimits& limits) noexcept;
  FourSlopeState at_half_sine(const Segment& segment, double time) const noexcept;
  /// Of the plan that has been made in `segments_`.
  void follow(const FourSlopePlan& plan) noexcept;
  void move_along() noexcept;
  const FourSlopeState& go_on() noexcept;
  /// At the end. By parts: a state that is copied as a whole waits for its position to be written.
  const FourSlopeState& keep_velocity(double time) noexcept {
    if (led_) end_ = now_;
    led_ = false;
    const double position = end_.position + end_.velocity * time;
    end_.position = now_.position = position;
    now_.velocity = end_.velocity;
    now_.acceleration = end_.acceleration;
    phase_ = end_.velocity == 0.0 ? SlopePhase::end : SlopePhase::constant;
    return now_;
  }

  // For the cache: what one that stands is asked for, then what a step along a segment needs.
  SlopePhase phase_ = SlopePhase::end;
  bool sinusoidal_ = false;
  bool straight_ = false;  // along the current segment only the position changes any more
  std::uint8_t count_ = 0, current_ = 0;
  bool led_ = false;  // by the last call: `end_` is `now_`
  FourSlopeState now_{};
  double time_ = 0.0;    // in the current segment
  double origin_ = 0.0;  // positions of the segments count from there
  Segment segment_{};    // the current one
  FourSlopeState end_{};
  std::array<Segment, kMaximumSegments> segments_{};
};

}  // namespace lockstep
