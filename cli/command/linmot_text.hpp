/// What of LinMot controllers counts, as text: limits and tables in whole increments.
#pragma once

#include <string>

#include "projects/loader/project.hpp"

namespace lockstep::cli {

/// Rows and codes of a controller, a line each.
std::string linmot_table_text(const LinMotController& controller);
/// The rows as they may be read again: state;A;B;C;D, then a row in each line.
std::string linmot_table_csv(const LinMotController& controller);
/// Limits of the motors, rows and codes of every such controller; empty where there is none.
std::string linmot_counting(const Project& project);

}  // namespace lockstep::cli
