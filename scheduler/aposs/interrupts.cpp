#include "scheduler/aposs/interrupts.hpp"

#include "scheduler/aposs/arithmetic.hpp"

namespace lockstep::aposs {
namespace {

constexpr int kTooManyInterrupts = 149;
constexpr int kTooManyTimes = 184;

std::uint32_t magnitude(std::int32_t number) noexcept {
  return static_cast<std::uint32_t>(absolute(number));
}

PositionSource source_of(PositionInterrupt which) noexcept {
  return static_cast<PositionSource>(which / 2);
}

/// A distance within half a period to either side.
std::int64_t shortest(std::int64_t distance, std::int64_t period) noexcept {
  if (period <= 0) return distance;
  std::int64_t rest = distance % period;
  if (rest >= (period + 1) / 2) rest -= period;
  if (rest < -(period / 2)) rest += period;
  return rest;
}

}  // namespace

bool passed(std::int32_t from, std::int32_t to, std::int32_t at, bool negative,
            std::int64_t period) noexcept {
  std::int64_t distance = shortest(std::int64_t{to} - from, period);
  std::int64_t up_to = std::int64_t{at} - from;
  if (negative) {
    distance = -distance;
    up_to = -up_to;
  }
  if (distance <= 0) return false;
  if (period > 0) {  // the next place of that name ahead
    up_to %= period;
    if (up_to <= 0) up_to += period;
  }
  return up_to > 0 && up_to <= distance;
}

void Interrupts::clear() noexcept {
  for (Edges& list : edges_) list.clear();
  positions_.clear();
  parameters_.clear();
  timers_.clear();
  disabled_.fill(false);
}

int Interrupts::define_edge(EdgeSource source, std::int32_t number, Entry entry, Device& device) noexcept {
  Edges& list = edges(source);
  const bool level = device.level(source, absolute(number));
  for (Edge& edge : list) {
    // The two edges of an input cannot both be watched; those of a bit can.
    const bool same =
        source == EdgeSource::kInput ? magnitude(edge.number) == magnitude(number) : edge.number == number;
    if (!same) continue;
    edge.number = number;
    edge.entry = entry;
    return 0;
  }
  if (list.full()) return kTooManyInterrupts;
  list.push({number, entry, level, false});
  return 0;
}

int Interrupts::define_position(PositionInterrupt which, std::int32_t at, Entry entry,
                                Device& device) noexcept {
  for (Position& position : positions_) {
    if (position.which != which || position.at != at) continue;
    position.entry = entry;
    return 0;
  }
  if (positions_.full()) return kTooManyInterrupts;
  positions_.push({which, at, device.position(source_of(which)).value, entry, false});
  return 0;
}

int Interrupts::define_parameter(std::int32_t number, Entry entry, Device& device) noexcept {
  for (Parameter& parameter : parameters_) {
    if (parameter.number != number) continue;
    parameter.entry = entry;
    return 0;
  }
  if (parameters_.full()) return kTooManyInterrupts;
  parameters_.push({number, device.changes(number), entry, false});
  return 0;
}

int Interrupts::define_timer(const Timer& timer) noexcept {
  for (Timer& other : timers_)
    if (other.entry == timer.entry && (other.period == 0) == (timer.period == 0)) {
      other = timer;
      return 0;
    }
  if (timers_.full()) return kTooManyTimes;
  timers_.push(timer);
  return 0;
}

int Interrupts::define_time(std::int32_t after, Entry entry, std::int64_t now) noexcept {
  return define_timer({now + after, 0, entry});
}

int Interrupts::define_period(std::int32_t period, Entry entry, std::int64_t now) noexcept {
  if (period > 0) return define_timer({now + period, period, entry});
  for (Timer* timer = timers_.begin(); timer != timers_.end(); ++timer)
    if (timer->entry == entry && timer->period != 0) {
      timers_.erase(timer);
      break;
    }
  return 0;
}

void Interrupts::delete_positions(Entry entry) noexcept {
  for (Position* position = positions_.begin(); position != positions_.end();)
    if (position->entry == entry)
      positions_.erase(position);
    else
      ++position;
}

void Interrupts::compare_edges(EdgeSource source, InterruptClass which, Device& device) noexcept {
  for (Edge& edge : edges(source)) {
    const bool level = device.level(source, absolute(edge.number));
    const bool comes = level != edge.level && level == (edge.number > 0);
    edge.level = level;
    // An edge while its class is disabled is forgotten; all others are remembered, once each.
    if (comes && !disabled(which)) edge.pending = true;
  }
}

void Interrupts::compare(Device& device) noexcept {
  compare_edges(EdgeSource::kInput, InterruptClass::kInput, device);
  compare_edges(EdgeSource::kCombit, InterruptClass::kCombit, device);
  compare_edges(EdgeSource::kStatbit, InterruptClass::kStatbit, device);
  for (Position& position : positions_) {
    const PositionReading reading = device.position(source_of(position.which));
    if (passed(position.last, reading.value, position.at, position.which % 2 != 0, reading.period))
      position.pending = true;
    position.last = reading.value;
  }
  for (Parameter& parameter : parameters_) {
    const std::uint32_t changes = device.changes(parameter.number);
    if (changes != parameter.changes) parameter.pending = true;
    parameter.changes = changes;
  }
}

std::optional<Interrupts::Entry> Interrupts::take_edge(EdgeSource source, InterruptClass which) noexcept {
  if (disabled(which)) return std::nullopt;
  Edge* next = nullptr;
  for (Edge& edge : edges(source))
    if (edge.pending && (next == nullptr || magnitude(edge.number) < magnitude(next->number))) next = &edge;
  if (next == nullptr) return std::nullopt;
  next->pending = false;
  return next->entry;
}

template <class List>
std::optional<Interrupts::Entry> Interrupts::take_first(List& list, InterruptClass which) noexcept {
  if (disabled(which)) return std::nullopt;
  for (auto& one : list) {
    if (!one.pending) continue;
    one.pending = false;
    return one.entry;
  }
  return std::nullopt;
}

std::optional<Interrupts::Entry> Interrupts::take_timer(std::int64_t now) noexcept {
  for (Timer* timer = timers_.begin(); timer != timers_.end(); ++timer) {
    const bool once = timer->period == 0;
    if (timer->due > now || disabled(once ? InterruptClass::kTime : InterruptClass::kPeriod)) continue;
    const Entry entry = timer->entry;
    if (once)
      timers_.erase(timer);
    else
      timer->due += timer->period;  // from when it was due: the periods do not drift
    return entry;
  }
  return std::nullopt;
}

std::optional<Interrupts::Entry> Interrupts::take(std::int64_t now, bool looks) noexcept {
  if (disabled(InterruptClass::kAll)) return std::nullopt;
  if (const auto entry = take_edge(EdgeSource::kInput, InterruptClass::kInput)) return entry;
  if (const auto entry = take_first(positions_, InterruptClass::kPosition)) return entry;
  if (const auto entry = take_edge(EdgeSource::kCombit, InterruptClass::kCombit)) return entry;
  if (const auto entry = take_edge(EdgeSource::kStatbit, InterruptClass::kStatbit)) return entry;
  if (const auto entry = take_first(parameters_, InterruptClass::kParameter)) return entry;
  return looks ? take_timer(now) : std::nullopt;
}

}  // namespace lockstep::aposs
