/// What a project says of an axis.
#pragma once

#include <vector>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// What a project says of an axis, apart from what moves it: what a name, a reference or a pin reads that may
/// lead to an axis of a project that is only looked at, where nothing moves.
class ConfiguredAxis : public LeadingObject {
 public:
  using LeadingObject::LeadingObject;

  /// The technology data block. The project sets start values before `configure`; afterwards DIR and CAL
  /// variables may be written in the cycle, the rest is computed.
  alignas(kCacheLine) AxisData data;

  /// The leading values with which this axis is interconnected; only these may be named by jobs.
  std::vector<LeadingValue> leading_values;
};

}  // namespace lockstep
