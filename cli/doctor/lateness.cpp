#include "cli/doctor/lateness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lockstep::cli {
namespace {

constexpr std::int64_t kMicrosecond = 1000;  // [ns]
constexpr std::size_t kBuckets = 20'001;     // up to 20 ms

}  // namespace

Lateness::Lateness() : buckets_(kBuckets) {}

void Lateness::add(std::int64_t late) noexcept {
  const std::int64_t minimum = std::max<std::int64_t>(late, 0);
  const auto bucket = static_cast<std::size_t>((minimum + kMicrosecond - 1) / kMicrosecond);
  ++buckets_[std::min(bucket, kBuckets - 1)];
  count_.fetch_add(1, std::memory_order_relaxed);
  if (minimum > worst()) worst_.store(minimum, std::memory_order_relaxed);
}

std::int64_t Lateness::quantile(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count())));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i + 1 < kBuckets; ++i) {
    seen += buckets_[i];
    if (seen >= wanted) return std::min(static_cast<std::int64_t>(i) * kMicrosecond, worst());
  }
  return worst();
}

void measure(WaitingClock& clock, std::int64_t cycle, std::int64_t duration, Lateness& into) noexcept {
  const std::int64_t start = clock.now();
  std::int64_t due = start;
  do {
    due += cycle;
    clock.sleep_until(due);
    const std::int64_t late = clock.now() - due;
    into.add(late);
    if (late > cycle) due += late / cycle * cycle;
  } while (due + cycle <= start + duration);
}

}  // namespace lockstep::cli
