#include "scheduler/process_image.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lockstep {
namespace {

constexpr std::uint64_t kAllBits = ~0ULL;

/// The distinct variables in which the signals lie, by type and among these in the order of their first
/// mention, and for each signal the number of its variable.
std::pair<std::vector<Signal>, std::vector<std::uint32_t>> variables_of(const std::vector<Signal>& signals) {
  std::vector<Signal> variables;
  std::map<const void*, std::uint32_t> numbers;
  for (const Signal& signal : signals)
    if (numbers.try_emplace(signal.address).second)
      variables.push_back(Signal{signal.address, signal.type, -1});
  std::stable_sort(variables.begin(), variables.end(),
                   [](const Signal& a, const Signal& b) { return a.type < b.type; });
  for (std::size_t i = 0; i < variables.size(); ++i)
    numbers[variables[i].address] = static_cast<std::uint32_t>(i);
  std::vector<std::uint32_t> indices;
  for (const Signal& signal : signals) indices.push_back(numbers[signal.address]);
  return {variables, indices};
}

/// What a variable holds after a write to it: part of an integer may change its sign, a REAL is rounded.
Value written(const Signal& variable, Value before, const VariableWrite& write) noexcept {
  if (write.mask == kAllBits && variable.type != Type::REAL) return write.value;
  std::uint64_t memory = 0;
  const Signal copy{&memory, variable.type, -1};
  VariableWrite all{0, before, kAllBits};
  all.add(write.value, write.mask);
  copy.store(all.value);
  return copy.load();
}

}  // namespace

std::size_t ProcessImage::WriteSet::add(std::uint32_t variable, Value value, std::uint64_t mask) noexcept {
  std::uint32_t& index = indices_[variable];
  if (index == 0) {  // never beyond what is reserved: each variable once
    writes_.push_back({variable, Value{}, 0});
    index = static_cast<std::uint32_t>(writes_.size());
  }
  writes_[index - 1].add(value, mask);
  return index - 1;
}

void ProcessImage::WriteSet::clear() noexcept {
  for (const VariableWrite& write : writes_) indices_[write.variable] = 0;
  writes_.clear();
  last = 0;
}

ProcessImage::ProcessImage(std::vector<Signal> signals)
    : signals_(std::move(signals)),
      variables_(variables_of(signals_).first),
      indices_(variables_of(signals_).second),
      snapshot_([this] {
        Snapshot first{.lines = std::vector<Line>(variables_.size() / kPerLine + 1)};
        fill(first.lines);
        return first;
      }()),
      mailbox_(variables_),
      shown_(snapshot_.front().lines.data()->values.data()),
      waiting_(variables_.size()),
      taken_by_cycle_(variables_.size()) {}

void ProcessImage::take_writes() noexcept {
  // What this tick is going to need and the bridge has touched is fetched at once; what publishing needs
  // comes while the tick computes.
  mailbox_.prefetch();
  snapshot_.prefetch();
  if (const std::uint64_t number = mailbox_.apply(); number != 0) applied_ = number;
}

void ProcessImage::fill(std::vector<Line>& lines) const noexcept {
  const Signal* variable = variables_.data();
  const Signal* const end = variable + variables_.size();
  for (Line& line : lines)
    for (std::size_t k = 0; k < kPerLine && variable != end; ++k, ++variable)
      line.values[k] = variable->load();
}

void ProcessImage::publish(std::int64_t tick) noexcept {
  Snapshot& snapshot = snapshot_.back();
  snapshot.tick = tick;
  snapshot.applied = applied_;
  fill(snapshot.lines);
  snapshot_.publish();
}

bool ProcessImage::refresh() noexcept {
  if (!snapshot_.refresh()) return false;
  shown_ = snapshot_.front().lines.data()->values.data();
  is_behind_ = snapshot_.front().applied < posted_;
  return true;
}

/// Puts on top of a value what its tick did not know yet.
Value ProcessImage::with_own_writes(std::uint32_t variable, Value value) const noexcept {
  for (const WriteSet* set : {&taken_by_cycle_, &waiting_}) {
    const VariableWrite* const write = set->to(variable);
    if (write != nullptr && snapshot_.front().applied < set->last)
      value = written(variables_[variable], value, *write);
  }
  return value;
}

/// Merges a write with those on their way.
void ProcessImage::add(const SignalWrite& write) noexcept {
  const Signal& signal = signals_[write.signal];
  Value value = write.value;
  std::uint64_t mask = write.mask;
  if (signal.bit >= 0) {
    value.u = (value.u & 1u) << signal.bit;
    mask = std::uint64_t{1} << signal.bit;
  }
  if (mask == 0) return;
  const std::size_t index = waiting_.add(indices_[write.signal], value, mask);
  mailbox_.put(index, waiting_.at(index));
}

void ProcessImage::post(std::span<const SignalWrite> batch) noexcept {
  if (!mailbox_.take_back()) {
    // The cycle has taken what waited, in a tick that followed the snapshot which this finds at the earliest.
    // So every later one shows it, and until then it is put on top.
    refresh();
    std::swap(waiting_, taken_by_cycle_);
    waiting_.clear();
  }
  ++posted_;
  for (const SignalWrite& write : batch) add(write);
  waiting_.last = posted_;
  is_behind_ = true;
  mailbox_.hand_on(waiting_.size(), posted_);
}

}  // namespace lockstep
