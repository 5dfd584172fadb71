#include "fb/save_encoder_data.hpp"

namespace lockstep {

void MC_SaveAbsoluteEncoderData::connect(EncoderSaving& saving) noexcept {
  if (saving.admit()) saving_ = &saving;
}

void MC_SaveAbsoluteEncoderData::hand_over(Job& job) noexcept {
  if (saving_ == nullptr) return job.fail(ErrorId::encoder_data_instances);
  saving_->submit(job);
}

}  // namespace lockstep
