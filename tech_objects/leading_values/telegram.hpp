/// What one leading object tells other controllers of its leading value, once per application cycle.
/// @source S7-1500T synchronous operation V7, 10.1, 10.3, 10.7
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/arithmetic/setpoint.hpp"

namespace lockstep {

/// A leading value with the time to which it belongs and all that a receiver needs to know of its source.
struct LeadingValueTelegram {
  std::uint64_t sequence = 0;  ///< one more with each telegram of the source, from 1
  std::uint64_t run = 0;       ///< of the controller that sends, another one each time it is started
  std::int64_t time = 0;       ///< of the application cycle [ns], on the clock that all controllers share
  std::int64_t cycle = 0;      ///< application cycle of the sender [ns] > 0
  std::int64_t delay = 0;      ///< LocalLeadingValueDelayTime of the source [ns] ≥ 0
  Setpoint value;              ///< on the ring of the source
  Modulo modulo;               ///< of the source
  DoubleDouble renamed;        ///< by how much homing has changed the names of its positions so far [u]
  std::uint32_t restarts = 0;  ///< of the source so far
  bool valid = false;          ///< whether the value may be followed
  bool position_led = false;   ///< whether the source is led by its setpoint; else it is in follow-up
};

}  // namespace lockstep
