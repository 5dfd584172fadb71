/// Where the leading value of an object goes.
/// @source S7-1500T synchronous operation V7, 10.3
#pragma once

#include <memory>
#include <string>

#include "scheduler/telegram_ring.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

namespace lockstep {

/// What takes telegrams.
inline constexpr ObjectKinds kLeadingAxisProxy = static_cast<ObjectKinds>(ObjectKind::TO_LeadingAxisProxy);

/// By which interface of a leading object telegrams go to a proxy. Made at load time.
struct TransferArea {
  std::string name;
  LeadingObject* from = nullptr;
  int interface = 1;  ///< index of CrossPlcSynchronousOperation.Interface, from 1
  LeadingAxisProxy* to = nullptr;
  std::unique_ptr<TelegramRing> ring{};  ///< telegrams under way
};

}  // namespace lockstep
