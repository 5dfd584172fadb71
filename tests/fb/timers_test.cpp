#include "fb/timers.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/support/property.hpp"

namespace lockstep::timers_test {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

// What one call gives, with the elapsed time in milliseconds.
struct Result {
  bool q;
  std::int64_t et;
  bool operator==(const Result&) const = default;
};

std::ostream& operator<<(std::ostream& stream, const Result& result) {
  return stream << (result.q ? "Q" : "not Q") << ", ET " << result.et << " ms";
}

// Calls a timer at a time in milliseconds.
template <class Timer>
Result at(Timer& timer, std::int64_t time, bool in) {
  timer.IN = in;
  timer.call(time * kMillisecond);
  return {timer.Q, static_cast<std::int64_t>(timer.ET) / kMillisecond};
}

template <class Timer>
void set_preset(Timer& timer, std::int64_t milliseconds) {
  timer.PT = TIME{milliseconds * kMillisecond};
}

template <class Timer>
class AnyTimer : public testing::Test {};
using Timers = testing::Types<TON, TOF, TP>;
TYPED_TEST_SUITE(AnyTimer, Timers);

TYPED_TEST(AnyTimer, RestsUntilItsInputIsTrue) {
  TypeParam timer;
  set_preset(timer, 10);
  EXPECT_EQ(at(timer, 1000, false), (Result{false, 0}));
  EXPECT_EQ(at(timer, 2000, false), (Result{false, 0}));
}

TYPED_TEST(AnyTimer, NeverShowsATimeOutsideZeroToThePreset) {
  std::mt19937 random(test::seed_of_test(20210));
  TypeParam timer;
  set_preset(timer, 20);
  std::int64_t now = 0;
  for (int call = 0; call < test::cases(20'000, 2'000'000); ++call) {
    now += std::uniform_int_distribution<std::int64_t>(0, 12)(random);
    const Result result = at(timer, now, std::uniform_int_distribution(0, 3)(random) < 2);
    ASSERT_GE(result.et, 0) << "call " << call;
    ASSERT_LE(result.et, 20) << "call " << call;
  }
}

TEST(TON, RisesWhenItsInputHasBeenTrueForThePreset) {
  TON timer;
  set_preset(timer, 10);
  EXPECT_EQ(at(timer, 100, true), (Result{false, 0}));
  EXPECT_EQ(at(timer, 104, true), (Result{false, 4}));
  EXPECT_EQ(at(timer, 110, true), (Result{true, 10}));
  EXPECT_EQ(at(timer, 500, true), (Result{true, 10})) << "the time stays at the preset";
  EXPECT_EQ(at(timer, 501, false), (Result{false, 0}));
}

TEST(TON, RisesToTheNanosecond) {
  TON timer;
  set_preset(timer, 10);
  at(timer, 100, true);
  timer.call(110 * kMillisecond - 1);
  EXPECT_FALSE(timer.Q);
  EXPECT_EQ(timer.ET, TIME{10 * kMillisecond - 1});
  timer.call(110 * kMillisecond);
  EXPECT_TRUE(timer.Q);
}

TEST(TON, MeetsAnEndThatFallsBetweenTwoCallsInTheLaterOne) {
  TON timer;
  set_preset(timer, 10);
  at(timer, 100, true);
  EXPECT_EQ(at(timer, 108, true), (Result{false, 8}));
  EXPECT_EQ(at(timer, 116, true), (Result{true, 10}));
}

TEST(TON, NeverRisesOnAPulseShorterThanThePreset) {
  TON timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  EXPECT_EQ(at(timer, 9, true), (Result{false, 9}));
  EXPECT_EQ(at(timer, 10, false), (Result{false, 0}));
  EXPECT_EQ(at(timer, 11, true), (Result{false, 0})) << "the next pulse starts at nothing";
  EXPECT_EQ(at(timer, 20, true), (Result{false, 9}));
}

TEST(TON, RisesAtOnceWithAPresetOfZeroOrLess) {
  for (const std::int64_t preset : {0, -5}) {
    TON timer;
    set_preset(timer, preset);
    EXPECT_EQ(at(timer, 7, true), (Result{true, 0})) << preset;
    EXPECT_EQ(at(timer, 8, true), (Result{true, 0})) << preset;
    EXPECT_EQ(at(timer, 9, false), (Result{false, 0})) << preset;
  }
}

TEST(TON, TakesAChangedPresetWithTheNextEdge) {
  TON timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  set_preset(timer, 2);
  EXPECT_EQ(at(timer, 5, true), (Result{false, 5}));
  set_preset(timer, 50);
  EXPECT_EQ(at(timer, 10, true), (Result{true, 10}));
  at(timer, 11, false);
  at(timer, 12, true);
  EXPECT_EQ(at(timer, 61, true), (Result{false, 49}));
  EXPECT_EQ(at(timer, 62, true), (Result{true, 50}));
}

TEST(TON, BearsTheGreatestPreset) {
  TON timer;
  timer.PT = TIME{std::numeric_limits<std::int64_t>::max()};
  EXPECT_EQ(at(timer, 1'000'000, true), (Result{false, 0}));
  EXPECT_EQ(at(timer, 1'000'001, true), (Result{false, 1}));
}

TEST(TOF, FallsWhenItsInputHasBeenFalseForThePreset) {
  TOF timer;
  set_preset(timer, 10);
  EXPECT_EQ(at(timer, 100, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 150, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 200, false), (Result{true, 0}));
  EXPECT_EQ(at(timer, 209, false), (Result{true, 9}));
  EXPECT_EQ(at(timer, 210, false), (Result{false, 10}));
  EXPECT_EQ(at(timer, 900, false), (Result{false, 10})) << "the time stays until the input rises";
  EXPECT_EQ(at(timer, 901, true), (Result{true, 0}));
}

TEST(TOF, StaysTrueWhenItsInputRisesBeforeTheEnd) {
  TOF timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  at(timer, 1, false);
  EXPECT_EQ(at(timer, 10, false), (Result{true, 9}));
  EXPECT_EQ(at(timer, 10, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 12, false), (Result{true, 0})) << "the delay starts anew";
  EXPECT_EQ(at(timer, 21, false), (Result{true, 9}));
  EXPECT_EQ(at(timer, 22, false), (Result{false, 10}));
}

TEST(TOF, FollowsItsInputWithAPresetOfZeroOrLess) {
  for (const std::int64_t preset : {0, -5}) {
    TOF timer;
    set_preset(timer, preset);
    EXPECT_EQ(at(timer, 1, true), (Result{true, 0})) << preset;
    EXPECT_EQ(at(timer, 2, false), (Result{false, 0})) << preset;
    EXPECT_EQ(at(timer, 3, true), (Result{true, 0})) << preset;
  }
}

TEST(TOF, TakesAChangedPresetWithTheNextEdge) {
  TOF timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  at(timer, 1, false);
  set_preset(timer, 2);
  EXPECT_EQ(at(timer, 5, false), (Result{true, 4}));
  EXPECT_EQ(at(timer, 11, false), (Result{false, 10}));
  at(timer, 12, true);
  at(timer, 13, false);
  EXPECT_EQ(at(timer, 15, false), (Result{false, 2}));
}

TEST(TP, MakesAPulseOfThePresetWhateverItsInputDoes) {
  TP timer;
  set_preset(timer, 10);
  EXPECT_EQ(at(timer, 100, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 103, false), (Result{true, 3}));
  EXPECT_EQ(at(timer, 105, true), (Result{true, 5})) << "an edge during the pulse does not start it anew";
  EXPECT_EQ(at(timer, 109, false), (Result{true, 9}));
  EXPECT_EQ(at(timer, 110, false), (Result{false, 0}));
}

TEST(TP, HoldsItsTimeAfterThePulseWhileItsInputIsTrue) {
  TP timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  EXPECT_EQ(at(timer, 13, true), (Result{false, 10}));
  EXPECT_EQ(at(timer, 50, true), (Result{false, 10})) << "a new pulse needs a new edge";
  EXPECT_EQ(at(timer, 51, false), (Result{false, 0}));
  EXPECT_EQ(at(timer, 52, true), (Result{true, 0}));
}

TEST(TP, DoesNotRememberAnEdgeDuringThePulse) {
  TP timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  at(timer, 5, false);
  at(timer, 6, true);
  EXPECT_EQ(at(timer, 10, true), (Result{false, 10}));
  EXPECT_EQ(at(timer, 11, true), (Result{false, 10}));
}

TEST(TP, StartsTheNextPulseInTheCallThatFindsTheLastOneOver) {
  TP timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  at(timer, 5, false);
  EXPECT_EQ(at(timer, 12, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 21, true), (Result{true, 9}));
  EXPECT_EQ(at(timer, 22, true), (Result{false, 10}));
}

TEST(TP, MakesNoPulseWithAPresetOfZeroOrLess) {
  for (const std::int64_t preset : {0, -5}) {
    TP timer;
    set_preset(timer, preset);
    EXPECT_EQ(at(timer, 1, true), (Result{false, 0})) << preset;
    EXPECT_EQ(at(timer, 2, true), (Result{false, 0})) << preset;
    EXPECT_EQ(at(timer, 3, false), (Result{false, 0})) << preset;
  }
}

TEST(TP, TakesAChangedPresetWithTheNextEdge) {
  TP timer;
  set_preset(timer, 10);
  at(timer, 0, true);
  set_preset(timer, 2);
  EXPECT_EQ(at(timer, 9, false), (Result{true, 9}));
  EXPECT_EQ(at(timer, 10, false), (Result{false, 0}));
  EXPECT_EQ(at(timer, 11, true), (Result{true, 0}));
  EXPECT_EQ(at(timer, 13, true), (Result{false, 2}));
}

}  // namespace
}  // namespace lockstep::timers_test
