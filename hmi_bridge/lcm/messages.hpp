/// Rows as LCM messages and back; LCM.md describes the layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/channel_length.hpp"
#include "hmi_bridge/traces/sink.hpp"
#include "lockstep/event_detail_t.hpp"
#include "lockstep/event_t.hpp"
#include "lockstep/trace_header_t.hpp"
#include "lockstep/trace_row_t.hpp"

namespace lockstep {

/// What is appended to the channel of the rows to name the channel of their header.
inline constexpr std::string_view kHeaderSuffix = "_HEADER";
static_assert(kLongestTraceChannel + kHeaderSuffix.size() == kLongestLcmChannel);

/// What is appended to name the channel of the events.
inline constexpr std::string_view kEventsSuffix = "_EVENTS";
/// What is appended to name the channel of what is known of events besides.
inline constexpr std::string_view kDetailSuffix = "_DETAIL";
/// Whether there is anything to be said of an event besides.
bool has_detail(const TraceEvent& event) noexcept;

/// What a trace is, apart from its signals.
struct LcmTraceIdentity {
  std::string project;
  std::string channel;      ///< 1 to `kLongestTraceChannel` characters
  std::int64_t period = 0;  ///< [ns] between rows
  /// Wall-clock time of t = 0 [µs since the epoch]; 0 in virtual time, so that the same project gives the
  /// same messages bit for bit.
  std::int64_t epoch = 0;

  /// Time stamp of a row [µs].
  std::int64_t utime(std::int64_t t) const noexcept { return epoch + t / 1000; }
};

/// @throws std::invalid_argument if the channel is empty or too long
void check_channel(const std::string& channel);

/// Encodes the header and the rows of one trace.
class LcmEncoder {
 public:
  LcmEncoder(LcmTraceIdentity identity, std::span<const TraceSignal> signals);

  /// The encoded message; valid until the next call.
  std::span<const std::uint8_t> header();
  /// Rows are numbered in the order of the calls.
  std::span<const std::uint8_t> row(const TraceRow& row);
  std::span<const std::uint8_t> event(const TraceEvent& event);
  std::span<const std::uint8_t> detail(const TraceEvent& event);

  std::size_t header_size() const { return static_cast<std::size_t>(header_.getEncodedSize()); }
  std::size_t row_size() const { return static_cast<std::size_t>(row_.getEncodedSize()); }

 private:
  template <class Message>
  std::span<const std::uint8_t> encode(const Message& message);

  LcmTraceIdentity identity_;
  std::vector<Type> types_;
  trace_header_t header_;
  trace_row_t row_;
  std::int64_t rows_ = 0;  // encoded so far
  std::vector<std::uint8_t> bytes_;
};

/// Decodes the messages of one channel, from a network or a log. Any bytes may come: nothing that a sender
/// puts into a message can do more than be refused.
class LcmDecoder {
 public:
  enum class Message : std::uint8_t {
    kHeader,   ///< `header` and `signals` are new, or the same again
    kRow,      ///< `row` is new
    kEarly,    ///< a row whose header has not come yet
    kForeign,  ///< no message of a trace
    kDamaged   ///< the message of a trace, but its content contradicts itself
  };

  /// @param bytes one message as it came over its channel
  Message accept(std::span<const std::uint8_t> bytes);

  /// How many signals a message tells of, before anything is made of it; 0 if it is no header, or too short
  /// for them.
  static std::size_t signals_announced(std::span<const std::uint8_t> bytes) noexcept;

  const trace_header_t& header() const noexcept { return header_; }
  const std::vector<TraceSignal>& signals() const noexcept { return signals_; }
  /// The last row, exact in all types; valid until the next `accept`.
  TraceRow row() const noexcept;
  const trace_row_t& message() const noexcept { return row_; }

 private:
  Message accept_header(std::span<const std::uint8_t> bytes);
  Message accept_row(std::span<const std::uint8_t> bytes);

  trace_header_t header_{};
  trace_row_t row_{};
  std::vector<TraceSignal> signals_;
  std::vector<Value> values_;
  bool has_header_ = false;
};

}  // namespace lockstep
