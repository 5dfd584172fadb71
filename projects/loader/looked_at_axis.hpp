/// An axis of a project that is loaded to be looked at.
#pragma once

#include <utility>

#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// What a project says of an axis, without what would move it: a tenth of its memory. It stands for the axis
/// where names lead to it and others refer to it, and never ticks.
class LookedAtAxis final : public ConfiguredAxis {
 public:
  using ConfiguredAxis::ConfiguredAxis;

  /// Takes over what has been loaded into an axis of the same name.
  void take(Axis& axis) {
    data = axis.data;
    leading_values = std::move(axis.leading_values);
  }

  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &data; }
  void configure(double /*servo_period*/, int /*ratio*/) override {}
  AxisPosition actual_position() const noexcept override { return {}; }
  bool measured_in_servo() const noexcept override { return false; }
  DoubleDouble measured_line() const noexcept override { return {}; }
  bool leading_value_stands() const noexcept override { return true; }
};

}  // namespace lockstep
