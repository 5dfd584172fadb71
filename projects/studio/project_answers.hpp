/// What a page asks of a project besides its values: tags, data blocks, pins, what is wrong with it.
#pragma once

#include <string_view>
#include <vector>

#include "projects/json/problem.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/project_text.hpp"
#include "projects/studio/units.hpp"

namespace lockstep::studio_api {

/// Tags, arrays and texts with what is declared of them, and their addresses on Modbus.
Json tags_json(const Project& project);
/// A technology object with every variable of its data block. @throws BadRequest if there is none
Json object_json(const Project& project, const StudioUnits& units, const StudioProjectText& text,
                 std::string_view name);
/// An instance of a block with its pins and how they are wired. @throws BadRequest if there is none
Json instance_json(const Project& project, const StudioUnits& units, const StudioProjectText& text,
                   std::string_view name);
Json problems_json(const std::vector<Problem>& problems);

}  // namespace lockstep::studio_api
