/// The search for the time-optimal profile among the motions that can be one.
///
/// The quickest change to the end velocity covers some distance. If the target lies further in direction `s`,
/// the motion gains distance by going more in direction s, in this order, as more distance is wanted:
///   1. ease: a present acceleration against s is reduced for a while before the change goes on;
///   2. hold: the change is split in two at a velocity where the acceleration is 0, if it starts
///   beyond a limit;
///   3. peak: the velocity goes to a peak in direction s beyond both ends, and from there to the end
///   velocity;
///   4. cruise: with the peak at the limit, it stays there.
/// Duration grows along this order, so the first motion that fits is the quickest. The distance may fall
/// before it grows, but it passes the wanted distance once, so that bracketing finds it; while easing it may
/// do so more often, and the turning points are looked at.
#pragma once

#include <array>

#include "tech_objects/profile/builder.hpp"
#include "tech_objects/profile/profile.hpp"
#include "tech_objects/profile/rise.hpp"

namespace lockstep {

/// Plans one profile. Inputs are valid. All methods terminate after a bounded number of steps.
class PositionPlanner {
 public:
  PositionPlanner(const MotionState& start, double target_velocity, const ProfileLimits& limits) noexcept;

  /// The quickest change of velocity.
  void plan_direct(Profile& out) const noexcept;

  /// The quickest motion to a position.
  void plan_to(double target_position, Profile& out) const noexcept;

 private:
  /// Everything as seen in one direction: velocities and distances with its sign.
  struct View {
    double sign;
    double v0, a0;
    double stop;   // velocity at which a0 has fallen to 0
    double end;    // target velocity
    double limit;  // maximum velocity
  };
  /// Where `ease` begins, seen in the direction of the change: the start, or where it comes inside the
  /// limits.
  struct Entry {
    RisePart part;    // from the start (or from `stop`) to here; without duration if it is the start
    double v, a;      // a > 0, or nothing can be eased
    double distance;  // from the start to here
    double lowest;    // velocity at which the acceleration is 0 if it falls from here
  };
  /// Two rises that meet at a velocity where the acceleration is 0.
  struct Pair {
    Rise first;
    Rise second;  // of a peak: run backwards
    double distance;
  };

  /// Where the peak is looked for, as velocity above its base.
  struct PeakSearch {
    double low, high;
    double over;   // the next to try
    bool by_root;  // the distance is smooth in √over
  };

  View view(double sign) const noexcept;
  double release_distance(const View& view) const noexcept;
  Rise climb(const View& view, double to, double excess) const noexcept;
  void build_climb(ProfileBuilder& builder, const View& view, const Rise& rise) const noexcept;

  Pair peak(const View& view, double base, double over) const noexcept;
  double rounding(const View& direct, const Rise& rise, double target) const noexcept;
  double solve_peak(const View& view, double base, double distance, Pair& pair) const noexcept;
  void refine_peak(const View& view, double base, double distance, PeakSearch search,
                   Pair& pair) const noexcept;
  double gain(const Pair& pair, double top) const noexcept;
  double first_guess(double base, double missing, const Pair& pair, double maximum) const noexcept;
  void build_peak(const View& view, const Pair& pair, double cruise, double target,
                  Profile& out) const noexcept;

  Entry entry(const View& down) const noexcept;
  Rise eased(const View& down, const Entry& from, double reduction, double& distance) const noexcept;
  std::array<double, 5> turning_reductions(const Entry& from, double end) const noexcept;
  bool solve_ease(const View& down, const Entry& from, double distance, double& reduction) const noexcept;
  void build_eased(const View& down, const Entry& from, double reduction, double target,
                   Profile& out) const noexcept;
  Pair hold(const View& down, double at, double excess_to, double excess_from) const noexcept;
  bool solve_hold(const View& down, double first, double last, double distance, Pair& pair) const noexcept;
  void build_hold(const View& down, const Pair& pair, double cruise, double target,
                  Profile& out) const noexcept;
  void plan_below(const View& up, double distance, double target, Profile& out) const noexcept;

  MotionState start_;
  double target_velocity_;
  double limit_up_, limit_down_;
  RiseLimits rise_limits_;
  JerkLimit jerk_;
};

}  // namespace lockstep
