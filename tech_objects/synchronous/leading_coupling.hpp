/// The first part of the chain: leading value → + additive → effective leading value.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/synchronous/leading_source.hpp"
#include "tech_objects/synchronous/shift.hpp"

namespace lockstep {

/// What is added to the leading value of one following axis, now and one tick ago.
struct AdditiveLeadingValue {
  double position = 0.0;      ///< [u] of the leading axis
  double velocity = 0.0;      ///< [u/s]
  double acceleration = 0.0;  ///< [u/s²]
};
struct AdditiveLeadingValues {
  bool in_use = false;  ///< whether either is other than zero
  AdditiveLeadingValue now;
  AdditiveLeadingValue last;
};

/// What a following axis sees of its leading axis. Thread: the cycle.
class LeadingCoupling {
 public:
  /// @param additive outlives this
  void configure(const AdditiveLeadingValues& additive) noexcept { additive_ = &additive; }

  void couple(const LeadingSource& source, Coupling coupling, bool velocity_only) noexcept {
    source_ = &source;
    coupling_ = coupling;
    velocity_only_ = velocity_only;
    uncontrolled_seen_ = 0;
    step_.modulo = source.modulo();
    names_ = source.renamed();
  }
  void end() noexcept { source_ = nullptr; }
  bool coupled() const noexcept { return source_ != nullptr; }

  /// Takes up the leading value of this tick where it is nothing but what the source tells: in most ticks.
  /// @param last_counts as in `look`  @return false: `look` has to
  bool look_at_plain(bool last_counts) noexcept {
    if (!source_->leads_as_it_is(coupling_) || additive_->in_use) return false;
    step_.now = source_->leading_state(coupling_);
    if (last_counts) step_.last = source_->last_leading_state(coupling_);
    return true;
  }
  /// Takes up the leading value of this tick.
  /// @param last_counts whether that of the tick before is asked for as well
  /// @return by how many turns the leading axis counts otherwise from now on, at the same place
  std::int64_t look(bool last_counts) noexcept {
    std::int64_t turned = 0;
    if (!source_->leads_as_it_is(coupling_)) {
      turned = look_at_led();
    } else {
      step_.now = source_->leading_state(coupling_);
      if (!last_counts && !additive_->in_use) return 0;
      step_.last = source_->last_leading_state(coupling_);
    }
    if (additive_->in_use) add_additive();
    return turned;
  }
  /// The value of the tick before, where `look` has left it out.
  void look_at_last() noexcept {
    if (!additive_->in_use && source_->leads_as_it_is(coupling_))
      step_.last = source_->last_leading_state(coupling_);
  }
  /// As if the value had been the same in the tick before.
  void forget_last() noexcept { step_.last = step_.now; }

  const Setpoint& now() const noexcept { return step_.now; }    ///< effective leading value
  const Setpoint& last() const noexcept { return step_.last; }  ///< effective leading value one tick ago
  const Modulo& modulo() const noexcept { return step_.modulo; }
  const LeadingStep& step() const noexcept { return step_; }
  bool velocity_only() const noexcept { return velocity_only_; }
  bool of_same_source(const LeadingCoupling& other) const noexcept { return source_ == other.source_; }

  /// Whether the leading value is measured: by the coupling, or as the leading axis is switched off.
  bool follows_actual_value() const noexcept {
    return source_ != nullptr && (coupling_ == Coupling::actual || source_->setpoint_is_actual());
  }
  /// Whether the leading value comes back to this axis, to which it was zero.
  bool sees_return() const noexcept;
  /// Whether it has been zero to this axis; who waits has seen none then, and forgets it.
  bool forget_zero() noexcept {
    const bool seen = uncontrolled_seen_ != 0;
    uncontrolled_seen_ = 0;
    return seen;
  }

 private:
  std::int64_t look_at_led() noexcept;
  void look_by_old_names() noexcept;
  void add_additive() noexcept;

  // What every cycle touches first.
  const LeadingSource* source_ = nullptr;
  const AdditiveLeadingValues* additive_ = nullptr;
  Coupling coupling_ = Coupling::setpoint;
  bool velocity_only_ = false;
  std::uint32_t uncontrolled_seen_ =
      0;  // which time without position control, seen by this coupling; 0: none
  LeadingStep step_;
  std::int64_t zero_turns_ = 0;  // turn of its zero then
  DoubleDouble names_;           // by what the source had been renamed when the coupling began [u]
};

}  // namespace lockstep
