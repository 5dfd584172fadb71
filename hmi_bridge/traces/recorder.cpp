#include "hmi_bridge/traces/recorder.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kBatch = 256;  // rows given back to the writer at a time

std::string loss_text(std::uint64_t rows, const std::string& where, const std::string& reason) {
  return "trace incomplete: " + std::to_string(rows) + (rows == 1 ? " row" : " rows") + " lost in " + where +
         ": " + reason;
}

}  // namespace

void TraceSink::lose(std::uint64_t rows, std::string_view reason) noexcept {
  lost_ += rows;
  if (!reason_.empty()) return;
  try {
    reason_ = reason;
  } catch (...) {
    reason_ = "no memory";  // short enough to need none
  }
}

TraceRecorder::TraceRecorder(TraceRing& ring, std::vector<TraceSignal> signals,
                             std::vector<std::unique_ptr<TraceSink>> sinks, EventSource events)
    : ring_(ring),
      signals_(std::move(signals)),
      sinks_(std::move(sinks)),
      events_(std::move(events)),
      thread_([this] { record(); }) {}

TraceRecorder::~TraceRecorder() {
  stop();
}

void TraceRecorder::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void TraceRecorder::tell(TraceEvent event) {
  const std::lock_guard lock(mutex_);
  if (told_.size() < kMaximumTold)
    told_.push_back(std::move(event));
  else
    ++lost_told_;
}

std::uint64_t TraceRecorder::lost_events() const noexcept {
  return (events_.queue != nullptr ? events_.queue->lost() : 0) + lost_told_;
}

std::vector<std::string> TraceRecorder::losses() const {
  std::vector<std::string> texts;
  if (const std::uint64_t dropped = ring_.dropped(); dropped > 0)
    texts.push_back(loss_text(dropped, "the trace buffer", "the recorder could not keep up with the run"));
  if (const std::uint64_t lost = lost_events(); lost > 0)
    texts.push_back("list of events incomplete: " + std::to_string(lost) +
                    " lost: the recorder could not keep up with the run");
  const std::lock_guard lock(mutex_);
  for (const Loss& loss : losses_) texts.push_back(loss_text(loss.rows, loss.name, loss.reason));
  return texts;
}

bool TraceRecorder::has_lost(std::string_view name) const {
  if (ring_.dropped() > 0) return true;
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(losses_, [name](const Loss& loss) { return loss.name == name; });
}

std::string TraceRecorder::held_up() const {
  const TraceSink* const sink = busy_.load(std::memory_order_acquire);
  if (sink == nullptr) return "";
  return loss_text(ring_.readable(), std::string(sink->name()),
                   "it takes nothing, nor what it has been given before");
}

void TraceRecorder::record() {
  block_write_signals();
  begin_sinks();
  auto next_flush = std::chrono::steady_clock::now() + kFlush;
  for (bool stopping = false; !stopping;) {
    if (!drain()) {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, kPoll, [this] { return stop_; });
      stopping = stop_;
    }
    if (const auto now = std::chrono::steady_clock::now(); now >= next_flush) {
      flush_sinks();
      next_flush = now + kFlush;
    }
    report();
  }
  finishing_ = true;
  while (drain()) continue;  // the last rows came before stop_, so they are visible now
  end_sinks();
  report();
  ring_.close();
  if (events_.queue != nullptr) events_.queue->close();
}

template <class Call>
void TraceRecorder::guarded(TraceSink& sink, std::uint64_t rows, Call call) noexcept {
  busy_.store(&sink, std::memory_order_release);
  try {
    call(sink);
  } catch (const std::exception& error) {
    sink.lose(rows, error.what());
  } catch (...) {
    sink.lose(rows, "unknown error");
  }
  busy_.store(nullptr, std::memory_order_relaxed);
}

void TraceRecorder::begin_sinks() noexcept {
  for (const auto& sink : sinks_) guarded(*sink, 0, [this](TraceSink& s) { s.begin(signals_); });
}

bool TraceRecorder::drain() noexcept {
  const std::size_t rows = std::min(ring_.readable(), kBatch);
  // Looked at after the rows, so that the events of their ticks are there.
  take_told();
  const std::size_t events = events_.queue != nullptr ? events_.queue->readable() : 0;
  std::size_t given = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const TraceRow row = ring_.row(i);
    while (given < events && events_.queue->event(given).t <= row.t)
      give_queued(events_.queue->event(given++));
    give_told(row.t);
    for (const auto& sink : sinks_) guarded(*sink, 1, [&row](TraceSink& s) { s.row(row); });
    given_t_ = row.t;
    given_tick_ = row.tick;
  }
  ring_.pop(rows);
  if (rows < kBatch && (finishing_ || !events_.rows_follow)) {
    while (given < events) give_queued(events_.queue->event(given++));
    give_told(std::numeric_limits<std::int64_t>::max());
  }
  if (given > 0) events_.queue->pop(given);
  return rows > 0 || given > 0;
}

void TraceRecorder::take_told() noexcept try {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMaximumTold) return;
  waiting_.insert(waiting_.end(), told_.begin(), told_.end());
  told_.clear();
} catch (...) {
  // Without memory they stay where they are; the next round tries again.
}

/// Behind what was told of the ticks before.
void TraceRecorder::give_queued(const Event& event) noexcept {
  give_told(event.t - 1);
  give_event(event);
  given_t_ = event.t;
  given_tick_ = event.tick;
}

void TraceRecorder::give_event(const Event& event) noexcept {
  std::optional<TraceEvent> told;  // one for all sinks: a printed line can be taken only once
  const auto give = [&](TraceSink& sink) {
    if (!told) told = events_.texts.of(event, lost_events());
    sink.event(*told);
  };
  for (const auto& sink : sinks_) guarded(*sink, 0, give);
}

void TraceRecorder::give_event(const TraceEvent& event) noexcept {
  for (const auto& sink : sinks_) guarded(*sink, 0, [&](TraceSink& s) { s.event(event); });
}

/// Those that have waited for the row of their tick. One that was told late has the time of the row before
/// it, so that time never goes back in a log.
void TraceRecorder::give_told(std::int64_t until) noexcept {
  if (waiting_.empty()) return;
  std::size_t given = 0;
  for (; given < waiting_.size() && waiting_[given].t <= until; ++given) {
    TraceEvent& event = waiting_[given];
    if (event.t < given_t_) {
      event.t = given_t_;
      event.tick = given_tick_;
    }
    event.lost = lost_events();
    give_event(event);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(given));
}

void TraceRecorder::flush_sinks() noexcept {
  for (const auto& sink : sinks_) guarded(*sink, 0, [](TraceSink& s) { s.flush(); });
}

void TraceRecorder::end_sinks() noexcept {
  for (const auto& sink : sinks_) guarded(*sink, 0, [](TraceSink& s) { s.end(); });
}

void TraceRecorder::report() noexcept try {
  std::vector<Loss> losses;
  for (const auto& sink : sinks_)
    if (!sink->reason().empty()) losses.push_back({std::string(sink->name()), sink->lost(), sink->reason()});
  if (losses.empty()) return;  // losses never go away
  const std::lock_guard lock(mutex_);
  losses_ = std::move(losses);
} catch (...) {
  // Without memory for the report the counts stay with the sinks; the next round tries again.
}

}  // namespace lockstep
