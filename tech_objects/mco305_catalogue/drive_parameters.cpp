#include "tech_objects/mco305_catalogue/drive_parameters.hpp"

namespace lockstep::mco305 {
namespace {

constexpr std::int32_t kNoBound = 2'000'000'000;

constexpr DriveParameter kDriveParameters[] = {
    {kMaximumReference, "Maximum reference", "1/min", 3, 1, kNoBound, true,
     "speed at the full reference of the position controller; VELMAX until it is set"},
    {kSpeedHighLimit, "Motor speed high limit", "1/min", 0, 0, 60'000, true,
     "no reference makes the motor faster"},
    {kReferencePercent, "Reference", "%", 1, -kNoBound, kNoBound, false,
     "that the drive gets, of its maximum reference"},
    {kDriveStatus, "Status word", "", 0, 0, 65'535, false,
     "bits 0 to 2, 9, 11: it follows its reference; bit 3: it has a fault. The bits are not in the sources"},
    {kMainActualValue, "Main actual value", "%", 2, -kNoBound, kNoBound, false,
     "speed of the motor, of the maximum reference"},
    {kMotorVoltage, "Motor voltage", "V", 1, 0, 4000, false,
     "of a motor of 400 V at 50 Hz, in proportion to the frequency. The motor is not in the sources"},
    {kMotorFrequency, "Frequency", "Hz", 1, 0, kNoBound, false,
     "of a motor of four poles without slip. The motor is not in the sources"},
    {kMotorCurrent, "Motor current", "A", 2, 0, kNoBound, false,
     "1 A that magnetizes it, and across to that 0.3 A/Nm. The motor is not in the sources"},
    {kMotorTorque, "Torque", "Nm", 1, -kNoBound, kNoBound, false,
     "of the motor, where the machine is simulated with its inertia"},
    {kMotorSpeed, "Speed", "1/min", 0, -kNoBound, kNoBound, false, "of the motor"},
    {kDriveInputs, "Digital inputs", "", 0, 0, 63, false, "18, 19, 27, 29, 32, 33; 33 is the lowest bit"},
    {kAnalogInput53, "Analog input 53", "V", 3, -10'000, 10'000, false, "as INAD reads it"},
    {kAnalogInput54, "Analog input 54", "V", 3, -10'000, 10'000, false, "as INAD reads it"},
    {kAnalogOutput42, "Analog output 42", "mA", 3, 0, 20'000, false, "as OUTDA has set it"},
};

}  // namespace

std::span<const DriveParameter> drive_parameters() noexcept {
  return kDriveParameters;
}

const DriveParameter* find_drive_parameter(std::int32_t number) noexcept {
  for (const DriveParameter& one : kDriveParameters)
    if (one.number == number) return &one;
  return nullptr;
}

}  // namespace lockstep::mco305
