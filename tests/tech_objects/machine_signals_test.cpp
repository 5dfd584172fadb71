#include "tech_objects/drive/machine_signals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep::machine_signals_test {
namespace {

constexpr double kLine = 0.0;

TEST(PositionRange, HoldsBothItsEnds) {
  constexpr PositionRange range{-1.0, 2.0};
  for (const double inside : {-1.0, 0.0, 2.0}) EXPECT_TRUE(range.contains(inside, kLine)) << inside;
  for (const double outside : {-1.001, 2.001, 359.0}) EXPECT_FALSE(range.contains(outside, kLine)) << outside;
}

TEST(PositionRange, ComesByOnEveryTurnAlsoOverTheEndOfTheRing) {
  constexpr PositionRange range{-10.0, 10.0};
  for (const double inside : {355.0, 5.0, 360.0, -3590.0, 3600.0})
    EXPECT_TRUE(range.contains(inside, 360.0)) << inside;
  for (const double outside : {11.0, 349.0, -11.0, 3611.0})
    EXPECT_FALSE(range.contains(outside, 360.0)) << outside;
}

TEST(ZeroMarks, AreMetOnTheWayButNotWhereItBegins) {
  constexpr ZeroMarks marks{3.0, 10.0};
  EXPECT_EQ(marks.between(0.0, 3.0), 3.0);
  EXPECT_EQ(marks.between(3.0, 12.0), std::nullopt);
  EXPECT_EQ(marks.between(3.0, 13.5), 13.0);
  EXPECT_EQ(marks.between(13.5, 3.0), 13.0);
  EXPECT_EQ(marks.between(13.0, 3.0), 3.0);
  EXPECT_EQ(marks.between(-1.0, -28.0), -7.0) << "the first of several";
  EXPECT_EQ(marks.between(5.0, 5.0), std::nullopt);
}

TEST(ZeroMarks, WithoutPeriodAreOne) {
  constexpr ZeroMarks mark{3.0, 0.0};
  EXPECT_EQ(mark.between(0.0, 100.0), 3.0);
  EXPECT_EQ(mark.between(100.0, 0.0), 3.0);
  EXPECT_EQ(mark.between(4.0, 100.0), std::nullopt);
}

/// Every mark is met exactly once, whatever the steps in which the axis comes by.
TEST(ZeroMarks, AreNeitherMissedNorMetTwice) {
  constexpr ZeroMarks marks{0.1, 0.3};
  for (const double step : {0.0137, 0.1, 0.3, -0.0137, -0.1, -0.3}) {
    int met = 0;
    double here = 0.05;
    for (int i = 0; i < 30000; ++i) {
      const double next = here + step;
      met += marks.between(here, next).has_value() ? 1 : 0;
      here = next;
    }
    const double distance = std::abs(here - 0.05);
    EXPECT_NEAR(met, distance / 0.3, 1.0) << step;
  }
}

/// Positions one after another; the switch is active from 10 to 20.
struct Passing {
  MarkSearch search;
  std::optional<ZeroMarks> marks = ZeroMarks{5.0, 10.0};

  Passing(HomingMark mark, int direction, int side = 1) { search.begin(mark, direction, side); }
  /// @return whether the mark has been found
  bool pass(std::initializer_list<double> positions) {
    for (const double position : positions)
      search.step(position, position >= 10.0 && position <= 20.0, marks);
    return search.found();
  }
};

TEST(MarkSearch, TellsTheSidesOfASwitchApartWhicheverWayItIsPassed) {
  for (const int direction : {1, 0}) {
    Passing positive(HomingMark::switch_edge, direction, 1);
    EXPECT_FALSE(positive.pass({5.0, 11.0}));
    EXPECT_TRUE(positive.pass({19.0, 21.0}));
    EXPECT_EQ(positive.search.place(), 21.0);
  }
  Passing entered(HomingMark::switch_edge, -1, 1);
  EXPECT_TRUE(entered.pass({25.0, 19.0})) << "its positive side, met in the negative direction";
  Passing left(HomingMark::switch_edge, -1, -1);
  EXPECT_FALSE(left.pass({5.0, 15.0, 25.0, 15.0}));
  EXPECT_TRUE(left.pass({5.0}));
}

TEST(MarkSearch, DoesNotTakeTheSwitchOnWhichItBeginsForAnEdge) {
  Passing passing(HomingMark::switch_edge, 0, -1);
  EXPECT_FALSE(passing.pass({15.0, 16.0, 25.0}));
}

TEST(MarkSearch, TakesNoZeroMarkBeforeTheCamIsLeft) {
  Passing passing(HomingMark::zero_mark_after_cam, 1);
  EXPECT_FALSE(passing.pass({0.0, 6.0, 12.0, 16.0, 21.0}));
  EXPECT_TRUE(passing.pass({24.0, 26.0}));
  EXPECT_EQ(passing.search.place(), 25.0);
}

TEST(MarkSearch, AsksForTheCamAgainAfterTurningBack) {
  Passing passing(HomingMark::zero_mark_after_cam, 1);
  EXPECT_FALSE(passing.pass({15.0, 21.0, 22.0, 21.0, 24.0, 26.0, 36.0}));
  EXPECT_TRUE(passing.pass({15.0, 22.0, 26.0}));
}

}  // namespace
}  // namespace lockstep::machine_signals_test
