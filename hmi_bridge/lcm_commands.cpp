#include "hmi_bridge/lcm_commands.hpp"

#include <exception>
#include <limits>

namespace lockstep {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// Goes over a message before the generated decoder does, which trusts the lengths of strings.
class Walk {
 public:
  explicit Walk(Bytes bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t width) noexcept {
    if (bytes_.size() < width) return fail();
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < width; ++i) number = number << 8 | bytes_[i];
    bytes_ = bytes_.subspan(width);
    return number;
  }
  void skip(std::size_t width) noexcept {
    if (bytes_.size() < width)
      fail();
    else
      bytes_ = bytes_.subspan(width);
  }
  /// A length, which counts the 0 at the end, and the characters.
  void string() noexcept {
    const std::uint64_t length = number(4);
    if (length == 0 || length > bytes_.size() || bytes_[length - 1] != 0) {
      fail();
      return;
    }
    bytes_ = bytes_.subspan(length);
  }
  bool at_end() const noexcept { return good_ && bytes_.empty(); }
  bool good() const noexcept { return good_; }

 private:
  std::uint64_t fail() noexcept {
    good_ = false;
    bytes_ = {};
    return 0;
  }
  Bytes bytes_;
  bool good_ = true;
};

template <class Message>
bool begins(Walk& walk, Bytes bytes) noexcept {
  return bytes.size() <= std::numeric_limits<int>::max() &&
         walk.number(8) == static_cast<std::uint64_t>(Message::getHash()) && walk.good();
}

template <class Message>
std::optional<Message> decoded(Bytes bytes) try {
  const int size = static_cast<int>(bytes.size());
  Message message;
  if (message.decode(bytes.data(), 0, size) != size) return std::nullopt;
  return message;
} catch (const std::exception&) {  // such as no memory
  return std::nullopt;
}

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

std::string_view action_text(std::int32_t action) noexcept {
  constexpr std::string_view texts[] = {"disable",      "enable", "stop",  "jog forward",
                                        "jog backward", "home",   "reset", "override"};
  return action >= 0 && action < static_cast<std::int32_t>(std::size(texts)) ? texts[action]
                                                                             : std::string_view{};
}

std::optional<command_t> decode_command(Bytes bytes) {
  Walk walk(bytes);
  if (!begins<command_t>(walk, bytes)) return std::nullopt;
  walk.skip(4 * 8 + 4 + 8);
  walk.string();
  return walk.at_end() ? decoded<command_t>(bytes) : std::nullopt;
}

std::optional<panel_t> decode_panel(Bytes bytes) {
  Walk walk(bytes);
  if (!begins<panel_t>(walk, bytes)) return std::nullopt;
  walk.skip(5 * 8 + 2 * 4 + 4 * 8);
  walk.string();
  return walk.at_end() ? decoded<panel_t>(bytes) : std::nullopt;
}

std::optional<event_t> decode_event(Bytes bytes) {
  Walk walk(bytes);
  if (!begins<event_t>(walk, bytes)) return std::nullopt;
  walk.skip(4 * 8);
  for (int i = 0; i < 3; ++i) walk.string();  // kind, source, type
  walk.skip(4);
  walk.string();
  walk.skip(4);
  walk.string();
  return walk.at_end() ? decoded<event_t>(bytes) : std::nullopt;
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
