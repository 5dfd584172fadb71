#include "hmi_bridge/lcm/leading_value_sender.hpp"

#include <pthread.h>

#include <algorithm>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"
#include "scheduler/real_time_rights.hpp"
#include "scheduler/waiting_clock.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kBehindTick = 30'000;       // [ns] when a tick has put its telegram at the earliest
constexpr std::int64_t kSilent = 1'000'000'000;    // [ns] without telegrams, after which nobody hurries
constexpr std::int64_t kLongestWait = 20'000'000;  // [ns] how long the end of a run may wait for this thread

}  // namespace

LeadingValueSender::LeadingValueSender(const std::string& url, std::vector<Area> areas, std::int64_t run,
                                       ClockWatch& clock, bool looks)
    : joined_(url, LcmTraceIdentity{"leading values", "LEADING_VALUES", 0, 0}, false),
      clock_(clock),
      looks_(looks) {
  areas_.reserve(areas.size());
  for (Area& area : areas) {
    std::string channel = area.link.area;
    areas_.push_back({LeadingValueWriter(std::move(area.link), run), area.ring, std::move(channel)});
  }
}

LeadingValueSender::~LeadingValueSender() {
  stop();
}

void LeadingValueSender::start() {
  thread_ = std::thread([this] { run(); });
  give_priority(thread_.native_handle(), kPriority);
}

void LeadingValueSender::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void LeadingValueSender::run() noexcept {
  pthread_setname_np(pthread_self(), "leading out");  // for top and strace
  block_write_signals();
  WaitingClock& clock = monotonic_clock();
  while (!stop_) {
    send_all();
    const std::int64_t now = clock.now();
    if (looks_) clock_.look(now);
    const std::int64_t look = now - last_sent_ > kSilent ? kIdleLook : kLook;
    clock.sleep_until(std::min(std::max(next_, now + look), now + kLongestWait));
  }
  send_all();
}

void LeadingValueSender::send_all() noexcept {
  for (Sending& area : areas_)
    area.ring->take([&](const LeadingValueTelegram& telegram) { send(area, telegram); });
}

/// A clock that is not to be trusted makes the value invalid for whoever hears it.
void LeadingValueSender::send(Sending& area, LeadingValueTelegram telegram) noexcept {
  next_ = telegram.time + telegram.cycle + kBehindTick;
  last_sent_ = telegram.time;
  telegram.time += clock_.offset();
  if (!clock_.trusted()) telegram.valid = false;
  const auto bytes = area.writer.write(telegram);
  const int status = lcm_publish(joined_.instance(), area.channel.c_str(), bytes.data(),
                                 static_cast<unsigned>(bytes.size()));
  if (memory_ != nullptr) memory_->add(area.channel, bytes);
  (status == 0 ? sent_.telegrams : sent_.failed).fetch_add(1, std::memory_order_relaxed);
}

}  // namespace lockstep
