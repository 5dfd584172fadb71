#include "projects/system/connections.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "projects/loader/provided_value.hpp"
#include "tech_objects/axis/configured_axis.hpp"

namespace lockstep {
namespace {

constexpr double kTransferCycles = 2.0;  // of the controller of the proxy, as published
constexpr double kNano = 1e-9;

const std::vector<LeadingValue>& leading_values_of(const LeadingObject& object) {
  static const std::vector<LeadingValue> kNone;
  return object.kind == ObjectKind::TO_SynchronousAxis
             ? static_cast<const ConfiguredAxis&>(object).leading_values
             : kNone;
}

double delay_configured_of(const LeadingObject& object) {
  return object.kind == ObjectKind::TO_LeadingAxisProxy
             ? static_cast<const LeadingAxisProxy&>(object).data.Parameter.LocalLeadingValueDelayTime
             : provided_by(object).LocalLeadingValueDelayTime;
}

}  // namespace

/// A transfer area of a system, or of one of its projects, to one proxy.
struct Connections::Link {
  std::string area;
  SystemObject from;
  int interface = 1;
  std::size_t controller = 0;  // of the proxy
  const LeadingAxisProxy* proxy = nullptr;
};

Connections::Connections(const System& system) : system_(system) {
  std::vector<Link> links;
  add_links(links);
  for (const Link& link : links) {
    const auto same = [&](const Link& other) { return other.proxy == link.proxy; };
    const std::size_t first = rows_.size();
    add_rows(link);
    const bool ambiguous = std::ranges::count_if(links, same) > 1;
    for (std::size_t i = first; i < rows_.size(); ++i) rows_[i].ambiguous = ambiguous;
  }
  add_local_rows();
  add_delays();
  mark_recursive();
  compute_delays();
  mark_extrapolated();
}

// ---- What there is

void Connections::add_links(std::vector<Link>& links) const {
  for (const SystemArea& area : system_.areas)
    for (const SystemArea::Receiver& to : area.to)
      links.push_back({area.name, {area.controller, area.from}, area.interface, to.controller, to.proxy});
  for (std::size_t i = 0; i < system_.controllers.size(); ++i)
    for (const TransferArea& area : system_.controllers[i].project.transfer_areas)
      for (const TransferArea::Receiver& to : area.to)
        links.push_back({area.name, {i, area.from}, area.interface, i, to.proxy});
}

/// A row for each axis that may follow the proxy; one without an axis if there is none.
void Connections::add_rows(const Link& link) {
  Interconnection row{
      .source = link.from, .interface = link.interface, .area = link.area, .proxy = link.proxy};
  const std::size_t before = rows_.size();
  for (const auto& object : system_.controllers[link.controller].project.controller->objects) {
    if (!among(object->kind, kLeading)) continue;
    const auto& axis = static_cast<const LeadingObject&>(*object);
    for (const LeadingValue& leading : leading_values_of(axis)) {
      if (leading.source != link.proxy) continue;
      row.following = {link.controller, &axis};
      row.coupling = leading.coupling;
      row.left_out = is_left_out(&axis);
      rows_.push_back(row);
    }
  }
  if (rows_.size() != before) return;
  row.following = {link.controller, nullptr};
  rows_.push_back(row);
}

void Connections::add_local_rows() {
  for (std::size_t i = 0; i < system_.controllers.size(); ++i)
    for (const auto& object : system_.controllers[i].project.controller->objects) {
      if (!among(object->kind, kLeading)) continue;
      const auto& axis = static_cast<const LeadingObject&>(*object);
      for (const LeadingValue& leading : leading_values_of(axis))
        if (leading.source->kind != ObjectKind::TO_LeadingAxisProxy)
          rows_.push_back({.source = {i, leading.source},
                           .area = "",
                           .following = {i, &axis},
                           .coupling = leading.coupling});
    }
}

/// Of what provides by a transfer area, and of the proxies.
void Connections::add_delays() {
  for (std::size_t i = 0; i < system_.controllers.size(); ++i)
    for (const auto& object : system_.controllers[i].project.controller->objects) {
      if (!among(object->kind, kLeading)) continue;
      const auto* const leading = static_cast<const LeadingObject*>(object.get());
      const bool proxy = leading->kind == ObjectKind::TO_LeadingAxisProxy;
      const bool provides = std::ranges::any_of(rows_, [&](const Interconnection& row) {
        return row.proxy != nullptr && (proxy ? row.proxy == leading : row.source.object == leading);
      });
      if (!provides) continue;
      const bool fixed = std::ranges::any_of(
          system_.delays.fixed, [&](const KeptDelays::Axis& one) { return one.object == leading; });
      delays_.push_back({{i, leading}, proxy, delay_configured_of(*leading), fixed, std::nullopt});
    }
}

bool Connections::is_left_out(const LeadingObject* axis) const {
  return std::ranges::any_of(system_.delays.left_out,
                             [&](const KeptDelays::Axis& one) { return one.object == axis; });
}

// ---- Recursions

/// Whether the calculation has to do with an interconnection: it is not left out, nor is one of its objects.
bool Connections::counts(const Interconnection& row) const {
  const auto fixed = [&](const LeadingObject* object) {
    const DelayTime* const delay = delay_of(object);
    return delay != nullptr && delay->fixed;
  };
  return row.local() || !(row.left_out || fixed(row.source.object) || fixed(row.proxy));
}

/// Whether the value of an object comes, by whatever axes and proxies, to another one.
bool Connections::leads_to(const LeadingObject* from, const LeadingObject* to, Along along) const {
  std::vector<const LeadingObject*> open = {from};
  std::unordered_set<const LeadingObject*> seen;
  while (!open.empty()) {
    const LeadingObject* const object = open.back();
    open.pop_back();
    for (const Interconnection& row : rows_) {
      if (row.source.object != object || row.following.object == nullptr) continue;
      if (along == Along::counted && !counts(row)) continue;
      if (row.following.object == to) return true;
      if (seen.insert(row.following.object).second) open.push_back(row.following.object);
    }
  }
  return false;
}

/// Whether the source of an interconnection follows its own value by it.
bool Connections::goes_round(const Interconnection& row, Along along) const {
  if (row.following.object == nullptr || (along == Along::counted && !counts(row))) return false;
  return row.following.object == row.source.object ||
         leads_to(row.following.object, row.source.object, along);
}

void Connections::mark_recursive() {
  for (Interconnection& row : rows_) row.recursive = goes_round(row, Along::all);
  for (Interconnection& row : rows_) row.cut = row.recursive && !goes_round(row, Along::counted);
}

bool Connections::recursive() const noexcept {
  return std::ranges::any_of(rows_, &Interconnection::recursive);
}

// ---- Delays

double Connections::cycle_of(std::size_t controller) const {
  const Clock& clock = system_.controllers[controller].project.controller->clock;
  return static_cast<double>(clock.interpolator_cycle()) * kNano;
}

double Connections::transfer_time(std::size_t controller) const {
  return kTransferCycles * cycle_of(controller);
}

DelayTime* Connections::find_delay(const LeadingObject* object) noexcept {
  const auto found =
      std::ranges::find_if(delays_, [&](const DelayTime& one) { return one.object.object == object; });
  return found == delays_.end() ? nullptr : &*found;
}

const DelayTime* Connections::delay_of(const LeadingObject* object) const noexcept {
  const auto found =
      std::ranges::find_if(delays_, [&](const DelayTime& one) { return one.object.object == object; });
  return found == delays_.end() ? nullptr : &*found;
}

/// Whether an object of the controller follows a proxy or another object there, by whatever axes between
/// them, and is as far ahead in time as that is: none of them is coupled behind a delay or left out.
bool Connections::leads_undelayed(const LeadingObject* from, const LeadingObject* to) const {
  std::vector<const LeadingObject*> open = {from};
  std::unordered_set<const LeadingObject*> seen;
  while (!open.empty()) {
    const LeadingObject* const object = open.back();
    open.pop_back();
    for (const Interconnection& row : rows_) {
      const LeadingObject* const leading = row.local() ? row.source.object : row.proxy;
      const LeadingObject* const following = row.following.object;
      if (leading != object || following == nullptr || row.coupling == Coupling::delayed ||
          is_left_out(following))
        continue;
      if (following == to) return true;
      if (seen.insert(following).second) open.push_back(following);
    }
  }
  return false;
}

/// What a delay has to be at least, with the others as they are computed so far: of a leading object the
/// transfer to each proxy and what that brings forward; and as much as that of all whose value it passes on,
/// or that pass on its own: proxies, and axes of its controller that provide their value again.
double Connections::needed(const DelayTime& delay) const {
  const LeadingObject* const object = delay.object.object;
  double lowest = 0.0;
  const auto add = [&](double value) { lowest = std::max(lowest, value); };
  for (const DelayTime& other : delays_)
    if (&other != &delay && other.object.controller == delay.object.controller &&
        (leads_undelayed(object, other.object.object) || leads_undelayed(other.object.object, object)))
      add(other.computed.value_or(0.0));
  for (const Interconnection& row : rows_) {
    if (row.local() || row.left_out || row.source.object != object || row.following.object == nullptr)
      continue;
    const DelayTime* const of_proxy = delay_of(row.proxy);
    add(transfer_time(row.following.controller) +
        (of_proxy == nullptr ? 0.0 : of_proxy->computed.value_or(0.0)));
  }
  return lowest;
}

/// @return whether something has changed
bool Connections::computed_once() {
  bool changed = false;
  for (DelayTime& delay : delays_) {
    if (!delay.computed || delay.fixed) continue;
    const double value = std::round(needed(delay) * 1e9) / 1e9;  // the number that a project would have
    changed |= value != *delay.computed;
    delay.computed = value;
  }
  return changed;
}

/// Whether an object is part of a recursion, or leads to one.
bool Connections::ends_in_recursion(const LeadingObject* object) const {
  const auto is_there = [&](const LeadingObject* leading, const Interconnection& round) {
    return round.source.object == leading || leads_to(leading, round.source.object, Along::counted);
  };
  const auto ends_there = [&](const Interconnection& round) {
    if (!round.recursive || round.cut) return false;
    if (round.proxy == object || round.following.object == object || is_there(object, round)) return true;
    return std::ranges::any_of(rows_, [&](const Interconnection& row) {
      return row.proxy == object && row.following.object != nullptr && counts(row) &&
             is_there(row.following.object, round);
    });
  };
  return std::ranges::any_of(rows_, ends_there);
}

/// From 0 they grow until nothing asks for more: as many rounds as there are cascades.
void Connections::compute_delays() {
  for (DelayTime& delay : delays_) {
    if (delay.fixed)
      delay.computed = delay.configured;
    else if (!ends_in_recursion(delay.object.object))
      delay.computed = 0.0;
  }
  for (std::size_t round = 0; round <= delays_.size() && computed_once(); ++round) continue;
}

/// By the delays as they are configured: what is at hand has to last for the transfer, and until the next
/// telegram of a source that is slow.
void Connections::mark_extrapolated() {
  for (Interconnection& row : rows_) {
    if (row.local()) continue;
    const double at_hand = delay_configured_of(*row.source.object) - delay_configured_of(*row.proxy);
    const double needed = std::max(transfer_time(row.following.controller), cycle_of(row.source.controller));
    row.extrapolated = needed > at_hand + 0.5 * kNano;
  }
}

// ---- Routes

void Connections::follow_back(const LeadingObject* following, Route& route,
                              std::vector<Route>& routes) const {
  bool has_source = false;
  for (const Interconnection& row : rows_) {
    if (row.following.object != following) continue;
    has_source = true;
    if (row.recursive) continue;
    route.hops.push_back(&row);
    follow_back(row.source.object, route, routes);
    route.hops.pop_back();
    if (routes.size() >= kMaximumRoutes) return;
  }
  if (has_source || route.hops.empty()) return;
  routes.push_back(route);
  routes.back().extrapolated =
      std::ranges::any_of(route.hops, [](const Interconnection* hop) { return hop->extrapolated; });
}

std::vector<Route> Connections::routes_of(const LeadingObject* following) const {
  std::vector<Route> routes;
  Route route;
  follow_back(following, route, routes);
  return routes;
}

}  // namespace lockstep
