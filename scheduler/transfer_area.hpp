/// Where the leading value of an object goes.
/// @source S7-1500T synchronous operation V7, 10.3
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scheduler/telegram_ring.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

namespace lockstep {

/// What takes telegrams.
inline constexpr ObjectKinds kLeadingAxisProxy = static_cast<ObjectKinds>(ObjectKind::TO_LeadingAxisProxy);

/// Where the ends of a transfer area are.
enum class TransferDirection : std::uint8_t {
  within,  ///< both in this controller
  send,    ///< the source is here
  receive  ///< the proxies are here
};

/// By which interface of a leading object telegrams go to proxies. Made at load time.
struct TransferArea {
  struct Receiver {
    LeadingAxisProxy* proxy = nullptr;
    std::unique_ptr<TelegramRing> ring{};  ///< telegrams under way
  };

  std::string name;
  LeadingObject* from = nullptr;
  int interface = 1;  ///< index of CrossPlcSynchronousOperation.Interface, from 1
  TransferDirection direction = TransferDirection::within;
  std::string channel;     ///< of the network, where one end is elsewhere
  std::string controller;  ///< that sends, where the source is elsewhere
  std::string source;      ///< its leading object
  std::vector<Receiver> to{};

  bool leads(const TechnologyObject* proxy) const noexcept {
    for (const Receiver& receiver : to)
      if (receiver.proxy == proxy) return true;
    return false;
  }
};

/// Where the counts of telegrams are shown that go out over networks; nullptr: nobody asks.
struct SentTelegramTags {
  std::uint64_t* sent = nullptr;
  std::uint64_t* failed = nullptr;
  std::uint64_t* dropped = nullptr;
  std::uint64_t* clock_losses = nullptr;
};

}  // namespace lockstep
