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

TEST(SignalCopies, TakeInOnePieceWhatLiesBesideEachOther) {
  struct {
    LREAL position = 1.5, velocity = -2.5, actual_position = 3.5, actual_velocity = 4.5;
    LREAL acceleration = 5.5;
    UDINT sensor = 6;
    DINT cycle = -7;
    DINT unwanted = 8;
    INT count = -9;
    BOOL done = true, busy = false;
  } axis;
  const SignalCopies four(
      {{Signal{&axis.actual_velocity, Type::LREAL}, Signal{&axis.position, Type::LREAL},
        Signal{&axis.velocity, Type::LREAL}, Signal{&axis.actual_position, Type::LREAL}}});
  EXPECT_EQ(four.pieces(), 1u);
  // 32 bytes, 16 bytes, and behind what nobody wants 4.
  const std::vector<Signal> signals = {
      {&axis.done, Type::BOOL},          {&axis.cycle, Type::DINT},
      {&axis.sensor, Type::UDINT},       {&axis.position, Type::LREAL},
      {&axis.acceleration, Type::LREAL}, {&axis.velocity, Type::LREAL},
      {&axis.count, Type::INT},          {&axis.actual_position, Type::LREAL},
      {&axis.busy, Type::BOOL},          {&axis.actual_velocity, Type::LREAL}};
  const SignalCopies copies(signals);
  EXPECT_EQ(copies.pieces(), 3u);
  EXPECT_EQ(copies.words(), 7u);
  const std::vector<Value> values = read_of(copies, signals.size());
  for (std::size_t i = 0; i < signals.size(); ++i) EXPECT_EQ(values[i].u, signals[i].load().u) << i;
}

// What does not add up to a piece: 8 and 4 bytes, and 8.
TEST(SignalCopies, KeepAVariableWhole) {
  struct {
    DINT first = -1;
    DINT second = -2;
    DINT third = -3;
    REAL fourth = 0.5F;
    DINT fifth = -5;
  } all;
  const std::vector<Signal> signals = {{&all.first, Type::DINT},
                                       {&all.second, Type::DINT},
                                       {&all.third, Type::DINT},
                                       {&all.fourth, Type::REAL},
                                       {&all.fifth, Type::DINT}};
  const SignalCopies copies(signals);
  EXPECT_EQ(copies.pieces(), 2u);
  const std::vector<Value> values = read_of(copies, signals.size());
  for (std::size_t i = 0; i < signals.size(); ++i) EXPECT_EQ(values[i].u, signals[i].load().u) << i;
}

// Values of every type at addresses of every kind, NaNs with their payload among them; each other time many
// beside each other.
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
    const std::size_t size = round % 2 == 0 ? memory.size() - 8 : 200;
    for (std::size_t count = random() % 150; count > 0; --count) {
      Signal signal{&memory[random() % size], kTypes[random() % kTypes.size()]};
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
