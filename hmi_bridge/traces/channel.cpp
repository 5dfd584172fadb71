#include "hmi_bridge/traces/channel.hpp"

#include <algorithm>
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
    if (!open_until_ || *open_until_ < row.t) claim_kept(row.t - selection_.before);
    open_until_ = row.t + selection_.after;
  }
  const bool is_shown = open_until_ && row.t <= *open_until_;
  if (counts && is_shown) {
    add(row);
    due_ = kept_.size();
  } else if (counts) {
    keep(row);
  }
  give_due(kAtOnce);
}

void TraceChannel::end() {
  give_due(due_);
  sink_->end();
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

void TraceChannel::add(const TraceRow& row) {
  Kept& kept = kept_.emplace_back();
  kept.row = row;
  kept.values.assign(row.values.begin(), row.values.end());
}

/// Rows wait as long as an occasion may ask for them.
void TraceChannel::keep(const TraceRow& row) {
  if (selection_.before <= 0) return;
  while (due_ == 0 && !kept_.empty() && kept_.front().row.t < row.t - selection_.before) kept_.pop_front();
  add(row);
}

/// What waits from a time on is to be handed on, behind what is already.
void TraceChannel::claim_kept(std::int64_t from) {
  const auto waiting = kept_.begin() + static_cast<std::ptrdiff_t>(due_);
  kept_.erase(waiting,
              std::find_if(waiting, kept_.end(), [&](const Kept& kept) { return kept.row.t >= from; }));
  due_ = kept_.size();
}

void TraceChannel::give_due(std::size_t maximum) {
  for (; due_ > 0 && maximum > 0; --due_, --maximum) {
    Kept& kept = kept_.front();
    kept.row.values = kept.values;
    give(kept.row);
    kept_.pop_front();
  }
}

}  // namespace lockstep
