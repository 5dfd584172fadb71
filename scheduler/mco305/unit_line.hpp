/// A position in the user units of a device, as axes see it that follow it.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/mco305/units.hpp"

namespace lockstep {

/// On a line that goes on where it is when the unit changes: what follows the device does not step.
/// Thread: the cycle.
class UnitLine {
 public:
  /// @param counts where the device has been when the unit was taken [qc]
  void take(const mco305::UserUnit& unit, DoubleDouble counts) noexcept {
    begin_ = at(counts);
    counts_ = counts;
    unit_ = unit;
  }
  const mco305::UserUnit& unit() const noexcept { return unit_; }
  DoubleDouble at(DoubleDouble counts) const noexcept {
    return begin_ + (counts - counts_) * static_cast<double>(unit_.sign * unit_.denominator) /
                        static_cast<double>(unit_.numerator);
  }
  /// So many counts as a distance [u].
  double distance(double counts) const noexcept {
    return static_cast<double>(unit_.sign) * counts * static_cast<double>(unit_.denominator) /
           static_cast<double>(unit_.numerator);
  }

 private:
  mco305::UserUnit unit_{};
  DoubleDouble begin_{}, counts_{};  // [u], [qc]
};

}  // namespace lockstep
