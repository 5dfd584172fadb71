#include "scheduler/signal_copies.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <iterator>
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

/// Variables by address and size, and where each lies in what is taken.
using Variables = std::map<std::pair<const char*, std::size_t>, std::uint32_t>;

struct Piece {
  Variables::iterator first;  // of the variables in it
  std::size_t count = 0;
  std::size_t size = 0;
};

/// The piece that begins with a variable: as many of those that follow without a gap as make a power of two.
Piece piece_at(Variables& variables, Variables::iterator first, std::size_t maximum) {
  Piece piece{first, 1, first->first.second};
  const char* const begin = first->first.first;
  std::size_t count = 0;
  std::size_t size = 0;
  for (auto next = first; next != variables.end() && next->first.first == begin + size; ++next) {
    size += next->first.second;
    ++count;
    if (size > maximum) break;
    if (std::has_single_bit(size)) piece = {first, count, size};
  }
  return piece;
}

}  // namespace

SignalCopies::SignalCopies(std::span<const Signal> signals) {
  // Bits of a word are taken with it, once.
  Variables variables;
  const auto key = [](const Signal& signal) {
    return std::pair(static_cast<const char*>(signal.address),
                     static_cast<std::size_t>(size_of(signal.type)));
  };
  for (const Signal& signal : signals) variables.try_emplace(key(signal));
  std::vector<Piece> pieces;
  for (auto next = variables.begin(); next != variables.end();) {
    pieces.push_back(piece_at(variables, next, std::ranges::max(kSizes)));
    std::advance(next, pieces.back().count);
  }
  const auto place = [](std::size_t size) {
    return static_cast<std::size_t>(std::ranges::find(kSizes, size) - kSizes.begin());
  };
  std::ranges::stable_sort(pieces, {}, [&](const Piece& piece) { return place(piece.size); });
  std::uint32_t offset = 0;
  for (const Piece& piece : pieces) {
    addresses_.push_back(piece.first->first.first);
    auto variable = piece.first;
    for (std::size_t i = 0; i < piece.count; ++i, ++variable)
      variable->second = std::exchange(offset, offset + static_cast<std::uint32_t>(variable->first.second));
  }
  for (std::size_t i = 0; i < kSizes.size(); ++i)
    ends_[i] = static_cast<std::uint32_t>(
        std::ranges::count_if(pieces, [&](const Piece& piece) { return place(piece.size) <= i; }));
  words_ = (offset + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  for (const Signal& signal : signals) taken_.push_back({variables.at(key(signal)), signal.type, signal.bit});
}

void SignalCopies::take(std::uint64_t* to) const noexcept {
  const void* const* const begin = addresses_.data();
  char* next = reinterpret_cast<char*>(to);
  std::uint32_t done = 0;
  // No further than there are pieces: code that is not reached is not fetched.
  const auto those_of_size = [&]<std::size_t kIndex>() {
    const std::uint32_t end = ends_[kIndex];
    next = copy<kSizes[kIndex]>(begin + done, begin + end, next);
    done = end;
    return end != ends_.back();
  };
  [&]<std::size_t... kIndices>(std::index_sequence<kIndices...>) {
    (those_of_size.template operator()<kIndices>() && ...);
  }
  (std::make_index_sequence<kSizes.size()>());
}

void SignalCopies::read(const std::uint64_t* from, std::span<Value> values) const noexcept {
  const char* const begin = reinterpret_cast<const char*>(from);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Taken& taken = taken_[i];
    values[i] = load_value(begin + taken.offset, taken.type, taken.bit);
  }
}

}  // namespace lockstep
