#include "projects/assembly/sources.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "projects/assembly/templates.hpp"
#include "projects/json/fields.hpp"
#include "projects/json/named_file.hpp"
#include "projects/json/text_file.hpp"
#include "projects/keys/parts.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// The path of a file by which it is known again; empty with an error if there is none.
fs::path real_path(const std::string& path, std::error_code& error) {
  return fs::canonical(path.empty() ? fs::path(".") : fs::path(path), error);
}

/// Of an object a member takes the place of one of the same key.
void put(JsonValue& object, std::string_view key, const JsonValue& value) {
  const auto member = std::ranges::find(object.members, key, &JsonValue::Member::key);
  if (member != object.members.end())
    member->value = &value;
  else
    object.members.push_back({std::string(key), &value});
}

constexpr std::string_view kNamed[] = {"technology_objects", "transfer_areas", "tags", "templates"};
constexpr std::string_view kListed[] = {"programs", "stimuli", "expectations", "instances"};
constexpr std::pair<std::string_view, std::string_view> kInner[] = {{"modbus", "map"}, {"trace", "signals"}};

}  // namespace

/// The files from the project to one of them, each included by the one above.
struct ProjectSources::Including {
  std::string path;
  std::string shown;
  const Including* above;
};

ProjectSources::ProjectSources(std::string_view text, const std::string& folder, const std::string& path) {
  const JsonDocument* const project = read(text, "", folder);
  if (project == nullptr) return;
  const JsonValue& root = project->root();
  root_ = made_from(root);
  std::error_code ignored;
  const Including top{path.empty() ? "" : real_path(path, ignored).string(),
                      path.empty() ? "the project" : fs::path(path).filename().string(), nullptr};
  top_ = real_path(folder, ignored).string();
  include_all(root, folder, &top);
  merge(root);
  for (Problem& problem : found_.take_errors()) problems_.push_back(std::move(problem));
  // With too many values there is nothing to look at.
  if (root.kind == JsonKind::object && !expand_templates(*root_, made_, texts_, problems_)) root_ = nullptr;
}

const JsonDocument* ProjectSources::read(std::string_view text, std::string file, std::string folder) {
  const JsonDocument& document = documents_.emplace_back(text, std::move(file), std::move(folder));
  problems_.insert(problems_.end(), document.problems().begin(), document.problems().end());
  bytes_ += text.size();
  values_ += document.size();
  return document.usable() ? &document : nullptr;
}

void ProjectSources::include_all(const JsonValue& including, const std::string& folder,
                                 const Including* files) {
  const JsonValue* const list = including.find("include");
  if (read_array(list, found_) == nullptr) return;
  for (const JsonValue* const name : list->elements) include(*name, folder, files);
}

void ProjectSources::include(const JsonValue& name, const std::string& folder, const Including* files) {
  if (!read_title(&name, found_)) return;
  const std::string shown = (fs::path(folder) / name.text).lexically_normal().string();
  std::error_code error;
  const fs::path path = real_path(shown, error);
  if (error)
    return found_.report(name, name.shown() + " cannot be included: " + error.message() +
                                   "; allowed: a file, relative to the one that includes it");
  if (fs::path(name.text).is_absolute() || top_.empty() || !stays_within(path.string(), top_))
    return found_.report(
        name, name.shown() + " leads out of the folder of the project; allowed: files in it and below it");
  if (!fs::is_regular_file(path, error))
    return found_.report(name,
                         name.shown() + " is no file; allowed: a file, relative to the one that includes it");
  std::string chain = name.shown();
  for (const Including* file = files; file != nullptr; file = file->above) {
    chain = quote(file->shown) + " → " + chain;
    if (file->path == path.string())
      return found_.report(name, name.shown() + " includes itself: " + chain + "; allowed: each file once");
  }
  const auto [before, first] = included_.try_emplace(path.string(), &name);
  if (!first)
    return found_.report(name, name.shown() + " is included already" + other_place(*before->second, name) +
                                   "; allowed: each file once");
  if (included_.size() > kMaximumFiles)
    return found_.report(name, "the project includes more than " + std::to_string(kMaximumFiles) +
                                   " files; that is all there may be");
  const std::size_t left = JsonDocument::kLongest - std::min(bytes_, JsonDocument::kLongest);
  std::string text;
  try {
    text = read_text_file(shown, left);
  } catch (const UnreadableFile& unreadable) {
    return found_.report(name, name.shown() + " cannot be read: " + unreadable.what());
  }
  if (text.size() > left)
    return found_.report(name, "with " + name.shown() + " the files of the project are longer than " +
                                   std::to_string(JsonDocument::kLongest >> 20) +
                                   " MiB; that is all there may be");
  const std::string its_folder = fs::path(shown).parent_path().string();
  const JsonDocument* const part = read(text, shown, its_folder);
  if (part == nullptr) return;
  if (values_ > JsonDocument::kMaximumValues)
    return found_.report(name, "with " + name.shown() + " the files of the project have more than " +
                                   std::to_string(JsonDocument::kMaximumValues) + " values");
  const Fields fields(part->root(), keys::kPart, found_);
  if (!fields.usable()) return;
  read_string(fields["$schema"], found_);
  if (const JsonValue* const modbus = fields["modbus"]) const Fields map(*modbus, keys::kPartMap, found_);
  if (const JsonValue* const trace = fields["trace"])
    const Fields signals(*trace, keys::kPartSignals, found_);
  const Including file{path.string(), shown, files};
  include_all(part->root(), its_folder, &file);
  parts_.push_back(&part->root());
}

JsonValue* ProjectSources::made_from(const JsonValue& value) {
  return &made_.emplace_back(value);
}

void ProjectSources::merge(const JsonValue& project) {
  if (project.kind != JsonKind::object || parts_.empty()) return;
  parts_.push_back(&project);
  for (const std::string_view key : kNamed) merge_section(key, JsonKind::object);
  for (const std::string_view key : kListed) merge_section(key, JsonKind::array);
  for (const auto& [key, inner] : kInner) merge_inner(key, inner);
}

/// What all files have, in place of what the project alone has.
const JsonValue* ProjectSources::merged(const std::vector<const JsonValue*>& sections, JsonKind kind) {
  JsonValue* whole = nullptr;
  std::vector<JsonValue::Member> members;
  std::vector<const JsonValue*> elements;
  for (const JsonValue* const section : sections) {
    if ((kind == JsonKind::object ? read_object(section, found_) : read_array(section, found_)) == nullptr)
      continue;
    whole = made_from(*section);  // of the project itself, if that has one
    members.insert(members.end(), section->members.begin(), section->members.end());
    elements.insert(elements.end(), section->elements.begin(), section->elements.end());
  }
  if (whole == nullptr) return nullptr;
  whole->members = std::move(members);
  whole->elements = std::move(elements);
  return whole;
}

void ProjectSources::merge_section(std::string_view key, JsonKind kind) {
  std::vector<const JsonValue*> sections;
  for (const JsonValue* const part : parts_)
    if (const JsonValue* const section = part->find(key)) sections.push_back(section);
  if (sections.empty() || (sections.size() == 1 && parts_.back()->find(key) != nullptr)) return;
  if (const JsonValue* const whole = merged(sections, kind)) put(*root_, key, *whole);
}

void ProjectSources::merge_inner(std::string_view key, std::string_view inner) {
  std::vector<const JsonValue*> sections;
  const JsonValue* outer = nullptr;
  for (const JsonValue* const part : parts_) {
    const JsonValue* const found = part->find(key);
    if (found != nullptr && found->kind != JsonKind::object && part == parts_.back()) return;
    if (found == nullptr || found->kind != JsonKind::object) continue;
    outer = found;
    if (const JsonValue* const section = found->find(inner)) sections.push_back(section);
  }
  const JsonValue* const whole = merged(sections, JsonKind::array);
  if (whole == nullptr) return;
  JsonValue* const made = made_from(*outer);
  if (outer != parts_.back()->find(key)) made->members.clear();  // what else a part has there is reported
  put(*made, inner, *whole);
  put(*root_, key, *made);
}

}  // namespace lockstep
