// Transfer areas: by which interface of a leading object telegrams go to which proxy.
#include <algorithm>

#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/looked_at_axis.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

const TO_Struct_CrossPlcSynchronousOperation& provided_by(const LeadingObject& object, LoadedFor use) {
  if (object.kind == ObjectKind::TO_ExternalEncoder)
    return static_cast<const ExternalEncoder&>(object).data.CrossPlcSynchronousOperation;
  return use == LoadedFor::looking
             ? static_cast<const LookedAtAxis&>(object).data.CrossPlcSynchronousOperation
             : static_cast<const Axis&>(object).data.CrossPlcSynchronousOperation;
}

/// What is wrong with the two ends of an area, which are there; true: nothing.
bool fits(const JsonValue& json, const TransferArea& area, const Loading& loading) {
  const std::string interface = "Interface[" + std::to_string(area.interface) + "]";
  const auto index = static_cast<std::size_t>(area.interface) - 1;
  if (!provided_by(*area.from, loading.use).Interface[index].EnableLeadingValueOutput) {
    loading.problems.report(*json.find("from"), "'" + area.from->name +
                                                    "' does not provide its leading value by " + interface +
                                                    "; allowed with: CrossPlcSynchronousOperation." +
                                                    interface + ".EnableLeadingValueOutput TRUE");
    return false;
  }
  const auto& areas = loading.project.transfer_areas;
  const auto same_output = [&](const TransferArea& other) {
    return other.from == area.from && other.interface == area.interface;
  };
  const auto same_proxy = [&](const TransferArea& other) { return other.to == area.to; };
  if (const auto other = std::find_if(areas.begin(), areas.end(), same_output); other != areas.end()) {
    loading.problems.report(*json.find("from"), interface + " of '" + area.from->name +
                                                    "' is that of the transfer area '" + other->name +
                                                    "' already; allowed: one area for each interface");
    return false;
  }
  if (const auto other = std::find_if(areas.begin(), areas.end(), same_proxy); other != areas.end()) {
    loading.problems.report(*json.find("to"), "'" + area.to->name +
                                                  "' has the telegrams of the transfer area '" + other->name +
                                                  "' already; allowed: one source for each proxy");
    return false;
  }
  return true;
}

void load_transfer_area(const std::string& name, const JsonValue& json, const Loading& loading) {
  const Fields fields(json, keys::kTransferArea, loading.problems);
  if (!fields.usable()) return;
  TransferArea area;
  area.name = name;
  const std::size_t before = loading.problems.count();
  read_members(fields, keys::kTransferArea, &area, loading);
  area.from = static_cast<LeadingObject*>(loading.find_object(fields["from"], kPositioned));
  area.to = static_cast<LeadingAxisProxy*>(loading.find_object(fields["to"], kLeadingAxisProxy));
  if (loading.problems.count() != before || area.from == nullptr || area.to == nullptr) return;
  if (!fits(json, area, loading)) return;
  area.ring = std::make_unique<TelegramRing>();
  loading.controller().telegram_outputs.push_back({area.from, area.ring.get()});
  loading.controller().telegram_inputs.push_back({area.to, area.ring.get()});
  loading.project.transfer_areas.push_back(std::move(area));
}

/// What no telegrams can come for leads nothing.
void warn_of_proxies_alone(const JsonValue* objects, const Loading& loading) {
  const auto& areas = loading.project.transfer_areas;
  for (const auto& object : loading.controller().objects) {
    if (object->kind != ObjectKind::TO_LeadingAxisProxy || objects == nullptr) continue;
    const auto its = [&](const TransferArea& area) { return area.to == object.get(); };
    const JsonValue* const json = objects->find(object->name);
    if (json != nullptr && std::none_of(areas.begin(), areas.end(), its))
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
