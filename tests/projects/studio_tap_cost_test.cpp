#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "projects/studio/tap_cost.hpp"

namespace lockstep::studio_tap_cost_test {
namespace {

using Json = nlohmann::json;

Json told(const TapCost& cost) {
  return Json::parse(cost.told().dump());
}

TEST(TapCost, ComparesTicksWithSignalsToThoseWithout) {
  TapCost cost;
  EXPECT_TRUE(told(cost).is_null());
  cost.add(1000, 5'000.0, 0);
  EXPECT_TRUE(told(cost).is_null()) << "one look tells nothing";
  cost.add(2000, 11'000.0, 0);
  EXPECT_EQ(told(cost), (Json{{"tick_us", 6.0}, {"tick_without_us", 6.0}}));
  cost.add(3000, 99'000.0, 64);
  EXPECT_EQ(told(cost), (Json{{"tick_us", 6.0}, {"tick_without_us", 6.0}}))
      << "between these looks they were chosen, so that it counts for neither";
  cost.add(4000, 106'000.0, 64);
  EXPECT_EQ(told(cost), (Json{{"tick_us", 7.0}, {"tick_without_us", 6.0}}));
}

TEST(TapCost, WithoutATimeInWhichNobodyLookedHasNothingToCompareWith) {
  TapCost cost;
  cost.add(10, 100.0, 3);
  cost.add(20, 180.0, 3);
  EXPECT_EQ(told(cost), (Json{{"tick_us", 8.0}, {"tick_without_us", nullptr}}));
  cost.add(20, 180.0, 3);
  EXPECT_EQ(told(cost)["tick_us"], 8.0) << "no tick, no news";
}

}  // namespace
}  // namespace lockstep::studio_tap_cost_test
