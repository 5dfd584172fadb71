// The network of a simulated system: what it does to telegrams is what is asked of it, and always the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "projects/system/simulated_network.hpp"

namespace lockstep::simulated_link_test {
namespace {

constexpr std::int64_t kMilli = 1'000'000;

struct Arrived {
  std::uint64_t sequence;
  std::int64_t at;
  bool operator==(const Arrived&) const = default;
};

/// What arrives of `count` telegrams, one a millisecond, looked at each 10 µs.
std::vector<Arrived> carried(const SimulatedNetwork& network, int count, std::uint64_t index = 0) {
  SimulatedLink link(network, index);
  std::vector<Arrived> arrived;
  for (std::int64_t now = 0; now < (count + 50) * kMilli; now += 10'000) {
    if (now % kMilli == 0 && now < count * kMilli) {
      LeadingValueTelegram telegram;
      telegram.sequence = static_cast<std::uint64_t>(now / kMilli);
      telegram.cycle = kMilli;
      link.send(telegram, now);
    }
    link.take(now, [&](const LeadingValueTelegram& telegram) {
      arrived.push_back({telegram.sequence, now});
    });
  }
  return arrived;
}

TEST(SimulatedLink, WithoutNetworkHandsOverInTheNextTick) {
  SimulatedLink link({}, 0);
  link.send({}, 5);
  int taken = 0;
  link.take(5, [&](const LeadingValueTelegram&) { ++taken; });
  EXPECT_EQ(taken, 0) << "not in a tick of the same time, whichever controller comes first";
  link.take(6, [&](const LeadingValueTelegram&) { ++taken; });
  EXPECT_EQ(taken, 1);
}

TEST(SimulatedLink, TakesLatencyAndJitter) {
  const auto arrived = carried({.latency = 300'000, .jitter = 100'000}, 2000);
  ASSERT_EQ(arrived.size(), 2000u);
  std::int64_t shortest = kMilli, longest = 0;
  for (const Arrived& one : arrived) {
    const std::int64_t time = one.at - static_cast<std::int64_t>(one.sequence) * kMilli;
    shortest = std::min(shortest, time);
    longest = std::max(longest, time);
  }
  EXPECT_GE(shortest, 200'000);
  EXPECT_LE(shortest, 210'000);
  EXPECT_LE(longest, 400'000);
  EXPECT_GE(longest, 390'000);
}

TEST(SimulatedLink, LosesDoublesAndReordersAsManyAsAsked) {
  const auto lossy = carried({.loss = 0.1}, 10'000);
  EXPECT_NEAR(static_cast<double>(lossy.size()), 9000.0, 150.0);
  const auto doubled = carried({.jitter = 100'000, .duplicates = 0.1}, 10'000);
  EXPECT_NEAR(static_cast<double>(doubled.size()), 11'000.0, 150.0);
  const auto mixed = carried({.reordering = 0.1}, 10'000);
  ASSERT_EQ(mixed.size(), 10'000u);
  int behind = 0;
  std::uint64_t newest = 0;
  for (const Arrived& one : mixed) {
    behind += one.sequence < newest ? 1 : 0;
    newest = std::max(newest, one.sequence);
  }
  EXPECT_GT(behind, 400);
  EXPECT_LT(behind, 1000);
}

TEST(SimulatedLink, GivesTheSameForTheSameSeedAndAnotherForEachLink) {
  const SimulatedNetwork network{.latency = 300'000, .jitter = 200'000, .loss = 0.1, .seed = 7};
  EXPECT_EQ(carried(network, 1000), carried(network, 1000));
  EXPECT_NE(carried(network, 1000), carried(network, 1000, 1));
  SimulatedNetwork other = network;
  other.seed = 8;
  EXPECT_NE(carried(network, 1000), carried(other, 1000));
}

}  // namespace
}  // namespace lockstep::simulated_link_test
