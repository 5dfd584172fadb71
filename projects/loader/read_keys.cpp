#include "projects/loader/read_keys.hpp"

#include <algorithm>

namespace lockstep {
namespace {

std::int64_t integer_of(double limit) {
  constexpr double kMaximum = 9.2e18;
  if (limit > kMaximum) return INT64_MAX;
  return limit < -kMaximum ? INT64_MIN : static_cast<std::int64_t>(limit);
}

std::optional<KeyValue> read_number(const JsonValue& json, const Key& key, Problems& problems) {
  const auto value = read_number(&json, key.range.lowest, key.range.highest, problems);
  if (!value) return std::nullopt;
  if (*value == key.range.excluded) {
    problems.report(json, "a " + std::string(key.name) + " of " + json.shown() +
                              " is not allowed; allowed: any other number");
    return std::nullopt;
  }
  return KeyValue{.number = *value};
}

std::optional<KeyValue> read_integer(const JsonValue& json, const Key& key, Problems& problems) {
  const auto value =
      read_integer(&json, integer_of(key.range.lowest), integer_of(key.range.highest), problems);
  if (!value) return std::nullopt;
  if (key.numbers.empty() || std::ranges::find(key.numbers, *value) != key.numbers.end())
    return KeyValue{.integer = *value};
  std::string allowed;
  for (const int number : key.numbers) allowed += (allowed.empty() ? "" : ", ") + std::to_string(number);
  report_kind(json, allowed, problems);
  return std::nullopt;
}

std::optional<KeyValue> read_duration(const JsonValue& json, const Key& key, Problems& problems) {
  constexpr double kSecond = 1e9;  // [ns]
  const auto value =
      read_duration(&json, integer_of(key.range.lowest), integer_of(key.range.highest), problems);
  if (!value) return std::nullopt;
  return KeyValue{.number = static_cast<double>(*value) / kSecond, .integer = *value};
}

std::optional<KeyValue> read_word(const JsonValue& json, const Key& key, Problems& problems) {
  std::vector<std::string_view> words;
  for (const Word& word : key.words) words.push_back(word.word);
  const auto index = read_word(&json, words, problems);
  if (!index) return std::nullopt;
  return KeyValue{.integer = key.words[*index].value};
}

/// The memory of a tag of the type that the key asks for.
std::optional<KeyValue> read_tag(const JsonValue& json, const Key& key, const Loading& loading) {
  const auto name = read_string(&json, loading.problems);
  if (!name) return std::nullopt;
  const auto found = loading.find(json, *name);
  if (!found) return std::nullopt;
  if (found->tag != nullptr && found->signal.type == key.type)
    return KeyValue{.text = *name, .address = found->signal.address};
  const std::string type(type_name(key.type));
  const bool vowel = type.front() == 'L' || type.front() == 'I';  // as they are spoken
  loading.problems.report(json, json.shown() + " is not allowed here; allowed: the name of " +
                                    (vowel ? "an " : "a ") + type + " tag");
  return std::nullopt;
}

std::optional<KeyValue> read_object_name(const JsonValue& json, const Key& key, const Loading& loading) {
  TechnologyObject* const object = loading.find_object(&json, key.objects);
  if (object == nullptr) return std::nullopt;
  return KeyValue{.address = object};
}

/// [from, to] with from ≤ to.
std::optional<KeyValue> read_positions(const JsonValue& json, const Key& key, Problems& problems) {
  constexpr std::string_view kAllowed = "two positions [from, to], from not greater than to";
  if (json.kind != JsonKind::array || json.elements.size() != 2) {
    report_kind(json, kAllowed, problems);
    return std::nullopt;
  }
  const auto from = read_number(*json.elements[0], key, problems);
  const auto to = read_number(*json.elements[1], key, problems);
  if (!from || !to) return std::nullopt;
  if (from->number <= to->number) return KeyValue{.number = from->number, .second = to->number};
  problems.report(json, std::string("from is greater than to; allowed: ") + std::string(kAllowed));
  return std::nullopt;
}

std::optional<KeyValue> read_text(std::optional<std::string_view> text) {
  if (!text) return std::nullopt;
  return KeyValue{.text = *text};
}

/// A structure, or each of a list of them, into what the key says is to hold it.
void read_structure(const JsonValue& json, const Key& key, void* target, const Loading& loading) {
  if (key.shape == KeyShape::one)
    return read_members({json, key.keys, loading.problems}, key.keys, key.part(target), loading);
  if (read_array(&json, loading.problems) == nullptr) return;
  for (const JsonValue* const element : json.elements)
    read_members({*element, key.keys, loading.problems}, key.keys, key.part(target), loading);
}

}  // namespace

std::optional<KeyValue> read_value(const JsonValue* json, const Key& key, const Loading& loading) {
  if (json == nullptr) return std::nullopt;
  Problems& problems = loading.problems;
  switch (key.kind) {
    case KeyKind::boolean:
      if (const auto value = read_bool(json, problems)) return KeyValue{.integer = *value ? 1 : 0};
      return std::nullopt;
    case KeyKind::integer:
      return read_integer(*json, key, problems);
    case KeyKind::number:
      return read_number(*json, key, problems);
    case KeyKind::duration:
      return read_duration(*json, key, problems);
    case KeyKind::word:
      return read_word(*json, key, problems);
    case KeyKind::title:
      return read_text(read_title(json, problems, key.longest));
    case KeyKind::tag:
      return read_tag(*json, key, loading);
    case KeyKind::object:
      return read_object_name(*json, key, loading);
    case KeyKind::positions:
      return read_positions(*json, key, problems);
    default:
      return read_text(key.form == nullptr ? read_string(json, problems)
                                           : read_form(json, *key.form, problems));
  }
}

std::optional<std::size_t> read_variant(const JsonValue& json, std::span<const KeyVariant> variants,
                                        Problems& problems) {
  if (json.kind != JsonKind::object) return std::nullopt;
  const auto selector = std::ranges::find(variants.front().keys, KeyKind::selector, &Key::kind);
  std::vector<std::string_view> names;
  for (const KeyVariant& variant : variants) names.push_back(variant.name);
  return read_word(json.find(selector->name), names, problems);
}

std::size_t variant_of(const TechnologyObject& object) noexcept {
  return static_cast<std::size_t>(std::ranges::find(kObjectKinds, object.kind, &ObjectKindText::kind) -
                                  kObjectKinds.begin());
}

void read_members(const Fields& fields, Keys keys, void* target, const Loading& loading) {
  for (const Key& key : keys) {
    const JsonValue* const json = fields[key.name];
    if (json == nullptr) continue;
    if (key.part != nullptr) {
      read_structure(*json, key, target, loading);
    } else if (key.store != nullptr) {
      if (const auto value = read_value(json, key, loading)) key.store(target, *value);
    }
  }
}

}  // namespace lockstep
