#include <gtest/gtest.h>

#include <functional>

#include "hmi_bridge/modbus/client.hpp"
#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/foreign_device.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/serial_cable.hpp"

namespace lockstep::modbus_client_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

ModbusEntry entry(std::uint32_t signal, ModbusTable table, std::uint32_t address, Type type) {
  ModbusEntry result;
  result.signal = signal;
  result.table = table;
  result.address = address;
  result.type = type;
  return result;
}

/// The controller's side: tags that a client fills from the machine, which is the foreign device.
struct Tags {
  LREAL speed = 0.0;            // signal 0
  LINT count = 0;               // 1
  INT locked = 0;               // 2
  BOOL shown = false;           // 3
  INT out = 12;                 // 4
  BOOL quality = false;         // 5
  std::int64_t age = -1;        // 6
  USINT narrow = 3;             // 7
  BOOL one_good = false;        // 8
  std::int64_t one_age = -1;    // 9
  BOOL other_good = false;      // 10
  std::int64_t other_age = -1;  // 11
  std::vector<Signal> signals = {
      {&speed, Type::LREAL, -1},  {&count, Type::LINT, -1},      {&locked, Type::INT, -1},
      {&shown, Type::BOOL, -1},   {&out, Type::INT, -1},         {&quality, Type::BOOL, -1},
      {&age, Type::TIME, -1},     {&narrow, Type::USINT, -1},    {&one_good, Type::BOOL, -1},
      {&one_age, Type::TIME, -1}, {&other_good, Type::BOOL, -1}, {&other_age, Type::TIME, -1}};
  ProcessImage image{signals};
  std::int64_t ticks = -1;

  void tick() {
    image.take_writes();
    image.publish(++ticks);
  }
  /// Ticks until something holds; the test fails if it never does.
  void expect(const std::function<bool()>& condition) {
    const auto deadline = Clock::now() + 20s;
    while (!condition() && Clock::now() < deadline) {
      tick();
      std::this_thread::yield();
    }
    EXPECT_TRUE(condition());
  }
};

ModbusDevice plain_device() {
  ModbusDevice device;
  device.name = "machine";
  device.cycle = 5ms;
  device.quality = 5;
  device.age = 6;
  device.reads = {entry(0, ModbusTable::holding_register, 10, Type::REAL),
                  entry(1, ModbusTable::holding_register, 20, Type::LINT),
                  entry(2, ModbusTable::holding_register, 32, Type::INT),
                  entry(3, ModbusTable::coil, 1, Type::BOOL)};
  device.writes = {entry(4, ModbusTable::holding_register, 200, Type::INT)};
  return device;
}

class Client : public ::testing::Test {
 protected:
  void serve(std::uint16_t port = 0) {
    ModbusServerOptions at;
    at.listen = {{"127.0.0.1", port}};
    server = std::make_unique<ModbusServer>(at, machine.map, machine.image);
    ASSERT_EQ(server->start(), "");
  }
  void poll(std::vector<ModbusDevice> devices, std::uint16_t port) {
    ModbusClientOptions options;
    options.connect = Endpoint{"127.0.0.1", port};
    options.timeout = 20s;
    options.first_retry = 5ms;
    options.longest_retry = 20ms;
    options.devices = std::move(devices);
    start(options);
  }
  void start(const ModbusClientOptions& options) {
    client = std::make_unique<ModbusClient>(options, tags.image);
    client->start();
  }

  ModbusMachine machine;
  Tags tags;
  std::unique_ptr<ModbusServer> server;
  std::unique_ptr<ModbusClient> client;
};

TEST_F(Client, ReadsADevicesValuesIntoTagsAndWritesTagsToIt) {
  serve();
  poll({plain_device()}, server->port());
  tags.expect([&] { return tags.quality; });
  EXPECT_EQ(tags.speed, 200.0);
  EXPECT_EQ(tags.locked, 77);
  EXPECT_TRUE(tags.shown);
  machine.tick();
  EXPECT_EQ(machine.row[0], 12);
  machine.speed = 2.5;
  machine.count = -5;
  tags.out = 13;
  machine.tick();
  tags.expect([&] { return tags.speed == 2.5 && tags.count == -5; });
  tags.expect([&] {
    machine.tick();
    return machine.row[0] == 13;
  });
  EXPECT_EQ(client->counters().failed, 0u);
}

TEST_F(Client, TheAgeOfGoodValuesIsNextToNothingAndGrowsWhenTheDeviceIsGone) {
  serve();
  const std::uint16_t port = server->port();
  poll({plain_device()}, port);
  tags.expect([&] { return tags.quality && tags.age == 0; });
  server->stop();
  tags.expect([&] { return !tags.quality; });
  EXPECT_EQ(tags.locked, 77) << "the last value stays";
  tags.expect([&] { return tags.age > 100'000'000; });
  machine.locked = 78;
  machine.tick();
  serve(port);
  tags.expect([&] { return tags.quality && tags.age == 0 && tags.locked == 78; });
  EXPECT_GE(client->counters().connections, 2u);
  EXPECT_GE(client->counters().unreachable, 1u);
}

TEST_F(Client, NeighboursGoInOneRequest) {
  serve();
  ModbusDevice device;
  device.cycle = 1h;
  device.quality = 5;
  device.reads = {entry(2, ModbusTable::holding_register, 31, Type::INT),
                  entry(4, ModbusTable::holding_register, 32, Type::INT),
                  entry(7, ModbusTable::holding_register, 30, Type::UINT)};
  machine.word = WORD{200};
  machine.tick();
  poll({device}, server->port());
  tags.expect([&] { return tags.quality; });
  EXPECT_EQ(client->counters().requests, 1u);
  EXPECT_EQ(tags.locked, -3);
  EXPECT_EQ(tags.out, 77);
  EXPECT_EQ(tags.narrow, 200);
}

TEST_F(Client, AnExceptionSpoilsTheQualityAndNotTheOtherValues) {
  serve();
  ModbusDevice device = plain_device();
  device.reads.push_back(entry(7, ModbusTable::input_register, 500, Type::UINT));
  poll({device}, server->port());
  tags.expect([&] { return tags.locked == 77 && client->counters().refused >= 2; });
  EXPECT_FALSE(tags.quality);
  EXPECT_EQ(client->counters().failed, 0u);
  EXPECT_EQ(client->counters().connections, 1u);
}

TEST_F(Client, AValueThatItsTagCannotHoldIsNotTaken) {
  serve();
  ModbusDevice device = plain_device();
  device.reads.push_back(entry(7, ModbusTable::holding_register, 30, Type::UINT));  // 16#0F0F
  poll({device}, server->port());
  tags.expect([&] { return tags.locked == 77 && client->counters().bad_values >= 1; });
  EXPECT_FALSE(tags.quality);
  EXPECT_EQ(tags.narrow, 3);
}

/// Two neighbours that go in one request; of each is told how it is.
ModbusDevice device_of_two(const ModbusEntry& one, const ModbusEntry& other) {
  ModbusDevice device;
  device.cycle = 5ms;
  device.quality = 5;
  device.age = 6;
  device.reads = {one, other};
  device.lines = {{false, 0, 8, 9}, {false, 1, 10, 11}};
  return device;
}

TEST_F(Client, AnEntryWhoseValueIsBadIsBadAlone) {
  serve();
  // 77 fits; -3 beside it does not.
  poll({device_of_two(entry(2, ModbusTable::holding_register, 32, Type::INT),
                      entry(7, ModbusTable::holding_register, 31, Type::INT))},
       server->port());
  tags.expect([&] { return tags.one_good && client->counters().bad_values >= 2; });
  EXPECT_FALSE(tags.other_good);
  EXPECT_FALSE(tags.quality) << "not all of the cycle went well";
  EXPECT_EQ(tags.locked, 77);
  EXPECT_EQ(tags.one_age, 0);
  tags.expect([&] { return tags.other_age > 50'000'000 && tags.age > 50'000'000; });
  EXPECT_EQ(tags.narrow, 3) << "the last value stays";
  machine.small = 9;
  machine.tick();
  tags.expect([&] { return tags.other_good && tags.quality && tags.narrow == 9; });
  EXPECT_EQ(tags.other_age, 0);
}

TEST_F(Client, AnEntryThatTheDeviceRefusesIsBadAloneAndItsNeighboursAreReadWithoutIt) {
  serve();
  // At 33 the device has nothing: it refuses the request for both.
  poll({device_of_two(entry(2, ModbusTable::holding_register, 32, Type::INT),
                      entry(7, ModbusTable::holding_register, 33, Type::UINT))},
       server->port());
  tags.expect([&] { return tags.one_good; });
  EXPECT_FALSE(tags.other_good);
  EXPECT_FALSE(tags.quality);
  EXPECT_EQ(tags.locked, 77);
  machine.locked = 78;
  machine.tick();
  tags.expect([&] { return tags.locked == 78 && tags.other_age > 50'000'000; });
  EXPECT_EQ(tags.one_age, 0);
  EXPECT_EQ(client->counters().failed, 0u);
  EXPECT_EQ(client->counters().connections, 1u);
}

TEST_F(Client, EntriesThatWereRefusedTogetherAreAskedForTogetherAgainLater) {
  serve();
  ModbusDevice device = device_of_two(entry(2, ModbusTable::holding_register, 32, Type::INT),
                                      entry(7, ModbusTable::holding_register, 33, Type::UINT));
  device.cycle = 1ms;
  poll({device}, server->port());
  // In the first cycle both together are refused, then the second alone: one good answer, two exceptions. In
  // each of the next hundred there is one of each, then both are asked for together again.
  const auto& counters = client->counters();
  tags.expect([&] { return counters.requests >= 150; });
  client->stop();
  EXPECT_EQ(counters.refused - counters.requests, 2u);
}

TEST_F(Client, AnEntryThatTheDeviceDoesNotLetWriteIsBadAlone) {
  serve();
  ModbusDevice device;
  device.cycle = 5ms;
  device.quality = 5;
  // 31 can be written, 32 cannot.
  device.writes = {entry(7, ModbusTable::holding_register, 31, Type::INT),
                   entry(4, ModbusTable::holding_register, 32, Type::INT)};
  device.lines = {{true, 0, 8, 9}, {true, 1, 10, 11}};
  poll({device}, server->port());
  tags.expect([&] { return tags.one_good && tags.other_age > 20'000'000; });
  EXPECT_FALSE(tags.other_good);
  EXPECT_FALSE(tags.quality);
  machine.tick();
  EXPECT_EQ(machine.small, 3);
  EXPECT_EQ(machine.locked, 77);
}

TEST_F(Client, TheQualityOfEveryEntryFallsWithTheDevice) {
  serve();
  poll({device_of_two(entry(2, ModbusTable::holding_register, 32, Type::INT),
                      entry(3, ModbusTable::coil, 1, Type::BOOL))},
       server->port());
  tags.expect([&] { return tags.one_good && tags.other_good && tags.quality; });
  server->stop();
  tags.expect([&] { return !tags.one_good && !tags.other_good && !tags.quality; });
  tags.expect([&] { return tags.one_age > 50'000'000 && tags.other_age > 50'000'000; });
}

TEST_F(Client, TheElementsOfALineAreGoodTogetherOrNot) {
  serve();
  ModbusDevice device;
  device.cycle = 5ms;
  device.reads = {entry(2, ModbusTable::holding_register, 32, Type::INT),
                  entry(7, ModbusTable::holding_register, 31, Type::INT)};
  device.reads[0].line = device.reads[1].line = 4;
  device.lines = {{false, 4, 8, 9}};
  poll({device}, server->port());
  tags.expect([&] { return tags.locked == 77 && tags.one_age > 20'000'000; });
  EXPECT_FALSE(tags.one_good);
  machine.small = 9;
  machine.tick();
  tags.expect([&] { return tags.one_good && tags.narrow == 9; });
}

TEST_F(Client, ADeviceThatKeepsSilentIsAskedLessAndLessOftenAndHoldsUpNoOther) {
  const ListeningSocket silent;  // the system accepts the connection; nobody answers
  ModbusClientOptions options;
  options.connect = Endpoint{"127.0.0.1", silent.port()};
  options.timeout = 20ms;
  options.first_retry = 100ms;
  options.devices = {plain_device()};
  tags.quality = true;
  start(options);
  tags.expect([&] { return !tags.quality && tags.age > 800'000'000; });
  // At 0, 120, 340, 760 ms; without pauses there would be some forty attempts.
  EXPECT_GE(client->counters().failed, 2u);
  EXPECT_LE(client->counters().failed, 4u);
  const auto before = Clock::now();
  client->stop();
  EXPECT_LT(Clock::now() - before, 5s);
}

TEST_F(Client, AnAnswerThatIsNotOneToTheRequestSpoilsTheCycleAndTheConnectionIsMadeAnew) {
  // Lies of an otherwise good device: the protocol, the unit; of a write its address and its value.
  for (const std::size_t place : {2, 6, 9, 11}) {
    std::atomic<bool> is_lying{false};
    const ForeignDevice device([&](const ForeignDevice::Bytes& request) {
      ForeignDevice::Bytes answer = ForeignDevice::good_answer(request);
      const bool is_asked_for = place <= 6 ? request[7] == 3 : request[7] == 6;
      if (is_asked_for && is_lying) {
        answer[place] ^= 1;
        if (request[7] == 3) answer[9] = answer[10] = 99;
      }
      return answer;
    });
    ModbusDevice one;
    one.unit = 5;
    one.cycle = 5ms;
    one.quality = 5;
    one.reads = {entry(2, ModbusTable::holding_register, 1000, Type::INT)};
    one.writes = {entry(4, ModbusTable::holding_register, 200, Type::INT)};
    poll({one}, device.port());
    tags.expect([&] { return tags.quality; });
    is_lying = true;
    bool has_been_wrong = false;
    tags.expect([&] {
      has_been_wrong |= tags.locked != 1000;
      return !tags.quality;
    });
    is_lying = false;
    tags.expect([&] { return tags.quality && tags.locked == 1000; });
    EXPECT_FALSE(has_been_wrong) << "byte " << place;
    EXPECT_GE(client->counters().failed, 1u) << "byte " << place;
    EXPECT_EQ(client->counters().refused, 0u) << "byte " << place;
    EXPECT_EQ(client->counters().connections, 1 + client->counters().failed) << "byte " << place;
    client.reset();
    tags.quality = false;
    tags.expect([&] { return !tags.quality; });
  }
}

TEST_F(Client, AConnectionThatTheDeviceEndsBetweenTwoCyclesIsMadeAnewInTime) {
  ModbusServerOptions at;
  at.listen = {{"127.0.0.1", 0}};
  at.idle_limit = 50ms;
  server = std::make_unique<ModbusServer>(at, machine.map, machine.image);
  ASSERT_EQ(server->start(), "");
  ModbusDevice device = plain_device();
  device.cycle = 400ms;
  poll({device}, server->port());
  tags.expect([&] { return tags.quality; });
  bool was_good = true;
  tags.expect([&] {
    was_good &= tags.quality;
    return client->counters().connections >= 3;
  });
  EXPECT_TRUE(was_good);
  EXPECT_EQ(client->counters().failed, 0u);
}

TEST_F(Client, PollsOverASerialLine) {
  const SerialCable cable;
  ModbusServerOptions line;
  line.serial = SerialOptions{};
  line.serial->device = cable.left();
  line.serial_unit = 4;
  ModbusServer on_the_line(line, machine.map, machine.image);
  ASSERT_EQ(on_the_line.start(), "");
  ModbusClientOptions options;
  options.serial.device = cable.right();
  options.timeout = 20s;
  options.devices = {plain_device()};
  options.devices[0].unit = 4;
  start(options);
  tags.expect([&] { return tags.quality; });
  EXPECT_EQ(tags.locked, 77);
  client->stop();
}

/// A device on a line that shows in each register its address, and answers the first request late.
void answer_late_once(const PseudoTerminal& line, std::chrono::milliseconds late) {
  for (bool is_first = true;; is_first = false) {
    const std::vector<std::uint8_t> asked = line.receive(8, 1000);
    if (asked.size() < 8) return;
    if (is_first) std::this_thread::sleep_for(late);
    line.send(with_check({asked[0], asked[1], 2, asked[2], asked[3]}));
  }
}

TEST_F(Client, ALateAnswerOnASerialLineIsNotTakenForThatOfAnotherRequest) {
  const PseudoTerminal line;
  std::thread device([&] { answer_late_once(line, 600ms); });
  ModbusClientOptions options;
  options.serial.device = line.name();
  options.timeout = 400ms;
  options.first_retry = 5ms;
  options.devices = {plain_device()};
  options.devices[0].reads = {entry(2, ModbusTable::holding_register, 1000, Type::INT),
                              entry(4, ModbusTable::holding_register, 2000, Type::INT)};
  options.devices[0].writes = {};
  start(options);
  bool is_mixed = false;
  tags.expect([&] {
    is_mixed |= tags.out == 1000 || tags.locked == 2000;
    return tags.quality && tags.out == 2000;
  });
  EXPECT_FALSE(is_mixed);
  EXPECT_EQ(tags.locked, 1000);
  EXPECT_EQ(client->counters().failed, 1u);
  client->stop();
  device.join();
}

}  // namespace
}  // namespace lockstep::modbus_client_test
