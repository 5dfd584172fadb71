#include "projects/studio/feed.hpp"

#include <algorithm>
#include <utility>

#include "projects/studio/api_values.hpp"

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
  Ring& ring = rings_[row.ring];
  const bool follows = row.ring == ring_ && row.dropped == dropped_;
  if (row.ring != ring_) {
    ring_ = row.ring;
    rings_.erase(rings_.begin(), rings_.lower_bound(ring_));
    store_.set_signals(ring.signals);
    newest_.clear();
    for (const TraceSignal& signal : ring.signals) newest_.push_back(*store_.find(signal.name));
  }
  values_.assign(row.row.values.begin(), row.row.values.end());
  std::vector<Value> operands;
  for (const Computed& one : ring.computed) {
    operands.clear();
    for (const std::size_t column : one.operands) operands.push_back(row.row.values[column]);
    values_.push_back(one.derived->value(operands, row.row.t, follows));
  }
  store_.append(row.row.t, row.row.tick, values_, row.dropped - dropped_);
  dropped_ = row.dropped;
}

/// Has the ring hold what a signal is computed of.
void StudioFeed::add_computed(const NamedSignal& signal, std::vector<NamedSignal>& plain, Ring& ring) {
  std::shared_ptr<StudioDerived>& derived = derived_[signal.name];
  std::string problem;
  if (!derived) derived = studio_api::derived_at(project_, signal.name, problem);
  if (!derived) return;
  Computed computed{derived, {}};
  for (const std::string& path : derived->operands()) {
    std::optional<NamedSignal> operand = studio_api::signal_at(project_, path, problem);
    if (!operand) return;
    const auto known = std::ranges::find(plain, operand->name, &NamedSignal::name);
    computed.operands.push_back(static_cast<std::size_t>(known - plain.begin()));
    if (known == plain.end()) plain.push_back(std::move(*operand));
  }
  ring.computed.push_back(std::move(computed));
}

void StudioFeed::look() {
  tap_.drain([this](const SignalTap::Row& row) { take(row); });
  if (handed_over_) return;
  std::vector<NamedSignal> plain;
  std::vector<const NamedSignal*> computed;
  for (const NamedSignal& signal : wanted_) {
    if (StudioDerived::is_one(signal.name))
      computed.push_back(&signal);
    else
      plain.push_back(signal);
  }
  Ring made;
  for (const NamedSignal* signal : computed) add_computed(*signal, plain, made);
  std::unique_ptr<TraceRing> ring;
  if (!plain.empty()) {
    const auto fitting = static_cast<std::int64_t>(kRingValues / (plain.size() + 3));
    const std::int64_t cycle = project_.controller->clock.interpolator_cycle();
    const std::int64_t rows =
        std::clamp<std::int64_t>(kRingTime / cycle, 64, std::max<std::int64_t>(fitting, 64));
    ring = std::make_unique<TraceRing>(places_of(plain), static_cast<std::size_t>(rows));
  }
  const std::uint64_t number = tap_.hand_over(std::move(ring));
  if (number == 0) return;
  for (const NamedSignal& signal : plain) made.signals.push_back(described(signal));
  for (const NamedSignal* signal : computed)
    if (derived_[signal->name]) made.signals.push_back(described(*signal));
  std::erase_if(derived_, [&](const auto& one) {
    return std::ranges::none_of(wanted_, [&](const NamedSignal& signal) { return signal.name == one.first; });
  });
  rings_[number] = std::move(made);
  handed_over_ = true;
}

}  // namespace lockstep
