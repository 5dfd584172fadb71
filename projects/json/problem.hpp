/// Problems of a project file: where, what is wrong, what is allowed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/network/visible_text.hpp"

namespace lockstep {

class JsonValue;

/// One thing that is wrong with a project file, or that is legal and looks like a mistake.
struct Problem {
  std::string place;       ///< JSON pointer; "line:column" for a syntax error
  std::string text;        ///< what is wrong, what is allowed; one line
  std::string file{};      ///< in which it is, if that is not the project file but one that it includes
  std::size_t line = 0;    ///< from 1; 0: not known, or the place tells it
  std::size_t column = 0;  ///< in characters, from 1
  std::string owner{};     ///< what it is part of, such as "call 'gear'"; empty: nothing that has a name
  bool operator==(const Problem&) const = default;
};

/// What is wrong with a value, or with the key of a member of an object.
Problem problem_at(const JsonValue& value, std::string text);
Problem problem_at_key(const JsonValue& member, std::string text);
/// What is wrong within a text, such as an expression. @param column in it, in bytes, from 1
Problem problem_within(const JsonValue& value, std::size_t column, std::string text);

/// Where another value stands, for the message about one: " in line 3", " in axes.json, line 3".
std::string other_place(const JsonValue& other, const JsonValue& value);

/// The line to show: "FILE:place: text (line 3, column 5, call 'gear')".
/// @param file the project file
std::string to_string(std::string_view file, const Problem& problem);

/// Collects what is found while a project is loaded, in the order in which it is found.
class Problems {
 public:
  /// Something for which the project is not valid.
  void report(const JsonValue& at, std::string text);
  /// Something of the key of a member for which the project is not valid.
  void report_key(const JsonValue& member, std::string text);
  /// Something at a column of a text, in bytes, from 1, for which the project is not valid.
  void report_within(const JsonValue& at, std::size_t column, std::string text);
  /// Something that is legal and looks like a mistake.
  void warn(const JsonValue& at, std::string text);
  void warn_within(const JsonValue& at, std::size_t column, std::string text);

  std::size_t count() const noexcept { return errors_.size(); }
  bool none() const noexcept { return errors_.empty(); }

  std::vector<Problem> take_errors() { return std::move(errors_); }
  std::vector<Problem> take_warnings() { return std::move(warnings_); }

 private:
  std::vector<Problem> errors_;
  std::vector<Problem> warnings_;
};

/// What `shown` gives, in single quotes.
std::string quote(std::string_view text);

/// Names separated by commas; a long list is cut short.
std::string list_of(std::span<const std::string_view> names);

/// " (did you mean 'x'?)" for the nearest of the names, also one that differs in case alone; empty if none is
/// near.
std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> names);

/// Whether two names are the same without regard to case, as IEC 61131-3 has it.
bool same_name(std::string_view a, std::string_view b) noexcept;
/// The name in lower case.
std::string fold(std::string_view name);

}  // namespace lockstep
