#include "hmi_bridge/studio/server.hpp"

#include <memory>
#include <utility>

#include "hmi_bridge/studio/connection.hpp"
#include "hmi_bridge/studio/listener.hpp"

namespace lockstep {
namespace {

void welcome(studio_net::Listener& listener, studio_net::Tcp::socket socket) {
  const auto connection = std::make_shared<studio_net::Connection>(listener, std::move(socket));
  if (listener.has_seat())
    connection->read();
  else
    connection->turn_away();
}

}  // namespace

StudioServer::StudioServer(StudioServerOptions options, StudioHandler& handler)
    : listener_(std::make_unique<studio_net::Listener>(std::move(options), handler, welcome)) {}

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
