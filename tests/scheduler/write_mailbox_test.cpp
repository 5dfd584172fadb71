#include "scheduler/write_mailbox.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/property.hpp"
#include "tests/support/values.hpp"

namespace lockstep {
namespace {

using test::integer;
using test::real;

std::vector<VariableWrite> room(std::size_t variables) {
  std::vector<VariableWrite> writes;
  writes.reserve(variables);
  return writes;
}

void expect_same(const std::vector<VariableWrite>& got, const std::vector<VariableWrite>& put) {
  ASSERT_EQ(got.size(), put.size());
  for (std::size_t i = 0; i < put.size(); ++i) {
    EXPECT_EQ(got[i].variable, put[i].variable) << i;
    EXPECT_EQ(got[i].value.u, put[i].value.u) << i;
    EXPECT_EQ(got[i].mask, put[i].mask) << i;
  }
}

TEST(WriteMailbox, CarriesEveryValueBitForBitWhateverItsForm) {
  std::vector<VariableWrite> put;
  const auto add = [&put](Value value, std::uint64_t mask = ~0ULL) {
    put.push_back({static_cast<std::uint32_t>(put.size()), value, mask});
  };
  for (const std::int64_t number :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{32767}, std::int64_t{-32768},
        std::int64_t{0xFFFFFFFF}, std::int64_t{0x100000000}, std::int64_t{-0x80000000LL},
        std::int64_t{-0x80000001LL}, std::numeric_limits<std::int64_t>::min()})
    add(integer(number));
  for (const double number : {0.0, -0.0, 1.5, 0.1, static_cast<double>(0.1F), 1e-40, 1e39, -3e38, 1e300,
                              std::numeric_limits<double>::infinity(), std::nan("")})
    add(real(number));
  add(integer(5), 0x00FF);
  add(integer(-5), 0);
  WriteMailbox mailbox(put.size());
  EXPECT_FALSE(mailbox.take_back());
  for (std::size_t i = 0; i < put.size(); ++i) mailbox.put(i, put[i]);
  mailbox.hand_on(put.size(), 7);
  auto got = room(put.size());
  EXPECT_EQ(mailbox.take(got), 7u);
  expect_same(got, put);
  EXPECT_EQ(mailbox.take(got), 0u) << "once";
}

TEST(WriteMailbox, GivesAnyBitsAsTheyWere) {
  std::mt19937_64 random(test::seed_of_test(20240604));
  for (int round = 0; round < test::cases(2'000, 1'000'000); ++round) {
    const std::size_t count = random() % 20;
    std::vector<VariableWrite> put;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t length = random() % 64;
      const auto bits = static_cast<std::int64_t>(random()) >> length;
      const auto variable = static_cast<std::uint32_t>(random() % 20);
      const std::uint64_t mask = random();
      put.push_back({variable, integer(bits), mask % 4 == 0 ? mask : ~0ULL});
    }
    WriteMailbox mailbox(20);
    mailbox.take_back();
    for (std::size_t i = 0; i < count; ++i) mailbox.put(i, put[i]);
    mailbox.hand_on(count, 1);
    auto got = room(20);
    ASSERT_EQ(mailbox.take(got), 1u);
    expect_same(got, put);
  }
}

TEST(WriteMailbox, GivesBackWhatHasNotBeenTakenAndNothingWhileItIsAddedTo) {
  WriteMailbox mailbox(4);
  auto got = room(4);
  EXPECT_EQ(mailbox.take(got), 0u);
  EXPECT_FALSE(mailbox.take_back());
  mailbox.put(0, {2, integer(9)});
  EXPECT_EQ(mailbox.take(got), 0u);
  mailbox.hand_on(1, 1);
  EXPECT_TRUE(mailbox.take_back());
  EXPECT_EQ(mailbox.take(got), 0u) << "it is just being added to";
  mailbox.put(1, {3, integer(8)});
  mailbox.hand_on(2, 2);
  EXPECT_EQ(mailbox.take(got), 2u);
  expect_same(got, {{2, integer(9)}, {3, integer(8)}});
  EXPECT_FALSE(mailbox.take_back()) << "all of it was taken";
}

}  // namespace
}  // namespace lockstep
