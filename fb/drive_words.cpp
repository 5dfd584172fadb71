#include "fb/drive_words.hpp"

namespace lockstep {

void MC_SetAxisSTW::request(Job& job) const noexcept {
  job.kind = JobKind::MC_SetAxisSTW;
  job.asks = ControlBitsJob{.stw1 = STW1, .stw1_mask = STW1BitMask, .stw2 = STW2, .stw2_mask = STW2BitMask};
}

}  // namespace lockstep
