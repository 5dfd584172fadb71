/// Strict reading of JSON: every value knows its place, objects keep the order of their members.
/// @source RFC 8259, RFC 6901 (pointers)
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "projects/json/problem.hpp"

namespace lockstep {

enum class JsonKind : std::uint8_t {
  null,
  boolean,
  number,
  string,
  array,
  object,
  unusable  ///< a value whose problem has been reported already; readers pass over it
};

/// A value of a document, which owns it.
class JsonValue {
 public:
  struct Member {
    std::string key;
    const JsonValue* value;
  };

  JsonKind kind = JsonKind::null;
  bool boolean = false;
  bool negative = false;        ///< of a number
  bool fraction = false;        ///< the number is written with a fraction, or is none without an exponent
  bool whole = false;           ///< the number has no fraction and its amount fits 64 bits
  std::uint64_t magnitude = 0;  ///< amount of a whole number
  double number = 0.0;          ///< any number, rounded to the nearest
  std::string text;             ///< of a string; a number as it is written
  std::vector<Member> members;  ///< of an object, in the order of the file
  std::vector<const JsonValue*> elements;  ///< of an array

  /// The member with a key; nullptr if there is none.
  const JsonValue* find(std::string_view key) const noexcept;

  /// Where the value stands, such as "/tags/start/init"; empty for the document. Characters that would break
  /// the line of a message are replaced and very long keys are cut short.
  std::string pointer() const;

  /// The value for a message, such as `3.5`, `'text'` or `an object`.
  std::string shown() const;

 private:
  friend class JsonBuilder;
  const JsonValue* parent_ = nullptr;
  std::string key_;        // in the parent, if that is an object
  std::size_t index_ = 0;  // in the parent, if that is an array
};

/// A document. Reading it stops at the first syntax error; other problems are told all at once.
class JsonDocument {
 public:
  static constexpr int kDeepest = 64;                 ///< levels of nesting
  static constexpr std::size_t kLongest = 16u << 20;  ///< length of the text [byte]
  static constexpr std::size_t kMaximumValues = 2'000'000;

  /// Reads a text. Problems are syntax errors ("line:column"), duplicate keys, numbers that no LREAL holds,
  /// nesting that is too deep, too many values.
  explicit JsonDocument(std::string_view text);

  /// Whether there is a document to look at; problems there may be nevertheless.
  bool usable() const noexcept { return root_ != nullptr; }
  /// Only if usable.
  const JsonValue& root() const noexcept { return *root_; }
  const std::vector<Problem>& problems() const noexcept { return problems_; }

 private:
  friend class JsonBuilder;
  std::deque<JsonValue> values_;
  const JsonValue* root_ = nullptr;
  std::vector<Problem> problems_;
};

}  // namespace lockstep
