#include "fb/execute_block.hpp"

namespace lockstep {

void ExecuteBlock::call(std::int64_t /*now*/) noexcept {
  const bool rising = Execute && !last_execute_;
  last_execute_ = Execute;
  const bool ended = phase_ >= JobPhase::done;
  if (rising) {
    start();
  } else if (ended && !Execute) {
    phase_ = JobPhase::idle;  // it was shown for a call at least
  } else if (!ended && job_ != nullptr && phase_ != JobPhase::idle) {
    phase_ = job_->phase;
    error_ = job_->error;
  }
  Busy = phase_ >= JobPhase::handed_over && phase_ <= JobPhase::reached;
  Done = phase_ == JobPhase::done;
  CommandAborted = phase_ == JobPhase::aborted;
  Error = phase_ == JobPhase::failed;
  ErrorID = static_cast<WORD>(Error ? error_ : ErrorId::none);
  show(phase_);
}

void ExecuteBlock::start() noexcept {
  if (const ErrorId error = check_inputs(); error != ErrorId::none) {
    job_ = nullptr;  // a job of this instance that still runs goes on, but is no longer shown
    phase_ = JobPhase::failed;
    error_ = error;
    return;
  }
  const bool pending = job_ != nullptr && job_->phase == JobPhase::handed_over;
  Job& job = pending ? *job_ : free_job();
  const JobPhase handed = job.phase;
  job = Job{};
  job.phase = handed;  // one that is still on its way to the axis stays in its queue
  request(job);
  job_ = &job;
  if (!pending) hand_over(job);
  phase_ = job.phase;
  error_ = job.error;
}

void ExecuteBlock::hand_over(Job& job) noexcept {
  target()->submit(job);
}

ErrorId ExecuteBlock::check_inputs() const noexcept {
  for (const Pin& pin : pin_table())
    if (pin.error != ErrorId::none && !pin.allows(*this)) return pin.error;
  return wired() ? ErrorId::none : ErrorId::no_technology_object;
}

Job& ExecuteBlock::free_job() noexcept {
  for (Job& job : jobs_)
    if (!job.running()) {
      job.phase = JobPhase::idle;
      return job;
    }
  return *job_;  // never: of three running jobs the shown one is still being handed over
}

}  // namespace lockstep
