/// What a test may know of the simulated machine, and the axis may not.
#pragma once

#include "tech_objects/axis/axis.hpp"
#include "tech_objects/drive/simulated_drive.hpp"

namespace lockstep::test {

/// The drive of an axis whose model is "simulated", once it has been configured.
inline const SimulatedDrive& simulated_drive(const Axis& axis) {
  return static_cast<const SimulatedDrive&>(axis.drive());
}

}  // namespace lockstep::test
