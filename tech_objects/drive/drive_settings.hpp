/// What a project says of a drive and of the machine behind it.
#pragma once

#include <array>

#include "tech_objects/drive/linear_motor_settings.hpp"
#include "tech_objects/drive/machine_plant.hpp"
#include "tech_objects/drive/machine_signals.hpp"

namespace lockstep {

/// What goes wrong at a simulated drive while the BOOL is TRUE; nullptr: nothing ever does.
struct SimulatedFaults {
  const bool* drive = nullptr;          ///< a fault of the drive: it loses its torque
  const bool* encoder = nullptr;        ///< no position any more
  const bool* communication = nullptr;  ///< neither setpoints nor actual values; the drive stops by itself
  const bool* blocked = nullptr;        ///< nothing moves, whatever the torque
};

/// A further encoder of a simulated machine, beside that of the drive.
struct SimulatedSensor {
  bool exists = false;
  double ratio = 1.0;           ///< [u] that it tells per [u] of the machine, not 0
  double resolution = 0.0;      ///< [u] ≥ 0, its increment; 0: none
  bool inverted = false;        ///< it turns the other way round than the machine
  double start_position = 0.0;  ///< [u] what it tells at the beginning, of an absolute one
  const bool* fault = nullptr;  ///< BOOL tag: while TRUE it tells nothing; nullptr: it never fails
};

/// The drive, its encoder, and its machine: the keys of "drive" in a project. A drive takes what concerns it.
struct DriveSettings {
  double time_constant = 0.0;    ///< [s] ≥ 0, of the velocity loop as a first-order lag; 0: follows at once
  double dead_time = 0.0;        ///< [s] 0 … 254 servo cycles, whole or not; more counts as that
  double resolution = 0.0;       ///< [u] ≥ 0, increment of the encoder; 0: reports the position itself
  bool inverted = false;         ///< motor and its encoder turn the other way round than the machine
  MachineSignals signals{};      ///< what stands along its path
  MachinePlantSettings plant{};  ///< what it moves; of no effect without inertia
  double quick_stop = 0.0;       ///< [u/s²] ≥ 0, deceleration of OFF3; 0: as hard as the drive can
  SimulatedFaults faults{};
  double position_cycle = 0.000125;          ///< [s] > 0, of the drive's own position loop (DSC)
  LinearMotorSettings linear_motor{};        ///< of "linear_motor"
  std::array<SimulatedSensor, 3> sensors{};  ///< Sensor[2] to Sensor[4]
};

}  // namespace lockstep
