#include "tech_objects/linmot/motor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep::linmot {
namespace {

constexpr double kMillimetres = 1e3;  // a metre

Limits limits_of(double speed, double acceleration) noexcept {
  return {
      std::max(1, increments(speed, kVelocityIncrement)) * kVelocityIncrement * kMillimetres,
      std::max(1, increments(acceleration, kAccelerationIncrement)) * kAccelerationIncrement * kMillimetres};
}

}  // namespace

void Motor::configure(const MotorSettings& settings, const MotorParameters& parameters, double cycle,
                      double tick) noexcept {
  settings_ = settings;
  cycle_ = cycle;
  tick_ = tick;
  limiter_.configure(cycle);
  thermal_.configure(settings.thermal, tick, std::max(1, static_cast<int>(std::lround(tick / cycle))));
  player_.configure(cycle);
  has_plant_ = settings.exists;
  force_constant_ = settings.force_constant;
  position_ = last_position_ = settings.start_position;
  if (has_plant_) plant_.configure(settings.plant, settings.start_position);
  take(parameters);
  setpoint_ = {actual(), 0.0, 0.0};
  limiter_.begin(actual());
  demand_ = actual();
  loop_.reset(position_);
}

void Motor::configure_loop() noexcept {
  const double maximum = std::min(parameters_.maximal_current, hardware_current_);
  const double limit = gentle_ ? maximum * parameters_.maximal_init_current / 100.0 : maximum;
  loop_.configure({.proportional = parameters_.proportional,
                   .derivative = parameters_.derivative,
                   .integral = parameters_.integral,
                   .friction = parameters_.ff_friction,
                   .acceleration = parameters_.ff_acceleration,
                   .deceleration = parameters_.ff_deceleration,
                   .offset = parameters_.current_offset,
                   .maximum_current = limit},
                  cycle_);
}

void Motor::take(const MotorParameters& parameters) noexcept {
  parameters_ = parameters;
  configure_loop();
  filter_ = limits_of(parameters.max_speed, parameters.max_acceleration);
  offset_ = parameters.curve_pos_offset;
  amplitude_ = parameters.curve_amplitude / 100.0;
  lowest_ = parameters.minimal_position;
  highest_ = parameters.maximal_position;
  bound_ = std::min(lowest_, highest_);
  rate_ = parameters.curve_speed / 100.0;
  if (curve_mode_ && !frozen_) player_.set_rate(rate_);
  if (energised_ && !frozen_ && !curve_mode_ && order_.follows_filter && !homes()) {
    order_.limits = filter_;
    limiter_.limit(filter_);
  }
}

double Motor::bounded(double position) const noexcept {
  return std::clamp(position, bound_, highest_);
}

// ---- Orders

void Motor::enter_run() noexcept {
  curve_missing_ = rise_waits_ = fall_waits_ = analog_known_ = false;
  last_trigger_ = trigger_level();
  if (!energised_) energise();
}

void Motor::energise() noexcept {
  energised_ = true;
  curve_mode_ = frozen_ = has_waiting_order_ = false;
  armed_.reset();
  queued_.reset();
  setpoint_ = {actual(), 0.0, 0.0};
  limiter_.begin(actual());
  loop_.reset(position_);
  gentle_ = homes();
  configure_loop();
  order_ = {.position = demand_, .limits = filter_, .follows_filter = true};
  limiter_.go_to(bounded(demand_), filter_);
}

void Motor::execute(const Order& order) noexcept {
  queued_.reset();
  if (!frozen_) return apply(order);
  has_waiting_order_ = true;
  if (order.kind == Order::Kind::increment) {
    demand_ += order.position;
    order_ = order;
    order_.kind = Order::Kind::position;
    order_.position = demand_;
    return;
  }
  order_ = order;
  if (order.kind == Order::Kind::position) demand_ = order.position;
}

void Motor::apply(const Order& order) noexcept {
  has_waiting_order_ = false;
  if (order.kind == Order::Kind::curve) {
    if (order.curve != nullptr) start_curve(order);
    return;
  }
  const double target = order.kind == Order::Kind::increment ? demand_ + order.position : order.position;
  order_ = order;
  order_.kind = Order::Kind::position;
  order_.position = target;
  go(target, order.limits, order.from_actual);
}

/// From the present set-point, whoever has made it, or from where the slider is.
void Motor::go(double target, const Limits& limits, bool from_actual) noexcept {
  demand_ = bounded(target);
  if (from_actual) {
    curve_mode_ = false;
    limiter_.begin(actual(), velocity_);
  } else if (curve_mode_) {
    leave_curve();
  }
  limiter_.go_to(demand_, limits);
}

/// The curve still gives the set-point of the next control cycle, from which the limiter goes on.
void Motor::leave_curve() noexcept {
  if (player_.begun()) setpoint_ = step_of_curve();
  curve_mode_ = false;
  player_.stop();
  limiter_.begin(setpoint_.position, setpoint_.velocity);
}

void Motor::start_curve(const Order& order) noexcept {
  order_ = order;
  curve_mode_ = true;
  if (order.from_demand) offset_ = setpoint_.position - amplitude_ * order.curve->start();
  player_.start(*order.curve, order.cyclic, rate_);
  demand_ = bounded(offset_ + amplitude_ * order.curve->end());
}

void Motor::set_demand(double position) noexcept {
  demand_ = bounded(position);
}

void Motor::stop(double acceleration) noexcept {
  if (curve_mode_) leave_curve();
  const Limits braking = limits_of(1.0, acceleration);
  limiter_.stop(braking.acceleration);
  demand_ = limiter_.target();
  order_ = {.position = demand_, .limits = {filter_.velocity, braking.acceleration}};
  has_waiting_order_ = false;
}

void Motor::freeze(bool frozen) noexcept {
  if (frozen == frozen_ || !energised_) return;
  frozen_ = frozen;
  if (!frozen) return resume();
  has_waiting_order_ = false;
  if (curve_mode_ && player_.begun())
    return player_.ramp_to(0.0, std::abs(setpoint_.velocity) / filter_.acceleration);
  if (!curve_mode_) return limiter_.stop(order_.limits.acceleration);
  // It has come in the tick in which the motor freezes: it waits.
  has_waiting_order_ = true;
  leave_curve();
  limiter_.stop(filter_.acceleration);
}

/// The last order that has come meanwhile, or else what was interrupted.
void Motor::resume() noexcept {
  if (has_waiting_order_) {
    Order order = order_;
    if (order.follows_filter) order.limits = filter_;
    return apply(order);
  }
  if (curve_mode_) {
    const double velocity = std::abs(amplitude_) * rate_ *
                            std::abs(player_.curve()->function().value(player_.time()).first_derivative);
    player_.ramp_to(rate_, velocity / filter_.acceleration);
    return;
  }
  if (order_.follows_filter) order_.limits = filter_;
  limiter_.go_to(demand_, order_.limits);
}

void Motor::demand_to_actual() noexcept {
  curve_mode_ = false;
  player_.stop();
  demand_ = bounded(actual());
  has_waiting_order_ = false;
  order_ = {.position = demand_, .limits = filter_, .follows_filter = true};
  limiter_.begin(demand_);
  setpoint_ = {demand_, 0.0, 0.0};
}

void Motor::move_names(double distance) noexcept {
  shift_ -= distance;
  demand_ += distance;
  setpoint_.position += distance;
  order_.position += distance;
  limiter_.begin(setpoint_.position);
}

/// Homing ends, and with it the current that it may press with stays as low; where no position is known, none
/// is gone to.
void Motor::emergency_stop() noexcept {
  using enum EmergencyStopMode;
  frozen_ = false;
  disarm();
  queued_.reset();
  give_up_homing();
  const Limits limits = limits_of(parameters_.emergency_max_speed, parameters_.emergency_max_acceleration);
  switch (static_cast<EmergencyStopMode>(parameters_.emergency_stop_mode)) {
    case off:
      return switch_off();
    case freeze:
      return stop(parameters_.emergency_max_acceleration);
    case goto_position:
      if (!homed_) return stop(parameters_.emergency_max_acceleration);
      order_ = {.position = parameters_.stop_position, .limits = limits};
      return go(parameters_.stop_position, limits, false);
  }
}

// ---- Homing

double Motor::direction_of_search() const noexcept {
  const auto mode = static_cast<InitMode>(parameters_.init_mode);
  return mode == InitMode::auto_move_out || mode == InitMode::trig_move_out ? 1.0 : -1.0;
}
bool Motor::by_trigger() const noexcept {
  const auto mode = static_cast<InitMode>(parameters_.init_mode);
  return mode == InitMode::trig_move_out || mode == InitMode::trig_move_in;
}
Limits Motor::homing_limits() const noexcept {
  return limits_of(parameters_.init_speed, parameters_.max_acceleration);
}

void Motor::begin_homing() noexcept {
  demand_ = actual();
  homed_ = false;
  if (static_cast<InitMode>(parameters_.init_mode) == InitMode::actual_position) {
    homing_ = Homing::initial;
    energise();
    assign_home();
    homing_ = Homing::done;
    homed_ = true;
    gentle_ = false;
    configure_loop();
    return;
  }
  homing_ = Homing::search;
  energise();
  slow_ticks_ = limit_ticks_ = 0;
  if (by_trigger() && trigger_level()) {
    homing_ = Homing::leave_trigger;
    search(-direction_of_search());
    return;
  }
  search(direction_of_search());
}

void Motor::search(double direction) noexcept {
  limiter_.run(direction * parameters_.init_speed * kMillimetres, homing_limits());
}

void Motor::end_homing() noexcept {
  if (homing_ == Homing::done || !energised_) return switch_off();
  homing_ = Homing::none;
  brakes_ = true;
  limiter_.stop(filter_.acceleration);
}

/// Where the slider is now is the home position.
void Motor::assign_home() noexcept {
  shift_ = position_ - parameters_.home_position;
  demand_ = parameters_.home_position;
  limiter_.begin(demand_);
  setpoint_ = {demand_, 0.0, 0.0};
  order_ = {.position = demand_, .limits = filter_, .follows_filter = true};
  loop_.reset(position_);
}

void Motor::homing_move(Homing to, double target) noexcept {
  constexpr double kPatience = 2.0;  // [s]
  homing_ = to;
  demand_ = target;
  limiter_.go_to(target, homing_limits());
  homing_ticks_left_ = static_cast<std::int64_t>((limiter_.duration() + kPatience) / tick_) + 1;
}

bool Motor::arrived() noexcept {
  return limiter_.at_end() && actual() - demand_ >= -parameters_.in_position_minus &&
         actual() - demand_ <= parameters_.in_position_plus;
}

void Motor::home_on() noexcept {
  constexpr double kStopTime = 0.020;  // [s] at the limit of the current, and slow
  const double limit =
      std::min(parameters_.maximal_current, hardware_current_) * parameters_.maximal_init_current / 100.0;
  const bool slow = std::abs(velocity_) < 0.5 * parameters_.init_speed * kMillimetres;
  slow_ticks_ = slow ? slow_ticks_ + 1 : 0;
  limit_ticks_ = std::abs(current_) >= limit * (1.0 - 1e-9) ? limit_ticks_ + 1 : 0;
  bool found = false;
  switch (homing_) {
    case Homing::leave_trigger:
      if (trigger_level()) return;
      homing_ = Homing::search;
      return search(direction_of_search());
    case Homing::search:
      found = by_trigger() ? trigger_level() && !last_trigger_
                           : std::min(slow_ticks_, limit_ticks_) * tick_ >= kStopTime - 1e-9;
      if (!found) return;
      assign_home();
      if (parameters_.check_init_position != parameters_.initial_position)
        return homing_move(Homing::check, parameters_.check_init_position);
      return homing_move(Homing::initial, parameters_.initial_position);
    case Homing::check:
    case Homing::initial:
      if (arrived()) {
        if (homing_ == Homing::check) return homing_move(Homing::initial, parameters_.initial_position);
        homing_ = Homing::done;
        homed_ = true;
        gentle_ = false;
        order_ = {.position = demand_, .limits = filter_, .follows_filter = true};
        return configure_loop();
      }
      if (--homing_ticks_left_ <= 0) homing_ = Homing::failed;
      return;
    default:
      return;
  }
}

// ---- Run modes and triggers

/// Which it mostly is on its way to, or at.
inline void Motor::keep_going_to(double target) noexcept {
  if (!analog_known_ || demand_ != bounded(target)) begin_going_to(target);
}

void Motor::begin_going_to(double target) noexcept {
  analog_known_ = true;
  execute({.position = target, .limits = filter_, .follows_filter = true});
}

double Motor::analog_target() const noexcept {
  const double volts =
      settings_.analog != nullptr && std::isfinite(*settings_.analog) ? *settings_.analog : 0.0;
  const double part = std::clamp(volts, 0.0, 10.0) / 10.0;
  return parameters_.position_0v + (parameters_.position_10v - parameters_.position_0v) * part;
}

void Motor::run_mode(bool rising, bool falling) noexcept {
  switch (static_cast<RunMode>(parameters_.run_mode)) {
    case RunMode::analog:
      return keep_going_to(analog_target());
    case RunMode::two_point:
      return keep_going_to(trigger_level() ? parameters_.position_1 : parameters_.position_0);
    case RunMode::continuous_curve:
      if (curve_active() && parameters_.curve_number != running_curve_) player_.end_cycle();
      if (!curve_active()) run_curve(parameters_.curve_number, true);
      return;
    case RunMode::trigger_curve:
      return follow_trigger(rising, falling);
    case RunMode::serial:
      return;
  }
}

/// An edge while a curve runs has its curve at the end of that one; a rise takes back a fall that waits.
void Motor::follow_trigger(bool rising, bool falling) noexcept {
  if (rising && !std::exchange(fall_waits_, false)) rise_waits_ = true;
  if (falling) fall_waits_ = true;
  if (curve_active()) return;
  if (std::exchange(rise_waits_, false)) return run_curve(parameters_.rise_curve_number, false);
  if (std::exchange(fall_waits_, false)) run_curve(parameters_.fall_curve_number, false);
}

void Motor::run_curve(DINT number, bool cyclic) noexcept {
  running_curve_ = number;
  const Curve* const curve = curve_of(number);
  if (number != 0 && curve == nullptr) {
    curve_missing_ = true;
    return;
  }
  execute({.kind = Order::Kind::curve, .curve = curve, .cyclic = cyclic});
}

void Motor::take_waiting_orders(bool rising) noexcept {
  if (armed_ && rising) {
    const Order order = *armed_;
    armed_.reset();
    execute(order);
  }
  if (queued_ && !curve_active()) {
    const Order order = *queued_;
    execute(order);
  }
}

void Motor::tick(bool running) noexcept {
  velocity_ = (position_ - last_position_) / tick_;
  last_position_ = position_;
  if (thermal_.calculates()) thermal_.tick();
  const bool level = trigger_level();
  const bool rising = level && !last_trigger_;
  const bool falling = !level && last_trigger_;
  if (acknowledge_ticks_ > 0) --acknowledge_ticks_;
  if (brakes_ && limiter_.at_end()) switch_off();
  if (homes()) home_on();
  if (running && energised_) {
    if (armed_ || queued_) take_waiting_orders(rising);
    if (parameters_.run_mode != static_cast<DINT>(RunMode::serial)) run_mode(rising, falling);
  }
  last_trigger_ = level;
}

// ---- Control cycles

inline LoopSetpoint Motor::step_of_curve() noexcept {
  const LoopSetpoint setpoint = player_.step(offset_, amplitude_);
  if (setpoint.position >= lowest_ && setpoint.position <= highest_) return setpoint;
  return {bounded(setpoint.position), 0.0, 0.0};
}

inline void Motor::next_of_curve() noexcept {
  setpoint_ = step_of_curve();
  if (player_.running() || frozen_) return;
  curve_mode_ = false;
  demand_ = setpoint_.position;
  limiter_.begin(demand_);
}

inline void Motor::next_setpoint() noexcept {
  if (curve_mode_)
    next_of_curve();
  else
    setpoint_ = limiter_.step();
}

/// Without current.
void Motor::rest(int cycles) noexcept {
  current_ = 0.0;
  for (int i = 0; has_plant_ && i < cycles; ++i) {
    position_ = plant_.position();
    plant_.step(0.0, cycle_);
  }
  setpoint_ = {actual(), 0.0, 0.0};
}

/// What is measured is where the slider is when the set-point is made.
void Motor::run(int cycles) noexcept {
  const bool heats = thermal_.calculates();
  if (!energised_) return rest(cycles);
  if (!has_plant_) {
    for (int i = 0; i < cycles; ++i) next_setpoint();
    position_ = setpoint_.position + shift_;
    return;
  }
  for (int i = 0; i < cycles; ++i) {
    next_setpoint();
    const LoopSetpoint on_machine{setpoint_.position + shift_, setpoint_.velocity, setpoint_.acceleration};
    position_ = plant_.position();
    current_ = loop_.step(on_machine, position_);
    if (heats) thermal_.add(current_);
    plant_.step(force_constant_ * current_, cycle_);
  }
}

bool Motor::in_position() const noexcept {
  if (frozen_ || has_waiting_order_ || acknowledge_ticks_ > 0 || curve_mode_ || !limiter_.at_end())
    return false;
  const double difference = actual() - demand_;
  return difference >= -parameters_.in_position_minus && difference <= parameters_.in_position_plus;
}

}  // namespace lockstep::linmot
