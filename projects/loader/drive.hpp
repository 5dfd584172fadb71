/// The drive of an axis, and the machine behind it.
#pragma once

#include "projects/loader/loader.hpp"

namespace lockstep {

void load_drive(const JsonValue& json, Axis& axis, const Loading& loading);

}  // namespace lockstep
