/// The order in which the axes are stepped: leading before following.
/// @source S7-1500T synchronous operation V7, 5.1 [999], 10.3 [4614-4616]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// Built anew whenever a coupling changes: without allocation, in time proportional to the number of axes,
/// and for each axis that waits to the length of the chain that it would follow.
class CouplingOrder {
 public:
  /// Load time: reserves all memory and puts the axes in the given order.
  void set_axes(std::span<Axis* const> axes);

  /// Thread: the cycle.
  void rebuild() noexcept;

  /// The axes, every coupled leading axis before those that follow it. An awaited leading axis comes first as
  /// well, unless that would close a circle; then the waiting axis is told.
  std::span<Axis* const> axes() const noexcept { return order_; }

 private:
  void place(Axis* axis) noexcept;
  bool leads_back(Axis* axis) noexcept;
  std::uint8_t& mark(const Axis* axis) noexcept;

  std::vector<Axis*> all_;
  std::vector<Axis*> order_;
  std::vector<Axis*> path_;          // axes whose leading axes are being placed
  std::vector<std::uint8_t> marks_;  // by number of the object
};

}  // namespace lockstep
