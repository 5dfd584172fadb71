/// The leading value of an object as it is provided to other controllers, and delayed to axes of this one.
/// @source S7-1500T synchronous operation V7, 10.1, 10.7
#pragma once

#include <cstdint>

#include "tech_objects/leading_values/recorded_values.hpp"
#include "tech_objects/leading_values/telegram.hpp"

namespace lockstep {

/// Memory is taken when it is made, at load time. Thread of the rest: the cycle.
class ProvidedValue {
 public:
  ProvidedValue() { recorded_.reserve(); }

  /// @param cycle of the interpolator [ns]  @param delay [s]; no more than `kLongestLeadingDelay` cycles
  /// count
  void configure(const Modulo& modulo, std::int64_t cycle, double delay) noexcept;
  double delay() const noexcept;  ///< [s]

  /// Begins anew: the object has been restarted.
  void clear() noexcept { recorded_.clear(); }

  /// The leading value of this tick. @param now time of it [ns]
  /// @param valid whether it may be followed  @param position_led whether the source is in setpoint operation
  void step(std::int64_t now, const Setpoint& value, bool valid, bool position_led) noexcept;
  /// Positions have other names from now on, each by this more [u].
  void rename(double by) noexcept { recorded_.rename(by); }

  /// As it was `delay` ago; ahead of all that is known where it stood then. Ticks that have been missed do
  /// not count: in them this controller has stood still, and what follows goes on from where it was. After a
  /// `step`.
  Setpoint delayed() const noexcept { return recorded_.at(executed_ - telegram_.delay); }
  /// What other controllers are told in this tick; the sender adds `renamed` and `restarts` of the object.
  const LeadingValueTelegram& telegram() const noexcept { return telegram_; }

 private:
  RecordedValues recorded_;    // by the time of executed ticks
  std::int64_t executed_ = 0;  // [ns] of those
  LeadingValueTelegram telegram_;
};

}  // namespace lockstep
