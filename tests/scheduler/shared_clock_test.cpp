// The clock that controllers share: what is to be trusted of it, and ticks that begin at its whole cycles.
#include "scheduler/shared_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "scheduler/controller.hpp"
#include "scheduler/real_time.hpp"
#include "scheduler/shown_count.hpp"

namespace lockstep::shared_clock_test {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kStep = ClockWatch::kBetween;

class SetClock final : public SharedClock {
 public:
  SharedClockReading read() noexcept override { return {offset, locked}; }
  std::int64_t offset = 37 * kSecond;
  bool locked = true;
};

/// Looks for so long, from `now` on, which goes on.
void look(ClockWatch& watch, std::int64_t& now, std::int64_t duration) {
  for (const std::int64_t end = now + duration; now < end; now += kStep) watch.look(now);
}

TEST(SharedClocks, CountAsLongAsTheyGoOnEvenly) {
  SetClock clock;
  ClockWatch watch(clock);
  EXPECT_TRUE(watch.trusted());
  std::int64_t now = 0;
  for (int i = 0; i < 1000; ++i) {  // slowly, as by the noise of reading
    clock.offset += 40'000;
    watch.look(now += kStep);
    ASSERT_TRUE(watch.trusted());
    ASSERT_EQ(watch.offset(), clock.offset);
  }
  EXPECT_EQ(watch.losses(), 0u);
}

TEST(SharedClocks, ThatJumpCountWithTheirNewOffsetOnceTheyHaveSettled) {
  for (const std::int64_t jump : {std::int64_t{100'000}, -kSecond, 3600 * kSecond}) {
    SetClock clock;
    ClockWatch watch(clock);
    std::int64_t now = 0;
    look(watch, now, kSecond);
    const std::int64_t before = clock.offset;
    clock.offset += jump;
    watch.look(now);
    EXPECT_FALSE(watch.trusted());
    EXPECT_EQ(watch.offset(), before) << "until it is known to go on";
    look(watch, now, kSecond);
    EXPECT_FALSE(watch.trusted());
    clock.offset += jump;  // once more: from here it has to go on
    look(watch, now, ClockWatch::kSettled);
    EXPECT_FALSE(watch.trusted());
    look(watch, now, 2 * kStep);
    EXPECT_TRUE(watch.trusted());
    EXPECT_EQ(watch.offset(), before + 2 * jump);
    EXPECT_EQ(watch.losses(), 1u);
  }
}

/// What is lost of several networks is one number of a tag.
TEST(SharedClocks, TellInATagHowOftenTheyWereLost) {
  SetClock first, second;
  ClockWatch one(first), other(second);
  std::uint64_t tag = 99;
  const ShownCount shown{&tag, {&one.loss_count(), &other.loss_count()}};
  shown.show();
  EXPECT_EQ(tag, 0u);
  first.locked = false;
  second.offset += kSecond;
  std::int64_t now = 0;
  look(one, now, kSecond);
  now = 0;
  look(other, now, kSecond);
  shown.show();
  EXPECT_EQ(tag, 2u);
}

TEST(SharedClocks, ThatNobodyDisciplinesDoNotCount) {
  SetClock clock;
  clock.locked = false;
  ClockWatch watch(clock);
  std::int64_t now = 0;
  look(watch, now, 10 * kSecond);
  EXPECT_FALSE(watch.trusted());
  EXPECT_EQ(watch.losses(), 0u) << "it has not been there yet";
  clock.locked = true;
  look(watch, now, ClockWatch::kSettled + 2 * kStep);
  EXPECT_TRUE(watch.trusted());
  clock.locked = false;
  watch.look(now);
  EXPECT_FALSE(watch.trusted());
  EXPECT_EQ(watch.losses(), 1u);
}

TEST(SharedClocks, LooksThatAreCloseToEachOtherAreNone) {
  SetClock clock;
  ClockWatch watch(clock);
  watch.look(0);
  clock.locked = false;
  watch.look(kStep - 1);
  EXPECT_TRUE(watch.trusted());
  watch.look(kStep);
  EXPECT_FALSE(watch.trusted());
}

TEST(SharedClocks, OfThisMachineNeedNobody) {
  const auto clock = make_shared_clock(SharedClockKind::monotonic, 0);
  EXPECT_EQ(clock->read().offset, 0);
  EXPECT_TRUE(clock->read().locked);
}

TEST(SharedClocks, AcrossMachinesAreReadToLessThanAJump) {
  const auto clock = make_shared_clock(SharedClockKind::tai, 0);
  EXPECT_FALSE(clock->read().locked) << "no clock is without any error";
  std::int64_t least = INT64_MAX, most = INT64_MIN;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t offset = clock->read().offset;
    least = std::min(least, offset);
    most = std::max(most, offset);
  }
  EXPECT_LT(most - least, ClockWatch::kJump);
}

/// A clock that goes on when somebody sleeps, from a time that is no whole cycle.
class SteppedClock final : public WaitingClock {
 public:
  std::int64_t now() noexcept override { return time_; }
  void sleep_until(std::int64_t due) noexcept override {
    if (first == 0) first = due;
    time_ = std::max(time_, due);
  }
  std::int64_t first = 0;

 private:
  std::int64_t time_ = 12'345'678'901;
};

TEST(AlignedTicks, BeginAtAWholeCycleOfTheSharedClock) {
  for (const std::int64_t cycle : {1'000'000, 4'000'000, 10'000'000})
    for (const std::int64_t offset : {0L, 37'000'123'456L}) {
      Controller controller;
      controller.clock = {cycle / 2, 2};
      controller.finish();
      SteppedClock clock;
      RealTimeRun run(controller, OverrunPolicy::report, 0, -1, clock);
      run.align(cycle, offset);
      run.start();
      run.wait();
      EXPECT_EQ((clock.first + offset) % cycle, 0);
      EXPECT_GE(clock.first, 12'345'678'901 + cycle / 2);
      EXPECT_LE(clock.first, 12'345'678'901 + cycle / 2 + cycle);
      EXPECT_EQ(run.status().start, clock.first);
      EXPECT_EQ(controller.shared_time_at_start, clock.first);
    }
}

}  // namespace
}  // namespace lockstep::shared_clock_test
