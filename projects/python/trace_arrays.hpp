/// Columns of a trace as NumPy arrays that look into its memory.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "projects/runtime/stored_trace.hpp"

namespace lockstep::python {

/// A trace as it stood at one moment: the block of its values with the number of rows that count. Every array
/// that is made of it holds it, and so the memory, for as long as the array or a view of it is there.
class TraceView {
 public:
  explicit TraceView(const StoredTrace& trace);

  std::size_t rows() const noexcept { return rows_; }
  const std::vector<TraceSignal>& signals() const noexcept { return signals_; }
  const TraceBlock& block() const noexcept { return *block_; }

 private:
  std::shared_ptr<const TraceBlock> block_;
  std::vector<TraceSignal> signals_;
  std::size_t rows_;
};

/// Adds the class to the module.
void add_trace(pybind11::module_& module);

}  // namespace lockstep::python
