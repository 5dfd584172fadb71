/// A trace in memory that others may look into while it grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Memory of a trace: a column of times, then one for each signal, each without gaps. A cell that has been
/// written is never changed, and a block never moves: who holds it may read the rows that were there when
/// they took it for as long as they like, in any thread.
class TraceBlock {
 public:
  /// @throws std::bad_alloc, also where the size is beyond what a machine can address
  TraceBlock(std::size_t columns, std::size_t capacity);

  std::size_t columns() const noexcept { return columns_; }    ///< of signals, without the times
  std::size_t capacity() const noexcept { return capacity_; }  ///< [rows]

  const double* times() const noexcept { return times_.get(); }  ///< [s]
  /// Cells of a signal, `column` < columns(). BOOL is 0 or 1 in `u`; integers and bit strings as `Value` has
  /// them; REAL, LREAL, and TIME in seconds, in `r`.
  const Value* column(std::size_t column) const noexcept { return cells_.get() + column * capacity_; }

 private:
  friend class StoredTrace;

  std::size_t columns_;
  std::size_t capacity_;
  std::unique_ptr<double[]> times_;
  std::unique_ptr<Value[]> cells_;
};

/// Collects rows. When a block is full, a new one takes over what is in it, twice as large. One thread at a
/// time.
class StoredTrace {
 public:
  /// @param signals of the rows, in their order
  explicit StoredTrace(std::vector<TraceSignal> signals);

  /// @throws std::bad_alloc; the trace is as it was then
  void add(const TraceRow& row);
  /// Adds a row of a trace whose values are known as doubles, such as one from a file; every signal is LREAL.
  void add(double time, std::span<const double> values);

  const std::vector<TraceSignal>& signals() const noexcept { return signals_; }
  std::size_t rows() const noexcept { return rows_; }
  /// The block that holds the rows up to now; later ones may go into it as well, behind them. Never null.
  std::shared_ptr<const TraceBlock> block() const noexcept { return block_; }

 private:
  void reserve_row();

  std::vector<TraceSignal> signals_;
  std::size_t rows_ = 0;
  std::shared_ptr<TraceBlock> block_;
};

}  // namespace lockstep
