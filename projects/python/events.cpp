#include "projects/python/events.hpp"

#include <pybind11/stl.h>

#include <string>

namespace py = pybind11;

namespace lockstep::python {
namespace {

py::object number_or_none(bool known, double number) {
  return known ? py::object(py::float_(number)) : py::none();
}

}  // namespace

py::tuple described(const TraceEvent& event) {
  return py::make_tuple(static_cast<double>(event.t) / 1e9, std::string(event_kind_text(event.kind)),
                        event.source, event.type, event.number, event.text, event.reaction_text, event.cause,
                        event.remedy, event.address, event.value_name,
                        number_or_none(event.has_value(), event.value), event.limit_name,
                        number_or_none(event.has_limit(), event.limit), event.unit, event.object, event.tick,
                        number_or_none(event.utime != 0, static_cast<double>(event.utime) / 1e6),
                        py::tuple(py::cast(detail_lines(event))));
}

py::list listed(const std::vector<TraceEvent>& events) {
  py::list list;
  for (const TraceEvent& event : events) list.append(described(event));
  return list;
}

}  // namespace lockstep::python
