#include "fb/counters.hpp"

#include <limits>

namespace lockstep {
namespace {

INT one_up(INT count) noexcept {
  return count < std::numeric_limits<INT>::max() ? static_cast<INT>(count + 1) : count;
}

INT one_down(INT count) noexcept {
  return count > std::numeric_limits<INT>::min() ? static_cast<INT>(count - 1) : count;
}

}  // namespace

void CTU::call(std::int64_t /*now*/) noexcept {
  const bool up = CU && !cu_memory_;
  cu_memory_ = CU;
  if (R)
    CV = 0;
  else if (up)
    CV = one_up(CV);
  Q = CV >= PV;
}

void CTD::call(std::int64_t /*now*/) noexcept {
  const bool down = CD && !cd_memory_;
  cd_memory_ = CD;
  if (LD)
    CV = PV;
  else if (down)
    CV = one_down(CV);
  Q = CV <= 0;
}

void CTUD::call(std::int64_t /*now*/) noexcept {
  const bool up = CU && !cu_memory_;
  const bool down = CD && !cd_memory_;
  cu_memory_ = CU;
  cd_memory_ = CD;
  if (R)
    CV = 0;
  else if (LD)
    CV = PV;
  else if (up && !down)
    CV = one_up(CV);
  else if (down && !up)
    CV = one_down(CV);
  QU = CV >= PV;
  QD = CV <= 0;
}

}  // namespace lockstep
