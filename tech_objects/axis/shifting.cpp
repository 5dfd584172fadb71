#include "tech_objects/axis/shifting.hpp"

#include <cmath>

#include "tech_objects/axis/synchronous_request.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// By what a phase shift moves an axis that is coupled; 1 for a cam, whose shifts go over a distance.
double ratio_of(const Job& coupling) noexcept {
  if (coupling.kind == JobKind::MC_CamIn) return 1.0;
  const auto& gear = coupling.as<GearJob>();
  return std::abs(static_cast<double>(gear.numerator) / gear.denominator);
}

}  // namespace

void ShiftOrders::begin(Job& job) noexcept {
  auto& asked = job.as<ShiftJob>();
  const bool phasing = is_phasing(job.kind);
  const bool relative = job.kind == JobKind::MC_PhasingRelative || job.kind == JobKind::MC_OffsetRelative;
  Shift& shift = phasing ? synchronous_.phase_shift() : synchronous_.following_offset();
  const bool in_time = phasing && asked.profile == ShiftProfileReference::dynamics;
  const Dynamics dynamics = in_time ? dynamics_.effective(job) : limits_.maximum();
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0) {
    reactions_.raise(zero.alarm, zero.detail);
    return job.fail(ErrorId::technology_alarm);
  }
  // The dynamics are those of the following axis; a phase shift moves it by the ratio.
  const double ratio = phasing ? ratio_of(*jobs_[kBase]) : 1.0;
  const Dynamics of_shift{dynamics.velocity / ratio, dynamics.acceleration / ratio,
                          dynamics.deceleration / ratio, dynamics.jerk / ratio};
  const DoubleDouble target = relative ? shift.value() + asked.shift : DoubleDouble{asked.shift, 0.0};
  const ShiftRequest request = shift_request(asked, target, of_shift);
  asked.base = relative ? shift.value() : DoubleDouble{};
  if (shift.begin(request, period_) != PlanResult::ok) {
    shift.halt();
    return job.fail(ErrorId::unspecified);
  }
  const bool runs = shift.phase() == Shift::Phase::running;
  jobs_.put(phasing ? kPhasing : kOffset, job, runs ? JobPhase::active : JobPhase::waiting);
}

void ShiftOrders::cancel_waiting(Job& job) noexcept {
  const Slot slot = is_phasing(job.kind) ? kPhasing : kOffset;
  if (jobs_[slot] != nullptr && jobs_[slot]->phase == JobPhase::waiting) {
    ends_.abort(slot, AbortedBy::job, &job);
    (slot == kPhasing ? synchronous_.phase_shift() : synchronous_.following_offset()).cancel();
  }
  job.phase = JobPhase::done;
}

void ShiftOrders::take_ratio(const Job& job) noexcept {
  const auto& gear = job.as<GearJob>();
  if (gear.update) synchronous_.change_ratio({gear.numerator, gear.denominator});
}

void ShiftOrders::advance() noexcept {
  SynchronousMotion& motion = synchronous_;
  const SynchronousMotion& shown = motion;
  if (Job* const job = jobs_[kPhasing])
    show(kPhasing, *job, shown.phase_shift(), motion.advance_phase_shift());
  else if (shown.phase_shift().settling())
    motion.advance_phase_shift();
  if (Job* const job = jobs_[kOffset])
    show(kOffset, *job, shown.following_offset(), motion.advance_following_offset());
  else if (shown.following_offset().settling())
    motion.advance_following_offset();
}

inline void ShiftOrders::show(Slot slot, Job& job, const Shift& shift, Shift::Event event) noexcept {
  job.phase = shift.phase() == Shift::Phase::waiting ? JobPhase::waiting : JobPhase::active;
  auto& asked = job.as<ShiftJob>();
  asked.covered = rounded_difference(shift.value(), asked.base);
  if (event != Shift::Event::none) end(slot, event);
}

[[gnu::noinline]] void ShiftOrders::end(Slot slot, Shift::Event event) noexcept {
  if (event == Shift::Event::done) return ends_.end(slot, JobPhase::done, ErrorId::none);
  ends_.end(slot, JobPhase::failed, ErrorId::leading_value_reversed);
}

}  // namespace lockstep
