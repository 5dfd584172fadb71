#include "hmi_bridge/lcm/leading_value_receiver.hpp"

#include <poll.h>
#include <pthread.h>

#include <chrono>
#include <utility>
#include <vector>

#include "hmi_bridge/network/write_signals.hpp"
#include "scheduler/real_time_rights.hpp"
#include "scheduler/waiting_clock.hpp"

namespace lockstep {
namespace {

constexpr int kPollTelegrams = 20;                // how long the end of a run may wait for this thread
constexpr int kTelegramBurst = 256;               // datagrams taken at a time
constexpr std::int64_t kTelegramPause = 500'000;  // behind so many, in which others come first [ns]
constexpr LcmBounds kNoFragments{.message = 0};   // a telegram fits a datagram

void set(CarrierCounts::Count& count, std::uint64_t value) noexcept {
  count.store(value, std::memory_order_relaxed);
}

}  // namespace

LeadingValueReceiver::LeadingValueReceiver(const std::string& url, std::vector<Area> areas, ClockWatch& clock)
    : clock_(clock),
      joined_(url, LcmTraceIdentity{"leading values", "LEADING_VALUES", 0, 0}, false),
      receiver_(joined_, "", kNoFragments, [this](const LcmMessage& message) { take(message); }) {
  for (Area& area : areas) {
    std::string channel = area.link.area;
    Receiving receiving{LeadingValueReader(std::move(area.link)),
                        std::move(area.from),
                        std::move(area.rings),
                        area.counts,
                        {}};
    receiving.told.area = channel;
    receiving.told.controller = std::move(area.controller);
    receiving.told.proxies = std::move(area.proxies);
    if (channel.size() + kProxiesSuffix.size() <= LcmReassembly::kLongestChannel)
      receiving.channel = channel + std::string(kProxiesSuffix);
    areas_.emplace(std::move(channel), std::move(receiving));
  }
}

LeadingValueReceiver::~LeadingValueReceiver() {
  stop();
}

void LeadingValueReceiver::start() {
  thread_ = std::thread([this] { run(); });
  give_priority(thread_.native_handle(), kPriority);
}

void LeadingValueReceiver::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void LeadingValueReceiver::run() noexcept {
  pthread_setname_np(pthread_self(), "leading in");  // for top and strace
  block_write_signals();
  WaitingClock& clock = monotonic_clock();
  while (!stop_) {
    clock_.look(clock.now());
    try {
      tell(clock.now());
    } catch (...) {  // there is no memory for it: it is told a second later
    }
    pollfd source{receiver_.descriptor(), POLLIN, 0};
    if (poll(&source, 1, kPollTelegrams) <= 0) continue;
    int taken = 0;
    try {
      taken = receiver_.take(kTelegramBurst);
    } catch (...) {  // a message for which there is no memory is lost
    }
    if (taken >= kTelegramBurst) clock.sleep_until(clock.now() + kTelegramPause);
  }
}

bool LeadingValueReceiver::is_from(const Receiving& area, const LcmMessage& message) noexcept {
  if (area.from.empty() || message.sender.empty()) return true;
  for (const IpNetwork& network : area.from)
    if (network.contains(message.address)) return true;
  return false;
}

void LeadingValueReceiver::take(const LcmMessage& message) {
  const auto found = areas_.find(message.channel);
  if (found == areas_.end()) return;
  Receiving& area = found->second;
  if (memory_ != nullptr) memory_->add(message.channel, message.data);
  if (is_from(area, message)) {
    const std::int64_t now = monotonic_clock().now() + clock_.offset();
    if (const auto telegram = area.reader.read(message.data, now)) accept(area, *telegram);
  } else {
    ++area.foreign;
  }
  count(area);
}

/// The times of one that counts are those of this machine from here on.
void LeadingValueReceiver::accept(Receiving& area, LeadingValueTelegram telegram) {
  if (!clock_.trusted()) {
    area.counts->untrusted.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  telegram.time -= clock_.offset();
  for (TelegramRing* const ring : area.rings)
    if (!ring->put(telegram)) area.counts->dropped.fetch_add(1, std::memory_order_relaxed);
}

void LeadingValueReceiver::tell(std::int64_t now) {
  if (now - told_ < kTell) return;
  told_ = now;
  for (auto& [channel, area] : areas_)
    if (!area.channel.empty()) tell(area);
}

void LeadingValueReceiver::tell(Receiving& area) {
  leading_proxies_t& told = area.told;
  const auto number = [](const CarrierCounts::Count& count) {
    return static_cast<std::int64_t>(count.load(std::memory_order_relaxed));
  };
  const CarrierCounts& counts = *area.counts;
  told.utime = std::chrono::duration_cast<std::chrono::microseconds>(
                   std::chrono::system_clock::now().time_since_epoch())
                   .count();
  told.accepted = number(counts.accepted);
  told.malformed = number(counts.malformed);
  told.foreign = number(counts.foreign);
  told.not_signed = number(counts.not_signed);
  told.repeated = number(counts.repeated);
  told.ambiguous = number(counts.ambiguous);
  told.stale = number(counts.stale);
  told.untrusted = number(counts.untrusted);
  told.dropped = number(counts.dropped);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(told.getEncodedSize()));
  told.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  lcm_publish(joined_.instance(), area.channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
}

void LeadingValueReceiver::count(const Receiving& area) noexcept {
  const LeadingValueCounters& from = area.reader.counters();
  CarrierCounts& to = *area.counts;
  set(to.accepted, from.accepted);
  set(to.malformed, from.malformed);
  set(to.foreign, from.foreign + area.foreign);
  set(to.not_signed, from.not_signed);
  set(to.repeated, from.repeated);
  set(to.ambiguous, from.ambiguous);
  set(to.stale, from.stale);
}

}  // namespace lockstep
