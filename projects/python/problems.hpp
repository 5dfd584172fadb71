/// Problems of a project file, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "projects/loader/project.hpp"

namespace lockstep::python {

/// Where the text of a project comes from.
struct TextSource {
  std::string file;         ///< its name; empty: none
  bool as_written = false;  ///< the lines of the text are those that its author knows
};

/// (place, text, file, line, column, owner) of each; line and column are 0 where nobody knows the lines.
pybind11::list listed(const std::vector<Problem>& problems, const TextSource& source);

/// The project, if it is valid. The GIL is held.
/// @throws lockstep.InvalidProject with all problems
Project& valid(LoadedProject& loaded, const TextSource& source);

}  // namespace lockstep::python
