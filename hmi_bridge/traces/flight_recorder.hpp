/// What happened before an alarm: the last seconds of a trace, written to a file when one comes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/traces/recordings.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

struct FlightRecorderOptions {
  std::string file;         ///< beginning of the names of files, as `Recordings` has them
  std::int64_t before = 0;  ///< [ns]
  std::int64_t after = 0;   ///< [ns]
  int files = 10;           ///< at most so many in a run [1, 1000]
  int keep = 20;            ///< so many stay, those of earlier runs among them [1, 10000]
};

/// Keeps the rows of the last moments in memory of its own and writes them, with those of a moment after, to
/// a CSV trace for each alarm. Alarms that come meanwhile belong to the same file, and lengthen it. No file
/// of an earlier run is written over; the oldest beyond `keep` are removed when a new one has been begun. A
/// file that cannot be written or removed is told and hurts nothing else. Thread: the recorder's.
class FlightRecorder final : public TraceSink {
 public:
  /// Rows are kept in as much memory as `before` asks for.
  /// @param columns of the whole trace that are kept  @param period from row to row [ns] > 0
  FlightRecorder(FlightRecorderOptions options, std::vector<std::size_t> columns, std::int64_t period);

  void begin(std::span<const TraceSignal> signals) override;
  void row(const TraceRow& row) override;
  void event(const TraceEvent& event) override;
  void flush() override;
  void end() override;
  std::string_view name() const noexcept override { return options_.file; }

  /// Files that have been written whole. After `end`.
  const std::vector<std::string>& written() const noexcept { return written_; }
  /// Old files that could not be removed, with the reason. After `end`.
  const std::vector<std::string>& not_removed() const noexcept { return not_removed_; }

 private:
  void open();
  void close();
  void write(const TraceRow& row);
  void write_kept();

  const FlightRecorderOptions options_;
  const std::vector<std::size_t> columns_;
  const std::size_t capacity_;  // rows
  std::vector<TraceSignal> signals_;
  std::vector<Value> memory_;   // a ring of rows
  std::vector<TraceRow> rows_;  // of each row of the ring what stands before its values
  std::size_t count_ = 0, next_ = 0;
  std::vector<Value> values_;
  const Recordings recordings_;
  std::unique_ptr<TraceSink> file_;  // that is being written
  std::optional<std::int64_t> until_;
  int opened_ = 0;
  std::vector<std::string> written_;
  std::vector<std::string> not_removed_;
};

}  // namespace lockstep
