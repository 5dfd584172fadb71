/// The text of a file that is being read: which line and column a byte of it is in, and where its values
/// begin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// Both count from 1; 0: not known. A column is a character, also a tab; a byte order mark is none.
struct SourcePosition {
  std::size_t line = 0;
  std::size_t column = 0;
  bool operator==(const SourcePosition&) const = default;
};

/// A text and where it comes from. Looking up a position takes the same time wherever it is.
class SourceText {
 public:
  /// @param file as messages name it; empty: the one whose name whoever shows them knows
  /// @param folder to which names of files in the text are relative; empty: the current one
  explicit SourceText(std::string_view text, std::string file = "", std::string folder = "");

  const std::string& text() const noexcept { return text_; }
  const std::string& file() const noexcept { return file_; }
  const std::string& folder() const noexcept { return folder_; }

  /// Of a byte; behind the end: the end.
  SourcePosition position(std::size_t byte) const noexcept;

 private:
  std::size_t characters_before(std::size_t byte) const noexcept;

  std::string text_;
  std::string file_;
  std::string folder_;
  std::vector<std::uint32_t> lines_;   // where each begins
  std::vector<std::uint32_t> blocks_;  // characters before each
};

/// Where a value of a JSON text begins; of a member of an object its key too, else the value again.
struct ValueOffset {
  std::uint32_t key = 0;
  std::uint32_t value = 0;
};

/// Of the values of a JSON text with comments, in its order. Of a text with a syntax error they are right up
/// to there.
/// @param maximum no more of them
std::vector<ValueOffset> value_offsets(std::string_view text, std::size_t maximum);

}  // namespace lockstep
