/// Where trace rows go: a file, a network. Sinks live on the recorder's thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "hmi_bridge/traces/event.hpp"
#include "scheduler/trace_ring.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What a column of a trace is.
struct TraceSignal {
  std::string name;         ///< as in the project, such as `Knife.StatusWord.X22`
  Type type = Type::LREAL;  ///< of the value: BOOL for a bit of a word
  std::string unit;         ///< text such as "u/s"; empty for none
  bool operator==(const TraceSignal&) const = default;
};

/// A receiver of rows. Every function is called on the recorder's thread, in the order
/// begin, then row and flush, then end. A failure never leaves a sink: it counts the rows that did not get
/// through and keeps the first reason; the recorder shows both.
class TraceSink {
 public:
  TraceSink() = default;
  TraceSink(const TraceSink&) = delete;
  TraceSink& operator=(const TraceSink&) = delete;
  virtual ~TraceSink() = default;

  /// What the rows will hold; once, before the first row.
  virtual void begin(std::span<const TraceSignal> signals) = 0;
  virtual void row(const TraceRow& row) = 0;
  /// Something has happened; before the row of its tick.
  virtual void event(const TraceEvent& /*event*/) {}
  /// Hands over what is held back; called several times a second, whether there are rows or not.
  virtual void flush() = 0;
  /// Flushes and closes; once, after the last row.
  virtual void end() = 0;

  /// What the sink is, for messages: a file name, a URL.
  virtual std::string_view name() const noexcept = 0;

  /// Rows that were given to the sink and did not get through.
  virtual std::uint64_t lost() const noexcept { return lost_; }
  /// Why the first of them was lost; empty while nothing has failed. May be set without a lost row,
  /// when only a header or the closing of a file failed.
  virtual const std::string& reason() const noexcept { return reason_; }

  /// Counts rows as lost. The first reason is kept: later ones are its consequences.
  void lose(std::uint64_t rows, std::string_view reason) noexcept;

 private:
  std::uint64_t lost_ = 0;
  std::string reason_;
};

}  // namespace lockstep
