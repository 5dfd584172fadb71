// Where the servers of a project are: addresses and lines, and whom they let in.
#include <algorithm>
#include <string>

#include "projects/json/addresses.hpp"
#include "projects/keys/modbus.hpp"
#include "projects/loader/modbus.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

void load_listen(const JsonValue& json, ModbusServerOptions& options, Problems& problems) {
  std::vector<const JsonValue*> places = json.elements;
  if (json.kind != JsonKind::array) places.assign(1, &json);
  if (places.empty()) problems.report(json, "nowhere to listen; allowed: HOST:PORT, or an array of them");
  options.listen.clear();
  for (const JsonValue* const place : places) {
    const auto endpoint = read_endpoint(place, problems);
    if (!endpoint) continue;
    if (endpoint->port != 0 && std::ranges::find(options.listen, *endpoint) != options.listen.end())
      problems.report(*place, place->shown() + " is there twice; each address is allowed once");
    else
      options.listen.push_back(*endpoint);
  }
}

/// Modbus has no passwords.
void warn_of_open_server(const Fields& fields, const ModbusServerOptions& options, Problems& problems) {
  if (!options.allow.empty() || fields["allow"] != nullptr) return;
  for (const Endpoint& place : options.listen)
    if (!is_loopback(place.host))
      problems.warn(*fields["listen"], "whoever reaches " + to_string(place) +
                                           " may read and write what the map shows; 'allow' says from which "
                                           "networks clients may come");
}

/// Two servers cannot listen at one endpoint; port 0 is another one each time.
void report_taken_places(const Fields& fields, const ModbusConfig& modbus, Problems& problems) {
  for (const Endpoint& place : modbus.servers.back().listen)
    for (std::size_t i = 0; place.port != 0 && i + 1 < modbus.servers.size(); ++i) {
      const std::vector<Endpoint>& taken = modbus.servers[i].listen;
      if (std::find(taken.begin(), taken.end(), place) == taken.end()) continue;
      problems.report(*fields["listen"], "server " + std::to_string(i) + " listens at " + to_string(place) +
                                             " already; each address is allowed once");
    }
}

/// RTU over a serial line.
void load_line(const Fields& fields, const ModbusConfig& modbus, ModbusServerOptions& options,
               Problems& problems) {
  for (const char* const key : {"listen", "allow", "max_clients", "max_clients_per_address",
                                "max_requests_per_second", "idle_timeout"})
    if (const JsonValue* const field = fields[key])
      problems.report(*field, "'" + std::string(key) + "' is for TCP; a server has it or 'serial'");
  options.listen.clear();
  report_taken_line(*fields["serial"], modbus, options.serial->device, problems);
}

}  // namespace

std::optional<Endpoint> read_endpoint(const JsonValue* json, Problems& problems) {
  const auto text = read_form(json, kEndpointForm, problems);
  std::string problem;
  return text ? parse_endpoint(*text, problem) : std::nullopt;
}

void load_modbus_place(const JsonValue& json, const Fields& fields, const Loading& loading) {
  Problems& problems = loading.problems;
  ModbusConfig& modbus = loading.project.modbus;
  ModbusServerOptions& options = modbus.servers.back();
  read_keys(fields, keys::kServer, options, loading);
  if (fields["serial"] != nullptr) return load_line(fields, modbus, options, problems);
  if (fields["listen"] == nullptr)
    problems.report(json, "the key 'listen' is missing, or 'serial' in its place");
  if (fields["unit"] != nullptr)
    problems.report(*fields["unit"], "on TCP every unit id is answered; allowed with 'serial' only");
  if (fields["listen"] != nullptr) {
    load_listen(*fields["listen"], options, problems);
    report_taken_places(fields, modbus, problems);
  }
  load_networks(fields["allow"], options.allow, problems);
  warn_of_open_server(fields, options, problems);
}

void report_taken_line(const JsonValue& serial, const ModbusConfig& modbus, const std::string& device,
                       Problems& problems) {
  std::ptrdiff_t users = 0;
  for (const ModbusServerOptions& server : modbus.servers)
    users += server.serial && server.serial->device == device ? 1 : 0;
  for (const ModbusClientConfig& client : modbus.clients)
    users += client.options.serial.device == device ? 1 : 0;
  const JsonValue* const at = serial.find("device");
  if (users > 1 && at != nullptr && !device.empty())
    problems.report(
        *at, at->shown() + " is the line of another server or client already; each line is allowed once");
}

}  // namespace lockstep
