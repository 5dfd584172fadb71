// Transfer areas: by which interface of a leading object telegrams go to which proxies.
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/network.hpp"
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

/// Reads the areas of a project, those within it and those of which one end is in another process.
class TransferAreaLoader {
 public:
  explicit TransferAreaLoader(const Loading& loading) : loading_(loading) {}

  void load(const TransferSections& sections);

 private:
  void load_area(const std::string& name, const JsonValue& json);
  void require(const Fields& fields, const TransferArea& area) const;
  bool source_fits(const JsonValue& from, const TransferArea& area) const;
  void add_receivers(const JsonValue* to, TransferArea& area) const;
  void add_receiver(const JsonValue& name, TransferArea& area) const;
  const std::string* led_by(const LeadingAxisProxy* proxy) const;
  void keep_within(TransferArea area) const;
  void keep_coupled(const TransferArea& area, const JsonValue& json);
  void warn_of_proxies_alone(const JsonValue* objects) const;

  const Loading& loading_;
  NetworkCoupling coupling_;
  std::vector<TransferArea> crossing_;  // of `coupling_`
};

void TransferAreaLoader::load(const TransferSections& sections) {
  Problems& problems = loading_.problems;
  if (sections.network != nullptr)
    coupling_.network = read_network(*sections.network, loading_.folder, true, loading_);
  if (coupling_.network.controller.empty()) coupling_.network.controller = loading_.project.name;
  if (sections.areas != nullptr && read_object(sections.areas, problems) != nullptr)
    for (const auto& [name, json] : sections.areas->members) load_area(name, *json);
  if (sections.network != nullptr && crossing_.empty() && problems.none())
    problems.warn(*sections.network, "no transfer area is sent or received over this network");
  if (!crossing_.empty()) loading_.project.couplings.push_back(std::move(coupling_));
  warn_of_proxies_alone(sections.objects);
}

void TransferAreaLoader::load_area(const std::string& name, const JsonValue& json) {
  const Fields fields(json, keys::kTransferArea, loading_.problems);
  if (!fields.usable()) return;
  TransferArea area;
  area.name = name;
  const std::size_t before = loading_.problems.count();
  read_members(fields, keys::kTransferArea, &area, loading_);
  if (loading_.problems.count() == before) require(fields, area);
  if (const JsonValue* const from = fields["from"]; from != nullptr) {
    area.from = static_cast<LeadingObject*>(loading_.find_object(from, kPositioned));
    if (loading_.problems.count() == before && area.from != nullptr) source_fits(*from, area);
  }
  add_receivers(fields["to"], area);
  if (loading_.problems.count() != before) return;
  if (area.direction == TransferDirection::within)
    keep_within(std::move(area));
  else
    keep_coupled(area, json);
}

/// Which keys an area has depends on where its ends are.
void TransferAreaLoader::require(const Fields& fields, const TransferArea& area) const {
  using enum TransferDirection;
  const TransferDirection here = area.direction;
  const std::tuple<const char*, bool, bool> keys[] = {
      {"from", here != receive, here != receive},   {"to", here != send, here != send},
      {"channel", false, here != within},           {"controller", here == receive, here == receive},
      {"source", here == receive, here == receive}, {"address", false, here == receive}};
  for (const auto& [key, needed, allowed] : keys) {
    const JsonValue* const json = fields[key];
    if (needed && json == nullptr)
      loading_.problems.report(fields.value(), std::string("the key '") + key + "' is missing");
    if (!allowed && json != nullptr)
      loading_.problems.report_key(*json,
                                   std::string("the key '") + key +
                                       "' has no meaning for an area of this direction; allowed: " +
                                       (std::string_view(key) == "from"      ? "with 'within' and 'send'"
                                        : std::string_view(key) == "to"      ? "with 'within' and 'receive'"
                                        : std::string_view(key) == "channel" ? "with 'send' and 'receive'"
                                                                             : "with 'receive'"));
  }
}

/// Whether the source of an area, which is there, provides its value by the interface, and by it alone.
bool TransferAreaLoader::source_fits(const JsonValue& from, const TransferArea& area) const {
  if (area.direction == TransferDirection::receive) return true;
  std::string problem = interface_problem(*area.from, area.interface);
  for (const auto* const areas : {&std::as_const(loading_.project.transfer_areas), &crossing_})
    for (const TransferArea& other : *areas)
      if (other.from == area.from && other.interface == area.interface && problem.empty())
        problem = interface_text(area.interface) + " of '" + area.from->name +
                  "' is that of the transfer area '" + other.name +
                  "' already; allowed: one area for each interface";
  if (!problem.empty()) loading_.problems.report(from, problem);
  return problem.empty();
}

/// The area that leads a proxy already; nullptr: none.
const std::string* TransferAreaLoader::led_by(const LeadingAxisProxy* proxy) const {
  for (const auto* const areas : {&std::as_const(loading_.project.transfer_areas), &crossing_})
    for (const TransferArea& area : *areas)
      if (area.leads(proxy)) return &area.name;
  return nullptr;
}

/// Adds the proxy of a name to an area.
void TransferAreaLoader::add_receiver(const JsonValue& name, TransferArea& area) const {
  auto* const proxy = static_cast<LeadingAxisProxy*>(loading_.find_object(&name, kLeadingAxisProxy));
  if (proxy == nullptr) return;
  const std::string* const other = area.leads(proxy) ? &area.name : led_by(proxy);
  if (other == nullptr) return void(area.to.push_back({proxy, nullptr}));
  loading_.problems.report(name, "'" + proxy->name + "' has the telegrams of the transfer area '" + *other +
                                     "' already; allowed: one source for each proxy");
}

void TransferAreaLoader::add_receivers(const JsonValue* to, TransferArea& area) const {
  if (to == nullptr) return;
  if (to->kind != JsonKind::array) return add_receiver(*to, area);
  if (to->elements.empty())
    loading_.problems.report(*to, "nobody takes these telegrams; allowed: one proxy or more");
  for (const JsonValue* const name : to->elements) add_receiver(*name, area);
}

void TransferAreaLoader::keep_within(TransferArea area) const {
  Controller& controller = loading_.controller();
  for (TransferArea::Receiver& receiver : area.to) {
    receiver.ring = std::make_unique<TelegramRing>();
    controller.telegram_outputs.push_back({area.from, receiver.ring.get()});
    controller.telegram_inputs.push_back({receiver.proxy, receiver.ring.get()});
  }
  loading_.project.transfer_areas.push_back(std::move(area));
}

/// One end is in another process.
void TransferAreaLoader::keep_coupled(const TransferArea& area, const JsonValue& json) {
  Problems& problems = loading_.problems;
  const bool sent = area.direction == TransferDirection::send;
  LeadingValueLink link{.area = area.channel.empty() ? area.name : area.channel,
                        .sender = sent ? coupling_.network.controller : area.controller,
                        .source = sent ? area.from->name : area.source,
                        .interface = area.interface};
  const JsonValue* const channel = json.find("channel");
  if (const std::string problem = channel_problem(link.area); !problem.empty())
    return problems.report(channel != nullptr ? *channel : json, problem);
  for (const TransferArea& other : crossing_)
    if (other.channel == link.area)
      return problems.report(channel != nullptr ? *channel : json,
                             "the channel " + quote(link.area) + " is that of the transfer area '" +
                                 other.name + "' already; allowed: one area for each channel");
  TransferArea kept{.name = area.name,
                    .from = area.from,
                    .interface = area.interface,
                    .direction = area.direction,
                    .channel = link.area,
                    .controller = area.controller,
                    .source = area.source};
  for (const TransferArea::Receiver& receiver : area.to) kept.to.push_back({receiver.proxy, nullptr});
  crossing_.push_back(std::move(kept));
  if (sent) return void(coupling_.sent.push_back({std::move(link), area.from}));
  ReceivedArea received{.link = std::move(link), .senders = read_senders(json.find("address"), problems)};
  for (const TransferArea::Receiver& receiver : area.to) received.to.push_back(receiver.proxy);
  coupling_.received.push_back(std::move(received));
}

/// What no telegrams can come for leads nothing.
void TransferAreaLoader::warn_of_proxies_alone(const JsonValue* objects) const {
  for (const auto& object : loading_.controller().objects) {
    if (object->kind != ObjectKind::TO_LeadingAxisProxy || objects == nullptr) continue;
    const JsonValue* const json = objects->find(object->name);
    if (json == nullptr || loading_.is_led_from_outside(object->name)) continue;
    if (led_by(static_cast<const LeadingAxisProxy*>(object.get())) == nullptr)
      loading_.problems.warn(*json,
                             "no transfer area has telegrams for '" + object->name + "'; it leads nothing");
  }
}

}  // namespace

void load_transfer_areas(const TransferSections& sections, const Loading& loading) {
  TransferAreaLoader(loading).load(sections);
}

}  // namespace lockstep
