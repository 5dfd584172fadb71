#include "scheduler/signal_copies.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <utility>

namespace lockstep {
namespace {

template <std::size_t kSize>
char* copy(const void* const* address, const void* const* end, char* to) noexcept {
  // Four at a time: the loop would cost as much as what it copies.
  for (; end - address >= 4; address += 4, to += 4 * kSize) {
    std::memcpy(to, address[0], kSize);
    std::memcpy(to + kSize, address[1], kSize);
    std::memcpy(to + 2 * kSize, address[2], kSize);
    std::memcpy(to + 3 * kSize, address[3], kSize);
  }
  for (; address != end; ++address, to += kSize) std::memcpy(to, *address, kSize);
  return to;
}

}  // namespace

SignalCopies::SignalCopies(std::span<const Signal> signals) {
  // Bits of a word are taken with it, once.
  std::array<std::map<const void*, std::uint32_t, std::less<>>, kSizes.size()> variables;
  const auto rank = [](Type type) {
    const auto size = static_cast<std::size_t>(size_of(type));
    return static_cast<std::size_t>(std::find(kSizes.begin(), kSizes.end(), size) - kSizes.begin());
  };
  for (const Signal& signal : signals) variables[rank(signal.type)].try_emplace(signal.address);
  std::uint32_t offset = 0;
  for (std::size_t i = 0; i < kSizes.size(); ++i) {
    for (auto& [address, its_offset] : variables[i]) {
      addresses_.push_back(address);
      its_offset = std::exchange(offset, offset + static_cast<std::uint32_t>(kSizes[i]));
    }
    ends_[i] = static_cast<std::uint32_t>(addresses_.size());
  }
  words_ = (offset + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  for (const Signal& signal : signals)
    taken_.push_back({variables[rank(signal.type)].at(signal.address), signal.type, signal.bit});
}

void SignalCopies::take(std::uint64_t* to) const noexcept {
  const void* const* const begin = addresses_.data();
  char* next = reinterpret_cast<char*>(to);
  next = copy<8>(begin, begin + ends_[0], next);
  next = copy<4>(begin + ends_[0], begin + ends_[1], next);
  next = copy<2>(begin + ends_[1], begin + ends_[2], next);
  copy<1>(begin + ends_[2], begin + ends_[3], next);
}

void SignalCopies::read(const std::uint64_t* from, std::span<Value> values) const noexcept {
  const char* const begin = reinterpret_cast<const char*>(from);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Taken& taken = taken_[i];
    values[i] = load_value(begin + taken.offset, taken.type, taken.bit);
  }
}

}  // namespace lockstep
