/// The interconnection overview of a system: which axis follows which leading axis of which controller, by
/// which routes, and the delay times with which all of them see the same leading value at the same time.
/// @source S7-1500T synchronous operation V7, 10.1, 10.6
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "projects/system/system.hpp"

namespace lockstep {

/// An object in its system.
struct SystemObject {
  std::size_t controller = 0;  ///< index
  const LeadingObject* object = nullptr;
  bool operator==(const SystemObject&) const = default;
};

/// A row of the overview: a leading value and an axis that may follow it.
struct Interconnection {
  SystemObject source;                      ///< axis or encoder
  int interface = 0;                        ///< by which it provides the value; 0: for axes of its controller
  std::string area;                         ///< transfer area; empty: none
  const LeadingAxisProxy* proxy = nullptr;  ///< that the axis follows; nullptr: the source itself
  SystemObject following{};                 ///< with an object of nullptr: nothing follows the proxy
  Coupling coupling = Coupling::setpoint;
  bool recursive = false;  ///< the leading axis would follow its own value
  bool cut = false;  ///< recursive, and each circle that it is in has an interconnection that does not count
  bool left_out = false;      ///< does not count in the calculation of delays
  bool ambiguous = false;     ///< the proxy has several sources
  bool extrapolated = false;  ///< the proxy looks ahead of what has come, by delays and cycles as configured

  bool local() const noexcept { return proxy == nullptr; }
};

/// A delay time that is configured: of a leading object that provides its value, or of a proxy.
struct DelayTime {
  SystemObject object;
  bool proxy = false;
  double configured = 0.0;         ///< [s]
  bool fixed = false;              ///< the calculation leaves it as it is
  std::optional<double> computed;  ///< [s]; none: it leads to a recursion
  bool is_current() const noexcept { return fixed || (computed && *computed == configured); }
};

/// A path of a leading value, from an axis back to its source.
struct Route {
  std::vector<const Interconnection*> hops;  ///< the last one is that of the source
  bool extrapolated = false;                 ///< in one of its cascades at least
};

/// The overview of a system, which outlives it.
class Connections {
 public:
  explicit Connections(const System& system);
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  const std::vector<Interconnection>& rows() const noexcept { return rows_; }
  /// Of all objects that have one, in the order of controllers and their objects.
  const std::vector<DelayTime>& delays() const noexcept { return delays_; }
  const DelayTime* delay_of(const LeadingObject* object) const noexcept;
  bool recursive() const noexcept;

  /// The routes by which an axis gets leading values, without those that a recursion is part of. At most
  /// `kMaximumRoutes`.
  std::vector<Route> routes_of(const LeadingObject* following) const;
  static constexpr std::size_t kMaximumRoutes = 1000;

  /// The application cycle of a controller [s].
  double cycle_of(std::size_t controller) const;
  /// Two application cycles of the controller: of the transfer to a proxy on it [s].
  double transfer_time(std::size_t controller) const;

 private:
  struct Link;
  void add_links(std::vector<Link>& links) const;
  void add_rows(const Link& link);
  void add_local_rows();
  void add_delays();
  void mark_recursive();
  void compute_delays();
  void mark_extrapolated();
  bool computed_once();
  double needed(const DelayTime& delay) const;
  void follow_back(const LeadingObject* following, Route& route, std::vector<Route>& routes) const;
  enum class Along { all, counted };
  bool leads_to(const LeadingObject* from, const LeadingObject* to, Along along) const;
  bool goes_round(const Interconnection& row, Along along) const;
  bool counts(const Interconnection& row) const;
  bool ends_in_recursion(const LeadingObject* object) const;
  bool leads_undelayed(const LeadingObject* from, const LeadingObject* to) const;
  bool is_left_out(const LeadingObject* axis) const;
  DelayTime* find_delay(const LeadingObject* object) noexcept;

  const System& system_;
  std::vector<Interconnection> rows_;
  std::vector<DelayTime> delays_;
};

}  // namespace lockstep
