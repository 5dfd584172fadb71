#include "cli/monitor/events.hpp"

#include <utility>

#include "hmi_bridge/traces/event.hpp"

namespace lockstep::cli {
namespace {

/// As a run tells them on standard error.
std::vector<std::string> lines_of(const event_detail_t& detail) {
  TraceEvent event;
  event.cause = detail.cause;
  event.remedy = detail.remedy;
  event.address = detail.address;
  event.unit = detail.unit;
  if (detail.n > 0) {
    event.value_name = detail.names[0];
    event.value = detail.values[0];
  }
  if (detail.n > 1) {
    event.limit_name = detail.names[1];
    event.limit = detail.values[1];
  }
  if (detail.kind == "alarm") return detail_lines(event);
  std::vector<std::string> lines;
  if (!detail.object.empty()) lines.push_back("of " + detail.object);
  if (!detail.cause.empty()) lines.push_back(detail.cause);
  return lines;
}

}  // namespace

void HeardEvents::put(std::deque<ToldEvent>& list, ToldEvent told, std::size_t maximum) {
  list.push_front(std::move(told));
  if (list.size() > maximum) list.pop_back();
}

void HeardEvents::accept(const std::string& channel, const event_t& event) {
  if (const auto known = times_.find(channel); known != times_.end() && event.t < known->second)
    std::erase_if(running_, [&](const auto& job) { return job.first.first == channel; });  // another run
  times_[channel] = event.t;
  const ToldEvent told{channel, event, {}};
  const std::pair key(channel, event.source);
  if (event.kind == "alarm" || event.kind == "acknowledged") return put(alarms_, told, kMaximumAlarms);
  if (event.kind.starts_with("command")) return put(answers_, told, kMaximumAnswers);
  if (event.kind == "overrun") {
    ++overruns_;
    return;
  }
  if (event.kind == "job started") {
    if (running_.size() < kMaximumJobs || running_.contains(key)) running_[key] = event;
    return;
  }
  if (!event.kind.starts_with("job ")) return;
  running_.erase(key);
  put(ended_, told, kMaximumJobs);
}

void HeardEvents::accept(const std::string& channel, const event_detail_t& detail) {
  const auto attach = [&](std::deque<ToldEvent>& list) {
    for (ToldEvent& told : list) {
      const event_t& event = told.event;
      if (told.channel != channel || event.t != detail.t || event.source != detail.source ||
          event.kind != detail.kind || event.number != detail.number)
        continue;
      told.details = lines_of(detail);
      return;
    }
  };
  attach(detail.kind == "alarm" ? alarms_ : ended_);
}

std::size_t HeardEvents::pending() const {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (auto told = alarms_.rbegin(); told != alarms_.rend(); ++told) {
    std::size_t& count = counts[{told->channel, told->event.source}];
    count = told->event.kind == "alarm" ? count + 1 : 0;
  }
  std::size_t sum = 0;
  for (const auto& [source, count] : counts) sum += count;
  return sum;
}

}  // namespace lockstep::cli
