#include "projects/system/couple.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace lockstep {
namespace {

LeadingValueLink link_of(const System& system, const SystemArea& area) {
  return {.area = system.channel_of(area),
          .sender = system.controllers[area.controller].name,
          .source = area.from->name,
          .interface = area.interface,
          .key = {}};
}

/// The proxies of an area that are on a controller.
std::vector<LeadingAxisProxy*> proxies_of(const SystemArea& area, std::size_t controller) {
  std::vector<LeadingAxisProxy*> proxies;
  for (const SystemArea::Receiver& to : area.to)
    if (to.controller == controller) proxies.push_back(to.proxy);
  return proxies;
}

void keep_within(Project& project, const SystemArea& area, const std::vector<LeadingAxisProxy*>& proxies) {
  TransferArea within{.name = area.name,
                      .from = area.from,
                      .interface = area.interface,
                      .channel = {},
                      .controller = {},
                      .source = {}};
  for (LeadingAxisProxy* const proxy : proxies) {
    auto ring = std::make_unique<TelegramRing>();
    project.controller->telegram_outputs.push_back({area.from, ring.get()});
    project.controller->telegram_inputs.push_back({proxy, ring.get()});
    within.to.push_back({proxy, std::move(ring)});
  }
  project.transfer_areas.push_back(std::move(within));
}

}  // namespace

void couple(System& system, std::size_t controller) {
  Project& project = system.controllers[controller].project;
  NetworkCoupling coupling{.network = system.network};
  coupling.network.controller = system.controllers[controller].name;
  for (const SystemArea& area : system.areas) {
    std::vector<LeadingAxisProxy*> here = proxies_of(area, controller);
    const bool source = area.controller == controller;
    if (source && !here.empty()) keep_within(project, area, here);
    if (source && here.size() < area.to.size()) coupling.sent.push_back({link_of(system, area), area.from});
    if (!source && !here.empty())
      coupling.received.push_back(
          {link_of(system, area), system.controllers[area.controller].addresses, std::move(here)});
  }
  if (!coupling.sent.empty() || !coupling.received.empty()) project.couplings.push_back(std::move(coupling));
}

}  // namespace lockstep
