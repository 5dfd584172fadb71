#include "tech_objects/axis/faults.hpp"

#include "tech_objects/types/published.hpp"

namespace lockstep {

void DriveFaults::watch(const DriveActual& now) noexcept {
  drive_in_trouble_ = now.trouble;
  data.StatusDrive.Error = now.fault;
  data.StatusDrive.CommunicationOK = !now.silent && !now.fault;
  auto& sensor = data.StatusSensor[encoders_.operative()];
  sensor.Error = now.encoder_failed;
  sensor.CommunicationOK = !now.silent;
  if (now.silent || now.encoder_failed) lose_sensor();
  raise_alarms(now);
}

/// A fault of the drive matters once the axis is, or is to be, enabled.
void DriveFaults::raise_alarms(const DriveActual& now) noexcept {
  const auto sensor = static_cast<std::uint8_t>(encoders_.operative() + 1);
  if (now.silent) return reactions_.raise(alarm::kCommunication, {.sensor = sensor});
  if (now.encoder_failed) reactions_.raise(alarm::kEncoder, {.sensor = sensor});
  if (now.fault && (power.enable || power_state_ != PowerState::off)) reactions_.raise(alarm::kDriveFault);
}

/// Actual values do not count until the alarm has been acknowledged.
void DriveFaults::lose_sensor() noexcept {
  if (encoders_.lost()) return;
  encoders_.lose();
  data.StatusSensor[encoders_.operative()].State = SensorState::not_valid;
  attention.coupling_has_changed();  // axes that follow are told
  if (!encoders_.absolute(encoders_.operative())) homed_ = false;
}

/// The axis goes on from where it was seen last; an absolute encoder knows better.
void DriveFaults::regain_sensor() noexcept {
  data.StatusSensor[encoders_.operative()].State = SensorState::valid;
  encoders_.count(drive_->read().position);
  encoders_.regain(actual_, sensors_.play());
}

void DriveFaults::acknowledge() noexcept {
  const std::uint16_t off = power_state_ == PowerState::on ? kControlOn : kControlOff;
  drive_control_.send(off);
  drive_control_.send(off | bit_mask(stw1::kAcknowledgeFault));
  drive_control_.send(off);
  DriveActual now = drive_->read();
  if (encoders_.several()) sensors_.read(now);
  if (!now.silent && !now.encoder_failed && encoders_.lost()) regain_sensor();
  watch(now);
}

}  // namespace lockstep
