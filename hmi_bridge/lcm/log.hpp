/// Traces as LCM event logs, which `lcm-logplayer` replays.
#pragma once

#include <lcm/eventlog.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hmi_bridge/lcm/messages.hpp"
#include "hmi_bridge/traces/file.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Writes a trace to an event log: the same messages as `LcmPublisher`, the header before the first row and
/// then once for every second of t, so that a player may begin anywhere. The time of an event is the row's
/// `utime`.
class LcmLog final : public TraceSink {
 public:
  static constexpr std::int64_t kHeaderPeriod = 1'000'000'000;  ///< [ns] of t

  /// Opens the file and cuts it to nothing. Any thread.
  /// @throws std::system_error if that fails; its text names the file;
  ///     std::invalid_argument for a channel that is empty or too long
  LcmLog(const std::string& path, LcmTraceIdentity identity);
  ~LcmLog() override;

  void begin(std::span<const TraceSignal> signals) override;
  void row(const TraceRow& row) override;
  void event(const TraceEvent& event) override;
  void flush() override;
  void end() override;
  std::string_view name() const noexcept override { return path_; }

  /// A further channel in the same file. It has to be begun and ended before this one ends, and events are on
  /// this one's channel alone.
  /// @throws std::invalid_argument for a channel that is empty or too long
  std::unique_ptr<TraceSink> add_channel(LcmTraceIdentity identity);

 private:
  class Channel;
  struct Destroy {
    void operator()(lcm_eventlog_t* log) const noexcept { lcm_eventlog_destroy(log); }
  };
  void write(std::string& channel, std::span<const std::uint8_t> bytes, std::int64_t t, std::uint64_t rows);
  void write_header(std::int64_t t);

  const std::string path_;
  const LcmTraceIdentity identity_;
  std::string channel_;
  std::string header_channel_;
  std::string events_channel_;
  std::string detail_channel_;
  const std::unique_ptr<lcm_eventlog_t, Destroy> log_;
  TraceFile file_;
  std::optional<LcmEncoder> encoder_;
  std::optional<std::int64_t> next_header_;  // [ns] of t; none before the first header
};

}  // namespace lockstep
