/// Which signals a ring holds when several sinks ask for some each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"
#include "scheduler/controller.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A signal under the name by which the project calls it.
struct NamedSignal {
  std::string name;
  Signal signal;
  Unit unit = Unit::kNone;
  const TechnologyObject* object = nullptr;  ///< whose variable it is
  const Instance* instance = nullptr;        ///< whose pin it is
};

/// The unit of a signal in words, as the project has it. Once everything is loaded.
std::string unit_of(const NamedSignal& signal);

/// Where the values of some signals stand, in their order.
std::vector<Signal> places_of(const std::vector<NamedSignal>& signals);

/// The columns of a ring: each signal once, in the order in which it was first asked for.
class TraceColumns {
 public:
  /// The column of a signal; it is added if none of its name is there.
  std::size_t of(const NamedSignal& signal);
  /// The columns of several signals, in their order.
  std::vector<std::size_t> of(const std::vector<NamedSignal>& signals);

  /// What the ring is made with.
  std::vector<Signal> places() const { return places_of(columns_); }
  /// What the recorder tells its sinks.
  std::vector<TraceSignal> described() const;

 private:
  std::vector<NamedSignal> columns_;
};

}  // namespace lockstep
