/// The parameters of the drive in which the option sits, as far as the simulated drive has them: what GETVLT
/// reads and SETVLT changes. All others are error 112.
/// @source MCO 305 Design Guide, GETVLT, SETVLT, SYSVAR 28, 30 to 32, 34, 35; the conversion indices are
/// those of the FC 300
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::mco305 {

struct DriveParameter {
  std::int32_t number;  ///< 3-03 as 303
  std::string_view title, unit;
  int decimals;                  ///< that a value has behind its point: 1500.000 1/min is 1500000
  std::int32_t lowest, highest;  ///< as a program sees them
  bool writable;                 ///< by SETVLT
  std::string_view meaning;
};

/// Numbers that the device asks for.
enum DriveParameterNumber : std::int32_t {
  kMaximumReference = 303,
  kSpeedHighLimit = 413,
  kReferencePercent = 1602,
  kDriveStatus = 1603,
  kMainActualValue = 1605,
  kMotorVoltage = 1612,
  kMotorFrequency = 1613,
  kMotorCurrent = 1614,
  kMotorTorque = 1616,
  kMotorSpeed = 1617,
  kDriveInputs = 1660,
  kAnalogInput53 = 1662,
  kAnalogInput54 = 1664,
  kAnalogOutput42 = 1665,
};

std::span<const DriveParameter> drive_parameters() noexcept;
/// nullptr: the simulated drive has no such parameter.
const DriveParameter* find_drive_parameter(std::int32_t number) noexcept;

}  // namespace lockstep::mco305
