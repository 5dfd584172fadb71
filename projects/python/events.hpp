/// What has happened in a run, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "hmi_bridge/traces/event.hpp"

namespace lockstep::python {

/// (time [s], kind, source, type, number, text, reaction) of an event, as `lockstep.Event` takes them.
pybind11::tuple described(const TraceEvent& event);
pybind11::list listed(const std::vector<TraceEvent>& events);

}  // namespace lockstep::python
