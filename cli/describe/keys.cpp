// The keys of the project file.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "projects/json/problem.hpp"
#include "projects/keys/texts.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string path_of(const KeySection& section, const Key& key) {
  return (section.path.empty() ? "" : section.path + ".") + std::string(key.name);
}

Table table_of_keys() {
  return Table({"Key", "Value", "If not given", ""});
}

void add_row(Table& table, const Key& key) {
  table.row({std::string(key.name), value_text(key), default_text(key), meaning_text(key)});
}

std::string heading_of(const KeySection& section) {
  std::string text = section.path.empty() ? "project file" : section.path;
  if (!section.variant.empty()) text += ": " + std::string(section.variant);
  return text + "\n";
}

std::string section_text(const KeySection& section, std::size_t width) {
  Table table = table_of_keys();
  for (const Key& key : section.keys) add_row(table, key);
  return heading_of(section) + paragraph(section.text, 2, width) + table.text(2, width);
}

Json key_json(const Key& key) {
  Json json{{"name", key.name}, {"required", key.required}, {"value", value_text(key)}};
  if (!key.required && !default_text(key).empty()) json["otherwise"] = default_text(key);
  json["text"] = meaning_text(key);
  return json;
}

Json section_json(const KeySection& section) {
  Json json{{"path", section.path}};
  if (!section.variant.empty()) json["variant"] = section.variant;
  json["text"] = section.text;
  auto& list = json["keys"] = Json::array();
  for (const Key& key : section.keys) list.push_back(key_json(key));
  return json;
}

Json sections_json(const std::vector<KeySection>& sections) {
  Json json{{"kind", "keys"}};
  auto& list = json["structures"] = Json::array();
  for (const KeySection& section : sections) list.push_back(section_json(section));
  return json;
}

std::string key_overview_text(std::size_t width) {
  const std::vector<KeySection> sections = all_key_sections();
  Table table({"Structure", ""});
  for (const KeySection& section : sections) {
    if (section.path.empty()) continue;
    const std::string variant = section.variant.empty() ? "" : ": " + std::string(section.variant);
    table.row({section.path + variant, std::string(section.text)});
  }
  return section_text(sections.front(), width) + "\n" + table.text(0, width);
}

std::string sections_text(const std::vector<KeySection>& sections, std::size_t width) {
  std::string text;
  for (const KeySection& section : sections)
    text += (text.empty() ? "" : "\n") + section_text(section, width);
  return text;
}

/// Of every object, without standing among its keys.
constexpr Key kAnywhere = [] {
  Key key = keys::kComment;
  key.text =
      "for the reader: every object of the file may have one, every call too; lockstep tags shows those of "
      "tags. // to the end of a line and /* */ are comments as well";
  return key;
}();

std::string single_text(const std::string& path, const Key& key, std::size_t width) {
  Table table = table_of_keys();
  add_row(table, key);
  return path + "\n" + table.text(2, width);
}

}  // namespace

std::vector<std::string> key_paths() {
  std::vector<std::string> paths;
  for (const KeySection& section : all_key_sections())
    for (const Key& key : section.keys) paths.push_back(path_of(section, key));
  return paths;
}

const Key& comment_key() {
  return kAnywhere;
}

Subject keys_subject(std::string_view path) {
  if (path.empty()) return {&key_overview_text, [] { return sections_json(all_key_sections()); }};
  std::vector<KeySection> found;
  for (const KeySection& section : all_key_sections())
    if (same_name(section.path, path)) found.push_back(section);
  if (!found.empty())
    return {[found](std::size_t width) { return sections_text(found, width); },
            [found] { return sections_json(found); }};
  const auto single = [](const std::string& whole, const Key& key) -> Subject {
    return {[whole, key](std::size_t width) { return single_text(whole, key, width); },
            [whole, key] {
              Json json{{"kind", "key"}, {"path", whole}};
              json.update(key_json(key));
              return json;
            }};
  };
  for (const KeySection& section : all_key_sections())
    for (const Key& key : section.keys)
      if (const std::string whole = path_of(section, key); same_name(whole, path)) return single(whole, key);
  const auto point = path.rfind('.');
  const std::string_view of = point == path.npos ? "" : path.substr(0, point);
  if (same_name(path.substr(point + 1), kAnywhere.name))
    for (const KeySection& section : all_key_sections())
      if (same_name(section.path, of)) return single(std::string(path), kAnywhere);
  return {};
}

}  // namespace lockstep::cli
