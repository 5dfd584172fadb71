#include "hmi_bridge/trace_channel.hpp"

#include <utility>

namespace lockstep {

TraceChannel::TraceChannel(std::unique_ptr<TraceSink> sink, std::vector<std::size_t> columns,
                           TraceSelection selection, std::optional<std::size_t> occasion)
    : sink_(std::move(sink)),
      columns_(std::move(columns)),
      selection_(selection),
      occasion_(occasion),
      values_(columns_.size()) {}

void TraceChannel::begin(std::span<const TraceSignal> signals) {
  std::vector<TraceSignal> chosen;
  for (const std::size_t column : columns_) chosen.push_back(signals[column]);
  if (occasion_) occasion_type_ = signals[*occasion_].type;
  sink_->begin(chosen);
}

void TraceChannel::row(const TraceRow& row) {
  ++rows_;
  const bool counts = rows_ % selection_.every == 0;
  if (selection_.trigger == TriggerKind::none) {
    if (counts) give(row);
    return;
  }
  if (occasion(row)) {
    const std::int64_t after = row.t + selection_.after;
    if (!open_until_ || *open_until_ < row.t) give_kept(row.t - selection_.before);
    open_until_ = after;
  }
  if (!counts) return;
  if (open_until_ && row.t <= *open_until_)
    give(row);
  else
    keep(row);
}

void TraceChannel::event(const TraceEvent& event) {
  if (selection_.trigger == TriggerKind::alarm && event.kind == EventKind::alarm) alarm_at_ = event.t;
  sink_->event(event);
}

bool TraceChannel::occasion(const TraceRow& row) noexcept {
  if (selection_.trigger == TriggerKind::alarm) return std::exchange(alarm_at_, std::nullopt).has_value();
  const double value = as_double(row.values[*occasion_], occasion_type_);
  switch (selection_.trigger) {
    case TriggerKind::above:
      return value > selection_.level;
    case TriggerKind::below:
      return value < selection_.level;
    case TriggerKind::rising:
    case TriggerKind::falling: {
      const bool rising = selection_.trigger == TriggerKind::rising;
      const bool beyond = rising ? value > selection_.level : value < selection_.level;
      return !std::exchange(was_beyond_, beyond) && beyond;
    }
    default:
      return false;
  }
}

void TraceChannel::give(const TraceRow& row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) values_[i] = row.values[columns_[i]];
  TraceRow part = row;
  part.values = values_;
  sink_->row(part);
}

/// Rows wait as long as an occasion may ask for them.
void TraceChannel::keep(const TraceRow& row) {
  if (selection_.before <= 0) return;
  Kept kept;
  while (!kept_.empty() && kept_.front().row.t < row.t - selection_.before) {
    kept = std::move(kept_.front());  // its memory serves again
    kept_.pop_front();
  }
  kept.row = row;
  kept.values.assign(row.values.begin(), row.values.end());
  kept_.push_back(std::move(kept));
}

void TraceChannel::give_kept(std::int64_t from) {
  for (Kept& kept : kept_) {
    kept.row.values = kept.values;
    if (kept.row.t >= from) give(kept.row);
  }
  kept_.clear();
}

}  // namespace lockstep
