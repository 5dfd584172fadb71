/// FUNCTIONS.md: the chapter of operators, functions, conversions, types and literals.
#pragma once

#include <string>

namespace lockstep {

std::string functions_document();

}  // namespace lockstep
