#include "tech_objects/profile/four_slope_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sign_of(double value) noexcept {
  return value < 0.0 ? -1.0 : 1.0;
}

double root(double value) noexcept {
  return value > 0.0 ? std::sqrt(value) : 0.0;
}

// Sums of their series: the same bits on every processor. 0 ≤ x ≤ 1, half a turn.
struct Turn {
  double sine, cosine;
};
Turn half_turn(double x) noexcept {
  const double angle = (x - 0.5) * kPi;  // within a quarter turn of 0
  const double square = angle * angle;
  double sine = 1.0, cosine = 1.0;
  for (int n = 22; n >= 2; n -= 2) {
    cosine = 1.0 - cosine * square / (n * (n - 1));
    sine = 1.0 - sine * square / (n * (n + 1));
  }
  return {cosine, -sine * angle};  // sin(y + π/2) = cos y, cos(y + π/2) = -sin y
}

}  // namespace

/// Puts the segments of a plan one behind the other. Accelerations and velocities are seen in a direction, in
/// which the acceleration is not negative.
class FourSlopePlan {
 public:
  using Segment = FourSlopeProfile::Segment;
  FourSlopePlan(const FourSlopeState& from, const FourSlopeLimits& limits, Segment* segments) noexcept
      : now_(from), limits_(limits), segments_(segments) {}

  const FourSlopeState& now() const noexcept { return now_; }
  std::uint8_t count() const noexcept { return count_; }

  void to_velocity(double wanted) noexcept;
  void keep(double duration, SlopePhase phase) noexcept { add(duration, 0.0, phase); }

 private:
  struct Phases {
    SlopePhase rises, plateau, falls;
  };
  static constexpr Phases kFaster{SlopePhase::acceleration_rises, SlopePhase::acceleration,
                                  SlopePhase::acceleration_falls};
  static constexpr Phases kSlower{SlopePhase::deceleration_rises, SlopePhase::deceleration,
                                  SlopePhase::deceleration_falls};
  static constexpr Phases kTooFast{SlopePhase::velocity_too_high_rises, SlopePhase::velocity_too_high,
                                   SlopePhase::velocity_too_high_falls};

  double velocity() const noexcept { return heading_ * now_.velocity; }
  double acceleration() const noexcept { return heading_ * now_.acceleration; }
  // With which an acceleration falls that was a deceleration: the slower of both, so that a small velocity
  // behind 0 is near to none, and no position lies between them.
  double fall_behind_zero() const noexcept { return std::max(limits_.slopes[1], limits_.slopes[3]); }
  void add(double duration, double jerk, SlopePhase phase) noexcept;
  void change_to(double acceleration, double slope, SlopePhase phase) noexcept;
  void let_fall() noexcept;
  double velocity_after_fall() const noexcept;
  void on_one_side(double wanted, double limit, double rise, double fall, const Phases& phases) noexcept;
  void to_zero(double wanted) noexcept;

  FourSlopeState now_;
  const FourSlopeLimits& limits_;
  Segment* segments_;  // none: only the end is asked for
  std::uint8_t count_ = 0;
  double heading_ = 1.0;
};

void FourSlopePlan::add(double duration, double jerk, SlopePhase phase) noexcept {
  if (!(duration > 0.0)) return;
  if (segments_ != nullptr && count_ < FourSlopeProfile::kMaximumSegments) {
    segments_[count_] = {now_, duration, jerk, phase};
    ++count_;
  }
  const double t = duration;
  now_.position += t * (now_.velocity + t * (now_.acceleration / 2.0 + t * jerk / 6.0));
  now_.velocity += t * (now_.acceleration + t * jerk / 2.0);
  now_.acceleration += t * jerk;
}

/// To an acceleration in the heading.
void FourSlopePlan::change_to(double wanted, double slope, SlopePhase phase) noexcept {
  const double difference = wanted - acceleration();
  if (slope > 0.0) add(std::abs(difference) * slope, heading_ * sign_of(difference) / slope, phase);
  now_.acceleration = heading_ * wanted;
}

/// Where the velocity ends, in the heading, if the acceleration falls to 0 as fast as it may.
double FourSlopePlan::velocity_after_fall() const noexcept {
  const double a2 = acceleration() * acceleration(), v = velocity();
  const double fall_of_deceleration = limits_.slopes[3];
  if (v >= 0.0) return v + a2 * limits_.slopes[1] / 2.0;
  const double gain = a2 * fall_of_deceleration / 2.0;
  if (v + gain <= 0.0) return v + gain;
  return (a2 + 2.0 * v / fall_of_deceleration) * fall_behind_zero() / 2.0;
}

/// The acceleration falls to 0; what brakes becomes an acceleration where the velocity passes through 0.
void FourSlopePlan::let_fall() noexcept {
  if (velocity() < 0.0) {
    const double slope = limits_.slopes[3], a2 = acceleration() * acceleration();
    const bool passes = velocity() + a2 * slope / 2.0 > 0.0;
    const double there = passes ? root(a2 + 2.0 * velocity() / slope) : 0.0;
    change_to(there, slope, SlopePhase::deceleration_falls);
    if (!passes) return;
    now_.velocity = 0.0;
    return change_to(0.0, fall_behind_zero(), SlopePhase::acceleration_falls);
  }
  change_to(0.0, limits_.slopes[1], SlopePhase::acceleration_falls);
}

/// To a velocity ahead without passing through 0 velocity.
void FourSlopePlan::on_one_side(double wanted, double limit, double rise, double fall,
                                const Phases& phases) noexcept {
  if (acceleration() > limit) change_to(limit, fall, SlopePhase::acceleration_too_high);
  const double a2 = acceleration() * acceleration();
  const double slopes = rise + fall;
  const double free = slopes > 0.0 ? root((2.0 * (wanted - velocity()) + a2 * rise) / slopes) : kInfinity;
  const double peak = std::max(std::min(free, limit), acceleration());
  change_to(peak, rise, phases.rises);
  if (peak > 0.0) add((wanted - velocity() - peak * peak * fall / 2.0) / peak, 0.0, phases.plateau);
  change_to(0.0, fall, phases.falls);
  now_.velocity = heading_ * wanted;
}

/// From a negative velocity to 0, with an acceleration there with which the wanted velocity behind it is not
/// passed.
void FourSlopePlan::to_zero(double wanted) noexcept {
  const double limit = limits_.deceleration, rise = limits_.slopes[2], fall = limits_.slopes[3];
  const double fall_behind = fall_behind_zero();
  const double maximum_there = fall_behind > 0.0 ? root(2.0 * wanted / fall_behind) : kInfinity;
  if (acceleration() > limit) {
    // It may pass through 0 before it is within the limit.
    const double begin = acceleration() * acceleration();
    const bool passes = velocity() + (begin - limit * limit) * fall / 2.0 > 0.0;
    const double within = passes ? root(begin + 2.0 * velocity() / fall) : limit;
    change_to(within, fall, SlopePhase::acceleration_too_high);
    if (passes) {
      now_.velocity = 0.0;
      return;
    }
  }
  const double a2 = acceleration() * acceleration(), gap = -velocity();
  const double natural = rise > 0.0 ? std::min(root(a2 + 2.0 * gap / rise), limit) : limit;
  const double there = std::min(natural, maximum_there);
  const double slopes = rise + fall;
  double peak = natural;
  if (natural > maximum_there && slopes > 0.0)
    peak = std::min(root((2.0 * gap + a2 * rise + there * there * fall) / slopes), limit);
  peak = std::max(peak, acceleration());
  change_to(peak, rise, SlopePhase::reversal);
  const double behind = fall > 0.0 ? (peak * peak - there * there) * fall / 2.0 : 0.0;
  if (peak > 0.0) add((-velocity() - behind) / peak, 0.0, SlopePhase::reversal);
  change_to(there, fall, SlopePhase::reversal);
  now_.velocity = 0.0;
}

void FourSlopePlan::to_velocity(double wanted) noexcept {
  if (now_.acceleration != 0.0) {
    heading_ = sign_of(now_.acceleration);
    if (velocity_after_fall() > heading_ * wanted) let_fall();
  }
  if (now_.velocity == wanted && now_.acceleration == 0.0) return;
  heading_ = now_.acceleration != 0.0 ? sign_of(now_.acceleration) : sign_of(wanted - now_.velocity);
  const double there = heading_ * wanted;
  if (velocity() < 0.0 && there <= 0.0) {
    const bool too_fast = -velocity() > limits_.velocity && limits_.velocity > 0.0;
    return on_one_side(there, limits_.deceleration, limits_.slopes[2], limits_.slopes[3],
                       too_fast ? kTooFast : kSlower);
  }
  if (velocity() < 0.0) to_zero(there);
  on_one_side(there, limits_.acceleration, limits_.slopes[0], limits_.slopes[1], kFaster);
}

void FourSlopeProfile::stand(double position) noexcept {
  count_ = current_ = 0;
  now_ = end_ = {position, 0.0, 0.0};
  led_ = false;
  phase_ = SlopePhase::end;
}

void FourSlopeProfile::begin(const FourSlopeState& from, const FourSlopeLimits& limits) noexcept {
  origin_ = from.position;
  now_ = from;
  current_ = 0;
  led_ = false;
  time_ = 0.0;
  sinusoidal_ = limits.sinusoidal;
  phase_ = SlopePhase::start;
}

void FourSlopeProfile::follow(const FourSlopePlan& plan) noexcept {
  count_ = plan.count();
  segment_ = segments_[0];
  straight_ = false;
}

void FourSlopeProfile::to_velocity(const FourSlopeState& from, double velocity,
                                   const FourSlopeLimits& limits) noexcept {
  begin(from, limits);
  const double lowest = limits.reverses ? -limits.velocity : 0.0;
  FourSlopePlan plan({0.0, from.velocity, from.acceleration}, limits, segments_.data());
  plan.to_velocity(std::clamp(velocity, lowest, limits.velocity));
  follow(plan);
  end_ = plan.now();
  end_.position += origin_;
}

namespace {

/// The velocity that a motion to a target has in between, and what is left to go with it.
struct Between {
  double velocity = 0.0, rest = 0.0;
  bool met = true;
};

double reached(const FourSlopeState& start, double velocity, const FourSlopeLimits& limits) noexcept {
  FourSlopePlan plan(start, limits, nullptr);
  plan.to_velocity(velocity);
  plan.to_velocity(0.0);
  return plan.now().position;
}

// The further the velocity is to one side, the further the motion gets.
Between find_between(const FourSlopeState& start, double distance, const FourSlopeLimits& limits) noexcept {
  constexpr double kMet = 1e-3;
  constexpr int kHalvings = 64;
  double low = limits.reverses ? -limits.velocity : 0.0, high = limits.velocity;
  for (const double fastest : {high, low}) {
    const double rest = distance - reached(start, fastest, limits);
    if (rest == 0.0 || (fastest > 0.0 && rest > 0.0) || (fastest < 0.0 && rest < 0.0))
      return {fastest, rest, true};
  }
  double between = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    between = (low + high) / 2.0;
    if (between == low || between == high) break;
    (reached(start, between, limits) > distance ? high : low) = between;
  }
  return {between, 0.0, std::abs(reached(start, between, limits) - distance) < kMet};
}

}  // namespace

// From a state that is beyond its limits there may be targets that no velocity in between meets: then it
// stops first.
void FourSlopeProfile::to_position(const FourSlopeState& from, double target,
                                   const FourSlopeLimits& limits) noexcept {
  begin(from, limits);
  const double distance = target - from.position;
  FourSlopePlan plan({0.0, from.velocity, from.acceleration}, limits, segments_.data());
  Between between = find_between(plan.now(), distance, limits);
  if (!between.met) {
    plan.to_velocity(0.0);
    between = find_between(plan.now(), distance, limits);
  }
  plan.to_velocity(between.velocity);
  if (between.rest != 0.0 && between.velocity != 0.0)
    plan.keep(between.rest / between.velocity, SlopePhase::constant);
  plan.to_velocity(0.0);
  follow(plan);
  end_ = {between.met ? target : from.position + plan.now().position, 0.0, 0.0};
}

FourSlopeState FourSlopeProfile::at_half_sine(const Segment& segment, double t) const noexcept {
  const FourSlopeState& begin = segment.begin;
  const double duration = segment.duration, change = begin.acceleration * duration;
  const Turn turn = half_turn(t / duration);
  return {
      origin_ + begin.position + t * begin.velocity + change * (t / 2.0 - duration / (2.0 * kPi) * turn.sine),
      begin.velocity + change * (1.0 - turn.cosine) / 2.0, begin.acceleration * kPi / 2.0 * turn.sine};
}

/// By parts: a state that is copied as a whole waits for its last part.
inline void FourSlopeProfile::move_along() noexcept {
  const Segment& segment = segment_;
  const FourSlopeState& begin = segment.begin;
  const double t = time_;
  const double place = origin_ + begin.position;
  if (begin.acceleration == 0.0 && segment.jerk == 0.0 && begin.velocity != 0.0) {
    // Without the division; most steps do not even come here.
    straight_ = true;
    now_.position = place + t * begin.velocity;
    now_.velocity = begin.velocity;
    now_.acceleration = 0.0;
  } else if (!sinusoidal_ || begin.acceleration == 0.0) {
    now_.position = place + t * (begin.velocity + t * (begin.acceleration / 2.0 + t * segment.jerk / 6.0));
    now_.velocity = begin.velocity + t * (begin.acceleration + t * segment.jerk / 2.0);
    now_.acceleration = begin.acceleration + t * segment.jerk;
  } else {
    now_ = at_half_sine(segment, t);
  }
  phase_ = segment.phase;
}

/// Not called at the end.
const FourSlopeState& FourSlopeProfile::go_on() noexcept {
  while (time_ >= segment_.duration) {
    straight_ = false;
    time_ -= segment_.duration;
    if (++current_ == count_) return keep_velocity(time_);
    segment_ = segments_[current_];
  }
  move_along();
  return now_;
}

double FourSlopeProfile::stop_path(double velocity, double acceleration,
                                   const FourSlopeLimits& limits) noexcept {
  FourSlopePlan plan({0.0, velocity, acceleration}, limits, nullptr);
  plan.to_velocity(0.0);
  return plan.now().position;
}

}  // namespace lockstep
