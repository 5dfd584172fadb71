// Shows that the replaced allocation operators count.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/allocations.hpp"

namespace lockstep::test::allocation_test {

TEST(CountAllocations, SeesWhatIsTakenAndGivenBackWhileItIsOpen) {
  const std::uint64_t before = allocations_counted();
  auto outside = std::make_unique<std::vector<int>>(100);
  EXPECT_EQ(allocations_counted(), before);
  {
    const CountAllocations count;
    outside->resize(100000);
    outside.reset();
  }
  EXPECT_GE(allocations_counted(), before + 4);
}

}  // namespace lockstep::test::allocation_test
