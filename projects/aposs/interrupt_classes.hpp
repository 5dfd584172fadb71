/// The classes of interrupts by their names, in the order in which DISABLE and ENABLE count them.
#pragma once

#include <iterator>
#include <string_view>

#include "scheduler/aposs/interrupt_operands.hpp"

namespace lockstep::aposs {

inline constexpr std::string_view kInterruptClassNames[] = {"ALL",     "INT",   "POSINT", "COMBIT",
                                                            "STATBIT", "PARAM", "TIME",   "PERIOD"};
static_assert(std::size(kInterruptClassNames) == kInterruptClasses);

}  // namespace lockstep::aposs
