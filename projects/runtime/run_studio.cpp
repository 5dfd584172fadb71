// The studio of a run: what others see of it over HTTP and WebSocket.
#include <fmt/format.h>

#include <filesystem>

#include "projects/json/addresses.hpp"
#include "projects/runtime/run_surroundings.hpp"

namespace lockstep {

std::optional<Endpoint> RunSurroundings::studio_endpoint() const {
  if (!studio_server_) return {};
  return studio_server_->endpoint();
}

/// Before the recorder, which tells it what happens.
void RunSurroundings::make_studio() {
  if (studio_listen().empty()) return;
  studio_ =
      std::make_unique<StudioSession>(project_, options_.simulate ? 0 : epoch_, project_.studio.history);
  project_.controller->tap = &studio_->tap();
}

/// What the project says counts in real time; in virtual time nobody looks unless asked to.
std::string RunSurroundings::studio_listen() const {
  if (options_.no_studio) return "";
  if (!options_.studio.empty()) return options_.studio;
  return options_.simulate ? "" : project_.studio.listen;
}

/// When recorder, desk and audit log are there.
void RunSurroundings::empower_studio() {
  StudioPowers powers;
  powers.audit = audit_.get();
  powers.tell = [this](TraceEvent event) { recorder_->tell(std::move(event)); };
  if (commands_) powers.desk = &commands_->desk();
  if (studio_writes()) powers.why_no_write = powers.why_no_command = "";
  if (options_.simulate) powers.why_no_command = "virtual time runs as fast as it can: nobody commands in it";
  powers.describe = options_.describe;
  powers.health = [this] { return health(); };
  powers.project_folder = std::filesystem::path(options_.file).parent_path().string();
  try {
    powers.project_text = expanded_project(options_.file);
  } catch (const UnreadableFile&) {
    powers.project_text.clear();  // it has been loaded otherwise: programs cannot be shown
  }
  studio_->empower(std::move(powers));
}

/// Of what can be read while the run goes on. Thread: the studio's.
std::string RunSurroundings::health() const {
  using studio_api::Json;
  Json json = {{"audit", audit_ ? Json{{"file", audit_->path()}, {"lost", audit_->lost()}} : Json()},
               {"retain", keeper_ ? Json{{"file", keeper_->path()}} : Json()},
               {"losses", recorder_->losses()}};
  json["modbus"] = nullptr;
  if (server_) {
    const ModbusCounters& counters = server_->counters();
    json["modbus"] = {{"clients", counters.clients.load()},
                      {"requests", counters.requests.load()},
                      {"refused", counters.exceptions.load()}};
  }
  json["commands"] = nullptr;
  if (commands_) {
    const CommandCounters counters = commands_->desk().counters();
    json["commands"] = {{"accepted", counters.accepted}, {"refused", counters.refused()}};
  }
  const StudioCounters& counters = studio_server_->counters();
  json["studio"] = {{"requests", counters.requests.load()},
                    {"refused", counters.refused.load()},
                    {"faults", counters.faults.load()},
                    {"pages", counters.pages.load()}};
  if (const RealTimeStatus* const status = status_.load()) {
    json["cycle"] = {{"ticks", status->ticks.load()},
                     {"overruns", status->overruns.load()},
                     {"missed_ticks", status->missed_ticks.load()},
                     {"worst_lateness_us", static_cast<double>(status->worst_lateness.load()) * 1e-3},
                     {"longest_tick_us", static_cast<double>(status->longest_tick.load()) * 1e-3},
                     {"busy_us", static_cast<double>(status->busy.load()) * 1e-3}};
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void RunSurroundings::start_studio() {
  if (!studio_) return;
  empower_studio();
  StudioServerOptions wanted;
  std::string problem;
  const std::optional<Endpoint> endpoint = parse_endpoint(studio_listen(), problem);
  if (!endpoint) throw CouldNotStart(named("studio") + problem);
  wanted.listen = *endpoint;
  wanted.names = options_.studio_names;
  wanted.allow = project_.studio.allow;
  if (!options_.studio_token.empty()) {
    wanted.token = read_studio_token(options_.studio_token, problem);
    if (wanted.token.empty()) throw CouldNotStart(named("studio-token-file") + problem);
  }
  if (wanted.token.empty() && !is_loopback(endpoint->host))
    throw CouldNotStart(
        named("studio") + "whoever reaches " + to_string(*endpoint) +
        " could look at the machine; allowed without a token: 127.0.0.1, [::1] and localhost; "
        "elsewhere --studio-token-file FILE");
  studio_server_ = std::make_unique<StudioServer>(std::move(wanted), *studio_);
  if (const std::string error = studio_server_->start(); !error.empty())
    throw CouldNotStart(named("studio") + error);
  messages_.inform("studio on http://" + to_string(studio_server_->endpoint()) + "/" + rights_of_pages());
}

/// Who looks on knows from the first line on whether others may do more than that.
std::string RunSurroundings::rights_of_pages() const {
  if (!studio_writes()) return "";
  const std::string axes =
      commands_ && !options_.simulate ? commands_->desk().axes_text(CommandRoute::studio) : "";
  return axes.empty() ? ", whose pages may write" : ", whose pages may write, and command " + axes;
}

}  // namespace lockstep
