#include "projects/studio/feed.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

constexpr std::int64_t kRingTime = 2'000'000'000;  // [ns]
constexpr std::size_t kRingValues = (std::size_t{64} << 20) / sizeof(Value);

}  // namespace

TraceSignal StudioFeed::described(const NamedSignal& signal) const {
  return {signal.name, signal.signal.value_type(), units_.of(signal)};
}

void StudioFeed::want(std::vector<NamedSignal> signals) {
  const auto is_same = [](const NamedSignal& a, const NamedSignal& b) { return a.name == b.name; };
  if (std::equal(signals.begin(), signals.end(), wanted_.begin(), wanted_.end(), is_same)) return;
  wanted_ = std::move(signals);
  handed_over_ = false;
}

std::size_t StudioFeed::index(const NamedSignal& signal) {
  const std::optional<std::size_t> known = store_.find(signal.name);
  if (known) return *known;
  // A store learns of a signal by being told what rows have; the next row tells it again what it has.
  const TraceSignal added = described(signal);
  store_.set_signals(std::span(&added, 1));
  ring_ = 0;
  return store_.signals().size() - 1;
}

bool StudioFeed::is_in_newest(std::size_t index) const noexcept {
  return std::find(newest_.begin(), newest_.end(), index) != newest_.end();
}

void StudioFeed::take(const SignalTap::Row& row) {
  if (row.ring != ring_) {
    ring_ = row.ring;
    rings_.erase(rings_.begin(), rings_.lower_bound(ring_));
    const std::vector<TraceSignal>& signals = rings_[ring_];
    store_.set_signals(signals);
    newest_.clear();
    for (const TraceSignal& signal : signals) newest_.push_back(*store_.find(signal.name));
  }
  store_.append(row.row.t, row.row.tick, row.row.values, row.dropped - dropped_);
  dropped_ = row.dropped;
}

void StudioFeed::look() {
  tap_.drain([this](const SignalTap::Row& row) { take(row); });
  if (handed_over_) return;
  std::unique_ptr<TraceRing> ring;
  if (!wanted_.empty()) {
    const auto fitting = static_cast<std::int64_t>(kRingValues / (wanted_.size() + 3));
    const std::int64_t rows = std::clamp<std::int64_t>(kRingTime / cycle_, 64, fitting);
    ring = std::make_unique<TraceRing>(places_of(wanted_), static_cast<std::size_t>(rows));
  }
  const std::uint64_t number = tap_.hand_over(std::move(ring));
  if (number == 0) return;
  std::vector<TraceSignal>& signals = rings_[number];
  for (const NamedSignal& signal : wanted_) signals.push_back(described(signal));
  handed_over_ = true;
}

}  // namespace lockstep
