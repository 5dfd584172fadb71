#include "projects/studio/trace_files.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/network/write_signals.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"

namespace lockstep {
namespace {

constexpr int kLowestPriority = 19;
constexpr double kLongestTime = 9e9;          // [s] that nanoseconds of 64 bits hold
constexpr double kToldEach = 0.05;            // of the progress
constexpr std::uint64_t kRowsPerLook = 4096;  // of a log, between two looks whether it is wanted

/// The reading is given up.
struct NotWanted {};

void check_times(const TraceTable& table, const std::string& name) {
  double before = -kLongestTime;
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    const double t = table.t[row];
    if (!(t >= before && t <= kLongestTime))
      throw TraceFormatError(name + ": row " + std::to_string(row + 1) +
                             ": the times of rows have to rise, from -9e9 s to 9e9 s");
    before = t;
  }
}

/// What is wrong with a file: what stands in the message of a temporary one is where it lay.
std::string said_of(const std::exception& error, const std::string& path, const std::string& name) {
  std::string text = error.what();
  if (const std::size_t at = text.find(path); at != std::string::npos) text.replace(at, path.size(), name);
  return text;
}

}  // namespace

StudioTraceFiles::~StudioTraceFiles() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    cancel_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  for (const Job& job : jobs_)
    if (job.is_temporary) ::unlink(job.path.c_str());
}

const StudioTraceFile* StudioTraceFiles::add(std::string path, std::string name, bool is_temporary) {
  return queue(std::move(path), std::move(name), is_temporary, OpenFile());
}

const StudioTraceFile* StudioTraceFiles::add(OpenFile file, std::string name) {
  std::string path = file.path();
  return queue(std::move(path), std::move(name), false, std::move(file));
}

const StudioTraceFile* StudioTraceFiles::queue(std::string path, std::string name, bool is_temporary,
                                               OpenFile opened) {
  if (files_.size() >= kFiles) return nullptr;
  StudioTraceFile& file = enter(std::move(name));
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back({file.id, std::move(path), file.name, is_temporary, std::move(opened)});
  }
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  wake_.notify_one();
  return &file;
}

StudioTraceFile& StudioTraceFiles::enter(std::string name) {
  StudioTraceFile& file = files_.emplace_back();
  file.id = "file-" + std::to_string(++number_);
  file.name = std::move(name);
  return file;
}

bool StudioTraceFiles::remove(std::string_view id) {
  const auto found = std::ranges::find(files_, id, &StudioTraceFile::id);
  if (found == files_.end()) return false;
  files_.erase(found);
  const std::lock_guard lock(mutex_);
  if (current_ == id) cancel_ = true;
  std::erase_if(jobs_, [&](const Job& job) {
    if (job.id == id && job.is_temporary) ::unlink(job.path.c_str());
    return job.id == id;
  });
  return true;
}

const StudioTraceFile* StudioTraceFiles::find(std::string_view id) const noexcept {
  const auto found = std::ranges::find(files_, id, &StudioTraceFile::id);
  return found == files_.end() ? nullptr : &*found;
}

StudioTraceFile* StudioTraceFiles::find(std::string_view id) noexcept {
  const auto found = std::ranges::find(files_, id, &StudioTraceFile::id);
  return found == files_.end() ? nullptr : &*found;
}

/// @return the file of which there is news; empty: of none
std::string StudioTraceFiles::take() {
  const std::lock_guard lock(mutex_);
  if (!finished_.empty()) {
    Read read = std::move(finished_.front());
    finished_.pop_front();
    told_ = -1.0;
    StudioTraceFile* file = find(read.id);
    if (file == nullptr) return "";
    if (!read.name.empty() && files_.size() >= kFiles) {
      file->remark += (file->remark.empty() ? "" : "; ") + read.name + " is left out: there are " +
                      std::to_string(kFiles) + " traces";
      return read.id;
    }
    if (!read.name.empty()) {
      file = &enter(std::move(read.name));
      file->of = read.id;
    }
    file->state = read.error.empty() ? StudioFileState::ready : StudioFileState::failed;
    file->progress = 1.0;
    file->error = std::move(read.error);
    file->remark = std::move(read.remark);
    file->store = std::move(read.store);
    file->history = std::move(read.history);
    return file->id;
  }
  StudioTraceFile* const file = find(current_);
  const double progress = progress_;
  if (file == nullptr || progress < told_ + kToldEach) return "";
  file->progress = told_ = progress;
  return current_;
}

void StudioTraceFiles::check_wanted(double progress) {
  progress_ = progress;
  if (cancel_) throw NotWanted{};
}

void StudioTraceFiles::read_log(LcmTraceReader& reader, const std::string& name, Read& read) {
  reader.hear_events([&read](TraceEvent event) { read.history.add(std::move(event)); });
  read.store.set_signals(reader.signals());
  std::int64_t before = std::numeric_limits<std::int64_t>::min();
  for (std::uint64_t rows = 0; reader.next(); ++rows) {
    const TraceRow row = reader.row();
    if (row.t < before) throw TraceFormatError(name + ": the times of rows have to rise");
    before = row.t;
    read.store.append(row.t, row.tick, row.values);
    if (rows % kRowsPerLook == 0) check_wanted(reader.progress());
  }
  read.remark = reader.remark();
}

/// @param others gets the channels of further traces
StudioTraceFiles::Read StudioTraceFiles::read(const Job& job, std::vector<std::string>& others) {
  Read read;
  read.id = job.id;
  if (job.name.ends_with(".lcm")) {
    LcmTraceReader reader(job.path);
    read_log(reader, job.name, read);
    others = reader.others();
    if (others.size() >= kFiles) {
      read.remark += (read.remark.empty() ? "" : "; ") + std::to_string(others.size() - kFiles + 1) +
                     " further traces are left out";
      others.resize(kFiles - 1);
    }
  } else {
    const TraceTable table = read_csv_trace(job.path, [this](double part) { check_wanted(part * 0.8); });
    check_times(table, job.name);
    read.store = TraceStore(table);
    read.remark = table.remark;
  }
  return read;
}

/// A further trace of a log, which may be damaged where the first one is not.
StudioTraceFiles::Read StudioTraceFiles::read_other(const Job& job, const std::string& channel) {
  Read read;
  read.id = job.id;
  read.name = job.name + ", " + channel;
  try {
    LcmTraceReader reader(job.path, channel);
    read_log(reader, read.name, read);
  } catch (const std::exception& error) {
    read.error = said_of(error, job.path, job.name);
  }
  return read;
}

void StudioTraceFiles::read_all(const Job& job, std::vector<Read>& results) {
  std::vector<std::string> others;
  results.push_back(read(job, others));
  for (const std::string& channel : others) results.push_back(read_other(job, channel));
}

void StudioTraceFiles::work() noexcept {
  block_write_signals();
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kLowestPriority);
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
    if (stop_) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    current_ = job.id;
    cancel_ = false;
    progress_ = 0.0;
    lock.unlock();
    std::vector<Read> results;
    try {
      read_all(job, results);
    } catch (const NotWanted&) {
      results.assign(1, Read{.id = job.id, .error = "given up"});
    } catch (const std::exception& error) {
      results.assign(1, Read{.id = job.id, .error = said_of(error, job.path, job.name)});
    }
    if (job.is_temporary) ::unlink(job.path.c_str());
    lock.lock();
    current_.clear();
    std::move(results.begin(), results.end(), std::back_inserter(finished_));
  }
}

}  // namespace lockstep
