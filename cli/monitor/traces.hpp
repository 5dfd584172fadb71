/// The traces that are heard on a network.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/messages.hpp"

namespace lockstep::cli {

/// One trace: its description and what came last.
class HeardTrace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes a message that came on the trace's channel or on that of its header.
  void accept(std::span<const std::uint8_t> bytes, Clock::time_point now);

  bool described() const noexcept { return described_; }
  bool has_row() const noexcept { return rows_ != 0; }
  const std::string& project() const noexcept { return decoder_.header().project; }
  const std::vector<TraceSignal>& signals() const noexcept { return decoder_.signals(); }
  /// The last row; its values are as many as the signals.
  TraceRow row() const noexcept { return {t_, 0, dropped_, values_}; }

  /// What is kept of it [byte], about.
  std::size_t memory() const noexcept { return memory_of(header_message_.size(), signals().size()); }
  /// What is kept [byte] of a trace whose description is a message of so many bytes with so many signals.
  static std::size_t memory_of(std::size_t bytes, std::size_t signals) noexcept {
    constexpr std::size_t kSignal = 400;  // three texts in the header, two in the signal, and values
    return 2 * bytes + kSignal * signals;
  }

  std::uint64_t rows() const noexcept { return rows_; }  ///< that have come since the description
  /// The message of the description, as it came.
  const std::vector<std::uint8_t>& header_message() const noexcept { return header_message_; }

  double rate(Clock::time_point now) const;              ///< rows in a second, over the last two seconds
  double age(Clock::time_point now) const;               ///< of the last row [s]
  double unheard(Clock::time_point now) const;           ///< time since the last word of the sender [s]
  std::uint64_t lost() const noexcept { return lost_; }  ///< rows sent that did not come
  std::uint64_t damaged() const noexcept { return damaged_; }  ///< messages that contradict themselves

 private:
  void take_header();
  void take_row(Clock::time_point now);

  LcmDecoder decoder_;
  std::int64_t id_ = 0;  // of the header
  std::vector<std::uint8_t> header_message_;
  std::vector<Value> values_;  // of the last row; the decoder's own are gone with the next header
  bool described_ = false;
  std::uint64_t rows_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t damaged_ = 0;
  std::int64_t t_ = 0;       // [ns] of the run
  std::int64_t number_ = 0;  // of the last row in its channel
  std::uint64_t dropped_ = 0;
  Clock::time_point last_;   // row
  Clock::time_point heard_;  // row or header, which comes once a second
  std::deque<std::pair<Clock::time_point, std::uint64_t>> counts_;  // rows at times, for the rate
};

/// All traces of a network, by channel. Anything may come from there: channels without a trace leave nothing
/// behind, and there is an end to the number of traces and to the memory of all that they describe.
class HeardTraces {
 public:
  static constexpr std::size_t kMaximum = 100;
  static constexpr std::size_t kMaximumMemory = 64u << 20;  ///< of descriptions and last rows [byte], about

  /// Takes any message of the network.
  void accept(const std::string& channel, std::span<const std::uint8_t> bytes,
              HeardTrace::Clock::time_point now);

  bool any_row() const;
  std::size_t memory() const noexcept;  ///< [byte], about
  const std::map<std::string, HeardTrace>& all() const noexcept { return traces_; }

 private:
  std::map<std::string, HeardTrace> traces_;
};

/// The traces as lines of a table, none longer than `width` columns.
std::vector<std::string> trace_lines(const HeardTraces& traces, HeardTrace::Clock::time_point now,
                                     std::size_t width);

/// A value as its type reads: TRUE, 16#2A, 12.5000.
std::string signal_value_text(Value value, Type type);

/// What a trace is and how it comes: channel, project, time, rows in a second, age, rows missing. One line.
std::string trace_heading(const std::string& channel, const HeardTrace& trace,
                          HeardTrace::Clock::time_point now);

/// The first columns of a UTF-8 text.
std::string cut_to(const std::string& text, std::size_t width);

}  // namespace lockstep::cli
