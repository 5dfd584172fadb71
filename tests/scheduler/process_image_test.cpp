#include "scheduler/process_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/property.hpp"
#include "tests/support/values.hpp"

namespace lockstep::process_image_test {
namespace {

using test::integer;
using test::real;

void post(ProcessImage& image, const std::vector<SignalWrite>& batch) {
  image.post(batch);
}

struct Tags {
  DINT count = 5;
  LREAL speed = 1.5;
  REAL rounded = 0.0F;
  WORD word{0x0F0F};
  std::vector<Signal> signals() {
    return {{&count, Type::DINT, -1}, {&speed, Type::LREAL, -1}, {&rounded, Type::REAL, -1},
            {&word, Type::WORD, -1},  {&word, Type::WORD, 4},    {&word, Type::WORD, 0}};
  }
};

enum : std::uint32_t { kCount, kSpeed, kRounded, kWord, kBit4, kBit0 };

TEST(ProcessImage, ShowsTheInitialValuesBeforeTheFirstTick) {
  Tags tags;
  ProcessImage image(tags.signals());
  EXPECT_EQ(image.tick(), -1);
  EXPECT_EQ(image.value(kCount).i, 5);
  EXPECT_EQ(image.value(kSpeed).r, 1.5);
  EXPECT_EQ(image.value(kBit4).u, 0u);
  EXPECT_EQ(image.value(kBit0).u, 1u);
  EXPECT_EQ(image.type(kBit0), Type::BOOL);
}

TEST(ProcessImage, ShowsTheValuesOfTheEndOfATickOnceItIsPublishedAndRefreshed) {
  Tags tags;
  ProcessImage image(tags.signals());
  tags.count = -7;
  image.publish(3);
  EXPECT_EQ(image.value(kCount).i, 5);
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kCount).i, -7);
  EXPECT_EQ(image.tick(), 3);
  EXPECT_FALSE(image.refresh());
}

TEST(ProcessImage, WritesEnterAtTheStartOfATickAndTheLastOneWins) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kCount, integer(1)}, {kSpeed, real(2.0)}});
  post(image, {{kCount, integer(2)}});
  EXPECT_EQ(tags.count, 5);
  image.take_writes();
  EXPECT_EQ(tags.count, 2);
  EXPECT_EQ(tags.speed, 2.0);
}

TEST(ProcessImage, AReadAfterAWriteShowsItBeforeAnyTickAsTheTagWillHoldIt) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kRounded, real(0.1)}});
  EXPECT_EQ(image.value(kRounded).r, static_cast<double>(0.1F));
}

TEST(ProcessImage, AReadAfterAWriteShowsItWhileTicksThatDoNotKnowItGoByAndNoLonger) {
  Tags tags;
  ProcessImage image(tags.signals());
  image.take_writes();  // the tick has begun already
  post(image, {{kCount, integer(10)}});
  image.publish(0);
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kCount).i, 10);
  image.take_writes();
  tags.count = 11;  // a program has changed it since
  image.publish(1);
  EXPECT_EQ(image.value(kCount).i, 10);
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kCount).i, 11);
}

TEST(ProcessImage, AWordAndItsBitsAreOneVariableForWritesOnTheirWay) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kBit4, integer(1)}});
  EXPECT_EQ(image.value(kWord).u, 0x0F1Fu);
  post(image, {{kWord, integer(0x8000)}});
  EXPECT_EQ(image.value(kBit4).u, 0u);
  post(image, {{kBit0, integer(1)}});
  EXPECT_EQ(image.value(kWord).u, 0x8001u);
  image.publish(0);  // a tick that took none of them
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kWord).u, 0x8001u);
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0x8001});
}

TEST(ProcessImage, AWriteOfTheHighestBitShowsTheSignThatItMakes) {
  INT number = 1;
  ProcessImage image({{&number, Type::INT, -1}, {&number, Type::INT, 15}});
  post(image, {{1, Value{.u = 1}}});
  EXPECT_EQ(image.value(0).i, -32767);
  image.publish(0);  // a tick that does not know it
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(0).i, -32767);
  image.take_writes();
  EXPECT_EQ(number, -32767);
}

TEST(ProcessImage, AWriteOfNoBitsChangesNothingAndTakesNoPlace) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kWord, integer(0xFFFF), 0}});
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0x0F0F});
  post(image, {{kWord, integer(0xFFFF), 0}, {kCount, integer(9)}, {kWord, integer(1), ~0ULL << 16}});
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0x0F0F}) << "and of no bits that it has";
  EXPECT_EQ(tags.count, 9);
}

TEST(ProcessImage, AMaskedWriteLeavesTheOtherBitsAsTheyAreAtItsTick) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kWord, integer(0x00F0), 0x00FF}});
  EXPECT_EQ(image.value(kWord).u, 0x0FF0u);
  tags.word = WORD{0xA00F};
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0xA0F0});
}

TEST(ProcessImage, AWriteEntersOnceAndLeavesTheTagToTheProgramAfterThat) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kBit4, integer(1)}});
  image.take_writes();
  image.publish(0);
  tags.word = WORD{0};
  post(image, {{kBit0, integer(1)}});
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{1}) << "bit 4 was not written again";
  image.publish(1);
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{1});
}

TEST(ProcessImage, AWriteThatWasTakenAndOneThatWaitsBothShowOverATickThatKnowsNeither) {
  Tags tags;
  ProcessImage image(tags.signals());
  post(image, {{kBit4, integer(1)}});
  image.take_writes();  // in a tick that has not ended
  post(image, {{kBit0, integer(0)}});
  EXPECT_EQ(image.value(kWord).u, 0x0F1Eu);
  tags.word = WORD{0x0F0F};  // the program clears bit 4 again, in the same tick
  image.publish(0);
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kWord).u, 0x0F0Eu);
}

/// Up to three writes of the word and its bits, some of them masked.
std::vector<SignalWrite> any_batch(std::mt19937& random) {
  std::vector<SignalWrite> batch;
  for (auto writes = random() % 4; writes > 0; --writes) {
    const auto signal = static_cast<std::uint32_t>(kWord + random() % 3);
    const bool is_word = signal == kWord;
    const auto value = static_cast<std::int64_t>(random() & (is_word ? 0xFFFF : 1));
    batch.push_back({signal, integer(value), is_word && random() % 2 == 0 ? random() & 0xFFFF : ~0ULL});
  }
  return batch;
}

/// The word after these writes, one by one.
WORD written(WORD word, const std::vector<SignalWrite>& batch) {
  auto bits = static_cast<std::uint64_t>(word);
  for (const SignalWrite& write : batch) {
    const int bit = write.signal == kBit4 ? 4 : 0;
    const std::uint64_t mask = write.signal == kWord ? write.mask : 1ULL << bit;
    bits = (bits & ~mask) | ((write.value.u << bit) & mask);
  }
  return WORD{static_cast<std::uint16_t>(bits)};
}

TEST(ProcessImage, MergedWritesGiveAndShowWhatTheyWouldOneByOne) {
  std::mt19937 random(test::seed_of_test(20240604));
  Tags tags;
  ProcessImage image(tags.signals());
  WORD view = tags.word;      // what the bridge has to see
  WORD expected = tags.word;  // what the next tick has to find
  const auto post_any = [&] {
    const std::vector<SignalWrite> batch = any_batch(random);
    post(image, batch);
    view = written(view, batch);
    ASSERT_EQ(WORD{static_cast<std::uint16_t>(image.value(kWord).u)}, view);
    expected = written(expected, batch);
  };
  for (int tick = 0; tick < test::cases(10'000, 1'000'000); ++tick) {
    for (auto posts = random() % 3; posts > 0; --posts) post_any();
    image.take_writes();
    ASSERT_EQ(tags.word, expected) << "tick " << tick;
    if (random() % 2 == 0) tags.word = WORD{static_cast<std::uint16_t>(random())};
    std::vector<SignalWrite> during;
    if (random() % 2 == 0) {
      during = any_batch(random);
      post(image, during);
      view = written(view, during);
      ASSERT_EQ(WORD{static_cast<std::uint16_t>(image.value(kWord).u)}, view);
    }
    image.publish(tick);
    ASSERT_TRUE(image.refresh());
    view = expected = written(tags.word, during);
    ASSERT_EQ(WORD{static_cast<std::uint16_t>(image.value(kWord).u)}, view) << "tick " << tick;
  }
}

TEST(ProcessImage, BetweenThreadsBatchesEnterWholeAndSnapshotsAreOfOneTick) {
  constexpr std::int64_t kTicks = 50'000;
  LINT written[4] = {};
  LINT shown[4] = {};
  std::vector<Signal> signals;
  for (auto& tag : written) signals.push_back({&tag, Type::LINT, -1});
  for (auto& tag : shown) signals.push_back({&tag, Type::LINT, -1});
  ProcessImage image(signals);
  std::atomic<bool> is_over{false};
  std::uint64_t torn_writes = 0;
  std::thread cycle([&] {
    for (std::int64_t tick = 0; tick < kTicks; ++tick) {
      image.take_writes();
      for (const LINT tag : written) torn_writes += tag != written[0] ? 1 : 0;
      for (LINT& tag : shown) tag = tick;
      image.publish(tick);
      if (tick % 64 == 0) std::this_thread::yield();
    }
    is_over = true;
  });
  std::uint64_t torn_reads = 0;
  std::uint64_t missing = 0;
  std::int64_t value = 0;
  do {
    std::vector<SignalWrite> batch;
    for (std::uint32_t i = 0; i < 4; ++i) batch.push_back({i, integer(value + 1)});
    image.refresh();
    image.post(batch);
    ++value;
    image.refresh();
    for (std::size_t i = 0; i < 4; ++i) missing += image.value(i).i != value ? 1 : 0;
    for (std::size_t i = 4; i < 8; ++i)
      torn_reads += image.value(i).i != std::max<LINT>(image.tick(), 0) ? 1 : 0;
  } while (!is_over);
  cycle.join();
  image.take_writes();
  EXPECT_EQ(torn_writes, 0u);
  EXPECT_EQ(torn_reads, 0u);
  EXPECT_EQ(missing, 0u);
  EXPECT_EQ(written[0], value) << "the last write entered";
  EXPECT_GT(value, 0);
}

TEST(ProcessImage, BetweenThreadsEachWriteEntersExactlyOnce) {
  constexpr int kPosts = 5'000;
  WORD word{0};
  LINT other = 0;
  ProcessImage image({{&word, Type::WORD, 0}, {&word, Type::WORD, 1}, {&other, Type::LINT, -1}});
  std::atomic<bool> is_over{false};
  int seen = 0;
  std::thread cycle([&] {
    for (std::int64_t tick = 0; !is_over; ++tick) {
      image.take_writes();
      if ((static_cast<unsigned>(word) & 1u) != 0) ++seen;
      word = WORD{static_cast<std::uint16_t>(static_cast<unsigned>(word) & ~1u)};  // a command is taken back
      image.publish(tick);
      std::this_thread::yield();
    }
  });
  for (int n = 1; n <= kPosts; ++n) {
    post(image, {{0, integer(1)}});
    for (int k = 0; k < n % 5; ++k) post(image, {{1, integer(k % 2)}, {2, integer(n)}});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    do {
      image.refresh();
    } while (image.value(0).u != 0 && std::chrono::steady_clock::now() < deadline);
    EXPECT_EQ(image.value(0).u, 0u);
  }
  is_over = true;
  cycle.join();
  EXPECT_EQ(seen, kPosts);
}

}  // namespace
}  // namespace lockstep::process_image_test
