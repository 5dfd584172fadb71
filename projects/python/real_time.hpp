/// A project in real time, for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace lockstep::python {

/// Adds `RealTimeProject` to the module.
void add_real_time_project(pybind11::module_& module);

}  // namespace lockstep::python
