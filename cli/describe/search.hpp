/// What has to do with a word: the search of `lockstep describe`.
#pragma once

#include <string>
#include <vector>

#include "cli/describe/subject.hpp"

namespace lockstep::cli {

/// Everything in whose name or meaning all words occur, best first: blocks, pins, variables, alarms, errors,
/// keys, functions, operators and types of expressions. @return an empty subject if there is nothing, or the
/// words are too short to search for
Subject search_subject(const std::vector<std::string>& words);

/// Something of a dialect, with what else, of all but dialects, is called like that: the command HOME, and
/// MC_Home.
Subject with_namesakes(const Subject& subject, const std::string& word);

}  // namespace lockstep::cli
