#include "fb/long_counters.hpp"

namespace lockstep {

template struct UpCounter<DINT>;
template struct DownCounter<DINT>;
template struct UpDownCounter<DINT>;

}  // namespace lockstep
