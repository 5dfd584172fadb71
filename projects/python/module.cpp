// The extension module of the Python package: what lockstep/ is made on.
#include <pybind11/pybind11.h>

#include "projects/python/real_time.hpp"
#include "projects/python/stepped_project.hpp"
#include "projects/python/trace_arrays.hpp"

PYBIND11_MODULE(_lockstep, module) {
  module.doc() = "The runtime in C++; what programs use is in lockstep.";
  module.attr("__version__") = LOCKSTEP_VERSION;
  lockstep::python::add_trace(module);
  lockstep::python::add_stepped_project(module);
  lockstep::python::add_real_time_project(module);
}
