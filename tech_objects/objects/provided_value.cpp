#include "tech_objects/objects/provided_value.hpp"

#include <algorithm>

#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep {

void ProvidedValue::configure(const Modulo& modulo, std::int64_t cycle, double delay) noexcept {
  telegram_.modulo = modulo;
  telegram_.cycle = cycle;
  telegram_.delay = std::min(nanoseconds(delay), kLongestLeadingDelay * cycle);
  recorded_.set_source(modulo, cycle);
}

double ProvidedValue::delay() const noexcept {
  return seconds(telegram_.delay);
}

void ProvidedValue::step(std::int64_t now, const Setpoint& value, bool valid, bool position_led) noexcept {
  ++telegram_.sequence;
  telegram_.time = now;
  telegram_.value = value;
  telegram_.valid = valid;
  telegram_.position_led = position_led;
  executed_ += telegram_.cycle;
  recorded_.add(executed_, value);
}

}  // namespace lockstep
