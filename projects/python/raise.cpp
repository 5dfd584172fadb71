#include "projects/python/raise.hpp"

namespace py = pybind11;

namespace lockstep::python {

py::str shown(std::string_view text) {
  const auto decoded = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
  if (!decoded) throw py::error_already_set();
  return py::str(decoded);
}

void raise(const char* name, const std::string& text) {
  const py::object type = py::module_::import("lockstep.errors").attr(name);
  PyErr_SetObject(type.ptr(), shown(text).ptr());
  throw py::error_already_set();
}

}  // namespace lockstep::python
