/// What a program prints, on its way to whoever shows it: whole lines, as texts and numbers; nothing is
/// formatted here.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace lockstep::aposs {

struct Printed {
  enum class Kind : std::uint8_t { kText, kNumber, kCharacter, kEndOfLine };
  Kind kind = Kind::kEndOfLine;
  std::int32_t value = 0;  ///< the number of a text of the image; a number; a character
};

/// One thread prints, another one takes. A line that does not fit is left out whole, and counted.
class PrintQueue {
 public:
  /// @param capacity items, rounded up to a power of two. At load.
  explicit PrintQueue(std::size_t capacity = 4096);

  // For the cycle.

  void push(Printed item) noexcept;
  /// Ends the line: from now on it may be taken.
  void end_line() noexcept;
  /// Lines that have been given out since it was asked last.
  std::uint32_t take_line_count() noexcept { return std::exchange(lines_, 0); }
  /// Gives out what there is of a line that does not end.
  void flush() noexcept;

  // For the other side.

  bool take(Printed& item) noexcept;
  /// Any thread.
  std::uint64_t dropped_lines() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<Printed> ring_;
  std::size_t mask_ = 0;
  std::size_t written_ = 0;  ///< with the line that is being printed
  std::uint32_t lines_ = 0;
  bool dropping_ = false;
  std::atomic<std::size_t> given_{0}, taken_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace lockstep::aposs
