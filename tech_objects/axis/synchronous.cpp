// Motion of an axis that another one leads.
#include <cmath>

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/synchronous_request.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/function_state.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// How a coupling at positions synchronizes.
SyncProfileReference profile_of(const Job& job) noexcept {
  return job.kind == JobKind::MC_CamIn ? job.as<CamJob>().profile : job.as<GearJob>().profile;
}

/// By what a phase shift moves an axis that is coupled; 1 for a cam, whose shifts go over a distance.
double ratio_of(const Job& coupling) noexcept {
  if (coupling.kind == JobKind::MC_CamIn) return 1.0;
  const auto& gear = coupling.as<GearJob>();
  return std::abs(static_cast<double>(gear.numerator) / gear.denominator);
}

}  // namespace

void AxisOrders::begin_gear_in(Job& job) noexcept {
  absorb_superimposed();
  cut_acceleration();
  const Dynamics dynamics = own_dynamics(job);
  if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  jobs_.put(kBase, job, JobPhase::active);
  set_position_control(job.position_controlled);
  synchronous_.begin_at_velocity(coupling_request(job, *find_leading_value(master_of(job)), dynamics));
  show_coupling(job, Motion::synchronizing);
}

/// One that is rejected leaves what waits already.
void AxisOrders::begin_waiting(Job& job) noexcept {
  const Dynamics dynamics = effective_dynamics(job);
  const bool in_time = profile_of(job) == SyncProfileReference::dynamics;
  const int alarm_number = in_time ? limits_.zero_limit(dynamics) : 0;  // only that is planned with them
  if (alarm_number != 0) {
    raise(alarm_number);
    return job.fail(ErrorId::technology_alarm);
  }
  SynchronousMotion planned = awaited_;
  const CouplingRequest request = coupling_request(job, *find_leading_value(master_of(job)), dynamics);
  const SyncRefusal refusal = planned.begin_waiting(request, setpoint_);
  if (refusal != SyncRefusal::none) return job.fail(error_of(refusal));
  if (!override_running(class_of(job, false), job)) return;
  awaited_ = planned;
  jobs_.put(kWaiting, job, JobPhase::waiting);
  data.StatusSynchronizedMotion.WaitingFunctionState =
      waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
  coupling_changed = true;
}

/// Each tick while a synchronous job waits: has the leading value met the start?
void AxisOrders::watch_waiting() noexcept {
  const SynchronousMotion* active = motion_ == Motion::synchronous ? &synchronous_ : nullptr;
  switch (awaited_.watch(setpoint_, active)) {
    case SynchronousMotion::Start::not_yet:
      break;
    case SynchronousMotion::Start::rejected:
      end_job(kWaiting, JobPhase::failed, error_of(awaited_.refusal()));
      break;
    case SynchronousMotion::Start::synchronizing:
      activate_waiting(Motion::synchronizing);
      break;
    case SynchronousMotion::Start::synchronous:
      activate_waiting(Motion::synchronous);
      break;
  }
}

/// The waiting job becomes active: now it overrides what moves the axis.
void AxisOrders::activate_waiting(Motion motion) noexcept {
  Job& job = *jobs_[kWaiting];
  if (!awaited_axis_in_order || led_by_this(master_of(job)))
    return end_job(kWaiting, JobPhase::failed, ErrorId::recursive_coupling);
  if (jobs_.locked()) return end_job(kWaiting, JobPhase::failed, ErrorId::locked);
  if (simulating()) return end_job(kWaiting, JobPhase::failed, ErrorId::simulated);
  jobs_.take(kWaiting);
  data.StatusSynchronizedMotion.WaitingFunctionState =
      waiting_function_state(jobs_[kWaiting], jobs_[kWaitingOut]);
  const bool at_cam_end =
      job.kind == JobKind::MC_CamIn && job.as<CamJob>().profile == SyncProfileReference::at_cam_end;
  if (at_cam_end && jobs_[kBase] != nullptr) {
    auto& ended = jobs_[kBase]->as<CamJob>();
    ++ended.ends;
    ended.end_of_profile = true;
  }
  if (!override_running(class_of(job, true), job)) {
    coupling_changed = true;
    return;
  }
  // The new cam continues the following position of the old one, with what is superimposed on it; what still
  // moves of that goes on by itself, to rest.
  const bool moves = at_cam_end && superimposed_.in_use() && !superimposed_.resting();
  const DoubleDouble superimposed =
      at_cam_end && superimposed_.in_use() && !moves ? superimposed_.value() : DoubleDouble{};
  if (!moves) absorb_superimposed();
  if (moves) end_job(kSuperimposed, JobPhase::aborted, ErrorId::none);
  if (moves) superimposed_.stop(limits_.maximum(), false);
  jobs_.put(kBase, job, motion == Motion::synchronous ? JobPhase::reached : JobPhase::active);
  set_position_control(true);
  if (at_cam_end) {
    awaited_.raise_cam(superimposed);
    awaited_.settle_shifts(synchronous_, limits_.maximum());
  }
  synchronous_ = awaited_;
  show_coupling(job, motion);
}

void AxisOrders::show_coupling(const Job& job, Motion motion) noexcept {
  motion_ = motion;
  coupling_changed = true;
  LeadingObject* const master = master_of(job);
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = function_state(job.kind);
  status.ActualMaster = master->number;
  status.PhaseShift = status.Offset = 0.0;
  coupled_ = {master, nullptr};
  if (job.kind != JobKind::MC_CamIn) return clear_cam_status();
  const auto& cam = job.as<CamJob>();
  coupled_.cam = cam.cam;
  status.ActualCam = cam.cam->number;
  status.MasterOffset = synchronous_.leading_offset();
  status.MasterScaling = cam.master_scaling;
  status.SlaveOffset = synchronous_.following_offset_at_start();
  status.SlaveScaling = cam.slave_scaling;
}

void AxisOrders::clear_cam_status() noexcept {
  const TO_Struct_StatusSynchronizedMotion none;
  auto& status = data.StatusSynchronizedMotion;
  status.ActualCam = none.ActualCam;
  status.MasterOffset = none.MasterOffset;
  status.MasterScaling = none.MasterScaling;
  status.SlaveOffset = none.SlaveOffset;
  status.SlaveScaling = none.SlaveScaling;
}

/// What the coupling depends on in this tick: ratio, leading value, shifts.
void AxisOrders::look_at_coupling(const Job& job) noexcept {
  if (job.kind == JobKind::MC_GearInVelocity) {
    const auto& gear = job.as<GearJob>();
    if (gear.update) synchronous_.change_ratio({gear.numerator, gear.denominator});
  }
  synchronous_.look_at_leading();
  if (synchronous_.shifted()) advance_shifts();
}

void AxisOrders::step_synchronous() noexcept {
  Job* job = jobs_[kBase];
  look_at_coupling(*job);
  if (motion_ == Motion::synchronous && jobs_[kWaitingOut] == nullptr) {
    synchronous_.advance(setpoint_);
    if (synchronous_.at_cam_end()) meet_cam_end();
    return;
  }
  Setpoint next = setpoint_;
  synchronous_.advance(next);
  if (motion_ == Motion::synchronous) {
    if (watch_sync_out(superimposed_.advancing_base() ? superimposed_.with(next, modulo_) : next)) return;
    setpoint_ = next;
    if (synchronous_.at_cam_end()) meet_cam_end();
    return;
  }
  if (synchronous_.reversed()) {
    raise(alarm::kSynchronizing);  // the stop begins at the last setpoint that followed
    return step_single_axis();
  }
  setpoint_ = next;
  if (motion_ == Motion::desynchronizing) {
    if (synchronous_.left()) end_desynchronizing();
    return;
  }
  if (!synchronous_.synchronous()) return;
  motion_ = Motion::synchronous;
  job->phase = JobPhase::reached;
  if (synchronous_.at_cam_end()) meet_cam_end();
}

/// The leading value has reached an end of the cam. One that is passed once ends its job: the axis stands at
/// the end, or brakes if the cam ends with a slope.
void AxisOrders::meet_cam_end() noexcept {
  auto& job = jobs_[kBase]->as<CamJob>();
  ++job.ends;
  if (!synchronous_.passed_once()) return synchronous_.clear_cam_end();
  job.end_of_profile = true;
  const bool rests = synchronous_.rests_at_cam_end();
  end_job(kBase, JobPhase::done, ErrorId::none);
  for (const Slot slot : {kPhasing, kOffset, kWaitingOut}) end_job(slot, JobPhase::aborted, ErrorId::none);
  leave_synchronous();
  if (rests) {
    setpoint_.velocity = 0.0;
    setpoint_.acceleration = 0.0;
    return single_.stand(setpoint_);
  }
  setpoint_ = last_setpoint_;
  cut_acceleration();
  const Dynamics dynamics = own_dynamics(Job{});
  if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0)
    raise(alarm_number);
  else
    begin_stop(dynamics, false);
  step_single_axis();
}

// ---- Shifts
// -----------------------------------------------------------------------------------------------------

/// MC_LeadingValueAdditive: what counts from this tick on.
void AxisOrders::take_additive() noexcept {
  additive_.last = additive_.now;
  additive_.now = additive_request.counts ? additive_request.value : AdditiveLeadingValue{};
  const auto zero = [](const AdditiveLeadingValue& value) {
    return value.position == 0.0 && value.velocity == 0.0 && value.acceleration == 0.0;
  };
  additive_.in_use = !zero(additive_.now) || !zero(additive_.last);
}

/// MC_Phasing… and MC_Offset…
void AxisOrders::begin_shift(Job& job) noexcept {
  auto& asked = job.as<ShiftJob>();
  const bool phasing = is_phasing(job.kind);
  const bool relative = job.kind == JobKind::MC_PhasingRelative || job.kind == JobKind::MC_OffsetRelative;
  Shift& shift = phasing ? synchronous_.phase_shift() : synchronous_.following_offset();
  const bool in_time = phasing && asked.profile == ShiftProfileReference::dynamics;
  const Dynamics dynamics = in_time ? effective_dynamics(job) : limits_.maximum();
  if (const int alarm_number = limits_.zero_limit(dynamics); alarm_number != 0) {
    raise(alarm_number);
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

void AxisOrders::advance_shifts() noexcept {
  const Shift& phase = synchronous_.phase_shift();
  const Shift& offset = synchronous_.following_offset();
  if (jobs_[kPhasing] != nullptr)
    show_shift(kPhasing, phase, synchronous_.advance_phase_shift());
  else if (phase.settling())
    synchronous_.advance_phase_shift();
  if (jobs_[kOffset] != nullptr)
    show_shift(kOffset, offset, synchronous_.advance_following_offset());
  else if (offset.settling())
    synchronous_.advance_following_offset();
}

void AxisOrders::show_shift(Slot slot, const Shift& shift, Shift::Event event) noexcept {
  Job& job = *jobs_[slot];
  job.phase = shift.phase() == Shift::Phase::waiting ? JobPhase::waiting : JobPhase::active;
  auto& asked = job.as<ShiftJob>();
  asked.covered = rounded_difference(shift.value(), asked.base);
  if (event == Shift::Event::none) return;
  if (event == Shift::Event::done) return end_job(slot, JobPhase::done, ErrorId::none);
  end_job(slot, JobPhase::failed, ErrorId::leading_value_reversed);
}

void AxisOrders::leave_synchronous() noexcept {
  if (!led()) return;
  motion_ = Motion::single_axis;
  forget_coupling();
}

void AxisOrders::forget_coupling() noexcept {
  synchronous_.end();
  coupled_ = {};
  coupling_changed = true;
  auto& status = data.StatusSynchronizedMotion;
  status.FunctionState = 0;
  status.ActualMaster = DB_ANY{};
  status.PhaseShift = status.Offset = 0.0;
  clear_cam_status();
  status.StatusWord = DWORD{};
}

}  // namespace lockstep
