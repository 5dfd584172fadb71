#include "projects/python/problems.hpp"

namespace py = pybind11;

namespace lockstep::python {

py::list listed(const std::vector<Problem>& problems) {
  py::list list;
  for (const Problem& problem : problems) list.append(py::make_tuple(problem.place, problem.text));
  return list;
}

Project& valid(LoadedProject& loaded) {
  if (loaded.project) return *loaded.project;
  const py::object type = py::module_::import("lockstep.errors").attr("InvalidProject");
  PyErr_SetObject(type.ptr(), type(listed(loaded.problems), listed(loaded.warnings)).ptr());
  throw py::error_already_set();
}

}  // namespace lockstep::python
