#include "tech_objects/linmot/hardware.hpp"

namespace lockstep::linmot {
namespace {

constexpr SupplyThresholds kLowVoltage{18.24, 21.12, 50.88, 53.76};   // 24 to 48 V, version 2
constexpr SupplyThresholds kHighVoltage{36.48, 42.24, 76.32, 77.93};  // 48 to 72 V, version 2
constexpr SupplyThresholds kThirdPower{36.50, 42.24, 90.23, 92.29};   // 48 to 72 V, version 3
constexpr SupplyThresholds kThirdSignal{18.25, 21.12, 50.86, 53.73};

constexpr Hardware low(std::string_view name, std::uint8_t motors, bool mt, bool profibus) {
  return {name, motors, 2, mt, profibus, true, kLowVoltage, kLowVoltage};
}
constexpr Hardware high(std::string_view name, std::uint8_t motors, bool mt, bool profibus) {
  return {name, motors, 2, mt, profibus, false, kHighVoltage, kLowVoltage};
}
constexpr Hardware third(std::string_view name, std::uint8_t motors, bool mt, bool profibus) {
  return {name, motors, 3, mt, profibus, false, kThirdPower, kThirdSignal};
}

constexpr Hardware kAll[] = {
    low("E100", 1, false, false),      low("E200", 2, false, false),      low("E400", 4, false, false),
    low("E100-MT", 1, true, false),    low("E200-MT", 2, true, false),    low("E400-MT", 4, true, false),
    low("E130-DP", 1, false, true),    low("E230-DP", 2, false, true),    low("E430-DP", 4, false, true),
    high("E1000", 1, false, false),    high("E2000", 2, false, false),    high("E4000", 4, false, false),
    high("E1000-MT", 1, true, false),  high("E2000-MT", 2, true, false),  high("E4000-MT", 4, true, false),
    high("E1030-DP", 1, false, true),  high("E2030-DP", 2, false, true),  high("E4030-DP", 4, false, true),
    third("E1001", 1, false, false),   third("E2001", 2, false, false),   third("E4001", 4, false, false),
    third("E1001-MT", 1, true, false), third("E2001-MT", 2, true, false), third("E4001-MT", 4, true, false),
    third("E2031-DP", 2, false, true), third("E4031-DP", 4, false, true),
};
constexpr Hardware kAny{"", 4, 3, true, true, false, kThirdPower, kThirdSignal};

}  // namespace

std::span<const Hardware> all_hardware() noexcept {
  return kAll;
}
const Hardware& any_hardware() noexcept {
  return kAny;
}
const Hardware* find_hardware(std::string_view name) noexcept {
  for (const Hardware& one : kAll)
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace lockstep::linmot
