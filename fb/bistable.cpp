#include "fb/bistable.hpp"

namespace lockstep {

void SR::call(std::int64_t /*now*/) noexcept {
  Q1 = S1 || (!R && Q1);
}

void RS::call(std::int64_t /*now*/) noexcept {
  Q1 = !R1 && (S || Q1);
}

}  // namespace lockstep
