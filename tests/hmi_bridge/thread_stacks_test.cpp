// What a thread of a run takes of the memory that is locked.
#include "hmi_bridge/network/thread_stacks.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <thread>

namespace lockstep::thread_stacks_test {
namespace {

std::size_t stack_of_a_thread() {
  std::size_t size = 0;
  std::thread([&size] {
    pthread_attr_t own;
    ASSERT_EQ(pthread_getattr_np(pthread_self(), &own), 0);
    pthread_attr_getstacksize(&own, &size);
    pthread_attr_destroy(&own);
  }).join();
  return size;
}

TEST(ThreadStacks, AreSmallOnceTheyAreAskedToBe) {
  EXPECT_GT(stack_of_a_thread(), kThreadStack) << "those of the system";
  keep_stacks_small();
  EXPECT_LE(stack_of_a_thread(), kThreadStack);
}

}  // namespace
}  // namespace lockstep::thread_stacks_test
