#include "scheduler/crew.hpp"

#include <sched.h>

#include <algorithm>
#include <climits>

namespace lockstep {
namespace {

constexpr int kItemBits = 24;  // of an offer
constexpr std::uint64_t kItems = (std::uint64_t{1} << kItemBits) - 1;
constexpr int kAwake = 2000;    // turns that a helper looks for work before it sleeps, some 20 to 100 µs
constexpr int kPatience = 200;  // turns after which a waiting thread lets others have its processor

void breathe() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

bool open(std::uint32_t call) noexcept {
  return call % 2 == 1;
}

}  // namespace

Crew::Crew(int helpers) {
  helpers_.reserve(static_cast<std::size_t>(helpers));
  for (int i = 0; i < helpers; ++i) {
    helpers_.emplace_back([this] { help(); });
    pthread_setname_np(helpers_.back().native_handle(), "cycle helper");  // for top and strace
  }
}

Crew::~Crew() {
  ending_.store(true, std::memory_order_relaxed);
  call_.fetch_add(2, std::memory_order_release);
  call_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

std::vector<pthread_t> Crew::threads() {
  std::vector<pthread_t> threads;
  for (std::thread& helper : helpers_) threads.push_back(helper.native_handle());
  return threads;
}

void Crew::wake() noexcept {
  call_.fetch_add(1, std::memory_order_release);
  call_.notify_all();
}

void Crew::rest() noexcept {
  call_.fetch_add(1, std::memory_order_release);
}

void Crew::share(std::size_t count, Work work, void* context) noexcept {
  count_.store(count, std::memory_order_relaxed);
  work_.store(work, std::memory_order_relaxed);
  context_.store(context, std::memory_order_relaxed);
  done_.store(0, std::memory_order_relaxed);
  const std::uint64_t number = (offer_.load(std::memory_order_relaxed) >> kItemBits) + 1;
  offer_.store(number << kItemBits, std::memory_order_release);
  while (take_portion()) {
  }
  for (int turn = 1; done_.load(std::memory_order_acquire) != count; ++turn)
    turn % kPatience == 0 ? static_cast<void>(sched_yield()) : breathe();
  // Nothing of this number can be taken from now on, whatever the next piece of work has as its count.
  offer_.store(offer_.load(std::memory_order_relaxed) | kItems, std::memory_order_relaxed);
}

/// @return false if nothing is left to take
bool Crew::take_portion() noexcept {
  std::uint64_t offer = offer_.load(std::memory_order_acquire);
  for (;;) {
    const std::size_t begin = offer & kItems;
    const std::size_t count = count_.load(std::memory_order_relaxed);
    const Work work = work_.load(std::memory_order_relaxed);
    void* const context = context_.load(std::memory_order_relaxed);
    if (begin >= count) return false;
    const std::size_t end = std::min(begin + kPortion, count);
    const std::uint64_t taken = (offer & ~kItems) | end;
    if (!offer_.compare_exchange_weak(offer, taken, std::memory_order_acq_rel, std::memory_order_acquire))
      continue;
    work(context, begin, end);
    done_.fetch_add(end - begin, std::memory_order_release);
    return true;
  }
}

void Crew::help() noexcept {
  int idle = 0;
  while (!ending_.load(std::memory_order_relaxed)) {
    const std::uint32_t call = call_.load(std::memory_order_acquire);
    if (open(call)) {
      if (!take_portion()) breathe();
      idle = 0;
    } else if (++idle < kAwake) {
      breathe();
    } else {
      call_.wait(call, std::memory_order_acquire);
      idle = 0;
    }
  }
}

}  // namespace lockstep
