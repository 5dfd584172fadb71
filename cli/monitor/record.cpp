#include "cli/monitor/record.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lockstep::cli {
namespace {

constexpr std::size_t kEventHead = 28;  // mark, number, time and two lengths stand before channel and data

/// A new file: a record is never written over another one.
lcm_eventlog_t* open(const std::string& path) {
  const int made = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) throw std::system_error(errno, std::generic_category(), path);
  ::close(made);
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  if (log == nullptr) throw std::system_error(errno, std::generic_category(), path);
  return log;
}

}  // namespace

MonitorRecord::MonitorRecord(const std::string& path)
    : path_(path), log_(open(path)), file_(*this, log_->f) {}

MonitorRecord::~MonitorRecord() {
  file_.close();  // before its buffer goes
}

void MonitorRecord::message(const std::string& channel, std::span<const std::uint8_t> bytes,
                            std::int64_t utime) {
  ++messages_;
  if (!file_.open_row(kEventHead + channel.size() + bytes.size(), 1)) return;
  lcm_eventlog_event_t event{};
  event.timestamp = utime;
  event.channellen = static_cast<std::int32_t>(channel.size());
  event.channel = const_cast<char*>(channel.data());  // LCM only reads them
  event.datalen = static_cast<std::int32_t>(bytes.size());
  event.data = const_cast<std::uint8_t*>(bytes.data());
  file_.close_row(lcm_eventlog_write_event(log_.get(), &event) == 0);
}

}  // namespace lockstep::cli
