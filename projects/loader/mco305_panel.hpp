/// Parameters of an MCO 305 that are written from outside: they count as changed at its panel.
#pragma once

#include "projects/expressions/names.hpp"

namespace lockstep {

/// What is there may be written from now on. While loading, or between two ticks.
void expect_writes(const Operand& place) noexcept;

}  // namespace lockstep
