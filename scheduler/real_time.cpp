#include "scheduler/real_time.hpp"

#include <pthread.h>

#include <chrono>
#include <cstring>

#include "scheduler/processor.hpp"
#include "scheduler/real_time_rights.hpp"

namespace lockstep {
namespace {

constexpr int kOverrunsToStop = 3;                // in a row
constexpr std::chrono::milliseconds kCamPoll{1};  // how often the interpolation of cams looks for work
constexpr std::int64_t kLongestShutdown = 10'000'000'000;  // [ns] for bringing the axes to rest

template <class T>
void raise_to(std::atomic<T>& place, T value) noexcept {
  if (value > place.load(std::memory_order_relaxed)) place.store(value, std::memory_order_relaxed);
}

}  // namespace

RealTimeRun::RealTimeRun(Controller& controller, OverrunPolicy policy, std::int64_t duration, int processor,
                         WaitingClock& clock)
    : controller_(controller), policy_(policy), duration_(duration), processor_(processor), clock_(clock) {}

RealTimeRun::~RealTimeRun() {
  stop();
  wait();
}

std::vector<std::string> RealTimeRun::start() {
  std::vector<std::string> warnings;
  if (controller_.has_cams()) {
    controller_.interpolate_cams_elsewhere(true);
    interpolating_.store(true, std::memory_order_relaxed);
    interpolation_ = std::thread([this] { interpolate_cams(); });
  }
  const auto there = static_cast<int>(std::thread::hardware_concurrency());
  controller_.employ_processors(there);
  if (const int wanted = controller_.clock.processors; there > 0 && wanted > there)
    warnings.push_back("the project asks for " + std::to_string(wanted) +
                       " processors and this machine has " + std::to_string(there) +
                       ", which is what its ticks use");
  thread_ = std::thread([this] { run(); });
  if (processor_ >= 0)
    if (const int error = keep_on_processor(thread_.native_handle(), processor_); error != 0)
      warnings.push_back("the cycle cannot be kept on processor " + std::to_string(processor_) + " (" +
                         std::strerror(error) + "): it runs on the others");
  const int memory = lock_memory();
  rights_.memory = memory == 0;
  if (!rights_.memory)
    warnings.push_back(std::string("memory cannot be locked (") + std::strerror(memory) +
                       "): a page fault may delay a tick");
  const int priority = give_priority(thread_.native_handle(), kCyclePriority);
  rights_.priority = priority == 0;
  if (!rights_.priority)
    warnings.push_back(std::string("real-time priority is not permitted (") + std::strerror(priority) +
                       "): other processes may delay a tick");
  // One below the cycle, so that a helper never keeps it from a processor that both may use.
  for (const pthread_t helper : controller_.helping_threads()) give_priority(helper, kCyclePriority - 1);
  return warnings;
}

void RealTimeRun::wait() {
  may_end_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
  interpolating_.store(false, std::memory_order_relaxed);
  if (!interpolation_.joinable()) return;
  interpolation_.join();
  controller_.interpolate_cams_elsewhere(false);
}

/// Looks for work now and then, so that the cycle never has to wake it.
void RealTimeRun::interpolate_cams() noexcept {
  while (interpolating_.load(std::memory_order_relaxed))
    if (!controller_.interpolate_cams()) std::this_thread::sleep_for(kCamPoll);
}

/// When the first tick is due.
std::int64_t RealTimeRun::first_tick() noexcept {
  std::int64_t start = clock_.now() + controller_.clock.servo_cycle;
  if (aligned_to_ > 0) {
    const std::int64_t beyond = (start + shared_offset_) % aligned_to_;
    if (beyond != 0) start += aligned_to_ - beyond;
    controller_.shared_time_at_start = start;
  }
  status_.start.store(start, std::memory_order_relaxed);
  return start;
}

void RealTimeRun::run() noexcept {
  pthread_setname_np(pthread_self(), "cycle");  // for top and strace
  const std::int64_t cycle = controller_.clock.servo_cycle;
  const std::int64_t start = first_tick();
  bool shutting_down = false;
  std::int64_t shutdown_begin = 0;
  for (;;) {
    const std::int64_t t = controller_.now();
    const std::int64_t due = start + t;
    clock_.sleep_until(due);
    const std::int64_t begin = clock_.now();
    raise_to(status_.worst_lateness, begin - due);

    const bool ended = duration_ >= 0 && t >= duration_;
    if (!shutting_down && (ended || stop_requested_.load(std::memory_order_relaxed) ||
                           status_.stopped_by_overrun.load(std::memory_order_relaxed))) {
      controller_.shut_down();
      if (ended) controller_.trace = nullptr;  // which has as many rows as were asked for
      shutting_down = true;
      shutdown_begin = t;
    }
    const bool at_rest = shutting_down && (controller_.at_rest() || t - shutdown_begin > kLongestShutdown);
    if (at_rest) {
      controller_.trace = nullptr;  // what follows is a wait for who serves the last clients
      status_.at_rest.store(true, std::memory_order_release);
    }
    const bool last = at_rest && may_end_.load(std::memory_order_acquire);
    const bool interpolator_tick = controller_.interpolator_is_due();
    controller_.tick();
    status_.ticks.fetch_add(1, std::memory_order_relaxed);
    status_.time.store(t, std::memory_order_relaxed);

    const std::int64_t end = clock_.now();
    raise_to(status_.longest_tick, end - begin);
    // This thread alone writes it.
    status_.busy.store(status_.busy.load(std::memory_order_relaxed) + (end - begin),
                       std::memory_order_relaxed);
    const std::int64_t late = end - (due + cycle);
    // The grid of ticks stays; those whose time has passed are left out.
    const std::int64_t missed = late > 0 ? (late + cycle - 1) / cycle : 0;
    if (missed > 0) {
      controller_.skip(missed);
      status_.missed_ticks.fetch_add(static_cast<std::uint64_t>(missed), std::memory_order_relaxed);
    }
    if (interpolator_tick || missed > 0) count_overrun(end - due > controller_.clock.interpolator_cycle());
    if (last) break;
  }
}

void RealTimeRun::count_overrun(bool overrun) noexcept {
  overruns_in_a_row_ = overrun ? overruns_in_a_row_ + 1 : 0;
  if (overrun) status_.overruns.fetch_add(1, std::memory_order_relaxed);
  if (overrun) controller_.count_overrun();
  if (policy_ == OverrunPolicy::stop && overruns_in_a_row_ >= kOverrunsToStop)
    status_.stopped_by_overrun.store(true, std::memory_order_relaxed);
}

}  // namespace lockstep
