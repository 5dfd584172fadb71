#include "tech_objects/axis/homing.hpp"

#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

void HomingOrders::begin_in_passing(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  if (asked.mode == HomeMode::passive_configured) asked.position = data.Homing.HomePosition;
  if (!names_.fit(names_.distance_to(asked.position))) return job.fail(ErrorId::position);
  ends_.end(kPassiveHoming, JobPhase::aborted, ErrorId::none);
  jobs_.put(kPassiveHoming, job, JobPhase::active);
  homing_now_ = true;
  if (asked.mode != HomeMode::passive) homed_ = false;
  if (has_drive_)
    switches_.search_mark(false,
                          passive_direction(data.Sensor[encoders_.operative()].PassiveHoming.Direction));
}

void HomingOrders::begin_active(Job& job) noexcept {
  auto& asked = job.as<HomingJob>();
  const auto& settings = data.Sensor[encoders_.operative()].ActiveHoming;
  if (asked.mode == HomeMode::active_configured) asked.position = data.Homing.HomePosition;
  const double mark = asked.position - settings.HomePositionOffset;
  if (!names_.fit(names_.distance_to(mark)) || !names_.fit(names_.distance_to(asked.position)))
    return job.fail(ErrorId::position);
  // What acts on a coupling ends with it.
  ends_.abort_shifts(AbortedBy::job, &job);
  homed_ = false;
  homing_now_ = true;
  const bool has_switch = settings.Mode != static_cast<DINT>(HomingMark::zero_mark);
  using Phase = HomingCourse::Phase;
  homing_.begin({.direction = settings.Direction == HomingDirection::positive ? 1 : -1,
                 .mark = mark,
                 .approach_velocity = data.Homing.ApproachVelocity,
                 .referencing_velocity = data.Homing.ReferencingVelocity,
                 .positive_side = settings.SideInput},
                // A virtual axis has no marks: one is taken to be where it is.
                !has_drive_  ? Phase::travel
                : has_switch ? Phase::approach
                             : Phase::search);
  job.velocity = homing_.velocity();
  asked.direction = homing_.settings().direction;
  if (!has_drive_) {
    asked.mark_position = mark;
    names_.assign(actual_, mark);
  } else {
    if (has_switch) asked.direction = data.Homing.ApproachDirection ? -1 : 1;
    switches_.search_mark(true, homing_.settings().direction);
  }
  motion_orders_.begin(job);
  if (!job.running()) ends_.leave_homing();
}

void HomingOrders::step() noexcept {
  Job* base = jobs_[kBase];
  const bool active = base != nullptr && base->kind == JobKind::MC_Home;
  if (active && homing_.travels()) return;
  const bool met = homing_.found() && homing_.phase() != HomingCourse::Phase::back;
  if (!has_drive_ || met) return take_mark();
  if (active) guide(*base);
}

/// From one phase of an active homing to the next.
void HomingOrders::guide(Job& job) noexcept {
  const auto mark = static_cast<HomingMark>(data.Sensor[encoders_.operative()].ActiveHoming.Mode);
  const int direction = job.as<HomingJob>().direction;
  const bool at_limit_switch = switches_.homing_reverses() && limit_switches_.pressed(direction);
  const HomingCourse::Leg leg = homing_.guide(mark, direction, at_limit_switch);
  if (leg.kind == HomingCourse::Leg::Kind::gives_up)
    return reactions_.raise(alarm::kMarkNotFound,
                            {.cause = side_of(direction),
                             .sensor = static_cast<std::uint8_t>(encoders_.operative() + 1),
                             .value = actual_.value});
  if (leg.kind == HomingCourse::Leg::Kind::goes_on) return;
  if (leg.search != 0) switches_.search_mark(true, leg.search);
  head_for(job, leg.phase, leg.direction);
}

void HomingOrders::head_for(Job& job, HomingCourse::Phase phase, int direction) noexcept {
  homing_.enter(phase);
  job.as<HomingJob>().direction = direction;
  job.velocity = homing_.velocity();
  arrival_.begin();
  limits_.remember();
  Dynamics dynamics = dynamics_.own(job);
  if (const ZeroLimit zero = limits_.zero_limit(dynamics); zero.alarm != 0)
    return reactions_.raise(zero.alarm, zero.detail);
  if (superimposed_.advancing_base()) dynamics_.leave_to_superimposed(&job, dynamics);
  if (motion_orders_.plan(job, dynamics) == PlanResult::ok) return;
  ends_.end(kBase, JobPhase::failed, ErrorId::unspecified);
  stops_.begin(limits_.maximum(), false);
}

AxisPosition HomingOrders::place_of_mark() const noexcept {
  const double start = drive_->signals().start_position;
  return encoders_.position_of_machine(two_difference(homing_.mark_position(), start), sensors_.play());
}

/// The mark has been passed; a virtual axis has none, and takes the place where it is.
void HomingOrders::take_mark() noexcept {
  const AxisPosition place = has_drive_ ? place_of_mark() : actual_;
  homing_.end_search();
  Job* const passive = jobs_[kPassiveHoming];
  Job& job = passive != nullptr ? *passive : *jobs_[kBase];
  auto& asked = job.as<HomingJob>();
  asked.mark_position = passive != nullptr ? asked.position : homing_.settings().mark;
  if (!names_.assign(place, asked.mark_position))
    return reactions_.raise(alarm::kHomingNotPossible,
                            {.value = asked.mark_position, .limit = kPositionRange});
  if (passive != nullptr) return ends_.end(kPassiveHoming, JobPhase::done, ErrorId::none);
  switches_.renew_watch();
  head_for(job, HomingCourse::Phase::travel, 0);
}

}  // namespace lockstep
