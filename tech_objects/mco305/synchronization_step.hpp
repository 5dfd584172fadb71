/// A millisecond of following, inline: who calls it in every step spares calls and what they save. What few
/// steps need is called.
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/mco305/synchronization.hpp"
#include "tech_objects/mco305/units.hpp"

namespace lockstep::mco305 {

[[gnu::always_inline]] inline void Synchronization::step(const MasterInput& master,
                                                         std::int64_t actual) noexcept {
  const auto moved = static_cast<double>(master.moved());
  master_position_ = master.position();
  if (mode_ == SyncMode::kVelocity) {
    velocity_ = velocity_filter_.step(moved, filter_time_);
    return;
  }
  gear_.move(master.moved());
  double velocity = moved, lag = 0.0;
  if (smooths_) {
    velocity =
        velocity_filter_.step_and_return(moved, filter_limit_ > 0.0 ? faded_time(moved) : filter_time_);
    lag = velocity_filter_.lag();
    velocity_ = velocity_filter_.velocity();
  } else {
    velocity_ = moved;
  }
  const double ratio = gear_.ratio();
  if (mode_ == SyncMode::kMarkers) {
    if (following_) look_for_markers(master, actual);
    trimmed_ += velocity * filter_.trim() * ratio;
  }
  before_ = target_;
  const double offset = offset_.step(), correction = correction_.step();
  const double spread = offset_.velocity() * ratio + correction_.velocity();
  const double target_velocity = velocity * ratio * (1.0 + filter_.trim()) + spread;
  const double position = gear_.position();
  target_ = {.position = position + (offset - lag) * ratio + correction + trimmed_ +
                         velocity_precontrol_ * target_velocity,
             .velocity = target_velocity,
             .spread = spread};
  if (path_.active()) [[unlikely]]
    follow_path();
  wanted_ = nearest_count(position + total_offset());
}

/// Those of the master in this step, and what has been missed.
[[gnu::always_inline]] inline void Synchronization::look_for_markers(const MasterInput& master,
                                                                     std::int64_t actual) noexcept {
  if (master.mark_count() != 0) take_master_marks(master);
  if (master_window_.missed(static_cast<double>(master_position_), master_tolerance_)) miss_master_mark();
  if (slave_window_.missed(static_cast<double>(actual), slave_tolerance_)) miss_slave_mark();
}

[[gnu::always_inline]] inline void Synchronization::set_point(std::int64_t actual,
                                                              bool controls_velocity) noexcept {
  last_velocity_ = pursuit_.velocity();
  if (mode_ == SyncMode::kVelocity) {
    follow_velocity(actual, controls_velocity);
  } else if (awaits_path_) [[unlikely]] {
    pursuit_.follow(0.0, limits_);
  } else if (gives_back_) [[unlikely]] {
    pursue_what_holds_back();
  } else {
    const Target& aim = pursued();
    limits_.spread = aim.spread;
    pursuit_.step(aim.position, aim.velocity, limits_);
  }
  if (!reached_) [[unlikely]]
    look_whether_reached();
}

/// Until the velocity of the master has been reached once a small error is the beginning of a large one.
/// Behind the end of the mode its flags stay as they were.
inline void Synchronization::judge(std::int64_t actual) noexcept {
  if (mode_ < SyncMode::kPosition) return;
  if (following_ || later_edition_) error_ = wanted_ - actual;
  if (following_ && reached_) quality_.look(error_, accuracy_);
}

}  // namespace lockstep::mco305
