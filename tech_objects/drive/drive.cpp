#include "tech_objects/drive/drive.hpp"

#include <algorithm>

namespace lockstep {
namespace {

const MachineSignals kNone;

}  // namespace

void Drive::write_position(const PositionCommand& command) noexcept {
  write(std::clamp(command.velocity + command.kpc * command.xerr, -command.maximum, command.maximum));
}

SensorActual Drive::read_sensor(std::size_t /*sensor*/) noexcept {
  return {};
}

void Drive::command_torque(const TorqueCommand& /*command*/) noexcept {}

const MachineSignals& Drive::signals() const noexcept {
  return kNone;
}

}  // namespace lockstep
