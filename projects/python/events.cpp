#include "projects/python/events.hpp"

#include <string>

namespace py = pybind11;

namespace lockstep::python {

py::tuple described(const TraceEvent& event) {
  return py::make_tuple(static_cast<double>(event.t) / 1e9, std::string(event_kind_text(event.kind)),
                        event.source, event.type, event.number, event.text, event.reaction_text);
}

py::list listed(const std::vector<TraceEvent>& events) {
  py::list list;
  for (const TraceEvent& event : events) list.append(described(event));
  return list;
}

}  // namespace lockstep::python
