// Tags and stimuli: the named values of a project and their changes in a simulation.
#include <algorithm>

#include "projects/expressions/array_type.hpp"
#include "projects/expressions/constant.hpp"
#include "projects/expressions/string_type.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

std::optional<Type> read_type(const JsonValue* json, Problems& problems) {
  const auto text = read_string(json, problems);
  if (!text) return std::nullopt;
  if (const auto type = tag_type(*text)) return type;
  std::vector<std::string_view> names;
  for (int type = 0; type <= static_cast<int>(Type::TIME); ++type)
    names.push_back(type_name(static_cast<Type>(type)));
  problems.report(*json, "unknown type " + quote(*text) + did_you_mean(*text, names) +
                             "; allowed: " + list_of(names) +
                             ", STRING[n], ARRAY[lower..upper] OF one of them or of a structure of cams");
  return std::nullopt;
}

/// Memory for all arrays of a project, so that no file takes the machine down [byte].
constexpr std::size_t kMaximumArrayMemory = 64u << 20;

/// Values in arrays and texts that are kept: each is copied at the end of every tick.
constexpr std::size_t kMaximumKept = 10'000;

constexpr std::size_t kMaximumStrings = 10'000;

std::size_t values_of(const Array& array) {
  return array.count() * std::max<std::size_t>(array.element->members.size(), 1);
}

/// As many as two characters need.
std::size_t values_of(const Text& text) {
  return (text.capacity + 1) / 2;
}

/// Whether so many values more may be kept; if not, that is reported.
bool may_retain(std::size_t values, const JsonValue& json, const Loading& loading) {
  std::size_t kept = values;
  for (const ArrayTag* const other : loading.project.retain.arrays) kept += values_of(other->array);
  for (const StringTag& other : loading.controller().strings)
    if (other.retain) kept += values_of(other.text);
  if (kept <= kMaximumKept) return true;
  loading.problems.report(json, "with the " + std::to_string(values) + " values of this tag " +
                                    std::to_string(kept) +
                                    " values of arrays and texts are kept; allowed are " +
                                    std::to_string(kMaximumKept) + " in all of the project");
  return false;
}

bool read_retain(const Fields& fields, const Loading& loading) {
  const auto retain = read_value(fields, keys::kTag["retain"], loading);
  return retain && retain->integer != 0;
}

void load_array(const std::string& name, const JsonValue& json, const Loading& loading, bool named) {
  const Fields fields(json, keys::kTag, loading.problems);
  const auto array = read_array_type(*fields["type"], loading.problems);
  const bool retain = read_retain(fields, loading);
  if (!array) return;
  std::size_t memory = array->count() * array->element->size;
  for (const ArrayTag& other : loading.controller().arrays)
    memory += other.memory.size() * sizeof(std::uint64_t);
  if (memory > kMaximumArrayMemory)
    return loading.problems.report(*fields["type"], "the arrays of the project take more than " +
                                                        std::to_string(kMaximumArrayMemory >> 20) +
                                                        " MiB; that is all there is for them");
  ArrayTag& tag = loading.controller().add_array(name, *array);
  tag.comment = fields.comment();
  if (const JsonValue* const init = fields["init"]) read_array_values(*init, tag.array, loading.problems);
  if (retain && may_retain(values_of(tag.array), *fields["retain"], loading))
    loading.project.retain.arrays.push_back(&tag);
  if (named) loading.names().define(name, &tag);
}

void load_string(const std::string& name, const JsonValue& json, const Loading& loading, bool named) {
  const Fields fields(json, keys::kTag, loading.problems);
  const auto capacity = read_string_type(*fields["type"], loading.problems);
  const bool retain = read_retain(fields, loading);
  if (!capacity) return;
  if (loading.controller().strings.size() == kMaximumStrings)
    return loading.problems.report(*fields["type"], "there are more than " + std::to_string(kMaximumStrings) +
                                                        " tags of type STRING; allowed are these");
  StringTag tag{.name = name, .comment = std::string(fields.comment()), .initial = {}, .memory = {}};
  if (const JsonValue* const init = fields["init"])
    tag.initial = read_text_constant(*init, *capacity, loading.problems).value_or("");
  StringTag& added = loading.controller().add_string(std::move(tag), *capacity);
  if (retain) added.retain = may_retain(values_of(added.text), *fields["retain"], loading);
  if (named) loading.names().define(name, &added);
}

void load_tag(const std::string& name, const JsonValue& json, const Loading& loading) {
  const bool named = loading.add_name(json, name, {});
  const JsonValue* const declared = json.kind == JsonKind::object ? json.find("type") : nullptr;
  if (declared != nullptr && declared->kind == JsonKind::string && is_array_type(declared->text))
    return load_array(name, json, loading, named);
  if (declared != nullptr && declared->kind == JsonKind::string && is_string_type(declared->text))
    return load_string(name, json, loading, named);
  const Fields fields(json, keys::kTag, loading.problems);
  if (!fields.usable()) return;
  const auto type = read_type(fields["type"], loading.problems);
  const bool retain = read_retain(fields, loading);
  if (!type) return;
  Tag tag{.name = name, .type = *type, .retain = retain, .comment = std::string(fields.comment())};
  if (const JsonValue* const init = fields["init"])
    tag.initial = read_constant(*init, *type, loading.problems).value_or(Value{});
  if (named) loading.names().define(name, &loading.controller().add_tag(std::move(tag)));
}

void read_text_assignment(const StringTag& tag, const JsonValue& json, const Loading& loading,
                          std::vector<Assignment>& assignments) {
  const auto text = read_text_constant(json, tag.text.capacity, loading.problems);
  if (!text) return;
  const std::vector<Signal> signals = text_signals(tag.text);
  const std::vector<Value> values = text_values(*text, tag.text.capacity);
  for (std::size_t i = 0; i < signals.size(); ++i) assignments.push_back({signals[i], values[i]});
}

void load_stimulus(const JsonValue& json, const Loading& loading) {
  const Fields fields(json, keys::kStimulus, loading.problems);
  const auto at = read_value(fields, keys::kStimulus["at"], loading);
  if (const JsonValue* const command = fields["ascii"]) {
    if (at) load_scripted_command(*command, at->integer, loading);
    if (fields["set"] == nullptr) return;
  }
  if (fields.usable() && fields["set"] == nullptr)
    return loading.problems.report(json, "'set' is missing; allowed in its place: 'ascii', a command");
  for (const Assignment& one : read_assignments(fields["set"], "a stimulus", loading))
    if (at) loading.controller().stimuli.push_back({at->integer, one.place, one.value});
}

}  // namespace

std::vector<Assignment> read_assignments(const JsonValue* json, std::string_view who,
                                         const Loading& loading) {
  std::vector<Assignment> assignments;
  const JsonValue* const set = read_object(json, loading.problems);
  if (set == nullptr) return assignments;
  for (const auto& [path, value] : set->members) {
    if (const StringTag* const string = loading.names().find_string(path)) {
      read_text_assignment(*string, *value, loading, assignments);
      continue;
    }
    const auto place = loading.find(*value, path);
    if (!place) continue;
    if (place->tag == nullptr && place->array == nullptr) {
      loading.problems.report(*value, quote(path) + " is no tag; " + std::string(who) + " sets tags");
      continue;
    }
    if (const auto constant = read_constant(*value, place->signal.value_type(), loading.problems))
      assignments.push_back({place->signal, *constant});
  }
  return assignments;
}

void load_tags(const JsonValue& tags, const Loading& loading) {
  if (read_object(&tags, loading.problems) == nullptr) return;
  for (const auto& [name, json] : tags.members) load_tag(name, *json, loading);
}

void load_stimuli(const JsonValue& stimuli, const Loading& loading) {
  if (read_array(&stimuli, loading.problems) == nullptr) return;
  for (const JsonValue* const stimulus : stimuli.elements) load_stimulus(*stimulus, loading);
}

}  // namespace lockstep
