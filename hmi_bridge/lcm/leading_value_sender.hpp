/// The thread that sends telegrams of leading values over an LCM network.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/lcm/leading_values.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/telegram_memory.hpp"
#include "scheduler/shared_clock.hpp"
#include "scheduler/telegram_ring.hpp"

namespace lockstep {

/// What a controller has sent. Any thread.
struct LeadingValueSent {
  std::atomic<std::uint64_t> telegrams{0};
  std::atomic<std::uint64_t> failed{0};  ///< that the network has not taken
};

/// Takes the telegrams that the cycle has put into rings and sends each on the channel of its area. The cycle
/// wakes nobody: the time of a telegram tells when the next one is due, and then this thread looks.
class LeadingValueSender {
 public:
  struct Area {
    LeadingValueLink link;  ///< its area is the channel
    TelegramRing* ring = nullptr;
  };
  /// Of SCHED_FIFO, as far as it is permitted: a telegram is late as a tick is.
  static constexpr int kPriority = 78;
  static constexpr std::int64_t kLook = 50'000;         ///< from look to look once one is due [ns]
  static constexpr std::int64_t kIdleLook = 1'000'000;  ///< while none comes [ns]

  /// Joins the network. Rings and clock outlive this; times in the rings are those of CLOCK_MONOTONIC.
  /// @param run number of this process, chosen by chance  @param looks whether it looks after the clock
  /// @throws as LcmPublisher
  LeadingValueSender(const std::string& url, std::vector<Area> areas, std::int64_t run, ClockWatch& clock,
                     bool looks);
  LeadingValueSender(const LeadingValueSender&) = delete;
  LeadingValueSender& operator=(const LeadingValueSender&) = delete;
  ~LeadingValueSender();  ///< stops

  /// What goes out is kept there, which outlives this. Before `start`.
  void keep_in(TelegramMemory& memory) noexcept { memory_ = &memory; }
  void start();
  /// Sends what is there, and ends the thread.
  void stop();
  const LeadingValueSent& sent() const noexcept { return sent_; }
  /// The LCM instance, to subscribe on where the network is this process.
  lcm_t* instance() noexcept { return joined_.instance(); }

 private:
  struct Sending {
    LeadingValueWriter writer;
    TelegramRing* ring;
    std::string channel;
  };
  void run() noexcept;
  void send_all() noexcept;
  void send(Sending& area, LeadingValueTelegram telegram) noexcept;

  LcmPublisher joined_;  // publishes no rows; it joins and tells why it cannot
  std::vector<Sending> areas_;
  ClockWatch& clock_;
  const bool looks_;
  TelegramMemory* memory_ = nullptr;
  LeadingValueSent sent_;
  std::int64_t next_ = 0;       // [ns] when the next telegram is due
  std::int64_t last_sent_ = 0;  // [ns]
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lockstep
