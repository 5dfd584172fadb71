/// Units in words, as a project has chosen them: `Units.LengthUnit` and `Units.VelocityUnit` of its objects.
#pragma once

#include <string>

#include "scheduler/controller.hpp"
#include "tech_objects/types/declaration.hpp"

namespace lockstep {

/// A unit of an object's values, such as "mm/s²". Positions of an object that belongs to another one are
/// those of that one; a rotary axis whose LengthUnit is none of an angle counts in "°". "u" where it has no
/// unit of its own, such as a cam. While nobody writes, which nobody may: any thread.
std::string unit_of(Unit unit, const TechnologyObject& object);

/// A unit of a pin: that of the object that the instance is wired to; of a leading value that of its Master.
std::string unit_of(Unit unit, const Instance& instance);

/// The object that carries out what an instance asks for, which is the one that does not lead; nullptr: the
/// block takes none, or it is not wired.
const TechnologyObject* object_of(const Instance& instance) noexcept;

}  // namespace lockstep
