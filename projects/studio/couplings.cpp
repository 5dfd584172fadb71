#include "projects/studio/couplings.hpp"

#include <string>
#include <utility>

#include "projects/json/problem.hpp"

namespace lockstep::studio_api {
namespace {

std::string delay_of_proxy(const std::string& proxy) {
  return proxy + ".Parameter.LocalLeadingValueDelayTime";
}

const TechnologyObject* object_named(const Project& project, const Json& name) {
  if (!name.is_string()) return nullptr;
  for (const auto& object : project.controller->objects)
    if (same_name(object->name, name.get_ref<const std::string&>())) return object.get();
  return nullptr;
}

/// By what the leading value of a coupling is delayed; empty: by nothing.
std::string delay_of(const Project& project, const Json& coupling) {
  const TechnologyObject* const leading = object_named(project, coupling.at("leading"));
  if (leading == nullptr) return "";
  if (leading->kind == ObjectKind::TO_LeadingAxisProxy) return delay_of_proxy(leading->name);
  return coupling.value("coupling", "") == "delayed"
             ? leading->name + ".CrossPlcSynchronousOperation.LocalLeadingValueDelayTime"
             : "";
}

Json area_json(const std::string& following, const std::string& leading, const std::string& area) {
  return {{"following", following}, {"leading", leading}, {"area", area}};
}

void add_areas_within(const Project& project, Json& list) {
  for (const TransferArea& area : project.transfer_areas)
    for (const TransferArea::Receiver& receiver : area.to)
      list.push_back(area_json(receiver.proxy->name, area.from->name, area.name));
}

/// Who receives what is sent is known to nobody here: whoever listens.
void add_areas_beyond(const Project& project, Json& list) {
  for (const NetworkCoupling& coupling : project.couplings) {
    for (const ReceivedArea& area : coupling.received)
      for (const LeadingAxisProxy* const proxy : area.to) {
        Json one = area_json(proxy->name, area.link.sender + "." + area.link.source, area.link.area);
        one["remote"] = "leading";
        list.push_back(std::move(one));
      }
    for (const SentArea& area : coupling.sent) {
      Json one = area_json("proxies of " + area.link.area, area.from->name, area.link.area);
      one["remote"] = "following";
      list.push_back(std::move(one));
    }
  }
}

}  // namespace

Json couplings_json(const Project& project, const StudioProjectText& text) {
  Json list = text.couplings();
  for (Json& coupling : list)
    if (std::string delay = delay_of(project, coupling); !delay.empty()) coupling["delay"] = std::move(delay);
  add_areas_within(project, list);
  add_areas_beyond(project, list);
  return list;
}

}  // namespace lockstep::studio_api
