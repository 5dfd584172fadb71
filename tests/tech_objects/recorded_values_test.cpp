// The path through the leading values of a source, and that path as it is given to following axes.
#include "tech_objects/leading_values/recorded_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tech_objects/leading_values/adapted_value.hpp"
#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep::recorded_values_test {
namespace {

constexpr std::int64_t kCycle = 1'000'000;
constexpr double kJerk = 2000.0;  // [u/s³]
constexpr Modulo kRing{true, 360.0, -20.0};

/// A path whose jerk is +J, -J, -J, +J over parts of 37.3 ms each, on and on, from 250 u/s.
Setpoint path(double t, const Modulo& modulo) {
  constexpr double kPart = 0.0373;
  constexpr double kSigns[] = {1.0, -1.0, -1.0, 1.0};
  double p = 0.0, v = 250.0, a = 0.0;
  for (int i = 0; t > 0.0; ++i) {
    const double d = std::min(t, kPart);
    const double j = kSigns[i % 4] * kJerk;
    p += v * d + a * d * d / 2 + j * d * d * d / 6;
    v += a * d + j * d * d / 2;
    a += j * d;
    t -= d;
  }
  return {normalised({0, p}, modulo), v, a};
}

double distance(const Setpoint& a, const Setpoint& b, const Modulo& modulo = kRing) {
  return std::abs(rounded_difference(a.position, b.position, modulo));
}

RecordedValues record() {
  RecordedValues values;
  values.reserve();
  values.set_source(kRing, kCycle);
  return values;
}

TEST(RecordedValues, AreGivenToTheBitAtTheirTimes) {
  RecordedValues values = record();
  for (int i = 0; i < 3000; ++i) ASSERT_TRUE(values.add(i * kCycle, path(seconds(i * kCycle), kRing)));
  for (int i = 0; i < 3000; ++i) {
    const Setpoint expected = path(seconds(i * kCycle), kRing), given = values.at(i * kCycle);
    ASSERT_EQ(given.position, expected.position);
    ASSERT_EQ(given.velocity, expected.velocity);
    ASSERT_EQ(given.acceleration, expected.acceleration);
  }
}

TEST(RecordedValues, AreInterpolatedWithinTheWrittenErrorOfTheJerk) {
  for (const std::int64_t cycle : {kCycle, 4 * kCycle, 16 * kCycle}) {
    RecordedValues values = record();
    values.set_source(kRing, cycle);
    for (std::int64_t t = 0; t <= 1000 * kCycle; t += cycle) values.add(t, path(seconds(t), kRing));
    const double h = seconds(cycle);
    double largest = 0.0, largest_velocity = 0.0, largest_acceleration = 0.0;
    for (std::int64_t t = 0; t < 950 * kCycle; t += 37'001) {
      const Setpoint expected = path(seconds(t), kRing), given = values.at(t);
      largest = std::max(largest, distance(given, expected));
      largest_velocity = std::max(largest_velocity, std::abs(given.velocity - expected.velocity));
      largest_acceleration =
          std::max(largest_acceleration, std::abs(given.acceleration - expected.acceleration));
    }
    EXPECT_LE(largest, kJerk * h * h * h / 160 + 1e-9) << cycle;
    EXPECT_LE(largest_velocity, kJerk * h * h / 45 + 1e-9) << cycle;
    EXPECT_LE(largest_acceleration, kJerk * h / 4.8 + 1e-6) << cycle;
    EXPECT_GT(largest, kJerk * h * h * h / 1600) << "the formula tells nothing";
  }
}

TEST(RecordedValues, GoesOnBehindTheNewestWithItsAccelerationForFourCycles) {
  RecordedValues values = record();
  values.add(0, {{0, 10.0}, 100.0, 50.0});
  const Setpoint near = values.at(3 * kCycle);
  EXPECT_DOUBLE_EQ(near.position.value, 10.0 + 100.0 * 0.003 + 25.0 * 0.003 * 0.003);
  EXPECT_DOUBLE_EQ(near.velocity, 100.0 + 50.0 * 0.003);
  EXPECT_EQ(near.acceleration, 50.0);
  const Setpoint far = values.at(104 * kCycle);
  EXPECT_DOUBLE_EQ(far.velocity, 100.2);
  EXPECT_EQ(far.acceleration, 0.0);
  EXPECT_NEAR(far.position.value, 10.0 + 0.4 + 25.0 * 0.004 * 0.004 + 100.2 * 0.1, 1e-12);
  for (double t = 0.0; t < 0.5; t += 0.0071) {
    values.clear();
    values.add(0, path(t, kRing));
    for (int later = 1; later <= 4; ++later) {
      const double h = 0.001 * later;
      EXPECT_LE(distance(values.at(later * kCycle), path(t + h, kRing)), kJerk * h * h * h / 6 + 1e-12);
    }
  }
}

/// Behind four cycles the acceleration is given up: as much more as the path may have of it.
TEST(RecordedValues, GoOnForLongWithinTheWrittenErrorOfJerkAndAcceleration) {
  constexpr double kSharpest = kJerk * 0.0373;  // [u/s²] of the path
  const double kept = 0.004;
  for (double t = 0.0; t < 0.5; t += 0.0071) {
    RecordedValues values = record();
    values.add(0, path(t, kRing));
    for (int later = 5; later <= 40; later += 5) {
      const double rest = 0.001 * later - kept;
      const double bound = kJerk * kept * kept * (kept / 6.0 + rest / 2.0) + kSharpest * rest * rest / 2.0;
      EXPECT_LE(distance(values.at(later * kCycle), path(t + 0.001 * later, kRing)), bound + 1e-12) << later;
    }
  }
}

TEST(RecordedValues, ThatComeInAnyOrderOrTwiceMakeTheSamePath) {
  RecordedValues ordered = record(), shuffled = record();
  std::vector<int> order(500);
  for (int i = 0; i < 500; ++i) order[static_cast<std::size_t>(i)] = i;
  std::mt19937 random(7);
  for (int i = 0; i + 5 < 500; i += 5) std::shuffle(order.begin() + i, order.begin() + i + 5, random);
  for (int i = 0; i < 500; ++i) ordered.add(i * kCycle, path(seconds(i * kCycle), kRing));
  for (const int i : order) {
    EXPECT_TRUE(shuffled.add(i * kCycle, path(seconds(i * kCycle), kRing)));
    EXPECT_FALSE(shuffled.add(i * kCycle, {})) << "a second one of the same time counts for nothing";
  }
  for (std::int64_t t = 0; t < 499 * kCycle; t += 77'777) {
    EXPECT_EQ(shuffled.at(t).position, ordered.at(t).position);
    EXPECT_EQ(shuffled.at(t).velocity, ordered.at(t).velocity);
  }
}

TEST(RecordedValues, HoldsTheLongestDelayWhileTheOldestGiveWay) {
  RecordedValues values = record();
  for (int i = 0; i < 10000; ++i) {
    values.add(i * kCycle, {{i, 0.0}, 360000.0, 0.0});
    if (i >= kLongestLeadingDelay) {
      ASSERT_TRUE(values.reaches_back_to((i - kLongestLeadingDelay) * kCycle)) << i;
    }
  }
  EXPECT_EQ(values.at((9999 - kLongestLeadingDelay) * kCycle).position.turns, 9999 - kLongestLeadingDelay);
  EXPECT_FALSE(values.reaches_back_to(0));
  EXPECT_FALSE(values.add(0, {})) << "older than all that is held";
}

TEST(RecordedValues, AreRenamedWithoutMotion) {
  RecordedValues values = record();
  for (int i = 0; i < 100; ++i) values.add(i * kCycle, path(seconds(i * kCycle), kRing));
  const Setpoint before = values.at(50'300'000);
  values.rename(77.0);
  const Setpoint behind = values.at(50'300'000);
  EXPECT_NEAR(rounded_difference(behind.position, before.position, kRing), 77.0, 1e-12);
  EXPECT_NEAR(behind.velocity, before.velocity, 1e-9);
}

// ---- Without steps

/// A receiver that asks each millisecond for the value of `delay` ago.
struct Receiver {
  RecordedValues values = record();
  AdaptedValue adapted;
  std::int64_t delay = 0;

  const Setpoint& step(std::int64_t now) { return adapted.step(values, now, now - delay, kCycle); }
};

TEST(AdaptedValue, IsTheRecordedPathToTheBitWhereItIsInterpolated) {
  Receiver receiver;
  receiver.delay = 3'300'000;
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t now = i * kCycle;
    if (i >= 2) receiver.values.add((i - 2) * kCycle, path(seconds((i - 2) * kCycle), kRing));
    if (i < 4) continue;
    const Setpoint given = receiver.step(now);
    ASSERT_FALSE(receiver.adapted.returning());
    ASSERT_EQ(given.position, receiver.values.at(now - 3'300'000).position) << i;
  }
}

/// 1 % to 30 % of the telegrams are lost, all of them are late by up to 6 cycles, some come twice. Steps are
/// looked for in position, velocity and acceleration, and how far off the path the value comes.
TEST(AdaptedValue, NeverStepsWhateverIsLostLateOrDoubled) {
  for (const std::int64_t delay : {std::int64_t{0}, 2 * kCycle, 5 * kCycle, 12 * kCycle}) {
    for (const double loss : {0.01, 0.1, 0.3}) {
      SCOPED_TRACE(testing::Message() << "delay " << delay << ", loss " << loss << ", seed 11");
      std::mt19937 random(11);
      std::uniform_real_distribution<double> dice(0.0, 1.0);
      Receiver receiver;
      receiver.delay = delay;
      std::vector<std::pair<std::int64_t, std::int64_t>> under_way;  // arrival, time
      Setpoint last;
      double furthest = 0.0;
      for (int i = 0; i < 20000; ++i) {
        const std::int64_t now = i * kCycle;
        if (dice(random) >= loss)
          under_way.emplace_back(now + static_cast<int>(6 * dice(random)) * kCycle, now);
        if (dice(random) < 0.05) under_way.emplace_back(now + 5 * kCycle, now);
        for (const auto& [arrival, time] : under_way)
          if (arrival == now) receiver.values.add(time, path(seconds(time), kRing));
        std::erase_if(under_way, [&](const auto& one) { return one.first <= now; });
        if (!receiver.values.reaches_back_to(now - delay)) continue;
        const bool begun = receiver.adapted.begun();
        const Setpoint given = receiver.step(now);
        if (begun) {
          const double moved = rounded_difference(given.position, last.position, kRing);
          ASSERT_NEAR(moved, 0.0005 * (given.velocity + last.velocity), 1e-4) << i;
          ASSERT_NEAR(given.velocity, last.velocity, 0.4) << i;  // 400 u/s²: five times that of the path
          // What was extrapolated with the acceleration of the path, 75 u/s² at most, goes on without it.
          ASSERT_NEAR(given.acceleration, last.acceleration, 150.0) << i;
        }
        last = given;
        furthest = std::max(furthest, distance(given, path(seconds(now - delay), kRing)));
      }
      EXPECT_LE(furthest, delay == 12 * kCycle && loss == 0.01 ? 1e-5 : 0.5);
    }
  }
}

/// A path that stands until a jerk of 1 u/s³ lasts from `begin` on for `duration` [s].
Setpoint jerked(double t, double begin, double duration) {
  const double jerk = std::clamp(t - begin, 0.0, duration);
  const double rest = std::max(t - begin - duration, 0.0);
  const double p = jerk * jerk * jerk / 6.0, v = jerk * jerk / 2.0, a = jerk;
  return {{0, p + rest * (v + rest * a / 2.0)}, v + rest * a, a};
}

/// Differences of what is given from the path, summed up over all cycles.
struct Summed {
  double position = 0.0, velocity = 0.0, acceleration = 0.0;
};

/// What a jerk leaves in a value that is always extrapolated by `late` cycles.
Summed left_by(double begin, double duration, int late) {
  Receiver receiver;
  receiver.values.set_source(Modulo{}, kCycle);
  Summed all;
  for (int i = 0; i < 400; ++i) {
    if (i >= late) receiver.values.add((i - late) * kCycle, jerked(0.001 * (i - late), begin, duration));
    if (receiver.values.empty()) continue;
    const Setpoint given = receiver.step(i * kCycle), truth = jerked(0.001 * i, begin, duration);
    all.position += std::abs(given.position.value - truth.position.value);
    all.velocity += std::abs(given.velocity - truth.velocity);
    all.acceleration += std::abs(given.acceleration - truth.acceleration);
  }
  return all;
}

/// What is given depends on the jerk of the path linearly. So with any jerk of at most J it is off by no more
/// than J times the sum of what each moment of a cycle leaves in all later ones: that sum is the largest
/// difference there can be, and it is within J · (t + T)³ / 30 for a value that is extrapolated by t, with
/// T = 8 cycles + 4 t, its velocity within J · (t + T)² / 10, its acceleration within J · (t + T) / 2.
TEST(AdaptedValue, IsWithinTheWrittenBoundOfTheJerkWhateverThePath) {
  constexpr int kParts = 20;  // of a cycle
  for (int late = 1; late <= 4; ++late) {
    SCOPED_TRACE(late);
    Summed all;
    for (int part = 0; part < kParts; ++part) {
      const Summed one = left_by(0.010 + 0.001 * part / kParts, 0.001 / kParts, late);
      all.position += one.position;
      all.velocity += one.velocity;
      all.acceleration += one.acceleration;
    }
    const double span = 0.001 * (late + 8 + 4 * late);
    EXPECT_LE(all.position, span * span * span / 30.0);
    EXPECT_LE(all.velocity, span * span / 10.0);
    EXPECT_LE(all.acceleration, span / 2.0);
    EXPECT_GT(all.position, span * span * span / 100.0) << "the formula tells nothing";
  }
}

TEST(AdaptedValue, MeetsTheRecordedPathAgainAfterAGap) {
  Receiver receiver;
  receiver.delay = 2 * kCycle;
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool gap = i > 1000 && i < 1020;
    if (!gap) receiver.values.add(i * kCycle, path(seconds(i * kCycle), kRing));
    if (i < 2) continue;
    const Setpoint given = receiver.step(i * kCycle);
    if (i > 1020 && met == 0 && !receiver.adapted.returning()) met = i;
    if (met != 0) {
      ASSERT_EQ(given.position, path(seconds((i - 2) * kCycle), kRing).position) << i;
    }
  }
  // It was extrapolated by up to 18 cycles: 4 · 18 + 8 cycles, from the one that closes the gap on.
  EXPECT_GT(met, 1020);
  EXPECT_LE(met, 1020 + 4 * 18 + 8 + 1);
}

/// A source of 250 u/s that misses up to 30 ticks at a time for a while, even before the last ones are made
/// up for: it stands in them. What is given goes on, slower, and never back nor by a step, and then is its
/// path again.
TEST(AdaptedValue, NeverTurnsBackForASourceThatHasMissedTicks) {
  for (const std::int64_t delay : {std::int64_t{0}, 2 * kCycle, 5 * kCycle + 300'000, 60 * kCycle}) {
    SCOPED_TRACE(testing::Message() << "delay " << delay << ", seed 5");
    std::mt19937 random(5);
    Receiver receiver;
    receiver.delay = delay;
    std::int64_t executed = 0, next = 0, skipped = 0;
    double path = 0.0;
    Setpoint last;
    for (int i = 0; i < 20000; ++i) {
      const std::int64_t now = i * kCycle;
      if (now == next) {
        path = 0.25 * static_cast<double>(executed);
        receiver.values.add(now, {normalised({0, path}, kRing), 250.0, 0.0}, now - executed * kCycle);
        ++executed;
        const bool calm = i % 2000 > 200 || i > 15000;
        const int missed = calm || random() % 20 != 0 ? 0 : 1 + static_cast<int>(random() % 30);
        skipped += missed;
        next += (1 + missed) * kCycle;
      }
      if (!receiver.values.reaches_back_to(now - delay)) continue;
      const bool begun = receiver.adapted.begun();
      const Setpoint given = receiver.step(now);
      if (begun) {
        const double moved = rounded_difference(given.position, last.position, kRing);
        ASSERT_NEAR(moved, 0.0005 * (given.velocity + last.velocity), 1e-2) << i;
        ASSERT_GE(given.velocity, 0.0) << i;
        ASSERT_LE(given.velocity, 250.0 + 1e-9) << i;
        ASSERT_NEAR(given.velocity, last.velocity, 25.0) << i;
      }
      last = given;
    }
    EXPECT_GT(skipped, 300);
    EXPECT_FALSE(receiver.adapted.returning());
    EXPECT_EQ(last.position, receiver.values.at(19999 * kCycle - delay).position);
  }
}

TEST(AdaptedValue, GoesOverToAnotherDelayWithoutAStep) {
  Receiver receiver;
  receiver.delay = 10 * kCycle;
  Setpoint last;
  for (int i = 0; i < 1000; ++i) {
    receiver.values.add(i * kCycle, {normalised({0, 0.25 * i}, kRing), 250.0, 0.0});
    if (i < 10) continue;
    if (i == 500) receiver.delay = 30 * kCycle;
    const Setpoint given = receiver.step(i * kCycle);
    if (i > 10) {
      ASSERT_NEAR(rounded_difference(given.position, last.position, kRing),
                  0.0005 * (given.velocity + last.velocity), 1e-3)
          << i;
    }
    last = given;
  }
  EXPECT_FALSE(receiver.adapted.returning());
  EXPECT_NEAR(distance(last, {normalised({0, 0.25 * 969}, kRing), 0.0, 0.0}), 0.0, 1e-9);
}

}  // namespace
}  // namespace lockstep::recorded_values_test
