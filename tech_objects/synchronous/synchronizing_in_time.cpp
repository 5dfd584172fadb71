// The way in that is planned in time, with the dynamics of the request.
#include <algorithm>
#include <cmath>

#include "tech_objects/synchronous/synchronizing.hpp"

namespace lockstep {
namespace {

/// Velocity that is left to the side to which SyncDirection lets an axis not turn, for what counts as no
/// distance: part of the velocity of the job.
constexpr double kAgainst = 1e-3;

/// How many times the dynamics of the job a leading value that goes on speeding up may make of a profile that
/// has been planned at its velocity of the start.
constexpr double kSteeper = 2.0;

/// Part of its velocity that a measured leading value has to gain while it is watched to be one that speeds
/// up.
constexpr double kRunsUp = 0.25;

}  // namespace

/// Profile 0: starts at the last tick from which the distance that is left still suffices for the planned
/// time.
Synchronizing::Start Synchronizing::watch_time(const Chain& chain, const Setpoint& own) noexcept {
  const LeadingStep& led = chain.leading.step();
  const int direction = progress_.direction();
  const double leading_velocity = led.now.velocity;
  const double distance = distance_to(chain, leading_sync_position_);
  if (chain.function.is_cam()) aim_at_cam(chain, distance);
  const double synchronous_velocity = slope_ * leading_velocity;
  if (led.last.velocity == 0.0 || sign(leading_velocity) != direction) return Start::not_yet;
  if (std::abs(synchronous_velocity) >= dynamics_.velocity) return reject(SyncRefusal::velocity);
  const int forced = forced_direction(chain.function.following());
  if (forced != 0 && (sign(synchronous_velocity) == -forced || forced * own.velocity < 0.0))
    return reject(SyncRefusal::direction);

  const double step = direction * led.distance();
  Profile now, next;
  const auto reaches = [&](const Setpoint& leading, double left, double ahead, Profile& profile) noexcept {
    return plan_time(chain, own, leading, left, ahead, profile) &&
           profile.duration() * std::abs(leading.velocity) <= left;
  };
  if (distance < 0.0) return Start::not_yet;
  bool in_time = reaches(led.last, distance, 0.0, now);
  if (!in_time && forced != 0 && curvature_ != 0.0) {  // it need not bend as the cam does
    curvature_ = 0.0;
    in_time = reaches(led.last, distance, 0.0, now);
  }
  if (!in_time) return Start::not_yet;  // too late for this pass
  if (distance > step && reaches(led.now, distance - step, own.velocity * chain.period, next))
    return Start::not_yet;
  if (carries_too_far(chain, distance)) return Start::not_yet;

  const double covered = following_distance(chain, own, slope_ * led.last.velocity);
  const AxisPosition following = advanced(own.position, covered, chain.function.following());
  if (chain.function.is_cam())
    take_joint(chain, chain.function.cam().joined_at(leading_at(chain, distance), direction),
               following.turns);
  else
    anchor(chain, distance, following);
  time_profile_ = now;
  time_velocity_ = std::abs(led.last.velocity);
  distance_ = distance;
  return begin_profile(Method::time, led.last.position);
}

/// Whether the leading value, speeding up as it does, will be so fast at the synchronous position that a
/// profile begun now would be steeper than `kSteeper` times its dynamics: it runs over the leading distance,
/// so that its acceleration grows with the square of the leading velocity. An acceleration that decreases
/// ends as it is about to; any other one is taken to last.
/// @param distance of the leading axis that is left
bool Synchronizing::carries_too_far(const Chain& chain, double distance) const noexcept {
  const LeadingStep& led = chain.leading.step();
  const int direction = progress_.direction();
  const bool is_measured = chain.leading.follows_actual_value();
  const double acceleration = direction * (is_measured ? watched_acceleration_ : led.now.acceleration);
  if (acceleration <= 0.0) return false;
  // What an encoder shows from cycle to cycle is noise beside a velocity that has been there for long.
  if (is_measured && acceleration * kWatchedTicks * chain.period < kRunsUp * std::abs(led.now.velocity))
    return false;
  const double planned = led.last.velocity * led.last.velocity;
  double to_come = led.now.velocity * led.now.velocity + 2.0 * acceleration * distance;
  const double decrease = (direction * led.last.acceleration - acceleration) / chain.period;
  if (!is_measured && decrease > 0.0) {
    const double velocity = std::abs(led.now.velocity) + 0.5 * acceleration * acceleration / decrease;
    to_come = std::min(to_come, velocity * velocity);
  }
  return to_come > kSteeper * planned;
}

/// Of SyncDirection: 1, -1; 0: the axis may turn either way.
int Synchronizing::forced_direction(const Modulo& following) const noexcept {
  if (!following.enabled || direction_ == SyncDirection::kShortestPath) return 0;
  return direction_ == SyncDirection::kPositive ? 1 : -1;
}

/// Distance of the following axis to its synchronous position, as SyncDirection has it [u]: with a turn more
/// where it could not get the synchronous velocity on the way.
double Synchronizing::following_distance(const Chain& chain, const Setpoint& own,
                                         double synchronous_velocity) const noexcept {
  const Modulo& following = chain.function.following();
  const double leading_velocity = chain.leading.now().velocity;
  const double here = own.position.value;
  if (!following.enabled) return following_sync_position_ - here;
  const double shortest = shortest_distance(here, following_sync_position_, following);
  const int to = forced_direction(following);
  const double there = kOnSynchronousValue * following.length;
  if (to == 0) return shortest;
  double distance = to * shortest;
  if (distance < -there) distance += following.length;
  const double acceleration = std::min(dynamics_.acceleration, dynamics_.deceleration) -
                              std::abs(curvature_) * leading_velocity * leading_velocity;
  const ProfileLimits limits = limits_of({dynamics_.velocity, acceleration, acceleration, dynamics_.jerk});
  Profile change;
  const MotionState start{.velocity = own.velocity, .acceleration = own.acceleration};
  if (plan_velocity(start, synchronous_velocity, limits, change) != PlanResult::ok) return to * distance;
  const double minimum = to * change.target().position;
  if (minimum > there && distance < minimum + there)
    distance += following.length * std::ceil((minimum + there - distance) / following.length);
  return to * distance;
}

/// The motion relative to the function, at the leading velocity at hand, that ends on it at rest.
/// @param distance of the leading axis that is left  @param ahead distance that the axis itself makes until
/// then [u]
bool Synchronizing::plan_time(const Chain& chain, const Setpoint& own, const Setpoint& leading,
                              double distance, double ahead, Profile& profile) const noexcept {
  // Of a cam it is the parabola that touches it in the synchronous position.
  const double slope = slope_ - curvature_ * progress_.direction() * distance;
  const double function_velocity = slope * leading.velocity;
  const double bend = curvature_ * leading.velocity * leading.velocity;
  const double slowest = std::min(function_velocity, slope_ * leading.velocity);
  const double fastest = std::max(function_velocity, slope_ * leading.velocity);
  const double acceleration = std::min(dynamics_.acceleration, dynamics_.deceleration) - std::abs(bend);
  ProfileLimits limits{.velocity_max = dynamics_.velocity - fastest,
                       .velocity_min = -dynamics_.velocity - slowest,
                       .acceleration = acceleration,
                       .deceleration = acceleration,
                       .jerk = dynamics_.jerk};
  const double against = kAgainst * dynamics_.velocity;
  const int forced = forced_direction(chain.function.following());
  if (forced > 0) limits.velocity_min = slowest > 0.0 ? -slowest : -against;
  if (forced < 0) limits.velocity_max = fastest < 0.0 ? -fastest : against;
  const double relative_velocity = own.velocity - function_velocity;
  const double slope_change = relative_velocity / leading.velocity * leading.acceleration;
  // A slow leading value that changes its velocity strongly would carry more along than the axis may make.
  const double seen = chain.leading.follows_actual_value() ? watched_acceleration_ : leading.acceleration;
  if (std::abs(relative_velocity / leading.velocity * seen) > acceleration) return false;
  const MotionState start{
      .position = slope_ * progress_.direction() * distance - 0.5 * curvature_ * distance * distance -
                  (following_distance(chain, own, slope_ * leading.velocity) - ahead),
      .velocity = relative_velocity,
      .acceleration = own.acceleration - slope * leading.acceleration - bend - slope_change};
  return plan_position(start, 0.0, 0.0, limits, profile) == PlanResult::ok;
}

}  // namespace lockstep
