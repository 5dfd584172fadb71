/// What a project says of a linear motor: its force, its position loop, and what it moves.
#pragma once

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/drive/linear_motor_plant.hpp"

namespace lockstep {

struct LinearMotorSettings {
  double force_constant = 1.0;    ///< [N/A] > 0
  double control_cycle = 0.0001;  ///< [s] > 0, of the position loop; 1 to 256 of them are a servo cycle
  bool brake = false;             ///< without current a brake holds the motor once it rests
  CurrentLoopSettings loop{};
  LinearMotorPlantSettings plant{};
};

}  // namespace lockstep
