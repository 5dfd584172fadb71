/// The memory of a running program: cells, calls and loops; and the arrays, which are those of the device.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/aposs/image.hpp"

namespace lockstep::aposs {

/// The arrays of a device, told apart by their order: each program names as many as it uses, from the first
/// on.
class Arrays {
 public:
  struct Extent {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
  };

  /// Creates the arrays that are not there yet.
  /// @return 0; 170 if one is there with another size, 175 without memory for it
  int fit(std::span<const ArrayDeclaration> wanted);

  /// Memory for these, so that `fit` allocates nothing, whatever has been deleted, and each stays where it
  /// is. At load.
  void reserve(std::span<const ArrayDeclaration> wanted);
  std::size_t count() const noexcept { return count_; }
  /// DELETE ARRAYS: none is there any more.
  void forget() noexcept { count_ = 0; }

  /// The element, from 1; null outside the array, and of an array that is not there.
  std::int32_t* element(std::uint32_t array, std::int32_t index) noexcept {
    if (array >= count_) return nullptr;
    const std::uint32_t offset = static_cast<std::uint32_t>(index) - 1;
    return offset < extents_[array].size ? &cells_[extents_[array].first + offset] : nullptr;
  }
  /// The whole array; empty if it is not there.
  std::span<std::int32_t> of(std::uint32_t array) noexcept {
    if (array >= count_) return {};
    return {&cells_[extents_[array].first], extents_[array].size};
  }

  /// All of them, one behind the other.
  std::span<std::int32_t> all() noexcept {
    return count_ == 0 ? std::span<std::int32_t>()
                       : std::span(cells_).first(extents_[count_ - 1].first + extents_[count_ - 1].size);
  }
  /// The memory, whose first elements are those of the first array.
  std::span<std::int32_t> memory() noexcept { return cells_; }

  static constexpr std::size_t kMaximumCells = std::size_t{1} << 22;

 private:
  std::vector<std::int32_t> cells_;
  std::vector<Extent> extents_;
  std::size_t count_ = 0;
};

inline constexpr std::size_t kMaximumCalls = 10;  ///< GOSUB within GOSUB: the next one is error 151
inline constexpr std::size_t kMaximumLoops =
    10;  ///< LOOP within LOOP of one routine: the next one is error 114

/// A place to go back to.
struct Call {
  std::uint16_t instruction = 0;
  std::uint8_t loops = 0;  ///< on the stack when it was called
};

/// A LOOP that has jumped back and is not over.
struct Loop {
  std::uint16_t instruction = 0;
  std::int32_t remaining = 0;
};

/// Calls and loops of one level: the main program, an interrupt, the error handler.
class Stack {
 public:
  void clear() noexcept { calls_count_ = loops_count_ = 0; }
  bool call(std::uint16_t from) noexcept;
  /// Whether there was a call to go back from; `to` is the instruction that called.
  bool leave(std::uint16_t& to) noexcept;
  /// GOTO out of a subprogram: its call is forgotten, or all are. @return whether there was one
  bool forget(bool all) noexcept;

  enum class Turn : std::uint8_t { kAgain, kOver, kTooDeep };
  /// A LOOP at its end: the first time its count is taken over.
  Turn turn(std::uint16_t instruction, std::int32_t count) noexcept;

  std::size_t depth() const noexcept { return calls_count_; }

 private:
  std::size_t loops_of_caller() const noexcept {
    return calls_count_ == 0 ? 0 : calls_[calls_count_ - 1].loops;
  }

  std::array<Call, kMaximumCalls> calls_{};
  std::array<Loop, kMaximumLoops*(kMaximumCalls + 1)> loops_{};
  std::size_t calls_count_ = 0, loops_count_ = 0;
};

}  // namespace lockstep::aposs
