/// Texts in the cycle: STRING[n].
/// @source IEC 61131-3:2013, 6.4.2 (STRING), 6.6.2.5.12 (comparison of strings)
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// The maximum n of a STRING[n].
inline constexpr std::size_t kLongestText = 254;

/// Where a text lives: characters of one byte (ISO 8859-1), up to the first zero or to the end of its
/// capacity.
struct Text {
  char* characters = nullptr;
  std::size_t capacity = 0;  ///< n of STRING[n], 1 to kLongestText

  std::string_view view() const noexcept;
  /// Replaces the text. What has no space is cut off, the rest of the space becomes zero. `text` may be this
  /// one itself.
  void assign(std::string_view text) const noexcept;
};

struct EvaluationCounters;
struct TextChoice;

/// A text in an expression: that of a tag as it stands, a literal, or one that SEL or MUX choose.
struct TextSource {
  std::optional<Text> tag;  ///< none: the choice or the literal counts
  std::string literal;
  std::shared_ptr<const TextChoice> choice = nullptr;  ///< none: the literal counts

  /// The text now; neither allocates nor fails. Thread: the cycle.
  std::string_view view(EvaluationCounters& counters) const noexcept;
  /// The maximum number of characters that it may have.
  std::size_t capacity() const noexcept;
};

/// `left = right` or `left <> right`; letters of both cases differ.
struct TextComparison {
  TextSource left;
  TextSource right;
  bool is_equality = true;

  bool holds(EvaluationCounters& counters) const noexcept {
    return (left.view(counters) == right.view(counters)) == is_equality;
  }
};

/// "STRING[20]".
std::string text_type_name(std::size_t capacity);

/// The text as signals, for what carries values: two characters in a WORD, the first in its low byte; the
/// last one of an odd capacity is a BYTE.
std::vector<Signal> text_signals(const Text& text);
/// The values of these signals that make them hold a text, and the text that they hold.
std::vector<Value> text_values(std::string_view text, std::size_t capacity);
std::string text_of(std::span<const Value> values, std::size_t capacity);

}  // namespace lockstep
