#include "scheduler/process_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace lockstep {
namespace {

Value integer(std::int64_t i) {
  Value value{};
  value.i = i;
  return value;
}

Value real(double r) {
  Value value{};
  value.r = r;
  return value;
}

bool post(ProcessImage& image, const std::vector<SignalWrite>& batch) {
  return image.post(batch);
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
  EXPECT_TRUE(post(image, {{kCount, integer(1)}, {kSpeed, real(2.0)}}));
  EXPECT_TRUE(post(image, {{kCount, integer(2)}}));
  EXPECT_EQ(tags.count, 5);
  image.take_writes();
  EXPECT_EQ(tags.count, 2);
  EXPECT_EQ(tags.speed, 2.0);
}

TEST(ProcessImage, AReadAfterAWriteShowsItBeforeAnyTickAsTheTagWillHoldIt) {
  Tags tags;
  ProcessImage image(tags.signals());
  ASSERT_TRUE(post(image, {{kRounded, real(0.1)}}));
  EXPECT_EQ(image.value(kRounded).r, static_cast<double>(0.1F));
}

TEST(ProcessImage, AReadAfterAWriteShowsItWhileTicksThatDoNotKnowItGoByAndNoLonger) {
  Tags tags;
  ProcessImage image(tags.signals());
  image.take_writes();  // the tick has begun already
  ASSERT_TRUE(post(image, {{kCount, integer(10)}}));
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
  ASSERT_TRUE(post(image, {{kBit4, integer(1)}}));
  EXPECT_EQ(image.value(kWord).u, 0x0F1Fu);
  ASSERT_TRUE(post(image, {{kWord, integer(0x8000)}}));
  EXPECT_EQ(image.value(kBit4).u, 0u);
  ASSERT_TRUE(post(image, {{kBit0, integer(1)}}));
  EXPECT_EQ(image.value(kWord).u, 0x8001u);
  image.publish(0);  // a tick that took none of them
  EXPECT_TRUE(image.refresh());
  EXPECT_EQ(image.value(kWord).u, 0x8001u);
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0x8001});
}

TEST(ProcessImage, AMaskedWriteLeavesTheOtherBitsAsTheyAreAtItsTick) {
  Tags tags;
  ProcessImage image(tags.signals());
  ASSERT_TRUE(post(image, {{kWord, integer(0x00F0), 0x00FF}}));
  EXPECT_EQ(image.value(kWord).u, 0x0FF0u);
  tags.word = WORD{0xA00F};
  image.take_writes();
  EXPECT_EQ(tags.word, WORD{0xA0F0});
}

TEST(ProcessImage, ABatchThatDoesNotFitIsRefusedAsAWholeAndTheOthersStay) {
  Tags tags;
  ProcessImage image(tags.signals(), 3);
  const SignalWrite nine{kCount, integer(9)};
  const SignalWrite one{kCount, integer(1)};
  EXPECT_FALSE(post(image, {nine, nine, nine, nine}));
  EXPECT_TRUE(post(image, {nine, one}));
  EXPECT_FALSE(post(image, {{kSpeed, real(7.0)}, {kCount, integer(2)}}));
  EXPECT_EQ(image.value(kSpeed).r, 1.5);
  EXPECT_TRUE(post(image, {{kCount, integer(3)}}));
  image.take_writes();
  EXPECT_EQ(tags.count, 3);
  EXPECT_EQ(tags.speed, 1.5);
}

TEST(ProcessImage, RoomForWritesComesBackWithTheTickThatShowsThem) {
  Tags tags;
  ProcessImage image(tags.signals(), 2);
  for (int tick = 0; tick < 10; ++tick) {
    EXPECT_TRUE(post(image, {{kCount, integer(-1)}, {kCount, integer(tick)}}));
    EXPECT_FALSE(post(image, {{kCount, integer(-1)}}));
    image.take_writes();
    EXPECT_EQ(tags.count, tick);
    image.publish(tick);
    EXPECT_TRUE(image.refresh());
  }
}

TEST(ProcessImage, BetweenThreadsBatchesEnterWholeAndSnapshotsAreOfOneTick) {
  constexpr std::int64_t kTicks = 50'000;
  LINT written[4] = {};
  LINT shown[4] = {};
  std::vector<Signal> signals;
  for (auto& tag : written) signals.push_back({&tag, Type::LINT, -1});
  for (auto& tag : shown) signals.push_back({&tag, Type::LINT, -1});
  ProcessImage image(signals, 64);
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
    if (image.post(batch)) ++value;
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
  EXPECT_EQ(written[0], value) << "every write that was accepted entered";
  EXPECT_GT(value, 0);
}

}  // namespace
}  // namespace lockstep
