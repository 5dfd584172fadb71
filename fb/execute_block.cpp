#include "fb/execute_block.hpp"

namespace lockstep {

void ExecuteBlock::call(std::int64_t /*now*/) noexcept {
  const bool rising = Execute && !last_execute_;
  last_execute_ = Execute;
  if (!rising && phase() == JobPhase::idle) return;
  const bool ended = phase() >= JobPhase::done;
  const bool stays = ended && Execute && !rising;
  if (stays && settled_) return;
  settled_ = stays;
  if (rising) {
    start();
  } else if (ended && !Execute) {
    set_phase(JobPhase::idle, ErrorId::none);  // it was shown for a call at least
  } else if (!ended && job_->phase != phase()) {
    set_phase(job_->phase, job_->error);
  }
  Done = phase() == JobPhase::done;
  show(phase());
}

void ExecuteBlock::start() noexcept {
  if (const ErrorId error = check_inputs(); error != ErrorId::none) {
    job_ = nullptr;  // a job of this instance that still runs goes on, but is no longer shown
    set_phase(JobPhase::failed, error);
    return;
  }
  const bool pending = job_ != nullptr && job_->phase == JobPhase::handed_over;
  const bool waits = job_ != nullptr && job_->phase == JobPhase::waiting;
  const Job* const replaces = pending ? job_->replaces : waits ? job_ : nullptr;
  Job& job = pending ? *job_ : free_job();
  const JobPhase handed = job.phase;
  job = Job{};
  job.phase = handed;  // one that is still on its way to the axis stays in its queue
  job.replaces = replaces;
  request(job);
  job_ = &job;
  if (!pending) hand_over(job);
  set_phase(job.phase, job.error);
}

void ExecuteBlock::hand_over(Job& job) noexcept {
  target()->submit(job);
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
