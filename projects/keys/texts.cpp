#include "projects/keys/texts.hpp"

#include <algorithm>
#include <limits>

#include "projects/json/fields.hpp"
#include "projects/keys/project.hpp"
#include "projects/keys/system.hpp"

namespace lockstep {
namespace {

bool is_bounded(const Range& range) {
  return range.lowest > -std::numeric_limits<double>::max() &&
         range.highest < std::numeric_limits<double>::max();
}

std::string limit_text(const Key& key, double limit) {
  if (key.kind == KeyKind::duration) return duration_text(static_cast<std::int64_t>(limit));
  if (key.kind == KeyKind::integer) return std::to_string(static_cast<std::int64_t>(limit));
  return decimal_text(limit);
}

std::string range_text(const Key& key) {
  std::string text;
  if (is_bounded(key.range))
    text = " from " + limit_text(key, key.range.lowest) + " to " + limit_text(key, key.range.highest);
  if (key.range.excluded == key.range.excluded) text += ", not " + decimal_text(key.range.excluded);
  return text;
}

std::string words_text(const Key& key) {
  std::string text;
  for (const Word& word : key.words) text += (text.empty() ? "" : ", ") + std::string(word.word);
  for (const int number : key.numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

std::string objects_text(ObjectKinds kinds) {
  std::string text;
  for (const ObjectKindText& kind : kObjectKinds)
    if (among(kind.kind, kinds)) text += (text.empty() ? "" : ", ") + std::string(kind.name);
  return text;
}

/// What one value is.
std::string single_text(const Key& key) {
  switch (key.kind) {
    case KeyKind::boolean:
      return "true, false";
    case KeyKind::integer:
      return key.numbers.empty() ? "integer" + range_text(key) : words_text(key);
    case KeyKind::number:
      return "number" + range_text(key);
    case KeyKind::duration:
      return "duration" + range_text(key);
    case KeyKind::word:
      return words_text(key);
    case KeyKind::title:
      return "text of 1 to " + std::to_string(key.longest) + " characters";
    case KeyKind::text:
      return key.form == nullptr ? "text" : std::string(key.form->what);
    case KeyKind::tag:
      return "name of a tag of type " + std::string(type_name(key.type));
    case KeyKind::signal:
      return "path of a signal";
    case KeyKind::object:
      return "name of an object: " + objects_text(key.objects);
    case KeyKind::positions:
      return "[from, to]";
    case KeyKind::constant:
      return "value";
    case KeyKind::structure:
    case KeyKind::variants:
      return "object";
    case KeyKind::selector:
      return "word";
    case KeyKind::unspecified:
    case KeyKind::defined:
      return std::string(key.what);
  }
  return "";
}

class Sections {
 public:
  std::vector<KeySection> made;

  void add(const std::string& path, std::string_view variant, Keys keys, std::string_view text) {
    const auto same =
        std::ranges::find(made, keys.data(), [](const KeySection& one) { return one.keys.data(); });
    if (same != made.end() && same->path == path) return;
    made.push_back({path, variant, keys, text, same != made.end() ? same->path : ""});
    for (const Key& key : keys) {
      const std::string below = (path.empty() ? "" : path + ".") + std::string(key.name);
      if (key.kind == KeyKind::structure) add(below, "", key.keys, key.text);
      for (const KeyVariant& one : key.variants) add(below, one.name, one.keys, key.text);
      if (key.definition == "call" && key.shape == KeyShape::list && path == "programs") add_calls(below);
    }
  }

 private:
  void add_calls(const std::string& path) {
    add(path, "fb", keys::kCall, "the call of a function block");
    add(path, "set", keys::kSet, "an assignment");
    add(path, "set_start", keys::kSetStart, "a change of a start value");
    add(path, "if", keys::kIf, "a branch");
  }
};

/// A cell of a table: bars would end it.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string heading_of(const KeySection& section) {
  std::string text = section.path.empty() ? "The file" : "`" + section.path + "`";
  if (!section.variant.empty()) text += ": " + std::string(section.variant);
  return text;
}

}  // namespace

std::string value_text(const Key& key) {
  const std::string one = single_text(key);
  switch (key.shape) {
    case KeyShape::one:
      return one;
    case KeyShape::list:
      return "[ " + one + ", … ]";
    case KeyShape::one_or_list:
      return one + ", or [ " + one + ", … ]";
    case KeyShape::named:
      return "{ name: " + one + ", … }";
  }
  return one;
}

std::string meaning_text(const Key& key) {
  std::string text(key.text);
  if (!key.unit.empty()) text += " [" + std::string(key.unit) + "]";
  return text;
}

std::optional<KeyValue> default_of(const Key& key) {
  if (key.fresh == nullptr || key.required || !key.otherwise.empty()) return std::nullopt;
  return key.fresh();
}

std::string_view word_of(const Key& key, std::int64_t value) {
  const auto word = std::ranges::find(key.words, value, &Word::value);
  return word == key.words.end() ? std::string_view() : word->word;
}

std::string default_text(const Key& key) {
  if (key.required) return "required";
  if (!key.otherwise.empty()) return std::string(key.otherwise);
  const auto value = default_of(key);
  if (!value) return "";
  if (key.kind == KeyKind::boolean) return value->integer != 0 ? "true" : "false";
  if (key.kind == KeyKind::integer) return std::to_string(value->integer);
  if (key.kind == KeyKind::number) return decimal_text(value->number);
  if (key.kind == KeyKind::duration) return duration_text(value->integer);
  return std::string(word_of(key, value->integer));
}

std::vector<KeySection> key_sections() {
  Sections sections;
  sections.add("", "", keys::kProject, "a project file");
  return std::move(sections.made);
}

std::vector<KeySection> system_key_sections() {
  Sections sections;
  sections.add("system", "", keys::kSystem, "a system file: several controllers and what is between them");
  return std::move(sections.made);
}

std::vector<KeySection> all_key_sections() {
  std::vector<KeySection> sections = key_sections();
  for (KeySection& section : system_key_sections()) sections.push_back(std::move(section));
  return sections;
}

std::string keys_document() {
  std::string text =
      "# The keys of a project file\n\n"
      "Made from the declarations in `projects/keys`; `LOCKSTEP_UPDATE=1 projects_tests "
      "--gtest_filter='Keys.*'` renews it. `lockstep describe keys` shows the same,\n"
      "`lockstep describe TO_SynchronousAxis` the variables that `config` sets, [CAMS.md](CAMS.md) how a cam "
      "is "
      "defined.\n"
      "A path leaves out names and indices: `technology_objects.drive` is the key `drive` of an object among "
      "`technology_objects`; what begins with `system` is of a system file.\n"
      "Every object listed here may have a `comment` too, a text for the reader; `lockstep tags` shows those "
      "of "
      "tags. `//` and `/* */` are comments as well.\n";
  for (const KeySection& section : all_key_sections()) {
    text += "\n## " + heading_of(section) + "\n\n" + std::string(section.text) + "\n\n";
    if (!section.same_as.empty()) {
      text += "The keys are those of `" + section.same_as + "`.\n";
      continue;
    }
    text += "| key | value | if not given | meaning |\n|---|---|---|---|\n";
    for (const Key& key : section.keys)
      text += "| `" + std::string(key.name) + "` | " + cell(value_text(key)) + " | " +
              cell(default_text(key)) + " | " + cell(meaning_text(key)) + " |\n";
  }
  return text;
}

}  // namespace lockstep
