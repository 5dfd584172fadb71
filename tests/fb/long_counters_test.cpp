#include "fb/long_counters.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lockstep::long_counters_test {
namespace {

constexpr DINT kMaximum = std::numeric_limits<DINT>::max();
constexpr DINT kMinimum = std::numeric_limits<DINT>::min();

// One rising edge: a call with the input FALSE and one with it TRUE.
template <class Block, class Owner>
void pulse(Block& block, BOOL Owner::*input) {
  block.*input = false;
  block.call(0);
  block.*input = true;
  block.call(0);
}

TEST(CTU_DINT, CountsBeyondTheGreatestInt) {
  CTU_DINT counter;
  counter.PV = 32'769;
  for (int i = 0; i < 32'768; ++i) pulse(counter, &CTU_DINT::CU);
  EXPECT_EQ(counter.CV, 32'768);
  EXPECT_FALSE(counter.Q);
  pulse(counter, &CTU_DINT::CU);
  EXPECT_TRUE(counter.Q);
}

TEST(CTU_DINT, StopsAtTheGreatestDint) {
  CTU_DINT counter;
  counter.CV = kMaximum - 1;
  pulse(counter, &CTU_DINT::CU);
  pulse(counter, &CTU_DINT::CU);
  EXPECT_EQ(counter.CV, kMaximum);
}

TEST(CTD_DINT, StopsAtTheLeastDint) {
  CTD_DINT counter;
  counter.LD = true;
  counter.PV = kMinimum + 1;
  counter.call(0);
  counter.LD = false;
  pulse(counter, &CTD_DINT::CD);
  pulse(counter, &CTD_DINT::CD);
  EXPECT_EQ(counter.CV, kMinimum);
  EXPECT_TRUE(counter.Q);
}

TEST(CTUD_DINT, StopsAtBothEnds) {
  CTUD_DINT counter;
  counter.CV = kMaximum;
  pulse(counter, &CTUD_DINT::CU);
  EXPECT_EQ(counter.CV, kMaximum);
  counter.CV = kMinimum;
  pulse(counter, &CTUD_DINT::CD);
  EXPECT_EQ(counter.CV, kMinimum);
}

}  // namespace
}  // namespace lockstep::long_counters_test
