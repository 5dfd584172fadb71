#include "hmi_bridge/studio/server.hpp"

#include <utility>

#include "hmi_bridge/studio/listener.hpp"

namespace lockstep {

StudioServer::StudioServer(StudioServerOptions options, StudioHandler& handler)
    : listener_(std::make_unique<studio_net::Listener>(std::move(options), handler)) {}

StudioServer::~StudioServer() {
  stop();
}

std::string StudioServer::start() {
  return listener_->start();
}

void StudioServer::stop() {
  listener_->stop();
}

Endpoint StudioServer::endpoint() const {
  return listener_->endpoint();
}

const StudioCounters& StudioServer::counters() const noexcept {
  return listener_->counters();
}

}  // namespace lockstep
