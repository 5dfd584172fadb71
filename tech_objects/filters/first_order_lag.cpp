#include "tech_objects/filters/first_order_lag.hpp"

#include "tech_objects/arithmetic/decay.hpp"

namespace lockstep {

void FirstOrderLag::tune(double time_constant, double period) noexcept {
  time_constant_ = time_constant;
  decay_ = time_constant > 0.0 ? decay_within(period / time_constant) : 1.0;
  gain_ = time_constant / period * decay_;
}

}  // namespace lockstep
