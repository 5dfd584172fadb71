/// What carries the leading values of a run to other processes and back.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/leading_value_receiver.hpp"
#include "hmi_bridge/lcm/leading_value_sender.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/messages.hpp"
#include "scheduler/shared_clock.hpp"

namespace lockstep {

/// One network of a run: its rings, which are added to the controller, its clock and its threads. Thread: the
/// owner. The cycle must have ended before this does.
class LeadingValueExchange {
 public:
  /// Reads the key and joins the network; nothing is sent yet. `project` outlives this.
  /// @throws CouldNotStart with what is wrong and why
  LeadingValueExchange(Project& project, const NetworkCoupling& coupling, Messages& messages);
  LeadingValueExchange(const LeadingValueExchange&) = delete;
  LeadingValueExchange& operator=(const LeadingValueExchange&) = delete;

  /// What goes out and comes in is kept there, which outlives this. Before `start`.
  void keep_in(TelegramMemory& memory) noexcept;
  /// Telegrams that go out and come in, in a second.
  double rate() const noexcept { return rate_; }
  void start();
  /// Sends what the last tick has put, and ends the threads.
  void end();

  /// What the clock shows more than that by which the cycle waits [ns].
  std::int64_t clock_offset() const noexcept { return watch_.offset(); }
  /// Tells that the clock is not to be trusted any more, or is again.
  void look();
  /// After `end`: what was lost on the way, and came from where it should not.
  void tell_losses();
  /// Where time 0 of the controller is on the common clock. @param start on that of the cycle [ns]
  std::string started(std::int64_t start) const;

 private:
  struct Incoming {
    std::string name;  // of the proxies, for messages
    CarrierCounts counts;
  };
  std::vector<LeadingValueSender::Area> outgoing(Project& project, const NetworkCoupling& coupling,
                                                 const SharedKey& key);
  std::vector<LeadingValueReceiver::Area> incoming(Project& project, const NetworkCoupling& coupling,
                                                   const SharedKey& key);
  void show_counts(Project& project) const;
  TelegramRing& add_ring() { return *rings_.emplace_back(std::make_unique<TelegramRing>()); }

  const NetworkConfig network_;
  Messages& messages_;
  std::unique_ptr<SharedClock> clock_;
  ClockWatch watch_;
  bool told_untrusted_ = false;
  double rate_ = 0.0;  // [1/s] of what goes out; what comes in is taken to be as fast
  std::vector<std::unique_ptr<TelegramRing>> rings_;
  std::vector<TelegramRing*> sent_rings_;
  std::vector<std::unique_ptr<Incoming>> incoming_;
  std::unique_ptr<LeadingValueSender> sender_;      // none without what goes out
  std::unique_ptr<LeadingValueReceiver> receiver_;  // none without what comes in
};

}  // namespace lockstep
