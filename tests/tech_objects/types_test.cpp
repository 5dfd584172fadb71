#include "tech_objects/types.hpp"

#include <gtest/gtest.h>

namespace lockstep {
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

}  // namespace
}  // namespace lockstep
