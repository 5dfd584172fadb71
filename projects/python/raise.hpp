/// Raising the exceptions of the package, which are declared in src/lockstep/errors.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace lockstep::python {

/// Raises an exception of `lockstep.errors` by its name. The GIL is held.
[[noreturn]] void raise(const char* name, const std::string& text);

}  // namespace lockstep::python
