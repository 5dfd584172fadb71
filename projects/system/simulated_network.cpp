#include "projects/system/simulated_network.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// One step of SplitMix64, whose bits are the same everywhere.
/// @source Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014)
std::uint64_t next_random(std::uint64_t& state) noexcept {
  state += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

constexpr double kReorderedCycles = 4.0;  // by which a telegram is late at most that is overtaken

}  // namespace

SimulatedLink::SimulatedLink(const SimulatedNetwork& network, std::uint64_t index) noexcept
    : network_(network), state_(network.seed) {
  state_ = next_random(state_) + index * 0x632be59bd9b4e019u;
}

/// From 0 to below 1.
double SimulatedLink::chance() noexcept {
  return static_cast<double>(next_random(state_) >> 11) * 0x1p-53;
}

void SimulatedLink::send(const LeadingValueTelegram& telegram, std::int64_t now) {
  if (network_.loss > 0.0 && chance() < network_.loss) {
    ++lost_;
    return;
  }
  put(telegram, now);
  if (network_.duplicates > 0.0 && chance() < network_.duplicates) put(telegram, now);
}

void SimulatedLink::put(const LeadingValueTelegram& telegram, std::int64_t now) {
  std::int64_t time = network_.latency;
  if (network_.jitter > 0)
    time += std::llround((2.0 * chance() - 1.0) * static_cast<double>(network_.jitter));
  if (network_.reordering > 0.0 && chance() < network_.reordering)
    time += std::llround(chance() * kReorderedCycles * static_cast<double>(telegram.cycle));
  const std::int64_t arrival = now + std::max<std::int64_t>(time, 0);
  const auto behind = std::ranges::upper_bound(in_transit_, arrival, {}, &InTransit::arrival);
  in_transit_.insert(behind, {arrival, now, telegram});
}

}  // namespace lockstep
