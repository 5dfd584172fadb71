#include "hmi_bridge/lcm/event_messages.hpp"

#include <string_view>

#include "hmi_bridge/lcm/wire.hpp"
#include "lockstep/event_detail_t.hpp"
#include "lockstep/event_t.hpp"

namespace lockstep {
namespace {

std::optional<EventKind> kind_of(std::string_view text) noexcept {
  for (auto kind = EventKind::alarm; kind <= EventKind::write_refused;
       kind = static_cast<EventKind>(static_cast<int>(kind) + 1))
    if (event_kind_text(kind) == text) return kind;
  return {};
}

bool is_event(std::span<const std::uint8_t> bytes) noexcept {
  LcmWalk walk(bytes);
  if (static_cast<std::int64_t>(walk.number(8)) != event_t::getHash()) return false;
  walk.skip(4 * 8);
  for (int i = 0; i < 3; ++i) walk.string();  // kind, source, type
  walk.skip(4);
  walk.string();
  walk.skip(4);
  walk.string();
  return walk.at_end();
}

bool is_detail(std::span<const std::uint8_t> bytes) noexcept {
  LcmWalk walk(bytes);
  if (static_cast<std::int64_t>(walk.number(8)) != event_detail_t::getHash()) return false;
  walk.skip(3 * 8);
  for (int i = 0; i < 2; ++i) walk.string();  // kind, source
  walk.skip(4);
  for (int i = 0; i < 4; ++i) walk.string();  // object, cause, remedy, address
  walk.skip(2 * 4);
  const std::uint64_t values = walk.count(4 + 1 + 8);
  for (std::uint64_t i = 0; i < values; ++i) walk.string();
  walk.skip(8 * values);
  walk.string();
  return walk.at_end();
}

}  // namespace

std::optional<TraceEvent> event_of(std::span<const std::uint8_t> bytes) {
  event_t message{};
  if (!is_event(bytes) || !decode(message, bytes)) return {};
  const std::optional<EventKind> kind = kind_of(message.kind);
  if (!kind) return {};
  TraceEvent event;
  event.kind = *kind;
  event.t = message.t;
  event.tick = static_cast<std::uint64_t>(message.tick);
  event.lost = static_cast<std::uint64_t>(message.lost);
  event.source = message.source;
  event.type = message.type;
  event.number = message.number;
  event.text = message.text;
  event.reaction = message.reaction;
  event.reaction_text = message.reaction_text;
  event.utime = message.utime;
  return event;
}

bool add_detail(TraceEvent& event, std::span<const std::uint8_t> bytes) {
  event_detail_t message{};
  if (!is_detail(bytes) || !decode(message, bytes)) return false;
  if (message.t != event.t || message.source != event.source || message.number != event.number ||
      message.kind != event_kind_text(event.kind))
    return false;
  event.object = message.object;
  event.address = message.address;
  if (event.kind != EventKind::job_aborted) event.cause = message.cause;
  event.remedy = message.remedy;
  event.cause_number = message.cause_number;
  event.sensor = message.sensor;
  event.unit = message.unit;
  if (message.n > 0) event.value_name = message.names[0], event.value = message.values[0];
  if (message.n > 1) event.limit_name = message.names[1], event.limit = message.values[1];
  return true;
}

}  // namespace lockstep
