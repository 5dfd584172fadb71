#include "tech_objects/drive/machine_plant.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/arithmetic/decay.hpp"

namespace lockstep {
namespace {

/// An integral part takes about as long as this many time constants of the velocity loop.
constexpr double kIntegralTimes = 4.0;

}  // namespace

void MachinePlant::configure(const MachinePlantSettings& settings, double motor_angle, double start,
                             double time_constant, double cycle) noexcept {
  settings_ = settings;
  inertia_ = settings.inertia * motor_angle;
  per_torque_ = cycle / inertia_;
  rubs_ = per_torque_ * settings.friction;
  can_be_disturbed_ = settings.friction != 0.0 || settings.load_torque != 0.0 || settings.has_stop;
  undisturbed_ = !can_be_disturbed_;
  start_ = start;
  cycle_ = cycle;
  // A stop takes the energy of what runs into it: critically damped with the inertia of the machine.
  damping_ = settings.has_stop ? 2.0 * std::sqrt(settings.stop.stiffness * inertia_) : 0.0;
  learning_ = decay_within(cycle / (kIntegralTimes * std::max(time_constant, cycle)));
  known_ = torque_ = 0.0;
}

TorqueBand MachinePlant::permitted(const TorqueBand& limits) const noexcept {
  const double maximum = settings_.maximum_torque;
  return {std::clamp(limits.lower, -maximum, maximum), std::clamp(limits.upper, -maximum, maximum)};
}

/// What the stop pushes back with, against its side ≥ 0: spring and damper for place and velocity at the end
/// of the cycle, of which it takes part itself, so that no stiffness is too high for the cycle.
/// @param velocity at the end of the cycle without the stop
double MachinePlant::stop_torque(const Begin& begin, double velocity) const noexcept {
  const double towards = settings_.stop.side * velocity;
  const double depth =
      settings_.stop.side * (begin.place + start_ - settings_.stop.position) + towards * cycle_;
  if (depth <= 0.0) return 0.0;
  const double stiffness = settings_.stop.stiffness;
  const double torque =
      (stiffness * depth + damping_ * towards) / (1.0 + per_torque_ * (stiffness * cycle_ + damping_));
  return std::max(torque, 0.0);
}

/// The motor does what it may; the velocity that comes of it.
inline double MachinePlant::push(double velocity_before, double wanted_velocity, const TorqueBand& permitted,
                                 double additive) noexcept {
  const double asked = (wanted_velocity - velocity_before) / per_torque_ + known_ + additive;
  torque_ = permitted.cut(asked);
  limited_ = torque_ != asked;
  return wanted_velocity + per_torque_ * ((torque_ - asked) + (known_ + additive + settings_.load_torque));
}

MachinePlant::Motion MachinePlant::step(const Begin& begin, const Motion& wanted, bool pulses,
                                        const TorqueBand& permitted, double additive) noexcept {
  if (!pulses) {
    torque_ = known_ = 0.0;
    undisturbed_ = !can_be_disturbed_;
    if (begin.velocity == 0.0) return {};  // the brake holds
  }
  double velocity = pulses ? push(begin.velocity, wanted.velocity, permitted, additive)
                           : begin.velocity + per_torque_ * settings_.load_torque;
  double stopped = 0.0, pushed_back = 0.0;
  if (settings_.has_stop) {
    stopped = stop_torque(begin, velocity);
    pushed_back = settings_.stop.side * stopped;
    velocity -= per_torque_ * settings_.stop.side * stopped;
  }
  const double rubbed = std::clamp(velocity, -rubs_, rubs_);
  velocity -= rubbed;
  if (!pulses && velocity * begin.velocity <= 0.0) velocity = 0.0;
  const double friction = rubbed == 0.0 ? rubbed : rubbed / per_torque_;  // a division is long
  const double against = pushed_back + friction - settings_.load_torque - additive;
  if (pulses) known_ += (against - known_) * learning_;
  undisturbed_ = !can_be_disturbed_ && known_ == 0.0;
  // At the stop with the velocity of the end, as its torque has been found; else the means of the cycle.
  if (stopped > 0.0) return {velocity * cycle_, velocity};
  if (!pulses || limited_) return {0.5 * (begin.velocity + velocity) * cycle_, velocity};
  return {wanted.distance + 0.5 * (velocity - wanted.velocity) * cycle_, velocity};
}

void MachinePlant::hold(double wanted_velocity, const TorqueBand& permitted) noexcept {
  torque_ = permitted.cut(inertia_ / cycle_ * wanted_velocity);
}

}  // namespace lockstep
