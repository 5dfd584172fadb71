#include "hmi_bridge/lcm/telegram_memory.hpp"

#include <fcntl.h>
#include <lcm/eventlog.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <system_error>

namespace lockstep {

void TelegramMemory::add(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() > KeptTelegram::kLongest || channel.size() > KeptTelegram::kLongestChannel) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || kept_.empty()) return;
  KeptTelegram& kept = kept_[next_];
  kept.utime = std::chrono::duration_cast<std::chrono::microseconds>(
                   std::chrono::system_clock::now().time_since_epoch())
                   .count();
  kept.size = static_cast<std::uint16_t>(bytes.size());
  kept.channel_size = static_cast<std::uint8_t>(channel.size());
  std::copy(channel.begin(), channel.end(), kept.channel_bytes.begin());
  std::copy(bytes.begin(), bytes.end(), kept.bytes.begin());
  next_ = (next_ + 1) % kept_.size();
  count_ = std::min(count_ + 1, kept_.size());
}

std::vector<KeptTelegram> TelegramMemory::since(std::int64_t utime) const {
  std::vector<KeptTelegram> found;
  found.reserve(kept_.size());
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < count_; ++i) {
    const KeptTelegram& kept = kept_[(next_ + kept_.size() - count_ + i) % kept_.size()];
    if (kept.utime >= utime) found.push_back(kept);
  }
  return found;
}

void write_telegrams(const std::string& path, const std::vector<KeptTelegram>& telegrams) {
  const auto refuse = [&path](int error) { throw std::system_error(error, std::generic_category(), path); };
  const int made = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) refuse(errno);
  ::close(made);
  struct Destroy {
    void operator()(lcm_eventlog_t* log) const noexcept { lcm_eventlog_destroy(log); }
  };
  const std::unique_ptr<lcm_eventlog_t, Destroy> log(lcm_eventlog_create(path.c_str(), "w"));
  if (log == nullptr) refuse(errno);
  for (const KeptTelegram& kept : telegrams) {
    lcm_eventlog_event_t event{};
    event.timestamp = kept.utime;
    event.channellen = kept.channel_size;
    event.channel = const_cast<char*>(kept.channel_bytes.data());  // LCM only reads them
    event.datalen = kept.size;
    event.data = const_cast<std::uint8_t*>(kept.bytes.data());
    errno = 0;
    if (lcm_eventlog_write_event(log.get(), &event) != 0) refuse(errno != 0 ? errno : EIO);
  }
  if (std::fflush(log->f) != 0) refuse(errno);
}

}  // namespace lockstep
