/// The files of a project: its own and those that it includes, as one tree of values.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "projects/json/document.hpp"

namespace lockstep {

/// A project's values as if they stood in one file, of which each still knows where it stands. What a file
/// includes comes before what it holds itself; instances of templates come last.
class ProjectSources {
 public:
  static constexpr std::size_t kMaximumFiles = 100;  ///< that a project may include

  /// Reads the included files and expands the templates. All that is wrong with them is among the problems.
  /// @param folder to which included files are relative, and which they may not leave; empty: the current one
  /// @param path of the project file, so that it is not included itself; empty: it is none
  ProjectSources(std::string_view text, const std::string& folder, const std::string& path = "");

  /// Whether there is a project to look at; problems there may be nevertheless.
  bool usable() const noexcept { return root_ != nullptr; }
  /// Only if usable. It has all sections of the project and none of `include`, `templates`, `instances`.
  const JsonValue& root() const noexcept { return *root_; }
  std::vector<Problem> take_problems() { return std::move(problems_); }

 private:
  struct Including;

  const JsonDocument* read(std::string_view text, std::string file, std::string folder);
  void include_all(const JsonValue& including, const std::string& folder, const Including* files);
  void include(const JsonValue& name, const std::string& folder, const Including* files);
  JsonValue* made_from(const JsonValue& value);
  void merge(const JsonValue& project);
  const JsonValue* merged(const std::vector<const JsonValue*>& sections, JsonKind kind);
  void merge_section(std::string_view key, JsonKind kind);
  void merge_inner(std::string_view key, std::string_view inner);

  Problems found_;
  std::vector<Problem> problems_;
  std::deque<JsonDocument> documents_;
  std::deque<JsonValue> made_;                                  // in place of those of several files
  std::deque<std::string> texts_;                               // of instances
  std::vector<const JsonValue*> parts_;                         // roots of included files, in their order
  std::unordered_map<std::string, const JsonValue*> included_;  // by path: where
  std::string top_;                                             // folder that no file may leave
  std::size_t bytes_ = 0;
  std::size_t values_ = 0;
  JsonValue* root_ = nullptr;
};

/// The project as one JSON text without includes, templates and instances, for reading and for loading.
std::string expanded_text(const JsonValue& root);

}  // namespace lockstep
