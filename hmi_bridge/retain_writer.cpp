#include "hmi_bridge/retain_writer.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "hmi_bridge/write_signals.hpp"

namespace lockstep {
namespace {

std::vector<Signal> signals_of(const std::vector<KeptValue>& values) {
  std::vector<Signal> signals;
  for (const KeptValue& value : values) signals.push_back(value.signal);
  for (const KeptValue& value : values)
    if (value.present) signals.push_back(*value.present);
  return signals;
}

}  // namespace

std::vector<std::string> restore(const RetainFile& file, const std::vector<KeptValue>& values) {
  std::vector<std::string> remarks;
  const auto remark = [&](const KeptValue& value, const std::string& text) {
    remarks.push_back("retain file " + file.path() + ": " + value.name + " " + text);
  };
  for (const KeptValue& value : values) {
    const KeptRow* const row = file.find(value.name);
    if (row == nullptr) continue;
    const Type type = value.signal.value_type();
    if (row->type != type_name(type)) {
      remark(value, "was kept as " + row->type + " (" + row->value + ") and is " +
                        std::string(type_name(type)) + " now: it begins with its init value");
      continue;
    }
    if (row->basis != value.basis) {
      remark(value,
             "was kept (" + row->value +
                 ") with other settings of its axis and is not taken: adjust the encoder again. It was: " +
                 row->basis + "; it is: " + value.basis);
      continue;
    }
    const std::optional<Value> kept = kept_value(row->value, type);
    if (!kept)
      throw RetainFileError("retain file " + file.path() + ": it is damaged (" + value.name + " is '" +
                            row->value + "', which is no " + row->type + ")");
    value.signal.store(*kept);
    Value present{};
    present.u = 1;
    if (value.present) value.present->store(present);
  }
  return remarks;
}

RetainWriter::RetainWriter(RetainFile file, std::vector<KeptValue> values, std::chrono::nanoseconds interval)
    : file_(std::move(file)), values_(std::move(values)), interval_(interval), image_(signals_of(values_)) {}

RetainWriter::~RetainWriter() {
  stop();
}

void RetainWriter::start() {
  thread_ = std::thread([this] { run(); });
}

void RetainWriter::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

std::string RetainWriter::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, "");
}

bool RetainWriter::failing() const {
  const std::lock_guard lock(mutex_);
  return failing_;
}

std::uint64_t RetainWriter::commits() const {
  const std::lock_guard lock(mutex_);
  return commits_;
}

void RetainWriter::run() {
  block_write_signals();
  const auto poll = std::min<std::chrono::nanoseconds>(kPoll, interval_);
  changed_ = true;  // values that the file does not know yet
  look();
  write();
  auto next_write = std::chrono::steady_clock::now() + interval_;
  while (wait(poll)) {
    changed_ |= look();
    if (!changed_ || std::chrono::steady_clock::now() < next_write) continue;
    write();
    next_write = std::chrono::steady_clock::now() + interval_;
  }
  look();  // the last tick is over
  write();
}

/// False: it is to stop.
bool RetainWriter::wait(std::chrono::steady_clock::duration time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, time, [this] { return stop_; });
}

/// Takes the newest snapshot; whether it holds anything else than the one before.
bool RetainWriter::look() {
  image_.refresh();
  std::vector<KeptRow> rows;
  std::size_t place = values_.size();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const KeptValue& value = values_[i];
    if (value.present && image_.value(place++).u == 0) continue;
    const Type type = image_.type(i);
    rows.push_back({value.name, std::string(type_name(type)), kept_text(image_.value(i), type), value.basis});
  }
  if (rows == rows_) return false;
  rows_ = std::move(rows);
  return true;
}

void RetainWriter::write() {
  std::string problem;
  try {
    problem = file_.write(rows_);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  changed_ = !problem.empty();
  const std::lock_guard lock(mutex_);
  commits_ = file_.commits();
  if (!problem.empty() && !failing_)
    news_ = "retain file " + file_.path() + ": values cannot be written: " + problem + "; it is tried again";
  if (problem.empty() && failing_) news_ = "retain file " + file_.path() + ": values are written again";
  failing_ = !problem.empty();
}

}  // namespace lockstep
