#include "projects/python/problems.hpp"

#include "projects/python/raise.hpp"

namespace py = pybind11;

namespace lockstep::python {

py::list listed(const std::vector<Problem>& problems, const TextSource& source) {
  py::list list;
  for (const Problem& problem : problems) {
    const bool included = !problem.file.empty();
    const bool at_line = included || source.as_written;
    list.append(py::make_tuple(shown(problem.place), shown(problem.text),
                               shown(included ? problem.file : source.file), at_line ? problem.line : 0,
                               at_line ? problem.column : 0, shown(problem.owner)));
  }
  return list;
}

Project& valid(LoadedProject& loaded, const TextSource& source) {
  if (loaded.project) return *loaded.project;
  const py::object type = py::module_::import("lockstep.errors").attr("InvalidProject");
  PyErr_SetObject(type.ptr(), type(listed(loaded.problems, source), listed(loaded.warnings, source)).ptr());
  throw py::error_already_set();
}

}  // namespace lockstep::python
