/// Templates: parts of a project with parameters, of which each instance is a copy.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "projects/json/document.hpp"

namespace lockstep {

/// Puts the instances of a project's templates behind what its sections have.
/// @param root has `templates` and `instances`
/// @param made, texts take what is made
void expand_templates(JsonValue& root, std::deque<JsonValue>& made, std::deque<std::string>& texts,
                      std::vector<Problem>& problems);

}  // namespace lockstep
