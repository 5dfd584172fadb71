#include "scheduler/write_mailbox.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/property.hpp"
#include "tests/support/values.hpp"

namespace lockstep::write_mailbox_test {
namespace {

using test::integer;
using test::real;

constexpr Type kTypes[] = {Type::BOOL,  Type::SINT, Type::INT,   Type::DINT, Type::LINT, Type::USINT,
                           Type::UINT,  Type::BYTE, Type::UDINT, Type::WORD, Type::TIME, Type::ULINT,
                           Type::LWORD, Type::REAL, Type::LREAL, Type::DWORD};

/// Variables of the types given, each between bytes that no write may touch.
class Variables {
 public:
  explicit Variables(const std::vector<Type>& types) : memory_(3 * types.size(), kUntouched) {
    for (std::size_t i = 0; i < types.size(); ++i) {
      signals.push_back({&memory_[3 * i + 1], types[i], -1});
      signals.back().store(Value{});
    }
  }

  std::vector<Value> values() const {
    std::vector<Value> all;
    for (const Signal& signal : signals) all.push_back(signal.load());
    return all;
  }

  bool neighbours_are_untouched() const {
    for (std::size_t i = 0; i < signals.size(); ++i) {
      Variables fresh({signals[i].type});
      fresh.signals[0].store(signals[i].load());
      for (std::size_t k = 0; k < 3; ++k)
        if (memory_[3 * i + k] != fresh.memory_[k]) return false;
    }
    return true;
  }

  std::vector<Signal> signals;

 private:
  static constexpr std::uint64_t kUntouched = 0xA5A5A5A5A5A5A5A5;
  std::vector<std::uint64_t> memory_;
};

/// Puts all and hands it on.
void post(WriteMailbox& mailbox, const std::vector<VariableWrite>& writes, std::uint64_t number) {
  for (std::size_t i = 0; i < writes.size(); ++i) mailbox.put(i, writes[i]);
  mailbox.hand_on(writes.size(), number);
}

TEST(WriteMailbox, AWriteOfNoBitsTouchesNothingOfAnyType) {
  for (const Type type : kTypes) {
    Variables variables({type});
    WriteMailbox mailbox(variables.signals);
    for (const std::uint64_t mask : {0ULL, size_of(type) == 8 ? 0ULL : ~0ULL << 8 * size_of(type)}) {
      mailbox.take_back();
      post(mailbox, {{0, integer(-1), mask}}, 1);
      EXPECT_EQ(mailbox.apply(), 1u);
      EXPECT_EQ(variables.values()[0].u, 0u) << type_name(type);
      EXPECT_TRUE(variables.neighbours_are_untouched()) << type_name(type);
    }
  }
}

TEST(WriteMailbox, CarriesEveryValueBitForBitWhateverItsForm) {
  std::vector<VariableWrite> writes;
  std::vector<Type> types;
  const auto add = [&](Type type, Value value, std::uint64_t mask = ~0ULL) {
    writes.push_back({static_cast<std::uint32_t>(writes.size()), value, mask});
    types.push_back(type);
  };
  for (const std::int64_t number :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{32767}, std::int64_t{-32768},
        std::int64_t{0xFFFFFFFF}, std::int64_t{0x100000000}, std::int64_t{-0x80000000LL},
        std::int64_t{-0x80000001LL}, std::numeric_limits<std::int64_t>::min()})
    add(Type::LINT, integer(number));
  for (const double number : {0.0, -0.0, 1.5, 0.1, static_cast<double>(0.1F), 1e-40, 1e39, -3e38, 1e300,
                              std::numeric_limits<double>::infinity(), std::nan("")})
    add(Type::LREAL, real(number));
  add(Type::INT, integer(-5));
  add(Type::USINT, integer(200));
  add(Type::DINT, integer(-70000));
  add(Type::BOOL, integer(1));
  add(Type::LWORD, integer(-5), 0xFF00);
  add(Type::LWORD, integer(5), 0);
  Variables variables(types);
  WriteMailbox mailbox(variables.signals);
  EXPECT_FALSE(mailbox.take_back());
  post(mailbox, writes, 7);
  EXPECT_EQ(mailbox.apply(), 7u);
  for (std::size_t i = 0; i < writes.size(); ++i)
    EXPECT_EQ(variables.values()[i].u, writes[i].value.u & writes[i].mask) << i;
  EXPECT_TRUE(variables.neighbours_are_untouched());
  EXPECT_EQ(mailbox.apply(), 0u) << "once";
}

TEST(WriteMailbox, RoundsARealAndMayChangeTheSignOfAnInteger) {
  Variables variables({Type::REAL, Type::INT});
  WriteMailbox mailbox(variables.signals);
  mailbox.take_back();
  post(mailbox, {{0, real(0.1)}, {1, integer(0x8000), 0x8000}}, 1);
  EXPECT_EQ(mailbox.apply(), 1u);
  EXPECT_EQ(variables.values()[0].r, static_cast<double>(0.1F));
  EXPECT_EQ(variables.values()[1].i, -32768);
}

/// Any value of any type, whole or some of its bits, comes to what writing it there directly comes to.
TEST(WriteMailbox, WritesAsTheBridgeWouldItself) {
  std::mt19937_64 random(test::seed_of_test(20240604));
  for (int round = 0; round < test::cases(2'000, 1'000'000); ++round) {
    std::vector<Type> types;
    for (std::size_t i = 0; i < 20; ++i) types.push_back(kTypes[random() % std::size(kTypes)]);
    Variables variables(types);
    Variables expected(types);
    WriteMailbox mailbox(variables.signals);
    for (std::uint64_t number = 1; number < 4; ++number) {
      std::vector<VariableWrite> writes;
      for (std::uint32_t variable = 0; variable < 20; ++variable) {
        if (random() % 2 == 0) continue;
        const Signal& there = expected.signals[variable];
        const std::uint64_t bits = random() >> random() % 64;
        const std::uint64_t mask = random();
        Variables any({there.type});
        any.signals[0].store(is_real(there.type) ? real(static_cast<double>(bits)) : Value{.u = bits});
        writes.push_back({variable, any.values()[0], mask % 4 == 0 && !is_real(there.type) ? mask : ~0ULL});
        VariableWrite whole{variable, there.load()};
        whole.add(writes.back().value, writes.back().mask);
        there.store(whole.value);
      }
      mailbox.take_back();
      post(mailbox, writes, number);
      ASSERT_EQ(mailbox.apply(), number);
      for (std::size_t i = 0; i < 20; ++i)
        ASSERT_EQ(variables.values()[i].u, expected.values()[i].u) << static_cast<int>(types[i]);
      ASSERT_TRUE(variables.neighbours_are_untouched());
    }
  }
}

TEST(WriteMailbox, GivesBackWhatHasNotBeenTakenAndNothingWhileItIsAddedTo) {
  Variables variables({Type::INT, Type::INT, Type::INT, Type::INT});
  WriteMailbox mailbox(variables.signals);
  EXPECT_EQ(mailbox.apply(), 0u);
  EXPECT_FALSE(mailbox.take_back());
  mailbox.put(0, {2, integer(9)});
  EXPECT_EQ(mailbox.apply(), 0u);
  mailbox.hand_on(1, 1);
  EXPECT_TRUE(mailbox.take_back());
  EXPECT_EQ(mailbox.apply(), 0u) << "it is just being added to";
  mailbox.put(1, {3, integer(8)});
  mailbox.hand_on(2, 2);
  EXPECT_EQ(variables.values()[2].i, 0);
  EXPECT_EQ(mailbox.apply(), 2u);
  EXPECT_EQ(variables.values()[2].i, 9);
  EXPECT_EQ(variables.values()[3].i, 8);
  EXPECT_FALSE(mailbox.take_back()) << "all of it was taken";
}

}  // namespace
}  // namespace lockstep::write_mailbox_test
