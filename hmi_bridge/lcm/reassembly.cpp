#include "hmi_bridge/lcm/reassembly.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lockstep {
namespace {

constexpr std::uint32_t kShort = 0x4C433032;     // "LC02"
constexpr std::uint32_t kFragment = 0x4C433033;  // "LC03"
constexpr std::size_t kShortHead = 8;
constexpr std::size_t kFragmentHead = 20;
constexpr std::size_t kPiece = 128;  // what it costs to keep a fragment, beside its data [byte]

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t width) noexcept {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < width; ++i) number = number << 8 | bytes[at + i];
  return number;
}

/// The characters up to the 0, which the channel of a message ends with; none if there is no channel.
std::optional<std::string_view> channel_at(std::span<const std::uint8_t> bytes) noexcept {
  const auto maximum = bytes.first(std::min(bytes.size(), LcmReassembly::kLongestChannel + 1));
  const auto end = std::find(maximum.begin(), maximum.end(), std::uint8_t{0});
  if (end == maximum.end() || end == maximum.begin()) return std::nullopt;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()),
                          static_cast<std::size_t>(end - maximum.begin()));
}

}  // namespace

std::optional<LcmMessage> LcmReassembly::malformed() noexcept {
  ++counters_.malformed;
  return std::nullopt;
}

std::optional<LcmMessage> LcmReassembly::refused() noexcept {
  ++counters_.refused;
  return std::nullopt;
}

std::optional<LcmMessage> LcmReassembly::accept(std::span<const std::uint8_t> datagram, std::uint64_t sender,
                                                Clock::time_point now) {
  give_up_late(now);
  if (datagram.size() < kShortHead) return malformed();
  const std::uint32_t magic = number_at(datagram, 0, 4);
  if (magic == kShort) return accept_short(datagram.subspan(kShortHead));
  if (magic != kFragment || datagram.size() < kFragmentHead) return malformed();
  return accept_fragment({.sequence = number_at(datagram, 4, 4),
                          .message_size = number_at(datagram, 8, 4),
                          .offset = number_at(datagram, 12, 4),
                          .number = static_cast<std::uint16_t>(number_at(datagram, 16, 2)),
                          .count = static_cast<std::uint16_t>(number_at(datagram, 18, 2)),
                          .rest = datagram.subspan(kFragmentHead)},
                         sender, now);
}

std::optional<LcmMessage> LcmReassembly::accept_short(std::span<const std::uint8_t> rest) {
  const auto channel = channel_at(rest);
  if (!channel) return malformed();
  ++counters_.messages;
  return LcmMessage{*channel, rest.subspan(channel->size() + 1)};
}

std::optional<LcmMessage> LcmReassembly::accept_fragment(const Fragment& fragment, std::uint64_t sender,
                                                         Clock::time_point now) {
  if (bounds_.message == 0 || fragment.message_size > bounds_.message) return refused();
  if (fragment.number >= fragment.count) return malformed();
  std::string_view channel;
  std::span<const std::uint8_t> data = fragment.rest;
  if (fragment.number == 0) {
    const auto first = channel_at(data);
    if (!first) return malformed();
    channel = *first;
    data = data.subspan(channel.size() + 1);
  }
  // In 64 bits: two numbers of 32 bits have no sum that wraps.
  if (data.empty() || std::uint64_t{fragment.offset} + data.size() > fragment.message_size)
    return malformed();
  const auto partial = partial_of(fragment, sender, now);
  if (partial == partial_.end() || partial->pieces.contains(fragment.number)) return malformed();
  if (!make_capacity(kPiece + data.size(), partial)) return refused();
  if (fragment.number == 0) partial->channel = channel;
  partial->pieces[fragment.number] = {fragment.offset, {data.begin(), data.end()}};
  memory_ += kPiece + data.size();
  return partial->pieces.size() == partial->count ? complete(partial) : std::nullopt;
}

/// The message that a fragment belongs to, begun if need be; none if they contradict each other.
LcmReassembly::Partials::iterator LcmReassembly::partial_of(const Fragment& fragment, std::uint64_t sender,
                                                            Clock::time_point now) {
  const auto found = std::find_if(partial_.begin(), partial_.end(), [&](const Partial& one) {
    return one.sender == sender && one.sequence == fragment.sequence;
  });
  if (found != partial_.end()) {
    const bool agrees = found->size == fragment.message_size && found->count == fragment.count;
    return agrees ? found : partial_.end();
  }
  while (partial_.size() >= bounds_.incomplete) {
    ++counters_.given_up;
    forget(partial_.begin());
  }
  partial_.push_back({.sender = sender,
                      .sequence = fragment.sequence,
                      .size = fragment.message_size,
                      .count = fragment.count,
                      .begun = now,
                      .channel = {},
                      .pieces = {}});
  return std::prev(partial_.end());
}

/// Lets the oldest messages give way until so many bytes more may be kept of one. @return false if it has
/// given way itself
bool LcmReassembly::make_capacity(std::size_t bytes, Partials::iterator partial) noexcept {
  while (memory_ + bytes > bounds_.memory) {
    const bool own = partial_.begin() == partial;
    ++counters_.given_up;
    forget(partial_.begin());
    if (own) return false;
  }
  return true;
}

/// Puts the fragments together, each of which has to begin where the one before has ended.
std::optional<LcmMessage> LcmReassembly::complete(Partials::iterator partial) {
  std::size_t end = 0;
  bool whole = true;
  for (const auto& [number, piece] : partial->pieces) {
    whole = whole && piece.offset == end;
    end += piece.data.size();
  }
  whole = whole && end == partial->size;
  if (whole) {
    channel_ = partial->channel;
    data_.clear();
    data_.reserve(end);
    for (const auto& [number, piece] : partial->pieces)
      data_.insert(data_.end(), piece.data.begin(), piece.data.end());
  }
  forget(partial);
  if (!whole) return malformed();
  ++counters_.messages;
  return LcmMessage{channel_, data_};
}

void LcmReassembly::forget(Partials::iterator partial) noexcept {
  for (const auto& [number, piece] : partial->pieces) memory_ -= kPiece + piece.data.size();
  partial_.erase(partial);
}

void LcmReassembly::give_up_late(Clock::time_point now) noexcept {
  while (!partial_.empty() && now - partial_.front().begun > bounds_.timeout) {
    ++counters_.given_up;
    forget(partial_.begin());
  }
}

}  // namespace lockstep
