/// The thread that takes telegrams of leading values from an LCM network.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <vector>

#include "hmi_bridge/lcm/leading_values.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/receiver.hpp"
#include "hmi_bridge/lcm/telegram_memory.hpp"
#include "hmi_bridge/network/network.hpp"
#include "scheduler/shared_clock.hpp"
#include "scheduler/telegram_ring.hpp"
#include "tech_objects/leading_values/carrier_counts.hpp"

namespace lockstep {

/// Hears the channels of some areas, judges what comes and puts telegrams that count into rings, from which
/// the cycle takes them. Whatever others send to the network is counted and of no other effect; a flood costs
/// a part of one processor at most, and what finds no space then is lost.
class LeadingValueReceiver {
 public:
  struct Area {
    LeadingValueLink link;               ///< its area is the channel
    std::vector<IpNetwork> from{};       ///< of the sender; empty: any
    std::vector<TelegramRing*> rings{};  ///< of the proxies that take the telegrams
    CarrierCounts* counts = nullptr;
    std::string controller{};  ///< that receives
    std::string proxies{};     ///< names of its proxies, for whoever looks at the network
  };
  static constexpr std::int64_t kTell = 1'000'000'000;  ///< between two messages of what has come [ns]
  static constexpr int kPriority = 78;                  ///< of SCHED_FIFO, as far as it is permitted

  /// Joins the network. Rings, counts and clock outlive this; times in the rings are those of
  /// CLOCK_MONOTONIC.
  /// @throws as LcmPublisher and LcmReceiver
  LeadingValueReceiver(const std::string& url, std::vector<Area> areas, ClockWatch& clock);
  LeadingValueReceiver(const LeadingValueReceiver&) = delete;
  LeadingValueReceiver& operator=(const LeadingValueReceiver&) = delete;
  ~LeadingValueReceiver();  ///< stops

  /// What comes on the channels of the areas is kept there, which outlives this. Before `start`.
  void keep_in(TelegramMemory& memory) noexcept { memory_ = &memory; }
  void start();
  void stop();
  /// The LCM instance, to publish on where the network is this process.
  lcm_t* instance() noexcept { return joined_.instance(); }

 private:
  struct Receiving {
    LeadingValueReader reader;
    std::vector<IpNetwork> from;
    std::vector<TelegramRing*> rings;
    CarrierCounts* counts;
    std::string channel;        // on which is told what has come; empty: nothing is
    leading_proxies_t told{};   // without its counts
    std::uint64_t foreign = 0;  // by their address
  };
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };

  void run() noexcept;
  void take(const LcmMessage& message);
  void accept(Receiving& area, LeadingValueTelegram telegram);
  void tell(std::int64_t now);
  void tell(Receiving& area);
  static void count(const Receiving& area) noexcept;
  static bool is_from(const Receiving& area, const LcmMessage& message) noexcept;

  std::unordered_map<std::string, Receiving, Hash, std::equal_to<>> areas_;  // by channel
  ClockWatch& clock_;
  TelegramMemory* memory_ = nullptr;
  LcmPublisher joined_;  // publishes no rows; it joins and tells why it cannot
  LcmReceiver receiver_;
  std::int64_t told_ = 0;  // [ns]
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lockstep
