#include "cli/connections/overview.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/describe/table.hpp"
#include "projects/json/fields.hpp"
#include "projects/keys/objects.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const System& system, const SystemObject& object) {
  return full_name(system.controllers[object.controller], *object.object);
}

std::string output_of(const Interconnection& row) {
  return row.local() ? "local" : fmt::format("Interface[{}] {}", row.interface, row.area);
}

std::string_view coupling_of(const Interconnection& row) {
  for (const Word& word : keys::kCouplings)
    if (word.value == static_cast<int>(row.coupling)) return word.word;
  return "";
}

/// A delay as it is configured, and as it is computed where that is another one or is asked for.
std::string delay_text(const DelayTime* delay, const OverviewOptions& options) {
  if (delay == nullptr || !options.delays) return "";
  std::string text = milliseconds_text(delay->configured);
  if (delay->fixed) return text + " fixed";
  if (!options.computed) return text;
  return text + (delay->computed ? " → " + milliseconds_text(*delay->computed) : " → none");
}

bool has(std::string_view text, const std::string& folded) {
  return fold(text).find(folded) != std::string::npos;
}

std::string route_text(const System& system, const Route& route) {
  std::string text = name_of(system, route.hops.front()->following);
  for (const Interconnection* const hop : route.hops) {
    if (!hop->local()) text += " ← " + full_name(system.controllers[hop->following.controller], *hop->proxy);
    text += " ← " + name_of(system, hop->source);
  }
  return text + (route.extrapolated ? ": extrapolated" : ": interpolated");
}

Json delay_json(const DelayTime* delay) {
  if (delay == nullptr) return nullptr;
  Json json = {{"configured", delay->configured}, {"fixed", delay->fixed}};
  json["computed"] = delay->computed ? Json(*delay->computed) : Json(nullptr);
  return json;
}

Json row_json(const System& system, const Connections& connections, const Interconnection& row) {
  Json json;
  json["source"] = {{"controller", system.controllers[row.source.controller].name},
                    {"leading_axis", row.source.object->name},
                    {"delay", delay_json(connections.delay_of(row.source.object))}};
  if (!row.local()) json["source"].update({{"interface", row.interface}, {"transfer_area", row.area}});
  json["receiver"] = {{"controller", system.controllers[row.following.controller].name}};
  json["receiver"]["following_axis"] =
      row.following.object == nullptr ? Json(nullptr) : Json(row.following.object->name);
  if (!row.local()) {
    json["receiver"]["proxy"] = row.proxy->name;
    json["receiver"]["delay"] = delay_json(connections.delay_of(row.proxy));
  }
  json["coupling"] = coupling_of(row);
  json["recursive"] = row.recursive;
  json["recursion_left_out"] = row.cut;
  json["left_out"] = row.left_out;
  json["ambiguous"] = row.ambiguous;
  if (!row.local()) json["extrapolated"] = row.extrapolated;
  return json;
}

}  // namespace

std::string milliseconds_text(double seconds) {
  return decimal_text(std::round(seconds * 1e9) / 1e6) + " ms";
}

bool is_shown(const System& system, const Interconnection& row, const OverviewOptions& options) {
  if (row.local() && !options.local) return false;
  if (options.filter.empty()) return true;
  const std::string wanted = fold(options.filter);
  if (has(name_of(system, row.source), wanted) || has(row.area, wanted)) return true;
  if (has(system.controllers[row.following.controller].name, wanted)) return true;
  if (row.following.object != nullptr && has(name_of(system, row.following), wanted)) return true;
  return !row.local() && has(row.proxy->name, wanted);
}

std::string remark_of(const Connections& connections, const Interconnection& row) {
  if (row.following.object == nullptr) return "nothing follows";
  if (row.recursive)
    return row.left_out ? "recursive, left out" : row.cut ? "recursive, one left out" : "recursive";
  if (row.left_out) return "left out";
  if (row.local()) return "";
  const DelayTime* const source = connections.delay_of(row.source.object);
  const DelayTime* const proxy = connections.delay_of(row.proxy);
  if (source->fixed || proxy->fixed) return "left out";
  return source->is_current() && proxy->is_current() ? "as computed" : "";
}

std::string overview_text(const System& system, const Connections& connections,
                          const OverviewOptions& options, std::size_t width) {
  const std::vector<std::string> headings = {"Leading axis", "Delay",    "Output", "Following axis", "Proxy",
                                             "Delay",        "Coupling", "Path",   "Remark"};
  Table table(headings), several(headings);
  for (const Interconnection& row : connections.rows()) {
    if (!is_shown(system, row, options)) continue;
    const std::string controller = system.controllers[row.following.controller].name;
    Table& its = row.ambiguous ? several : table;
    its.row({name_of(system, row.source), delay_text(connections.delay_of(row.source.object), options),
             output_of(row),
             row.following.object == nullptr ? controller + ".—" : name_of(system, row.following),
             row.local() ? "" : row.proxy->name,
             row.local() ? "" : delay_text(connections.delay_of(row.proxy), options),
             row.following.object == nullptr ? "" : std::string(coupling_of(row)),
             row.local()        ? ""
             : row.extrapolated ? "extrapolated"
                                : "interpolated",
             remark_of(connections, row)});
  }
  std::string text = table.empty() ? "no interconnections\n" : table.text(0, width);
  if (!several.empty()) text += "\nLeading value source not unique\n" + several.text(0, width);
  if (options.routes.empty()) return text;
  std::string problem;
  const LeadingObject* const axis = axis_of_routes(system, options.routes, problem);
  const std::vector<Route> routes = connections.routes_of(axis);
  text += "\nRoutes of " + options.routes + "\n";
  if (routes.empty()) text += "  none\n";
  for (const Route& route : routes) text += "  " + route_text(system, route) + "\n";
  return text;
}

std::string overview_json(const System& system, const Connections& connections,
                          const OverviewOptions& options) {
  Json json = {{"system", system.name}, {"recursive", connections.recursive()}};
  json["interconnections"] = Json::array();
  for (const Interconnection& row : connections.rows())
    if (is_shown(system, row, options))
      json["interconnections"].push_back(row_json(system, connections, row));
  if (options.routes.empty()) return json.dump(2) + "\n";
  std::string problem;
  json["routes"] = Json::array();
  for (const Route& route : connections.routes_of(axis_of_routes(system, options.routes, problem))) {
    Json one = {{"extrapolated", route.extrapolated}};
    one["axes"] = {name_of(system, route.hops.front()->following)};
    for (const Interconnection* const hop : route.hops) {
      if (!hop->local())
        one["axes"].push_back(full_name(system.controllers[hop->following.controller], *hop->proxy));
      one["axes"].push_back(name_of(system, hop->source));
    }
    json["routes"].push_back(std::move(one));
  }
  return json.dump(2) + "\n";
}

const LeadingObject* axis_of_routes(const System& system, const std::string& name, std::string& problem) {
  const std::size_t dot = name.find('.');
  const auto index = system.find(std::string_view(name).substr(0, dot));
  if (!index || dot == name.npos) {
    problem = quote(name) + " begins with no controller of the system; allowed: CONTROLLER.AXIS";
    return nullptr;
  }
  const Names::FoundObject found =
      system.controllers[*index].project.names.find_object(std::string_view(name).substr(dot + 1), kAnyAxis);
  problem = found.problem;
  return static_cast<const LeadingObject*>(found.object);
}

}  // namespace lockstep::cli
