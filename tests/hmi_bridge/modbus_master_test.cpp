// One connection to a foreign device: how long it waits for an answer that comes byte by byte.
#include "hmi_bridge/modbus_master.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "tests/hmi_bridge/serial_cable.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

/// The answer to a request for 100 registers, of unit 1; a check behind it or a header in front is not in it.
std::vector<std::uint8_t> hundred_registers() {
  std::vector<std::uint8_t> answer = {1, 3, 200};
  answer.resize(3 + 200, 7);
  return answer;
}

/// A device that hands the bytes of its answer over one at a time.
class Trickle {
 public:
  /// @param place from which requests come and to which answers go
  Trickle(int place, std::vector<std::uint8_t> answer, std::chrono::milliseconds pause)
      : thread_([this, place, answer = std::move(answer), pause] { run(place, answer, pause); }) {}
  ~Trickle() {
    over_ = true;
    thread_.join();
  }

 private:
  void run(int place, const std::vector<std::uint8_t>& answer, std::chrono::milliseconds pause) {
    pollfd asked{place, POLLIN, 0};
    while (!over_ && ::poll(&asked, 1, 20) == 0) {
    }
    for (const std::uint8_t byte : answer) {
      if (over_ || ::write(place, &byte, 1) != 1) return;
      std::this_thread::sleep_for(pause);
    }
  }
  std::atomic<bool> over_{false};
  std::thread thread_;
};

std::vector<std::uint8_t> on_the_line() {
  std::vector<std::uint8_t> answer = hundred_registers();
  const std::uint16_t crc = modbus_crc(answer);
  answer.push_back(static_cast<std::uint8_t>(crc));
  answer.push_back(static_cast<std::uint8_t>(crc >> 8));
  return answer;
}

TEST(ModbusMaster, TheWholeAnswerHasToBeThereInTime) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&place), size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&place), &size);
  ModbusMaster master(Endpoint{"127.0.0.1", ntohs(place.sin_port)}, 200ms);
  ASSERT_TRUE(master.connect()) << master.problem();
  const int device = ::accept(listener, nullptr, nullptr);
  std::vector<std::uint8_t> answer = {0, 1, 0, 0, 0, 203};
  for (const std::uint8_t byte : hundred_registers()) answer.push_back(byte);
  {
    const Trickle slow(device, answer, 10ms);  // two seconds in all
    std::vector<std::uint16_t> words(100);
    EXPECT_FALSE(master.read(1, ModbusTable::holding_register, 0, words));
    EXPECT_FALSE(master.was_refused());
    EXPECT_FALSE(master.is_connected()) << "what comes late would be taken for another answer";
  }
  ::close(device);
  ::close(listener);
}

TEST(ModbusMaster, TheWholeAnswerHasToBeThereInTimeOnASerialLineToo) {
  const PseudoTerminal line;
  SerialOptions options;
  options.device = line.name();
  options.baud = 115200;
  ModbusMaster master(options, 200ms);
  ASSERT_TRUE(master.connect()) << master.problem();
  const Trickle slow(line.control(), on_the_line(), 10ms);
  std::vector<std::uint16_t> words(100);
  EXPECT_FALSE(master.read(1, ModbusTable::holding_register, 0, words));
}

TEST(ModbusMaster, ASerialLineTakesItsTimeForEachCharacter) {
  const PseudoTerminal line;
  SerialOptions options;
  options.device = line.name();
  options.baud = 1200;  // two seconds for request and answer
  ModbusMaster master(options, 100ms);
  ASSERT_TRUE(master.connect()) << master.problem();
  const Trickle slow(line.control(), on_the_line(), 2ms);
  std::vector<std::uint16_t> words(100);
  EXPECT_TRUE(master.read(1, ModbusTable::holding_register, 0, words)) << master.problem();
  EXPECT_EQ(words[99], 0x0707);
}

TEST(ModbusMaster, AnAnswerThatWasLateOnASerialLineIsNotTakenForTheNextOne) {
  const PseudoTerminal line;
  SerialOptions options;
  options.device = line.name();
  ModbusMaster master(options, 20s);
  ASSERT_TRUE(master.connect()) << master.problem();
  std::vector<std::uint8_t> late = {1, 3, 200};
  late.resize(3 + 200, 9);
  const std::uint16_t crc = modbus_crc(late);
  late.push_back(static_cast<std::uint8_t>(crc));
  late.push_back(static_cast<std::uint8_t>(crc >> 8));
  line.send(late);
  const Trickle prompt(line.control(), on_the_line(), 0ms);
  std::vector<std::uint16_t> words(100);
  EXPECT_TRUE(master.read(1, ModbusTable::holding_register, 0, words)) << master.problem();
  EXPECT_EQ(words[0], 0x0707);
}

}  // namespace
}  // namespace lockstep
