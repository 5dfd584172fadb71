#include "cli/monitor/traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/describe/table.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kWindow = 2s;     // over which the rate is taken
constexpr auto kSample = 100ms;  // between two counts of it
constexpr double kSilent = 3.0;  // [s] without a row: the trace waits for its trigger; without a word: silent
constexpr std::size_t kValueWidth = 14;  // columns of a value

double seconds(HeardTrace::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::string heading(const std::string& channel, const HeardTrace& trace, HeardTrace::Clock::time_point now) {
  const std::string line = printable(channel) + ": " + printable(trace.project());
  if (!trace.has_row()) return line + "  no rows yet";
  if (trace.age(now) <= kSilent) return line;
  return line + (trace.unheard(now) > kSilent ? "  SILENT" : "  WAITING");
}

std::string counts_text(const HeardTrace& trace, HeardTrace::Clock::time_point now) {
  const TraceRow row = trace.row();
  std::string line = fmt::format("  t {:.3f} s  {:.0f} rows/s  age {:.1f} s  dropped {}  lost {}",
                                 static_cast<double>(row.t) * 1e-9, trace.rate(now), trace.age(now),
                                 row.dropped, trace.lost());
  return trace.damaged() != 0 ? line + fmt::format("  damaged {}", trace.damaged()) : line;
}

}  // namespace

std::string signal_value_text(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (type == Type::TIME) return fmt::format("{:.3f}", as_double(value, type));
  if (is_bit_string(type)) return fmt::format("16#{:X}", value.u);
  if (!is_real(type))
    return is_signed_integer(type) ? fmt::format("{}", value.i) : fmt::format("{}", value.u);
  const double size = std::abs(value.r);
  const bool plain = size == 0.0 || (size >= 0.01 && size < 1e9);
  return plain ? fmt::format("{:.4f}", value.r) : fmt::format("{:.4e}", value.r);
}

std::string cut_to(const std::string& text, std::size_t width) {
  std::string result;
  std::size_t shown = 0;
  for (const char c : text) {
    const bool begins = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (begins && ++shown > width) break;
    result += c;
  }
  return result;
}

std::string trace_heading(const std::string& channel, const HeardTrace& trace,
                          HeardTrace::Clock::time_point now) {
  const std::string line = heading(channel, trace, now);
  return trace.has_row() ? line + counts_text(trace, now) : line;
}

void HeardTrace::accept(std::span<const std::uint8_t> bytes, Clock::time_point now) {
  switch (decoder_.accept(bytes)) {
    case LcmDecoder::Message::kHeader:
      heard_ = now;
      header_message_.assign(bytes.begin(), bytes.end());
      take_header();
      break;
    case LcmDecoder::Message::kRow:
      take_row(now);
      break;
    case LcmDecoder::Message::kDamaged:
      ++damaged_;
      break;
    case LcmDecoder::Message::kEarly:
    case LcmDecoder::Message::kForeign:
      break;
  }
}

void HeardTrace::take_header() {
  const std::int64_t id = decoder_.header().id;
  if (described_ && id == id_ && values_.size() == signals().size()) return;
  described_ = true;
  id_ = id;
  values_.assign(signals().size(), Value{});
  rows_ = lost_ = 0;
  counts_.clear();
}

void HeardTrace::take_row(Clock::time_point now) {
  const TraceRow row = decoder_.row();
  const std::int64_t number = decoder_.message().number;
  const bool is_new_run = row.t < t_ || number <= number_;
  if (is_new_run || rows_ == 0)
    lost_ = 0;
  else if (number_ >= 0)  // what a sender of anything may put there stays a count
    lost_ += static_cast<std::uint64_t>(number - number_) - 1;
  number_ = number;
  t_ = row.t;
  dropped_ = row.dropped;
  values_.assign(row.values.begin(), row.values.end());
  last_ = heard_ = now;
  ++rows_;
  if (counts_.empty() || now - counts_.back().first >= kSample) counts_.emplace_back(now, rows_);
  while (counts_.size() > 2 && now - counts_.front().first > kWindow) counts_.pop_front();
}

double HeardTrace::rate(Clock::time_point now) const {
  if (rows_ == 0 || now - last_ > kWindow) return 0.0;
  const auto& [since, count] = counts_.front();
  const double passed = seconds(last_ - since);
  return passed > 0.0 ? static_cast<double>(rows_ - count) / passed : 0.0;
}

double HeardTrace::age(Clock::time_point now) const {
  return seconds(now - last_);
}

double HeardTrace::unheard(Clock::time_point now) const {
  return seconds(now - heard_);
}

void HeardTraces::accept(const std::string& channel, std::span<const std::uint8_t> bytes,
                         HeardTrace::Clock::time_point now) {
  const bool header = channel.ends_with(kHeaderSuffix);
  const std::string name = header ? channel.substr(0, channel.size() - kHeaderSuffix.size()) : channel;
  const auto known = traces_.find(name);
  if (const std::size_t signals = LcmDecoder::signals_announced(bytes); signals > 0) {
    const std::size_t own = known == traces_.end() ? 0 : known->second.memory();
    if (memory() - own + HeardTrace::memory_of(bytes.size(), signals) > kMaximumMemory) return;
  }
  if (known != traces_.end()) return known->second.accept(bytes, now);
  if (!header || traces_.size() >= kMaximum) return;
  HeardTrace trace;
  trace.accept(bytes, now);
  if (trace.described()) traces_.emplace(name, std::move(trace));
}

std::size_t HeardTraces::memory() const noexcept {
  std::size_t sum = 0;
  for (const auto& [channel, trace] : traces_) sum += trace.memory();
  return sum;
}

bool HeardTraces::any_row() const {
  return std::any_of(traces_.begin(), traces_.end(),
                     [](const auto& entry) { return entry.second.has_row(); });
}

std::vector<std::string> trace_lines(const HeardTraces& traces, HeardTrace::Clock::time_point now,
                                     std::size_t width) {
  std::vector<std::string> lines;
  for (const auto& [channel, trace] : traces.all()) {
    if (!lines.empty()) lines.emplace_back();
    lines.push_back(cut_to(heading(channel, trace, now), width));
    if (trace.has_row()) lines.push_back(cut_to(counts_text(trace, now), width));
    const auto& signals = trace.signals();
    std::size_t longest = 0;
    for (const TraceSignal& signal : signals)
      longest = std::max(longest, shown_width(printable(signal.name)));
    longest = std::min(longest, width > kValueWidth + 16 ? width - kValueWidth - 16 : 8);
    const TraceRow row = trace.row();
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const std::string value = trace.has_row() ? signal_value_text(row.values[i], signals[i].type) : "-";
      const std::string name = padded(cut_to(printable(signals[i].name), longest), longest);
      std::string line = fmt::format("  {}  {:>{}}", name, value, kValueWidth);
      if (!signals[i].unit.empty()) line += " " + printable(signals[i].unit);
      lines.push_back(cut_to(line, width));
    }
  }
  return lines;
}

}  // namespace lockstep::cli
