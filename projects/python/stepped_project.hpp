/// A project in virtual time, for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace lockstep::python {

/// Adds `SteppedProject` and `check` to the module.
void add_stepped_project(pybind11::module_& module);

}  // namespace lockstep::python
