/// Which axes can be stepped side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// The order of the axes in levels: an axis reads only axes of lower levels, so that those of one level can
/// be stepped in any order, or at once, and the result is to the bit that of the whole order one by one.
///
/// A coupled axis reads its leading axis. An axis that waits for its synchronous position looks along the
/// whole chain of couplings above it; it is a level of its own, behind all axes in front of it in the order
/// and before all others.
class Levels {
 public:
  /// Load time: reserves all memory. @param highest_number of an axis
  void reserve(std::size_t axes, std::uint32_t highest_number);

  /// Without allocation, in time proportional to the number of axes. Thread: the cycle.
  /// @param order leading before following axes
  void rebuild(std::span<Axis* const> order) noexcept;

  std::size_t count() const noexcept { return count_; }
  /// The axes of a level, from 0, in their order.
  std::span<Axis* const> operator[](std::size_t level) const noexcept {
    return std::span(axes_).subspan(begins_[level], begins_[level + 1] - begins_[level]);
  }

 private:
  std::vector<Axis*> axes_;            // by level
  std::vector<std::uint32_t> begins_;  // of the levels in `axes_`, and the end of the last one
  std::vector<std::uint32_t> levels_;  // by number of the axis
  std::size_t count_ = 0;
};

}  // namespace lockstep
