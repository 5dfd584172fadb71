// What follows a counter: gear, pursuit, filter, offsets, markers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tech_objects/mco305/marker_track.hpp"
#include "tech_objects/mco305/virtual_master.hpp"
#include "tech_objects/synchronous/count_filter.hpp"
#include "tech_objects/synchronous/count_gear.hpp"
#include "tech_objects/synchronous/marker_filter.hpp"
#include "tech_objects/synchronous/marker_pairing.hpp"
#include "tech_objects/synchronous/marker_window.hpp"
#include "tech_objects/synchronous/offset_spread.hpp"
#include "tech_objects/synchronous/pursuit.hpp"
#include "tests/support/property.hpp"

namespace lockstep::counted_following_test {
namespace {

constexpr unsigned kSeed = 20260724;

TEST(CountGear, LosesNothingInABillionCounts) {
  std::mt19937_64 random(kSeed);
  const struct {
    std::int64_t leading, following;
  } kRatios[] = {{2048, 55}, {-113, 355}, {1073741823, 1073741789}, {3, -7}, {1073741823, 1}, {1, 1000}};
  for (const auto& ratio : kRatios) {
    CountGear gear;
    gear.set(ratio.leading, ratio.following);
    gear.begin(17.0);
    std::int64_t moved = 0;
    std::uniform_int_distribution<std::int64_t> counts(-300, 20'300);
    while (moved < 1'000'000'000) {
      const std::int64_t step = counts(random);
      gear.move(step);
      moved += step;
    }
    // whole + rest / leading = 17 + moved * following / leading, with no remainder left over.
    const std::int64_t leading = ratio.leading < 0 ? -ratio.leading : ratio.leading;
    const std::int64_t following = ratio.leading < 0 ? -ratio.following : ratio.following;
    const std::int64_t exact = moved * following;
    std::int64_t whole = exact / leading, rest = exact % leading;
    if (rest < 0) {
      rest += leading;
      --whole;
    }
    EXPECT_EQ(gear.whole(), 17 + whole) << ratio.leading;
    EXPECT_EQ(gear.fraction(), static_cast<double>(rest) / static_cast<double>(leading)) << ratio.leading;
  }
}

TEST(CountGear, StaysWhereItIsWhenItsRatioChanges) {
  CountGear gear;
  gear.set(3, 2);
  gear.begin(100.25);
  gear.move(7);
  const double before = gear.position();
  gear.set(1000, 999);
  EXPECT_NEAR(gear.position(), before, 1e-3);
  EXPECT_DOUBLE_EQ(gear.ratio(), 0.999);
  gear.set(0, 5);  // with which nothing can be computed
  EXPECT_DOUBLE_EQ(gear.ratio(), 0.999);
}

TEST(Pursuit, KeepsItsLimitsAndMeetsATargetThatGoesOn) {
  std::mt19937_64 random(kSeed);
  const auto of = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int kCases = 20'000;
  for (int i = 0; i < kCases; ++i) {
    PursuitLimits limits;
    limits.velocity = of(1.0, 200.0);
    limits.acceleration = of(0.01, 5.0);
    limits.deceleration = of(0.01, 5.0);
    const double velocity = of(-0.8, 0.8) * limits.velocity;
    double target = of(-20'000.0, 20'000.0);
    Pursuit pursuit;
    pursuit.begin(0.0, of(-1.0, 1.0) * limits.velocity);
    int steps = 0;
    constexpr int kLongest = 400'000;
    for (; steps < kLongest && !(pursuit.synchronous(limits) && pursuit.position() == target); ++steps) {
      const double before = pursuit.velocity(), place = pursuit.position();
      target += velocity;
      pursuit.step(target, velocity, limits);
      const double now = pursuit.velocity();
      ASSERT_LE(std::abs(now), limits.velocity * (1.0 + 1e-12));
      const double change = std::abs(now) - std::abs(before);
      if (before * now >= 0.0) {
        ASSERT_LE(change, limits.acceleration * (1.0 + 1e-9) + 1e-9) << i;
        ASSERT_GE(change, -limits.deceleration * (1.0 + 1e-9) - 1e-9) << i;
      } else {
        // Through standstill: a part of the step brakes, the rest speeds up.
        ASSERT_LE(std::abs(before) / limits.deceleration + std::abs(now) / limits.acceleration, 1.0 + 1e-9)
            << i;
      }
      ASSERT_NEAR(pursuit.position() - place, now, 1e-6);
    }
    ASSERT_LT(steps, kLongest) << i << ": " << velocity << " within " << limits.velocity << ", "
                               << limits.acceleration << ", " << limits.deceleration;
    // It goes along with it to the last bit.
    for (int k = 0; k < 3; ++k) {
      target += velocity;
      pursuit.step(target, velocity, limits);
      ASSERT_EQ(pursuit.position(), target);
    }
  }
}

// A target that is counted: its velocity is known by its counts alone, and none of them is a motion.
TEST(Pursuit, MeetsACountedTargetWithoutOvershooting) {
  std::mt19937_64 random(kSeed);
  const auto of = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int kCases = 3000, kKnown = 64;
  int over = 0;
  double farthest = 0.0;
  for (int i = 0; i < kCases; ++i) {
    PursuitLimits limits{.velocity = of(5.0, 100.0),
                         .acceleration = of(0.02, 2.0),
                         .deceleration = of(0.02, 2.0),
                         .uncertainty = 1.0};
    const double velocity = of(-0.6, 0.6) * limits.velocity, offset = of(-3000.0, 3000.0);
    double place = velocity * kKnown, counted = std::floor(place);
    Pursuit pursuit;
    pursuit.begin(counted, velocity);
    pursuit.expect(counted / kKnown, kKnown);
    double beyond = 0.0;
    int steps = 0;
    for (; steps < 20'000 && !(steps > 10 && pursuit.position() == counted + offset); ++steps) {
      place += velocity;
      const double before = counted;
      counted = std::floor(place);
      pursuit.step(counted + offset, counted - before, limits);
      beyond = std::max(beyond, (pursuit.position() - counted - offset) * (offset > 0.0 ? 1.0 : -1.0));
    }
    ASSERT_LT(steps, 20'000) << i << ": it is met";
    over += beyond > 2.0 ? 1 : 0;
    farthest = std::max(farthest, beyond);
  }
  // Where a single count comes but once in a long while nobody can know it beforehand.
  EXPECT_LE(over, kCases / 500);
  EXPECT_LE(farthest, 50.0);
}

TEST(Pursuit, DoesNotOvershootAStandingTarget) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    PursuitLimits limits;
    limits.velocity = std::uniform_real_distribution<double>(0.5, 100.0)(random);
    limits.acceleration = limits.deceleration = std::uniform_real_distribution<double>(0.01, 5.0)(random);
    const double target = std::uniform_real_distribution<double>(1.0, 10'000.0)(random);
    Pursuit pursuit;
    pursuit.begin(0.0, 0.0);
    for (int k = 0; k < 200'000 && pursuit.position() != target; ++k) {
      pursuit.step(target, 0.0, limits);
      ASSERT_LE(pursuit.position(), target + 1e-9);
    }
    EXPECT_EQ(pursuit.position(), target);
  }
}

TEST(Pursuit, StaysInItsBandAndNeverReverses) {
  PursuitLimits limits{.velocity = 100.0, .acceleration = 0.2, .deceleration = 0.2, .band = 0.05};
  Pursuit pursuit;
  pursuit.begin(0.0, 10.0);
  double target = 2000.0;
  for (int i = 0; i < 5000; ++i) {
    target += 10.0;
    pursuit.step(target, 10.0, limits);
    ASSERT_GE(pursuit.velocity(), 9.5);
    ASSERT_LE(pursuit.velocity(), 10.5);
  }
  EXPECT_EQ(pursuit.position(), target);
  limits.band = -1.0;
  limits.reversal = PursuitLimits::Reversal::never;
  for (int i = 0; i < 2000; ++i) {
    target -= 10.0;
    pursuit.step(target, -10.0, limits);
    ASSERT_GE(pursuit.velocity(), 0.0);
  }
  EXPECT_EQ(pursuit.velocity(), 0.0);
  limits.reversal = PursuitLimits::Reversal::with_target;
  for (int i = 0; i < 20'000; ++i) {
    target -= 10.0;
    pursuit.step(target, -10.0, limits);
  }
  EXPECT_EQ(pursuit.position(), target);
}

// What halves without end would be computed with numbers that a processor is slow with.
TEST(CountFilter, ComesToRestBehindACounterThatStands) {
  CountFilter filter;
  filter.begin(0.0);
  for (int ms = 0; ms < 1000; ++ms) filter.step_and_return(7.0, 20.0);
  for (int ms = 0; ms < 2'000'000; ++ms) {
    filter.step_and_return(0.0, 20.0);
    ASSERT_NE(std::fpclassify(filter.velocity()), FP_SUBNORMAL) << ms;
    ASSERT_NE(std::fpclassify(filter.lag()), FP_SUBNORMAL) << ms;
  }
  EXPECT_EQ(filter.velocity(), 0.0);
  EXPECT_EQ(filter.lag(), 0.0);
}

TEST(CountFilter, GivesBackWhatItHoldsBack) {
  CountFilter filter;
  filter.begin(0.0);
  double given = 0.0;
  for (int i = 0; i < 1000; ++i) given += filter.step_and_return(20.0, 50.0);
  EXPECT_GT(filter.lag(), 1.0);
  EXPECT_NEAR(20'000.0 - given, filter.lag(), 1e-6);
  for (int i = 0; i < 20'000; ++i) given += filter.step_and_return(20.0, 50.0);
  EXPECT_NEAR(420'000.0 - given, 0.0, 1e-3);
  EXPECT_DOUBLE_EQ(CountFilter::published_time(1000.0), 9.5);
  EXPECT_DOUBLE_EQ(CountFilter::published_time(1512.0), 0.5 * (9.3 + 4.5));
  EXPECT_DOUBLE_EQ(CountFilter::published_time(10.0), 39.5);
  EXPECT_DOUBLE_EQ(CountFilter::published_time(1e6), 1.4);
}

TEST(OffsetSpread, TakesItsTime) {
  for (const bool trapezoid : {false, true}) {
    OffsetSpread spread;
    spread.begin(0.0);
    spread.set(4000.0, 2000.0, trapezoid);
    spread.want(4000.0);
    double fastest = 0.0;
    int steps = 0;
    while (spread.reached() != 4000.0 && steps < 10'000) {
      const double before = spread.reached();
      spread.step();
      fastest = std::max(fastest, spread.reached() - before);
      ++steps;
    }
    EXPECT_NEAR(steps, 2000, 4) << trapezoid;
    EXPECT_NEAR(fastest, trapezoid ? 2.5 : 2.0, 0.01);
  }
  OffsetSpread at_once;
  at_once.begin(0.0);
  at_once.want(7.0);
  EXPECT_EQ(at_once.step(), 7.0);
  at_once.want_within(107.0, 50.0);
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(at_once.step(), 7.0 + 2.0 * (i + 1), 1e-9);
}

TEST(MarkerWindow, TellsMarkersFromNoiseAndFromNone) {
  using Verdict = MarkerWindow::Verdict;
  MarkerWindow window;
  const MarkerTolerance within{30'000.0, 1000.0};
  EXPECT_EQ(window.take(5000.0, within), Verdict::accepted);  // the first one, wherever it lies
  EXPECT_EQ(window.take(20'000.0, within), Verdict::ignored);
  EXPECT_EQ(window.take(36'000.0, within), Verdict::accepted);
  EXPECT_FALSE(window.missed(67'000.0, within));
  EXPECT_TRUE(window.missed(67'000.1, within));
  EXPECT_EQ(window.last(), 66'000.0);  // from where it should have been
  EXPECT_EQ(window.take(96'500.0, within), Verdict::accepted);
  const MarkerTolerance open{4000.0, 0.0};
  window.begin();
  EXPECT_EQ(window.take(0.0, open), Verdict::accepted);
  EXPECT_EQ(window.take(7199.0, open), Verdict::accepted);
  EXPECT_EQ(window.take(14'400.0, open), Verdict::late);  // 1.8 times the distance
  EXPECT_FALSE(window.missed(1e9, open));
}

TEST(MarkerPairing, FindsTheFirstPairAsItIsTold) {
  // Markers of what leads at 4000, 8000; of what follows at 4700, 8700.
  bool backwards = false;
  const auto apart_of = [&backwards](FirstPair rule) {
    MarkerPairing pairing;
    pairing.begin(rule);
    pairing.travel(backwards);
    for (const double place : {4000.0, 8000.0, 12'000.0}) {
      if (const auto apart = pairing.leading(place, 0.0, 4000.0)) return *apart;
      if (const auto apart = pairing.following(place + 700.0, 0.0, 4000.0)) return *apart;
    }
    return 1e9;
  };
  EXPECT_EQ(apart_of(FirstPair::leading_first), 700.0);
  EXPECT_EQ(apart_of(FirstPair::following_first), -3300.0);
  EXPECT_EQ(apart_of(FirstPair::first_two), 700.0);
  EXPECT_EQ(apart_of(FirstPair::forward), 700.0);
  EXPECT_EQ(apart_of(FirstPair::backward), -3300.0);
  EXPECT_EQ(apart_of(FirstPair::nearest), 700.0);
  backwards = true;  // 3: "Korrektur durch Aufholen", 4: "durch Abbremsen", whichever way it travels
  EXPECT_EQ(apart_of(FirstPair::forward), -3300.0);
  EXPECT_EQ(apart_of(FirstPair::backward), 700.0);
  EXPECT_EQ(apart_of(FirstPair::nearest), 700.0);
}

TEST(MarkerPairing, DropsThePartnerOfAMissedOne) {
  MarkerPairing pairing;
  pairing.begin(FirstPair::first_two);
  EXPECT_FALSE(pairing.leading(0.0, 0.0, 4000.0));
  EXPECT_EQ(pairing.following(5.0, 0.0, 4000.0), 5.0);
  EXPECT_FALSE(pairing.following(4005.0, 5.0, 4000.0));  // its partner is missing
  EXPECT_FALSE(pairing.leading(8000.0, 5.0, 4000.0));    // belongs to the next one
  EXPECT_EQ(pairing.following(8006.0, 5.0, 4000.0), 1.0);
  EXPECT_FALSE(pairing.leading(12'000.0, 6.0, 4000.0));
  pairing.drop();
  EXPECT_FALSE(pairing.following(12'006.0, 6.0, 4000.0));
}

TEST(MarkerFilter, TrimsTheGearToTheMeanDistance) {
  MarkerFilter filter;
  filter.begin(4000.0);
  const MarkerFilterSettings settings{.time = 2000.0, .distance = 4000.0, .minimum_markers = 100.0};
  for (int i = 0; i < 3000; ++i) filter.take_spacing(4040.0, 20.0, settings);
  EXPECT_NEAR(filter.trim(), -1.0 / 101.0, 1e-9);
  EXPECT_NEAR(filter.distance(), 4040.0, 1e-6);
  EXPECT_NEAR(filter.markers(), 20.0 * 2000.0 / 12'000.0, 1e-12);
}

TEST(VirtualMaster, CountsWithoutALoss) {
  mco305::VirtualMaster master;
  master.set_acceleration(25'600);
  master.set_velocity(25'600);
  std::int64_t counts = 0;
  for (int i = 0; i < 1000; ++i) counts += master.step();
  EXPECT_EQ(master.frequency(), 25'600'000);
  EXPECT_EQ(counts, 51'200);  // half of 25600 pulses, 4 counts each
  for (int i = 0; i < 1'000'000; ++i) counts += master.step();
  EXPECT_EQ(counts, 51'200 + 102'400'000);
  EXPECT_EQ(counts, master.position());
  master.set_velocity(-25'600);
  for (int i = 0; i < 2000; ++i) counts += master.step();
  EXPECT_EQ(counts, 51'200 + 102'400'000);
  EXPECT_EQ(master.frequency(), -25'600'000);
  master.set_acceleration(0);
  EXPECT_TRUE(master.active());
  master.set_velocity(0);
  EXPECT_FALSE(master.active());
  EXPECT_EQ(master.step(), 0);
}

std::vector<double> passed(mco305::MarkerTrackSettings settings, double distance, double step) {
  mco305::MarkerTrack track;
  track.configure(settings);
  std::vector<double> all;
  for (double at = 0.0; at < distance; at += step)
    track.pass(at, at + step, [&](double place) { all.push_back(place); });
  return all;
}

TEST(MarkerTrack, HasWhatMachinesSufferFrom) {
  const bool yes = true;
  EXPECT_EQ(passed({.position = 700.0, .period = 4000.0}, 20'000.0, 13.0),
            (std::vector<double>{700.0, 4700.0, 8700.0, 12'700.0, 16'700.0}));
  const auto noisy = passed({.period = 4000.0, .noise = 15.0, .seed = 3}, 400'000.0, 21.0);
  ASSERT_NEAR(static_cast<double>(noisy.size()), 100.0, 1.0);
  double sum = 0.0;
  bool off = false;
  for (const double place : noisy) {
    const double by = place - std::round(place / 4000.0) * 4000.0;
    EXPECT_LE(std::abs(by), 15.0);
    off = off || std::abs(by) > 5.0;
    sum += by;
  }
  EXPECT_TRUE(off);
  EXPECT_LT(std::abs(sum) / 100.0, 4.0);
  EXPECT_EQ(noisy, passed({.period = 4000.0, .noise = 15.0, .seed = 3}, 400'000.0, 21.0));
  EXPECT_TRUE(passed({.period = 4000.0, .missing = &yes}, 20'000.0, 13.0).empty());
  EXPECT_EQ(passed({.period = 4000.0, .spurious = &yes}, 7999.0, 1.0),
            (std::vector<double>{1800.0, 4000.0, 5800.0}));
  EXPECT_EQ(passed({.period = 4000.0, .twice = &yes}, 7999.0, 1.0),
            (std::vector<double>{400.0, 4000.0, 4400.0}));
  std::vector<double> backwards;
  mco305::MarkerTrack track;
  track.configure({.period = 4000.0, .twice = &yes});
  for (double at = 0.0; at > -7999.0; at -= 1.0)
    track.pass(at, at - 1.0, [&](double place) { backwards.push_back(place); });
  EXPECT_EQ(backwards, (std::vector<double>{-400.0, -4000.0, -4400.0})) << "behind it, whichever way it goes";
  // One count in a hundred does not get through.
  const auto slipped = passed({.period = 3960.0, .slip = 0.01}, 12'500.0, 10.0);
  ASSERT_EQ(slipped.size(), 3u);
  for (std::size_t i = 0; i < slipped.size(); ++i)
    EXPECT_NEAR(slipped[i], 4000.0 * static_cast<double>(i + 1), 1e-6);
}

// A track that remembers where there is no marker sees what one sees that begins anew.
TEST(MarkerTrackProperty, FindsOnEveryWayTheMarkersThatLieThere) {
  int markers = 0, steps = 0;
  test::for_each_seed(1, test::cases(100, 10'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto below = [&random](int limit) {
      return static_cast<int>(random() % static_cast<unsigned>(limit));
    };
    bool missing = false, spurious = false, twice = false;
    mco305::MarkerTrackSettings settings;
    if (below(3) != 0) settings = {.missing = &missing, .spurious = &spurious, .twice = &twice};
    settings.position = below(20'000) - 10'000;
    settings.period = 1 + below(below(2) == 0 ? 100 : 5000);
    settings.noise = below(2) == 0 ? 0.0 : settings.period * below(60) / 100.0;
    settings.seed = one.seed % 1000;
    mco305::MarkerTrack track;
    track.configure(settings);
    const int longest = 1 + below(below(2) == 0 ? 5 : 1000);
    const auto seen = [](mco305::MarkerTrack& by, double from, double to) {
      std::vector<double> all;
      by.pass(from, to, [&all](double place) { all.push_back(place); });
      return all;
    };
    double at = below(1'000'000) - 500'000, direction = 1.0;
    for (int i = 0; i < 1000; ++i, ++steps) {
      if (below(50) == 0) direction = -direction;
      for (bool* const trouble : {&missing, &spurious, &twice})
        if (below(*trouble ? 10 : 200) == 0) *trouble = !*trouble;
      const double to = at + direction * below(longest + 1);
      mco305::MarkerTrack anew;
      anew.configure(settings);
      const std::vector<double> found = seen(track, at, to);
      ASSERT_EQ(found, seen(anew, at, to)) << i << ": from " << at << " to " << to;
      markers += static_cast<int>(found.size());
      at = to;
    }
  });
  EXPECT_GT(markers, steps / 100);
}

}  // namespace
}  // namespace lockstep::counted_following_test
