#include "projects/runtime/stored_trace.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kFirstRows = 1024;

/// Cells of a block; their number is not allowed to overflow, whatever a caller asks for.
std::size_t cells_of(std::size_t columns, std::size_t capacity) {
  const std::size_t limit = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(Value);
  if (columns != 0 && capacity > limit / columns) throw std::bad_alloc();
  return columns * capacity;
}

}  // namespace

// Not initialized: of memory that nobody has written the system gives none.
TraceBlock::TraceBlock(std::size_t columns, std::size_t capacity)
    : columns_(columns),
      capacity_(capacity),
      times_(std::make_unique_for_overwrite<double[]>(cells_of(1, capacity))),
      cells_(std::make_unique_for_overwrite<Value[]>(cells_of(columns, capacity))) {}

StoredTrace::StoredTrace(std::vector<TraceSignal> signals)
    : signals_(std::move(signals)), block_(std::make_shared<TraceBlock>(signals_.size(), kFirstRows)) {}

void StoredTrace::reserve_row() {
  if (rows_ < block_->capacity()) return;
  const auto larger = std::make_shared<TraceBlock>(block_->columns(), 2 * block_->capacity());
  std::copy_n(block_->times_.get(), rows_, larger->times_.get());
  for (std::size_t column = 0; column < signals_.size(); ++column)
    std::copy_n(block_->column(column), rows_, larger->cells_.get() + column * larger->capacity());
  block_ = larger;
}

void StoredTrace::add(const TraceRow& row) {
  reserve_row();
  // Divided, so that a time is the double that is nearest to its decimal number, as in a file.
  block_->times_[rows_] = static_cast<double>(row.t) / 1e9;
  for (std::size_t column = 0; column < signals_.size(); ++column) {
    Value value = row.values[column];
    if (signals_[column].type == Type::TIME) value.r = static_cast<double>(value.i) / 1e9;
    block_->cells_[column * block_->capacity() + rows_] = value;
  }
  ++rows_;
}

void StoredTrace::add(double time, std::span<const double> values) {
  reserve_row();
  block_->times_[rows_] = time;
  for (std::size_t column = 0; column < signals_.size(); ++column)
    block_->cells_[column * block_->capacity() + rows_].r = values[column];
  ++rows_;
}

}  // namespace lockstep
