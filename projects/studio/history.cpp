#include "projects/studio/history.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {

void StudioHistory::end_job(const TraceEvent& event) {
  const auto open = std::find_if(jobs_.rbegin(), jobs_.rend(), [&](const StudioJob& job) {
    return job.end < 0 && job.instance == event.source;
  });
  if (open != jobs_.rend()) {
    open->end = event.t;
    open->ended = event_kind_text(event.kind);
    open->text = event.text;
  } else if (event.kind == EventKind::job_failed) {
    // It was rejected, so it has not begun.
    jobs_.push_back({event.source, event.type, event.object, event.t, event.t,
                     std::string(event_kind_text(event.kind)), event.text});
  }
}

void StudioHistory::add(TraceEvent event) {
  switch (event.kind) {
    case EventKind::alarm:
      pending_.push_back(event);
      break;
    case EventKind::acknowledged:
      std::erase_if(pending_, [&](const TraceEvent& one) { return one.source == event.source; });
      break;
    case EventKind::job_started:
      end_job(event);  // the same instance once more
      jobs_.push_back({event.source, event.type, event.object, event.t, -1, "", ""});
      break;
    case EventKind::job_done:
    case EventKind::job_aborted:
    case EventKind::job_failed:
    case EventKind::job_ended:
      end_job(event);
      break;
    default:
      break;
  }
  if (jobs_.size() > kJobs) {
    const auto over =
        std::find_if(jobs_.begin(), jobs_.end(), [](const StudioJob& job) { return job.end >= 0; });
    jobs_.erase(over != jobs_.end() ? over : jobs_.begin());
  }
  events_.push_back(std::move(event));
  if (events_.size() > kEvents) events_.pop_front();
}

void StudioInbox::put(const TraceEvent& event) {
  const std::lock_guard lock(mutex_);
  if (events_.size() < kWaiting)
    events_.push_back(event);
  else
    ++lost_;
}

std::vector<TraceEvent> StudioInbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

std::uint64_t StudioInbox::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

}  // namespace lockstep
