// What goes wrong at drive and encoder of an axis: alarms, their acknowledgement, and control words.
// @source S7-1500T alarms 411, 421, 431; PROFIdrive state machine
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

// Bits of the control words that an axis does not use itself.
constexpr std::uint16_t kFreeBits1 = 0xFB00;
constexpr std::uint16_t kFreeBits2 = 0x0FFF;

}  // namespace

/// Each servo cycle in which the drive reports something wrong, and the one in which that ends.
void AxisOrders::watch_drive(const DriveActual& now) noexcept {
  drive_in_trouble_ = now.trouble;
  data.StatusDrive.Error = now.fault;
  data.StatusDrive.CommunicationOK = !now.silent && !now.fault;
  auto& sensor = data.StatusSensor[encoders_.operative()];
  sensor.Error = now.encoder_failed;
  sensor.CommunicationOK = !now.silent;
  if (now.silent || now.encoder_failed) lose_sensor();
  raise_drive_alarms(now);
}

/// A fault of the drive matters once the axis is, or is to be, enabled.
void AxisOrders::raise_drive_alarms(const DriveActual& now) noexcept {
  if (now.silent) return raise(alarm::kCommunication);
  if (now.encoder_failed) raise(alarm::kEncoder);
  if (now.fault && (power.enable || power_state_ != PowerState::off)) raise(alarm::kDriveFault);
}

/// Actual values do not count until the alarm has been acknowledged.
void AxisOrders::lose_sensor() noexcept {
  if (encoders_.lost()) return;
  encoders_.lose();
  data.StatusSensor[encoders_.operative()].State = SensorState::not_valid;
  coupling_changed = true;  // axes that follow are told
  if (!encoders_.absolute(encoders_.operative())) homed_ = false;
}

/// The axis goes on from where it was seen last; an absolute encoder knows better.
void AxisOrders::regain_sensor() noexcept {
  data.StatusSensor[encoders_.operative()].State = SensorState::valid;
  encoders_.count(drive_->read().position);
  encoders_.regain(actual_, play());
}

/// MC_Reset at the drive. What is still wrong is told again at once.
void AxisOrders::acknowledge_drive() noexcept {
  const std::uint16_t off = power_state_ == PowerState::on ? kControlOn : kControlOff;
  control_drive(off);
  control_drive(off | bit_mask(stw1::kAcknowledgeFault));
  control_drive(off);
  DriveActual now = drive_->read();
  if (encoders_.several()) read_encoders(now);
  if (!now.silent && !now.encoder_failed && encoders_.lost()) regain_sensor();
  watch_drive(now);
}

void AxisOrders::control_drive(std::uint16_t stw1) noexcept {
  const std::uint16_t free = free_bits_.stw1;
  drive_->control(static_cast<std::uint16_t>(stw1 | free), free_bits_.stw2);
  sent_stw1_ = stw1;
}

ErrorId Axis::set_control_bits(const ControlBitsJob& job) noexcept {
  const auto mask1 = static_cast<std::uint16_t>(job.stw1_mask);
  const auto mask2 = static_cast<std::uint16_t>(job.stw2_mask);
  if ((mask1 & ~kFreeBits1) != 0 || (mask2 & ~kFreeBits2) != 0) return ErrorId::control_bits;
  if (!has_drive_) return ErrorId::unspecified;
  const auto changed = [](std::uint16_t word, WORD bits, std::uint16_t mask) {
    return static_cast<std::uint16_t>((word & ~mask) | (static_cast<std::uint16_t>(bits) & mask));
  };
  free_bits_.stw1 = changed(free_bits_.stw1, job.stw1, mask1);
  free_bits_.stw2 = changed(free_bits_.stw2, job.stw2, mask2);
  control_drive(sent_stw1_);
  return ErrorId::none;
}

}  // namespace lockstep
