// Where an axis has been, against a list of all of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "tech_objects/mco305/recent_positions.hpp"

namespace lockstep::mco305 {
namespace {

constexpr std::int64_t kKept = RecentPositions::kSteps;

TEST(RecentPositions, AreThoseOfTheLastStepsHoweverLongItHasStood) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    RecentPositions recent;
    std::vector<std::int64_t> all;
    std::int64_t position = 0, left = 0;
    for (std::int64_t step = 0; step < 5000; ++step, --left) {
      if (left <= 0) {
        position += static_cast<std::int64_t>(random() % 7) - 3;
        left = random() % 4 == 0 ? static_cast<std::int64_t>(random() % 600) : 1;
      }
      if (random() % 1500 == 0) {
        position = 1000;
        recent.fill(position);
        std::fill(all.begin(), all.end(), position);
      }
      recent.keep(step, position);
      all.push_back(position);
      for (std::int64_t ago = 0; ago < std::min(kKept, step + 1); ++ago)
        ASSERT_EQ(recent.at(step - ago), all[static_cast<std::size_t>(step - ago)])
            << "seed " << seed << ", step " << step << ", " << ago << " ago";
    }
  }
}

}  // namespace
}  // namespace lockstep::mco305
