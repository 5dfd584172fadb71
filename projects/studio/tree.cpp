#include "projects/studio/tree.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "projects/expressions/own_variables.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string folded(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

/// Collects what is found under its path.
class Collector {
 public:
  Collector(const Project& project, const StudioUnits& units) : project_(project), units_(units) {}

  void add(const std::string& path, std::string_view text) {
    const FoundOperand found = project_.names.find(path);
    if (!found.place || found.place->signal.value_type() >= Type::AXIS) return;
    const Operand& place = *found.place;
    signals.push_back({path, std::string(type_name(place.signal.value_type())),
                       units_.of(NamedSignal{path, place.signal, place.unit, place.object, place.instance}),
                       std::string(text), why_not_writable(place)});
  }

  void add_variable(const std::string& object, const Variable& variable) {
    const std::string pattern(variable.path);
    const std::size_t brackets = pattern.find("[]");
    if (brackets == std::string::npos) return add_with_bits(object + "." + pattern, variable);
    if (variable.count > kStudioElements) return;
    for (std::size_t i = 1; i <= variable.count; ++i)
      add_with_bits(
          object + "." + pattern.substr(0, brackets + 1) + std::to_string(i) + pattern.substr(brackets + 1),
          variable);
  }

  std::vector<StudioSignal> signals;

 private:
  void add_with_bits(const std::string& path, const Variable& variable) {
    add(path, variable.text);
    if (variable.bits == nullptr) return;
    for (std::size_t bit = 0; bit < variable.bits->size(); ++bit)
      if (const std::string_view name = (*variable.bits)[bit]; !name.empty())
        add(path + ".X" + std::to_string(bit), name);
  }

  const Project& project_;
  const StudioUnits& units_;
};

Json objects_of(const Project& project) {
  Json objects = Json::array();
  for (const auto& object : project.controller->objects)
    objects.push_back({{"name", object->name},
                       {"type", kind_name(object->kind)},
                       {"number", static_cast<std::uint64_t>(object->number)}});
  return objects;
}

}  // namespace

std::vector<StudioSignal> studio_signals(const Project& project, const StudioUnits& units) {
  const Controller& controller = *project.controller;
  Collector collector(project, units);
  for (const Tag& tag : controller.tags) collector.add(tag.name, tag.comment);
  for (const auto& object : controller.objects) {
    for (const std::span<const Variable> list : data_block_of(object->kind).lists())
      for (const Variable& variable : list) collector.add_variable(object->name, variable);
    for (const OwnVariable& own : own_variables(*object))
      collector.add_variable(object->name, own.declaration);
  }
  for (const Instance& instance : controller.instances)
    for (const Pin& pin : instance.type->pins)
      collector.add(instance.name + "." + std::string(pin.name), pin.text);
  return std::move(collector.signals);
}

std::vector<const StudioSignal*> find_studio_signals(const std::vector<StudioSignal>& signals,
                                                     std::string_view text, std::size_t limit) {
  std::istringstream stream(folded(text));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<const StudioSignal*> found;
  for (const StudioSignal& signal : signals) {
    const std::string all = folded(signal.path) + " " + folded(signal.text);
    if (std::all_of(words.begin(), words.end(),
                    [&](const std::string& word) { return all.find(word) != std::string::npos; }))
      found.push_back(&signal);
  }
  // What is called so comes before what begins so, and that before what has the words somewhere.
  const std::string whole = folded(text);
  const auto rank = [&](const StudioSignal* signal) {
    const std::string path = folded(signal->path);
    if (path == whole) return 0;
    return path.starts_with(whole) ? 1 : 2;
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const StudioSignal* a, const StudioSignal* b) { return rank(a) < rank(b); });
  if (found.size() > limit) found.resize(limit);
  return found;
}

std::string studio_project(const Project& project) {
  const Controller& controller = *project.controller;
  Json tags = Json::array();
  for (const Tag& tag : controller.tags)
    tags.push_back({{"name", tag.name},
                    {"type", type_name(tag.type)},
                    {"retain", tag.retain},
                    {"comment", tag.comment}});
  Json instances = Json::array();
  for (const Instance& instance : controller.instances)
    instances.push_back({{"name", instance.name}, {"type", instance.type->name}});
  Json traced = Json::array();
  for (const NamedSignal& signal : project.trace.signals) traced.push_back(signal.name);
  const Json document = {{"name", project.name},
                         {"description", project.description},
                         {"clock",
                          {{"servo_cycle", controller.clock.servo_cycle},
                           {"interpolator_cycle", controller.clock.interpolator_cycle()}}},
                         {"objects", objects_of(project)},
                         {"instances", instances},
                         {"tags", tags},
                         {"trace", traced}};
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lockstep
