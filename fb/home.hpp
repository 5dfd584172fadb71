/// Homing: MC_Home.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Relates the position of the technology object to the machine.
/// @source S7-1500T axis functions, MC_Home
/// @errors 16#800A Mode; 16#8071 not position-controlled; 16#80A1 MC_GearInPos or MC_CamIn active
struct MC_Home final : ExecuteBlock {
  LeadingObject* Axis{};
  LREAL Position{};
  INT Mode{};
  DINT Sensor{};
  LREAL ReferenceMarkPosition{};

  static constexpr std::string_view kName = "MC_Home";
  static constexpr std::string_view kText = "Homes an axis or an external encoder.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Home";
  static constexpr Choice kModes[] = {{0, "direct, absolute: the actual position becomes Position"},
                                      {1, "direct, relative: the actual position is shifted by Position"}};
  static constexpr auto kPins =
      pins(object<&MC_Home::Axis>("Axis", kLeading, "axis or encoder that is homed"), pin::kExecute,
           in<&MC_Home::Position>("Position", Unit::kPosition, kFinite, "home position or shift, by Mode",
                                  {.error = ErrorId::position}),
           in<&MC_Home::Mode>("Mode", Unit::kNone, kAny, "kind of homing",
                              {.error = ErrorId::mode, .choices = kModes}),
           in<&MC_Home::Sensor>("Sensor", Unit::kNone, {0.0, 4.0}, "encoder to adjust; 0: the operative one",
                                {.error = ErrorId::sensor}),
           out<&MC_Home::ReferenceMarkPosition>("ReferenceMarkPosition",
                                                "position assigned to the homing mark", Unit::kPosition),
           pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
