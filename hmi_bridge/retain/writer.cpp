#include "hmi_bridge/retain/writer.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMaximumNews = 16;  // that nobody has asked for

std::size_t count_of(const std::vector<KeptValue>& values) {
  std::size_t count = 0;
  for (const KeptValue& value : values) count += value.signals().size() + (value.present ? 1 : 0);
  return count;
}

std::vector<Signal> signals_of(const std::vector<KeptValue>& values, EncoderSaving* saving) {
  std::vector<Signal> signals;
  for (const KeptValue& value : values) {
    const std::span<const Signal> own = value.signals();
    signals.insert(signals.end(), own.begin(), own.end());
  }
  for (const KeptValue& value : values)
    if (value.present) signals.push_back(*value.present);
  if (saving == nullptr) return signals;
  signals.push_back({&saving->asked, Type::UDINT, -1});
  signals.push_back({&saving->answered, Type::UDINT, -1});
  signals.push_back({&saving->error, Type::WORD, -1});
  signals.push_back({&saving->differs, Type::BOOL, -1});
  return signals;
}

/// The beginning of a text that may be that of a long array.
std::string beginning_of(const std::string& text) {
  constexpr std::size_t kMaximum = 200;
  return text.size() <= kMaximum ? text : text.substr(0, kMaximum) + "…";
}

/// The row of an array stays under another name. @return what there is to say of that
std::string put_aside(const KeptRow& row, std::vector<KeptRow>& aside) {
  if (!row.type.starts_with("ARRAY")) return "";
  aside.push_back({row.name + "@" + row.type, row.type, row.value, row.basis});
  return "; what was kept stays in the file as '" + aside.back().name + "'";
}

/// What there is to say of a row of another type; that of an array is put aside.
std::string other_type(const KeptRow& row, const std::string& type, std::vector<KeptRow>& aside) {
  return "was kept as " + row.type + " (" + beginning_of(row.value) + ") and is " + type +
         " now: it begins with its init value" + put_aside(row, aside);
}

}  // namespace

std::vector<std::string> restore(RetainFile& file, const std::vector<KeptValue>& values) {
  std::vector<std::string> remarks;
  std::vector<KeptRow> aside;
  const auto remark = [&](const KeptValue& value, const std::string& text) {
    remarks.push_back("retain file " + file.path() + ": " + value.name + " " + text);
  };
  for (const KeptValue& value : values) {
    const KeptRow* const row = file.find(value.name);
    if (row == nullptr) continue;
    if (row->type != value.type()) {
      remark(value, other_type(*row, value.type(), aside));
      continue;
    }
    if (row->basis != value.basis) {
      const bool array = row->type.starts_with("ARRAY");
      remark(value, "was kept (" + beginning_of(row->value) + ") with other settings of " +
                        (array ? "its object" : "its axis") + " and is not taken" +
                        (array ? "" : ": adjust the encoder again") + ". It was: " + row->basis +
                        "; it is: " + value.basis + put_aside(*row, aside));
      continue;
    }
    const std::span<const Signal> signals = value.signals();
    const auto kept = value.values(row->value);
    if (!kept)
      throw RetainFileError("retain file " + file.path() + ": it is damaged (" + value.name + " is '" +
                            beginning_of(row->value) + "', which is no " + row->type + ")");
    for (std::size_t i = 0; i < signals.size(); ++i) signals[i].store((*kept)[i]);
    Value present{};
    present.u = 1;
    if (value.present) value.present->store(present);
  }
  if (const std::string problem = aside.empty() ? "" : file.write(aside); !problem.empty())
    throw RetainFileError("retain file " + file.path() + ": arrays of another type cannot be put aside: " +
                          problem + "; nothing has been changed");
  return remarks;
}

RetainWriter::RetainWriter(RetainFile file, std::vector<KeptValue> values, std::chrono::nanoseconds interval,
                           EncoderSaving* saving, std::chrono::nanoseconds watch)
    : file_(std::move(file)),
      values_(std::move(values)),
      interval_(interval),
      watch_(watch),
      asked_at_(count_of(values_)),
      image_(signals_of(values_, saving)),
      seen_(asked_at_),
      texts_(values_.size()),
      is_old_(values_.size(), true) {
  if (saving != nullptr) saving->kept = true;
}

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
  if (news_.empty()) return "";
  std::string oldest = std::move(news_.front());
  news_.pop_front();
  return oldest;
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
  auto next_watch = std::chrono::steady_clock::now() + watch_;
  while (wait(poll)) {
    changed_ |= look();
    const auto now = std::chrono::steady_clock::now();
    const bool due = changed_ && now >= next_write;
    if (due || asked_ != answered_) {
      write();
      answer();
      next_write = std::chrono::steady_clock::now() + interval_;
    } else if (now >= next_watch) {
      watch();
    } else {
      continue;
    }
    next_watch = std::chrono::steady_clock::now() + watch_;
  }
  look();  // the last tick is over
  write();
}

/// False: it is to stop.
bool RetainWriter::wait(std::chrono::steady_clock::duration time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, time, [this] { return stop_; });
}

/// Takes the newest snapshot; whether it holds anything else than the one before. Texts are made when they
/// are to be written only: those of large arrays take their time.
bool RetainWriter::look() {
  image_.refresh();
  bool changed = false;
  std::size_t place = 0;
  const auto is_new = [&](std::size_t signal) {
    const Value value = image_.value(signal);
    return std::exchange(seen_[signal].u, value.u) != value.u;
  };
  for (std::size_t i = 0; i < values_.size(); ++i) {
    bool own = false;
    for (std::size_t k = 0; k < values_[i].signals().size(); ++k) own |= is_new(place++);
    if (own) is_old_[i] = true;
    changed |= own;
  }
  while (place < asked_at_) changed |= is_new(place++);
  if (asked_at_ < image_.size()) asked_ = image_.value(asked_at_).u;
  return changed;
}

/// The values that are there, as the last look saw them.
std::vector<KeptRow> RetainWriter::rows() {
  std::vector<KeptRow> present;
  std::size_t place = 0;
  std::size_t presence = asked_at_;
  for (const KeptValue& value : values_) presence -= value.present ? 1 : 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::span<const Signal> signals = values_[i].signals();
    if (is_old_[i]) texts_[i] = values_[i].text(std::span(seen_).subspan(place, signals.size()));
    is_old_[i] = false;
    place += signals.size();
    if (values_[i].present && seen_[presence++].u == 0) continue;
    present.push_back({values_[i].name, values_[i].type(), texts_[i], values_[i].basis});
  }
  return present;
}

void RetainWriter::write() {
  std::string problem;
  try {
    problem = file_.write(rows());
  } catch (const std::exception& error) {
    problem = error.what();
  }
  changed_ = !problem.empty();
  note(problem);
}

/// The file may go from under its name although there is nothing to be written.
void RetainWriter::watch() {
  const std::string problem = file_.hold();
  if (!problem.empty()) {
    changed_ = is_away_ = true;
    return note(problem);
  }
  if (std::exchange(is_away_, false)) return write();
  const std::lock_guard lock(mutex_);
  add_news(file_.remark());
}

void RetainWriter::note(const std::string& problem) {
  const std::string file = "retain file " + file_.path() + ": ";
  const std::lock_guard lock(mutex_);
  commits_ = file_.commits();
  add_news(file_.remark());
  if (!problem.empty() && !failing_)
    add_news(file + "values cannot be written: " + problem + "; it is tried again");
  if (problem.empty() && failing_) add_news(file + "values are written again");
  failing_ = !problem.empty();
}

/// Where nobody asks, the oldest ones stay.
void RetainWriter::add_news(std::string text) {
  if (!text.empty() && news_.size() < kMaximumNews) news_.push_back(std::move(text));
}

/// To the job that waits: the disk has what the last look saw, or why it has not.
void RetainWriter::answer() {
  if (asked_ == answered_) return;
  Value number{}, error{}, differs{};
  number.u = asked_;
  if (!changed_ && !file_.verify()) {
    changed_ = true;
    differs.u = 1;
    note("what was read back is not what was written");
  }
  if (changed_)
    error.u = static_cast<std::uint64_t>(file_.full() ? ErrorId::encoder_data_no_space
                                                      : ErrorId::encoder_data_not_written);
  const auto place = static_cast<std::uint32_t>(asked_at_);
  const SignalWrite writes[] = {{place + 1, number}, {place + 2, error}, {place + 3, differs}};
  image_.post(writes);
  answered_ = asked_;
}

}  // namespace lockstep
