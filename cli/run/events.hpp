/// lockstep run: alarms as messages.
#pragma once

#include <atomic>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep::cli {

/// Tells alarms and their acknowledgement on standard error, in their order. Thread: the recorder's.
class AlarmMessages final : public TraceSink {
 public:
  /// @param patience how long a message waits for a reader [ms]
  explicit AlarmMessages(int patience) : patience_(patience) {}

  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& /*row*/) override {}
  void event(const TraceEvent& event) override;
  void flush() override {}
  void end() override {}
  std::string_view name() const noexcept override { return "messages"; }

 private:
  int patience_;
};

}  // namespace lockstep::cli
