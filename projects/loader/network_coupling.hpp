/// What crosses to other processes.
#pragma once

#include <vector>

#include "hmi_bridge/lcm/leading_values.hpp"
#include "hmi_bridge/network/network.hpp"
#include "projects/keys/network.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

namespace lockstep {

/// A leading value that goes out.
struct SentArea {
  LeadingValueLink link{};  ///< without its key
  const LeadingObject* from = nullptr;
};

/// One that comes in.
struct ReceivedArea {
  LeadingValueLink link{};           ///< without its key
  std::vector<IpNetwork> senders{};  ///< from which it may come; empty: from any
  std::vector<LeadingAxisProxy*> to{};
};

/// What crosses to other processes over one network.
struct NetworkCoupling {
  NetworkConfig network{};  ///< `key_file` as it can be opened
  std::vector<SentArea> sent{};
  std::vector<ReceivedArea> received{};
};

}  // namespace lockstep
