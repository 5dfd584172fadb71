#include "tech_objects/drive/linear_motor_plant.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kPerMetre = 1e-3;  // a millimetre is so many metres
constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A step is split into so many pieces at most; the last one takes what is left as it comes.
constexpr int kPieces = 12;

/// When a distance ≥ 0 is covered from `velocity` on with `acceleration`: the first time > 0; `never` if that
/// is later.
double time_to_cover(double distance, double velocity, double acceleration, double never) noexcept {
  const double under_root = velocity * velocity + 2.0 * acceleration * distance;
  if (under_root < 0.0) return never;
  const double sum = velocity + std::sqrt(under_root);
  if (sum <= 0.0) return never;
  return std::min(2.0 * distance / sum, never);
}

}  // namespace

void LinearMotorPlant::configure(const LinearMotorPlantSettings& settings, double start) noexcept {
  position_ = start;
  velocity_ = 0.0;
  const double mass = settings.slider_mass + settings.load_mass;
  mass_ = mass * kPerMetre;
  friction_ = settings.friction;
  weight_ = -mass * kGravity * std::sin(settings.inclination * kDegree);
  external_force_ = settings.external_force;
  spring_ = {settings.spring.position, 0.0, settings.spring.stiffness * kPerMetre, 0.0};
  stops_.clear();
  for (const DampedStop& stop : settings.stops)
    stops_.push_back({stop.position, static_cast<double>(stop.side), stop.stiffness * kPerMetre,
                      stop.damping * kPerMetre});
  free_ = spring_.stiffness == 0.0 && stops_.empty();
}

/// A stop is touched, or met just now, and its damper does not outweigh its spring on the way out.
bool LinearMotorPlant::pushes(const Stop& stop) const noexcept {
  const double depth = stop.side * (position_ - stop.position);
  const double towards = stop.side * velocity_;
  return depth >= 0.0 && (towards > 0.0 || stop.stiffness * depth + stop.damping * towards > 0.0);
}

LinearMotorPlant::Elastic LinearMotorPlant::elastic() const noexcept {
  Elastic sum{spring_.stiffness, spring_.stiffness * spring_.position, 0.0};
  for (const Stop& stop : stops_) {
    if (!pushes(stop)) continue;
    sum.stiffness += stop.stiffness;
    sum.pull += stop.stiffness * stop.position;
    sum.damping += stop.damping;
  }
  return sum;
}

void LinearMotorPlant::step_in_pieces(double pushed, double duration) noexcept {
  double left = duration;
  for (int i = 1; i <= kPieces && left > 0.0; ++i) left -= piece(pushed, left, i == kPieces);
}

/// @param whole whether it may not be split any more  @return how much of the duration is over
double LinearMotorPlant::piece(double force, double duration, bool whole) noexcept {
  const Elastic at = elastic();
  if (velocity_ == 0.0) {
    const double pushed = force + at.pull - at.stiffness * position_;
    if (std::abs(pushed) <= friction_) return duration;  // it sticks
    force -= std::copysign(friction_, pushed);
  } else {
    force -= std::copysign(friction_, velocity_);
  }
  if (at.stiffness == 0.0 && at.damping == 0.0) return fly(force / mass_, duration, whole);
  return swing(at, force, duration, whole);
}

/// The next stop that is met within the duration, which becomes the time until then; none: nullptr.
const LinearMotorPlant::Stop* LinearMotorPlant::next_stop(double acceleration,
                                                          double& duration) const noexcept {
  const Stop* next = nullptr;
  const double furthest = (std::abs(velocity_) + 0.5 * std::abs(acceleration) * duration) * duration;
  for (const Stop& stop : stops_) {
    const double gap = stop.side * (stop.position - position_);
    if (gap <= 0.0 || gap > furthest) continue;
    const double time = time_to_cover(gap, stop.side * velocity_, stop.side * acceleration, duration);
    if (time >= duration) continue;
    duration = time;
    next = &stop;
  }
  return next;
}

/// Nothing but a constant force.
double LinearMotorPlant::fly(double acceleration, double duration, bool whole) noexcept {
  double time = duration;
  bool turns = false;
  const Stop* met = nullptr;
  if (!whole) {
    turns = velocity_ * acceleration < 0.0 && -velocity_ / acceleration < time;
    if (turns) time = -velocity_ / acceleration;
    met = next_stop(acceleration, time);
  }
  const double after = turns && met == nullptr ? 0.0 : velocity_ + acceleration * time;
  position_ = met != nullptr ? met->position : position_ + 0.5 * (velocity_ + after) * time;
  velocity_ = after;
  return time;
}

/// The stop that is met or left first within the duration, which becomes the time until then; none: nullptr.
/// With the midpoint rule the distance after t is (t v + t² F / 2m) / (1 + t d / 2m + t² k / 4m).
const LinearMotorPlant::Stop* LinearMotorPlant::next_crossing(const Elastic& at, double pushed,
                                                              double& duration) const noexcept {
  const Stop* next = nullptr;
  for (const Stop& stop : stops_) {
    const double gap = stop.position - position_;
    if (gap == 0.0) continue;
    const double velocity = velocity_ - 0.5 * gap * at.damping / mass_;
    const double acceleration = (pushed - 0.5 * gap * at.stiffness) / mass_;
    const double towards = gap > 0.0 ? 1.0 : -1.0;
    const double time = time_to_cover(std::abs(gap), towards * velocity, towards * acceleration, duration);
    if (time >= duration) continue;
    duration = time;
    next = &stop;
  }
  return next;
}

/// Spring, stops and dampers: midpoint rule, m (v' - v) = h (F - k (x + h u / 2) - d u) with u = (v + v')
/// / 2.
double LinearMotorPlant::swing(const Elastic& at, double force, double duration, bool whole) noexcept {
  const double pushed = force + at.pull - at.stiffness * position_;
  double time = duration;
  bool turns = false;
  const Stop* passed = nullptr;
  if (!whole) {
    // v' is 0 after the root of a quadratic equation.
    const double speed = std::abs(velocity_);
    const double faster = (std::copysign(pushed, pushed * velocity_) - 0.5 * speed * at.damping) / mass_;
    const double root = std::sqrt(faster * faster + speed * speed * at.stiffness / mass_);
    turns = speed > 0.0 && 2.0 * speed < time * (root - faster);
    if (turns) time = 2.0 * speed / (root - faster);
    passed = next_crossing(at, pushed, time);
  }
  const double half = time * (0.5 * time * at.stiffness + at.damping) / (2.0 * mass_);
  const double after =
      turns && passed == nullptr ? 0.0 : (velocity_ * (1.0 - half) + time / mass_ * pushed) / (1.0 + half);
  position_ = passed != nullptr ? passed->position : position_ + 0.5 * (velocity_ + after) * time;
  velocity_ = after;
  return time;
}

double LinearMotorPlant::energy() const noexcept {
  const auto stored = [](double stiffness, double depth) { return 0.5 * stiffness * depth * depth; };
  double sum = 0.5 * mass_ * velocity_ * velocity_ - weight_ * position_ +
               stored(spring_.stiffness, position_ - spring_.position);
  for (const Stop& stop : stops_)
    sum += stored(stop.stiffness, std::max(0.0, stop.side * (position_ - stop.position)));
  return sum;
}

}  // namespace lockstep
