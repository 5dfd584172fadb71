/// What a cam is made of and what it does, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "projects/cam_files/definition.hpp"

namespace lockstep {

/// What an element or transition is called in tables, such as "line" or "modified sine R-G".
std::string stretch_name(const CamDefinition& definition, const CamStretch& stretch);

/// Of a cam that has a function: sizes, extremes, joints, elements with the figures of their laws.
nlohmann::ordered_json cam_facts(const CamDefinition& definition);

}  // namespace lockstep
