#include "cli/monitor/events.hpp"

#include <utility>

namespace lockstep::cli {

void HeardEvents::put(std::deque<ToldEvent>& list, ToldEvent told, std::size_t maximum) {
  list.push_front(std::move(told));
  if (list.size() > maximum) list.pop_back();
}

void HeardEvents::accept(const std::string& channel, const event_t& event) {
  if (const auto known = times_.find(channel); known != times_.end() && event.t < known->second)
    std::erase_if(running_, [&](const auto& job) { return job.first.first == channel; });  // another run
  times_[channel] = event.t;
  const ToldEvent told{channel, event};
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
