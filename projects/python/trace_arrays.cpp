#include "projects/python/trace_arrays.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"
#include "projects/python/raise.hpp"
#include "projects/python/sealed.hpp"

namespace py = pybind11;

namespace lockstep::python {
namespace {

/// An array that looks at `memory` and keeps `owner`, whose it is. Nobody writes through it.
py::array array_on(const py::dtype& type, const void* memory, std::size_t rows, py::handle owner) {
  py::array array(type, {static_cast<py::ssize_t>(rows)}, {static_cast<py::ssize_t>(sizeof(Value))}, memory,
                  owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Of the cells of a column: each has 8 bytes, of which a BOOL is the first.
py::dtype dtype_of(Type type) {
  if (type == Type::BOOL) return py::dtype("?");
  if (is_real(type) || type == Type::TIME) return py::dtype("f8");
  return is_signed_integer(type) ? py::dtype("i8") : py::dtype("u8");
}

py::array column(const py::object& self, std::size_t index) {
  const auto& view = self.cast<const TraceView&>();
  if (index >= view.signals().size()) throw py::index_error("a trace has no such column");
  return array_on(dtype_of(view.signals()[index].type), view.block().column(index), view.rows(), self);
}

py::array times(const py::object& self) {
  const auto& view = self.cast<const TraceView&>();
  return array_on(py::dtype("f8"), view.block().times(), view.rows(), self);
}

py::list signals_described(const TraceView& view) {
  py::list signals;
  for (const TraceSignal& signal : view.signals())
    signals.append(py::make_tuple(signal.name, std::string(type_name(signal.type)), signal.unit));
  return signals;
}

TraceView read_csv(const std::string& path) {
  const TraceTable table = read_csv_trace(path);
  StoredTrace trace(table.signals);
  std::vector<double> row(table.signals.size());
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = table.columns[k][i];
    trace.add(table.t[i], row);
  }
  return TraceView(trace);
}

TraceView read_log(const std::string& path) {
  LcmTraceReader reader(path);
  StoredTrace trace(reader.signals());
  while (reader.next()) trace.add(reader.row());
  return TraceView(trace);
}

bool is_unicode(const std::string& text) {
  const auto decoded = py::reinterpret_steal<py::object>(
      PyUnicode_FromStringAndSize(text.data(), static_cast<Py_ssize_t>(text.size())));
  if (!decoded) PyErr_Clear();
  return static_cast<bool>(decoded);
}

/// Names of signals are keys in Python, where they are Unicode.
void require_unicode(const TraceView& view, const std::string& path) {
  for (const TraceSignal& signal : view.signals())
    for (const std::string* const text : {&signal.name, &signal.unit})
      if (!is_unicode(*text))
        throw TraceFormatError(path + ": the name or the unit of a signal is no UTF-8: " + *text);
}

TraceView read_trace(const std::string& path) {
  try {
    TraceView view = path.ends_with(".lcm") ? read_log(path) : read_csv(path);
    require_unicode(view, path);
    return view;
  } catch (const TraceFormatError& error) {
    raise("TraceError", error.what());
  }
}

}  // namespace

TraceView::TraceView(const StoredTrace& trace)
    : block_(trace.block()), signals_(trace.signals()), rows_(trace.rows()) {}

void add_trace(py::module_& module) {
  py::class_<TraceView> type(module, "TraceView",
                             "The memory of a trace; what its arrays have as their base.");
  seal(type);
  type.def_property_readonly("rows", &TraceView::rows)
      .def_property_readonly("signals", &signals_described, "(name, type, unit) of each column.")
      .def_property_readonly(
          "address",
          [](const TraceView& view) { return reinterpret_cast<std::uintptr_t>(view.block().times()); },
          "Where the times stand in memory.")
      .def(
          "column_address",
          [](const TraceView& view, std::size_t index) {
            if (index >= view.signals().size()) throw py::index_error("a trace has no such column");
            return reinterpret_cast<std::uintptr_t>(view.block().column(index));
          },
          py::arg("index"), "Where a column stands in memory.")
      .def("times", &times, "The times of the rows [s], without a copy.")
      .def("column", &column, py::arg("index"), "A column, without a copy.");
  module.def("read_trace", &read_trace, py::arg("path"), "A trace from a .csv or .lcm file.");
}

}  // namespace lockstep::python
