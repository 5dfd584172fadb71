#include "projects/assembly/templates.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "projects/assembly/placeholders.hpp"
#include "projects/expressions/names.hpp"
#include "projects/json/fields.hpp"
#include "projects/keys/parts.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kMaximumInstances = 10'000;  // of a project
constexpr std::string_view kName = "name";          // the parameter that every template has

/// One instance, while it is made.
struct TemplateInstance {
  const std::string& text;  // for messages
  TemplateParameters parameters;
};

class TemplateExpansion {
 public:
  TemplateExpansion(JsonValue& root, std::deque<JsonValue>& made, std::deque<std::string>& texts,
                    Problems& problems)
      : root_(root), made_(made), texts_(texts), problems_(problems) {}

  /// @return false if there are too many instances or values
  bool expand();

 private:
  void look_at(const JsonValue& one) const;
  void add_instances(const JsonValue& json);
  std::optional<std::pair<std::string, const JsonValue*>> read_range(const Fields& fields) const;
  void add_instance(const JsonValue& json, const JsonValue& kind, TemplateParameters parameters);
  bool give_parameters(const JsonValue& json, const JsonValue& kind, TemplateParameters& parameters);
  bool fill(JsonValue& value, const TemplateParameters& parameters, const JsonValue& at);
  void put_section(std::string_view key, const JsonValue& section, const TemplateInstance& instance);
  JsonValue* copy(const JsonValue& value, const JsonValue* parent, const TemplateInstance& instance);
  JsonValue& section_of(JsonValue& owner, std::string_view key, const JsonValue& like);

  JsonValue& root_;
  std::deque<JsonValue>& made_;
  std::deque<std::string>& texts_;  // of the instances, for messages
  Problems& problems_;
  std::unordered_map<std::string, const JsonValue*> names_;        // of instances
  std::unordered_map<const JsonValue*, JsonValue*> own_sections_;  // of the root: those made here
  std::size_t values_ = 0;
  bool over_ = false;
};

bool TemplateExpansion::expand() {
  const JsonValue* const templates = read_object(root_.find("templates"), problems_);
  if (templates != nullptr)
    for (const auto& [name, one] : templates->members) look_at(*one);
  const JsonValue* const instances = read_array(root_.find("instances"), problems_);
  if (instances == nullptr) return true;
  for (const JsonValue* const instance : instances->elements) add_instances(*instance);
  return !over_;
}

/// What can be said of a template without an instance.
void TemplateExpansion::look_at(const JsonValue& one) const {
  const Fields fields(one, keys::kTemplate, problems_);
  if (!fields.usable()) return;
  if (const JsonValue* const modbus = fields["modbus"]) const Fields map(*modbus, keys::kPartMap, problems_);
  if (const JsonValue* const trace = fields["trace"])
    const Fields signals(*trace, keys::kPartSignals, problems_);
  const JsonValue* const parameters = read_object(fields["parameters"], problems_);
  if (parameters == nullptr) return;
  std::unordered_set<std::string> names;
  for (const auto& [name, parameter] : parameters->members) {
    if (const std::string problem = identifier_problem(name); !problem.empty())
      problems_.report_key(*parameter, problem);
    if (same_name(name, kName))
      problems_.report_key(*parameter,
                           "the parameter 'name' is there without being declared: the name of the instance");
    else if (!names.insert(fold(name)).second)
      problems_.report_key(*parameter,
                           "there is a parameter " + quote(name) + " already; case does not count");
    const Fields parameter_fields(*parameter, keys::kParameter, problems_);
    const JsonValue* const value = parameter_fields["default"];
    if (value != nullptr &&
        (value->kind == JsonKind::array || value->kind == JsonKind::object || value->kind == JsonKind::null))
      report_kind(*value, "a number, a text, true, false", problems_);
  }
}

std::vector<std::string_view> names_of(const JsonValue* object) {
  std::vector<std::string_view> names;
  if (object != nullptr)
    for (const auto& [name, value] : object->members) names.push_back(name);
  return names;
}

/// Whether a template may have it; what else it has is reported with the template.
bool is_section(std::string_view key) {
  const Keys sections(keys::kTemplate);
  return std::ranges::find(sections, key, &Key::name) != sections.end();
}

void TemplateExpansion::add_instances(const JsonValue& json) {
  const Fields fields(json, keys::kInstance, problems_);
  if (!fields.usable()) return;
  const auto wanted = read_string(fields["template"], problems_);
  if (!wanted) return;
  const JsonValue* const templates = root_.find("templates");
  const JsonValue* const kind = templates == nullptr ? nullptr : templates->find(*wanted);
  if (kind == nullptr) {
    const auto names = names_of(templates);
    return problems_.report(*fields["template"], "there is no template " + quote(*wanted) +
                                                     did_you_mean(*wanted, names) +
                                                     (names.empty() ? "" : "; allowed: " + list_of(names)));
  }
  if (kind->kind != JsonKind::object) return;
  if (fields["for"] == nullptr) return add_instance(json, *kind, {});
  const auto range = read_range(fields);
  if (!range) return;
  const auto& bounds = range->second->elements;
  const auto from = read_integer(bounds[0], INT32_MIN, INT32_MAX, problems_);
  const auto to = read_integer(bounds[1], INT32_MIN, INT32_MAX, problems_);
  if (!from || !to) return;
  if (*from > *to) return problems_.report(*range->second, "from is greater than to; allowed: [from, to]");
  if (*to - *from >= kMaximumInstances)
    return problems_.report(*range->second, "these are more than " + std::to_string(kMaximumInstances) +
                                                " instances; that is all there may be");
  for (std::int64_t i = *from; i <= *to && !over_; ++i) {
    JsonValue& number = made_.emplace_back(*bounds[0]);
    number.kind = JsonKind::number;
    number.whole = true;
    number.negative = i < 0;
    number.magnitude = static_cast<std::uint64_t>(i < 0 ? -i : i);
    number.number = static_cast<double>(i);
    number.text = std::to_string(i);
    add_instance(json, *kind, {{range->first, &number}});
  }
}

/// The one parameter of "for", and its two bounds.
std::optional<std::pair<std::string, const JsonValue*>> TemplateExpansion::read_range(
    const Fields& fields) const {
  const JsonValue* const json = read_object(fields["for"], problems_);
  if (json == nullptr) return std::nullopt;
  if (json->members.size() != 1) {
    problems_.report(*json, "this has " + std::to_string(json->members.size()) +
                                R"( parameters; allowed is one with its range, such as { "n": [1, 12] })");
    return std::nullopt;
  }
  const auto& [name, bounds] = json->members.front();
  if (bounds->kind == JsonKind::array && bounds->elements.size() == 2) return std::pair{fold(name), bounds};
  report_kind(*bounds, "two whole numbers [from, to]", problems_);
  return std::nullopt;
}

/// Fills a value of an instance from parameters that are there already.
bool TemplateExpansion::fill(JsonValue& value, const TemplateParameters& parameters, const JsonValue& at) {
  const std::string problem = fill_placeholders(value, parameters);
  if (!problem.empty()) problems_.report(at, problem);
  return problem.empty();
}

/// What "with" says, and defaults. @param parameters has that of "for"
bool TemplateExpansion::give_parameters(const JsonValue& json, const JsonValue& kind,
                                        TemplateParameters& parameters) {
  const std::size_t before = problems_.count();
  const JsonValue* const declared = kind.find("parameters");
  auto names = names_of(declared);
  const auto known = [&](const std::string& name) {
    return std::ranges::any_of(names, [&](std::string_view one) { return same_name(one, name); });
  };
  for (const auto& [name, value] : parameters)
    if (!known(name))
      problems_.report(*json.find("for"), "the template has no parameter " + quote(name) +
                                              did_you_mean(name, names) + "; it has: " + list_of(names));
  const TemplateParameters range = parameters;
  const JsonValue* const with = read_object(json.find("with"), problems_);
  if (with != nullptr)
    for (const auto& [name, value] : with->members) {
      if (!known(name)) {
        problems_.report_key(*value, "the template has no parameter " + quote(name) +
                                         did_you_mean(name, names) + "; it has: " + list_of(names));
        continue;
      }
      if (value->kind == JsonKind::array || value->kind == JsonKind::object ||
          value->kind == JsonKind::null) {
        report_kind(*value, "a number, a text, true, false", problems_);
        continue;
      }
      JsonValue& given = made_.emplace_back(*value);
      fill(given, range, *value);
      if (!parameters.emplace(fold(name), &given).second)
        problems_.report_key(*value, "the parameter " + quote(name) + " is given already; each once");
    }
  if (declared != nullptr && declared->kind == JsonKind::object)
    for (const auto& [name, parameter] : declared->members) {
      const JsonValue* const value = parameter->find("default");
      if (value != nullptr)
        parameters.emplace(fold(name), value);
      else if (!parameters.contains(fold(name)))
        problems_.report(json,
                         "the parameter " + quote(name) + " of the template is missing; it has no default");
    }
  return problems_.count() == before;
}

void TemplateExpansion::add_instance(const JsonValue& json, const JsonValue& kind,
                                     TemplateParameters parameters) {
  if (over_) return;
  if (texts_.size() == static_cast<std::size_t>(kMaximumInstances)) {
    over_ = true;
    return problems_.report(json, "there are more than " + std::to_string(kMaximumInstances) +
                                      " instances; that is all there may be");
  }
  const JsonValue* const name = json.find(kName);
  if (name == nullptr || !read_string(name, problems_) || !give_parameters(json, kind, parameters)) return;
  JsonValue& own_name = made_.emplace_back(*name);
  if (!fill(own_name, parameters, *name)) return;
  if (own_name.kind != JsonKind::string)
    own_name.kind = JsonKind::string;  // of a name such as "${n}" the number
  if (const std::string problem = identifier_problem(own_name.text); !problem.empty())
    return problems_.report(*name, problem);
  const auto [other, added] = names_.try_emplace(fold(own_name.text), name);
  if (!added)
    return problems_.report(*name, "there is an instance " + quote(own_name.text) + " already" +
                                       other_place(*other->second, *name) + "; each name is allowed once");
  parameters[std::string(kName)] = &own_name;
  const JsonValue* const asked = json.find("template");
  const std::string place = other_place(*asked, kind);
  const std::string& text = texts_.emplace_back("instance " + quote(own_name.text) + " of the template " +
                                                quote(asked->text) + place.substr(0, place.find(" (")));
  const TemplateInstance instance{text, std::move(parameters)};
  for (const auto& [key, section] : kind.members)
    if (key != "parameters" && is_section(key)) put_section(key, *section, instance);
}

/// A value with its parameters filled in; nullptr when there are too many values.
JsonValue* TemplateExpansion::copy(const JsonValue& value, const JsonValue* parent,
                                   const TemplateInstance& instance) {
  if (++values_ > JsonDocument::kMaximumValues) {
    if (!over_)
      problems_.report(value, "with its templates the project has more than " +
                                  std::to_string(JsonDocument::kMaximumValues) +
                                  " values; that is all there may be");
    over_ = true;
    return nullptr;
  }
  JsonValue& made = made_.emplace_back(value);
  made.belong_to(parent, instance.text);
  if (!fill(made, instance.parameters, made)) made.kind = JsonKind::unusable;
  for (const JsonValue*& element : made.elements) {
    const JsonValue* const copied = copy(*element, &made, instance);
    if (copied == nullptr) return nullptr;
    element = copied;
  }
  std::vector<JsonValue::Member> members;
  std::unordered_set<std::string> keys;
  for (const auto& [key, member] : value.members) {
    JsonValue* const copied = copy(*member, &made, instance);
    if (copied == nullptr) return nullptr;
    std::string problem;
    std::string own_key = filled_text(key, instance.parameters, problem);
    if (problem.empty() && !keys.insert(own_key).second)
      problem = "the key " + quote(own_key) + " is there twice; each key is allowed once";
    if (problem.empty())
      members.push_back({std::move(own_key), copied});
    else
      problems_.report_key(*copied, problem);
  }
  made.members = std::move(members);
  return &made;
}

/// A section of the root to which may be added.
/// @param like what it is made from if the project has none
JsonValue& TemplateExpansion::section_of(JsonValue& owner, std::string_view key, const JsonValue& like) {
  auto member = std::ranges::find(owner.members, key, &JsonValue::Member::key);
  if (member != owner.members.end()) {
    if (const auto own = own_sections_.find(member->value); own != own_sections_.end()) return *own->second;
    JsonValue& made = made_.emplace_back(*member->value);
    own_sections_.emplace(&made, &made);
    member->value = &made;
    return made;
  }
  JsonValue& made = made_.emplace_back(like);
  made.members.clear();
  made.elements.clear();
  own_sections_.emplace(&made, &made);
  owner.members.push_back({std::string(key), &made});
  return made;
}

void TemplateExpansion::put_section(std::string_view key, const JsonValue& section,
                                    const TemplateInstance& instance) {
  const JsonValue* const copied = copy(section, nullptr, instance);
  if (copied == nullptr || copied->kind == JsonKind::unusable) return;
  const JsonValue* added = copied;
  JsonValue* owner = &root_;
  std::string_view inner = key;
  if (key == "modbus" || key == "trace") {
    inner = key == "modbus" ? "map" : "signals";
    const JsonValue* const list = copied->find(inner);
    if (list == nullptr) return;  // reported with the template
    JsonValue& outer = section_of(root_, key, *copied);
    if (outer.kind != JsonKind::object) return;  // as the loader will report
    owner = &outer;
    added = list;
  }
  const bool listed = key != "technology_objects" && key != "transfer_areas" && key != "tags";
  if ((listed ? read_array(added, problems_) : read_object(added, problems_)) == nullptr) return;
  JsonValue& target = section_of(*owner, inner, *added);
  if (target.kind != added->kind) return;  // as the loader will report
  target.members.insert(target.members.end(), added->members.begin(), added->members.end());
  target.elements.insert(target.elements.end(), added->elements.begin(), added->elements.end());
}

}  // namespace

bool expand_templates(JsonValue& root, std::deque<JsonValue>& made, std::deque<std::string>& texts,
                      std::vector<Problem>& problems) {
  Problems found;
  const bool expanded = TemplateExpansion(root, made, texts, found).expand();
  for (Problem& problem : found.take_errors()) problems.push_back(std::move(problem));
  return expanded;
}

}  // namespace lockstep
