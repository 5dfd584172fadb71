#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "hmi_bridge/modbus/master.hpp"
#include "hmi_bridge/modbus/serial.hpp"
#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/serial_cable.hpp"
#include "tests/support/property.hpp"

namespace lockstep::modbus_serial_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using namespace std::chrono_literals;

Bytes checked(Bytes frame) {
  const std::uint16_t crc = modbus_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

TEST(SerialFrame, HasThePublishedCheck) {
  EXPECT_EQ(checked({0x01, 0x03, 0x00, 0x00, 0x00, 0x0A}),
            (Bytes{0x01, 0x03, 0x00, 0x00, 0x00, 0x0A, 0xC5, 0xCD}));
  EXPECT_EQ(modbus_crc(Bytes{0x02, 0x07}), 0x1241) << "the standard's own example, low byte 41 first";
}

TEST(SerialFrame, EndsAfterTheSilenceOfTheStandard) {
  SerialOptions options;
  options.baud = 9600;
  EXPECT_EQ(frame_silence(options), 4010us) << "3.5 characters of 11 bits";
  options.parity = Parity::none;
  options.stop_bits = 1;
  EXPECT_EQ(frame_silence(options), 3645us);
  options.baud = 115200;
  EXPECT_EQ(frame_silence(options), 1750us);
  options.silence = 20ms;
  EXPECT_EQ(frame_silence(options), 20ms);
}

ModbusServerOptions on(const std::string& device) {
  ModbusServerOptions options;
  options.listen.clear();
  options.serial = SerialOptions{};
  options.serial->device = device;
  options.serial->silence = 20ms;  // a test's machine may hand bytes over late
  options.serial_unit = 17;
  return options;
}

/// Answers as unit 17 on a line, and with another map as unit 18.
class OnALine : public ::testing::Test {
 protected:
  void SetUp() override {
    ModbusUnits units(machine.map);
    units.own[18] = &other;
    server =
        std::make_unique<ModbusServer>(std::vector<ModbusService>{{on(line.name()), units}}, machine.image);
    ASSERT_EQ(server->start(), "");
  }
  void expect_silence() { EXPECT_EQ(line.receive(1, 100), Bytes{}); }
  void expect_answer(const Bytes& frame) { EXPECT_EQ(line.receive(frame.size()), frame); }
  /// Until the server has seen so many, as it may be late on a busy machine: then two frames would be one.
  void await(ModbusCounter count, std::uint64_t number) {
    for (int i = 0; i < 2000 && server->counters().*count < number; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(server->counters().*count, number);
  }
  /// After frames of which nothing tells when the server has seen them.
  void expect_answer_in_the_end() {
    Bytes got;
    for (int i = 0; i < 20 && got.empty(); ++i) {
      line.send(request);
      got = line.receive(answer.size(), 1000);
    }
    EXPECT_EQ(got, answer);
  }

  const Bytes request = checked({17, 3, 0, 32, 0, 1});
  const Bytes answer = checked({17, 3, 2, 0, 77});

  ModbusMachine machine;
  ModbusMap other{{}, {}};
  PseudoTerminal line;
  std::unique_ptr<ModbusServer> server;
};

TEST_F(OnALine, ARequestToItIsAnswered) {
  for (int i = 0; i < 3; ++i) {
    line.send(request);
    expect_answer(answer);
  }
  line.send(checked({17, 3, 0, 9, 0, 1}));
  expect_answer(checked({17, 0x83, 2}));
  line.send(checked({18, 3, 0, 32, 0, 1}));
  expect_answer(checked({18, 0x83, 2}));
  EXPECT_EQ(server->counters().requests, 5u);
  EXPECT_EQ(server->counters().exceptions, 2u);
}

TEST_F(OnALine, ARequestToAnotherGetsNoAnswerAndNeitherDoesItsAnswer) {
  line.send(checked({16, 3, 0, 32, 0, 1}));
  expect_silence();
  line.send(checked({16, 3, 2, 0, 77}));
  expect_silence();
  EXPECT_EQ(server->counters().requests, 0u);
  EXPECT_EQ(server->counters().bad_frames, 0u);
  expect_answer_in_the_end();
}

TEST_F(OnALine, AFrameThatIsDamagedTooShortOrTooLongGetsNoAnswerAndIsCounted) {
  Bytes damaged = request;
  damaged[3] ^= 1;
  line.send(damaged);
  await(&ModbusCounters::bad_frames, 1);
  line.send({17, 3, 0});
  await(&ModbusCounters::bad_frames, 2);
  line.send(checked(Bytes(300, 17)));
  await(&ModbusCounters::bad_frames, 3);
  expect_silence();
  line.send(request);
  expect_answer(answer);
}

TEST_F(OnALine, AWriteToAllIsCarriedOutAndNotAnswered) {
  line.send(checked({0, 6, 0, 31, 0, 5}));
  expect_silence();
  line.send(checked({17, 3, 0, 31, 0, 1}));
  expect_answer(checked({17, 3, 2, 0, 5}));
  machine.tick();
  EXPECT_EQ(machine.small, 5);
}

TEST_F(OnALine, AnyBytesLeaveItAtItsWork) {
  std::mt19937 random(test::seed_of_test(4711));
  for (int round = 0; round < test::cases(10, 1000); ++round) {
    Bytes noise(1 + static_cast<std::size_t>(round % 10) * 30);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    line.send(noise);
    line.receive(1, 50);
  }
  line.send(request);
  expect_answer(answer);
  EXPECT_EQ(server->counters().faults, 0u);
}

TEST(SerialLine, ThatIsNotThereOrIsNoneIsTold) {
  ModbusMachine machine;
  ModbusServer missing(on("/dev/no_such_line"), machine.map, machine.image);
  EXPECT_EQ(missing.start(), "/dev/no_such_line: No such file or directory");
  ModbusServer none(on("/dev/null"), machine.map, machine.image);
  EXPECT_NE(none.start(), "");
}

TEST(SerialLine, ThatBreaksLeavesTheRestAtItsWork) {
  ModbusMachine machine;
  auto line = std::make_unique<PseudoTerminal>();
  ModbusServerOptions tcp;
  tcp.listen = {{"127.0.0.1", 0}};
  ModbusServer server({{on(line->name()), machine.map}, {tcp, machine.map}}, machine.image);
  ASSERT_EQ(server.start(), "");
  line.reset();
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (server.counters().broken_lines == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::yield();
  EXPECT_EQ(server.counters().broken_lines, 1u);
  ModbusMaster master(Endpoint{"127.0.0.1", server.port()}, 20s);
  ASSERT_TRUE(master.connect());
  std::vector<std::uint16_t> words(1);
  ASSERT_TRUE(master.read(1, ModbusTable::holding_register, 32, words));
  EXPECT_EQ(words[0], 77);
  EXPECT_EQ(server.counters().broken_lines, 1u);
}

TEST(SerialLine, TheLibrarysMasterReadsAndWritesOverTheCable) {
  ModbusMachine machine;
  const SerialCable cable;
  ModbusServer server(on(cable.left()), machine.map, machine.image);
  ASSERT_EQ(server.start(), "");
  SerialOptions other_end;
  other_end.device = cable.right();
  ModbusMaster master(other_end, 20s);
  ASSERT_TRUE(master.connect()) << master.problem();
  std::vector<std::uint16_t> words(2);
  ASSERT_TRUE(master.read(17, ModbusTable::holding_register, 31, words)) << master.problem();
  EXPECT_EQ(words, (std::vector<std::uint16_t>{0xFFFD, 77}));
  const std::vector<std::uint16_t> row(123, 0x1234);
  ASSERT_TRUE(master.write(17, ModbusTable::holding_register, 200, row)) << master.problem();
  machine.tick();
  EXPECT_EQ(machine.row[122], 0x1234);
  EXPECT_FALSE(master.read(17, ModbusTable::holding_register, 9, words));
  EXPECT_TRUE(master.was_refused());
  EXPECT_TRUE(master.is_connected());
}

}  // namespace
}  // namespace lockstep::modbus_serial_test
