// Profiles against motions from an independent generator.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tech_objects/profile/profile.hpp"

namespace lockstep::profile_vectors_test {
namespace {

constexpr double kNoLimit = 1e9;

std::vector<std::vector<double>> rows_of(const std::string& name) {
  std::ifstream file{std::string{LOCKSTEP_TEST_DATA} + "/" + name};
  std::vector<std::vector<double>> rows;
  std::string line;
  for (bool header = true; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    if (!std::exchange(header, false)) {
      std::istringstream cells{line};
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
      rows.push_back(row);
    }
  }
  return rows;
}

TEST(ProfileVectors, ChangesOfVelocityTakeTheShortestTimeAndItsWay) {
  const auto rows = rows_of("otg_velocity.csv");
  ASSERT_GE(rows.size(), 2000u);
  for (const auto& r : rows) {
    Profile profile;
    ASSERT_EQ(plan_velocity({0.0, r[0], r[1]}, r[2], {kNoLimit, -kNoLimit, r[3], r[3], r[4]}, profile),
              PlanResult::ok);
    ASSERT_NEAR(profile.duration(), r[5], 1e-9 * r[5]) << "v0=" << r[0] << " a0=" << r[1];
    ASSERT_NEAR(profile.target().position, r[6], 1e-6 * std::max(1.0, std::abs(r[6])));
  }
}

TEST(ProfileVectors, MotionsFromRestToRestWithUnequalAccelerationAndDecelerationAreTimeOptimal) {
  const auto rows = rows_of("otg_asymmetric.csv");
  ASSERT_GE(rows.size(), 2000u);
  for (const auto& r : rows) {
    Profile profile;
    ASSERT_EQ(plan_position({r[0], 0.0, 0.0}, r[1], 0.0, {r[2], -r[2], r[3], r[4], r[5]}, profile),
              PlanResult::ok);
    ASSERT_NEAR(profile.duration(), r[6], 1e-9 * r[6]) << "p1=" << r[1];
    ASSERT_NEAR(profile.at(0.5 * r[6]).position, r[7], 1e-6 * std::abs(r[1] - r[0])) << "p1=" << r[1];
  }
}

TEST(ProfileVectors, MotionsFromAnyStateToAnyVelocityAreTimeOptimal) {
  const auto rows = rows_of("otg_position.csv");
  ASSERT_GE(rows.size(), 1800u);
  for (const auto& r : rows) {
    Profile profile;
    ASSERT_EQ(plan_position({r[0], r[1], r[2]}, r[3], r[4], {r[5], -r[5], r[6], r[6], r[7]}, profile),
              PlanResult::ok);
    ASSERT_NEAR(profile.duration(), r[8], 1e-9 * r[8]) << "p0=" << r[0];
    // The range: the way to the target, or what the velocity covers in the time where that is little.
    const double range = std::max(std::abs(r[3] - r[0]), r[5] * r[8]);
    ASSERT_NEAR(profile.at(0.5 * r[8]).position, r[9], 1e-6 * range) << "p0=" << r[0];
  }
}

}  // namespace
}  // namespace lockstep::profile_vectors_test
