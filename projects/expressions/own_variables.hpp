/// Variables that an object has beside those of its kind, and those that it computes for whoever looks: of an
/// MCO 305 its programs' and its system variables.
#pragma once

#include <span>

#include "tech_objects/data_blocks/own_variable.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

/// They stay where they are once the object is loaded.
std::span<const OwnVariable> own_variables(const TechnologyObject& object) noexcept;

/// A variable of the data block has been found by its path: from now on somebody may read it. Any thread, at
/// any time.
void expect_reads(TechnologyObject& object, const Variable& variable) noexcept;

/// Computes what has been expected since the last tick. Between two ticks.
void bring_up_to_date(TechnologyObject& object) noexcept;

}  // namespace lockstep
