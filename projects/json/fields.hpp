/// Typed access to the members of JSON objects; whatever is wrong is reported where it stands.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "projects/json/document.hpp"
#include "projects/json/key.hpp"
#include "projects/json/problem.hpp"
#include "projects/json/text_form.hpp"

namespace lockstep {

/// Reports that a value is of the wrong kind, unless its problem is known already.
/// @param allowed such as "a string"
void report_kind(const JsonValue& value, std::string_view allowed, Problems& problems);

/// A number so that reading it back gives the same double; a duration [ns] in the largest unit in which it is
/// whole.
std::string decimal_text(double value);
std::string duration_text(std::int64_t nanoseconds);

/// Each reads one value and reports it if it is none of that kind; `value` may be nullptr, which gives none.
std::optional<std::string_view> read_string(const JsonValue* value, Problems& problems);
std::optional<bool> read_bool(const JsonValue* value, Problems& problems);
std::optional<std::int64_t> read_integer(const JsonValue* value, std::int64_t lowest, std::int64_t highest,
                                         Problems& problems);
/// A finite number, lowest ≤ number ≤ highest.
std::optional<double> read_number(const JsonValue* value, double lowest, double highest, Problems& problems);
/// A duration [ns], such as "10ms".
std::optional<std::int64_t> read_duration(const JsonValue* value, std::int64_t lowest, std::int64_t highest,
                                          Problems& problems);
/// One of some words: its index.
std::optional<std::size_t> read_word(const JsonValue* value, std::span<const std::string_view> words,
                                     Problems& problems);
/// A text of 1 to `longest` bytes, all of which can be shown.
std::optional<std::string_view> read_title(const JsonValue* value, Problems& problems,
                                           std::size_t longest = kLongestTitle);

/// A text of a form.
std::optional<std::string_view> read_form(const JsonValue* value, const TextForm& form, Problems& problems);

/// The value itself, if it is of that kind.
const JsonValue* read_object(const JsonValue* value, Problems& problems);
const JsonValue* read_array(const JsonValue* value, Problems& problems);

/// An object whose keys are known. Reports at once a value that is none, unknown keys and missing ones. Each
/// may have a comment as well.
class Fields {
 public:
  Fields(const JsonValue& value, Keys keys, Problems& problems);
  /// One of several kinds of objects: of a key of another kind it is told where it is allowed.
  Fields(const JsonValue& value, std::span<const KeyVariant> variants, std::size_t variant,
         Problems& problems);

  /// Whether it is an object at all.
  bool usable() const noexcept { return value_.kind == JsonKind::object; }
  const JsonValue& value() const noexcept { return value_; }
  /// The value of a key; nullptr if it is missing.
  const JsonValue* operator[](std::string_view key) const noexcept { return value_.find(key); }
  /// What `keys::kComment` says; empty if it is missing.
  std::string_view comment() const noexcept;

 private:
  const JsonValue& value_;
};

}  // namespace lockstep
