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
/// @return false if there are too many instances or values: then the root is not whole
bool expand_templates(JsonValue& root, std::deque<JsonValue>& made, std::deque<std::string>& texts,
                      std::vector<Problem>& problems);

}  // namespace lockstep
