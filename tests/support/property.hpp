/// Tests with random cases: which seeds they have, how many, and how a failing one is followed.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "tests/support/seeds.hpp"

namespace lockstep::test {

/// The seed of a test with one generator for all its cases, printed.
inline std::uint64_t seed_of_test(std::uint64_t usual) {
  const std::uint64_t seed = seed_of_run(usual);
  testing::Test::RecordProperty("seed", std::to_string(seed));
  return seed;
}

/// One case of a test whose cases have seeds of their own.
struct Case {
  std::uint64_t seed;
  bool alone;  ///< LOCKSTEP_SEED asks for it: it may tell what happens
};

/// What has been run.
struct Cases {
  std::uint64_t first = 0;
  int count = 0;
  bool alone = false;  ///< one case that was asked for: no statistics
};

/// Calls `run(Case)` for seeds in a row, from `first` on; ends after ten that fail. Each failure names its
/// seed; how many cases there were and from which seed on is printed.
template <class Run>
Cases for_each_seed(std::uint64_t first, int count, Run run) {
  constexpr int kMaximumFailures = 10;
  const auto alone = seed_of("LOCKSTEP_SEED");
  Cases ran{alone.value_or(seed_of("LOCKSTEP_FIRST_SEED").value_or(first)), 0, alone.has_value()};
  const testing::TestResult& result = *testing::UnitTest::GetInstance()->current_test_info()->result();
  int failed = 0;
  while (ran.count < (ran.alone ? 1 : count) && failed < kMaximumFailures) {
    const std::uint64_t seed = ran.first + static_cast<std::uint64_t>(ran.count++);
    SCOPED_TRACE("follow it with LOCKSTEP_SEED=" + std::to_string(seed));
    const int parts = result.total_part_count();
    run(Case{seed, ran.alone});
    for (int i = parts; i < result.total_part_count(); ++i)
      if (result.GetTestPartResult(i).failed()) {
        ++failed;
        break;
      }
  }
  std::printf("%d cases from seed %llu on\n", ran.count, static_cast<unsigned long long>(ran.first));
  testing::Test::RecordProperty("first_seed", std::to_string(ran.first));
  return ran;
}

}  // namespace lockstep::test
