// Problems, declared in problem.hpp, that are told of a value of a document: with its place there.
#include <string>
#include <utility>

#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"

namespace lockstep {

Problem problem_at(const JsonValue& value, std::string text) {
  const SourcePosition position = value.position();
  return {.place = value.pointer(),
          .text = std::move(text),
          .file = value.source() == nullptr ? "" : value.source()->file(),
          .line = position.line,
          .column = position.column,
          .owner = value.owner()};
}

Problem problem_at_key(const JsonValue& member, std::string text) {
  Problem problem = problem_at(member, std::move(text));
  const SourcePosition position = member.key_position();
  problem.line = position.line;
  problem.column = position.column;
  return problem;
}

Problem problem_within(const JsonValue& value, std::size_t column, std::string text) {
  Problem problem = problem_at(value, std::move(text));
  // Where the text has escapes, or is that of an instance, its columns are none of the file.
  const bool as_written =
      value.source() != nullptr && value.kind == JsonKind::string &&
      value.source()->text().compare(value.begin() + 1, value.text.size() + 1, value.text + "\"") == 0;
  if (as_written)
    problem.column = value.source()->position(value.begin() + column).column;
  else
    problem.text += " (character " + std::to_string(column) + " of the text)";
  return problem;
}

std::string other_place(const JsonValue& other, const JsonValue& value) {
  if (other.source() == nullptr) return "";
  std::string text = " in ";
  if (other.source() != value.source())
    text += (other.source()->file().empty() ? "the project file" : other.source()->file()) + ", ";
  text += "line " + std::to_string(other.key_position().line);
  const std::string owner = other.owner();
  return owner.empty() ? text : text + " (" + owner + ")";
}

void Problems::report(const JsonValue& at, std::string text) {
  errors_.push_back(problem_at(at, std::move(text)));
}

void Problems::report_key(const JsonValue& member, std::string text) {
  errors_.push_back(problem_at_key(member, std::move(text)));
}

void Problems::report_within(const JsonValue& at, std::size_t column, std::string text) {
  errors_.push_back(problem_within(at, column, std::move(text)));
}

void Problems::warn_within(const JsonValue& at, std::size_t column, std::string text) {
  warnings_.push_back(problem_within(at, column, std::move(text)));
}

void Problems::warn(const JsonValue& at, std::string text) {
  warnings_.push_back(problem_at(at, std::move(text)));
}

}  // namespace lockstep
