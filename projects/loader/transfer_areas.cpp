// Transfer areas: by which interface of a leading object telegrams go to which proxies.
#include <algorithm>

#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/provided_value.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/axis/configured_axis.hpp"

namespace lockstep {

const TO_Struct_CrossPlcSynchronousOperation& provided_by(const LeadingObject& object) {
  return object.kind == ObjectKind::TO_ExternalEncoder
             ? static_cast<const ExternalEncoder&>(object).data.CrossPlcSynchronousOperation
             : static_cast<const ConfiguredAxis&>(object).data.CrossPlcSynchronousOperation;
}

std::string interface_text(int interface) {
  return "Interface[" + std::to_string(interface) + "]";
}

std::string interface_problem(const LeadingObject& object, int interface) {
  const auto index = static_cast<std::size_t>(interface) - 1;
  if (provided_by(object).Interface[index].EnableLeadingValueOutput) return "";
  return "'" + object.name + "' does not provide its leading value by " + interface_text(interface) +
         "; allowed with: CrossPlcSynchronousOperation." + interface_text(interface) +
         ".EnableLeadingValueOutput TRUE";
}

namespace {

/// Whether the source of an area, which is there, provides its value by the interface, and by it alone.
bool source_fits(const JsonValue& json, const TransferArea& area, const Loading& loading) {
  const JsonValue& from = *json.find("from");
  const std::string problem = interface_problem(*area.from, area.interface);
  if (!problem.empty()) {
    loading.problems.report(from, problem);
    return false;
  }
  const auto& areas = loading.project.transfer_areas;
  const auto other = std::ranges::find_if(areas, [&](const TransferArea& one) {
    return one.from == area.from && one.interface == area.interface;
  });
  if (other == areas.end()) return true;
  loading.problems.report(from, interface_text(area.interface) + " of '" + area.from->name +
                                    "' is that of the transfer area '" + other->name +
                                    "' already; allowed: one area for each interface");
  return false;
}

/// Adds the proxy of a name to an area.
void add_receiver(const JsonValue& name, TransferArea& area, const Loading& loading) {
  auto* const proxy = static_cast<LeadingAxisProxy*>(loading.find_object(&name, kLeadingAxisProxy));
  if (proxy == nullptr) return;
  const auto& areas = loading.project.transfer_areas;
  const auto other = std::ranges::find_if(areas, [&](const TransferArea& one) { return one.leads(proxy); });
  if (other == areas.end() && !area.leads(proxy)) return void(area.to.push_back({proxy, nullptr}));
  loading.problems.report(name, "'" + proxy->name + "' has the telegrams of the transfer area '" +
                                    (other == areas.end() ? area.name : other->name) +
                                    "' already; allowed: one source for each proxy");
}

void add_receivers(const JsonValue* to, TransferArea& area, const Loading& loading) {
  if (to == nullptr) return;
  if (to->kind != JsonKind::array) return add_receiver(*to, area, loading);
  if (to->elements.empty())
    loading.problems.report(*to, "nobody takes these telegrams; allowed: one proxy or more");
  for (const JsonValue* const name : to->elements) add_receiver(*name, area, loading);
}

void load_transfer_area(const std::string& name, const JsonValue& json, const Loading& loading) {
  const Fields fields(json, keys::kTransferArea, loading.problems);
  if (!fields.usable()) return;
  TransferArea area;
  area.name = name;
  const std::size_t before = loading.problems.count();
  read_members(fields, keys::kTransferArea, &area, loading);
  area.from = static_cast<LeadingObject*>(loading.find_object(fields["from"], kPositioned));
  if (loading.problems.count() == before && area.from != nullptr) source_fits(json, area, loading);
  add_receivers(fields["to"], area, loading);
  if (loading.problems.count() != before || area.from == nullptr) return;
  for (TransferArea::Receiver& receiver : area.to) {
    receiver.ring = std::make_unique<TelegramRing>();
    loading.controller().telegram_outputs.push_back({area.from, receiver.ring.get()});
    loading.controller().telegram_inputs.push_back({receiver.proxy, receiver.ring.get()});
  }
  loading.project.transfer_areas.push_back(std::move(area));
}

/// What no telegrams can come for leads nothing.
void warn_of_proxies_alone(const JsonValue* objects, const Loading& loading) {
  const auto& areas = loading.project.transfer_areas;
  for (const auto& object : loading.controller().objects) {
    if (object->kind != ObjectKind::TO_LeadingAxisProxy || objects == nullptr) continue;
    const JsonValue* const json = objects->find(object->name);
    if (json == nullptr || loading.is_led_from_outside(object->name)) continue;
    if (std::ranges::none_of(areas, [&](const TransferArea& area) { return area.leads(object.get()); }))
      loading.problems.warn(*json,
                            "no transfer area has telegrams for '" + object->name + "'; it leads nothing");
  }
}

}  // namespace

void load_transfer_areas(const JsonValue* areas, const JsonValue* objects, const Loading& loading) {
  if (areas != nullptr && read_object(areas, loading.problems) != nullptr)
    for (const auto& [name, json] : areas->members) load_transfer_area(name, *json, loading);
  warn_of_proxies_alone(objects, loading);
}

}  // namespace lockstep
