/// Reads traces from LCM event logs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/messages.hpp"
#include "hmi_bridge/traces/event.hpp"
#include "hmi_bridge/traces/regular_file.hpp"
#include "hmi_bridge/traces/table.hpp"

namespace lockstep {

/// Goes through the rows of one trace in a log, which `LcmLog` or `lcm-logger` wrote. Any one thread.
class LcmTraceReader {
 public:
  /// @param channel of the trace; empty: the first trace that has rows, by the order of the headers; the
  /// first one if none has
  /// @throws TraceFormatError "FILE: …" if the file cannot be read or holds no such trace
  explicit LcmTraceReader(const std::string& path, const std::string& channel = "");

  /// Goes to the next row; false at the end of the log. Rows before the first header are passed over and
  /// counted.
  /// @throws TraceFormatError "FILE: event n: …" for a damaged message or a header with other signals
  bool next();

  /// Valid from construction.
  const trace_header_t& header() const noexcept { return decoder_.header(); }
  const std::vector<TraceSignal>& signals() const noexcept { return decoder_.signals(); }
  /// The row that `next` found, until the next call.
  TraceRow row() const noexcept { return decoder_.row(); }
  /// Has events of the trace told while `next` goes on, each with what is known of it besides. What is no
  /// event is passed over, whatever it is.
  void hear_events(std::function<void(TraceEvent)> heard) { heard_ = std::move(heard); }
  /// What part of the log has been read, from 0 to 1; 0 of what has no size.
  double progress() const noexcept {
    return size_ > 0 ? static_cast<double>(offset_) / static_cast<double>(size_) : 0.0;
  }
  std::int64_t utime() const noexcept { return decoder_.message().utime; }  ///< [µs], of the row
  std::int64_t event_time() const noexcept { return event_.time; }          ///< [µs], of the row's event
  /// Names of channels that were compared to find the trace: what a log of many headers costs.
  std::uint64_t comparisons() const noexcept { return comparisons_; }
  /// Channels of the other traces that have rows, by name. Complete when `next` was false.
  std::vector<std::string> others() const;
  /// What is missing: rows before the first header, or an end that was cut short. Complete when `next` was
  /// false.
  const std::string& remark() const noexcept { return remark_; }

 private:
  struct Event {
    std::string channel;
    std::int64_t time = 0;  // [µs]
    std::vector<std::uint8_t> data;
  };

  bool next_event();
  void open();
  void find_header();
  void end_of_log();
  void note_other();
  void hear_event();
  void tell_event();
  [[noreturn]] void fail(const std::string& what) const;

  const std::string path_;
  std::string channel_;
  RegularFile log_;
  LcmDecoder decoder_;
  Event event_;               // read last
  std::int64_t number_ = -1;  // of it
  std::int64_t offset_ = 0;   // behind it
  std::int64_t size_ = 0;     // of the file, as far as it is known [byte]
  std::uint64_t early_ = 0;
  std::uint64_t comparisons_ = 0;
  std::map<std::string, bool, std::less<>> others_;  // channels of other traces; whether they have rows
  std::string remark_;
  std::function<void(TraceEvent)> heard_;  // nobody: events are passed over
  std::optional<TraceEvent> waiting_;      // whose detail may come
};

/// Reads a whole trace.
/// @throws as LcmTraceReader
TraceTable read_lcm_trace(const std::string& path, const std::string& channel = "");

}  // namespace lockstep
