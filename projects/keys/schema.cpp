#include "projects/keys/schema.hpp"

#include <algorithm>
#include <limits>

#include "projects/json/fields.hpp"
#include "projects/keys/texts.hpp"
#include "projects/literals/duration.hpp"

namespace lockstep {
namespace {

using Json = KeySchema::Json;

Json described(std::string_view description, const Json& schema) {
  Json result = {{"description", description}};
  result.update(schema);
  return result;
}

Json reference(std::string_view definition) {
  return {{"$ref", "#/definitions/" + std::string(definition)}};
}

bool is_end(double limit) {
  return std::abs(limit) >= std::numeric_limits<double>::max();
}

/// A number with its ends. A range that goes as far as the type does has none.
Json number(const Key& key) {
  const bool whole = key.kind == KeyKind::integer;
  const auto limit = [&](double value) {
    return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
  };
  Json schema = {{"type", whole ? "integer" : "number"}};
  if (!is_end(key.range.lowest)) schema["minimum"] = limit(key.range.lowest);
  if (!is_end(key.range.highest)) schema["maximum"] = limit(key.range.highest);
  if (key.range.excluded == key.range.excluded) schema["not"] = {{"const", key.range.excluded}};
  return schema;
}

Json words(std::span<const Word> list) {
  Json names = Json::array();
  for (const Word& word : list) names.push_back(word.word);
  return {{"enum", names}};
}

/// The default of a member; null if none is to be told.
Json default_value(const Key& key) {
  const auto value = default_of(key);
  if (!value || key.shape != KeyShape::one) return {};
  if (key.kind == KeyKind::boolean) return value->integer != 0;
  if (key.kind == KeyKind::integer) return value->integer;
  if (key.kind == KeyKind::number) return value->number;
  if (key.kind == KeyKind::duration) return duration_text(value->integer);
  const std::string_view word = word_of(key, value->integer);
  return word.empty() ? Json() : Json(word);
}

std::string description_of(const Key& key) {
  std::string text = meaning_text(key);
  if (key.kind == KeyKind::duration) text += ": a duration such as 10ms, 1.5s, T#1s500ms";
  if (!key.otherwise.empty()) text += " (if not given: " + std::string(key.otherwise) + ")";
  return text;
}

/// A value, or an array of values. Nothing that stands for one of them may be an array.
Json one_or_list(const Json& one) {
  Json schema = one;
  schema["items"] = one;
  schema["type"] = {one["type"], "array"};
  return schema;
}

Json shaped(KeyShape shape, Json one) {
  switch (shape) {
    case KeyShape::one:
      return one;
    case KeyShape::list:
      return {{"type", "array"}, {"items", std::move(one)}};
    case KeyShape::one_or_list:
      return one_or_list(one);
    case KeyShape::named:
      return {{"type", "object"}, {"additionalProperties", std::move(one)}};
  }
  return one;
}

}  // namespace

Json KeySchema::object(Keys keys) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : keys) {
    properties[std::string(key.name)] = value(key);
    if (key.required) required.push_back(key.name);
  }
  if (const std::string comment(keys::kComment.name); !properties.contains(comment))
    properties[comment] = value(keys::kComment);
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json KeySchema::value(const Key& key) {
  if (key.definition.empty()) {
    Json schema = described(description_of(key), shaped(key.shape, single(key)));
    if (Json value = default_value(key); !value.is_null()) schema["default"] = std::move(value);
    return schema;
  }
  const std::string name(key.definition);
  const bool inside = key.shape == KeyShape::list;  // each of a list is what is defined, else the whole
  if (key.kind != KeyKind::defined && !definitions.contains(name)) {
    Json schema = shaped(inside ? KeyShape::one : key.shape, single(key));
    definitions[name] = inside ? schema : described(description_of(key), schema);
  }
  return inside ? described(description_of(key), shaped(key.shape, reference(name))) : reference(name);
}

Json KeySchema::single(const Key& key) {
  switch (key.kind) {
    case KeyKind::boolean:
      return {{"type", "boolean"}};
    case KeyKind::integer:
      if (!key.numbers.empty())
        return {{"enum", Json(std::vector<int>(key.numbers.begin(), key.numbers.end()))}};
      return number(key);
    case KeyKind::number:
      return number(key);
    case KeyKind::word:
      return words(key.words);
    case KeyKind::title:
      return {{"type", "string"}, {"minLength", 1}, {"maxLength", key.longest}};
    case KeyKind::positions: {
      Key position = key;
      position.kind = KeyKind::number;
      return {{"type", "array"}, {"items", number(position)}, {"minItems", 2}, {"maxItems", 2}};
    }
    case KeyKind::constant:
      return {{"type", {"boolean", "number", "string"}}};
    case KeyKind::structure:
      return object(key.keys);
    case KeyKind::variants:
      return variants(key.variants);
    case KeyKind::unspecified:
    case KeyKind::defined:
      return Json::object();
    case KeyKind::duration:
      return {{"type", "string"}, {"pattern", duration_pattern()}};
    case KeyKind::text:
      if (key.form != nullptr) return {{"type", "string"}, {"pattern", key.form->pattern}};
      return {{"type", "string"}};
    case KeyKind::tag:
    case KeyKind::signal:
    case KeyKind::object:
    case KeyKind::selector:
      return {{"type", "string"}};
  }
  return Json::object();
}

/// One schema for each variant, chosen by its selector: of an object of an unknown kind only that is known.
Json KeySchema::variants(std::span<const KeyVariant> variants) {
  const auto selector = std::ranges::find(variants.front().keys, KeyKind::selector, &Key::kind);
  const std::string name(selector->name);
  Json names = Json::array();
  Json branches = Json::array();
  for (const KeyVariant& variant : variants) {
    names.push_back(variant.name);
    const Json is_it = {{"properties", {{name, {{"enum", {variant.name}}}}}}, {"required", {name}}};
    branches.push_back({{"if", is_it}, {"then", object(variant.keys)}});
  }
  const Json properties = {{name, described(selector->text, {{"enum", names}})}};
  return {{"type", "object"}, {"properties", properties}, {"required", {name}}, {"allOf", branches}};
}

}  // namespace lockstep
