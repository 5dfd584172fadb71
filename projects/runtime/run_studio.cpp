// The studio of a run: what others see of it over HTTP and WebSocket.
#include <fmt/format.h>

#include "projects/runtime/run_surroundings.hpp"

namespace lockstep {

std::optional<Endpoint> RunSurroundings::studio_endpoint() const {
  if (!studio_server_) return {};
  return studio_server_->endpoint();
}

/// Before the recorder, which tells it what happens.
void RunSurroundings::make_studio() {
  if (options_.studio.empty()) return;
  studio_ = std::make_unique<StudioSession>(project_, options_.simulate ? 0 : epoch_);
  project_.controller->tap = &studio_->tap();
}

void RunSurroundings::start_studio() {
  if (!studio_) return;
  StudioServerOptions wanted;
  std::string problem;
  const std::optional<Endpoint> endpoint = parse_endpoint(options_.studio, problem);
  if (!endpoint) throw CouldNotStart(named("studio") + problem);
  wanted.listen = *endpoint;
  wanted.names = options_.studio_names;
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
  messages_.inform("studio on http://" + to_string(studio_server_->endpoint()) + "/");
}

}  // namespace lockstep
