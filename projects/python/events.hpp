/// What has happened in a run, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "hmi_bridge/traces/event.hpp"

namespace lockstep::python {

/// An event as `lockstep.Event` takes it: its fields in their order.
pybind11::tuple described(const TraceEvent& event);
pybind11::list listed(const std::vector<TraceEvent>& events);

}  // namespace lockstep::python
