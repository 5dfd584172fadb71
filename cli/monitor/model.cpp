#include "cli/monitor/model.hpp"

#include <algorithm>
#include <utility>

#include "hmi_bridge/lcm/commands.hpp"

namespace lockstep::cli {
namespace {

std::string lowered(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The channel without an ending; none if it ends otherwise.
std::optional<std::string> before(const std::string& channel, std::string_view ending) {
  if (!channel.ends_with(ending)) return std::nullopt;
  return channel.substr(0, channel.size() - ending.size());
}

}  // namespace

Model::Model(std::string network, std::optional<Panel> axis_panel)
    : url(std::move(network)), panel(std::move(axis_panel)) {}

bool Model::accept(const std::string& channel, std::span<const std::uint8_t> bytes, Clock::time_point now) {
  const auto known = [&](const std::string& name) { return heard_.traces.all().contains(name); };
  heard_.at = now;
  if (const auto name = before(channel, kEventsSuffix); name && known(*name)) {
    if (bytes.size() > kLongestNote) return false;
    const auto event = decode_event(bytes);
    if (event) heard_.events.accept(*name, *event);
    return event.has_value();
  }
  if (const auto name = before(channel, kDetailSuffix); name && known(*name)) {
    if (bytes.size() > kLongestNote) return false;
    const auto detail = decode_detail(bytes);
    if (detail) heard_.events.accept(*name, *detail);
    return detail.has_value();
  }
  if (const auto name = before(channel, kPanelSuffix); name && panel) {
    const auto state = bytes.size() <= kLongestNote ? decode_panel(bytes) : std::nullopt;
    if (state) panel->accept(*name, *state, now);
    return false;
  }
  if (heard_.leading.accept(channel, bytes, now)) return true;
  const std::string name = before(channel, kHeaderSuffix).value_or(channel);
  const auto rows_of = [&] { return known(name) ? heard_.traces.all().at(name).rows() : 0; };
  const std::uint64_t rows = rows_of();
  heard_.traces.accept(channel, bytes, now);
  if (!known(name)) return false;
  if (rows_of() == rows) return true;
  const HeardTrace& trace = heard_.traces.all().at(name);
  std::vector<History>& histories = heard_.histories[name];
  const std::size_t signals = trace.signals().size();
  if (histories.size() > signals || trace.rows() == 1) {
    histories_ -= histories.size();
    histories.clear();  // another trace
  }
  const std::size_t capacity = std::min(signals - histories.size(), kMaximumHistories - histories_);
  if (capacity > 0) histories.resize(histories.size() + capacity);
  histories_ += capacity;
  const TraceRow row = trace.row();
  for (std::size_t i = 0; i < histories.size(); ++i)
    histories[i].add(row.t, as_double(row.values[i], trace.signals()[i].type));
  return true;
}

void Model::pause(bool on, Clock::time_point now) {
  if (on == paused()) return;
  frozen_.reset();
  if (!on) return;
  frozen_ = heard_;
  frozen_->at = now;
}

bool Model::matches(const std::string& name) const {
  return search.empty() || lowered(name).find(lowered(search)) != std::string::npos;
}

std::vector<SignalRow> Model::rows() const {
  std::vector<SignalRow> rows;
  for (const auto& [channel, trace] : shown().traces.all()) {
    const std::size_t first = rows.size();
    const auto& signals = trace.signals();
    for (std::size_t i = 0; i < signals.size(); ++i)
      if (matches(signals[i].name)) rows.push_back({channel, i});
    const auto name = [&](const SignalRow& row) { return lowered(signals[row.index].name); };
    const auto moves = [&](const SignalRow& row) {
      const History* const lately = history(row);
      const auto span = lately != nullptr ? lately->whole(window()) : std::nullopt;
      return span && span->maximum > span->minimum;
    };
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
    if (order == Order::by_name)
      std::stable_sort(begin, rows.end(), [&](const auto& a, const auto& b) { return name(a) < name(b); });
    if (order == Order::by_movement) std::stable_partition(begin, rows.end(), moves);
  }
  return rows;
}

std::size_t Model::chosen(const std::vector<SignalRow>& rows) const {
  if (!chosen_) return 0;
  const auto found = std::find(rows.begin(), rows.end(), *chosen_);
  return found == rows.end() ? 0 : static_cast<std::size_t>(found - rows.begin());
}

void Model::move(std::ptrdiff_t steps) {
  const std::vector<SignalRow> all = rows();
  if (all.empty()) return;
  const auto last = static_cast<std::ptrdiff_t>(all.size()) - 1;
  const auto from = static_cast<std::ptrdiff_t>(chosen(all));
  const std::ptrdiff_t distance = std::clamp(steps, -last, last);
  chosen_ = all[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(from + distance, 0, last))];
}

const TraceSignal& Model::signal(const SignalRow& row) const {
  return shown().traces.all().at(row.channel).signals().at(row.index);
}

std::optional<Value> Model::value(const SignalRow& row) const {
  const HeardTrace& trace = shown().traces.all().at(row.channel);
  if (!trace.has_row()) return std::nullopt;
  return trace.row().values[row.index];
}

const History* Model::history(const SignalRow& row) const {
  const auto found = shown().histories.find(row.channel);
  if (found == shown().histories.end() || row.index >= found->second.size()) return nullptr;
  return &found->second[row.index];
}

}  // namespace lockstep::cli
