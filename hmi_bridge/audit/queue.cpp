#include "hmi_bridge/audit/queue.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};  // at all that has been put together

}  // namespace

void AuditQueue::push(std::string text, std::uint64_t entries) {
  if (waiting_.size() >= capacity_) return lose(entries);
  waiting_.push_back({std::move(text), entries});
}

void AuditQueue::add_line(std::string text) {
  push(std::move(text), 1);
}

/// The line of what has been put together.
void AuditQueue::tell(Told& told, Clock::time_point now) {
  AuditEntry entry = std::move(*told.pending);
  told.pending.reset();
  entry.before = std::exchange(told.before, {});
  told.value = entry.after;
  told.at = now;
  told.differs = false;
  const std::uint64_t count = std::exchange(told.count, 0);
  push(audit_line(entry, count), count);
}

void AuditQueue::add(AuditEntry entry, Clock::time_point now) {
  std::string key = entry.via + (entry.accepted ? '+' : '-');
  for (const std::string* part : {&entry.source, &entry.subject, &entry.action})
    key.append(1, '\0').append(*part);
  const auto found = table_.find(key);
  if (found == table_.end()) {
    if (table_.size() >= capacity_ && now - looked_ >= kApart) forget_old(now);
    if (table_.size() < capacity_) table_.emplace(std::move(key), Told{now, entry.after, {}, {}});
    return push(audit_line(entry), 1);
  }
  Told& told = found->second;
  if (told.count == 0) told.before = entry.before;
  told.differs = told.differs || entry.after != told.value;
  told.pending = std::move(entry);
  ++told.count;
  due_ = std::min(due_, told.due());
}

void AuditQueue::tell_due(Clock::time_point now) {
  swept_ = now;
  due_ = Clock::time_point::max();
  for (auto& [key, told] : table_) {
    if (told.count == 0) continue;
    if (now >= told.due())
      tell(told, now);
    else
      due_ = std::min(due_, told.due());
  }
}

void AuditQueue::take(Clock::time_point now, std::vector<AuditLine>& lines) {
  if (now >= due_ && now - swept_ >= kBetweenLooks) tell_due(now);
  lines.insert(lines.end(), std::move_iterator(waiting_.begin()), std::move_iterator(waiting_.end()));
  waiting_.clear();
  if (lost_ == 0) return;
  lines.push_back({R"({"time":")" + audit_time(std::chrono::system_clock::now()) +
                       R"(","event":"lost","entries":)" + std::to_string(lost_) + "}\n",
                   0});
  lost_ = 0;
}

void AuditQueue::take_all(std::vector<AuditLine>& lines) {
  take(Clock::time_point::max(), lines);
}

void AuditQueue::forget_old(Clock::time_point now) {
  looked_ = now;
  std::erase_if(
      table_, [now](const auto& one) { return one.second.count == 0 && now - one.second.at >= kSameApart; });
}

}  // namespace lockstep
