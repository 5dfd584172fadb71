#include "projects/loader/configuration_tree.hpp"

#include <algorithm>
#include <map>

namespace lockstep {
namespace {

ConfigurationNode& child_of(ConfigurationNode& parent, std::string_view name) {
  for (const auto& child : parent.children)
    if (child->name == name) return *child;
  parent.children.push_back(std::make_unique<ConfigurationNode>());
  parent.children.back()->name = name;
  return *parent.children.back();
}

void insert(ConfigurationNode& root, const Variable& variable) {
  ConfigurationNode* node = &root;
  for (std::string_view rest = variable.path; !rest.empty();) {
    const auto point = rest.find('.');
    std::string_view segment = rest.substr(0, point);
    rest = point == rest.npos ? std::string_view{} : rest.substr(point + 1);
    const bool array = segment.ends_with("[]");
    if (array) segment.remove_suffix(2);
    node = &child_of(*node, segment);
    if (array) node->count = variable.count;
  }
  node->variable = &variable;
}

ConfigurationNode build(ObjectKind kind) {
  ConfigurationNode root;
  for (const auto list : data_block_of(kind).lists())
    for (const Variable& variable : list) insert(root, variable);
  return root;
}

}  // namespace

const ConfigurationNode* ConfigurationNode::find(std::string_view child) const noexcept {
  for (const auto& candidate : children)
    if (candidate->name == child) return candidate.get();
  return nullptr;
}

bool ConfigurationNode::computed() const noexcept {
  if (variable != nullptr) return variable->computed;
  return std::all_of(children.begin(), children.end(), [](const auto& child) { return child->computed(); });
}

const ConfigurationNode& configuration_tree(ObjectKind kind) {
  static const std::map<ObjectKind, ConfigurationNode> trees = [] {
    std::map<ObjectKind, ConfigurationNode> made;
    for (const ObjectKindText& known : kObjectKinds) made.emplace(known.kind, build(known.kind));
    return made;
  }();
  return trees.at(kind);
}

}  // namespace lockstep
