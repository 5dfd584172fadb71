/// Messages of an LCM network, received by a socket of our own. LCM's own reassembly believes what a datagram
/// claims, and one that lies ends the process, so that liblcm sends and writes logs, and receives only what
/// this process has sent itself (memq://).
#pragma once

#include <lcm/lcm.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/reassembly.hpp"

namespace lockstep {

/// Joins the network of a publisher. One thread at a time.
class LcmReceiver {
 public:
  /// Takes a message, whose memory lasts as long as the call.
  using Handler = std::function<void(const LcmMessage&)>;

  /// @param joined tells the URL; outlives this  @param channel the only one that is heard; empty: all
  /// @param bounds of messages in fragments
  /// @throws std::runtime_error that names the URL where the network cannot be joined
  LcmReceiver(LcmPublisher& joined, std::string channel, LcmBounds bounds, Handler handler);
  LcmReceiver(const LcmReceiver&) = delete;
  LcmReceiver& operator=(const LcmReceiver&) = delete;
  ~LcmReceiver();

  /// Readable when something waits, for poll().
  int descriptor() const noexcept;
  /// Takes what waits and hands the messages on; does not wait. @param maximum datagrams  @return how many
  int take(int maximum);

  const LcmDatagramCounters& counters() const noexcept { return reassembly_.counters(); }

 private:
  static void take_own(const lcm_recv_buf_t* buffer, const char* channel, void* self) noexcept;
  bool take_datagram();
  void hand_on(const LcmMessage& message);

  lcm_t* own_ = nullptr;  // memq://: the messages of this process
  int socket_ = -1;
  const std::string channel_;
  const Handler handler_;
  LcmReassembly reassembly_;
  std::unique_ptr<std::uint8_t[]> datagram_;
};

}  // namespace lockstep
