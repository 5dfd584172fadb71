#include "projects/python/raise.hpp"

namespace py = pybind11;

namespace lockstep::python {

void raise(const char* name, const std::string& text) {
  const py::object type = py::module_::import("lockstep.errors").attr(name);
  PyErr_SetObject(type.ptr(), py::str(text).ptr());
  throw py::error_already_set();
}

}  // namespace lockstep::python
