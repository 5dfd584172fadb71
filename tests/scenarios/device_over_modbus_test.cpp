// A field bus and a panel over a real connection: process data and parameters of a running MCO 305, read and
// written by their numbers with a foreign client.
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::device_over_modbus_test {
namespace {

/// Words and double words at their numbers, and the exception that a request got.
class FieldBus {
 public:
  explicit FieldBus(int port) : client_(modbus_new_tcp("127.0.0.1", port), &destroy) {
    modbus_set_response_timeout(client_.get(), 20, 0);
    EXPECT_EQ(modbus_connect(client_.get()), 0) << modbus_strerror(errno);
  }
  void send(int word, std::uint16_t value) {
    EXPECT_EQ(modbus_write_register(client_.get(), word, value), 1) << modbus_strerror(errno);
  }
  std::uint16_t came(int word) {
    std::uint16_t value = 0;
    EXPECT_EQ(modbus_read_input_registers(client_.get(), word, 1, &value), 1) << modbus_strerror(errno);
    return value;
  }
  std::int32_t parameter(int number) {
    std::array<std::uint16_t, 2> words{};
    EXPECT_EQ(modbus_read_registers(client_.get(), 10 * number, 2, words.data()), 2)
        << number << ": " << modbus_strerror(errno);
    return static_cast<std::int32_t>(std::uint32_t{words[0]} << 16 | words[1]);
  }
  /// @returns 0, or the error of libmodbus
  int set_parameter(int number, std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    const std::array<std::uint16_t, 2> words{static_cast<std::uint16_t>(bits >> 16),
                                             static_cast<std::uint16_t>(bits & 0xFFFF)};
    return modbus_write_registers(client_.get(), 10 * number, 2, words.data()) == 2 ? 0 : errno;
  }
  int error_of_reading(int address, int count) {
    std::array<std::uint16_t, 8> words{};
    return modbus_read_registers(client_.get(), address, count, words.data()) == count ? 0 : errno;
  }

 private:
  static void destroy(modbus_t* client) {
    modbus_close(client);
    modbus_free(client);
  }
  std::unique_ptr<modbus_t, void (*)(modbus_t*)> client_;
};

/// The program answers word 1 with one more in word 1, shows 33-17 and 1900 in words 2 and 3, and counts in
/// word 4 how often the panel has changed 33-17.
Json device_project() {
  Json project = empty_project();
  project["technology_objects"]["Teddy"] = Json::parse(R"json({
    "type": "MCO_305", "parameters": { "1900": 20, "SYNCMPULSM": 4000 },
    "programs": [ { "number": 0, "autostart": true, "lines": [
      "ON PARAM 33-17 GOSUB changed", "count = 0",
      "main:", "PCD[1] = PCD[1] + 1", "PCD[2] = (GET SYNCMPULSM)", "PCD[3] = (GET 1900)", "PCD[4] = count",
      "DELAY 2", "GOTO main",
      "SUBMAINPROG", "SUBPROG changed", "count = count + 1", "RETURN", "ENDPROG" ]
} ]
})json");
  project["modbus"]["map"] = Json::parse(R"([ { "object": "Teddy", "content": "pcd", "address": 100 },
                       { "object": "Teddy", "content": "parameters", "address": 0 } ])");
  return project;
}

class DeviceOverModbus : public ::testing::Test {
 protected:
  Directory directory;
  RunningLockstep run{directory.write("project.json", device_project().dump())};
  FieldBus bus{run.port()};
};

TEST_F(DeviceOverModbus, GivesProcessDataToItsProgramAndHasItsAnswer) {
  for (const std::uint16_t value : {std::uint16_t{41}, std::uint16_t{0x7FFF}, std::uint16_t{0xFFFF}}) {
    bus.send(100, value);
    const auto answer = static_cast<std::uint16_t>(value + 1);
    EXPECT_TRUE(wait_until([&] { return bus.came(100) == answer; })) << bus.came(100);
  }
  EXPECT_EQ(bus.error_of_reading(110, 1), EMBXILADD) << "there are ten words";
}

TEST_F(DeviceOverModbus, HasParametersByTheirNumbers) {
  EXPECT_EQ(bus.parameter(3317), 4000);
  EXPECT_EQ(bus.parameter(1900), 20);
  ASSERT_TRUE(wait_until([&] { return bus.came(102) == 20; })) << "its program listens";
  EXPECT_EQ(bus.set_parameter(1900, 1234), 0);
  EXPECT_EQ(bus.set_parameter(3317, 4321), 0);
  EXPECT_TRUE(wait_until([&] { return bus.came(102) == 1234 && bus.came(101) == 4321; }));
  EXPECT_TRUE(wait_until([&] { return bus.came(103) == 1; })) << "ON PARAM sees what the panel changes, once";
  EXPECT_EQ(bus.parameter(3317), 4321);
  EXPECT_EQ(bus.set_parameter(1900, -7), 0);
  EXPECT_TRUE(wait_until([&] { return bus.parameter(1900) == -7; }));
  // 34-01 to 34-10 are the words that come.
  bus.send(102, 0xBEEF);
  EXPECT_TRUE(wait_until([&] { return bus.parameter(3403) == 0xBEEF; }));
}

TEST_F(DeviceOverModbus, RefusesWhatIsNoParameterOrOutsideOfItsRange) {
  EXPECT_EQ(bus.error_of_reading(33'172, 1), EMBXILADD) << "between two parameters";
  EXPECT_EQ(bus.error_of_reading(33'170, 3), EMBXILADD);
  EXPECT_EQ(bus.set_parameter(3450, 5), EMBXILADD) << "a read-out";
  EXPECT_EQ(bus.set_parameter(3315, -1), EMBXILVAL) << "33-15 has 1 to 10000";
  EXPECT_EQ(bus.parameter(3317), 4000);
}

TEST(BottleFillerOverModbus, FillsWhatTheFieldBusOrders) {
  RunningLockstep run(LOCKSTEP_SOURCE_DIR "/projects/29_bottle_filler/project.json");
  FieldBus bus(run.port());
  bus.send(101, 360);
  // Its program sees an edge, and none from before it has begun.
  const auto runs = [&] { return bus.came(101) >= 359 && bus.came(101) <= 361; };
  EXPECT_TRUE(wait_until([&] {
    bus.send(100, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    bus.send(100, 1);
    return wait_until(runs, std::chrono::seconds(3));
  })) << bus.came(101);
  EXPECT_EQ(bus.parameter(3321), 300) << "the window of the bottles";
  bus.send(120, 1);
  EXPECT_TRUE(wait_until([&] { return bus.came(121) >= 3; })) << bus.came(121);
  bus.send(100, 0);
  EXPECT_TRUE(wait_until([&] { return bus.came(101) == 0; })) << bus.came(101);
  EXPECT_EQ(bus.came(123), 0) << "no error";
}

}  // namespace
}  // namespace lockstep::test::device_over_modbus_test
