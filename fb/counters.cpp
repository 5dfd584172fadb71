#include "fb/counters.hpp"

namespace lockstep {

template struct UpCounter<INT>;
template struct DownCounter<INT>;
template struct UpDownCounter<INT>;

}  // namespace lockstep
