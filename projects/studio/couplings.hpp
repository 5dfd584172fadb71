/// What follows what in a project, for pages: also over transfer areas, to and from other controllers.
#pragma once

#include "projects/loader/project.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/project_text.hpp"

namespace lockstep::studio_api {

/// Couplings of programs and those that the project allows, then those over transfer areas, whose `area` is
/// told; of an end on another controller `remote` says which, `leading` or `following`. `delay` is the path
/// of the variable by which a leading value is delayed here, where one is.
/// @source S7-1500T synchronous operation V7, 10.6.2
Json couplings_json(const Project& project, const StudioProjectText& text);

}  // namespace lockstep::studio_api
