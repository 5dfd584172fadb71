/// The thread that takes commands from an LCM network.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/lcm/command_desk.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/receiver.hpp"
#include "hmi_bridge/traces/event.hpp"

namespace lockstep {

/// Listens on CHANNEL_CMD and tells on CHANNEL_PANEL how the axes stand. Its answers are events, which go
/// where those of the cycle go. Only a project that says so has one; without it nothing is subscribed to.
class CommandListener {
 public:
  static constexpr std::chrono::milliseconds kBeat{100};

  /// Takes an answer; on the listener's thread.
  using Answers = std::function<void(TraceEvent)>;

  /// Joins the network. @param image of the axes' signals; outlives this  @param servo_cycle [ns]
  /// @throws as LcmPublisher and LcmReceiver
  CommandListener(const std::string& url, LcmTraceIdentity identity, std::vector<CommandAxis> axes,
                  ProcessImage& image, std::int64_t servo_cycle, Answers answers);
  CommandListener(const CommandListener&) = delete;
  CommandListener& operator=(const CommandListener&) = delete;
  ~CommandListener();  ///< stops

  /// Commands, carried out or refused, are told to a log, which outlives this. Before `start`.
  void audit_to(AuditLog& log);
  void start();
  /// Ends the thread; after it `counters` may be read.
  void stop();
  const CommandCounters& counters() const noexcept { return desk_.counters(); }
  std::uint64_t faults() const noexcept { return faults_; }

 private:
  void take(const LcmMessage& message);
  void listen() noexcept;
  void beat();
  void tell(const CommandDesk::Answer& answer);
  std::int64_t time() const noexcept;

  LcmTraceIdentity identity_;
  LcmPublisher joined_;  // publishes no rows; it joins and tells why it cannot
  LcmReceiver receiver_;
  ProcessImage& image_;
  CommandDesk desk_;
  std::string_view sender_;  // of the message at hand
  const std::int64_t servo_cycle_;
  const Answers answers_;
  std::atomic<bool> stop_{false};
  std::uint64_t faults_ = 0;
  std::thread thread_;
};

}  // namespace lockstep
