// Values that do not look in their registers as Modbus would have it: swapped bytes, bits, scales; several
// maps, diagnostics and the identification.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hmi_bridge/modbus/request.hpp"
#include "tests/support/values.hpp"

namespace lockstep::modbus_shapes_test {
namespace {

using test::real;

using Bytes = std::vector<std::uint8_t>;

constexpr auto kHolding = ModbusTable::holding_register;

ModbusEntry entry(std::uint32_t signal, std::uint32_t address, Type type) {
  ModbusEntry result;
  result.signal = signal;
  result.table = kHolding;
  result.address = address;
  result.type = type;
  result.writable = true;
  return result;
}

ModbusEntry bit_entry(std::uint32_t signal, std::uint32_t address, int bit, bool writable = true) {
  ModbusEntry result = entry(signal, address, Type::BOOL);
  result.bit = static_cast<std::int8_t>(bit);
  result.writable = writable;
  return result;
}

ModbusEntry scaled_entry(Type type, double scale, double offset) {
  ModbusEntry result = entry(0, 0, type);
  result.is_scaled = true;
  result.scale = scale;
  result.offset = offset;
  return result;
}

TEST(ByteOrder, LittleSwapsTheBytesOfEveryRegister) {
  Value value{};
  value.u = 0x12345678;
  ModbusEntry swapped = entry(0, 0, Type::UDINT);
  swapped.byte_order = ByteOrder::little;
  EXPECT_EQ(encode(swapped, Type::UDINT, value), (ModbusWords{0x3412, 0x7856, 0, 0}));
  swapped.word_order = WordOrder::little;
  EXPECT_EQ(encode(swapped, Type::UDINT, value), (ModbusWords{0x7856, 0x3412, 0, 0}));
  const std::vector<std::uint16_t> words = {0x7856, 0x3412};
  EXPECT_EQ(decode(swapped, Type::UDINT, words)->u, 0x12345678u);
}

TEST(Scale, MakesAnIntegerOfARealAndBack) {
  const ModbusEntry tenths = scaled_entry(Type::INT, 0.1, 0.0);
  EXPECT_EQ(encode(tenths, Type::LREAL, real(12.34))[0], 123);
  EXPECT_EQ(encode(tenths, Type::LREAL, real(-12.36))[0], 0xFF84);
  const std::vector<std::uint16_t> words = {0xFF84};
  EXPECT_DOUBLE_EQ(decode(tenths, Type::LREAL, words)->r, -12.4);
  const ModbusEntry kelvin = scaled_entry(Type::UINT, 0.5, -273.0);
  EXPECT_EQ(encode(kelvin, Type::REAL, real(0.0))[0], 546);
  EXPECT_EQ(decode(kelvin, Type::REAL, std::vector<std::uint16_t>{546})->r, 0.0);
}

TEST(Scale, ShowsTheNearestIntegerOfTheTypeAndNoneForNoNumber) {
  const ModbusEntry plain = scaled_entry(Type::INT, 1.0, 0.0);
  EXPECT_EQ(encode(plain, Type::LREAL, real(1e9))[0], 0x7FFF);
  EXPECT_EQ(encode(plain, Type::LREAL, real(-1e9))[0], 0x8000);
  EXPECT_EQ(encode(plain, Type::LREAL, real(0.0 / 0.0 * 0.0))[0], 0);
  EXPECT_EQ(encode(scaled_entry(Type::UINT, 1.0, 0.0), Type::LREAL, real(-5.0))[0], 0);
  EXPECT_EQ(encode(scaled_entry(Type::LINT, 1.0, 0.0), Type::LREAL, real(1e300)),
            (ModbusWords{0x7FFF, 0xFFFF, 0xFFFF, 0xFFFF}));
  EXPECT_EQ(encode(scaled_entry(Type::ULINT, 1.0, 0.0), Type::LREAL, real(1e300)),
            (ModbusWords{0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF}));
}

TEST(Scale, RefusesWhatTheTagCannotHold) {
  EXPECT_FALSE(decode(scaled_entry(Type::INT, 1e308, 0.0), Type::LREAL, std::vector<std::uint16_t>{100}));
  EXPECT_FALSE(decode(scaled_entry(Type::INT, 1e38, 0.0), Type::REAL, std::vector<std::uint16_t>{100}));
  ModbusEntry limited = scaled_entry(Type::INT, 0.1, 0.0);
  limited.range = {0.0, 10.0};
  EXPECT_TRUE(decode(limited, Type::LREAL, std::vector<std::uint16_t>{100}));
  EXPECT_FALSE(decode(limited, Type::LREAL, std::vector<std::uint16_t>{101}));
}

TEST(WrongShapes, AreTold) {
  const std::vector<Type> types = {Type::BOOL, Type::INT, Type::LREAL};
  ModbusEntry coil = bit_entry(0, 0, 1);
  coil.table = ModbusTable::coil;
  ModbusEntry scaled = entry(1, 9, Type::INT);
  scaled.is_scaled = true;
  ModbusEntry real_on_the_wire = entry(2, 10, Type::REAL);
  real_on_the_wire.is_scaled = true;
  ModbusEntry same = bit_entry(0, 5, 9);
  same.byte_order = ByteOrder::little;  // bit 1 of the number
  const ModbusMap map({coil, bit_entry(1, 1, 1), bit_entry(0, 5, 1), bit_entry(0, 5, 2), same, scaled,
                       real_on_the_wire, entry(1, 5, Type::INT)},
                      types);
  std::vector<std::string> told;
  for (const ModbusMapProblem& problem : map.problems())
    told.push_back(std::to_string(problem.entry) + " " + std::string(problem.key));
  EXPECT_EQ(told, (std::vector<std::string>{"0 bit", "1 type", "4 bit", "5 scale", "6 type", "7 address"}));
}

/// Three flags in the bits 0, 3 and 8 of register 1, the last one read-only; a number in register 2; a map of
/// its own for unit 5; diagnostics in the registers 10 and 11.
class Shapes : public ::testing::Test {
 protected:
  Bytes ask(Bytes pdu, std::uint8_t unit = 1) {
    Bytes frame = {0, 1, 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1), unit};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    const auto answer = responder.answer(frame);
    EXPECT_EQ(modbus_frame_length(answer), answer.size());
    EXPECT_EQ(answer[6], unit);
    return Bytes(answer.begin() + 7, answer.end());
  }
  void tick() {
    image.take_writes();
    image.publish(++ticks);
  }
  static ModbusEntry counter_entry(std::uint32_t address, ModbusCounter counter) {
    ModbusEntry result = entry(0, address, Type::UINT);
    result.writable = false;
    result.counter = counter;
    return result;
  }

  bool a = false, b = true, c = true;
  std::int16_t number = 7;
  std::vector<Signal> signals = {
      {&a, Type::BOOL, -1}, {&b, Type::BOOL, -1}, {&c, Type::BOOL, -1}, {&number, Type::INT, -1}};
  std::vector<Type> types = {Type::BOOL, Type::BOOL, Type::BOOL, Type::INT};
  ModbusMap map{{bit_entry(0, 1, 0), bit_entry(1, 1, 3), entry(3, 2, Type::INT), bit_entry(2, 3, 8, false),
                 bit_entry(0, 3, 0), counter_entry(10, &ModbusCounters::requests),
                 counter_entry(11, &ModbusCounters::not_allowed)},
                types};
  ModbusMap other{{entry(3, 0, Type::INT)}, types};
  ModbusUnits units{map};
  ProcessImage image{signals};
  ModbusCounters counters;
  std::int64_t ticks = -1;
  ModbusIdentity identity{"Maker", "code", "1.2", "Product", "Project"};
  ModbusUnits with_unit_5() {
    ModbusUnits result(map);
    result.own[5] = &other;
    return result;
  }
  ModbusResponder responder{with_unit_5(), image, identity, &counters};
};

TEST_F(Shapes, BitsShareTheirRegister) {
  EXPECT_TRUE(map.problems().empty());
  EXPECT_EQ(ask({3, 0, 1, 0, 2}), (Bytes{3, 4, 0, 8, 0, 7}));
  EXPECT_EQ(ask({3, 0, 3, 0, 1}), (Bytes{3, 2, 1, 0}));
}

TEST_F(Shapes, AWriteOfARegisterSetsAllItsBits) {
  EXPECT_EQ(ask({6, 0, 1, 0, 1}), (Bytes{6, 0, 1, 0, 1}));
  EXPECT_EQ(ask({3, 0, 1, 0, 1}), (Bytes{3, 2, 0, 1}));
  tick();
  EXPECT_TRUE(a);
  EXPECT_FALSE(b);
  EXPECT_EQ(ask({16, 0, 1, 0, 2, 4, 0, 9, 0, 5}), (Bytes{16, 0, 1, 0, 2}));
  tick();
  EXPECT_TRUE(a && b);
  EXPECT_EQ(number, 5);
}

TEST_F(Shapes, ABitWithoutAnEntryCannotBeSetAndAReadOnlyOneMakesItsRegisterReadOnly) {
  EXPECT_EQ(ask({6, 0, 1, 0, 2}), (Bytes{0x86, 3}));
  EXPECT_EQ(ask({6, 0, 3, 0, 1}), (Bytes{0x86, 2}));
  EXPECT_EQ(ask({16, 0, 1, 0, 2, 4, 0x80, 0, 0, 5}), (Bytes{0x90, 3}));
  tick();
  EXPECT_FALSE(a);
  EXPECT_EQ(number, 7);
}

TEST_F(Shapes, AMaskWriteNeedsOnlyTheBitsThatItNames) {
  EXPECT_EQ(ask({22, 0, 3, 0xFF, 0xFE, 0, 1}), (Bytes{22, 0, 3, 0xFF, 0xFE, 0, 1}));
  EXPECT_EQ(ask({22, 0, 3, 0xFE, 0xFF, 0, 0}), (Bytes{0x96, 2})) << "the read-only bit";
  EXPECT_EQ(ask({22, 0, 1, 0xFF, 0xFD, 0, 2}), (Bytes{0x96, 3})) << "a bit without an entry";
  b = false;
  tick();
  EXPECT_TRUE(a && c);
  EXPECT_FALSE(b);
}

TEST_F(Shapes, AUnitIdMayHaveAMapOfItsOwn) {
  EXPECT_EQ(ask({3, 0, 0, 0, 1}, 5), (Bytes{3, 2, 0, 7}));
  EXPECT_EQ(ask({3, 0, 0, 0, 1}, 6), (Bytes{0x83, 2}));
  EXPECT_EQ(ask({3, 0, 1, 0, 1}, 5), (Bytes{0x83, 2}));
  EXPECT_EQ(ask({6, 0, 0, 0, 9}, 5), (Bytes{6, 0, 0, 0, 9}));
  EXPECT_EQ(ask({3, 0, 2, 0, 1}, 1), (Bytes{3, 2, 0, 9})) << "of the same tag";
}

TEST_F(Shapes, CountersOfTheServerAreRegistersThatCannotBeWritten) {
  counters.requests = 70'000;
  counters.not_allowed = 3;
  EXPECT_EQ(ask({3, 0, 10, 0, 2}), (Bytes{3, 4, 0xFF, 0xFF, 0, 3}));
  EXPECT_EQ(ask({6, 0, 10, 0, 0}), (Bytes{0x86, 2}));
}

Bytes object(std::uint8_t id, const std::string& text) {
  Bytes bytes = {id, static_cast<std::uint8_t>(text.size())};
  bytes.insert(bytes.end(), text.begin(), text.end());
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

TEST_F(Shapes, TheIdentificationIsToldAsAStream) {
  const Bytes basic = object(0, "Maker") + object(1, "code") + object(2, "1.2");
  EXPECT_EQ(ask({43, 14, 1, 0}), (Bytes{43, 14, 1, 0x82, 0, 0, 3} + basic));
  EXPECT_EQ(ask({43, 14, 2, 0}),
            (Bytes{43, 14, 2, 0x82, 0, 0, 5} + basic + object(4, "Product") + object(6, "Project")));
  EXPECT_EQ(ask({43, 14, 1, 2}), (Bytes{43, 14, 1, 0x82, 0, 0, 1} + object(2, "1.2")));
  EXPECT_EQ(ask({43, 14, 1, 99}), (Bytes{43, 14, 1, 0x82, 0, 0, 3} + basic)) << "begins anew";
}

TEST_F(Shapes, TheIdentificationIsToldObjectByObject) {
  EXPECT_EQ(ask({43, 14, 4, 4}), (Bytes{43, 14, 4, 0x82, 0, 0, 1} + object(4, "Product")));
  EXPECT_EQ(ask({43, 14, 4, 3}), (Bytes{0xAB, 2}));
  EXPECT_EQ(ask({43, 14, 5, 0}), (Bytes{0xAB, 3}));
  EXPECT_EQ(ask({43, 14, 0, 0}), (Bytes{0xAB, 3}));
  EXPECT_EQ(ask({43, 13, 1, 0}), (Bytes{0xAB, 1}));
  EXPECT_EQ(ask({43, 14, 1}), (Bytes{0xAB, 3}));
}

TEST(Identification, ThatIsTooLongForOneAnswerGoesOnInTheNext) {
  const ModbusIdentity identity{std::string(200, 'v'), std::string(100, 'c'), "1", "p", "a"};
  std::vector<std::uint8_t> answer(253);
  const Bytes first = {43, 14, 2, 0};
  const ModbusIdentification found = identify(identity, first, answer);
  EXPECT_EQ(found.size, 7u + 130u + 102u + 3u + 3u + 3u);
  const ModbusIdentity longer{std::string(200, 'v'), std::string(128, 'c'), "1", "p", "a"};
  ASSERT_EQ(identify(longer, first, answer).size, 7u + 130u);
  EXPECT_EQ(answer[4], 0xFF) << "more follows";
  EXPECT_EQ(answer[5], 1) << "from here on";
  const Bytes next = {43, 14, 2, 1};
  ASSERT_EQ(identify(longer, next, answer).size, 7u + 130u + 3u + 3u + 3u);
  EXPECT_EQ(answer[4], 0);
}

}  // namespace
}  // namespace lockstep::modbus_shapes_test
