/// The bits of the status, error and warning words by their published names.
/// @source S7-1500T synchronous operation V7, 13.1.34 to 13.1.42
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Names of the bits X0 to X31 of a word; empty where reserved.
using BitNames = std::array<std::string_view, 32>;

/// Bits of `StatusSynchronizedMotion.StatusWord`.
enum class SynchronizedMotionBit : std::uint8_t {
  MaxVelocityExceeded = 0,      ///< the configured maximum velocity is exceeded in synchronous operation
  MaxAccelerationExceeded = 1,  ///< the configured maximum acceleration is exceeded in synchronous operation
  MaxDecelerationExceeded = 2,  ///< the configured maximum deceleration is exceeded in synchronous operation
  InSimulation = 3,             ///< simulation of synchronous operation
  LeadingValueAdditiveCommand = 4,  ///< additive leading value via MC_LeadingValueAdditive
};

inline constexpr BitNames kSynchronizedMotionBitNames = {"MaxVelocityExceeded",
                                                         "MaxAccelerationExceeded",
                                                         "MaxDecelerationExceeded",
                                                         "InSimulation",
                                                         "LeadingValueAdditiveCommand",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         "",
                                                         ""};

/// Bits of `StatusKinematicsMotion`.
enum class KinematicsMotionBit : std::uint8_t {
  MaxVelocityExceeded =
      0,  ///< velocity setpoint computed by the kinematics TO versus maximum velocity at the axis
  MaxAccelerationExceeded =
      1,  ///< acceleration setpoint computed by the kinematics TO versus maximum acceleration of the axis
  MaxDecelerationExceeded =
      2,  ///< deceleration setpoint computed by the kinematics TO versus maximum deceleration of the axis
};

inline constexpr BitNames kKinematicsMotionBitNames = {"MaxVelocityExceeded",
                                                       "MaxAccelerationExceeded",
                                                       "MaxDecelerationExceeded",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       "",
                                                       ""};

/// Bits of `StatusMotionIn.StatusWord`.
enum class MotionInBit : std::uint8_t {
  MaxVelocityExceeded = 0,  ///< the configured maximum velocity is exceeded during a MotionIn motion
};

inline constexpr BitNames kMotionInBitNames = {"MaxVelocityExceeded",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               "",
                                               ""};

/// Bits of `StatusWord`.
enum class StatusBit : std::uint8_t {
  Enable = 0,         ///< enable status: the technology object is enabled
  Error = 1,          ///< an error is present
  RestartActive = 2,  ///< a restart is active; the technology object is being reinitialised
  OnlineStartValuesChanged =
      3,  ///< restart variables were changed; the TO must be reinitialised to take over the changes
  ControlPanelActive = 4,  ///< the axis control panel is activated
  HomingDone = 5,          ///< homing status: the technology object is homed
  Done = 6,                ///< no motion job is being processed and the axis control panel is deactivated
  Standstill = 7,          ///< standstill signal: the axis is at standstill
  PositioningCommand = 8,  ///< a positioning job is active (MC_MoveRelative, MC_MoveAbsolute)
  JogCommand = 9,          ///< an MC_MoveJog job is active
  VelocityCommand = 10,    ///< an MC_MoveVelocity job is active
  HomingCommand = 11,      ///< an MC_Home job is being processed
  ConstantVelocity = 12,   ///< setpoint velocity reached; a constant setpoint velocity is output
  Accelerating = 13,       ///< an acceleration process is active
  Decelerating = 14,       ///< a deceleration process is active
  SWLimitMinActive = 15,   ///< a negative software limit switch was approached or overrun
  SWLimitMaxActive = 16,   ///< a positive software limit switch was approached or overrun
  HWLimitMinActive = 17,   ///< a negative hardware limit switch was approached or overrun
  HWLimitMaxActive = 18,   ///< a positive hardware limit switch was approached or overrun
  Synchronizing = 21,      ///< the axis is synchronising to a leading value
  Synchronous = 22,        ///< the axis travels synchronously to a leading value
  MoveSuperimposedCommand = 23,  ///< an MC_MoveSuperimposed job is active
  PhasingCommand =
      24,  ///< an MC_PhasingAbsolute or MC_PhasingRelative job for offsetting the leading value is active
  AxisSimulation = 25,         ///< the technology object is in simulation
  TorqueLimitingCommand = 26,  ///< an MC_TorqueLimiting job is active
  InLimitation = 27,  ///< the drive works at least at the threshold (default 90 %) of the torque/force limit
  NonPositionControlled = 28,    ///< the axis is in non-position-controlled operation
  KinematicsMotionCommand = 29,  ///< the axis is used for a kinematics job
  InClamping = 30,               ///< the axis is clamped at a fixed stop
  MotionInCommand = 31,          ///< a MotionIn job is active
};

inline constexpr BitNames kStatusBitNames = {"Enable",
                                             "Error",
                                             "RestartActive",
                                             "OnlineStartValuesChanged",
                                             "ControlPanelActive",
                                             "HomingDone",
                                             "Done",
                                             "Standstill",
                                             "PositioningCommand",
                                             "JogCommand",
                                             "VelocityCommand",
                                             "HomingCommand",
                                             "ConstantVelocity",
                                             "Accelerating",
                                             "Decelerating",
                                             "SWLimitMinActive",
                                             "SWLimitMaxActive",
                                             "HWLimitMinActive",
                                             "HWLimitMaxActive",
                                             "",
                                             "",
                                             "Synchronizing",
                                             "Synchronous",
                                             "MoveSuperimposedCommand",
                                             "PhasingCommand",
                                             "AxisSimulation",
                                             "TorqueLimitingCommand",
                                             "InLimitation",
                                             "NonPositionControlled",
                                             "KinematicsMotionCommand",
                                             "InClamping",
                                             "MotionInCommand"};

/// Bits of `StatusWord2`.
enum class Status2Bit : std::uint8_t {
  StopCommand = 0,  ///< an MC_Stop job is active; the technology object is locked
  DesynchronizingCommand =
      1,  ///< an MC_GearOut or MC_CamOut job is active; the following axis is being desynchronised
  PassingBacklash =
      2,  ///< the backlash is being travelled out; <TO>.ActualPosition does not change meanwhile
  PhasingCommandWaiting =
      3,  ///< an MC_PhasingAbsolute or MC_PhasingRelative job for offsetting the leading value is waiting
  OffsetCommand =
      4,  ///< an MC_OffsetAbsolute or MC_OffsetRelative job for offsetting the following value is active
  OffsetCommandWaiting =
      5,  ///< an MC_OffsetAbsolute or MC_OffsetRelative job for offsetting the following value is waiting
  MotionInSuperimposedCommand = 6,  ///< an MC_MotionInSuperimposed job is active
  HaltSuperimposedCommand = 7,      ///< an MC_HaltSuperimposed job is active
};

inline constexpr BitNames kStatus2BitNames = {"StopCommand",
                                              "DesynchronizingCommand",
                                              "PassingBacklash",
                                              "PhasingCommandWaiting",
                                              "OffsetCommand",
                                              "OffsetCommandWaiting",
                                              "MotionInSuperimposedCommand",
                                              "HaltSuperimposedCommand",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              ""};

/// Bits of `ErrorWord`.
enum class ErrorBit : std::uint8_t {
  SystemFault = 0,  ///< a system-internal error occurred
  ConfigFault =
      1,  ///< configuration error: one or more configuration parameters are inconsistent or inadmissible
  UserFault = 2,             ///< error in the user program at a Motion Control instruction or in its use
  CommandNotAccepted = 3,    ///< job not executable: a Motion Control instruction cannot be executed because
                             ///< necessary preconditions are not met
  DriveFault = 4,            ///< error in the drive
  SensorFault = 5,           ///< error in the encoder system
  DynamicError = 6,          ///< specified dynamic values are limited to admissible values
  CommunicationFault = 7,    ///< communication error: communication missing or faulty
  SWLimit = 8,               ///< software limit switch approached or overrun
  HWLimit = 9,               ///< hardware limit switch approached or overrun
  HomingError = 10,          ///< error during homing; homing cannot be completed
  FollowingErrorFault = 11,  ///< following-error limits exceeded
  PositioningFault = 12,     ///< positioning error
  PeripheralError = 13,      ///< error when accessing a logical address
  SynchronousError = 14,  ///< error in synchronous operation: the leading axis given at the instruction was
                          ///< not configured as a possible leading axis
  AdaptionError = 15,     ///< error in automatic data transfer
};

inline constexpr BitNames kErrorBitNames = {"SystemFault",
                                            "ConfigFault",
                                            "UserFault",
                                            "CommandNotAccepted",
                                            "DriveFault",
                                            "SensorFault",
                                            "DynamicError",
                                            "CommunicationFault",
                                            "SWLimit",
                                            "HWLimit",
                                            "HomingError",
                                            "FollowingErrorFault",
                                            "PositioningFault",
                                            "PeripheralError",
                                            "SynchronousError",
                                            "AdaptionError",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            "",
                                            ""};

/// Bits of `WarningWord`.
enum class WarningBit : std::uint8_t {
  SystemWarning = 0,  ///< a system-internal error occurred
  ConfigWarning = 1,  ///< configuration error: one or more configuration parameters are adapted internally
  UserWarning = 2,    ///< error in the user program at a Motion Control instruction or in its use
  CommandNotAccepted = 3,  ///< job not executable: a Motion Control instruction cannot be executed because
                           ///< necessary preconditions are not met
  DriveWarning = 4,    ///< warning of the drive; not set for drive warnings that do not lead to a TO alarm -
                       ///< evaluate those directly in the drive status word
  SensorWarning = 5,   ///< error in the encoder system
  DynamicWarning = 6,  ///< specified dynamic values are limited to admissible values
  CommunicationWarning = 7,    ///< communication error: communication missing or faulty
  SWLimitMin = 8,              ///< the negative software limit switch was approached
  SWLimitMax = 9,              ///< the positive software limit switch was approached
  HomingWarning = 10,          ///< error during homing; homing cannot be completed
  FollowingErrorWarning = 11,  ///< warning level of following-error monitoring reached or exceeded
  PositioningWarning = 12,     ///< positioning error
  PeripheralWarning = 13,      ///< error when accessing a logical address
  SynchronousWarning = 14,  ///< error in synchronous operation: the leading axis given at the instruction was
                            ///< not configured as a possible leading axis
  AdaptionWarning = 15,     ///< error in automatic data transfer
};

inline constexpr BitNames kWarningBitNames = {"SystemWarning",
                                              "ConfigWarning",
                                              "UserWarning",
                                              "CommandNotAccepted",
                                              "DriveWarning",
                                              "SensorWarning",
                                              "DynamicWarning",
                                              "CommunicationWarning",
                                              "SWLimitMin",
                                              "SWLimitMax",
                                              "HomingWarning",
                                              "FollowingErrorWarning",
                                              "PositioningWarning",
                                              "PeripheralWarning",
                                              "SynchronousWarning",
                                              "AdaptionWarning",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              "",
                                              ""};

/// Sets or clears one bit of a word.
template <class Bit>
constexpr void set_bit(DWORD& word, Bit bit, bool value) noexcept {
  const std::uint32_t mask = std::uint32_t{1} << static_cast<unsigned>(bit);
  const auto bits = static_cast<std::uint32_t>(word);
  word = static_cast<DWORD>(value ? bits | mask : bits & ~mask);
}

/// Whether one bit of a word is set.
template <class Bit>
constexpr bool has_bit(DWORD word, Bit bit) noexcept {
  return ((static_cast<std::uint32_t>(word) >> static_cast<unsigned>(bit)) & 1u) != 0;
}

}  // namespace lockstep
