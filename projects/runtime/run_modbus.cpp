// The Modbus server and clients of a run.
#include <fmt/format.h>

#include "projects/json/addresses.hpp"
#include "projects/runtime/run_surroundings.hpp"

namespace lockstep {

std::vector<Endpoint> RunSurroundings::modbus_endpoints() const {
  return server_ ? server_->endpoints() : std::vector<Endpoint>{};
}

/// What the audit log calls the signals of the map.
std::vector<std::string> RunSurroundings::modbus_names() const {
  std::vector<std::string> names;
  for (const NamedSignal& signal : project_.modbus.signals) names.push_back(signal.name);
  for (const ModbusMapConfig& map : project_.modbus.maps)
    for (const ModbusText& text : map.texts)
      for (std::size_t i = 0; i < text.count(); ++i)
        names[map.map.entries()[text.first + i].signal] +=
            fmt::format(" (characters {} and {})", 2 * i + 1, 2 * i + 2);
  return names;
}

/// What is served where: as the project says, or at the one endpoint that the options name.
std::vector<ModbusService> RunSurroundings::modbus_services() const {
  const ModbusConfig& modbus = project_.modbus;
  std::vector<ModbusService> services;
  for (std::size_t i = 0; i < modbus.servers.size(); ++i)
    services.push_back({modbus.servers[i], modbus.units_of(i)});
  if (options_.modbus.empty()) return services;
  std::string problem;
  const std::optional<Endpoint> endpoint = parse_endpoint(options_.modbus, problem);
  if (!endpoint) throw CouldNotStart(named("modbus") + problem);
  if (services.empty()) services.push_back({ModbusServerOptions{}, modbus.units_of(0)});
  services.erase(services.begin() + 1, services.end());
  services[0].options.listen = {*endpoint};
  services[0].options.serial.reset();
  if (!is_loopback(endpoint->host) && services[0].options.allow.empty())
    messages_.warn(named("modbus") + "whoever reaches " + to_string(*endpoint) +
                   " may read and write what the map shows; 'allow' of the project says from which "
                   "networks clients may come");
  return services;
}

void RunSurroundings::start_modbus() {
  const bool asked = !options_.modbus.empty();
  const bool wanted =
      asked || (!options_.simulate && !options_.no_modbus && !project_.modbus.servers.empty());
  if (!wanted) return;
  std::vector<ModbusService> services = modbus_services();
  image_ = std::make_unique<ProcessImage>(places_of(project_.modbus.signals));
  project_.controller->images.push_back(image_.get());
  ModbusIdentity identity;
  identity.revision = LOCKSTEP_VERSION;
  identity.application = project_.name;
  server_ = std::make_unique<ModbusServer>(std::move(services), *image_, identity);
  if (audit_) server_->audit_to(*audit_, modbus_names());
  if (const std::string error = server_->start(); !error.empty()) throw CouldNotStart("Modbus: " + error);
  for (const Endpoint& endpoint : server_->endpoints())
    messages_.inform("Modbus server on " + to_string(endpoint));
  if (asked) return;
  for (const ModbusServerOptions& server : project_.modbus.servers)
    if (server.serial)
      messages_.inform(
          fmt::format("Modbus server on {}, unit {}", server.serial->device, server.serial_unit));
}

/// Foreign devices have no place in a simulation.
void RunSurroundings::start_clients() {
  if (options_.simulate || options_.no_modbus) return;
  for (const ModbusClientConfig& client : project_.modbus.clients) {
    client_images_.push_back(std::make_unique<ProcessImage>(places_of(client.signals)));
    project_.controller->images.push_back(client_images_.back().get());
    clients_.push_back(std::make_unique<ModbusClient>(client.options, *client_images_.back()));
  }
  for (const auto& client : clients_) client->start();
}

void RunSurroundings::tell_failures(const ModbusClient& client) const {
  const ModbusClientCounters& counters = client.counters();
  const auto warn = [&](const std::atomic<std::uint64_t>& count, std::string_view text) {
    if (count != 0)
      messages_.warn(
          fmt::format("Modbus client of {}: {} {}", client.options().endpoint(), count.load(), text));
  };
  warn(counters.unreachable, "attempts to connect failed");
  warn(counters.failed, "requests without a good answer");
  warn(counters.refused, "requests refused with an exception");
  warn(counters.bad_values, "values read that their tags cannot hold");
  warn(counters.faults, "internal faults survived");
}

/// Clients that were turned away: somebody may be missing, or somebody may have tried.
void RunSurroundings::tell_refused_clients() const {
  const ModbusCounters& counters = server_->counters();
  const auto warn = [this](const std::atomic<std::uint64_t>& count, std::string_view text) {
    if (count != 0) messages_.warn(fmt::format("Modbus: {} {}", count.load(), text));
  };
  warn(counters.not_allowed, "connections refused: not from a network in 'allow'");
  warn(counters.refused, "connections refused: too many clients");
  warn(counters.displaced, "silent clients lost their place to new ones");
  warn(counters.malformed, "connections closed: what came was not Modbus");
  warn(counters.stalled, "connections closed: a request not ended or an answer not taken");
  warn(counters.throttled, "requests held back: more than 'max_requests_per_second'");
  warn(counters.bad_frames, "frames on serial lines dropped: wrong check or length");
  warn(counters.broken_lines, "times a serial line broke");
  warn(counters.faults, "internal faults survived");
}

}  // namespace lockstep
