// Devices that lead themselves: what they are led by would grow by itself. Axes that may follow each other
// are none of that: a job that would close their circle fails (16#8019).
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "projects/loader/loader.hpp"
#include "tech_objects/axis/configured_axis.hpp"

namespace lockstep {
namespace {

/// That an object is led by another one, or may be.
struct Lead {
  const LeadingObject* by;
  std::string_view how;
  std::string_view where;  ///< it can be left out: a key, or the name of a transfer area
};

class CircleSearch {
 public:
  explicit CircleSearch(const Loading& loading)
      : loading_(loading), done_(loading.controller().objects.size() + 1) {}

  void search(const Mco305& device, const JsonValue* json);

 private:
  using Objects = std::vector<const TechnologyObject*>;

  const std::vector<Lead>& leads_of(const TechnologyObject& object);
  Objects circle_of(const Mco305& device);
  std::string text(const Objects& circle);

  static std::size_t index(const TechnologyObject& object) { return static_cast<std::size_t>(object.number); }

  const Loading& loading_;
  std::vector<bool> done_;   // devices, by their numbers: no further circle goes over them
  std::vector<Lead> leads_;  // of the last object that was asked for
};

std::string_view master_key(const DeviceMaster& master) {
  return master.follows != nullptr ? "follows" : "encoder_output_of";
}

std::string text_of_where(const TechnologyObject& object, const Lead& lead) {
  const std::string of_it = " of '" + object.name + "'";
  if (object.kind == ObjectKind::TO_SynchronousAxis)
    return "'" + lead.by->name + "' among the " + std::string(lead.where) + of_it;
  if (object.kind == ObjectKind::TO_LeadingAxisProxy) return "the transfer area " + quote(lead.where);
  return quote(lead.where) + of_it;
}

const std::vector<Lead>& CircleSearch::leads_of(const TechnologyObject& object) {
  leads_.clear();
  const auto add = [&](const LeadingObject* by, std::string_view how, std::string_view where) {
    if (by != nullptr) leads_.push_back({by, how, where});
  };
  if (object.kind == ObjectKind::MCO_305) {
    const DeviceMaster& master = static_cast<const Mco305&>(object).master;
    add(master.follows != nullptr ? master.follows : master.encoder_output_of, "follows", master_key(master));
  } else if (object.kind == ObjectKind::TO_SynchronousAxis) {
    for (const LeadingValue& value : loading_.leading_values_of(object))
      add(value.source, "may follow", "leading_values");
  } else if (object.kind == ObjectKind::TO_ExternalEncoder) {
    add(static_cast<const ExternalEncoder&>(object).source_settings.follows, "sits on", "follows");
  } else if (object.kind == ObjectKind::TO_LeadingAxisProxy) {
    for (const TransferArea& area : loading_.project.transfer_areas)
      if (area.leads(&object)) add(area.from, "has the value of", area.name);
  }
  return leads_;
}

/// The shortest one: the device, what leads it, what leads that, … and the device again; empty: there is
/// none.
CircleSearch::Objects CircleSearch::circle_of(const Mco305& device) {
  Objects led(done_.size());  // by each number, the one over which it was reached
  Objects reached = {&device};
  for (std::size_t i = 0; i < reached.size() && led[index(device)] == nullptr; ++i) {
    for (const Lead& lead : leads_of(*reached[i])) {
      const std::size_t by = index(*lead.by);
      if (done_[by] || led[by] != nullptr) continue;
      led[by] = reached[i];
      reached.push_back(lead.by);
    }
  }
  if (led[index(device)] == nullptr) return {};
  Objects circle = {&device};
  do circle.push_back(led[index(*circle.back())]);
  while (circle.back() != &device);
  std::ranges::reverse(circle);
  return circle;
}

std::string CircleSearch::text(const Objects& circle) {
  std::string path = "'" + circle.front()->name + "'", allowed;
  for (std::size_t i = 0; i + 1 < circle.size(); ++i) {
    const std::vector<Lead>& leads = leads_of(*circle[i]);
    const Lead& lead = *std::ranges::find(leads, circle[i + 1], &Lead::by);
    path += (i == 0 ? " " : ", which ") + std::string(lead.how) + " '" + lead.by->name + "'";
    allowed += (i == 0 ? "" : ", ") + text_of_where(*circle[i], lead);
  }
  const bool devices = std::ranges::all_of(
      circle, [](const TechnologyObject* one) { return one->kind == ObjectKind::MCO_305; });
  return (devices ? "devices follow each other in a circle: "
                  : "a device leads itself through what it follows: ") +
         path + "; allowed: leave " + (circle.size() == 2 ? "it" : "one of them") + " out: " + allowed;
}

void CircleSearch::search(const Mco305& device, const JsonValue* json) {
  const Objects circle = circle_of(device);
  done_[index(device)] = true;
  if (circle.empty() || json == nullptr) return;
  const JsonValue* const master = json->find("master");
  const JsonValue* const key = master != nullptr ? master->find(master_key(device.master)) : nullptr;
  loading_.problems.report(key != nullptr ? *key : *json, text(circle));
}

}  // namespace

void refuse_circles(const JsonValue& objects, const Loading& loading) {
  CircleSearch search(loading);
  for (const auto& object : loading.controller().objects)
    if (object->kind == ObjectKind::MCO_305)
      search.search(static_cast<const Mco305&>(*object), objects.find(object->name));
}

}  // namespace lockstep
