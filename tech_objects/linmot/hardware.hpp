/// What depends on which controller it is.
/// @source LinMot release 1.3 addendum, 6.2 (tables 6-2, 6-3), appendix A
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::linmot {

/// [V] Beyond the inner ones a warning, beyond the outer ones an error.
struct SupplyThresholds {
  double low_error, low_warning, high_warning, high_error;
};

struct Hardware {
  std::string_view name;
  std::uint8_t motors;
  std::uint8_t version;
  bool mt, profibus;
  bool range_switch;  ///< 2 or 3 A
  SupplyThresholds power, signal;
};

/// Every one, by name, with its suffix.
std::span<const Hardware> all_hardware() noexcept;
/// Where none is named: all functions, thresholds of version 3.
const Hardware& any_hardware() noexcept;
const Hardware* find_hardware(std::string_view name) noexcept;

}  // namespace lockstep::linmot
