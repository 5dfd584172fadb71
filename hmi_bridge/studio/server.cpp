#include "hmi_bridge/studio/server.hpp"

#include <utility>

#include "hmi_bridge/studio/core.hpp"

namespace lockstep {

StudioServer::StudioServer(StudioServerOptions options, StudioHandler& handler)
    : core_(std::make_unique<studio_net::Core>(std::move(options), handler)) {}

StudioServer::~StudioServer() {
  stop();
}

std::string StudioServer::start() {
  return core_->start();
}

void StudioServer::stop() {
  core_->stop();
}

Endpoint StudioServer::endpoint() const {
  return core_->endpoint();
}

const StudioCounters& StudioServer::counters() const noexcept {
  return core_->counters();
}

}  // namespace lockstep
