#include "fb/job_block.hpp"

namespace lockstep {

ErrorId JobBlock::check_inputs() const noexcept {
  if (const ErrorId error = first_error(pin_table(), *this); error != ErrorId::none) return error;
  return wired() ? ErrorId::none : ErrorId::no_technology_object;
}

void JobBlock::set_phase(JobPhase phase, ErrorId error) noexcept {
  phase_ = phase;
  Busy = phase >= JobPhase::handed_over && phase <= JobPhase::reached;
  CommandAborted = phase == JobPhase::aborted;
  Error = phase == JobPhase::failed;
  ErrorID = static_cast<WORD>(Error ? error : ErrorId::none);
}

}  // namespace lockstep
