#include "hmi_bridge/lcm/log.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kEventHead = 28;  // mark, number, time and two lengths stand before channel and data

lcm_eventlog_t* open(const std::string& path) {
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "w");
  if (log == nullptr) throw std::system_error(errno, std::generic_category(), path);
  return log;
}

}  // namespace

LcmLog::LcmLog(const std::string& path, LcmTraceIdentity identity)
    : path_(path),
      identity_(std::move(identity)),
      channel_(identity_.channel),
      header_channel_(channel_ + std::string(kHeaderSuffix)),
      events_channel_(channel_ + std::string(kEventsSuffix)),
      detail_channel_(channel_ + std::string(kDetailSuffix)),
      log_((check_channel(channel_), open(path))),
      file_(*this, log_->f) {}

LcmLog::~LcmLog() {
  file_.close();  // before its buffer goes
}

void LcmLog::begin(std::span<const TraceSignal> signals) {
  encoder_.emplace(identity_, signals);
}

void LcmLog::row(const TraceRow& row) {
  if (!next_header_ || row.t >= *next_header_) write_header(row.t);
  write(channel_, encoder_.value().row(row), row.t, 1);
}

void LcmLog::event(const TraceEvent& event) {
  write(events_channel_, encoder_.value().event(event), event.t, 0);
  if (has_detail(event)) write(detail_channel_, encoder_.value().detail(event), event.t, 0);
}

void LcmLog::flush() {
  file_.flush();
}

void LcmLog::end() {
  if (!next_header_) write_header(0);  // a trace without rows still tells what it would have held
  file_.close();
}

void LcmLog::write_header(std::int64_t t) {
  next_header_ = t + kHeaderPeriod;
  write(header_channel_, encoder_.value().header(), t, 0);
}

void LcmLog::write(std::string& channel, std::span<const std::uint8_t> bytes, std::int64_t t,
                   std::uint64_t rows) {
  if (!file_.open_row(kEventHead + channel.size() + bytes.size(), rows)) return;
  lcm_eventlog_event_t event{};
  event.timestamp = identity_.utime(t);
  event.channellen = static_cast<std::int32_t>(channel.size());
  event.channel = channel.data();
  event.datalen = static_cast<std::int32_t>(bytes.size());
  event.data = const_cast<std::uint8_t*>(bytes.data());  // LCM only reads it
  file_.close_row(lcm_eventlog_write_event(log_.get(), &event) == 0);
}

/// Writes through the log to which it belongs.
class LcmLog::Channel final : public TraceSink {
 public:
  Channel(LcmLog& log, LcmTraceIdentity identity)
      : log_(log),
        identity_(std::move(identity)),
        channel_(identity_.channel),
        header_channel_(channel_ + std::string(kHeaderSuffix)) {
    check_channel(channel_);
  }
  void begin(std::span<const TraceSignal> signals) override { encoder_.emplace(identity_, signals); }
  void row(const TraceRow& row) override {
    if (!next_header_ || row.t >= *next_header_) write_header(row.t);
    log_.write(channel_, encoder_.value().row(row), row.t, 1);
  }
  void flush() override {}
  void end() override {
    if (!next_header_) write_header(0);
  }
  std::string_view name() const noexcept override { return log_.name(); }

 private:
  void write_header(std::int64_t t) {
    if (!log_.next_header_) log_.write_header(t);  // the log's own trace is the first one in it
    next_header_ = t + kHeaderPeriod;
    log_.write(header_channel_, encoder_.value().header(), t, 0);
  }

  LcmLog& log_;
  const LcmTraceIdentity identity_;
  std::string channel_;
  std::string header_channel_;
  std::optional<LcmEncoder> encoder_;
  std::optional<std::int64_t> next_header_;  // [ns] of t
};

std::unique_ptr<TraceSink> LcmLog::add_channel(LcmTraceIdentity identity) {
  return std::make_unique<Channel>(*this, std::move(identity));
}

}  // namespace lockstep
