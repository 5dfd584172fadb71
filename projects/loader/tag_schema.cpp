#include "projects/loader/tag_schema.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "projects/expressions/array_type.hpp"
#include "projects/expressions/string_type.hpp"
#include "projects/literals/duration.hpp"
#include "projects/loader/constant_schema.hpp"
#include "scheduler/text.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

/// What `init` is, if `type` is as said.
Json branch(Json type, Json init) {
  const Json is_it = {{"properties", {{"type", std::move(type)}}}, {"required", {"type"}}};
  return {{"if", is_it}, {"then", {{"properties", {{"init", std::move(init)}}}}}};
}

Json text_of(const std::string& pattern) {
  return {{"type", "string"}, {"pattern", pattern}};
}

}  // namespace

void add_tag_definitions(Json& definitions) {
  Json names = Json::array();
  Json branches = Json::array();
  for (int i = 0; i <= static_cast<int>(Type::TIME); ++i) {
    const Type type = static_cast<Type>(i);
    names.push_back(type_name(type));
    branches.push_back(branch({{"enum", {type_name(type)}}},
                              type == Type::TIME ? text_of(duration_pattern()) : constant_schema(type)));
  }
  branches.push_back(
      branch(text_of(string_type_pattern()), {{"type", "string"}, {"maxLength", kLongestText}}));
  branches.push_back(branch(text_of(array_type_pattern()), {{"type", "array"}}));
  definitions["tags"]["additionalProperties"]["allOf"] = branches;
  definitions["tag_type"] = {
      {"description",
       "elementary type, STRING[n], or ARRAY[lower..upper] OF an elementary type or of a structure of cams"},
      {"anyOf",
       {{{"description", "elementary type"}, {"enum", names}},
        {{"description", "text of up to n characters"},
         {"type", "string"},
         {"pattern", string_type_pattern()}},
        {{"description", "array"}, {"type", "string"}, {"pattern", array_type_pattern()}}}}};
  definitions["tag_type_of_values"] = {{"description", "type on the wire; it may narrow that of the signal"},
                                       {"enum", names}};
  definitions["initial_value"] = {
      {"description", "value at the start; of an array [element, ...] from the first one on"},
      {"type", {"boolean", "number", "string", "array"}}};
}

}  // namespace lockstep
