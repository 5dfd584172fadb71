#include <gtest/gtest.h>
#include <modbus.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/modbus_raw_client.hpp"

namespace lockstep::modbus_server_test {
namespace {

using Library = std::unique_ptr<modbus_t, void (*)(modbus_t*)>;

ModbusServerOptions any_port() {
  ModbusServerOptions options;
  options.listen = {{"127.0.0.1", 0}};
  return options;
}

/// The library's own client, connected.
Library client_of(const ModbusServer& server) {
  Library client(modbus_new_tcp("127.0.0.1", server.port()), [](modbus_t* context) {
    modbus_close(context);
    modbus_free(context);
  });
  modbus_set_response_timeout(client.get(), 20, 0);
  EXPECT_EQ(modbus_connect(client.get()), 0);
  return client;
}

/// What a foreign program prints.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

class Served : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(server.start(), ""); }

  ModbusMachine machine;
  ModbusServer server{any_port(), machine.map, machine.image};
};

TEST_F(Served, TheLibrarysClientReadsAllFourTables) {
  machine.position = 12.5;
  machine.tick();
  const Library client = client_of(server);
  std::array<std::uint8_t, 2000> bits{};
  std::array<std::uint16_t, 125> words{};
  EXPECT_EQ(modbus_read_bits(client.get(), 0, 3, bits.data()), 3);
  EXPECT_EQ(bits[1], 1);
  EXPECT_EQ(modbus_read_bits(client.get(), 1000, 2000, bits.data()), 2000);
  EXPECT_EQ(modbus_read_input_bits(client.get(), 0, 1, bits.data()), 1);
  EXPECT_EQ(bits[0], 1);
  EXPECT_EQ(modbus_read_registers(client.get(), 10, 2, words.data()), 2);
  EXPECT_EQ(modbus_get_float_abcd(words.data()), 200.0F);
  EXPECT_EQ(modbus_read_registers(client.get(), 200, 125, words.data()), 125);
  EXPECT_EQ(modbus_read_input_registers(client.get(), 0, 2, words.data()), 2);
  EXPECT_EQ(modbus_get_float_abcd(words.data()), 12.5F);
}

TEST_F(Served, TheLibrarysClientWritesWithEveryFunctionAndReadsItBackBeforeAnyTick) {
  const Library client = client_of(server);
  std::array<std::uint8_t, 1968> bits{};
  std::array<std::uint16_t, 125> words{};
  bits.fill(1);
  EXPECT_EQ(modbus_write_bit(client.get(), 0, 1), 1);
  EXPECT_EQ(modbus_write_bits(client.get(), 1000, 1968, bits.data()), 1968);
  EXPECT_EQ(modbus_write_register(client.get(), 31, 100), 1);
  words = {0x4060, 0};  // 3.5
  EXPECT_EQ(modbus_write_registers(client.get(), 10, 2, words.data()), 2);
  EXPECT_EQ(modbus_mask_write_register(client.get(), 30, 0xFFF0, 0x0003), 1);
  const std::array<std::uint16_t, 2> row = {7, 8};
  EXPECT_EQ(modbus_write_and_read_registers(client.get(), 200, 2, row.data(), 200, 3, words.data()), 3);
  EXPECT_EQ(words[0], 7);
  EXPECT_EQ(words[1], 8);
  EXPECT_EQ(words[2], 0);
  EXPECT_EQ(modbus_read_bits(client.get(), 0, 1, bits.data()), 1);
  EXPECT_EQ(bits[0], 1);
  EXPECT_EQ(modbus_read_registers(client.get(), 30, 2, words.data()), 2);
  EXPECT_EQ(words[0], 0x0F03);
  EXPECT_EQ(words[1], 100);
  EXPECT_FALSE(machine.start);
  machine.tick();
  EXPECT_TRUE(machine.start && machine.lamps[1967]);
  EXPECT_EQ(machine.speed, 3.5);
  EXPECT_EQ(machine.small, 100);
  EXPECT_EQ(machine.word, WORD{0x0F03});
}

TEST_F(Served, TheLibrarysClientGetsTheExceptions) {
  const Library client = client_of(server);
  std::uint16_t word = 0;
  EXPECT_EQ(modbus_read_registers(client.get(), 5, 1, &word), -1);
  EXPECT_EQ(errno, EMBXILADD);
  for (const int address : {32, 5, 11}) {  // read-only, without an entry, the second half of a REAL
    EXPECT_EQ(modbus_write_register(client.get(), address, 1), -1);
    EXPECT_EQ(errno, EMBXILADD) << address;
  }
  EXPECT_EQ(modbus_write_register(client.get(), 31, 1000), -1);
  EXPECT_EQ(errno, EMBXILVAL);
  std::array<std::uint8_t, 260> id{};
  EXPECT_EQ(modbus_report_slave_id(client.get(), 250, id.data()), -1);
  EXPECT_EQ(errno, EMBXILFUN);
  EXPECT_EQ(server.counters().requests, 6u);
  EXPECT_EQ(server.counters().exceptions, 6u);
  EXPECT_EQ(server.counters().faults, 0u);
}

TEST_F(Served, AnyNumberOfWritesWaitsForTheCycleAndTheLastOnesWin) {
  const Library client = client_of(server);
  std::array<std::uint16_t, 123> row{};
  std::array<std::uint16_t, 123> shown{};
  for (std::uint16_t n = 0; n < 200; ++n) {
    row.fill(n);
    ASSERT_EQ(modbus_write_registers(client.get(), 200, 123, row.data()), 123);
    ASSERT_EQ(modbus_read_registers(client.get(), 200, 123, shown.data()), 123);
    ASSERT_EQ(shown, row);
  }
  EXPECT_EQ(machine.row[0], 0);
  machine.tick();
  EXPECT_EQ(machine.row[0], 199);
  EXPECT_EQ(machine.row[122], 199);
}

TEST_F(Served, AForeignClientReadsAndWritesRealsInTheUsualWordOrder) {
  const std::string call = "mbpoll -1 -0 -B -o 10 -p " + std::to_string(server.port()) + " -t 4:float -r 10 ";
  const std::string before = output_of(call + "127.0.0.1");
  EXPECT_NE(before.find("[10]: \t200"), std::string::npos) << before;
  const std::string written = output_of(call + "127.0.0.1 -- -12.5");
  EXPECT_NE(written.find("Written 1 reference"), std::string::npos) << written;
  machine.tick();
  EXPECT_EQ(machine.speed, -12.5);
  const std::string after = output_of(call + "127.0.0.1");
  EXPECT_NE(after.find("[10]: \t-12.5"), std::string::npos) << after;
}

TEST_F(Served, APortThatIsTakenIsToldAndNothingStarts) {
  ModbusServerOptions options;
  options.listen = {{"127.0.0.1", server.port()}};
  ModbusMachine other;
  ModbusServer second(options, other.map, other.image);
  EXPECT_EQ(second.start(), "127.0.0.1:" + std::to_string(server.port()) + ": Address already in use");
  EXPECT_EQ(second.port(), 0);
  server.stop();
  EXPECT_EQ(second.start(), "");
  EXPECT_EQ(second.port(), options.listen[0].port);
}

TEST_F(Served, StoppingHangsUpOnTheClientsAndStartingServesAgain) {
  RawClient client(server.port());
  ASSERT_TRUE(client.send({0, 1, 0, 0, 0, 6, 1, 2, 0, 0, 0, 1}));
  EXPECT_EQ(client.receive(10).size(), 10u);
  server.stop();
  server.stop();
  EXPECT_EQ(server.port(), 0);
  EXPECT_TRUE(client.is_hung_up_on());
  EXPECT_EQ(server.counters().clients, 0u);
  ASSERT_EQ(server.start(), "");
  std::uint8_t bit = 0;
  EXPECT_EQ(modbus_read_input_bits(client_of(server).get(), 0, 1, &bit), 1);
}

TEST(ModbusServer, AHostThatIsNoneOfThisMachineIsTold) {
  ModbusMachine machine;
  ModbusServerOptions options = any_port();
  options.listen[0].host = "192.0.2.1";  // reserved for documentation
  ModbusServer server(options, machine.map, machine.image);
  EXPECT_EQ(server.start(), "192.0.2.1:0: Cannot assign requested address");
}

/// Ticks as fast as it can on a thread of its own: every word that it shows in one tick is the same number.
class Cycle {
 public:
  explicit Cycle(ModbusMachine& machine) : thread_([this, &machine] { run(machine); }) {}
  ~Cycle() { end(); }
  void end() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  std::uint64_t torn() const { return torn_; }  ///< after the end

 private:
  void run(ModbusMachine& machine) {
    std::int64_t last = 0;
    for (std::uint64_t n = 0; !is_over_; ++n) {
      const std::uint64_t word = n & 0x7FFF;
      machine.turns.fill(word * 0x0001000100010001ULL);
      machine.tick();
      const std::int64_t count = machine.count;
      torn_ += count % 0x0001000100010001LL != 0 || count < last ? 1 : 0;
      torn_ += machine.row[0] != machine.row[122] ? 1 : 0;
      last = count;
      std::this_thread::yield();
    }
  }

  std::atomic<bool> is_over_{false};
  std::uint64_t torn_ = 0;
  std::thread thread_;
};

TEST_F(Served, WhileTheCycleRunsNoRequestSeesTwoInstantsAndNoWriteIsTornOrForgotten) {
  Cycle cycle(machine);
  const Library client = client_of(server);
  std::array<std::uint16_t, 16> shown{};
  std::array<std::uint16_t, 4> count{};
  std::array<std::uint16_t, 123> row{};
  int torn = 0;
  int forgotten = 0;
  for (std::uint16_t n = 1; n <= 1'500; ++n) {
    ASSERT_EQ(modbus_read_input_registers(client.get(), 100, 16, shown.data()), 16);
    for (const std::uint16_t word : shown) torn += word != shown[0] ? 1 : 0;
    count.fill(n);
    ASSERT_EQ(modbus_write_registers(client.get(), 20, 4, count.data()), 4);
    count.fill(0);
    ASSERT_EQ(modbus_read_registers(client.get(), 20, 4, count.data()), 4);
    for (const std::uint16_t word : count) forgotten += word != n ? 1 : 0;
    row.fill(n);
    ASSERT_EQ(modbus_write_registers(client.get(), 200, 123, row.data()), 123);
  }
  cycle.end();
  EXPECT_EQ(cycle.torn(), 0u);
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(forgotten, 0);
}

TEST_F(Served, ManyClientsAtOnceEachGetTheirOwnAnswers) {
  Cycle cycle(machine);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&, k] {
      const Library client = client_of(server);
      for (std::uint16_t n = 0; n < 150; ++n) {
        std::uint16_t word = 0;
        if (modbus_write_register(client.get(), 210 + k, n) != 1) ++wrong;
        if (modbus_read_registers(client.get(), 210 + k, 1, &word) != 1 || word != n) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(server.counters().requests, 8u * 300u);
  EXPECT_EQ(server.counters().connections, 8u);
}

}  // namespace
}  // namespace lockstep::modbus_server_test
