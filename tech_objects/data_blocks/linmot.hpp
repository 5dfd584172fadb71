/// What others see of a LinMot controller: states, motors, process image, parameters. `linmot.cpp` declares
/// it.
#pragma once

#include <array>

#include "tech_objects/linmot_catalogue/parameters.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct LinMotMotorData {
  LREAL DemandPosition{}, SetPoint{}, SetPointVelocity{};  ///< [mm], [mm], [m/s]
  LREAL ActualPosition{}, ActualVelocity{};                ///< [mm], [m/s]
  LREAL FollowingError{}, DemandCurrent{};                 ///< [mm], [A]
  BOOL InPosition{}, PosRange{}, CurveActive{}, InitDone{}, Frozen{};
  WORD Errors{}, Warnings{};
  linmot::MotorParameters Parameters{};
};

/// The whole data block of a LinMot controller.
struct LinMotData {
  static constexpr std::size_t kWords = 64;  ///< of the process image, in each direction

  DINT State{}, StateNumber = -1, Code{};
  WORD Display{}, Errors{}, Warnings{}, LoggedWarnings{};
  std::array<WORD, kWords> ProfibusOut{}, ProfibusIn{};
  std::array<BYTE, 2 * kWords> ProfibusOutByte{}, ProfibusInByte{};
  linmot::SystemParameters Parameters{};
  std::array<LinMotMotorData, linmot::kMotors> Motors{};
};

}  // namespace lockstep
