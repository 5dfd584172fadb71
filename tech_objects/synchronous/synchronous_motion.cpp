#include "tech_objects/synchronous/synchronous_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// How close "standing on the synchronous position" is, relative to the position: rounding of the last
/// motion.
constexpr double kSamePlace = 1e-14;

/// No distance that an axis could be seen to make in a tick [u].
constexpr double kNoDistance = 1e-6;

/// Velocity that is left to the side to which SyncDirection lets an axis not turn, for what counts as no
/// distance: part of the velocity of the job.
constexpr double kAgainst = 1e-3;

/// Most that velocity and acceleration of the axis may make of its way over the leading distance, as a
/// multiple of that way: the quintic then stays within some ten times the way.
constexpr double kSteepest = 100.0;

/// Over how many ticks the change of the leading velocity is watched.
constexpr double kWatchedTicks = 16.0;

bool same_place(double distance, double position) noexcept {
  return std::abs(distance) <= kSamePlace * std::max(1.0, std::abs(position));
}

}  // namespace

void SynchronousMotion::configure(const Modulo& following, double period, double tolerance,
                                  const AdditiveLeadingValues& additive) noexcept {
  following_ = following;
  period_ = period;
  tolerance_ = tolerance;
  additive_ = &additive;
}

LeadingObject* SynchronousMotion::leading_object() const noexcept {
  return leading_ == nullptr ? nullptr : leading_->source;
}

bool SynchronousMotion::follows_actual_value() const noexcept {
  return leading_ != nullptr &&
         (leading_->coupling == Coupling::actual || leading_->source->setpoint_is_actual());
}

// ---- Every tick
// -------------------------------------------------------------------------------------------------

void SynchronousMotion::advance(Setpoint& setpoint) noexcept {
  if (synchronous_ && !velocity_only_) {
    evaluate_function(setpoint);
    if (shifted_ && offset_.in_use()) add_offset(setpoint);
    return;
  }
  if (synchronous_) return advance_in_velocity(setpoint);
  if (!velocity_only_) watch_reversal();
  if (reversed_) return;
  if (way_ == Way::velocity) return advance_velocity(setpoint);
  if (way_ == Way::out) return advance_out(setpoint);
  if (cam_ != nullptr) follow_.clear_end();
  evaluate_function(function_);
  advance_along_profile(setpoint);
}

/// leading value → + additive → effective leading value
void SynchronousMotion::look_at_leading() noexcept {
  const LeadingObject& source = *leading_->source;
  if (!source.leads_as_it_is(leading_->coupling)) {
    look_at_led();
  } else {
    leading_now_ = source.leading_state(leading_->coupling);
    if (synchronous_ && !shifted_ && !additive_->in_use) return;
    leading_last_ = source.last_leading_state(leading_->coupling);
  }
  if (!additive_->in_use) return;
  add_additive(leading_now_, additive_->now);
  add_additive(leading_last_, additive_->last);
}

void SynchronousMotion::add_additive(Setpoint& leading, const AdditiveLeadingValue& additive) const noexcept {
  leading.position = advanced(leading.position, additive.position, leading_modulo_);
  leading.velocity += additive.velocity;
  leading.acceleration += additive.acceleration;
}

/// effective leading value → + phase shift → function, to `function_` and to `result`. Written value by
/// value: copying a whole setpoint would make the processor wait until its parts have left for memory. The
/// share of the shift is added behind the gear, where nothing is rounded in between.
void SynchronousMotion::evaluate_function(Setpoint& result) noexcept {
  if (cam_ != nullptr) return evaluate_cam(result);
  AxisPosition position = gear_.value(leading_now_.position);
  double velocity = gear_.velocity(leading_now_.velocity);
  double acceleration = gear_.acceleration(leading_now_.acceleration);
  if (shifted_ && phase_.in_use()) {
    position = advanced(position, geared_phase_.of(phase_.value(), gear_.ratio()), following_);
    if (phase_.moves()) {
      velocity += gear_.velocity(phase_.velocity());
      acceleration += gear_.acceleration(phase_.acceleration());
    }
  }
  result.position.turns = function_.position.turns = position.turns;
  result.position.value = function_.position.value = position.value;
  result.velocity = function_.velocity = velocity;
  result.acceleration = function_.acceleration = acceleration;
}

/// function → + offset
void SynchronousMotion::add_offset(Setpoint& setpoint) noexcept {
  setpoint.position = followed_ = advanced(setpoint.position, offset_.value(), following_);
  setpoint.velocity += offset_.velocity();
  setpoint.acceleration += offset_.acceleration();
}

/// MC_GearInVelocity: the velocity follows, whatever the position.
void SynchronousMotion::advance_in_velocity(Setpoint& setpoint) noexcept {
  const double last = setpoint.velocity;
  setpoint.velocity = gear_.velocity(leading_now_.velocity);
  setpoint.acceleration = gear_.acceleration(leading_now_.acceleration);
  setpoint.position = advanced(setpoint.position, 0.5 * (last + setpoint.velocity) * period_, following_);
  function_ = setpoint;
}

/// Both positions belong together from now on.
void SynchronousMotion::place_gear(AxisPosition leading, AxisPosition following) noexcept {
  gear_.set(numerator_, denominator_, leading, following, leading_modulo_, following_);
  geared_phase_.forget();
}

void SynchronousMotion::change_ratio(DINT numerator, DINT denominator) noexcept {
  if (!synchronous_ || (numerator == numerator_ && denominator == denominator_)) return;
  numerator_ = numerator;
  denominator_ = denominator;
  place_gear({}, {});
}

/// Over a distance the progress is the very place at which the profile is read, so that a leading axis homed
/// backwards counts as the reversal that it is for the profile.
void SynchronousMotion::watch_reversal() noexcept {
  const double step = rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_);
  if (direction_ == 0) direction_ = sign(step);
  progress_ = way_ == Way::velocity ? progress_ + direction_ * step : covered();
  furthest_ = std::max(furthest_, progress_);
  reversed_ = furthest_ - progress_ > tolerance_;
}

/// MC_GearIn: towards velocity and acceleration of the function; where both are met, the function begins.
void SynchronousMotion::advance_velocity(Setpoint& setpoint) noexcept {
  const bool holding = progress_ < furthest_;  // reversed within the tolerance
  const double velocity = holding ? 0.0 : gear_.velocity(leading_now_.velocity);
  const double acceleration = holding ? 0.0 : gear_.acceleration(leading_now_.acceleration);
  const TrackingStep step =
      track_velocity({setpoint.velocity, setpoint.acceleration}, {velocity, acceleration},
                     {.velocity = dynamics_.velocity,
                      .acceleration = dynamics_.acceleration,
                      .deceleration = dynamics_.deceleration,
                      .jerk = dynamics_.jerk},
                     period_);
  setpoint.position = advanced(setpoint.position, step.way, following_);
  setpoint.velocity = step.velocity;
  setpoint.acceleration = step.acceleration;
  function_ = setpoint;
  if (!step.synchronous || holding) return;
  if (!velocity_only_) place_gear(leading_now_.position, setpoint.position);
  synchronous_ = true;
}

/// Leading distance since the start of the profile, in its direction [u].
double SynchronousMotion::covered() const noexcept {
  return direction_ * rounded_difference(leading_now_.position, leading_start_, leading_modulo_);
}

/// MC_GearInPos: the function of this tick plus what the axis is ahead of it.
void SynchronousMotion::advance_along_profile(Setpoint& setpoint) noexcept {
  const double way = covered();
  if (way >= profile_way_) {
    synchronous_ = true;
    setpoint = function_;
    if (offset_.in_use()) add_offset(setpoint);
    if (cam_ != nullptr && !passed_once()) follow_.clear_end();  // it begins, whatever pass that is
    return;
  }
  const SyncOffset ahead = offset(way);
  const double way_velocity = direction_ * leading_now_.velocity;
  const double way_acceleration = direction_ * leading_now_.acceleration;
  const Setpoint joined = cam_ != nullptr ? tangent(way) : function_;
  setpoint.position = advanced(joined.position, ahead.position, following_);
  setpoint.velocity = joined.velocity + ahead.velocity(way_velocity);
  setpoint.acceleration = joined.acceleration + ahead.acceleration(way_velocity, way_acceleration);
}

/// What the axis is ahead of its function, over the leading distance covered.
SyncOffset SynchronousMotion::offset(double way) const noexcept {
  if (way_ == Way::distance) return distance_profile_.value(way);
  const MotionState state = time_profile_.at(way / time_velocity_);
  if (way < 0.0) {  // turned back before the start, within the tolerance
    const double slope = state.velocity / time_velocity_;
    return {state.position + slope * way, slope, 0.0};
  }
  return {state.position, state.velocity / time_velocity_,
          state.acceleration / (time_velocity_ * time_velocity_)};
}

/// The axis has another name for every place. Of a cam that is a following value offset: its function stays.
void SynchronousMotion::shift_following(double by) noexcept {
  if (leading_ == nullptr || velocity_only_) return;
  function_.position = advanced(function_.position, by, following_);
  if (way_ == Way::out) {
    out_position_ = advanced(out_position_, by, following_);
  } else if (cam_ != nullptr) {
    following_offset().shift(by);
    joint_ = advanced(joint_, by, following_);
    slave_offset_ += by;
  } else if (synchronous_ || way_ != Way::velocity) {
    const AxisPosition leading = leading_now_.position;
    place_gear(leading, advanced(gear_.value(leading), by, following_));
  }
}

void SynchronousMotion::turn_following(std::int64_t turns) noexcept {
  function_.position.turns += turns;
  if (cam_ != nullptr)
    follow_.add_turns(turns);
  else
    gear_.add_turns(turns);
}

// ---- Beginning
// --------------------------------------------------------------------------------------------------

void SynchronousMotion::couple(const LeadingValue& leading, const Job& job,
                               const Dynamics& dynamics) noexcept {
  leading_ = &leading;
  leading_modulo_ = leading.source->modulo();
  cam_ = job.cam;
  curvature_ = 0.0;
  numerator_ = job.numerator;
  denominator_ = job.denominator;
  ratio_ = static_cast<double>(job.numerator) / static_cast<double>(job.denominator);
  dynamics_ = dynamics;
  velocity_only_ = job.kind == JobKind::MC_GearInVelocity;
  uncontrolled_seen_ = 0;
  phase_.reset();
  offset_.reset();
  shifted_ = false;
  synchronous_ = false;
  reversed_ = false;
  direction_ = 0;
  progress_ = 0.0;
  furthest_ = 0.0;
  watched_acceleration_ = 0.0;
}

void SynchronousMotion::begin_gear_in(const LeadingValue& leading, const Job& job,
                                      const Dynamics& dynamics) noexcept {
  couple(leading, job, dynamics);
  way_ = Way::velocity;
  place_gear({}, {});  // for its ratio; placed when met
}

ErrorId SynchronousMotion::begin_waiting(const LeadingValue& leading, const Job& job,
                                         const Dynamics& dynamics, const Setpoint& own) noexcept {
  couple(leading, job, dynamics);
  way_ = Way::none;
  profile_reference_ = job.mode;
  sync_direction_ = job.direction;
  master_sync_position_ = normalised({0, job.master_sync_position}, leading_modulo_).value;
  slave_sync_position_ = normalised({0, job.slave_sync_position}, following_).value;
  start_distance_ = job.master_start_distance;
  look_at_leading();
  leading_last_ = leading_now_;
  if (cam_ != nullptr) {
    if (const ErrorId error = begin_cam(job); error != ErrorId::none) return error;
  }
  if (profile_reference_ != 1 || leading_modulo_.enabled || standing_on_sync_positions(own))
    return ErrorId::none;
  // On a line, profile 1 needs its whole distance ahead; a standing leading axis is judged in both
  // directions.
  const double to_go = master_sync_position_ - leading_now_.position.value;
  const int heading = sign(leading_now_.velocity);
  const bool ahead = heading == 0 || heading * to_go >= 0.0;
  return ahead && std::abs(to_go) < start_distance_ ? ErrorId::leading_distance : ErrorId::none;
}

bool SynchronousMotion::standing_on_sync_positions(const Setpoint& own) const noexcept {
  const double leading = leading_now_.position.value;
  const double following = own.position.value;
  return own.standing() && leading_now_.velocity == 0.0 && leading_last_.velocity == 0.0 &&
         same_place(shortest_distance(leading, master_sync_position_, leading_modulo_), leading) &&
         (same_place(shortest_distance(following, slave_sync_position_, following_), following) ||
          on_slave_sync_position(following));
}

/// On a ring up to what the rounding of several motions leaves. The axis is put there in one tick, so that a
/// long ring must not make it more than nobody sees.
bool SynchronousMotion::on_slave_sync_position(double here) const noexcept {
  return following_.enabled && std::abs(shortest_distance(here, slave_sync_position_, following_)) <=
                                   std::min(kOnSynchronousValue * following_.length, kNoDistance);
}

SynchronousMotion::Start SynchronousMotion::reject(ErrorId error) noexcept {
  rejection_ = error;
  return Start::rejected;
}

// ---- Waiting
// ----------------------------------------------------------------------------------------------------

SynchronousMotion::Start SynchronousMotion::watch(const Setpoint& own,
                                                  const SynchronousMotion* active) noexcept {
  look_at_leading();
  watch_acceleration();
  if (uncontrolled_seen_ != 0) {  // there is no leading value yet: what was zero meanwhile does not matter
    uncontrolled_seen_ = 0;
    return Start::not_yet;
  }
  if (cam_ != nullptr) return watch_cam(own, active);
  if (standing_on_sync_positions(own)) {
    direction_ = 1;
    const double way =
        shortest_distance(leading_last_.position.value, master_sync_position_, leading_modulo_);
    const double following = shortest_distance(own.position.value, slave_sync_position_, following_);
    anchor(way, advanced(own.position, following, following_));
    synchronous_ = true;
    return Start::synchronous;
  }
  direction_ = sign(rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_));
  if (direction_ == 0) return Start::not_yet;
  const Start start = profile_reference_ == 0 ? watch_time(own) : watch_distance(own);
  if (start != Start::synchronizing) direction_ = 0;
  return start;
}

/// What the velocity of the leading value changes by, over so many ticks that the noise of an encoder does
/// not count: an extrapolated leading value tells no acceleration.
void SynchronousMotion::watch_acceleration() noexcept {
  const double change = (leading_now_.velocity - leading_last_.velocity) / period_;
  watched_acceleration_ += (change - watched_acceleration_) / kWatchedTicks;
}

/// Way from the last leading position to a place, in the direction of motion [u]; negative: a linear axis has
/// passed it.
double SynchronousMotion::way_to(double place) const noexcept {
  const double from = leading_last_.position.value;
  if (!leading_modulo_.enabled) return direction_ * (place - from);
  const double target = normalised({0, place}, leading_modulo_).value;
  if (target == from) return 0.0;
  return direction_ > 0 ? positive_distance(from, target, leading_modulo_)
                        : -negative_distance(from, target, leading_modulo_);
}

/// Places the function: the synchronous positions belong together, the leading one a way ahead of the last
/// tick.
void SynchronousMotion::anchor(double way_to_sync_position, AxisPosition following) noexcept {
  following.value = slave_sync_position_;
  place_gear(leading_at(way_to_sync_position), following);
}

/// The synchronous position of the leading axis, a way ahead of the last tick.
AxisPosition SynchronousMotion::leading_at(double way) const noexcept {
  AxisPosition leading = advanced(leading_last_.position, direction_ * way, leading_modulo_);
  if (leading_modulo_.enabled) {
    // The way is rounded: at the end of the ring the turn may be the neighbour's.
    const double off = leading.value - master_sync_position_;
    if (off > 0.5 * leading_modulo_.length) ++leading.turns;
    if (off < -0.5 * leading_modulo_.length) --leading.turns;
  }
  leading.value = master_sync_position_;
  return leading;
}

/// Profiles 1 and 3: starts at the last tick before the start position is crossed and spans the rest.
SynchronousMotion::Start SynchronousMotion::watch_distance(const Setpoint& own) noexcept {
  const bool in_advance = profile_reference_ == 1;
  const double start_place =
      in_advance ? master_sync_position_ - direction_ * start_distance_ : master_sync_position_;
  const double way = way_to(start_place);
  const double step =
      direction_ * rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_);
  if (way < 0.0 || way > step) return Start::not_yet;

  const double way_to_sync = in_advance ? way + start_distance_ : way;
  profile_way_ = way + start_distance_;
  AxisPosition following{own.position.turns, slave_sync_position_};
  anchor(way_to_sync, following);
  leading_start_ = leading_last_.position;
  const SyncStart start{.leading = leading_start_,
                        .leading_velocity = leading_last_.velocity,
                        .leading_acceleration = leading_last_.acceleration,
                        .following = own.position,
                        .velocity = own.velocity,
                        .acceleration = own.acceleration};
  const SyncTarget target{.at_start = gear_.value(leading_start_), .slope = gear_.ratio().rounded()};
  const SyncPlan plan =
      distance_profile_.plan(start, target, profile_way_, direction_ < 0,
                             static_cast<SyncDirection>(sync_direction_), leading_modulo_, following_);
  if (plan != SyncPlan::kReady) return reject(ErrorId::direction);
  if (shoots_beyond(distance_profile_.value(0.0), profile_way_)) return reject(ErrorId::leading_distance);
  following.turns += distance_profile_.turns();
  anchor(way_to_sync, following);
  return begin_profile(Way::distance);
}

/// Whether velocity and acceleration of the axis, led on by a leading axis that creeps, would carry it far
/// beyond the way that it has to make.
bool SynchronousMotion::shoots_beyond(const SyncOffset& start, double distance) const noexcept {
  const double turn = following_.enabled ? following_.length : std::numeric_limits<double>::infinity();
  const double natural = std::min(std::abs(start.position), turn) + std::abs(ratio_) * distance;
  const double own = std::abs(start.slope) * distance + std::abs(start.curvature) * distance * distance;
  return own > kSteepest * natural;
}

SynchronousMotion::Start SynchronousMotion::begin_profile(Way way) noexcept {
  way_ = way;
  progress_ = 0.0;
  furthest_ = 0.0;
  return Start::synchronizing;
}

/// Profile 0: starts at the last tick from which the way that is left still suffices for the planned time.
SynchronousMotion::Start SynchronousMotion::watch_time(const Setpoint& own) noexcept {
  const double leading_velocity = leading_now_.velocity;
  const double way = way_to(master_sync_position_);
  if (cam_ != nullptr) aim_at_cam(way);
  const double synchronous_velocity = ratio_ * leading_velocity;
  if (leading_last_.velocity == 0.0 || sign(leading_velocity) != direction_) return Start::not_yet;
  if (std::abs(synchronous_velocity) >= dynamics_.velocity) return reject(ErrorId::velocity);
  const int forced = forced_direction();
  if (forced != 0 && (sign(synchronous_velocity) == -forced || forced * own.velocity < 0.0))
    return reject(ErrorId::direction);

  const double step =
      direction_ * rounded_difference(leading_now_.position, leading_last_.position, leading_modulo_);
  Profile now, next;
  const auto reaches = [&](const Setpoint& leading, double left, double ahead, Profile& profile) noexcept {
    return plan_time(own, leading, left, ahead, profile) &&
           profile.duration() * std::abs(leading.velocity) <= left;
  };
  if (way < 0.0) return Start::not_yet;
  bool in_time = reaches(leading_last_, way, 0.0, now);
  if (!in_time && forced != 0 && curvature_ != 0.0) {  // it need not bend as the cam does
    curvature_ = 0.0;
    in_time = reaches(leading_last_, way, 0.0, now);
  }
  if (!in_time) return Start::not_yet;  // too late for this pass
  if (way > step && reaches(leading_now_, way - step, own.velocity * period_, next)) return Start::not_yet;

  const AxisPosition following =
      advanced(own.position, following_way(own, ratio_ * leading_last_.velocity), following_);
  if (cam_ != nullptr)
    take_joint(follow_.joined_at(leading_at(way), direction_), following.turns);
  else
    anchor(way, following);
  time_profile_ = now;
  time_velocity_ = std::abs(leading_last_.velocity);
  profile_way_ = way;
  leading_start_ = leading_last_.position;
  return begin_profile(Way::time);
}

/// Of SyncDirection: 1, -1; 0: the axis may turn either way.
int SynchronousMotion::forced_direction() const noexcept {
  if (!following_.enabled || sync_direction_ == 3) return 0;
  return sync_direction_ == 1 ? 1 : -1;
}

/// Way of the following axis to its synchronous position, as SyncDirection has it [u]: with a turn more where
/// it could not get the synchronous velocity on the way.
double SynchronousMotion::following_way(const Setpoint& own, double synchronous_velocity) const noexcept {
  const double here = own.position.value;
  if (!following_.enabled) return slave_sync_position_ - here;
  const double shortest = shortest_distance(here, slave_sync_position_, following_);
  const int to = forced_direction();
  const double there = kOnSynchronousValue * following_.length;
  if (to == 0) return shortest;
  double way = to * shortest;
  if (way < -there) way += following_.length;
  const double acceleration = std::min(dynamics_.acceleration, dynamics_.deceleration) -
                              std::abs(curvature_) * leading_now_.velocity * leading_now_.velocity;
  const ProfileLimits limits{.velocity_max = dynamics_.velocity,
                             .velocity_min = -dynamics_.velocity,
                             .acceleration = acceleration,
                             .deceleration = acceleration,
                             .jerk = dynamics_.jerk};
  Profile change;
  const MotionState start{.velocity = own.velocity, .acceleration = own.acceleration};
  if (plan_velocity(start, synchronous_velocity, limits, change) != PlanResult::ok) return to * way;
  const double least = to * change.target().position;
  if (least > there && way < least + there)
    way += following_.length * std::ceil((least + there - way) / following_.length);
  return to * way;
}

/// The motion relative to the function, at the leading velocity at hand, that ends on it at rest.
/// @param way leading distance that is left  @param ahead way that the axis itself makes until then [u]
bool SynchronousMotion::plan_time(const Setpoint& own, const Setpoint& leading, double way, double ahead,
                                  Profile& profile) const noexcept {
  // Of a cam it is the parabola that touches it in the synchronous position.
  const double slope = ratio_ - curvature_ * direction_ * way;
  const double function_velocity = slope * leading.velocity;
  const double bend = curvature_ * leading.velocity * leading.velocity;
  const double slowest = std::min(function_velocity, ratio_ * leading.velocity);
  const double fastest = std::max(function_velocity, ratio_ * leading.velocity);
  const double acceleration = std::min(dynamics_.acceleration, dynamics_.deceleration) - std::abs(bend);
  ProfileLimits limits{.velocity_max = dynamics_.velocity - fastest,
                       .velocity_min = -dynamics_.velocity - slowest,
                       .acceleration = acceleration,
                       .deceleration = acceleration,
                       .jerk = dynamics_.jerk};
  const double against = kAgainst * dynamics_.velocity;
  if (forced_direction() > 0) limits.velocity_min = slowest > 0.0 ? -slowest : -against;
  if (forced_direction() < 0) limits.velocity_max = fastest < 0.0 ? -fastest : against;
  const double relative_velocity = own.velocity - function_velocity;
  const double slope_change = relative_velocity / leading.velocity * leading.acceleration;
  // A slow leading value that changes its velocity strongly would carry more along than the axis may make.
  const double seen = follows_actual_value() ? watched_acceleration_ : leading.acceleration;
  if (std::abs(relative_velocity / leading.velocity * seen) > acceleration) return false;
  const MotionState start{
      .position = ratio_ * direction_ * way - 0.5 * curvature_ * way * way -
                  (following_way(own, ratio_ * leading.velocity) - ahead),
      .velocity = relative_velocity,
      .acceleration = own.acceleration - slope * leading.acceleration - bend - slope_change};
  return plan_position(start, 0.0, 0.0, limits, profile) == PlanResult::ok;
}

}  // namespace lockstep
