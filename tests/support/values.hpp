/// Values of signals, out of numbers.
#pragma once

#include <cstdint>

#include "tech_objects/types/types.hpp"

namespace lockstep::test {

inline Value real(double number) {
  return {.r = number};
}
inline Value integer(std::int64_t number) {
  return {.i = number};
}

}  // namespace lockstep::test
