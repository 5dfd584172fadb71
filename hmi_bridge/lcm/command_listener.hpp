/// The thread that takes commands from an LCM network.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/receiver.hpp"
#include "hmi_bridge/lcm/shared_desk.hpp"

namespace lockstep {

/// Listens on CHANNEL_CMD and tells on CHANNEL_PANEL how the axes stand; a desk judges what comes. Only a
/// project that says so has one; without it nothing is subscribed to.
class CommandListener {
 public:
  /// Joins the network. @param desk outlives this  @throws as LcmPublisher and LcmReceiver
  CommandListener(const std::string& url, LcmTraceIdentity identity, SharedDesk& desk);
  CommandListener(const CommandListener&) = delete;
  CommandListener& operator=(const CommandListener&) = delete;
  ~CommandListener();  ///< stops

  void start();
  /// Ends the thread; after it `faults` may be read.
  void stop();
  std::uint64_t faults() const noexcept { return faults_; }

 private:
  void listen() noexcept;
  void beat();

  LcmTraceIdentity identity_;
  LcmPublisher joined_;  // publishes no rows; it joins and tells why it cannot
  LcmReceiver receiver_;
  SharedDesk& desk_;
  std::atomic<bool> stop_{false};
  std::uint64_t faults_ = 0;
  std::thread thread_;
};

}  // namespace lockstep
