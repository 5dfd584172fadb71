#include "scheduler/crew.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace lockstep::crew_test {
namespace {

/// How often each item has been done.
struct Items {
  std::vector<int> done;

  static void work(void* context, std::size_t begin, std::size_t end) noexcept {
    auto& items = *static_cast<Items*>(context);
    for (std::size_t i = begin; i < end; ++i) ++items.done[i];
  }
};

class Crews : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Helpers, Crews, ::testing::Values(1, 2, 5));

TEST_P(Crews, DoEachItemOnceAndShowItToWhoAsked) {
  Crew crew(GetParam());
  int rounds = 0;
  for (std::size_t count = 0; count < 600; count += 7) {
    Items items{std::vector<int>(count)};
    crew.wake();
    for (int piece = 1; piece <= 5; ++piece) {
      crew.share(count, Items::work, &items);
      ASSERT_TRUE(std::all_of(items.done.begin(), items.done.end(), [&](int n) { return n == piece; }))
          << count;
    }
    crew.rest();
    ++rounds;
  }
  EXPECT_EQ(rounds, 86);
}

/// Helpers that have fallen asleep in between, or that are only just on their way.
TEST_P(Crews, EndWhileTheirHelpersSleepOrWake) {
  for (int i = 0; i < 50; ++i) {
    Crew crew(GetParam());
    if (i % 2 == 0) continue;
    Items items{std::vector<int>(100)};
    crew.wake();
    crew.share(100, Items::work, &items);
    crew.rest();
    ASSERT_EQ(*std::min_element(items.done.begin(), items.done.end()), 1);
  }
}

/// Where each thread begins; none goes on before all have begun.
struct Beginnings {
  std::size_t threads;
  std::mutex lock;
  std::map<std::thread::id, std::size_t> first;
  std::atomic<std::size_t> begun{0};

  static void work(void* context, std::size_t begin, std::size_t /*end*/) noexcept {
    auto& all = *static_cast<Beginnings*>(context);
    {
      const std::scoped_lock locked(all.lock);
      if (all.first.emplace(std::this_thread::get_id(), begin).second) ++all.begun;
    }
    while (all.begun != all.threads) std::this_thread::yield();
  }
};

/// So that each finds in its cache what it had there before.
TEST_P(Crews, BeginEachWithAShareOfItsOwnThatStaysTheSame) {
  Crew crew(GetParam());
  const auto threads = static_cast<std::size_t>(GetParam()) + 1;
  const std::size_t portions = 4;
  std::map<std::thread::id, std::size_t> before;
  for (int piece = 0; piece < 20; ++piece) {
    Beginnings beginnings{threads, {}, {}, {}};
    crew.wake();
    crew.share(threads * portions * Crew::kPortion, Beginnings::work, &beginnings);
    crew.rest();
    ASSERT_EQ(beginnings.first.at(std::this_thread::get_id()), 0u);
    std::set<std::size_t> first;
    for (const auto& [thread, begin] : beginnings.first) {
      ASSERT_EQ(begin % (portions * Crew::kPortion), 0u);
      first.insert(begin);
    }
    ASSERT_EQ(first.size(), threads);
    if (piece > 0) {
      ASSERT_EQ(beginnings.first, before);
    }
    before = beginnings.first;
  }
}

TEST(Crews, ShowTheirThreads) {
  Crew crew(3);
  EXPECT_EQ(crew.threads().size(), 3u);
}

}  // namespace
}  // namespace lockstep::crew_test
