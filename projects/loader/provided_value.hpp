/// What a leading object provides for other controllers.
#pragma once

#include <string>

#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// The settings by which an object provides its leading value.
/// @param object an axis with a position, or an external encoder
const TO_Struct_CrossPlcSynchronousOperation& provided_by(const LeadingObject& object);

/// "Interface[2]".
std::string interface_text(int interface);

/// Why no telegrams go out by an interface of an object, and what is allowed; empty: they do.
std::string interface_problem(const LeadingObject& object, int interface);

}  // namespace lockstep
