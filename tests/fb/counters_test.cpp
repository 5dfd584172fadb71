#include "fb/counters.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lockstep::counters_test {
namespace {

constexpr INT kMaximum = std::numeric_limits<INT>::max();
constexpr INT kMinimum = std::numeric_limits<INT>::min();

// One rising edge: a call with the input FALSE and one with it TRUE.
template <class Block, class Owner>
void pulse(Block& block, BOOL Owner::*input) {
  block.*input = false;
  block.call(0);
  block.*input = true;
  block.call(0);
}

template <class Block>
void load(Block& block, INT value) {
  block.LD = true;
  block.PV = value;
  block.call(0);
  block.LD = false;
}

TEST(CTU, CountsRisingEdgesUntilThePresetAndBeyond) {
  CTU counter;
  counter.PV = 2;
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, 1);
  EXPECT_FALSE(counter.Q);
  counter.call(0);
  EXPECT_EQ(counter.CV, 1) << "a level is no edge";
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, 2);
  EXPECT_TRUE(counter.Q);
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, 3);
  EXPECT_TRUE(counter.Q);
}

TEST(CTU, CountsAFirstCallWithTheInputTrue) {
  CTU counter;
  counter.CU = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 1);
}

TEST(CTU, LosesEdgesWhileItIsReset) {
  CTU counter;
  counter.PV = 5;
  pulse(counter, &CTU::CU);
  counter.R = true;
  counter.CU = false;
  counter.call(0);
  EXPECT_EQ(counter.CV, 0);
  counter.CU = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 0);
  counter.R = false;
  counter.call(0);
  EXPECT_EQ(counter.CV, 0) << "the edge came while the counter was being reset";
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, 1);
}

TEST(CTU, StopsAtTheGreatestInt) {
  CTU counter;
  counter.PV = kMaximum;
  counter.CV = kMaximum - 1;
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, kMaximum);
  EXPECT_TRUE(counter.Q);
  pulse(counter, &CTU::CU);
  EXPECT_EQ(counter.CV, kMaximum);
}

TEST(CTU, FormsItsOutputInEveryCall) {
  CTU counter;
  counter.call(0);
  EXPECT_TRUE(counter.Q) << "0 has reached a preset of 0";
  counter.PV = 1;
  counter.call(0);
  EXPECT_FALSE(counter.Q);
  counter.PV = -1;
  counter.call(0);
  EXPECT_TRUE(counter.Q);
}

TEST(CTD, CountsDownFromThePreset) {
  CTD counter;
  load(counter, 2);
  EXPECT_EQ(counter.CV, 2);
  EXPECT_FALSE(counter.Q);
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, 1);
  EXPECT_FALSE(counter.Q);
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, 0);
  EXPECT_TRUE(counter.Q);
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, -1);
  EXPECT_TRUE(counter.Q);
}

TEST(CTD, IsAtItsEndBeforeTheFirstLoad) {
  CTD counter;
  counter.PV = 3;
  counter.call(0);
  EXPECT_EQ(counter.CV, 0);
  EXPECT_TRUE(counter.Q);
}

TEST(CTD, CountsAFirstCallWithTheInputTrue) {
  CTD counter;
  counter.CD = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, -1);
}

TEST(CTD, FollowsThePresetAndLosesEdgesWhileItLoads) {
  CTD counter;
  load(counter, 7);
  counter.LD = true;
  counter.PV = 9;
  counter.CD = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 9);
  counter.LD = false;
  counter.call(0);
  EXPECT_EQ(counter.CV, 9) << "the edge came while the counter was being loaded";
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, 8);
}

TEST(CTD, StopsAtTheLeastInt) {
  CTD counter;
  load(counter, kMinimum + 1);
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, kMinimum);
  pulse(counter, &CTD::CD);
  EXPECT_EQ(counter.CV, kMinimum);
}

TEST(CTUD, CountsBothWays) {
  CTUD counter;
  counter.PV = 2;
  pulse(counter, &CTUD::CU);
  EXPECT_EQ(counter.CV, 1);
  EXPECT_FALSE(counter.QU);
  EXPECT_FALSE(counter.QD);
  pulse(counter, &CTUD::CU);
  EXPECT_EQ(counter.CV, 2);
  EXPECT_TRUE(counter.QU);
  pulse(counter, &CTUD::CD);
  pulse(counter, &CTUD::CD);
  EXPECT_EQ(counter.CV, 0);
  EXPECT_FALSE(counter.QU);
  EXPECT_TRUE(counter.QD);
}

TEST(CTUD, CountsEachInputInAFirstCallWithItTrue) {
  CTUD up;
  up.CU = true;
  up.call(0);
  EXPECT_EQ(up.CV, 1);
  CTUD down;
  down.CD = true;
  down.call(0);
  EXPECT_EQ(down.CV, -1);
}

TEST(CTUD, StandsStillWhenBothEdgesComeInOneCall) {
  CTUD counter;
  load(counter, 4);
  counter.CU = counter.CD = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 4);
  counter.call(0);
  EXPECT_EQ(counter.CV, 4);
}

TEST(CTUD, CountsAnEdgeWhileTheOtherInputMerelyIsTrue) {
  CTUD counter;
  load(counter, 4);
  pulse(counter, &CTUD::CU);
  counter.CD = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 4) << "4 + 1 - 1: CU was TRUE before and is no edge";
}

TEST(CTUD, RanksResetAboveLoadAboveCounting) {
  CTUD counter;
  counter.PV = 6;
  counter.R = counter.LD = counter.CU = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 0);
  counter.R = false;
  counter.CU = false;
  counter.call(0);
  EXPECT_EQ(counter.CV, 6);
  counter.CU = true;
  counter.call(0);
  EXPECT_EQ(counter.CV, 6);
  EXPECT_TRUE(counter.QU);
  counter.LD = false;
  counter.call(0);
  EXPECT_EQ(counter.CV, 6) << "the edge came while the counter was being loaded";
}

TEST(CTUD, StopsAtTheLimitsOfInt) {
  CTUD counter;
  load(counter, kMaximum);
  pulse(counter, &CTUD::CU);
  EXPECT_EQ(counter.CV, kMaximum);
  load(counter, kMinimum);
  pulse(counter, &CTUD::CD);
  EXPECT_EQ(counter.CV, kMinimum);
}

}  // namespace
}  // namespace lockstep::counters_test
