/// The flight recorder's part for leading values: with an alarm, the telegrams of the moments around it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/telegram_memory.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Writes FILE_telegrams_20261123T115200Z_1.lcm and its like: what was sent and came from `before` an alarm
/// to `after` it; alarms meanwhile prolong it. As many files as the flight recorder has, the oldest of which
/// are removed. Thread: the recorder's.
class TelegramRecorder final : public TraceSink {
 public:
  using Clock = std::chrono::system_clock;

  /// @param options of the flight recorder  @param memory outlives this
  TelegramRecorder(FlightRecorderOptions options, const TelegramMemory& memory);

  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& /*row*/) override {}
  void event(const TraceEvent& event) override;
  void flush() override;
  void end() override;
  std::string_view name() const noexcept override { return options_.file; }

  /// Files that have been written. After `end`.
  const std::vector<std::string>& written() const noexcept { return written_; }

 private:
  void write();
  void remove_oldest() const;

  const FlightRecorderOptions options_;
  const TelegramMemory& memory_;
  std::optional<Clock::time_point> from_, until_;
  int files_ = 0;
  std::vector<std::string> written_;
};

}  // namespace lockstep
