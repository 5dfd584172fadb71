#include "scheduler/signal_copies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace lockstep::signal_copies_test {
namespace {

std::vector<Value> read_of(const SignalCopies& copies, std::size_t count) {
  std::vector<std::uint64_t> taken(copies.words());
  copies.take(taken.data());
  std::vector<Value> values(count);
  copies.read(taken.data(), values);
  return values;
}

TEST(SignalCopies, GiveWhatStoodThereWhenTheyWereTaken) {
  LREAL position = 1.5;
  INT count = -7;
  BOOL done = true;
  REAL ratio = 0.1F;
  const std::vector<Signal> signals = {
      {&done, Type::BOOL}, {&count, Type::INT}, {&position, Type::LREAL}, {&ratio, Type::REAL}};
  const SignalCopies copies(signals);
  std::vector<std::uint64_t> taken(copies.words());
  copies.take(taken.data());
  position = 0.0;
  count = 0;
  done = false;
  ratio = 0.0F;
  std::array<Value, 4> values{};
  copies.read(taken.data(), values);
  EXPECT_EQ(values[0].u, 1u);
  EXPECT_EQ(values[1].i, -7);
  EXPECT_EQ(values[2].r, 1.5);
  EXPECT_EQ(values[3].r, static_cast<double>(0.1F));
}

TEST(SignalCopies, TakeAVariableOnceHoweverManyOfItsBitsAreWanted) {
  std::uint32_t word = 0x8000'0005;
  std::vector<Signal> signals;
  for (std::int8_t bit = 0; bit < 32; ++bit) signals.push_back({&word, Type::DWORD, bit});
  signals.push_back({&word, Type::DWORD});
  signals.push_back({&word, Type::DWORD});
  const SignalCopies copies(signals);
  EXPECT_EQ(copies.words(), 1u);
  const std::vector<Value> values = read_of(copies, signals.size());
  for (std::size_t bit = 0; bit < 32; ++bit)
    EXPECT_EQ(values[bit].u, bit == 0 || bit == 2 || bit == 31 ? 1u : 0u) << bit;
  EXPECT_EQ(values[32].u, 0x8000'0005u);
  EXPECT_EQ(values[33].u, 0x8000'0005u);
}

TEST(SignalCopies, OfNothingAreNothing) {
  const SignalCopies copies(std::vector<Signal>{});
  EXPECT_EQ(copies.words(), 0u);
  copies.take(nullptr);
  copies.read(nullptr, {});
}

// Values of every type at addresses of every kind, NaNs with their payload among them.
TEST(SignalCopies, AreToTheBitWhatSignalsLoad) {
  constexpr unsigned kSeed = 20261126;
  std::mt19937_64 random(kSeed);
  constexpr std::array kTypes = {Type::BOOL,  Type::SINT,  Type::INT,   Type::DINT, Type::LINT,  Type::USINT,
                                 Type::UINT,  Type::UDINT, Type::ULINT, Type::BYTE, Type::WORD,  Type::DWORD,
                                 Type::LWORD, Type::REAL,  Type::LREAL, Type::TIME, Type::DB_ANY};
  std::vector<std::byte> memory(1 << 14);
  for (std::byte& byte : memory) byte = static_cast<std::byte>(random());
  for (int round = 0; round < 500; ++round) {
    std::vector<Signal> signals;
    for (std::size_t count = random() % 150; count > 0; --count) {
      Signal signal{&memory[random() % (memory.size() - 8)], kTypes[random() % kTypes.size()]};
      if (signal.type == Type::BOOL) *static_cast<bool*>(signal.address) = random() % 2 == 0;
      const bool has_bits = signal.type != Type::BOOL && signal.type < Type::REAL;
      if (has_bits && random() % 4 == 0)
        signal.bit = static_cast<std::int8_t>(random() % (8u * static_cast<unsigned>(size_of(signal.type))));
      signals.push_back(signal);
    }
    // What one has written may be a part of another: BOOLs are made what they are once more, at the end.
    for (const Signal& signal : signals)
      if (signal.type == Type::BOOL) *static_cast<bool*>(signal.address) = random() % 2 == 0;
    const std::vector<Value> values = read_of(SignalCopies(signals), signals.size());
    for (std::size_t i = 0; i < signals.size(); ++i)
      ASSERT_EQ(values[i].u, signals[i].load().u) << kSeed << ", round " << round << ", signal " << i;
  }
}

}  // namespace
}  // namespace lockstep::signal_copies_test
