/// Raising the exceptions of the package, which are declared in src/lockstep/errors.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace lockstep::python {

/// A text that may have bytes of a file or of a name, with \xNN for what is no UTF-8.
pybind11::str shown(std::string_view text);

/// Raises an exception of `lockstep.errors` by its name. The GIL is held.
[[noreturn]] void raise(const char* name, const std::string& text);

}  // namespace lockstep::python
