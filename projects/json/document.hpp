/// Strict reading of JSON with comments: every value knows its place, objects keep the order of their
/// members.
/// @source RFC 8259, RFC 6901 (pointers)
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "projects/json/problem.hpp"
#include "projects/json/source_text.hpp"

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

  /// What it is part of, such as "call 'gear'" or "object 'Knife'": the innermost that has a name; empty:
  /// none.
  std::string owner() const;

  /// Where it begins; of a member of an object where its key begins.
  SourcePosition position() const noexcept;
  SourcePosition key_position() const noexcept;
  /// Its first byte in the text.
  std::size_t begin() const noexcept { return offset_.value; }
  /// The text in which it stands; nullptr if it is of no document.
  const SourceText* source() const noexcept { return source_; }

  /// Makes a copy of a value of a template part of a copy of what that one is part of.
  /// @param parent nullptr: it stays what it is part of
  /// @param instance for messages; outlives it
  void belong_to(const JsonValue* parent, const std::string& instance) noexcept {
    if (parent != nullptr) parent_ = parent;
    instance_ = &instance;
  }

 private:
  friend class JsonBuilder;
  std::string name_in_parent() const;
  std::string named_part() const;

  const SourceText* source_ = nullptr;
  ValueOffset offset_;
  const JsonValue* parent_ = nullptr;
  const std::string* instance_ = nullptr;  // of a template, of which it is a part
  std::string key_;                        // in the parent, if that is an object
  std::size_t index_ = 0;                  // in the parent, if that is an array
};

/// A document. Reading it stops at the first syntax error; other problems are told all at once.
class JsonDocument {
 public:
  static constexpr int kDeepest = 64;                 ///< levels of nesting
  static constexpr std::size_t kLongest = 16u << 20;  ///< length of the text [byte]
  static constexpr std::size_t kMaximumValues = 2'000'000;

  /// Reads a text. Problems are syntax errors ("line:column"), duplicate keys, numbers that no LREAL holds,
  /// nesting that is too deep, too many values.
  /// @param file, folder see `SourceText`
  explicit JsonDocument(std::string_view text, std::string file = "", std::string folder = "");

  /// Whether there is a document to look at; problems there may be nevertheless.
  bool usable() const noexcept { return root_ != nullptr; }
  /// Only if usable.
  const JsonValue& root() const noexcept { return *root_; }
  std::size_t size() const noexcept { return values_.size(); }
  const std::vector<Problem>& problems() const noexcept { return problems_; }

 private:
  friend class JsonBuilder;
  void read();

  std::unique_ptr<const SourceText> source_;
  std::deque<JsonValue> values_;
  const JsonValue* root_ = nullptr;
  std::vector<Problem> problems_;
};

}  // namespace lockstep
