/// Classes whose objects C++ alone makes.
#pragma once

#include <pybind11/pybind11.h>

namespace lockstep::python {

/// Takes `__new__` from a class, by which Python could make an object that has never been constructed.
inline void seal(const pybind11::handle& type) {
  reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = nullptr;
}

}  // namespace lockstep::python
