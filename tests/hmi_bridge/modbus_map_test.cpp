#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "tests/support/property.hpp"
#include "tests/support/values.hpp"

namespace lockstep::modbus_map_test {
namespace {

using test::integer;
using test::real;

ModbusEntry as(Type wire, WordOrder order = WordOrder::big) {
  return {0, ModbusTable::holding_register, 0, wire, order, true, kAny};
}

std::optional<Value> decoded(const ModbusEntry& entry, Type signal, std::vector<std::uint16_t> words) {
  return decode(entry, signal, words);
}

std::vector<std::string> problems(std::vector<ModbusEntry> entries, std::vector<Type> signals) {
  const ModbusMap map(std::move(entries), signals);
  std::vector<std::string> texts;
  for (const auto& problem : map.problems())
    texts.push_back(std::to_string(problem.entry) + " " + std::string(problem.key) + ": " + problem.text);
  return texts;
}

TEST(ModbusMap, TablesAreFoundByTheirPublishedNames) {
  for (const auto table : {ModbusTable::coil, ModbusTable::discrete_input, ModbusTable::input_register,
                           ModbusTable::holding_register})
    EXPECT_EQ(modbus_table(modbus_table_name(table)), table);
  EXPECT_EQ(modbus_table("coils"), std::nullopt);
}

TEST(ModbusMap, ATypeTakesAsManyRegistersAsItHasPairsOfBytes) {
  for (const Type type : {Type::BOOL, Type::SINT, Type::USINT, Type::BYTE, Type::INT, Type::UINT, Type::WORD})
    EXPECT_EQ(modbus_registers(type), 1) << type_name(type);
  for (const Type type : {Type::DINT, Type::UDINT, Type::DWORD, Type::REAL, Type::TIME})
    EXPECT_EQ(modbus_registers(type), 2) << type_name(type);
  for (const Type type : {Type::LINT, Type::ULINT, Type::LWORD, Type::LREAL})
    EXPECT_EQ(modbus_registers(type), 4) << type_name(type);
}

TEST(ModbusMap, EveryTypeThatATagMayHaveHasItselfAsItsUsualTypeOnTheWire) {
  for (int i = 0; i <= static_cast<int>(Type::TIME); ++i) {
    const auto type = static_cast<Type>(i);
    ASSERT_FALSE(modbus_types(type).empty()) << type_name(type);
    EXPECT_EQ(modbus_types(type)[0], type);
  }
  EXPECT_EQ(modbus_types(Type::DB_ANY)[0], Type::UDINT);
  EXPECT_TRUE(modbus_types(Type::AXIS).empty());
  EXPECT_TRUE(modbus_types(Type::TAG).empty());
}

TEST(ModbusMap, TheMostSignificantWordComesFirstUnlessTheEntrySaysOtherwise) {
  const ModbusWords big = encode(as(Type::UDINT), Type::UDINT, integer(0x12345678));
  EXPECT_EQ(big, (ModbusWords{0x1234, 0x5678, 0, 0}));
  const ModbusWords little = encode(as(Type::UDINT, WordOrder::little), Type::UDINT, integer(0x12345678));
  EXPECT_EQ(little, (ModbusWords{0x5678, 0x1234, 0, 0}));
  const ModbusWords wide = encode(as(Type::LINT), Type::LINT, integer(0x0123456789ABCDEF));
  EXPECT_EQ(wide, (ModbusWords{0x0123, 0x4567, 0x89AB, 0xCDEF}));
  EXPECT_EQ(decoded(as(Type::LINT, WordOrder::little), Type::LINT, {0xCDEF, 0x89AB, 0x4567, 0x0123})->i,
            0x0123456789ABCDEF);
}

TEST(ModbusMap, RealsGoAsTheirIeeePattern) {
  EXPECT_EQ(encode(as(Type::REAL), Type::REAL, real(1.0)), (ModbusWords{0x3F80, 0, 0, 0}));
  EXPECT_EQ(encode(as(Type::LREAL), Type::LREAL, real(-2.0)), (ModbusWords{0xC000, 0, 0, 0}));
  EXPECT_EQ(encode(as(Type::REAL), Type::LREAL, real(0.1)), (ModbusWords{0x3DCC, 0xCCCD, 0, 0})) << "rounded";
  EXPECT_EQ(encode(as(Type::REAL), Type::LREAL, real(1e300)), (ModbusWords{0x7F80, 0, 0, 0})) << "infinity";
}

TEST(ModbusMap, AnIntegerThatDoesNotFitOnTheWireShowsTheNearestThatDoes) {
  EXPECT_EQ(encode(as(Type::INT), Type::DINT, integer(40000))[0], 0x7FFF);
  EXPECT_EQ(encode(as(Type::INT), Type::DINT, integer(-40000))[0], 0x8000);
  EXPECT_EQ(encode(as(Type::UINT), Type::DINT, integer(-1))[0], 0);
  EXPECT_EQ(encode(as(Type::SINT), Type::ULINT, integer(-1))[0], 127);
  EXPECT_EQ(encode(as(Type::LINT), Type::ULINT, integer(-1)), (ModbusWords{0x7FFF, 0xFFFF, 0xFFFF, 0xFFFF}));
}

TEST(ModbusMap, AnEightBitNumberKeepsItsSignInItsRegister) {
  EXPECT_EQ(encode(as(Type::SINT), Type::SINT, integer(-2))[0], 0xFFFE);
  EXPECT_EQ(decoded(as(Type::SINT), Type::SINT, {0xFFFE})->i, -2);
  EXPECT_FALSE(decoded(as(Type::SINT), Type::SINT, {0x0080})) << "128";
  EXPECT_FALSE(decoded(as(Type::USINT), Type::USINT, {0x0100})) << "256";
}

TEST(ModbusMap, OfABitStringTheLowBitsGoThroughANarrowerType) {
  EXPECT_EQ(encode(as(Type::WORD), Type::DWORD, integer(0xABCD1234))[0], 0x1234);
  EXPECT_EQ(decoded(as(Type::WORD), Type::DWORD, {0xFFFF})->u, 0xFFFFu);
  EXPECT_FALSE(decoded(as(Type::DWORD), Type::WORD, {1, 0})) << "bit 16 has no place";
}

TEST(ModbusMap, ATimeGoesInMillisecondsOrAsLintInNanoseconds) {
  EXPECT_EQ(encode(as(Type::TIME), Type::TIME, integer(1'500'000'000)), (ModbusWords{0, 1500, 0, 0}));
  EXPECT_EQ(encode(as(Type::TIME), Type::TIME, integer(-1'500'000)), (ModbusWords{0xFFFF, 0xFFFE, 0, 0}));
  EXPECT_EQ(encode(as(Type::TIME), Type::TIME, integer(499'999)), ModbusWords{});
  EXPECT_EQ(encode(as(Type::TIME), Type::TIME, integer(INT64_MAX)), (ModbusWords{0x7FFF, 0xFFFF, 0, 0}));
  EXPECT_EQ(encode(as(Type::LINT), Type::TIME, integer(250'000)), (ModbusWords{0, 0, 3, 0xD090}));
  EXPECT_EQ(decoded(as(Type::TIME), Type::TIME, {0xFFFF, 0xFFFF})->i, -1'000'000);
  EXPECT_EQ(decoded(as(Type::LINT), Type::TIME, {0, 0, 3, 0xD090})->i, 250'000);
}

TEST(ModbusMap, AValueThatItsTagCannotHoldIsRefused) {
  EXPECT_FALSE(decoded(as(Type::BOOL), Type::BOOL, {2}));
  EXPECT_TRUE(decoded(as(Type::BOOL), Type::BOOL, {1}));
  EXPECT_FALSE(decoded(as(Type::INT), Type::UINT, {0xFFFF})) << "-1";
  EXPECT_FALSE(decoded(as(Type::DINT), Type::INT, {0, 0x8000})) << "32768";
  EXPECT_FALSE(decoded(as(Type::ULINT), Type::LINT, {0x8000, 0, 0, 0}));
  EXPECT_FALSE(decoded(as(Type::REAL), Type::LREAL, {0x7F80, 0})) << "infinity";
  EXPECT_FALSE(decoded(as(Type::REAL), Type::REAL, {0xFFC0, 0})) << "NaN";
  EXPECT_FALSE(decoded(as(Type::LREAL), Type::LREAL, {0x7FF8, 0, 0, 0})) << "NaN";
  EXPECT_FALSE(decoded(as(Type::LREAL), Type::LREAL, {0xFFF0, 0, 0, 0})) << "-infinity";
  EXPECT_FALSE(decoded(as(Type::LREAL), Type::REAL, {0x7FE0, 0, 0, 0})) << "beyond the range of REAL";
}

TEST(ModbusMap, AnEntryMayAllowASmallerRange) {
  ModbusEntry entry = as(Type::LREAL);
  entry.range = kNotZero;
  EXPECT_FALSE(decoded(entry, Type::LREAL, {0, 0, 0, 0}));
  EXPECT_TRUE(decoded(entry, Type::LREAL, {0x3FF0, 0, 0, 0}));
}

TEST(ModbusMap, WhatIsWrittenInItsOwnTypeIsReadBackTheSame) {
  std::mt19937_64 random(test::seed_of_test(20240601));
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    const auto type = static_cast<Type>(random() % (static_cast<unsigned>(Type::TIME) + 1));
    const ModbusEntry entry = as(type, random() % 2 == 0 ? WordOrder::big : WordOrder::little);
    ModbusWords words{};
    for (int k = 0; k < modbus_registers(type); ++k)
      words[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(random());
    const auto value =
        decode(entry, type, std::span(words).first(static_cast<std::size_t>(modbus_registers(type))));
    if (value) {
      ASSERT_EQ(encode(entry, type, *value), words) << type_name(type);
    }
  }
}

TEST(ModbusMap, FindsTheEntryThatCoversAnAddressInItsTable) {
  const std::vector<Type> signals = {Type::BOOL, Type::LREAL};
  const ModbusMap map({{0, ModbusTable::coil, 65535, Type::BOOL, WordOrder::big, true, kAny},
                       {1, ModbusTable::input_register, 7, Type::LREAL, WordOrder::big, false, kAny}},
                      signals);
  EXPECT_TRUE(map.problems().empty());
  EXPECT_EQ(map.find(ModbusTable::coil, 65535), &map.entries()[0]);
  EXPECT_EQ(map.find(ModbusTable::coil, 65536), nullptr);
  EXPECT_EQ(map.find(ModbusTable::discrete_input, 65535), nullptr);
  EXPECT_EQ(map.find(ModbusTable::input_register, 6), nullptr);
  EXPECT_EQ(map.find(ModbusTable::input_register, 7), &map.entries()[1]);
  EXPECT_EQ(map.find(ModbusTable::input_register, 10), &map.entries()[1]);
  EXPECT_EQ(map.find(ModbusTable::input_register, 11), nullptr);
}

TEST(ModbusMap, TellsEveryLineThatIsWrongAndWhatIsAllowed) {
  const auto texts =
      problems({{0, ModbusTable::holding_register, 0, Type::LREAL, WordOrder::big, true, kAny},
                {1, ModbusTable::holding_register, 3, Type::INT, WordOrder::big, true, kAny},
                {1, ModbusTable::coil, 0, Type::INT, WordOrder::big, true, kAny},
                {0, ModbusTable::input_register, 0, Type::INT, WordOrder::big, true, kAny},
                {0, ModbusTable::input_register, 65534, Type::LREAL, WordOrder::big, false, kAny},
                {9, ModbusTable::coil, 0, Type::BOOL, WordOrder::big, false, kAny},
                {2, ModbusTable::coil, 0, Type::BOOL, WordOrder::big, false, kAny},
                {3, ModbusTable::holding_register, 4294967295u, Type::INT, WordOrder::big, false, kAny}},
               {Type::LREAL, Type::INT, Type::TAG, Type::INT});
  ASSERT_EQ(texts.size(), 8u);
  EXPECT_EQ(texts[0],
            "1 address: address 3 of the table holding_register is taken by entry 0 of the map already");
  EXPECT_EQ(
      texts[1],
      "2 table: a value of type INT does not fit the one bit of the table coil; allowed: input_register, "
      "holding_register");
  EXPECT_EQ(texts[2], "3 type: a value of type LREAL cannot go as INT; allowed: LREAL, REAL");
  EXPECT_EQ(texts[3],
            "3 access: a client cannot write to the table input_register; allowed: coil, holding_register");
  EXPECT_EQ(texts[4], "4 address: 4 addresses from 65534 on go beyond 65535");
  EXPECT_EQ(texts[5], "5 tag: there is no signal with number 9");
  EXPECT_EQ(texts[6].substr(0, 6), "6 tag:");
  EXPECT_EQ(texts[7].substr(0, 10), "7 address:");
}

}  // namespace
}  // namespace lockstep::modbus_map_test
