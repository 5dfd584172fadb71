/// Records of the monitor: what is heard, as an LCM log.
#pragma once

#include <lcm/eventlog.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hmi_bridge/traces/file.hpp"

namespace lockstep::cli {

/// Writes messages as they come to an event log, which `lockstep plot` and `lcm-logplayer` read. A disk that
/// is full ends the writing: the file is cut back to its last whole message, and `reason` tells why. Any one
/// thread.
class MonitorRecord final : public TraceSink {
 public:
  /// @throws std::system_error if the file cannot be made, or is there already; its text names it
  explicit MonitorRecord(const std::string& path);
  ~MonitorRecord() override;

  /// @param utime [µs since the epoch]
  void message(const std::string& channel, std::span<const std::uint8_t> bytes, std::int64_t utime);
  std::uint64_t messages() const noexcept { return messages_; }  ///< given, lost ones among them

  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& /*row*/) override {}
  void flush() override { file_.flush(); }
  void end() override { file_.close(); }
  std::string_view name() const noexcept override { return path_; }

 private:
  struct Destroy {
    void operator()(lcm_eventlog_t* log) const noexcept { lcm_eventlog_destroy(log); }
  };
  const std::string path_;
  const std::unique_ptr<lcm_eventlog_t, Destroy> log_;
  TraceFile file_;
  std::uint64_t messages_ = 0;
};

}  // namespace lockstep::cli
