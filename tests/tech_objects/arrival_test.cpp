#include "tech_objects/axis/arrival.hpp"

#include <gtest/gtest.h>

namespace lockstep::arrival_test {
namespace {

using Verdict = Arrival::Verdict;

struct ArrivalOfAMotion : ::testing::Test {
  ArrivalOfAMotion() {
    arrival.configure(0.001);
    settings.Window = 0.1;
    settings.MinDwellTime = 0.003;
    settings.ToleranceTime = 0.005;
  }
  Verdict watch(double distance, bool monitored = true) {
    return arrival.watch_position(distance, settings, monitored);
  }

  Arrival arrival;
  TO_Struct_PositionMonitoring settings;
};

TEST_F(ArrivalOfAMotion, HasArrivedAfterTheDwellTimeInTheWindow) {
  for (int tick = 0; tick < 3; ++tick) EXPECT_EQ(watch(0.1), Verdict::in_progress) << tick;
  EXPECT_EQ(watch(0.1), Verdict::arrived);
}

TEST_F(ArrivalOfAMotion, IsMissedAfterTheToleranceTimeOutsideOfTheWindow) {
  for (int tick = 0; tick < 5; ++tick) EXPECT_EQ(watch(0.2), Verdict::in_progress) << tick;
  EXPECT_EQ(watch(0.2), Verdict::missed);
}

TEST_F(ArrivalOfAMotion, IsMissedWhereItLeavesTheWindowWithinTheDwellTime) {
  EXPECT_EQ(watch(0.05), Verdict::in_progress);
  EXPECT_EQ(watch(0.2), Verdict::missed);
}

TEST_F(ArrivalOfAMotion, IsNeverMissedWhereItIsNotMonitored) {
  EXPECT_EQ(watch(0.05, false), Verdict::in_progress);
  for (int tick = 0; tick < 20; ++tick) EXPECT_EQ(watch(0.2, false), Verdict::in_progress) << tick;
  for (int tick = 0; tick < 3; ++tick) EXPECT_EQ(watch(0.05, false), Verdict::in_progress) << tick;
  EXPECT_EQ(watch(0.05, false), Verdict::arrived);
}

TEST_F(ArrivalOfAMotion, CountsAnewWithEachMotion) {
  for (int tick = 0; tick < 3; ++tick) watch(0.1);
  arrival.begin();
  EXPECT_EQ(watch(0.1), Verdict::in_progress);
}

TEST_F(ArrivalOfAMotion, OfAStopIsThereAsSoonAsTheAxisStandsUnlessItDwells) {
  EXPECT_EQ(arrival.watch_rest(false, false, 0.003), Verdict::in_progress);
  EXPECT_EQ(arrival.watch_rest(true, false, 0.003), Verdict::arrived);
  arrival.begin();
  for (int tick = 0; tick < 3; ++tick)
    EXPECT_EQ(arrival.watch_rest(true, true, 0.003), Verdict::in_progress) << tick;
  EXPECT_EQ(arrival.watch_rest(true, true, 0.003), Verdict::arrived);
}

}  // namespace
}  // namespace lockstep::arrival_test
