// Thirty-two clients at full speed, half of them up to no good: what the cycle notices of them.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <thread>

#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/flood.hpp"
#include "tests/support/property.hpp"

namespace lockstep::modbus_flood_test {
namespace {

constexpr int kRounds = 150;  // of each good client
constexpr int kFirst = 210;   // its register: row[10] of the machine, beyond the pair

/// Waits of the calling thread in the system: switches that it asked for.
long waits() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

TEST(Flood, WithThirtyTwoClientsTheCycleNeitherWaitsNorAllocatesAndEveryAnswerIsRight) {
  ModbusMachine machine;
  ModbusServerOptions options;
  options.listen = {{"127.0.0.1", 0}};
  ModbusServer server(options, machine.map, machine.image);
  ASSERT_EQ(server.start(), "");
  const test::FloodClients clients(server.port(), kRounds, test::seed_of_test(20240604), kFirst);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  long waited = 0;
  std::uint64_t ticks = 0;
  const std::uint64_t allocated = test::allocations_counted();
  while (clients.good_left() > 0 && std::chrono::steady_clock::now() < deadline) {
    const long before = waits();
    {
      const test::CountAllocations count;
      for (int i = 0; i < 1000; ++i) machine.tick();
    }
    waited += waits() - before;
    ticks += 1000;
    std::this_thread::yield();  // the pause of a cycle, so that the others get on
  }
  machine.tick();
  EXPECT_EQ(clients.good_left(), 0) << "in two minutes";
#ifndef __SANITIZE_THREAD__  // which has locks of its own behind every access
  EXPECT_EQ(waited, 0);
#else
  std::printf("the thread sanitizer waited %ld times\n", waited);
#endif
  EXPECT_EQ(test::allocations_counted(), allocated);
  EXPECT_EQ(clients.wrong(), 0);
  EXPECT_GT(server.counters().malformed, 0u);
  EXPECT_GE(server.counters().requests, std::uint64_t{3} * test::kFloodGood * kRounds);
  EXPECT_EQ(server.counters().faults, 0u);
  for (int i = 0; i < test::kFloodGood; ++i)
    EXPECT_EQ(machine.row[static_cast<std::size_t>(kFirst - 200 + i)], kRounds - 1);
  RecordProperty("ticks", std::to_string(ticks));
}

TEST(Allocations, TheCountOfAllocationsSeesThem) {
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations count;
    delete new std::vector<int>(10);
  }
  EXPECT_GE(test::allocations_counted(), before + 2);
}

}  // namespace
}  // namespace lockstep::modbus_flood_test
