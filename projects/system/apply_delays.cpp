#include "projects/system/apply_delays.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <system_error>

#include "projects/json/document.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// In a text `length` bytes from `begin` on give way to another text.
struct Edit {
  std::size_t begin = 0;
  std::size_t length = 0;
  std::string text;
};

struct File {
  std::string path;
  std::string text;
  std::unique_ptr<JsonDocument> document;
  std::map<std::size_t, Edit> edits;  // by the object's first byte
};

class DelayWriter {
 public:
  explicit DelayWriter(const System& system) : system_(system) {}

  void write(const DelayTime& delay);
  ChangedFiles take();

 private:
  File* open(const std::string& path);
  File* file_of(const std::string& path, std::string_view object, int depth);
  std::optional<Edit> edit_of(const JsonValue& object, const DelayTime& delay) const;

  const System& system_;
  std::map<std::string, File> files_;  // by their real path
  std::vector<std::string> problems_;
};

File* DelayWriter::open(const std::string& path) {
  std::error_code ignored;
  const std::string real = fs::weakly_canonical(path, ignored).string();
  File& file = files_[real];
  if (file.document == nullptr) {
    file.path = path;
    file.text = read_text_file(path, JsonDocument::kLongest);
    file.document = std::make_unique<JsonDocument>(file.text);
  }
  return file.document->usable() ? &file : nullptr;
}

/// The file in which an object stands: the project's own, or one that it includes.
File* DelayWriter::file_of(const std::string& path, std::string_view object, int depth) {
  constexpr int kDeepest = 100;
  File* const file = open(path);
  if (file == nullptr || depth > kDeepest) return nullptr;
  const JsonValue& root = file->document->root();
  if (const JsonValue* const objects = root.find("technology_objects");
      objects != nullptr && objects->find(object) != nullptr)
    return file;
  const JsonValue* const includes = root.find("include");
  if (includes == nullptr) return nullptr;
  for (const JsonValue* const name : includes->elements) {
    const std::string included = (fs::path(path).parent_path() / name->text).lexically_normal().string();
    if (File* const found = file_of(included, object, depth + 1)) return found;
  }
  return nullptr;
}

/// The number that is there gives way; what is not there is put behind the brace where it is missing.
std::optional<Edit> DelayWriter::edit_of(const JsonValue& object, const DelayTime& delay) const {
  const std::array<std::string, 3> path = {
      "config", delay.proxy ? "Parameter" : "CrossPlcSynchronousOperation", "LocalLeadingValueDelayTime"};
  const std::string number = decimal_text(*delay.computed);
  const JsonValue* value = &object;
  std::size_t depth = 0;
  while (depth < path.size() && value->kind == JsonKind::object) {
    const JsonValue* const next = value->find(path[depth]);
    if (next == nullptr) break;
    value = next;
    ++depth;
  }
  if (depth == path.size()) {
    if (value->kind != JsonKind::number) return std::nullopt;
    return Edit{value->begin(), value->text.size(), number};
  }
  if (value->kind != JsonKind::object) return std::nullopt;
  std::string added = number;
  for (std::size_t i = path.size(); i-- > depth;) {
    added = "\"" + path[i] + "\": " + added;
    if (i > depth) added = "{ " + added + " }";
  }
  return Edit{value->begin() + 1, 0, " " + added + (value->members.empty() ? " " : ",")};
}

void DelayWriter::write(const DelayTime& delay) {
  if (delay.fixed || !delay.computed || delay.is_current()) return;
  const SystemController& controller = system_.controllers[delay.object.controller];
  const std::string& name = delay.object.object->name;
  const std::string shown = full_name(controller, *delay.object.object);
  File* const file = file_of(controller.file, name, 0);
  if (file == nullptr)
    return problems_.push_back(shown + " is made by a template: its delay, " + decimal_text(*delay.computed) +
                               " s, has to be written there by hand");
  const JsonValue& object = *file->document->root().find("technology_objects")->find(name);
  const std::optional<Edit> edit = edit_of(object, delay);
  if (!edit) return problems_.push_back(shown + ": its delay is no number in " + file->path);
  const auto [before, first] = file->edits.try_emplace(object.begin(), *edit);
  if (!first && before->second.text != edit->text)
    problems_.push_back(shown + ": another controller runs " + file->path +
                        " too, and its delay is to be another one; allowed: a project for each");
}

ChangedFiles DelayWriter::take() {
  ChangedFiles changed;
  for (auto& [real, file] : files_) {
    if (file.edits.empty()) continue;
    std::vector<Edit> edits;
    for (const auto& [object, edit] : file.edits) edits.push_back(edit);
    std::ranges::sort(edits, std::greater<>(), &Edit::begin);
    for (const Edit& edit : edits) file.text.replace(edit.begin, edit.length, edit.text);
    changed.files.push_back({file.path, file.text, static_cast<int>(edits.size())});
  }
  changed.problems = std::move(problems_);
  return changed;
}

}  // namespace

ChangedFiles with_delays(const System& system, const Connections& connections) {
  DelayWriter writer(system);
  for (const DelayTime& delay : connections.delays()) writer.write(delay);
  return writer.take();
}

void replace_file(const std::string& named, const std::string& text) {
  const std::string path = fs::weakly_canonical(named).string();
  const std::string temporary = path + ".new";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) {
    const int error = errno;
    std::remove(temporary.c_str());
    throw std::system_error(error, std::generic_category(), temporary);
  }
  if (fs::exists(path)) fs::permissions(temporary, fs::status(path).permissions());
  fs::rename(temporary, path);
}

}  // namespace lockstep
