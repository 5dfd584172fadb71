// Start values of the technology data block.
#include <algorithm>
#include <charconv>

#include "projects/expressions/constant.hpp"
#include "projects/loader/configuration_tree.hpp"
#include "projects/loader/loader.hpp"
#include "tech_objects/leading_values/recorded_values.hpp"
#include "tech_objects/leading_values/seconds.hpp"

namespace lockstep {
namespace {

/// A key of the configuration: a name, and an index if it is written with one.
struct ElementKey {
  std::string_view name;
  std::size_t index = 0;  // from 1; 0: none
};

ElementKey split(std::string_view key) {
  const auto open = key.find('[');
  if (open == key.npos || key.back() != ']') return {key};
  const std::string_view digits = key.substr(open + 1, key.size() - open - 2);
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  const bool plain = error == std::errc{} && end == digits.data() + digits.size() && !digits.starts_with('0');
  return plain ? ElementKey{key.substr(0, open), index} : ElementKey{key};
}

const JsonValue* member_of(const JsonValue* json, std::string_view key) {
  return json != nullptr && json->kind == JsonKind::object ? json->find(key) : nullptr;
}

class ConfigurationLoader {
 public:
  ConfigurationLoader(TechnologyObject& object, const Loading& loading)
      : object_(object), loading_(loading), problems_(loading.problems) {}

  /// @param index of the array element within which the structure lies, from 1; 0: none
  void load_structure(const JsonValue& json, const ConfigurationNode& structure, std::size_t index);

 private:
  void load_member(const std::string& key, const JsonValue& json, const ConfigurationNode& structure,
                   std::size_t index);
  void load_variable(const JsonValue& json, const Variable& variable, std::size_t index);
  void load_tag_reference(const JsonValue& json, const Signal& place);
  void report_unknown(const std::string& key, const JsonValue& json, const ConfigurationNode& structure);

  TechnologyObject& object_;
  const Loading& loading_;
  Problems& problems_;
};

void ConfigurationLoader::load_structure(const JsonValue& json, const ConfigurationNode& structure,
                                         std::size_t index) {
  if (json.kind == JsonKind::object) {
    for (const auto& [key, member] : json.members) load_member(key, *member, structure, index);
    return;
  }
  std::vector<std::string_view> names;
  for (const auto& child : structure.children) names.push_back(child->name);
  report_kind(json, "an object with " + list_of(names), problems_);
}

void ConfigurationLoader::load_member(const std::string& key, const JsonValue& json,
                                      const ConfigurationNode& structure, std::size_t index) {
  const ElementKey element = split(key);
  const ConfigurationNode* const node = structure.find(element.name);
  if (node == nullptr) return report_unknown(key, json, structure);
  if (node->computed())
    return problems_.report(json, quote(key) + " is computed by the runtime and cannot be set");
  const std::string name(node->name);
  if (node->count == 0 && element.index != 0)
    return problems_.report(json, "unknown key " + quote(key) + "; '" + name + "' is no array");
  if (node->count != 0 && (element.index == 0 || element.index > node->count))
    return problems_.report(json, quote(key) + " does not name an element of the array; allowed: '" + name +
                                      "[1]' to '" + name + "[" + std::to_string(node->count) + "]'");
  if (node->count != 0) index = element.index;
  if (node->variable != nullptr) return load_variable(json, *node->variable, index);
  load_structure(json, *node, index);
}

void ConfigurationLoader::report_unknown(const std::string& key, const JsonValue& json,
                                         const ConfigurationNode& structure) {
  std::vector<std::string> texts;
  for (const auto& child : structure.children)
    if (!child->computed()) texts.push_back(std::string(child->name) + (child->count != 0 ? "[1]" : ""));
  const std::vector<std::string_view> names(texts.begin(), texts.end());
  std::string text = "unknown key " + quote(key) + did_you_mean(key, names);
  if (key.find('.') != key.npos && find_variable(object_.kind, key).variable != nullptr)
    text += R"(; structures are nested, as in { "DynamicDefaults": { "Velocity": 100.0 } })";
  problems_.report_key(json, text + "; allowed: " + list_of(names));
}

void ConfigurationLoader::load_variable(const JsonValue& json, const Variable& variable, std::size_t index) {
  const std::size_t offset = index == 0 ? 0 : (index - 1) * variable.stride;
  const Signal place = VariableAddress{&variable, variable.offset + offset, -1}.signal(object_.data_block());
  if (variable.type == Type::TAG) return load_tag_reference(json, place);
  const auto value = read_plain_constant(json, variable.type, problems_);
  if (!value) return;
  if (const std::string problem = range_problem(*value, variable.type, variable.range, variable.choices);
      !problem.empty())
    return problems_.report(json, problem);
  if (variable.later && place.load().u != value->u)
    problems_.warn(json, "'" + std::string(variable.path) + "' has no effect yet");
  place.store(*value);
}

void ConfigurationLoader::load_tag_reference(const JsonValue& json, const Signal& place) {
  if (json.kind != JsonKind::string) return report_kind(json, "the name of a BOOL tag", problems_);
  const auto found = loading_.find(json, json.text);
  if (!found) return;
  if (found->tag == nullptr || found->signal.type != Type::BOOL)
    return problems_.report(json, json.shown() + " is not allowed here; allowed: the name of a BOOL tag");
  Value address{};
  address.u = reinterpret_cast<std::uintptr_t>(found->signal.address);
  place.store(address);
}

// Defaults are numbers, made for mm: what is a tight window there lets a machine push for seconds in m.
constexpr const char* kMadeForMillimetres[][2] = {{"FollowingError", "MinValue"},
                                                  {"FollowingError", "MaxValue"},
                                                  {"PositioningMonitoring", "Window"},
                                                  {"StandstillSignal", "VelocityThreshold"}};

/// Of an axis whose unit of length is longer than mm: which variables that watch over it are at their
/// defaults.
void warn_of_defaults(const JsonValue& config, TechnologyObject& object, Problems& problems) {
  const JsonValue* const unit = member_of(member_of(&config, "Units"), "LengthUnit");
  if (unit == nullptr) return;
  constexpr std::uint64_t kLonger[] = {1010, 1011, 1018, 1019, 1021};  // m, km, ft, in, mi
  const Signal place = find_variable(object.kind, "Units.LengthUnit").signal(object.data_block());
  if (std::ranges::find(kLonger, place.load().u) == std::end(kLonger)) return;
  std::string left;
  for (const auto& [structure, name] : kMadeForMillimetres) {
    const VariableAddress found = find_variable(object.kind, std::string(structure) + "." + name);
    if (found.variable == nullptr || member_of(member_of(&config, structure), name) != nullptr) continue;
    const Signal variable = found.signal(object.data_block());
    left += std::string(left.empty() ? "" : ", ") + structure + "." + name + " " +
            value_text(variable.load(), variable.type);
  }
  if (!left.empty())
    problems.warn(*unit, "numbers of '" + object.name +
                             "' are in that unit, defaults too, which are made for mm: " + left +
                             "; set them to what the machine needs");
}

}  // namespace

void check_delay(const JsonValue& config, double delay, const Loading& loading) {
  const std::int64_t cycle = loading.controller().clock.interpolator_cycle();
  const double longest = seconds(kLongestLeadingDelay * cycle);
  if (delay <= longest) return;
  const JsonValue* const json =
      config.find("CrossPlcSynchronousOperation")->find("LocalLeadingValueDelayTime");
  loading.problems.report(
      *json, "LocalLeadingValueDelayTime is longer than " + std::to_string(kLongestLeadingDelay) +
                 " application cycles; allowed: 0 to " + value_text(Value{.r = longest}, Type::LREAL) + " s");
}

void load_configuration(const JsonValue& config, TechnologyObject& object, const Loading& loading) {
  ConfigurationLoader(object, loading).load_structure(config, configuration_tree(object.kind), 0);
  warn_of_defaults(config, object, loading.problems);
}

}  // namespace lockstep
