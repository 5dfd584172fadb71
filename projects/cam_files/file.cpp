#include "projects/cam_files/file.hpp"

#include <filesystem>

#include "projects/assembly/sources.hpp"
#include "projects/cam_files/fields.hpp"
#include "projects/cam_files/table.hpp"
#include "projects/json/fields.hpp"
#include "projects/json/named_file.hpp"

namespace lockstep {
namespace {

/// A file beside the project. Its problems are told with the place in it.
void define_by_file(const JsonValue& object, const std::string& folder, const std::string& top,
                    CamDefinition& definition, Problems& problems) {
  const JsonValue& file = *object.find("file");
  for (const char* key : {"elements", "optimization", "points", "segments"})
    if (const JsonValue* const value = object.find(key))
      problems.report(*value, "is not allowed beside a file, which defines the cam");
  const auto name = read_title(&file, problems);
  if (!name) return;
  const std::optional<std::string> path = named_file(file, folder, top, problems);
  if (!path) return;
  try {
    LoadedCam loaded = load_cam_file(*path, "", definition.capacity);
    for (const Problem& problem : loaded.problems) problems.report(file, to_string(*name, problem));
    for (const Problem& warning : loaded.warnings) problems.warn(file, to_string(*name, warning));
    if (!loaded.definition) return;
    if (loaded.definition->cam.points.size() > definition.capacity)
      problems.report(file, "the cam in the file takes " +
                                std::to_string(loaded.definition->cam.points.size()) +
                                " points; allowed are " + std::to_string(definition.capacity));
    const std::size_t capacity = definition.capacity;
    definition = std::move(*loaded.definition);
    definition.capacity = capacity;
  } catch (const UnreadableFile& error) {
    problems.report(file, std::string("cannot be read: ") + error.what());
  }
}

/// InterpolationSettings of a technology object; what it does not give stays.
void read_settings(const JsonValue& object, TO_Cam_Struct_InterpolationSettings& settings,
                   Problems& problems) {
  settings = {};
  const JsonValue* value = &object;
  for (const char* key : {"config", "InterpolationSettings"})
    if (value != nullptr) value = value->find(key);
  if (value == nullptr) return;
  if (const auto mode = read_integer(value->find("InterpolationMode"), 0, 2, problems))
    settings.InterpolationMode = static_cast<DINT>(*mode);
  if (const auto boundary = read_integer(value->find("BoundaryConditions"), 0, 1, problems))
    settings.BoundaryConditions = static_cast<DINT>(*boundary);
}

/// The cam with a name in a project. The rest of the project is not looked at: that is for `lockstep check`.
void read_project(const JsonValue& root, const std::string& folder, const std::string& name,
                  CamDefinition& definition, Problems& problems) {
  const JsonValue* const objects = root.find("technology_objects");
  static const std::vector<JsonValue::Member>
      kNone;  // a choice between a list and a temporary would be a copy
  const std::vector<JsonValue::Member>& members = objects != nullptr ? objects->members : kNone;
  std::vector<std::string_view> cams;
  const JsonValue* found = nullptr;
  for (const auto& [key, object] : members) {
    const JsonValue* const type = object->find("type");
    if (type == nullptr || !type->text.starts_with("TO_Cam")) continue;
    cams.push_back(key);
    if (same_name(key, name)) found = object;
  }
  if (found == nullptr) {
    const std::string asked = name.empty()
                                  ? "this is a project: name one of its cams with --cam"
                                  : "the project has no cam " + quote(name) + did_you_mean(name, cams);
    problems.report(objects != nullptr ? *objects : root,
                    asked + (cams.empty() ? "; it has none" : "; it has: " + list_of(cams)));
    return;
  }
  definition.name = name;
  definition.capacity = found->find("type")->text == "TO_Cam_10k" ? kCam10kPoints : kCamPoints;
  read_settings(*found, definition.design.interpolation, problems);
  const JsonValue* const file = found->find("file");
  read_cam_definition(*found, file != nullptr ? file->source()->folder() : folder, folder,
                      CamWithoutCurve::refused, definition, problems);
}

/// The cam of a project, of which other files may be parts.
LoadedCam load_from_project(std::string_view text, const std::string& folder, const std::string& name) {
  LoadedCam loaded;
  ProjectSources sources(text, folder);
  loaded.problems = sources.take_problems();
  if (!sources.usable()) return loaded;
  CamDefinition definition;
  Problems problems;
  read_project(sources.root(), folder, name, definition, problems);
  for (Problem& problem : problems.take_errors()) loaded.problems.push_back(std::move(problem));
  loaded.warnings = problems.take_warnings();
  if (loaded.problems.empty()) loaded.definition = std::move(definition);
  return loaded;
}

LoadedCam load_json(std::string_view text, const std::string& folder, const std::string& name) {
  LoadedCam loaded;
  const JsonDocument document(text);
  loaded.problems = document.problems();
  if (!document.usable()) return loaded;
  CamDefinition definition;
  Problems problems;
  const JsonValue& root = document.root();
  if (root.find("lockstep") != nullptr) return load_from_project(text, folder, name);
  if (!name.empty())
    problems.report(root, "--cam names a cam of a project, and this file is none");
  else
    read_cam_document(root, definition, problems);
  for (Problem& problem : problems.take_errors()) loaded.problems.push_back(std::move(problem));
  loaded.warnings = problems.take_warnings();
  if (loaded.problems.empty()) loaded.definition = std::move(definition);
  return loaded;
}

}  // namespace

void read_cam_definition(const JsonValue& object, const std::string& folder, const std::string& top,
                         CamWithoutCurve without_curve, CamDefinition& definition, Problems& problems) {
  if (object.find("file") != nullptr) return define_by_file(object, folder, top, definition, problems);
  read_cam_members(object, without_curve, definition, problems);
}

LoadedCam load_cam(std::string_view text, const std::string& folder, const std::string& name,
                   std::size_t capacity) {
  LoadedCam loaded;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const auto first =
      text.find_first_not_of(" \t\r\n", text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  if (first == text.npos) {
    loaded.problems.push_back(
        {"1:1", "the file is empty; a cam is a JSON object or a table of points or elements"});
    return loaded;
  }
  if (text.size() > JsonDocument::kLongest) {
    loaded.problems.push_back(
        {"1:1", "the file is longer than " + std::to_string(JsonDocument::kLongest >> 20) + " MiB"});
    return loaded;
  }
  constexpr std::string_view kJsonBegins = "{[/";  // an object, an array, a comment
  if (kJsonBegins.find(text[first]) != kJsonBegins.npos) return load_json(text, folder, name);
  if (!name.empty()) {
    loaded.problems.push_back({"1:1", "--cam names a cam of a project, and this file is none"});
    return loaded;
  }
  CamDefinition definition;
  definition.capacity = capacity;
  read_cam_table(text, definition, loaded.problems, loaded.warnings);
  if (loaded.problems.empty()) loaded.definition = std::move(definition);
  return loaded;
}

LoadedCam load_cam_file(const std::string& path, const std::string& name, std::size_t capacity) {
  return load_cam(read_text_file(path, JsonDocument::kLongest),
                  std::filesystem::path(path).parent_path().string(), name, capacity);
}

}  // namespace lockstep
