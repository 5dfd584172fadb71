// Which server of a project a panel speaks to, and so which maps it has before it.
#include <algorithm>

#include "cli/panel/modbus_panel.hpp"
#include "projects/json/addresses.hpp"

namespace lockstep::cli {
namespace {

using Servers = std::vector<std::size_t>;  // indices

template <class Condition>
Servers servers_where(const ModbusConfig& modbus, Condition listens_at) {
  Servers found;
  for (std::size_t i = 0; i < modbus.servers.size(); ++i) {
    const std::vector<Endpoint>& places = modbus.servers[i].listen;
    if (std::any_of(places.begin(), places.end(), listens_at)) found.push_back(i);
  }
  return found;
}

/// Those that may be behind an address: that listen at it, else at its port, else any.
Servers servers_behind(const ModbusConfig& modbus, const Endpoint& address) {
  Servers found = servers_where(modbus, [&](const Endpoint& place) { return place == address; });
  if (found.empty())
    found = servers_where(modbus, [&](const Endpoint& place) { return place.port == address.port; });
  if (!found.empty()) return found;
  for (std::size_t i = 0; i < modbus.servers.size(); ++i) found.push_back(i);
  return found;
}

/// "0 (127.0.0.1:502), 1 (/dev/ttyS0)"
std::string all_servers(const ModbusConfig& modbus) {
  std::string text;
  for (std::size_t i = 0; i < modbus.servers.size(); ++i) {
    const ModbusServerOptions& server = modbus.servers[i];
    std::string places = server.serial ? server.serial->device : "";
    for (const Endpoint& place : server.listen) places += (places.empty() ? "" : ", ") + to_string(place);
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " (" + places + ")";
  }
  return text;
}

/// Maps of the server, or an empty list: then it is told why.
std::vector<const ModbusMapConfig*> find_maps(const ModbusConfig& modbus, const Endpoint& address,
                                              const PanelOptions& options) {
  if (modbus.servers.empty()) return modbus.maps_of(std::nullopt);
  if (options.server && *options.server >= modbus.servers.size()) {
    tell("--server " + std::to_string(*options.server) + ": there is none; allowed: " + all_servers(modbus));
    return {};
  }
  const Servers servers = options.server ? Servers{*options.server} : servers_behind(modbus, address);
  const auto maps = modbus.maps_of(servers.front());
  if (std::all_of(servers.begin(), servers.end(),
                  [&](auto server) { return modbus.maps_of(server) == maps; }))
    return maps;
  tell(options.place +
       ": the servers of the project have maps of their own, and this address does not tell which one is "
       "meant; allowed: an address at which one listens, or --server with one of " +
       all_servers(modbus));
  return {};
}

}  // namespace

std::optional<PanelTarget> find_target(const Project& project, const PanelOptions& options) {
  std::string problem;
  const std::optional<Endpoint> address = parse_endpoint(options.place, problem);
  if (!address) {
    tell(problem);
    return std::nullopt;
  }
  auto maps = find_maps(project.modbus, *address, options);
  if (maps.empty()) return std::nullopt;
  return PanelTarget{*address, std::move(maps)};
}

}  // namespace lockstep::cli
