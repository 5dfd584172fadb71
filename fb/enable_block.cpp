#include "fb/enable_block.hpp"

namespace lockstep {

void EnableBlock::call(std::int64_t /*now*/) noexcept {
  const bool rising = Enable && !last_enable_;
  last_enable_ = Enable;
  const bool ended = phase() >= JobPhase::done;
  if (rising) {
    start();
  } else if (ended && !Enable) {
    set_phase(JobPhase::idle, ErrorId::none);  // it was shown for a call at least
  } else if (!ended && phase() != JobPhase::idle) {
    go_on();
  }
}

/// A job that has been let go in this very tick and still runs is taken up again.
void EnableBlock::start() noexcept {
  const bool running = job_.running();
  if (const ErrorId error = check_inputs(); error != ErrorId::none) {
    if (running) job_.as<MotionInJob>().error = error;
    set_phase(JobPhase::failed, error);
    return;
  }
  if (!running) job_ = Job{};
  request(job_);
  if (!running) target()->submit(job_);
  set_phase(job_.phase, job_.error);
}

/// The inputs of this call. A job that has ended shows how, if it was not let go meanwhile.
void EnableBlock::go_on() noexcept {
  set_phase(job_.phase, job_.error);
  if (!job_.running()) return;
  if (!Enable) {
    job_.as<MotionInJob>().hold = false;
    set_phase(JobPhase::idle, ErrorId::none);
    return;
  }
  if (const ErrorId error = check_inputs(); error != ErrorId::none) {
    job_.as<MotionInJob>().error = error;
    set_phase(JobPhase::failed, error);
    return;
  }
  request(job_);
}

}  // namespace lockstep
