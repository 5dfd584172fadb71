#include "projects/cam_files/schema.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "projects/cam_files/fields.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;
using Members = std::vector<std::pair<std::string_view, Json>>;

Json described(std::string_view text, const Json& schema) {
  Json result = {{"description", text}};
  result.update(schema);
  return result;
}

Json number(std::string_view text) {
  return described(text,
                   {{"type", "number"}, {"minimum", -kLargestCamNumber}, {"maximum", kLargestCamNumber}});
}
Json flag(std::string_view text) {
  return described(text, {{"type", "boolean"}});
}
Json text(std::string_view description) {
  return described(description, {{"type", "string"}});
}
Json one_of(std::string_view text, std::span<const std::string_view> list) {
  return described(text, {{"enum", std::vector<std::string_view>(list.begin(), list.end())}});
}
Json count(std::string_view text) {
  return described(text, {{"type", "integer"}, {"minimum", 2}, {"maximum", kCam10kPoints}});
}
/// The name of a definition: a reference is an URI, which has no blanks.
std::string definition_name(std::string_view kind) {
  std::string name(kind);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}
Json reference(std::string_view kind) {
  return {{"$ref", "#/definitions/" + definition_name(kind)}};
}
Json array(std::string_view text, Json items) {
  return described(text, {{"type", "array"}, {"items", std::move(items)}});
}
Json pair(std::string_view text) {
  return described(text,
                   {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}});
}

/// The schema of an object from its keys and the schemas of its members.
Json object(const std::vector<Key>& keys, const Members& members) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : keys) {
    const auto member =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.first == key.name; });
    if (member == members.end()) throw std::logic_error("no schema for the key " + std::string(key.name));
    properties[std::string(key.name)] = member->second;
    if (key.required) required.push_back(key.name);
  }
  const std::string comment(keys::kComment.name);
  if (!properties.contains(comment)) properties[comment] = text(keys::kComment.text);
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

/// Makes the schema of one kind of object member by member.
class ObjectSchema {
 public:
  ObjectSchema() = default;
  explicit ObjectSchema(std::string_view kind) {
    keys_ = {{"type", keys::kRequired}, {"comment"}};
    members_ = {{"type", {{"const", kind}}}, {"comment", text(keys::kComment.text)}};
  }

  template <class T>
  ObjectSchema& numbers(std::span<const CamNumber<T>> list, bool required = true) {
    for (const CamNumber<T>& entry : list) {
      keys_.push_back({entry.key, required && entry.required});
      members_.emplace_back(entry.key, number(entry.text));
    }
    return *this;
  }
  ObjectSchema& members(std::span<const CamMember> list, const Members& schemas) {
    add_keys(list, keys_);
    members_.insert(members_.end(), schemas.begin(), schemas.end());
    return *this;
  }
  Json finish() const { return object(keys_, members_); }

 private:
  std::vector<Key> keys_;
  Members members_;
};

Json points_schema(std::string_view text) {
  return array(text, pair("leading value, following value"));
}

Json group_schema() {
  return ObjectSchema("point group")
      .numbers<CamPointGroup>(cam_fields::kGroup)
      .members(
          cam_fields::kGroupMembers,
          {{"points", points_schema("ascending, two at least")},
           {"relative_x", flag("leading values are 0 to 1 of start to end")},
           {"relative_y", flag("following values are 0 to 1 of lowest to highest")},
           {"interpolation", one_of("curve through or along the points", cam_words::kGroupInterpolations)},
           {"mapping", one_of("what the group becomes in the cam", cam_words::kMappings)},
           {"count", count("interpolation points of the mapping; 32 if not given")}})
      .finish();
}

Json transition_schema() {
  const Json continuity = one_of("up to where the curve is continuous there", cam_words::kContinuities);
  return ObjectSchema("transition")
      .numbers<CamTransition>(cam_fields::kTransition)
      .members(cam_fields::kTransitionMembers,
               {{"method", one_of("law if not given; system: as the interpolation of the cam says",
                                  cam_words::kMethods)},
                {"law", one_of("motion law; chosen by the goal if not given", law_names())},
                {"goal", one_of("figure that is to be small", cam_words::kGoals)},
                {"start_continuity", continuity},
                {"end_continuity", continuity},
                {"count", count("points of a law that becomes points; 32 if not given")}})
      .finish();
}

}  // namespace

Json cam_schema_definitions() {
  const Json coefficients =
      described("coefficients of x^0 to x^6; x is the leading value itself",
                {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 1}, {"maxItems", 7}});
  return {
      {"point", ObjectSchema("point").numbers<CamPointElement>(cam_fields::kPoint).finish()},
      {definition_name("point group"), group_schema()},
      {"line", ObjectSchema("line").numbers<CamLine>(cam_fields::kLine).finish()},
      {"sine",
       ObjectSchema("sine").numbers<CamSine>(cam_fields::kSine).numbers<CamWave>(cam_fields::kWave).finish()},
      {"polynomial", ObjectSchema("polynomial")
                         .numbers<CamPolynomial>(cam_fields::kPolynomial)
                         .numbers<CamWave>(cam_fields::kWave, false)
                         .members(cam_fields::kPolynomialMembers, {{"coefficients", coefficients}})
                         .finish()},
      {definition_name("inverse sine"),
       ObjectSchema("inverse sine")
           .numbers<CamInverseSine>(cam_fields::kInverseSine)
           .members(cam_fields::kInverseSineMembers, {{"mirrored", flag("falls from highest to lowest")},
                                                      {"count", count("points; 32 if not given")}})
           .finish()},
      {"transition", transition_schema()},
      {"segment", ObjectSchema().numbers<TO_Cam_Struct_SegmentData>(cam_fields::kSegment).finish()}};
}

namespace {

Json checks_schema() {
  return ObjectSchema()
      .numbers<CamChecks>(cam_fields::kChecks)
      .members(cam_fields::kCheckMembers,
               {{"leading_range", pair("leading values that the cam may use")},
                {"following_range", pair("following values that the cam may reach")},
                {"suitability", flag("laws have to meet velocity and acceleration beside them")},
                {"continuity", one_of("up to where the cam has to be continuous", cam_words::kContinuities)},
                {"cyclic",
                 {{"description",
                   "from the end to the start as well; \"closed\": and with the same following value"},
                  {"enum", {false, true, cam_words::kClosed}}}}})
      .finish();
}

template <std::size_t n>
std::vector<Key> list(const Key (&keys)[n]) {
  return {std::begin(keys), std::end(keys)};
}

}  // namespace

Json cam_definition_schema() {
  Json elements = Json::array();
  for (const std::string_view name : cam_words::kElements) elements.push_back(reference(name));
  const Json optimization = object(
      list(keys::kCamOptimization),
      {{"continuity", one_of("of transitions that do not say it themselves", cam_words::kContinuities)},
       {"goal", one_of("of transitions that do not say it themselves", cam_words::kGoals)}});
  return {{"elements",
           array("elements, ascending, and transitions by a law between them", {{"anyOf", elements}})},
          {"optimization", optimization},
          {"points", points_schema("points of the data block, instead of elements")},
          {"segments", array("segments of the data block, instead of elements", reference("segment"))}};
}

std::string cam_schema() {
  const Json definition = cam_definition_schema();
  const Json interpolation =
      object(list(keys::kCamInterpolation),
             {{"mode", one_of("how gaps are closed; cubic if not given", cam_words::kModes)},
              {"boundary", one_of("velocity: equal slopes at start and end", cam_words::kBoundaries)}});
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Lockstep cam"}};
  schema.update(object(
      list(keys::kCamFile),
      {{"$schema", text("where the schema of the file is, for editors")},
       {"lockstep_cam", {{"const", 1}}},
       {"name", text("name of the cam")},
       {"description", text("what it is for")},
       {"type", one_of("TO_Cam holds 1000 points, TO_Cam_10k 10000; both 50 segments", cam_words::kTypes)},
       {"interpolation", interpolation},
       {"elements", definition["elements"]},
       {"optimization", definition["optimization"]},
       {"points", definition["points"]},
       {"segments", definition["segments"]},
       {"checks", checks_schema()}}));
  schema["definitions"] = cam_schema_definitions();
  return schema.dump(2) + "\n";
}

}  // namespace lockstep
