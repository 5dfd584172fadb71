/// Parts of a trace: some of its signals, fewer of its rows, or only those around an occasion.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// What makes a channel show rows.
enum class TriggerKind : std::uint8_t {
  none,     ///< every row
  above,    ///< those in which a signal is greater than the level
  below,    ///< those in which a signal is less than the level
  rising,   ///< those around the row in which a signal comes from not above the level to above it
  falling,  ///< those around the row in which a signal comes from not below the level to below it
  alarm     ///< those around an alarm
};

/// Which rows of a trace count.
struct TraceSelection {
  std::int64_t every = 1;  ///< of the rows that the trigger lets through only each n-th, counted in the run
  TriggerKind trigger = TriggerKind::none;
  double level = 0.5;
  std::int64_t before = 0;  ///< rows of that time before the occasion count as well [ns]
  std::int64_t after = 0;   ///< rows of that time after the occasion count as well [ns]
};

/// Hands some columns and rows of a trace on to another sink. With a trigger, rows before the occasion wait
/// in memory that is bounded by `before`. They are handed on a few at a time while rows come in: subscribers
/// of a network have space for some tens of messages, and lose the rest of a burst.
class TraceChannel final : public TraceSink {
 public:
  /// Rows handed on at most when one comes in.
  static constexpr std::size_t kAtOnce = 4;

  /// @param columns of the whole trace, in the order in which the sink gets them
  /// @param occasion column of the signal of the trigger; none: an alarm, or no trigger
  TraceChannel(std::unique_ptr<TraceSink> sink, std::vector<std::size_t> columns,
               TraceSelection selection = {}, std::optional<std::size_t> occasion = {});

  void begin(std::span<const TraceSignal> signals) override;
  void row(const TraceRow& row) override;
  void event(const TraceEvent& event) override;
  void flush() override { sink_->flush(); }
  void end() override;
  std::string_view name() const noexcept override { return sink_->name(); }
  std::uint64_t lost() const noexcept override { return TraceSink::lost() + sink_->lost(); }
  const std::string& reason() const noexcept override {
    return sink_->reason().empty() ? TraceSink::reason() : sink_->reason();
  }

 private:
  struct Kept {
    TraceRow row;
    std::vector<Value> values;
  };

  bool occasion(const TraceRow& row) noexcept;
  void give(const TraceRow& row);
  void add(const TraceRow& row);
  void keep(const TraceRow& row);
  void claim_kept(std::int64_t from);
  void give_due(std::size_t maximum);

  const std::unique_ptr<TraceSink> sink_;
  const std::vector<std::size_t> columns_;
  const TraceSelection selection_;
  const std::optional<std::size_t> occasion_;
  std::vector<Value> values_;
  Type occasion_type_ = Type::LREAL;
  bool was_beyond_ = true;  // so that what begins beyond the level is no edge
  std::optional<std::int64_t> open_until_;
  std::optional<std::int64_t> alarm_at_;
  std::int64_t rows_ = -1;  // number of the last row
  std::deque<Kept> kept_;
  std::size_t due_ = 0;  // so many of the first are to be handed on
};

}  // namespace lockstep
