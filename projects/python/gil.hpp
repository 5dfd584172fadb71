/// Letting the GIL go, and coming back, also where the interpreter ends meanwhile: up to Python 3.13 it
/// unwinds a thread that comes back then, and unwinding ends the process where it meets a destructor.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

namespace lockstep::python {

/// Between two looks at signals, such as that of Ctrl-C.
inline constexpr std::chrono::milliseconds kBetweenLooks{50};

/// Lets the GIL go for its lifetime; not in the thread that ends the interpreter, which has it to the end.
/// Another thread that comes back then stays here for ever.
class WithoutGil {
 public:
  WithoutGil() : state_(_Py_IsFinalizing() != 0 ? nullptr : PyEval_SaveThread()) {}
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;  // nullptr: it has not been let go
};

/// In a thread that has let the GIL go: has handlers of signals run, as Ctrl-C asks for.
/// @throws pybind11::error_already_set with what they raise, such as KeyboardInterrupt
void look_at_signals();

}  // namespace lockstep::python
