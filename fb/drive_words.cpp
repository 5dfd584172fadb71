#include "fb/drive_words.hpp"

namespace lockstep {

void MC_SetAxisSTW::hand_over(Job& job) noexcept {
  if (Axis->stopping() && !Axis->power.enable) {
    job.phase = JobPhase::aborted;
    return;
  }
  const ErrorId error = Axis->set_control_bits(STW1, STW1BitMask, STW2, STW2BitMask);
  if (error != ErrorId::none) return job.fail(error);
  job.phase = JobPhase::done;
}

}  // namespace lockstep
