/// Datagrams of an LCM network, right ones and wrong ones.
/// @source LCM, UDP multicast protocol
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::test {

inline void append_number(std::vector<std::uint8_t>& bytes, std::uint64_t number, int width) {
  for (int i = width - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

inline std::vector<std::uint8_t> short_datagram(const std::string& channel, const std::string& data) {
  std::vector<std::uint8_t> bytes;
  append_number(bytes, 0x4C433032, 4);
  append_number(bytes, 7, 4);
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

/// A fragment as its head claims to be, whatever follows.
struct FragmentHead {
  std::uint32_t sequence = 1, size = 0, offset = 0;
  std::uint16_t number = 0, count = 1;
};
inline std::vector<std::uint8_t> fragment_datagram(const FragmentHead& head, const std::string& rest) {
  std::vector<std::uint8_t> bytes;
  append_number(bytes, 0x4C433033, 4);
  append_number(bytes, head.sequence, 4);
  append_number(bytes, head.size, 4);
  append_number(bytes, head.offset, 4);
  append_number(bytes, head.number, 2);
  append_number(bytes, head.count, 2);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

/// A message as liblcm cuts it: the channel stands before the data of the first fragment.
inline std::vector<std::vector<std::uint8_t>> in_fragments(std::uint32_t sequence, const std::string& channel,
                                                           const std::string& data, std::size_t piece) {
  std::vector<std::vector<std::uint8_t>> datagrams;
  const std::size_t count = (data.size() + piece - 1) / piece;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string part = data.substr(i * piece, piece);
    datagrams.push_back(fragment_datagram({.sequence = sequence,
                                           .size = static_cast<std::uint32_t>(data.size()),
                                           .offset = static_cast<std::uint32_t>(i * piece),
                                           .number = static_cast<std::uint16_t>(i),
                                           .count = static_cast<std::uint16_t>(count)},
                                          i == 0 ? channel + '\0' + part : part));
  }
  return datagrams;
}

}  // namespace lockstep::test
