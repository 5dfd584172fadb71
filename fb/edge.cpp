#include "fb/edge.hpp"

namespace lockstep {

void R_TRIG::call(std::int64_t /*now*/) noexcept {
  Q = CLK && !memory_;
  memory_ = CLK;
}

void F_TRIG::call(std::int64_t /*now*/) noexcept {
  Q = !CLK && !memory_;
  memory_ = !CLK;
}

}  // namespace lockstep
