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

Crew::Crew(int helpers) : shares_(static_cast<std::size_t>(helpers) + 1) {
  helpers_.reserve(static_cast<std::size_t>(helpers));
  for (std::size_t i = 1; i < shares_.size(); ++i) {
    helpers_.emplace_back([this, i] { help(i); });
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
  ++number_;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    shares_[i].offer.store(number_ << kItemBits | begin_of(i, count), std::memory_order_release);
  while (take_portion(0)) {
  }
  for (int turn = 1; done_.load(std::memory_order_acquire) != count; ++turn)
    turn % kPatience == 0 ? static_cast<void>(sched_yield()) : breathe();
  // Nothing of this number can be taken from now on, whatever the next piece of work has as its count.
  for (Share& share : shares_) share.offer.store(number_ << kItemBits | kItems, std::memory_order_relaxed);
}

std::size_t Crew::begin_of(std::size_t share, std::size_t count) const noexcept {
  const std::size_t portions = (count + kPortion - 1) / kPortion;
  return std::min(share * portions / shares_.size() * kPortion, count);
}

/// Of the own share, then of those of the others, once the own one has been offered too.
/// @return false if nothing is left to take
bool Crew::take_portion(std::size_t own) noexcept {
  const std::uint64_t number = shares_[own].offer.load(std::memory_order_acquire) >> kItemBits;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    if (take_portion_of((own + i) % shares_.size(), number)) return true;
  return false;
}

bool Crew::take_portion_of(std::size_t share, std::uint64_t number) noexcept {
  std::atomic<std::uint64_t>& offered = shares_[share].offer;
  std::uint64_t offer = offered.load(std::memory_order_acquire);
  for (;;) {
    if (offer >> kItemBits != number) return false;
    const std::size_t begin = offer & kItems;
    const std::size_t count = count_.load(std::memory_order_relaxed);
    const Work work = work_.load(std::memory_order_relaxed);
    void* const context = context_.load(std::memory_order_relaxed);
    const std::size_t behind = begin_of(share + 1, count);
    if (begin >= behind) return false;
    const std::size_t end = std::min(begin + kPortion, behind);
    const std::uint64_t taken = (offer & ~kItems) | end;
    if (!offered.compare_exchange_weak(offer, taken, std::memory_order_acq_rel, std::memory_order_acquire))
      continue;
    work(context, begin, end);
    done_.fetch_add(end - begin, std::memory_order_release);
    return true;
  }
}

void Crew::help(std::size_t own) noexcept {
  int idle = 0;
  while (!ending_.load(std::memory_order_relaxed)) {
    const std::uint32_t call = call_.load(std::memory_order_acquire);
    if (open(call)) {
      if (!take_portion(own)) breathe();
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
