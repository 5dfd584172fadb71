#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "hmi_bridge/modbus/request.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/support/property.hpp"

namespace lockstep::modbus_request_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

class ModbusRequest : public ::testing::Test {
 protected:
  /// The PDU that answers a PDU; checks the header around it.
  Bytes ask(Bytes pdu) {
    const auto length = static_cast<std::uint8_t>(pdu.size() + 1);
    Bytes frame = {0xAB, 0xCD, 0, 0, 0, length, 17};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const auto answer = responder.answer(frame);
    if (answer.size() < 9) {
      ADD_FAILURE() << "no answer";
      return {};
    }
    EXPECT_EQ(modbus_frame_length(answer), answer.size());
    EXPECT_EQ(answer[0], 0xAB);
    EXPECT_EQ(answer[1], 0xCD);
    EXPECT_EQ(answer[6], 17);
    return Bytes(answer.begin() + 7, answer.end());
  }

  ModbusMachine machine;
  ModbusResponder responder{machine.map, machine.image};
};

TEST(ModbusFrame, IsCutByTheLengthInItsHeader) {
  const Bytes bytes = {0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1, 99, 99};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(modbus_frame_length(std::span(bytes).first(i)), 0u);
  EXPECT_EQ(modbus_frame_length(bytes), 12u);
}

TEST(ModbusFrame, OfAnotherProtocolOrAnImpossibleLengthIsNone) {
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 1, 0, 6}), std::nullopt);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 1, 0, 0, 6}), std::nullopt);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 0, 0}), std::nullopt);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 0, 1}), std::nullopt);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 0, 2}), 8u);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 0, 254}), 260u);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 0, 255}), std::nullopt);
  EXPECT_EQ(modbus_frame_length(Bytes{0, 0, 0, 0, 255, 255}), std::nullopt);
}

TEST_F(ModbusRequest, ReadsOfAllFourTablesGiveTheirValues) {
  EXPECT_EQ(ask({1, 0, 0, 0, 3}), (Bytes{1, 1, 0b010}));
  EXPECT_EQ(ask({2, 0, 0, 0, 1}), (Bytes{2, 1, 1}));
  EXPECT_EQ(ask({3, 0, 10, 0, 2}), (Bytes{3, 4, 0x43, 0x48, 0, 0}));
  EXPECT_EQ(ask({3, 0, 30, 0, 3}), (Bytes{3, 6, 0x0F, 0x0F, 0xFF, 0xFD, 0, 77}));
  machine.position = -1.0;
  machine.tick();
  EXPECT_EQ(ask({4, 0, 0, 0, 2}), (Bytes{4, 4, 0xBF, 0x80, 0, 0}));
}

TEST_F(ModbusRequest, APartOfAValueMayBeRead) {
  machine.count = 0x0001000200030004;
  machine.tick();
  EXPECT_EQ(ask({3, 0, 21, 0, 2}), (Bytes{3, 4, 0, 2, 0, 3}));
}

TEST_F(ModbusRequest, ARangeReadsAsItsRegistersOneByOneWhateverTheyAre) {
  for (std::size_t i = 0; i < machine.row.size(); ++i) machine.row[i] = static_cast<INT>(7919 * (i + 1));
  machine.count = 0x0102030405060708;
  machine.tick();
  std::size_t ranges = 0;
  for (std::uint8_t first = 0; first < 255; ++first) {
    Bytes expected = {3, 0};
    for (std::uint8_t count = 1; count <= 125; ++count) {
      const std::uint32_t last = first + count - 1u;
      const Bytes one = ask({3, static_cast<std::uint8_t>(last >> 8), static_cast<std::uint8_t>(last), 0, 1});
      if (one[0] != 3) {
        EXPECT_EQ(ask({3, 0, first, 0, count}), (Bytes{0x83, 2}));
        break;
      }
      expected.insert(expected.end(), one.begin() + 2, one.end());
      expected[1] = static_cast<std::uint8_t>(2 * count);
      ASSERT_EQ(ask({3, 0, first, 0, count}), expected) << int{first} << " " << int{count};
      ++ranges;
    }
  }
  EXPECT_GT(ranges, 3000u);
}

TEST_F(ModbusRequest, AWriteIsReadBackAtOnceAndEntersWithTheNextTick) {
  EXPECT_EQ(ask({5, 0, 0, 0xFF, 0}), (Bytes{5, 0, 0, 0xFF, 0}));
  EXPECT_EQ(ask({6, 0, 31, 0xFF, 0x80}), (Bytes{6, 0, 31, 0xFF, 0x80}));
  EXPECT_EQ(ask({16, 0, 10, 0, 2, 4, 0x3F, 0x80, 0, 0}), (Bytes{16, 0, 10, 0, 2}));
  EXPECT_EQ(ask({15, 0, 2, 0, 1, 1, 1}), (Bytes{15, 0, 2, 0, 1}));
  EXPECT_EQ(ask({1, 0, 0, 0, 1}), (Bytes{1, 1, 1}));
  EXPECT_EQ(ask({3, 0, 31, 0, 1}), (Bytes{3, 2, 0xFF, 0x80}));
  EXPECT_EQ(ask({3, 0, 10, 0, 2}), (Bytes{3, 4, 0x3F, 0x80, 0, 0}));
  EXPECT_EQ(ask({3, 0, 30, 0, 1}), (Bytes{3, 2, 0x0F, 0x1F}));
  EXPECT_FALSE(machine.start);
  machine.tick();
  EXPECT_TRUE(machine.start);
  EXPECT_EQ(machine.small, -128);
  EXPECT_EQ(machine.speed, 1.0);
  EXPECT_EQ(machine.word, WORD{0x0F1F});
}

TEST_F(ModbusRequest, TheLargestQuantitiesAreServedAndOneMoreIsException3) {
  EXPECT_EQ(ask({1, 0x03, 0xE8, 0x07, 0xD0}).size(), 2u + 250u);
  EXPECT_EQ(ask({1, 0x03, 0xE8, 0x07, 0xD1}), (Bytes{0x81, 3}));
  EXPECT_EQ(ask({3, 0, 200, 0, 125}).size(), 2u + 250u);
  EXPECT_EQ(ask({3, 0, 200, 0, 126}), (Bytes{0x83, 3}));
  EXPECT_EQ(ask({4, 0, 100, 0, 0}), (Bytes{0x84, 3}));
  EXPECT_EQ(ask({2, 0, 0, 0, 0}), (Bytes{0x82, 3}));
  Bytes coils = {15, 0x03, 0xE8, 0x07, 0xB0, 246};
  coils.resize(6 + 246, 0xFF);
  EXPECT_EQ(ask(coils), (Bytes{15, 0x03, 0xE8, 0x07, 0xB0}));
  machine.tick();
  EXPECT_TRUE(machine.lamps[0] && machine.lamps[1967]);
  EXPECT_FALSE(machine.lamps[1968]);
  Bytes registers = {16, 0, 200, 0, 123, 246};
  registers.resize(6 + 246, 0x11);
  EXPECT_EQ(ask(registers), (Bytes{16, 0, 200, 0, 123}));
  machine.tick();
  EXPECT_EQ(machine.row[122], 0x1111);
  EXPECT_EQ(machine.row[123], 0);
}

TEST_F(ModbusRequest, AnAddressWithoutAnEntryIsException2) {
  EXPECT_EQ(ask({1, 0, 0, 0, 4}), (Bytes{0x81, 2}));
  EXPECT_EQ(ask({2, 0, 1, 0, 1}), (Bytes{0x82, 2}));
  EXPECT_EQ(ask({3, 0, 11, 0, 2}), (Bytes{0x83, 2}));
  EXPECT_EQ(ask({4, 0xFF, 0xFF, 0, 2}), (Bytes{0x84, 2}));
  EXPECT_EQ(ask({5, 0, 3, 0xFF, 0}), (Bytes{0x85, 2}));
  EXPECT_EQ(ask({6, 0, 9, 0, 0}), (Bytes{0x86, 2}));
  EXPECT_EQ(ask({16, 0, 31, 0, 3, 6, 0, 0, 0, 0, 0, 0}), (Bytes{0x90, 2}))
      << "no entry behind a read-only one";
  EXPECT_EQ(ask({22, 0, 9, 0, 0, 0, 0}), (Bytes{0x96, 2}));
  EXPECT_EQ(ask({23, 0, 9, 0, 1, 0, 31, 0, 1, 2, 0, 0}), (Bytes{0x97, 2}));
  EXPECT_EQ(ask({23, 0, 31, 0, 1, 0, 9, 0, 1, 2, 0, 0}), (Bytes{0x97, 2}));
}

TEST_F(ModbusRequest, AWriteToAReadOnlyEntryIsException2AndChangesNothing) {
  EXPECT_EQ(ask({5, 0, 1, 0, 0}), (Bytes{0x85, 2}));
  EXPECT_EQ(ask({6, 0, 32, 0, 1}), (Bytes{0x86, 2}));
  EXPECT_EQ(ask({16, 0, 31, 0, 2, 4, 0, 1, 0, 1}), (Bytes{0x90, 2}));
  EXPECT_EQ(ask({15, 0, 0, 0, 2, 1, 3}), (Bytes{0x8F, 2}));
  EXPECT_EQ(ask({22, 0, 32, 0, 0, 0, 0}), (Bytes{0x96, 2}));
  machine.tick();
  EXPECT_TRUE(machine.shown);
  EXPECT_FALSE(machine.start);
  EXPECT_EQ(machine.small, -3);
  EXPECT_EQ(machine.locked, 77);
}

TEST_F(ModbusRequest, AWriteOfAPartOfAValueIsException2) {
  EXPECT_EQ(ask({6, 0, 10, 0, 0}), (Bytes{0x86, 2}));
  EXPECT_EQ(ask({6, 0, 11, 0, 0}), (Bytes{0x86, 2}));
  EXPECT_EQ(ask({22, 0, 20, 0, 0, 0, 0}), (Bytes{0x96, 2}));
  EXPECT_EQ(ask({16, 0, 20, 0, 3, 6, 0, 0, 0, 0, 0, 0}), (Bytes{0x90, 2}));
  EXPECT_EQ(ask({16, 0, 21, 0, 4, 8, 0, 0, 0, 0, 0, 0, 0, 0}), (Bytes{0x90, 2}));
  EXPECT_EQ(ask({16, 0, 21, 0, 3, 6, 0, 0, 0, 0, 0, 0}), (Bytes{0x90, 2}));
  EXPECT_EQ(ask({23, 0, 10, 0, 1, 0, 10, 0, 1, 2, 0, 0}), (Bytes{0x97, 2}));
}

TEST_F(ModbusRequest, AValueThatItsTagCannotHoldIsException3AndNothingOfTheRequestEnters) {
  EXPECT_EQ(ask({6, 0, 31, 0, 128}), (Bytes{0x86, 3}));
  EXPECT_EQ(ask({16, 0, 10, 0, 2, 4, 0x7F, 0x80, 0, 0}), (Bytes{0x90, 3})) << "infinity";
  EXPECT_EQ(ask({16, 0, 10, 0, 2, 4, 0xFF, 0xC0, 0, 0}), (Bytes{0x90, 3})) << "NaN";
  EXPECT_EQ(ask({16, 0, 30, 0, 2, 4, 0x12, 0x34, 0x12, 0x34}), (Bytes{0x90, 3})) << "the second of two";
  EXPECT_EQ(ask({22, 0, 31, 0xFF, 0x00, 0, 0}), (Bytes{0x96, 3})) << "16#FF00";
  EXPECT_EQ(ask({23, 0, 30, 0, 1, 0, 30, 0, 2, 4, 0x12, 0x34, 0x12, 0x34}), (Bytes{0x97, 3}));
  EXPECT_EQ(ask({5, 0, 0, 0, 1}), (Bytes{0x85, 3}));
  EXPECT_EQ(ask({5, 0, 0, 0xFF, 0xFF}), (Bytes{0x85, 3}));
  machine.tick();
  EXPECT_EQ(machine.word, WORD{0x0F0F});
  EXPECT_EQ(machine.small, -3);
  EXPECT_EQ(machine.speed, 200.0);
}

TEST_F(ModbusRequest, AnUnknownFunctionIsException1) {
  for (const int function : {0, 7, 8, 11, 12, 17, 20, 21, 24, 100, 127, 128, 131, 255}) {
    const auto code = static_cast<std::uint8_t>(function);
    EXPECT_EQ(ask({code, 0, 0, 0, 1}), (Bytes{static_cast<std::uint8_t>(code | 0x80), 1})) << function;
    EXPECT_EQ(ask({code}), (Bytes{static_cast<std::uint8_t>(code | 0x80), 1})) << function;
  }
}

TEST_F(ModbusRequest, ALengthThatDoesNotFitTheFunctionIsException3) {
  for (const int function : {1, 2, 3, 4, 5, 6, 15, 16, 22, 23}) {
    const auto code = static_cast<std::uint8_t>(function);
    const Bytes refused = {static_cast<std::uint8_t>(code | 0x80), 3};
    for (const std::size_t length : {1u, 2u, 3u, 4u, 6u, 8u, 9u, 253u}) {
      Bytes pdu(length, 0);
      pdu[0] = code;
      EXPECT_EQ(ask(pdu), refused) << function << " with " << length << " bytes";
    }
  }
  EXPECT_EQ(ask({16, 0, 30, 0, 1, 4, 0, 0, 0, 0}), (Bytes{0x90, 3})) << "count and bytes differ";
  EXPECT_EQ(ask({16, 0, 30, 0, 1, 2, 0, 0, 0}), (Bytes{0x90, 3})) << "more bytes than it says";
  EXPECT_EQ(ask({16, 0, 30, 0, 1, 2, 0}), (Bytes{0x90, 3})) << "fewer bytes than it says";
  EXPECT_EQ(ask({15, 0, 0, 0, 1, 2, 0, 0}), (Bytes{0x8F, 3}));
  EXPECT_EQ(ask({23, 0, 30, 0, 1, 0, 30, 0, 1, 4, 0, 0}), (Bytes{0x97, 3}));
}

TEST_F(ModbusRequest, AMaskWriteLeavesTheBitsThatItDoesNotNameToTheProgram) {
  EXPECT_EQ(ask({22, 0, 30, 0xFF, 0x0F, 0x00, 0xA0}), (Bytes{22, 0, 30, 0xFF, 0x0F, 0x00, 0xA0}));
  EXPECT_EQ(ask({3, 0, 30, 0, 1}), (Bytes{3, 2, 0x0F, 0xAF}));
  machine.word = WORD{0x1000};
  machine.tick();
  EXPECT_EQ(machine.word, WORD{0x10A0});
}

TEST_F(ModbusRequest, AMaskWriteThatNamesNoBitIsAnsweredAndChangesNothing) {
  for (const std::uint8_t bits : {std::uint8_t{0x00}, std::uint8_t{0xFF}})
    EXPECT_EQ(ask({22, 0, 30, 0xFF, 0xFF, bits, bits}), (Bytes{22, 0, 30, 0xFF, 0xFF, bits, bits}));
  machine.tick();
  EXPECT_EQ(machine.word, WORD{0x0F0F});
  EXPECT_EQ(ask({3, 0, 30, 0, 1}), (Bytes{3, 2, 0x0F, 0x0F}));
}

TEST_F(ModbusRequest, AWriteWithReadReadsWhatItHasWrittenAsTheTagHoldsIt) {
  const auto tenth = std::bit_cast<std::uint64_t>(0.1);
  const auto rounded = std::bit_cast<std::uint64_t>(static_cast<double>(0.1F));
  Bytes request = {23, 0, 40, 0, 4, 0, 40, 0, 4, 8};
  Bytes expected = {23, 8};
  for (int shift = 56; shift >= 0; shift -= 8) {
    request.push_back(static_cast<std::uint8_t>(tenth >> shift));
    expected.push_back(static_cast<std::uint8_t>(rounded >> shift));
  }
  EXPECT_EQ(ask(request), expected);
  EXPECT_EQ(ask({23, 0, 30, 0, 3, 0, 31, 0, 1, 2, 0, 9}), (Bytes{23, 6, 0x0F, 0x0F, 0, 9, 0, 77}));
  machine.tick();
  EXPECT_EQ(machine.rounded, 0.1F);
  EXPECT_EQ(machine.small, 9);
}

/// What is left of the tags after a request that was answered with an exception.
Bytes memory_of(ModbusMachine& machine) {
  Bytes all;
  machine.tick();
  for (const Signal& signal : machine.signals) {
    const Value value = signal.load();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    all.insert(all.end(), bytes, bytes + sizeof value);
  }
  return all;
}

/// A good request with a few bytes changed, cut or added; now and then nothing but chance.
Bytes any_request(std::mt19937& random) {
  static const std::vector<Bytes> good = {{1, 0, 0, 0, 3},
                                          {1, 3, 0xE8, 7, 0xD0},
                                          {2, 0, 0, 0, 1},
                                          {3, 0, 10, 0, 2},
                                          {3, 0, 200, 0, 125},
                                          {4, 0, 100, 0, 16},
                                          {5, 0, 0, 0xFF, 0},
                                          {6, 0, 31, 0, 5},
                                          {15, 0, 2, 0, 1, 1, 1},
                                          {15, 3, 0xE8, 0, 12, 2, 0xFF, 0x0A},
                                          {16, 0, 20, 0, 4, 8, 1, 2, 3, 4, 5, 6, 7, 8},
                                          {16, 0, 30, 0, 2, 4, 9, 9, 0, 9},
                                          {22, 0, 30, 0xF0, 0x0F, 0x12, 0x34},
                                          {23, 0, 30, 0, 2, 0, 10, 0, 2, 4, 0x40, 0, 0, 0}};
  if (random() % 16 == 0) {
    Bytes pdu(1 + random() % 253);
    for (auto& byte : pdu) byte = static_cast<std::uint8_t>(random());
    return pdu;
  }
  Bytes pdu = good[random() % good.size()];
  for (auto changes = random() % 3; changes > 0; --changes)
    pdu[random() % pdu.size()] = static_cast<std::uint8_t>(random() % 2 == 0 ? random() : random() % 4);
  if (random() % 8 == 0) pdu.resize(1 + random() % (pdu.size() + 3));
  return pdu;
}

TEST_F(ModbusRequest, AnyBytesGetAWellFormedAnswerAndAnExceptionChangesNothing) {
  std::mt19937 random(test::seed_of_test(20240602));
  int served = 0;
  int refused = 0;
  for (int round = 0; round < test::cases(10'000, 1'000'000); ++round) {
    const Bytes pdu = any_request(random);
    const bool is_compared = random() % 10 == 0;
    const Bytes before = is_compared ? memory_of(machine) : Bytes{};
    const Bytes answer = ask(pdu);
    ASSERT_GE(answer.size(), 2u);
    if (answer[0] == pdu[0] && pdu[0] < 0x80) {
      ++served;
    } else {
      ++refused;
      ASSERT_EQ(answer[0], pdu[0] | 0x80);
      ASSERT_EQ(answer.size(), 2u);
      ASSERT_TRUE(answer[1] >= 1 && answer[1] <= 3) << int{answer[1]};
      if (is_compared) {
        ASSERT_EQ(memory_of(machine), before) << "round " << round;
      }
    }
    machine.tick();
  }
  EXPECT_GT(served, 2'000);
  EXPECT_GT(refused, 2'000);
  EXPECT_EQ(machine.locked, 77);
  EXPECT_TRUE(machine.shown);
}

TEST_F(ModbusRequest, WritesThatNoTickWillTakeAreException4AndChangeNothing) {
  const std::vector<Bytes> good = {{5, 0, 0, 0xFF, 0},
                                   {6, 0, 30, 0x12, 0x34},
                                   {15, 0, 0, 0, 1, 1, 1},
                                   {16, 0, 30, 0, 1, 2, 0x12, 0x34},
                                   {22, 0, 30, 0, 0, 0x12, 0x34},
                                   {23, 0, 30, 0, 1, 0, 30, 0, 1, 2, 0x12, 0x34}};
  responder.refuse_writes();
  for (const Bytes& request : good)
    EXPECT_EQ(ask(request), (Bytes{static_cast<std::uint8_t>(request[0] | 0x80), 4}));
  machine.tick();
  EXPECT_FALSE(machine.start);
  EXPECT_EQ(machine.word, WORD{0x0F0F});
  EXPECT_EQ(ask({3, 0, 30, 0, 1}), (Bytes{3, 2, 0x0F, 0x0F})) << "what can be read is read";
  EXPECT_EQ(ask({6, 0, 32, 0, 1}), (Bytes{0x86, 2})) << "what was never permitted is told as ever";
  EXPECT_EQ(ask({5, 0, 0, 0x12, 0}), (Bytes{0x85, 3}));
}

}  // namespace
}  // namespace lockstep::modbus_request_test
