/// Who leads whom, over any number of couplings.
#pragma once

#include <vector>

#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// Whether an object is the axis `first`, or follows one that is.
bool led_by(const LeadingObject& first, const LeadingObject* leading) noexcept;

/// The interconnection with an object; nullptr: there is none.
const LeadingValue* find_leading_value(const std::vector<LeadingValue>& leading_values,
                                       const LeadingObject* leading) noexcept;

}  // namespace lockstep
