#include "fb/enable_block.hpp"

namespace lockstep {

void EnableBlock::call(std::int64_t /*now*/) noexcept {
  const bool rising = Enable && !last_enable_;
  last_enable_ = Enable;
  const bool ended = phase_ >= JobPhase::done;
  if (rising) {
    start();
  } else if (ended && !Enable) {
    phase_ = JobPhase::idle;  // it was shown for a call at least
  } else if (!ended && phase_ != JobPhase::idle) {
    go_on();
  }
  Busy = phase_ >= JobPhase::handed_over && phase_ <= JobPhase::reached;
  CommandAborted = phase_ == JobPhase::aborted;
  Error = phase_ == JobPhase::failed;
  ErrorID = static_cast<WORD>(Error ? error_ : ErrorId::none);
}

/// A job that has been let go in this very tick and still runs is taken up again.
void EnableBlock::start() noexcept {
  error_ = check_inputs();
  phase_ = JobPhase::failed;
  if (error_ != ErrorId::none) {
    job_.input_error = error_;
    return;
  }
  const bool running = job_.running();
  if (!running) job_ = Job{};
  request(job_);
  job_.hold = true;
  job_.input_error = ErrorId::none;
  if (!running) target()->submit(job_);
  phase_ = job_.phase;
  error_ = job_.error;
}

/// The inputs of this call. A job that has ended shows how, if it was not let go meanwhile.
void EnableBlock::go_on() noexcept {
  phase_ = job_.phase;
  error_ = job_.error;
  if (!job_.running()) return;
  if (!Enable) {
    job_.hold = false;
    phase_ = JobPhase::idle;
    return;
  }
  if (const ErrorId error = check_inputs(); error != ErrorId::none) {
    job_.input_error = error_ = error;
    phase_ = JobPhase::failed;
    return;
  }
  request(job_);
}

ErrorId EnableBlock::check_inputs() const noexcept {
  for (const Pin& pin : pin_table())
    if (pin.error != ErrorId::none && !pin.allows(*this)) return pin.error;
  return target() == nullptr ? ErrorId::no_technology_object : ErrorId::none;
}

}  // namespace lockstep
