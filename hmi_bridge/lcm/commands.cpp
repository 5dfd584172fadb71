#include "hmi_bridge/lcm/commands.hpp"

#include "hmi_bridge/lcm/wire.hpp"

namespace lockstep {
namespace {

using Bytes = std::span<const std::uint8_t>;

template <class Message>
bool begins(LcmWalk& walk) noexcept {
  return walk.number(8) == static_cast<std::uint64_t>(Message::getHash()) && walk.good();
}

template <class Message>
std::optional<Message> decoded(Bytes bytes) {
  Message message;
  if (!decode(message, bytes)) return std::nullopt;
  return message;
}

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

std::string_view action_text(std::int32_t action) noexcept {
  constexpr std::string_view texts[] = {"disable", "enable", "stop",     "jog forward",  "jog backward",
                                        "home",    "reset",  "override", "start program"};
  return action >= 0 && action < static_cast<std::int32_t>(std::size(texts)) ? texts[action]
                                                                             : std::string_view{};
}

std::optional<command_t> decode_command(Bytes bytes) {
  LcmWalk walk(bytes);
  if (!begins<command_t>(walk)) return std::nullopt;
  walk.skip(4 * 8 + 4 + 8);
  walk.string();
  return walk.at_end() ? decoded<command_t>(bytes) : std::nullopt;
}

std::optional<panel_t> decode_panel(Bytes bytes) {
  LcmWalk walk(bytes);
  if (!begins<panel_t>(walk)) return std::nullopt;
  walk.skip(5 * 8 + 3 * 4 + 4 * 8);
  for (int i = 0; i < 3; ++i) walk.string();  // axis, type, velocity_unit
  return walk.at_end() ? decoded<panel_t>(bytes) : std::nullopt;
}

std::optional<event_t> decode_event(Bytes bytes) {
  LcmWalk walk(bytes);
  if (!begins<event_t>(walk)) return std::nullopt;
  walk.skip(4 * 8);
  for (int i = 0; i < 3; ++i) walk.string();  // kind, source, type
  walk.skip(4);
  walk.string();
  walk.skip(4);
  walk.string();
  return walk.at_end() ? decoded<event_t>(bytes) : std::nullopt;
}

std::optional<event_detail_t> decode_detail(Bytes bytes) {
  LcmWalk walk(bytes);
  if (!begins<event_detail_t>(walk)) return std::nullopt;
  walk.skip(3 * 8);
  walk.string();  // kind
  walk.string();  // source
  walk.skip(4);
  for (int i = 0; i < 4; ++i) walk.string();  // object, cause, remedy, address
  walk.skip(2 * 4);
  const std::uint64_t values = walk.count(5 + 8);  // an empty name, and the value
  for (std::uint64_t i = 0; i < values && walk.good(); ++i) walk.string();
  walk.skip(8 * values);
  walk.string();
  return walk.at_end() ? decoded<event_detail_t>(bytes) : std::nullopt;
}

std::vector<std::uint8_t> encoded(const command_t& message) {
  return bytes_of(message);
}
std::vector<std::uint8_t> encoded(const panel_t& message) {
  return bytes_of(message);
}
std::vector<std::uint8_t> encoded(const event_t& message) {
  return bytes_of(message);
}

}  // namespace lockstep
