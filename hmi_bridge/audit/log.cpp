#include "hmi_bridge/audit/log.hpp"

#include <iterator>
#include <utility>

#include "hmi_bridge/network/visible_text.hpp"
#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::seconds kPause{1};  // between two looks at what is due, and two attempts to write

std::string event_line(const char* event, const std::string& project) {
  return R"({"time":")" + audit_time(std::chrono::system_clock::now()) + R"(","event":")" + event +
         R"(","project":)" + json_text(project) + "}\n";
}

}  // namespace

AuditLog::AuditLog(AuditOptions options, const std::string& project, std::size_t capacity)
    : path_(options.file), file_(std::move(options)), queue_(capacity) {
  queue_.add_line(event_line("begin", project));
  thread_ = std::thread([this] { run(); });
}

AuditLog::~AuditLog() {
  stop();
}

void AuditLog::add(AuditEntry entry) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    queue_.add(std::move(entry), AuditQueue::Clock::now());
  } catch (...) {  // no memory
    const std::lock_guard lock(mutex_);
    queue_.lose(1);
  }
  woken_.notify_one();
}

std::string AuditLog::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

std::uint64_t AuditLog::lost() const {
  const std::lock_guard lock(mutex_);
  return queue_.lost();
}

void AuditLog::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void AuditLog::run() noexcept {
  block_write_signals();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    try {
      write(lock);
    } catch (...) {  // no memory; what waits goes on waiting
    }
    if (!lock.owns_lock()) lock.lock();
    const auto something = [this] { return stopping_ || (!failing_ && !queue_.empty()); };
    if (!stopping_) woken_.wait_for(lock, kPause, something);
  }
  try {
    write(lock);
    const bool writes = unwritten_.empty();
    queue_.take_all(unwritten_);
    if (writes) write(lock);
  } catch (...) {
  }
  if (!lock.owns_lock()) lock.lock();
  for (const AuditLine& line : unwritten_) queue_.lose(line.entries);
  unwritten_.clear();
}

/// Writes without holding anybody up. @param lock held; held again at the end
void AuditLog::write(std::unique_lock<std::mutex>& lock) {
  if (unwritten_.empty()) queue_.take(AuditQueue::Clock::now(), unwritten_);
  if (unwritten_.empty()) return;
  lock.unlock();
  const std::size_t written = file_.append(unwritten_);
  unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(written));
  const std::string problem = file_.problem();
  lock.lock();
  const bool failing = !unwritten_.empty();
  if (!problem.empty() && (failing != failing_ || !failing))
    news_ = "audit log " + path_ + ": " + problem +
            (failing ? "; it is tried again every second, and what it cannot hold is counted" : "");
  else if (failing_ && !failing)
    news_ = "audit log " + path_ + ": is written again";
  failing_ = failing;
}

}  // namespace lockstep
