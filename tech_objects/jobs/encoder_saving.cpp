#include "tech_objects/jobs/encoder_saving.hpp"

namespace lockstep {

void EncoderSaving::submit(Job& job) noexcept {
  if (!kept) return job.fail(ErrorId::encoder_data_protected);
  if (job_ != nullptr) return job.fail(ErrorId::encoder_data_being_saved);
  job_ = &job;
  job.phase = JobPhase::active;
  ++asked;
}

void EncoderSaving::step() noexcept {
  if (job_ == nullptr || answered != asked) return;
  job_->phase = JobPhase::done;
  if (error != WORD{}) job_->fail(static_cast<ErrorId>(error));
  job_ = nullptr;
}

}  // namespace lockstep
