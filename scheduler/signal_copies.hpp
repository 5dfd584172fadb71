/// How values of many signals are taken at one tick: a plan of copies, made when the signals are chosen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Copies the variables in which signals lie as they stand in memory, each once, those that lie beside each
/// other in one piece; what they mean is found out where they are read. Pieces are copied by size and among
/// those of a size by address. So one costs the cycle the fetch of an address, of a value and its store,
/// without a call, a branch or a conversion, and fetches that miss the cache overlap.
class SignalCopies {
 public:
  /// What the signals point at must outlive the last `take`.
  explicit SignalCopies(std::span<const Signal> signals);

  /// Memory that `take` fills.
  std::size_t words() const noexcept { return words_; }
  /// How often `take` fetches and stores something.
  std::size_t pieces() const noexcept { return addresses_.size(); }
  /// What `take` reads of the plan, to be fetched before.
  std::span<const void* const> plan() const noexcept { return addresses_; }
  /// Copies the variables. A constant number of steps. Thread: the cycle.
  void take(std::uint64_t* to) const noexcept;
  /// What the signals had, of what `take` has filled. Any thread.
  /// @param values one for each signal, in the order of the signals; to the bit what `Signal::load` gives
  void read(const std::uint64_t* from, std::span<Value> values) const noexcept;

 private:
  static constexpr std::array<std::size_t, 6> kSizes = {8, 16, 32, 4, 2, 1};  // of pieces, usual ones first

  /// Where the value of a signal lies in what was taken.
  struct Taken {
    std::uint32_t offset = 0;
    Type type = Type::BOOL;
    std::int8_t bit = -1;
  };

  std::array<std::uint32_t, kSizes.size()> ends_{};  // of the addresses of each size
  std::vector<const void*> addresses_;               // of the pieces, by size as in `kSizes`
  std::size_t words_ = 0;
  std::vector<Taken> taken_;
};

}  // namespace lockstep
