/// Problems of a project file, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "projects/loader/project.hpp"

namespace lockstep::python {

/// (place, text) of each.
pybind11::list listed(const std::vector<Problem>& problems);

/// The project, if it is valid. The GIL is held.
/// @throws lockstep.InvalidProject with all problems
Project& valid(LoadedProject& loaded);

}  // namespace lockstep::python
