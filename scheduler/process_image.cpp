#include "scheduler/process_image.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lockstep {
namespace {

constexpr std::uint64_t kAllBits = ~0ULL;

/// The distinct variables in which the signals lie, in the order of their first mention, and for each signal
/// the number of its variable.
std::pair<std::vector<Signal>, std::vector<std::uint32_t>> variables_of(const std::vector<Signal>& signals) {
  std::pair<std::vector<Signal>, std::vector<std::uint32_t>> result;
  std::map<const void*, std::uint32_t> known;
  for (const Signal& signal : signals) {
    const auto [place, is_new] =
        known.try_emplace(signal.address, static_cast<std::uint32_t>(result.first.size()));
    if (is_new) result.first.push_back(Signal{signal.address, signal.type, -1});
    result.second.push_back(place->second);
  }
  return result;
}

Value merged(Value before, Value value, std::uint64_t mask) noexcept {
  if (mask != kAllBits) value.u = (before.u & ~mask) | (value.u & mask);
  return value;
}

/// What a variable holds after a write to it: part of an integer may change its sign, a REAL is rounded.
Value written(const Signal& variable, Value before, Value value, std::uint64_t mask) noexcept {
  if (mask == kAllBits && variable.type != Type::REAL) return value;
  std::uint64_t memory = 0;
  const Signal copy{&memory, variable.type, -1};
  copy.store(merged(before, value, mask));
  return copy.load();
}

}  // namespace

void ProcessImage::WriteSet::add(std::uint32_t variable, Value value, std::uint64_t mask) noexcept {
  Write& write = writes_[variable];
  if (write.mask == 0) touched_.push_back(variable);  // never beyond what is reserved: each one once
  write.value = merged(write.value, value, mask);
  write.mask |= mask;
}

void ProcessImage::WriteSet::clear() noexcept {
  for (const std::uint32_t variable : touched_) writes_[variable] = {};
  touched_.clear();
  last = 0;
}

void ProcessImage::WriteSet::apply(const std::vector<Signal>& variables) const noexcept {
  for (const std::uint32_t variable : touched_) {
    const Write& write = writes_[variable];
    const Signal& signal = variables[variable];
    signal.store(write.mask == kAllBits ? write.value : merged(signal.load(), write.value, write.mask));
  }
}

void ProcessImage::WriteSet::apply(const std::vector<Signal>& variables,
                                   std::vector<Value>& values) const noexcept {
  for (const std::uint32_t variable : touched_) {
    const Write& write = writes_[variable];
    values[variable] = written(variables[variable], values[variable], write.value, write.mask);
  }
}

ProcessImage::ProcessImage(std::vector<Signal> signals)
    : signals_(std::move(signals)),
      variables_(variables_of(signals_).first),
      places_(variables_of(signals_).second),
      snapshot_(first_snapshot(variables_)),
      sets_{WriteSet(variables_.size()), WriteSet(variables_.size()), WriteSet(variables_.size())},
      shadow_(snapshot_.front().values),
      waiting_(variables_.size()) {}

ProcessImage::Snapshot ProcessImage::first_snapshot(const std::vector<Signal>& variables) {
  Snapshot snapshot;
  for (const Signal& variable : variables) snapshot.values.push_back(variable.load());
  return snapshot;
}

void ProcessImage::take_writes() noexcept {
  bring_snapshot_near();
  if ((box_.load(std::memory_order_relaxed) & kFull) == 0) return;
  // The bridge may have taken the set back since: then this is an empty one, and the set comes a tick later.
  cycle_set_ = box_.exchange(cycle_set_, std::memory_order_acq_rel) & kSet;
  WriteSet& set = sets_[cycle_set_];
  if (set.last == 0) return;
  set.apply(variables_);
  applied_ = set.last;
  set.clear();
}

/// The bridge has read the memory that the next snapshot goes to. A first write here, to each cache line,
/// fetches it back while the tick computes; at its end nothing has to wait for it.
void ProcessImage::bring_snapshot_near() noexcept {
  constexpr std::size_t kPerLine = kCacheLine / sizeof(Value);
  constexpr std::size_t kMost = 32 * kPerLine;  // what a processor holds on its way
  std::vector<Value>& values = snapshot_.back().values;
  for (std::size_t i = 0; i < std::min(values.size(), kMost); i += kPerLine) values[i] = Value{};
}

void ProcessImage::publish(std::int64_t tick) noexcept {
  Snapshot& snapshot = snapshot_.back();
  snapshot.tick = tick;
  snapshot.applied = applied_;
  for (std::size_t i = 0; i < variables_.size(); ++i) snapshot.values[i] = variables_[i].load();
  snapshot_.publish();
}

bool ProcessImage::refresh() noexcept {
  if (!snapshot_.refresh()) return false;
  const Snapshot& snapshot = snapshot_.front();
  std::copy(snapshot.values.begin(), snapshot.values.end(), shadow_.begin());
  // What this tick did not know yet goes on top.
  if (waiting_.last > snapshot.applied) waiting_.apply(variables_, shadow_);
  return true;
}

/// Adds a write to those on their way, and to what the bridge sees.
void ProcessImage::add(WriteSet& set, const SignalWrite& write) noexcept {
  const Signal& signal = signals_[write.signal];
  const std::uint32_t variable = places_[write.signal];
  Value value = write.value;
  std::uint64_t mask = write.mask;
  if (signal.bit >= 0) {
    value.u = (value.u & 1u) << signal.bit;
    mask = std::uint64_t{1} << signal.bit;
  }
  if (mask == 0) return;
  set.add(variable, value, mask);
  waiting_.add(variable, value, mask);
  shadow_[variable] = written(variables_[variable], shadow_[variable], value, mask);
}

void ProcessImage::post(std::span<const SignalWrite> batch) noexcept {
  const std::uint8_t found = box_.exchange(bridge_set_, std::memory_order_acq_rel);
  bridge_set_ = found & kSet;
  if ((found & kFull) == 0) {
    // The cycle has taken what waited, in a tick that followed the snapshot which this finds at the least. So
    // every later one shows it, and until then the shadow does.
    refresh();
    waiting_.clear();
  }
  WriteSet& set = sets_[bridge_set_];
  ++posted_;
  for (const SignalWrite& write : batch) add(set, write);
  set.last = posted_;
  waiting_.last = posted_;
  bridge_set_ = box_.exchange(bridge_set_ | kFull, std::memory_order_acq_rel) & kSet;
}

}  // namespace lockstep
