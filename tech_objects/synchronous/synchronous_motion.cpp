#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {

void SynchronousMotion::configure(const Modulo& following, double period, double tolerance,
                                  const AdditiveLeadingValues& additive) noexcept {
  leading_.configure(additive);
  function_.configure(following);
  period_ = period;
  tolerance_ = tolerance;
}

void SynchronousMotion::end() noexcept {
  leading_.end();
  function_.end();
}

// ---- Every tick
// -------------------------------------------------------------------------------------------------

/// A leading value that is made of more than the setpoint of its source, or of another one.
void SynchronousMotion::look_closely() noexcept {
  const std::int64_t turned = leading_.look(!synchronous_ || shifted_);
  if (turned == 0) return;
  function_.turn_leading(turned);
  synchronizing_.turn_leading(turned);
  desynchronizing_.turn_leading(turned);
}

/// With a phase shift, an offset, or both.
void SynchronousMotion::advance_shifted(Setpoint& setpoint) noexcept {
  if (shifts_.phase().in_use())
    function_.evaluate(leading_.now(), shifts_.phase());
  else
    function_.evaluate(leading_.now());
  if (shifts_.offset().in_use())
    shifts_.add_offset(function_.value(), function_.following(), setpoint);
  else
    setpoint = function_.value();
}

/// By the velocity alone, on the way in or out.
void SynchronousMotion::advance_otherwise(Setpoint& setpoint) noexcept {
  if (synchronous_) return advance_in_velocity(setpoint);
  if (leaving_) return advance_out(setpoint);
  advance_in(setpoint);
}

/// effective leading value → + phase shift → function
inline void SynchronousMotion::evaluate() noexcept {
  if (const Shift* const phase = phase_in_use(); phase != nullptr)
    function_.evaluate(leading_.now(), *phase);
  else
    function_.evaluate(leading_.now());
}

/// The velocity follows, whatever the position.
void SynchronousMotion::advance_in_velocity(Setpoint& setpoint) noexcept {
  const double last = setpoint.velocity;
  setpoint.velocity = function_.gear().velocity(leading_.now().velocity);
  setpoint.acceleration = function_.gear().acceleration(leading_.now().acceleration);
  setpoint.position =
      advanced(setpoint.position, 0.5 * (last + setpoint.velocity) * period_, function_.following());
  function_.show(setpoint);
}

/// The way in: towards the velocity of the function, or along a profile into it.
void SynchronousMotion::advance_in(Setpoint& setpoint) noexcept {
  if (!leading_.velocity_only()) synchronizing_.watch_reversal(leading_.step(), tolerance_);
  if (synchronizing_.reversed()) return;
  if (synchronizing_.tracks_velocity()) {
    synchronous_ = synchronizing_.track(chain(), setpoint);
    return;
  }
  if (function_.is_cam()) function_.cam().clear_end();
  evaluate();
  const Setpoint function = function_.value();
  if (synchronizing_.follow_profile(chain(), setpoint)) return;
  synchronous_ = true;
  setpoint = function;
  if (shifts_.offset().in_use()) shifts_.add_offset(function, function_.following(), setpoint);
  if (function_.is_cam() && !passed_once()) clear_cam_end();  // it begins, whatever pass that is
}

void SynchronousMotion::advance_out(Setpoint& setpoint) noexcept {
  desynchronizing_.watch_reversal(leading_.step(), tolerance_);
  if (desynchronizing_.reversed()) return;
  desynchronizing_.advance(leading_.step(), function_.following(), setpoint);
  function_.show(setpoint);
}

void SynchronousMotion::change_ratio(const GearRatio& ratio) noexcept {
  if (synchronous_) function_.change_ratio(ratio);
}

bool SynchronousMotion::rests_at_cam_end() const noexcept {
  return function_.cam().rests_at(function_.cam().ended()) && shifts_.phase().velocity() == 0.0 &&
         shifts_.offset().velocity() == 0.0;
}

// ---- Into it
// ----------------------------------------------------------------------------------------------------

void SynchronousMotion::couple(const CouplingRequest& request) noexcept {
  leading_.couple(*request.source, request.coupling, request.velocity_only);
  function_.couple(request, leading_.modulo());
  synchronizing_.couple(request, function_.ratio());
  shifts_.reset();
  shifted_ = false;
  synchronous_ = false;
  leaving_ = false;
}

void SynchronousMotion::begin_at_velocity(const CouplingRequest& request) noexcept {
  couple(request);
  synchronizing_.begin_tracking();
  function_.place_gear({}, {});  // for its ratio; placed when met
}

SyncRefusal SynchronousMotion::begin_waiting(const CouplingRequest& request, const Setpoint& own) noexcept {
  couple(request);
  look_at_leading();
  leading_.forget_last();
  const SyncRefusal why = synchronizing_.begin_waiting(request, chain(), own);
  shifted_ = shifts_.offset().in_use();
  return why;
}

SynchronousMotion::Start SynchronousMotion::watch(const Setpoint& own,
                                                  const SynchronousMotion* active) noexcept {
  look_at_leading();
  Start start = Start::not_yet;
  if (active != nullptr && active->synchronous_) {
    const ChainView view{active->leading_, active->function_, active->shifts_};
    start = synchronizing_.watch(chain(), own, &view);
  } else {
    start = synchronizing_.watch(chain(), own, nullptr);
  }
  shifted_ = shifted_ || shifts_.offset().in_use();
  synchronous_ = start == Start::synchronous;
  return start;
}

void SynchronousMotion::raise_cam(DoubleDouble by) noexcept {
  const DoubleDouble raised = shifts_.offset().value() + by;
  shifts_.begin_with_offset(raised);
  shifted_ = shifted_ || shifts_.offset().in_use();
  function_.cam().set_following_offset(raised.hi);
}

void SynchronousMotion::settle_shifts(const SynchronousMotion& ended, const Dynamics& dynamics) noexcept {
  if (shifts_.settle(ended.shifts_, leading_.step(), dynamics, period_)) shifted_ = true;
}

// ---- Out of it
// --------------------------------------------------------------------------------------------------

bool SynchronousMotion::meets_start_of_leaving(const LeavingRequest& request, const Setpoint& last,
                                               const Setpoint& candidate, const Dynamics& dynamics) noexcept {
  return desynchronizing_.meets(chain(), request, last, candidate, dynamics);
}

void SynchronousMotion::begin_leaving(const Setpoint& last) noexcept {
  leaving_ = true;
  shifts_.reset();
  shifted_ = false;
  synchronous_ = false;
  look_at_leading();
  desynchronizing_.begin(leading_.step(), last);
}

// ---- Names of positions
// --------------------------------------------------------------------------------------------------------

/// The axis has another name for every position. Of a cam that is a following value offset: its function
/// stays.
void SynchronousMotion::shift_following(double by) noexcept {
  if (!leading_.coupled() || leading_.velocity_only()) return;
  function_.shift_shown(by);
  if (leaving_) {
    desynchronizing_.shift_following(by, function_.following());
  } else if (function_.is_cam()) {
    following_offset().shift(by);
    synchronizing_.shift_following(by, function_.following());
    function_.cam().raise(by);
  } else if (synchronous_ || !synchronizing_.tracks_velocity()) {
    const AxisPosition leading = leading_.now().position;
    const AxisPosition following = function_.gear_value(leading);
    function_.place_gear(leading, advanced(following, by, function_.following()));
  }
}

}  // namespace lockstep
