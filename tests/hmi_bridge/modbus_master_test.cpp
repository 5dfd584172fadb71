// One connection to a foreign device: how long it waits for an answer that comes byte by byte.
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <thread>

#include "hmi_bridge/modbus/master.hpp"
#include "tests/hmi_bridge/foreign_device.hpp"
#include "tests/hmi_bridge/serial_cable.hpp"

namespace lockstep::modbus_master_test {
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
  return with_check(hundred_registers());
}

TEST(ModbusMaster, TheWholeAnswerHasToBeThereInTime) {
  const ListeningSocket place;
  ModbusMaster master(Endpoint{"127.0.0.1", place.port()}, 200ms);
  ASSERT_TRUE(master.connect()) << master.problem();
  const int device = place.accept();
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
}

/// Asks a device in every way, which changes its good answers.
class Liar {
 public:
  using Bytes = ForeignDevice::Bytes;
  explicit Liar(std::function<void(Bytes&)> change)
      : device_([change = std::move(change)](const Bytes& request) {
          Bytes answer = ForeignDevice::good_answer(request);
          change(answer);
          return answer;
        }) {}

  /// @return of the functions 1 to 6, 15, 16, 22, those that were content with their answer
  std::vector<int> content() {
    std::vector<std::uint16_t> words(3, 1);
    const auto one = std::span(words).first(1);
    const auto read = [&words](ModbusTable table) {
      return [&words, table](ModbusMaster& master) { return master.read(5, table, 300, words); };
    };
    const auto write = [](ModbusTable table, std::span<const std::uint16_t> what) {
      return [table, what](ModbusMaster& master) { return master.write(5, table, 300, what); };
    };
    const std::vector<std::pair<int, std::function<bool(ModbusMaster&)>>> functions = {
        {1, read(ModbusTable::coil)},
        {2, read(ModbusTable::discrete_input)},
        {3, read(ModbusTable::holding_register)},
        {4, read(ModbusTable::input_register)},
        {5, write(ModbusTable::coil, one)},
        {6, write(ModbusTable::holding_register, one)},
        {15, write(ModbusTable::coil, words)},
        {16, write(ModbusTable::holding_register, words)},
        {22, [](ModbusMaster& master) { return master.write_bits(5, 300, 0x0F, 5); }}};
    std::vector<int> content;
    for (const auto& [function, ask] : functions) {
      ModbusMaster master(Endpoint{"127.0.0.1", device_.port()}, 20s);
      EXPECT_TRUE(master.connect()) << master.problem();
      if (ask(master)) content.push_back(function);
      EXPECT_FALSE(master.was_refused()) << function;
      EXPECT_EQ(master.is_connected(), master.problem().empty()) << function << ": " << master.problem();
    }
    return content;
  }

 private:
  ForeignDevice device_;
};

TEST(ModbusMaster, TakesTheAnswersThatTheStandardAsksFor) {
  EXPECT_EQ(Liar([](Liar::Bytes&) {}).content(), (std::vector<int>{1, 2, 3, 4, 5, 6, 15, 16, 22}));
}

TEST(ModbusMaster, TakesNoAnswerWithAnotherTransactionProtocolLengthUnitOrFunction) {
  for (const std::size_t place : {0, 1, 2, 3, 4, 5, 6, 7})
    EXPECT_TRUE(Liar([place](Liar::Bytes& answer) { answer[place] ^= 1; }).content().empty())
        << "byte " << place;
}

TEST(ModbusMaster, TakesNoWriteForDoneThatTheDeviceTellsOtherwise) {
  const std::vector<int> reads = {1, 2, 3, 4};
  const auto lies_at = [](std::size_t place) {
    return Liar([place](Liar::Bytes& answer) {
      if (answer[7] > 4 && place < answer.size()) answer[place] ^= 1;
    });
  };
  for (const std::size_t place : {8, 9, 10, 11}) EXPECT_EQ(lies_at(place).content(), reads) << place;
  // A mask has another word.
  const std::vector<int> all_but_mask = {1, 2, 3, 4, 5, 6, 15, 16};
  for (const std::size_t place : {12, 13}) EXPECT_EQ(lies_at(place).content(), all_but_mask) << place;
}

TEST(ModbusMaster, ReadsBitsAndRegistersAtTheirPlaces) {
  const ForeignDevice device(ForeignDevice::good_answer);
  ModbusMaster master(Endpoint{"127.0.0.1", device.port()}, 20s);
  ASSERT_TRUE(master.connect());
  std::vector<std::uint16_t> words(20);
  ASSERT_TRUE(master.read(1, ModbusTable::coil, 40, words)) << master.problem();
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], i % 8 == 0 ? 1 : 0) << i;
  ASSERT_TRUE(master.read(1, ModbusTable::input_register, 0x1234, words)) << master.problem();
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i], 0x1234 + i);
}

TEST(ModbusMaster, AnAnswerOfAnotherUnitOnASerialLineIsNotTaken) {
  const PseudoTerminal line;
  SerialOptions options;
  options.device = line.name();
  ModbusMaster master(options, 20s);
  ASSERT_TRUE(master.connect()) << master.problem();
  const Trickle other(line.control(), on_the_line(), 0ms);
  std::vector<std::uint16_t> words(100);
  EXPECT_FALSE(master.read(2, ModbusTable::holding_register, 0, words));
  EXPECT_EQ(master.problem(), "the answer is of another unit");
}

TEST(ModbusMaster, AWriteOnASerialLineThatTheDeviceTellsOtherwiseIsNotTakenForDone) {
  const PseudoTerminal line;
  SerialOptions options;
  options.device = line.name();
  ModbusMaster master(options, 20s);
  const std::uint16_t words[] = {7};
  for (const std::uint8_t told : {std::uint8_t{7}, std::uint8_t{8}}) {
    ASSERT_TRUE(master.connect()) << master.problem();
    const Trickle device(line.control(), with_check({1, 6, 0, 5, 0, told}), 0ms);
    EXPECT_EQ(master.write(1, ModbusTable::holding_register, 5, words), told == 7) << master.problem();
  }
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
  line.send(with_check(late));
  const Trickle prompt(line.control(), on_the_line(), 0ms);
  std::vector<std::uint16_t> words(100);
  EXPECT_TRUE(master.read(1, ModbusTable::holding_register, 0, words)) << master.problem();
  EXPECT_EQ(words[0], 0x0707);
}

}  // namespace
}  // namespace lockstep::modbus_master_test
