#include "hmi_bridge/traces/flight_recorder.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

namespace lockstep {

FlightRecorder::FlightRecorder(FlightRecorderOptions options, std::vector<std::size_t> columns,
                               std::int64_t period)
    : options_(std::move(options)),
      columns_(std::move(columns)),
      capacity_(static_cast<std::size_t>(options_.before / std::max<std::int64_t>(period, 1)) + 1),
      values_(columns_.size()),
      recordings_(options_.file) {}

void FlightRecorder::begin(std::span<const TraceSignal> signals) {
  for (const std::size_t column : columns_) signals_.push_back(signals[column]);
  memory_.resize(capacity_ * columns_.size());
  rows_.resize(capacity_);
}

void FlightRecorder::row(const TraceRow& row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) values_[i] = row.values[columns_[i]];
  TraceRow part = row;
  part.values = values_;
  if (file_) {
    write(part);
    if (until_ && row.t >= *until_) close();
  }
  std::copy(values_.begin(), values_.end(),
            memory_.begin() + static_cast<std::ptrdiff_t>(next_ * columns_.size()));
  rows_[next_] = row;
  next_ = (next_ + 1) % capacity_;
  count_ = std::min(count_ + 1, capacity_);
}

void FlightRecorder::event(const TraceEvent& event) {
  if (event.kind != EventKind::alarm) return;
  if (!file_) {
    if (opened_ >= options_.files) return;
    ++opened_;
    open();
  }
  until_ = event.t + options_.after;
}

void FlightRecorder::open() {
  try {
    file_ = recordings_.open_next();
    // Before anything is written: on a full disk the old ones make space for it.
    not_removed_ = recordings_.remove_oldest(static_cast<std::size_t>(options_.keep));
    file_->begin(signals_);
  } catch (const std::filesystem::filesystem_error& error) {
    file_.reset();
    return lose(count_, error.code().message());
  } catch (const std::exception& error) {
    file_.reset();
    return lose(count_, error.what());
  }
  write_kept();
}

void FlightRecorder::write_kept() {
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t at = (next_ + capacity_ - count_ + i) % capacity_;
    TraceRow row = rows_[at];
    row.values = {memory_.data() + at * columns_.size(), columns_.size()};
    write(row);
  }
}

void FlightRecorder::write(const TraceRow& row) {
  try {
    file_->row(row);
  } catch (const std::exception& error) {
    file_->lose(1, error.what());
  }
}

void FlightRecorder::close() {
  try {
    file_->end();
  } catch (const std::exception& error) {
    file_->lose(0, error.what());
  }
  const std::string path(file_->name());
  if (file_->reason().empty())
    written_.push_back(path);
  else
    lose(file_->lost(), path + ": " + file_->reason());
  file_.reset();
  until_.reset();
}

void FlightRecorder::flush() {
  if (file_) file_->flush();
}

void FlightRecorder::end() {
  if (file_) close();
}

}  // namespace lockstep
