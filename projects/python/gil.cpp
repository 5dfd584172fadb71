#include "projects/python/gil.hpp"

#include <cxxabi.h>
#include <unistd.h>

namespace py = pybind11;

namespace lockstep::python {
namespace {

[[noreturn]] void stay() noexcept {
  while (true) pause();
}

/// Calls what takes the GIL.
template <class Call>
void come_back(Call call) {
  if (_Py_IsFinalizing() != 0) stay();
  try {
    call();
  } catch (const abi::__forced_unwind&) {
    stay();  // the interpreter has begun to end in between; leaving this handler would go on unwinding
  }
}

}  // namespace

WithoutGil::~WithoutGil() {
  if (state_ != nullptr) come_back([this] { PyEval_RestoreThread(state_); });
}

void look_at_signals() {
  come_back([] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

}  // namespace lockstep::python
