#include "scheduler/process_image.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lockstep {
namespace {

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

}  // namespace

ProcessImage::ProcessImage(std::vector<Signal> signals, std::size_t capacity)
    : signals_(std::move(signals)),
      variables_(variables_of(signals_).first),
      places_(variables_of(signals_).second),
      writes_(capacity),
      snapshot_(first_snapshot(variables_)),
      shadow_(variables_.size()),
      pending_(std::max<std::size_t>(capacity, 1)) {
  for (std::size_t i = 0; i < variables_.size(); ++i)
    Signal{&shadow_[i], variables_[i].type, -1}.store(snapshot_.front().values[i]);
}

ProcessImage::Snapshot ProcessImage::first_snapshot(const std::vector<Signal>& variables) {
  Snapshot snapshot;
  for (const Signal& variable : variables) snapshot.values.push_back(variable.load());
  return snapshot;
}

void ProcessImage::apply(const Signal& signal, const SignalWrite& write) noexcept {
  Value value = write.value;
  if (write.mask != ~0ULL) value.u = (signal.load().u & ~write.mask) | (value.u & write.mask);
  signal.store(value);
}

void ProcessImage::take_writes() noexcept {
  applied_ += writes_.consume([this](const SignalWrite& write) { apply(signals_[write.signal], write); });
}

void ProcessImage::publish(std::int64_t tick) noexcept {
  Snapshot& snapshot = snapshot_.back();
  snapshot.tick = tick;
  snapshot.applied = applied_;
  for (std::size_t i = 0; i < variables_.size(); ++i) snapshot.values[i] = variables_[i].load();
  snapshot_.publish();
}

Signal ProcessImage::shadow_of(std::size_t signal) const noexcept {
  return Signal{&shadow_[places_[signal]], signals_[signal].type, signals_[signal].bit};
}

bool ProcessImage::refresh() noexcept {
  if (!snapshot_.refresh()) return false;
  const Snapshot& snapshot = snapshot_.front();
  for (std::size_t i = 0; i < variables_.size(); ++i)
    Signal{&shadow_[i], variables_[i].type, -1}.store(snapshot.values[i]);
  shown_ = snapshot.applied;
  // What this tick did not know yet goes on top, by the same steps in which the cycle will apply it.
  for (std::uint64_t n = shown_; n != posted_; ++n) {
    const SignalWrite& write = pending_[n % pending_.size()];
    apply(shadow_of(write.signal), write);
  }
  return true;
}

Value ProcessImage::value(std::size_t signal) const noexcept {
  return shadow_of(signal).load();
}

bool ProcessImage::post(std::span<const SignalWrite> batch) noexcept {
  // The ring of pending writes is the narrower place: it holds a write until a snapshot shows it, the queue
  // only until the cycle takes it.
  if (batch.size() > writes_.capacity() - (posted_ - shown_) || !writes_.push(batch)) return false;
  for (const SignalWrite& write : batch) {
    pending_[posted_ % pending_.size()] = write;
    ++posted_;
    apply(shadow_of(write.signal), write);
  }
  return true;
}

}  // namespace lockstep
