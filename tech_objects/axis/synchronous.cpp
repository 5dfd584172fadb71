#include "tech_objects/axis/synchronous.hpp"

#include "tech_objects/axis/coupling_chain.hpp"
#include "tech_objects/axis/synchronous_request.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {
namespace {

/// How a coupling at positions synchronizes.
SyncProfileReference profile_of(const Job& job) noexcept {
  return job.kind == JobKind::MC_CamIn ? job.as<CamJob>().profile : job.as<GearJob>().profile;
}

}  // namespace

void FollowingOrders::begin_gear_in(Job& job) noexcept {
  stops_.absorb_superimposed();
  stops_.cut_acceleration();
  const Dynamics dynamics = dynamics_.own(job);
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0) {
    reactions_.raise(zero.alarm, zero.detail);
    return job.fail(ErrorId::technology_alarm);
  }
  jobs_.put(kBase, job, JobPhase::active);
  position_control_.set(job.position_controlled);
  synchronous_.begin_at_velocity(
      coupling_request(job, *find_leading_value(leading_values, master_of(job)), dynamics));
  coupling_.show(job, AxisMotion::synchronizing);
}

void FollowingOrders::begin_waiting(Job& job) noexcept {
  const Dynamics dynamics = dynamics_.effective(job);
  const bool in_time = profile_of(job) == SyncProfileReference::dynamics;
  // Only that is planned with them.
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); in_time && zero.alarm != 0) {
    reactions_.raise(zero.alarm, zero.detail);
    return job.fail(ErrorId::technology_alarm);
  }
  SynchronousMotion planned = awaited_;
  const CouplingRequest request =
      coupling_request(job, *find_leading_value(leading_values, master_of(job)), dynamics);
  const SyncRefusal refusal = planned.begin_waiting(request, setpoint_);
  if (refusal != SyncRefusal::none) return job.fail(error_of(refusal));
  if (!ends_.override_running(class_of(job, false), job)) return;
  awaited_ = planned;
  jobs_.put(kWaiting, job, JobPhase::waiting);
  ends_.show_waiting();
  attention.coupling_has_changed();
}

void FollowingOrders::watch_waiting() noexcept {
  const SynchronousMotion* active = motion_ == AxisMotion::synchronous ? &synchronous_ : nullptr;
  switch (awaited_.watch(setpoint_, active)) {
    case SynchronousMotion::Start::not_yet:
      break;
    case SynchronousMotion::Start::rejected:
      ends_.end(kWaiting, JobPhase::failed, error_of(awaited_.refusal()));
      break;
    case SynchronousMotion::Start::synchronizing:
      activate_waiting(AxisMotion::synchronizing);
      break;
    case SynchronousMotion::Start::synchronous:
      activate_waiting(AxisMotion::synchronous);
      break;
  }
}

/// The waiting job becomes active: now it overrides what moves the axis.
void FollowingOrders::activate_waiting(AxisMotion motion) noexcept {
  Job& job = *jobs_[kWaiting];
  if (!awaited_axis_in_order || led_by(self_, master_of(job)))
    return ends_.end(kWaiting, JobPhase::failed, ErrorId::recursive_coupling);
  if (jobs_.locked()) return ends_.end(kWaiting, JobPhase::failed, ErrorId::locked);
  if (simulated_ != nullptr) return ends_.end(kWaiting, JobPhase::failed, ErrorId::simulated);
  jobs_.take(kWaiting);
  ends_.show_waiting();
  const bool at_cam_end =
      job.kind == JobKind::MC_CamIn && job.as<CamJob>().profile == SyncProfileReference::at_cam_end;
  if (at_cam_end && jobs_[kBase] != nullptr) {
    auto& ended = jobs_[kBase]->as<CamJob>();
    ++ended.ends;
    ended.end_of_profile = true;
  }
  if (!ends_.override_running(class_of(job, true), job)) {
    attention.coupling_has_changed();
    return;
  }
  // The new cam continues the following position of the old one, with what is superimposed on it; what still
  // moves of that goes on by itself, to rest.
  const bool moves = at_cam_end && superimposed_.in_use() && !superimposed_.resting();
  const DoubleDouble superimposed =
      at_cam_end && superimposed_.in_use() && !moves ? superimposed_.value() : DoubleDouble{};
  if (!moves) stops_.absorb_superimposed();
  if (moves) ends_.end(kSuperimposed, JobPhase::aborted, ErrorId::none);
  if (moves) superimposed_.stop(limits_.maximum(), false);
  jobs_.put(kBase, job, motion == AxisMotion::synchronous ? JobPhase::reached : JobPhase::active);
  position_control_.set(true);
  if (at_cam_end) {
    awaited_.raise_cam(superimposed);
    awaited_.settle_shifts(synchronous_, limits_.maximum());
  }
  synchronous_ = awaited_;
  coupling_.show(job, motion);
}

bool FollowingOrders::meet_cam_end() noexcept {
  auto& job = jobs_[kBase]->as<CamJob>();
  ++job.ends;
  if (!synchronous_.passed_once()) {
    synchronous_.clear_cam_end();
    return false;
  }
  job.end_of_profile = true;
  const bool rests = synchronous_.rests_at_cam_end();
  ends_.end(kBase, JobPhase::done, ErrorId::none);
  ends_.abort_shifts(AbortedBy::end_of_cam);
  coupling_.leave();
  if (rests) {
    stops_.stand();
    return false;
  }
  setpoint_ = last_setpoint_;
  stops_.cut_acceleration();
  const Dynamics dynamics = dynamics_.own(Job{});
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0)
    reactions_.raise(zero.alarm, zero.detail);
  else
    stops_.begin(dynamics, false);
  return true;
}

}  // namespace lockstep
