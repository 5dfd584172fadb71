// A server before the last tick: what it has acknowledged is taken, and everything after it is refused.
#include <gtest/gtest.h>
#include <modbus.h>

#include <atomic>
#include <cerrno>
#include <memory>
#include <thread>

#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/serial_cable.hpp"

namespace lockstep::modbus_refusal_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(ModbusRefusal, OfAServerThatIsHammeredLeavesNothingAcknowledgedAndNotTaken) {
  for (int round = 0; round < 20; ++round) {
    ModbusMachine machine;
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    ModbusServer server(options, machine.map, machine.image);
    ASSERT_EQ(server.start(), "");
    std::atomic<std::uint16_t> acknowledged{0};
    int reason = 0;
    std::thread client([&] {
      const std::unique_ptr<modbus_t, void (*)(modbus_t*)> library(modbus_new_tcp("127.0.0.1", server.port()),
                                                                   &modbus_free);
      modbus_set_response_timeout(library.get(), 20, 0);
      ASSERT_EQ(modbus_connect(library.get()), 0);
      while (modbus_write_register(library.get(), 30, static_cast<std::uint16_t>(acknowledged + 1)) == 1)
        ++acknowledged;
      reason = errno;
      modbus_close(library.get());
    });
    while (acknowledged < 10 + round) {
      machine.tick();
      std::this_thread::yield();
    }
    server.refuse_writes();
    machine.tick();
    client.join();
    EXPECT_EQ(machine.word, WORD{acknowledged.load()});
    EXPECT_EQ(reason, EMBXSFAIL) << "exception 4";
  }
}

TEST(ModbusRefusal, OfAServerThatDoesNotRunIsNothing) {
  ModbusMachine machine;
  ModbusServer server({}, machine.map, machine.image);
  server.refuse_writes();
}

TEST(ModbusRefusal, IsToldOnALineTooAndWhatIsForAllIsNotCarriedOut) {
  ModbusMachine machine;
  const PseudoTerminal line;
  ModbusServerOptions options;
  options.listen.clear();
  options.serial = SerialOptions{};
  options.serial->device = line.name();
  options.serial->silence = std::chrono::milliseconds(20);
  options.serial_unit = 17;
  ModbusServer server(options, machine.map, machine.image);
  ASSERT_EQ(server.start(), "");
  line.send(with_check({17, 6, 0, 31, 0, 7}));
  EXPECT_EQ(line.receive(8), with_check({17, 6, 0, 31, 0, 7}));
  server.refuse_writes();
  line.send(with_check({0, 6, 0, 31, 0, 5}));
  EXPECT_EQ(line.receive(1, 100), Bytes{});
  line.send(with_check({17, 6, 0, 31, 0, 5}));
  EXPECT_EQ(line.receive(5), with_check({17, 0x86, 4}));
  machine.tick();
  EXPECT_EQ(machine.small, 7);
}

}  // namespace
}  // namespace lockstep::modbus_refusal_test
