#include "hmi_bridge/lcm/trace_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/event_messages.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "hmi_bridge/traces/regular_file.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kHeadSize = 28;  // mark, number, time and two lengths stand before channel and data
constexpr std::uint32_t kMark = 0xEDA1DA01;
constexpr std::size_t kTime = 12, kChannelLength = 20, kDataLength = 24;  // where they stand in the head
// What LCM reads of a channel, and sends as a message [byte].
constexpr std::uint32_t kLongestChannel = 999, kLongestMessage = 1u << 28;

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  std::uint32_t number = 0;
  for (const std::uint8_t byte : bytes.subspan(at, 4)) number = number << 8 | byte;
  return number;
}

std::int64_t time_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<std::int64_t>(std::uint64_t{number_at(bytes, at)} << 32 | number_at(bytes, at + 4));
}

constexpr std::size_t kMaximumTraces = 10'000;  // that are told apart; a log that holds more is no run's
constexpr std::size_t kMaximumListed = 24;      // in a message

/// The traces of a log by their channels, in the order of their headers. To find one takes as many steps as
/// their number has bits, whatever the channels are, since they are a stranger's.
class TracesInLog {
 public:
  /// @param comparisons counts them
  explicit TracesInLog(std::uint64_t& comparisons) : by_channel_(Before{&comparisons}) {}

  /// Notes a header on a channel.
  void add(std::string_view channel) {
    if (by_channel_.size() < kMaximumTraces && by_channel_.find(channel) == by_channel_.end())
      by_channel_.emplace(channel, by_channel_.size());
  }
  /// Notes a message that is no header.
  void note_rows(std::string_view channel) {
    if (const auto found = by_channel_.find(channel); found != by_channel_.end())
      first_with_rows_ = std::min(first_with_rows_, found->second);
  }
  bool empty() const noexcept { return by_channel_.empty(); }
  bool first_has_rows() const noexcept { return first_with_rows_ == 0; }
  /// The first one that has rows; the first one if none has. Not of an empty one.
  std::string chosen() const {
    return in_order()[first_with_rows_ < by_channel_.size() ? first_with_rows_ : 0];
  }
  std::string list() const {
    const std::vector<std::string> channels = in_order();
    std::string list;
    for (std::size_t i = 0; i < std::min(channels.size(), kMaximumListed); ++i)
      list += (list.empty() ? "" : ", ") + visible(channels[i]);
    return channels.size() > kMaximumListed ? list + ", …" : list;
  }

 private:
  struct Before {
    using is_transparent = void;  // NOLINT(readability-identifier-naming): named by the standard
    std::uint64_t* comparisons;
    bool operator()(std::string_view a, std::string_view b) const noexcept {
      ++*comparisons;
      return a < b;
    }
  };
  std::vector<std::string> in_order() const {
    std::vector<std::string> channels(by_channel_.size());
    for (const auto& [channel, number] : by_channel_) channels[number] = channel;
    return channels;
  }

  std::map<std::string, std::size_t, Before> by_channel_;  // with the number of its first header
  std::size_t first_with_rows_ = std::string::npos;        // number
};

}  // namespace

LcmTraceReader::LcmTraceReader(const std::string& path, const std::string& channel)
    : path_(path), channel_(channel) {
  open();
  find_header();
  open();  // from the front again: rows may stand before the header
}

void LcmTraceReader::open() {
  log_ = open_regular_file(path_);
  if (!log_.problem.empty()) throw TraceFormatError(path_ + ": " + log_.problem);
  size_ = log_.size();
  number_ = -1;
  offset_ = 0;
}

void LcmTraceReader::find_header() {
  TracesInLog traces(comparisons_);
  while (next_event()) {
    std::string_view channel = event_.channel;
    if (channel_.empty()) traces.note_rows(channel);
    if (channel_.empty() && traces.first_has_rows()) break;
    if (!channel.ends_with(kHeaderSuffix) || decoder_.accept(event_.data) != LcmDecoder::Message::kHeader)
      continue;
    channel.remove_suffix(kHeaderSuffix.size());
    if (channel == channel_) return;
    traces.add(channel);
  }
  if (offset_ == 0) throw TraceFormatError(path_ + ": is not an LCM event log");
  if (traces.empty()) throw TraceFormatError(path_ + ": holds no trace");
  if (!channel_.empty())
    throw TraceFormatError(path_ + ": holds no trace on channel " + visible(channel_) +
                           "; it holds: " + traces.list());
  channel_ = traces.chosen();
  open();
  find_header();
}

bool LcmTraceReader::next() {
  const std::int64_t id = header().id;
  while (next_event()) {
    const std::string_view channel = event_.channel;
    if (channel != channel_ && channel != channel_ + std::string(kHeaderSuffix)) {
      note_other();
      if (heard_) hear_event();
      continue;
    }
    switch (decoder_.accept(event_.data)) {
      case LcmDecoder::Message::kRow:
        return true;
      case LcmDecoder::Message::kHeader:
        if (header().id != id) fail("a trace of other signals begins on the same channel");
        break;
      case LcmDecoder::Message::kEarly:
        ++early_;
        break;
      default:
        fail("a damaged message on channel " + visible(channel));
    }
  }
  end_of_log();
  return false;
}

/// Reads the event that begins here; false if none does whose channel and data the file holds. LCM's own
/// reader believes what the lengths claim and takes memory for up to 2 GiB.
bool LcmTraceReader::next_event() {
  std::array<std::uint8_t, kHeadSize> head;
  if (std::fread(head.data(), 1, head.size(), log_.stream.get()) != head.size() ||
      number_at(head, 0) != kMark)
    return false;
  const std::uint32_t channel = number_at(head, kChannelLength), data = number_at(head, kDataLength);
  if (channel == 0 || channel > kLongestChannel || data > kLongestMessage) return false;
  const std::int64_t end = offset_ + kHeadSize + channel + data;
  if (end > size_) size_ = log_.size();  // it may be growing
  if (end > size_) return false;
  event_.time = time_at(head, kTime);
  event_.channel.resize(channel);
  event_.data.resize(data);
  if (std::fread(event_.channel.data(), 1, channel, log_.stream.get()) != channel ||
      std::fread(event_.data.data(), 1, data, log_.stream.get()) != data)
    return false;
  ++number_;
  offset_ = end;
  return true;
}

/// The event may be of another trace.
void LcmTraceReader::note_other() {
  std::string_view channel = event_.channel;
  if (const auto found = others_.find(channel); found != others_.end()) {
    found->second = true;
    return;
  }
  if (!channel.ends_with(kHeaderSuffix) || others_.size() >= kMaximumTraces) return;
  channel.remove_suffix(kHeaderSuffix.size());
  if (others_.find(channel) != others_.end()) return;
  LcmDecoder decoder;  // whose header is nobody's so far
  if (decoder.accept(event_.data) == LcmDecoder::Message::kHeader) others_.emplace(channel, false);
}

std::vector<std::string> LcmTraceReader::others() const {
  std::vector<std::string> channels;
  for (const auto& [channel, has_rows] : others_)
    if (has_rows) channels.push_back(channel);
  return channels;
}

/// The last event may be one of the trace's, or the detail of the one before.
void LcmTraceReader::hear_event() {
  const std::string_view channel = event_.channel;
  if (!channel.starts_with(channel_)) return;
  const std::string_view suffix = channel.substr(channel_.size());
  if (suffix == kDetailSuffix && waiting_) add_detail(*waiting_, event_.data);
  if (suffix != kEventsSuffix) return;
  tell_event();
  waiting_ = event_of(event_.data);
}

void LcmTraceReader::tell_event() {
  if (waiting_) heard_(*std::exchange(waiting_, std::nullopt));
}

void LcmTraceReader::end_of_log() {
  tell_event();
  if (!remark_.empty()) return;
  if (early_ > 0) remark_ = std::to_string(early_) + " rows of a trace with another header are left out";
  if (log_.size() == offset_) return;
  if (!remark_.empty()) remark_ += "; ";
  remark_ += "the log is cut short or damaged behind event " + std::to_string(number_);
}

void LcmTraceReader::fail(const std::string& what) const {
  throw TraceFormatError(path_ + ": event " + std::to_string(number_) + ": " + what);
}

TraceTable read_lcm_trace(const std::string& path, const std::string& channel) {
  LcmTraceReader reader(path, channel);
  TraceTable table;
  table.signals = reader.signals();
  table.columns.resize(table.signals.size());
  std::uint64_t dropped = 0;
  while (reader.next()) {
    const TraceRow row = reader.row();
    dropped = row.dropped;
    table.t.push_back(static_cast<double>(row.t) / 1e9);  // the nearest double: both sides are exact
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      table.columns[i].push_back(as_double(row.values[i], table.signals[i].type));
  }
  table.remark = reader.remark();
  if (dropped > 0)
    table.remark +=
        (table.remark.empty() ? "" : "; ") + std::to_string(dropped) + " rows were dropped by the run";
  return table;
}

}  // namespace lockstep
