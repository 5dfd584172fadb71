// Any datagrams on an LCM network: each is a byte for its sender, two for its length, and itself.
#include <algorithm>

#include "hmi_bridge/lcm/reassembly.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/datagrams.hpp"

namespace lockstep::fuzz::datagram_target {
namespace {

void add(std::string& input, char sender, const std::vector<std::uint8_t>& datagram) {
  input += sender;
  input += static_cast<char>(datagram.size() >> 8);
  input += static_cast<char>(datagram.size());
  input.append(datagram.begin(), datagram.end());
}

}  // namespace

std::vector<std::string> seeds() {
  std::string whole, cut, mixed, lies;
  add(whole, 0, test::short_datagram("KNIFE", "some data"));
  const std::string data(400, 'd');
  for (const auto& part : test::in_fragments(3, "KNIFE_HEADER", data, 100)) add(cut, 1, part);
  const auto one = test::in_fragments(4, "A", data, 150), other = test::in_fragments(4, "B", data, 70);
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (i < one.size()) add(mixed, 1, one[i]);
    add(mixed, 2, other[i]);
  }
  add(lies, 1, test::fragment_datagram({.size = 1000, .offset = 0xFFFFFFF8, .number = 1, .count = 2}, data));
  add(lies, 1, test::fragment_datagram({.size = 0xFFFFFFFF, .number = 0, .count = 65535}, "A"));
  return {whole, cut, mixed, lies};
}

int take(const std::uint8_t* data, std::size_t size) {
  constexpr LcmBounds kBounds{.message = 4000, .memory = 10'000, .incomplete = 5};
  LcmReassembly reassembly(kBounds);
  auto now = LcmReassembly::Clock::time_point{} + std::chrono::hours(1);
  unsigned sum = 0;
  for (Bytes rest(data, size); rest.size() >= 3; now += std::chrono::milliseconds(50)) {
    const std::size_t length = std::min<std::size_t>(rest[1] << 8 | rest[2], rest.size() - 3);
    if (const auto message = reassembly.accept(rest.subspan(3, length), rest[0], now)) {
      require(!message->channel.empty() && message->channel.size() <= LcmReassembly::kLongestChannel,
              "a channel has a name");
      require(message->channel.find('\0') == message->channel.npos, "and it ends at its 0");
      require(message->data.size() <= std::max<std::size_t>(kBounds.message, length),
              "no message is longer than allowed");
      for (const std::uint8_t byte : message->data) sum += byte;  // all of it can be read
    }
    require(reassembly.memory() <= kBounds.memory, "there is an end to the memory");
    require(reassembly.incomplete() <= kBounds.incomplete, "and to what is incomplete");
    rest = rest.subspan(3 + length);
  }
  return sum == 0xFFFFFFFF ? 1 : 0;
}

}  // namespace lockstep::fuzz::datagram_target
