#include "tech_objects/types/types.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace lockstep::types_test {
namespace {

TEST(Types, TagTypesAreFoundByTheirPublishedNameOnly) {
  EXPECT_EQ(tag_type("LREAL"), Type::LREAL);
  EXPECT_EQ(tag_type("lreal"), std::nullopt);
  EXPECT_EQ(tag_type("AXIS"), std::nullopt);
  EXPECT_EQ(type_name(Type::LWORD), "LWORD");
}

TEST(Types, RangesOfIntegersAreThoseOfTheirWidth) {
  EXPECT_EQ(lowest(Type::SINT), -128);
  EXPECT_EQ(highest(Type::SINT), 127u);
  EXPECT_EQ(lowest(Type::LINT), INT64_MIN);
  EXPECT_EQ(highest(Type::LINT), static_cast<std::uint64_t>(INT64_MAX));
  EXPECT_EQ(highest(Type::ULINT), UINT64_MAX);
  EXPECT_EQ(highest(Type::BOOL), 1u);
  EXPECT_EQ(lowest(Type::WORD), 0);
}

TEST(Types, ASignalKeepsTheSignOfItsValue) {
  INT number = -5;
  const Signal signal{&number, Type::INT, -1};
  EXPECT_EQ(signal.load().i, -5);
  Value value{};
  value.i = -123;
  signal.store(value);
  EXPECT_EQ(number, -123);
}

TEST(Types, StoringABitLeavesItsNeighboursAlone) {
  UDINT word = 0xF0F0;
  Value one{};
  one.u = 1;
  const Signal bit{&word, Type::UDINT, 3};
  EXPECT_EQ(bit.load().u, 0u);
  bit.store(one);
  EXPECT_EQ(word, 0xF0F8u);
  EXPECT_EQ(bit.value_type(), Type::BOOL);
}

// 300 · 1e-9 would be 0.30000000000000004, beyond a level of 0.3, and not what a CSV trace says.
TEST(Types, ATimeAsADoubleIsTheNearestToItsSeconds) {
  Value time{};
  time.i = 300'000'000;
  EXPECT_EQ(as_double(time, Type::TIME), 0.3);
  for (int i = 1; i < 2000; ++i) {
    time.i = i * std::int64_t{1'000'000};
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%d.%03d", i / 1000, i % 1000);
    ASSERT_EQ(as_double(time, Type::TIME), std::strtod(seconds, nullptr)) << i;
  }
}

}  // namespace
}  // namespace lockstep::types_test
