/// Homing: MC_Home.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Relates the position of the technology object to the machine.
/// @source S7-1500T axis functions, MC_Home
/// @errors 16#8001 a technology alarm is pending or comes; 16#8009 Position; 16#800A Mode; 16#800F not
/// enabled, MC_Stop active, or passive homing while active homing runs; 16#8010, 16#8011 Mode does not fit
/// the encoder; 16#8016, 16#8050 Sensor; 16#8071 not position-controlled; 16#80A1 MC_GearInPos or MC_CamIn
/// active
struct MC_Home final : ExecuteBlock {
  LeadingObject* Axis{};
  LREAL Position{};
  INT Mode{};
  DINT Sensor{};
  LREAL ReferenceMarkPosition{};

  static constexpr std::string_view kName = "MC_Home";
  static constexpr std::string_view kText = "Homes an axis or an external encoder.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_Home";
  static constexpr Choice kModes[] = {
      {0, "direct, absolute: the actual position becomes Position"},
      {1, "direct, relative: the actual position is shifted by Position"},
      {2, "passive: the next mark gets Position; HomingDone stays until then"},
      {3, "active: the axis moves to the mark, and then to the home position, Position"},
      {5, "active, with Homing.HomePosition as the home position"},
      {6, "absolute encoder adjustment, relative: shifted by Position, the offset is kept"},
      {7, "absolute encoder adjustment, absolute: the actual position becomes Position, the offset is kept"},
      {8, "passive: the next mark gets Position; HomingDone falls at the start"},
      {9, "ends a passive homing"},
      {10, "passive: the next mark gets Homing.HomePosition"},
      {11, "the setpoint becomes Position, the following error stays"},
      {12, "the setpoint is shifted by Position, the following error stays"},
      {13, "incremental encoder adjustment: the position of the encoder becomes Position"}};
  static constexpr auto kPins =
      pins(object<&MC_Home::Axis>("Axis", kPositioned, "axis or encoder that is homed"), pin::kExecute,
           in<&MC_Home::Position>("Position", Unit::kPosition, kFinite, "home position or shift, by Mode",
                                  {.error = ErrorId::position}),
           in<&MC_Home::Mode>("Mode", Unit::kNone, kAny, "kind of homing",
                              {.error = ErrorId::mode, .choices = kModes}),
           in<&MC_Home::Sensor>("Sensor", Unit::kNone, {0.0, 4.0},
                                "encoder to adjust with modes 6, 7, 13; 0: the operative one",
                                {.error = ErrorId::sensor}),
           out<&MC_Home::ReferenceMarkPosition>(
               "ReferenceMarkPosition", "position assigned to the homing mark, with Done", Unit::kPosition),
           pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
  void show(JobPhase phase) noexcept override;
};

}  // namespace lockstep
