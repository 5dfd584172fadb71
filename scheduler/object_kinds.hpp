/// Making technology objects by their kind.
#pragma once

#include <memory>
#include <string>

#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

/// An object of a published kind, with its start values. @param number position in `technology_objects`, from
/// 1
std::unique_ptr<TechnologyObject> make_object(ObjectKind kind, std::string name, DB_ANY number);

/// Where the kind stands in the order in which objects take part in a phase of a tick: what others look at
/// comes first. Objects of one kind take part in the order of the project.
std::size_t index_in_phase(ObjectKind kind) noexcept;

}  // namespace lockstep
