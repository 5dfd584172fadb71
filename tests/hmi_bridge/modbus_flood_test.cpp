// Thirty-two clients at full speed, half of them up to no good: what the cycle notices of them.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <random>
#include <thread>

#include "hmi_bridge/modbus_server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/modbus_raw_client.hpp"
#include "tests/support/allocations.hpp"

namespace lockstep {
namespace {

using Bytes = RawClient::Bytes;

constexpr int kGood = 16;
constexpr int kRounds = 150;  // of each good client: a write and a read of what it wrote

/// Waits of the calling thread in the system: switches that it asked for.
long waits() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

class Flood : public ::testing::Test {
 protected:
  void SetUp() override {
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    server = std::make_unique<ModbusServer>(options, machine.map, machine.image);
    ASSERT_EQ(server->start(), "");
  }
  ~Flood() override {
    is_over = true;
    for (std::thread& thread : threads) thread.join();
  }

  /// Writes a register of its own and reads it back; every answer is checked, byte by byte.
  void be_good(int number) {
    RawClient client(server->port());
    const auto low = static_cast<std::uint8_t>(200 + number);
    for (int n = 0; n < kRounds; ++n) {
      const auto value = static_cast<std::uint8_t>(n);
      const Bytes write = {0, value, 0, 0, 0, 6, 1, 6, 0, low, 0, value};
      const Bytes read = {0, value, 0, 0, 0, 6, 1, 3, 0, low, 0, 1};
      const Bytes answer = {0, value, 0, 0, 0, 5, 1, 3, 2, 0, value};
      if (!client.send(write) || client.receive(write.size()) != write) ++wrong;
      if (!client.send(read) || client.receive(answer.size()) != answer) ++wrong;
    }
    --good_left;
  }
  /// Comes again and again with bytes that are no Modbus, or not quite.
  void be_malformed(unsigned seed) {
    std::mt19937 random(seed);
    while (!is_over) {
      RawClient client(server->port());
      Bytes bytes = {0, 1, 0, 0, 0, 6, 1, 3, 0, 30, 0, 3};
      for (int i = 0; i < 3; ++i) {
        const std::size_t place = random() % bytes.size();
        if (place != 7) bytes[place] = static_cast<std::uint8_t>(random());  // not the function: no writes
      }
      client.send(bytes);
      client.end_sending();
      client.is_hung_up_on();
    }
  }
  /// A whole request, a byte at a time, without end.
  void be_slow() {
    RawClient client(server->port());
    const Bytes request = {0, 1, 0, 0, 0, 6, 1, 3, 0, 32, 0, 1};
    while (!is_over) {
      for (const std::uint8_t byte : request) {
        if (is_over || !client.send({byte})) return;
        std::this_thread::yield();
      }
      if (client.receive(11).size() != 11) ++wrong;
    }
  }
  /// Half a request, and then nothing: needs no thread.
  void be_silent() {
    RawClient client(server->port());
    client.send({0, 1, 0, 0, 0, 6});
    silent.push_back(std::move(client));
  }

  ModbusMachine machine;
  std::unique_ptr<ModbusServer> server;
  std::vector<std::thread> threads;
  std::vector<RawClient> silent;
  std::atomic<bool> is_over{false};
  std::atomic<int> good_left{kGood};
  std::atomic<int> wrong{0};
};

TEST_F(Flood, WithThirtyTwoClientsTheCycleNeitherWaitsNorAllocatesAndEveryAnswerIsRight) {
  for (int i = 0; i < 5; ++i) be_silent();
  for (int i = 0; i < kGood; ++i) threads.emplace_back([this, i] { be_good(i); });
  for (unsigned i = 0; i < 6; ++i) threads.emplace_back([this, i] { be_malformed(20240604 + i); });
  for (int i = 0; i < 5; ++i) threads.emplace_back([this] { be_slow(); });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  long waited = 0;
  std::uint64_t ticks = 0;
  const std::uint64_t allocated = test::allocations_counted();
  while (good_left > 0 && std::chrono::steady_clock::now() < deadline) {
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
  EXPECT_EQ(good_left, 0) << "in two minutes";
  EXPECT_EQ(waited, 0);
  EXPECT_EQ(test::allocations_counted(), allocated);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(server->counters().malformed, 0u);
  EXPECT_GE(server->counters().requests, std::uint64_t{2} * kGood * kRounds);
  EXPECT_EQ(server->counters().faults, 0u);
  for (int i = 0; i < kGood; ++i) EXPECT_EQ(machine.row[static_cast<std::size_t>(i)], kRounds - 1);
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
}  // namespace lockstep
