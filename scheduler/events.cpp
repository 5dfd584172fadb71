#include "scheduler/events.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <thread>

#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

EventQueue::EventQueue(std::size_t size)
    : mask_(std::bit_ceil(std::max<std::size_t>(size, 2)) - 1), events_(mask_ + 1) {}

void EventQueue::push(const Event& event) noexcept {
  const std::uint64_t written = written_.load(std::memory_order_relaxed);
  if (written - read_.load(std::memory_order_acquire) > mask_) {
    lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);  // one writer
    return;
  }
  events_[written & mask_] = event;
  written_.store(written + 1, std::memory_order_release);
}

bool EventQueue::wait_for_space() const noexcept {
  const auto crowded = [this] {
    return written_.load(std::memory_order_relaxed) - read_.load(std::memory_order_acquire) > mask_ / 2;
  };
  while (crowded()) {
    if (closed_.load(std::memory_order_acquire)) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return true;
}

/// An object derives from its base alone, so that a pin of any kind of object holds the address of that.
std::uint16_t JobWatch::object() const noexcept {
  if (object_ == nullptr) return 0;
  const TechnologyObject* object = nullptr;
  // NOLINTNEXTLINE(bugprone-sizeof-expression): the pointer is what is copied
  std::memcpy(&object, object_, sizeof object);
  return object == nullptr ? std::uint16_t{0} : static_cast<std::uint16_t>(object->number);
}

JobWatch::JobWatch(const BlockType& type, Block& block, std::uint32_t instance)
    : instance_(instance), block_(&block) {
  const auto output = [&](std::string_view name) -> const void* {
    const Pin* const pin = type.find_pin(name);
    return pin == nullptr ? nullptr : pin->signal(block).address;
  };
  busy_ = static_cast<const bool*>(output("Busy"));
  execute_ = static_cast<const bool*>(output("Execute"));
  done_ = static_cast<const bool*>(output("Done"));
  aborted_ = static_cast<const bool*>(output("CommandAborted"));
  error_ = static_cast<const bool*>(output("Error"));
  error_id_ = static_cast<const WORD*>(output("ErrorID"));
  if (error_id_ == nullptr) error_ = nullptr;
  shifts_ =
      aborted_ != nullptr && (type.name.starts_with("MC_Offset") || type.name.starts_with("MC_Phasing"));
  // The object that carries it out: the first but the one that leads.
  for (const Pin& pin : type.pins) {
    if (pin.type != Type::AXIS || pin.name == "Master") continue;
    object_ = pin.signal(block).address;
    break;
  }
}

}  // namespace lockstep
