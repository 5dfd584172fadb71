/// Problems of a project file: where, what is wrong, what is allowed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/network/visible_text.hpp"

namespace lockstep {

class JsonValue;

/// One thing that is wrong with a project file, or that is legal and looks like a mistake.
struct Problem {
  std::string place;  ///< JSON pointer; "line:column" for a syntax error
  std::string text;   ///< what is wrong, what is allowed; one line
  bool operator==(const Problem&) const = default;
};

/// The line to show: "FILE:place: text".
std::string to_string(std::string_view file, const Problem& problem);

/// Collects what is found while a project is loaded, in the order in which it is found.
class Problems {
 public:
  /// Something for which the project is not valid.
  void report(const JsonValue& at, std::string text);
  /// Something that is legal and looks like a mistake.
  void warn(const JsonValue& at, std::string text);

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
