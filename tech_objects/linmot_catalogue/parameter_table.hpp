/// The table of the parameters. Included by `parameters.cpp` only.
#pragma once

#include "tech_objects/linmot_catalogue/parameter.hpp"

namespace lockstep::linmot {

constexpr Parameter parameter_row(std::string_view path, Scope scope, Kind kind, std::string_view unit,
                                  Range range, std::span<const std::string_view> options, int flags,
                                  std::size_t offset, std::string_view text) {
  return {path, scope, kind, unit, range, options, static_cast<std::uint8_t>(flags), offset, text};
}

inline constexpr std::string_view kCommandInterfaceOptions[] = {"AT",          "MT",          "ASCII RS232",
                                                                "ASCII RS485", "Application", "PROFIBUS"};
inline constexpr std::string_view kMotorTypeOptions[] = {"No Drive",
                                                         "LinMot P0x-23",
                                                         "LinMot P0x-23F",
                                                         "LinMot P0x-37",
                                                         "LinMot P0x-37 PL19",
                                                         "LinMot P0x-37-HP",
                                                         "LinMot P0x-37-HP PL19",
                                                         "LinMot P0x-37F",
                                                         "LinMot P0x-37F PL19",
                                                         "LinMot P0x-48",
                                                         "LinMot P0x-48 PL27",
                                                         "Stepper",
                                                         "Magnet",
                                                         "Sin/Cos Position Sensor"};
inline constexpr std::string_view kMasterBoosterOptions[] = {"Master", "Booster parallel", "Booster reverse",
                                                             "Gantry Slave parallel"};
inline constexpr std::string_view kPositionSensorOptions[] = {
    "Internal Sensor", "Internal Sensor 40um", "External 20um", "External 10um", "External 5um",
    "External 2.5um",  "External 1.25um",      "AB Enc1 1X",    "AB Enc1 2X",    "AB Enc1 4X",
    "AB Enc2 1X",      "AB Enc2 2X",           "AB Enc2 4X"};
inline constexpr std::string_view kInitModeOptions[] = {"Actual Position", "Auto Move Out", "Auto Move In",
                                                        "Trig Move Out", "Trig Move In"};
inline constexpr std::string_view kRunModeOptions[] = {"Serial", "Analog", "Continuous Curve",
                                                       "Trigger Curve", "Two Point"};
inline constexpr std::string_view kCommutationOptions[] = {"Sine", "Trapezoid", "Block"};
inline constexpr std::string_view kEmergencyStopModeOptions[] = {"Off", "Freeze", "Goto Position"};
inline constexpr std::string_view kStepperMasterBoosterOptions[] = {"Master"};
inline constexpr std::string_view kStepperInitModeOptions[] = {"Actual Position", "Trig Turn Left",
                                                               "Trig Turn Right"};
inline constexpr std::string_view kStepperCommutationOptions[] = {"Auto", "Micro Step", "Half Step",
                                                                  "Full Step"};
inline constexpr std::string_view kMagnetEmergencyStopModeOptions[] = {"Off", "Freeze", "Set Current"};
inline constexpr std::string_view kSensorPeriodOptions[] = {"1 mm", "5 mm"};
inline constexpr std::string_view kSensorDirectionOptions[] = {"Positive", "Negative"};
inline constexpr std::string_view kOutput3Options[] = {"None",       "In Pos A",       "In Pos B",
                                                       "In Pos C",   "In Pos D",       "In Pos A*B",
                                                       "In Pos C*D", "In Pos A*B*C*D", "Pos Range"};
inline constexpr std::string_view kOutput4Options[] = {
    "None", "In Pos A", "In Pos B", "In Pos C", "In Pos D", "In Pos A*B", "In Pos C*D", "In Pos A*B*C*D"};
inline constexpr std::string_view kDiagnosePriorityOptions[] = {"None", "Low", "High"};
inline constexpr std::string_view kInterfaceCardTypeOptions[] = {"None", "DI01-08/08", "ME01-01/08",
                                                                 "ME01-02/08"};

inline constexpr Parameter kSystemTable[] = {
    parameter_row("System\\Info\\Hardware\\Device\\Type", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "controller model identification"),
    parameter_row("System\\Info\\Hardware\\Device\\Serial No High", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "upper three digits of the serial number"),
    parameter_row("System\\Info\\Hardware\\Device\\Serial No Low", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "lower three digits of the serial number"),
    parameter_row("System\\Info\\Hardware\\Device\\Serial Number", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "serial number as a string"),
    parameter_row("System\\Info\\Hardware\\Device\\Article Number", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "article number as a string"),
    parameter_row("System\\Info\\Hardware\\Memory\\Flash Type", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "kind of Flash memory fitted on the controller"),
    parameter_row("System\\Info\\Hardware\\Memory\\EEPROM Type", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "kind of EEPROM memory fitted on the controller"),
    parameter_row("System\\Info\\Hardware\\Memory\\RAM Type", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "kind of RAM memory fitted on the controller"),
    parameter_row("System\\Info\\Software\\Release", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "software release"),
    parameter_row("System\\Info\\Software\\Monitor", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "version of the monitor program"),
    parameter_row("System\\Info\\Software\\Base", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "version of the base software"),
    parameter_row("System\\Info\\Software\\Application", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "version of the application software"),
    parameter_row("System\\Info\\Software\\Application 2", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere, "version of the second application software"),
    parameter_row("System\\Info\\Software\\Tree Type", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "kind of parameter tree"),
    parameter_row("System\\Info\\Software\\Tree Version", Scope::system, Kind::shown, "", kAny, {}, kReadOnly,
                  kNowhere, "version of the parameter tree"),
    parameter_row(
        "System\\Info\\ID Switch Position", Scope::system, Kind::shown, "", kAny, {}, kLive, kNowhere,
        "shows the setting of the two hexadecimal rotary switches (front of DP and version 3 controllers, "
        "otherwise underside). Bus interfaces take their address from it"),
    parameter_row("System\\Passwords\\User", Scope::system, Kind::shown, "", kAny, {}, 0, kNowhere,
                  "current user password; can only be changed here"),
    parameter_row(
        "System\\Error Handling\\Error Mask\\DCLV Power Too Low", Scope::system, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(SystemParameters, error_mask_dclv_power_too_low),
        "power-stage supply voltage below the error limit. Selected entry sends the controller to ERROR and "
        "removes drive from all motors"),
    parameter_row(
        "System\\Error Handling\\Error Mask\\DCLV Power Too High", Scope::system, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(SystemParameters, error_mask_dclv_power_too_high),
        "power-stage supply voltage above the error limit. Selected entry sends the controller to ERROR and "
        "removes drive from all motors"),
    parameter_row(
        "System\\Error Handling\\Error Mask\\DCLV Signal Too Low", Scope::system, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(SystemParameters, error_mask_dclv_signal_too_low),
        "signal/logic supply voltage below the error limit. Selected entry sends the controller to ERROR and "
        "removes drive from all motors"),
    parameter_row(
        "System\\Error Handling\\Error Mask\\DCLV Signal Too High", Scope::system, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(SystemParameters, error_mask_dclv_signal_too_high),
        "signal/logic supply voltage above the error limit. Selected entry sends the controller to ERROR and "
        "removes drive from all motors"),
    parameter_row("System\\Error Handling\\Error Mask\\Electronic Fault", Scope::system, Kind::on_off, "",
                  kAny, {}, kReadOnly, offsetof(SystemParameters, error_mask_electronic_fault),
                  "heat sink above 70 degrees C, or short circuit on a motor phase. Selected entry sends the "
                  "controller "
                  "to ERROR and removes drive from all motors"),
    parameter_row("System\\Error Handling\\Warn Mask\\DCLV Power Low", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, warn_mask_dclv_power_low),
                  "power supply low. Selected entry raises a warning (WARNING OUT); operation continues"),
    parameter_row("System\\Error Handling\\Warn Mask\\DCLV Power High", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, warn_mask_dclv_power_high),
                  "power supply high. Selected entry raises a warning (WARNING OUT); operation continues"),
    parameter_row("System\\Error Handling\\Warn Mask\\DCLV Signal Low", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, warn_mask_dclv_signal_low),
                  "signal supply low. Selected entry raises a warning (WARNING OUT); operation continues"),
    parameter_row("System\\Error Handling\\Warn Mask\\DCLV Signal High", Scope::system, Kind::on_off, "",
                  kAny, {}, 0, offsetof(SystemParameters, warn_mask_dclv_signal_high),
                  "signal supply high. Selected entry raises a warning (WARNING OUT); operation continues"),
    parameter_row(
        "System\\Error Handling\\Warn Mask\\Electronic Fault", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, warn_mask_electronic_fault),
        "heat sink over 70 degrees C or motor-phase short circuit; after 5 s the temperature case becomes "
        "the "
        "error of the same name. Selected entry raises a warning (WARNING OUT); operation continues"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\DCLV Power Too Low", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_dclv_power_too_low),
        "power-stage supply voltage below the error limit. If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\DCLV Power Too High", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_dclv_power_too_high),
        "power-stage supply voltage above the error limit. If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\DCLV Signal Too Low", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_dclv_signal_too_low),
        "signal/logic supply voltage below the error limit. If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\DCLV Signal Too High", Scope::system, Kind::on_off, "", kAny, {},
        0, offsetof(SystemParameters, msg_mask_dclv_signal_too_high),
        "signal/logic supply voltage above the error limit. If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Electronic Fault", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_electronic_fault),
        "heat sink above 70 degrees C, or short circuit on a motor phase. If selected, this condition makes "
        "the MSG output active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Drive Type Mismatch", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_drive_type_mismatch),
        "connected actuator differs from the configured type. If selected, this condition makes the MSG "
        "output active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Curve Error", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_curve_error),
        "motion profile not found or not made for the configured actuator type. If selected, this condition "
        "makes the MSG output active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Slider Missing", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_slider_missing),
        "slider absent or motor not connected correctly. If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Init Failed", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, msg_mask_init_failed),
        "initialisation could not be completed. If selected, this condition makes the MSG output active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Drive Following Error", Scope::system, Kind::on_off, "", kAny, {},
        0, offsetof(SystemParameters, msg_mask_drive_following_error),
        "following error too large (limits set per motor). If selected, this condition makes the MSG output "
        "active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Drive Too Hot Calculated", Scope::system, Kind::on_off, "", kAny,
        {}, 0, offsetof(SystemParameters, msg_mask_drive_too_hot_calculated),
        "short-time overload from the calculated thermal model (blocked or overloaded motor: load mass too "
        "big, profile too fast). Deselecting it may leave a short overload undetected and damage the motor. "
        "If selected, this condition makes the MSG output active"),
    parameter_row(
        "System\\Error Handling\\Msg Mask\\Drive Too Hot Sensor", Scope::system, Kind::on_off, "", kAny, {},
        0, offsetof(SystemParameters, msg_mask_drive_too_hot_sensor),
        "motor too warm by sensor: overloaded and/or badly cooled. If selected, this condition makes the MSG "
        "output active"),
    parameter_row("System\\Error Handling\\Msg Mask\\In Position", Scope::system, Kind::on_off, "", kAny, {},
                  0, offsetof(SystemParameters, msg_mask_in_position),
                  "if selected, reaching the demand position can drive the MSG output (also needs IO "
                  "Configuration\\Msg "
                  "Output on)"),
    parameter_row("System\\Error Handling\\Logging Mask\\DCLV Power Too Low", Scope::system, Kind::on_off, "",
                  kAny, {}, 0, kNowhere,
                  "power-stage supply voltage below the error limit. If selected, the event is stored in the "
                  "controller's error log, which survives a power failure"),
    parameter_row("System\\Error Handling\\Logging Mask\\DCLV Power Too High", Scope::system, Kind::on_off,
                  "", kAny, {}, 0, kNowhere,
                  "power-stage supply voltage above the error limit. If selected, the event is stored in the "
                  "controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\DCLV Signal Too Low", Scope::system, Kind::on_off, "", kAny,
        {}, 0, kNowhere,
        "signal/logic supply voltage below the error limit. If selected, the event is stored in the "
        "controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\DCLV Signal Too High", Scope::system, Kind::on_off, "", kAny,
        {}, 0, kNowhere,
        "signal/logic supply voltage above the error limit. If selected, the event is stored in the "
        "controller's error log, which survives a power failure"),
    parameter_row("System\\Error Handling\\Logging Mask\\Electronic Fault", Scope::system, Kind::on_off, "",
                  kAny, {}, 0, kNowhere,
                  "heat sink above 70 degrees C, or short circuit on a motor phase. If selected, the event "
                  "is stored in "
                  "the controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\Drive Type Mismatch", Scope::system, Kind::on_off, "", kAny,
        {}, 0, kNowhere,
        "connected actuator differs from the configured type. If selected, the event is stored in the "
        "controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\Curve Error", Scope::system, Kind::on_off, "", kAny, {}, 0,
        kNowhere,
        "motion profile not found or not made for the configured actuator type. If selected, the event is "
        "stored in the controller's error log, which survives a power failure"),
    parameter_row("System\\Error Handling\\Logging Mask\\Slider Missing", Scope::system, Kind::on_off, "",
                  kAny, {}, 0, kNowhere,
                  "slider absent or motor not connected correctly. If selected, the event is stored in the "
                  "controller's "
                  "error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\Init Failed", Scope::system, Kind::on_off, "", kAny, {}, 0,
        kNowhere,
        "initialisation could not be completed. If selected, the event is stored in the controller's error "
        "log, which survives a power failure"),
    parameter_row("System\\Error Handling\\Logging Mask\\Drive Following Error", Scope::system, Kind::on_off,
                  "", kAny, {}, 0, kNowhere,
                  "following error too large (limits set per motor). If selected, the event is stored in the "
                  "controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\Drive Too Hot Calculated", Scope::system,
        Kind::on_off, "", kAny, {}, 0, kNowhere,
        "short-time overload from the calculated thermal model (blocked or overloaded motor: load mass too "
        "big, profile too fast). Deselecting it may leave a short overload undetected and damage the motor. "
        "If selected, the event is stored in the controller's error log, which survives a power failure"),
    parameter_row(
        "System\\Error Handling\\Logging Mask\\Drive Too Hot Sensor", Scope::system, Kind::on_off, "", kAny,
        {}, 0, kNowhere,
        "motor too warm by sensor: overloaded and/or badly cooled. If selected, the event is stored in the "
        "controller's error log, which survives a power failure"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Power Low Warn", Scope::system, Kind::shown, "V",
                  kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: warning when power supply falls below this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Power High Warn", Scope::system, Kind::shown, "V",
                  kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: warning when power supply rises above this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Power Low Error", Scope::system, Kind::shown, "V",
                  kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: error when power supply falls below this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Power High Error", Scope::system, Kind::shown,
                  "V", kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: error when power supply rises above this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Signal Low Warn", Scope::system, Kind::shown, "V",
                  kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: warning when signal supply falls below this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Signal High Warn", Scope::system, Kind::shown,
                  "V", kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: warning when signal supply rises above this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Signal Low Error", Scope::system, Kind::shown,
                  "V", kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: error when signal supply falls below this voltage"),
    parameter_row("System\\Error Handling\\DCLV Monitoring\\Signal High Error", Scope::system, Kind::shown,
                  "V", kAny, {}, kReadOnly, kNowhere,
                  "supply monitoring threshold: error when signal supply rises above this voltage"),
    parameter_row(
        "System\\Startup Mode\\Auto Start", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, auto_start),
        "after supply voltage is applied the controller goes by itself to INIT and then RUN, provided no "
        "error and no warning is present"),
    parameter_row(
        "System\\Startup Mode\\Init Together", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, init_together),
        "on: all active motors run their initialisation at the same time. Off: motor A first, then B, C, D"),
    parameter_row(
        "System\\IO Configuration\\Run Input", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, run_input),
        "RUN request is read from the digital input. If on, the matching ASCII flag command is refused with "
        "E61 (input alone decides)"),
    parameter_row(
        "System\\IO Configuration\\Init Input", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, init_input),
        "INIT request is read from the digital input. If on, the matching ASCII flag command is refused with "
        "E61 (input alone decides)"),
    parameter_row(
        "System\\IO Configuration\\Freeze Input", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, freeze_input),
        "FREEZE is read from the digital input. If on, the matching ASCII flag command is refused with E61 "
        "(input alone decides)"),
    parameter_row(
        "System\\IO Configuration\\Emerg Stop Input", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, emerg_stop_input),
        "STOP (emergency stop) is read from the digital input. If on, the matching ASCII flag command is "
        "refused with E61 (input alone decides)"),
    parameter_row("System\\IO Configuration\\Analog / Trig Drive A", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, analog_trig_drive_a),
                  "reads the trigger signal of drive A in states DRIVE INIT and RUN"),
    parameter_row("System\\IO Configuration\\Analog / Trig Drive B", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, analog_trig_drive_b),
                  "reads the trigger signal of drive B in states DRIVE INIT and RUN"),
    parameter_row("System\\IO Configuration\\Analog / Trig Drive C", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, analog_trig_drive_c),
                  "reads the trigger signal of drive C in states DRIVE INIT and RUN"),
    parameter_row("System\\IO Configuration\\Analog / Trig Drive D", Scope::system, Kind::on_off, "", kAny,
                  {}, 0, offsetof(SystemParameters, analog_trig_drive_d),
                  "reads the trigger signal of drive D in states DRIVE INIT and RUN"),
    parameter_row("System\\IO Configuration\\Error Output", Scope::system, Kind::on_off, "", kAny, {}, 0,
                  offsetof(SystemParameters, error_output), "ERROR OUT signal is driven"),
    parameter_row("System\\IO Configuration\\Warn Output", Scope::system, Kind::on_off, "", kAny, {}, 0,
                  offsetof(SystemParameters, warn_output), "WARNING OUT signal is driven"),
    parameter_row("System\\IO Configuration\\Pos Error Output", Scope::system, Kind::on_off, "", kAny, {}, 0,
                  offsetof(SystemParameters, pos_error_output), "POSITION ERROR OUT signal is driven"),
    parameter_row("System\\IO Configuration\\Msg Output", Scope::system, Kind::on_off, "", kAny, {}, 0,
                  offsetof(SystemParameters, msg_output), "MSG signal is driven"),
    parameter_row("System\\Command Interface", Scope::system, Kind::choice, "", kAny,
                  kCommandInterfaceOptions, kPrinted, offsetof(SystemParameters, command_interface),
                  "selects the single interface that may give commands; only one at a time"),
    parameter_row(
        "System\\Time\\Hours", Scope::system, Kind::shown, "h", kAny, {}, 0, kNowhere,
        "operating hours. Stands still while the controller is stopped with the Stop button, until the next "
        "start"),
    parameter_row("System\\Time\\Seconds", Scope::system, Kind::shown, "s", kAny, {}, 0, kNowhere,
                  "seconds part of the operating time"),
    parameter_row(
        "System\\Regeneration Resistor\\Switch Off Voltage", Scope::system, Kind::value, "V", {0.0, 100.0},
        {}, kLive, kNowhere,
        "below this power-supply voltage the brake (regeneration) resistor is switched off. Together the two "
        "values form a hysteresis. Version 3 controllers only"),
    parameter_row(
        "System\\Regeneration Resistor\\Switch On Voltage", Scope::system, Kind::value, "V", {0.0, 100.0}, {},
        kLive, kNowhere,
        "above this power-supply voltage the brake resistor is switched on. Together the two values form a "
        "hysteresis. Version 3 controllers only"),
    parameter_row(
        "Multi Trigger\\Jitter Filter\\Time", Scope::system, Kind::value, "ms", {0.0, 1000.0}, {}, 0,
        offsetof(SystemParameters, jitter_time),
        "time for which the trigger inputs must be stable before a state change is carried out (hides "
        "transient codes when several bits switch)"),
    parameter_row(
        "Multi Trigger\\Acknowledge\\Time", Scope::system, Kind::value, "ms", {0.0, 1000.0}, {}, 0,
        offsetof(SystemParameters, acknowledge_time),
        "shortest time In Position stays 0 after a command; it returns to 1 only when this time is over AND "
        "the motor is in the window"),
    parameter_row("Multi Trigger\\Output Configuration\\Output 3", Scope::system, Kind::choice, "", kAny,
                  kOutput3Options, 0, offsetof(SystemParameters, mt_output_3),
                  "function of digital output 3"),
    parameter_row("Multi Trigger\\Output Configuration\\Output 4", Scope::system, Kind::choice, "", kAny,
                  kOutput4Options, 0, offsetof(SystemParameters, mt_output_4),
                  "function of digital output 4"),
    parameter_row("PROFIBUS-DP\\Diagnose Priority", Scope::system, Kind::choice, "", kAny,
                  kDiagnosePriorityOptions, 0, kNowhere,
                  "priority with which the slave asks the PLC to collect diagnosis on a fault"),
    parameter_row(
        "PROFIBUS-DP\\Byte Order Datamodules\\Reversed", Scope::system, Kind::on_off, "", kAny, {}, 0,
        offsetof(SystemParameters, bytes_reversed),
        "on: byte order within each word of the data modules is swapped (set this for Siemens PLCs)"),
    parameter_row("PROFIBUS-DP\\Info\\Slave Node Address", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere,
                  "PROFIBUS address of the servo controller. Valid only while the controller is started"),
    parameter_row("PROFIBUS-DP\\Info\\Master Node Address", Scope::system, Kind::shown, "", kAny, {},
                  kReadOnly, kNowhere,
                  "PROFIBUS address of the master. Valid only while the controller is started"),
    parameter_row(
        "PROFIBUS-DP\\Info\\Baudrate", Scope::system, Kind::shown, "", kAny, {}, kReadOnly, kNowhere,
        "detected bit rate; written only when correctly taken in by the master (Data_Exchange). Valid only "
        "while the controller is started"),
    parameter_row(
        "PROFIBUS-DP\\Info\\Bus Cycle Time", Scope::system, Kind::shown, "", kAny, {}, kReadOnly, kNowhere,
        "PROFIBUS cycle time measured on the controller. Valid only while the controller is started"),
    parameter_row("Interface Card Type", Scope::system, Kind::choice, "", kAny, kInterfaceCardTypeOptions, 0,
                  kNowhere, "selects the add-on interface card"),
};

inline constexpr Parameter kMotorTable[] = {
    parameter_row(
        "Type", Scope::motor, Kind::choice, "", kAny, kMotorTypeOptions, 0, offsetof(MotorParameters, type),
        "kind of actuator connected to the channel. A wrong setting can destroy the actuator. Steppers and "
        "magnets have no temperature sensor, hence no overload monitoring"),
    parameter_row(
        "Advanced\\Master / Booster", Scope::linear_motor, Kind::choice, "", kAny, kMasterBoosterOptions, 0,
        kNowhere,
        "role of the motor in a group. A booster or gantry slave follows the preceding motor (B follows A) "
        "and takes over most of its settings"),
    parameter_row("Advanced\\Position Sensor", Scope::linear_motor, Kind::choice, "", kAny,
                  kPositionSensorOptions, 0, kNowhere,
                  "source and resolution of the actual position used by the controller"),
    parameter_row("Initialization\\Init Mode", Scope::linear_motor, Kind::choice, "", kAny, kInitModeOptions,
                  0, offsetof(MotorParameters, init_mode), "how the position zero of the slider is found"),
    parameter_row("Initialization\\Init Switches\\Init Once", Scope::linear_motor, Kind::on_off, "", kAny, {},
                  0, offsetof(MotorParameters, init_once),
                  "on: initialise only the first time INIT is entered. Off: initialise every time an active "
                  "INIT signal "
                  "is present"),
    parameter_row("Initialization\\Init Config\\Init Speed", Scope::linear_motor, Kind::value, "m/s",
                  {0.0011444091796875, 4.6875}, {}, 0, offsetof(MotorParameters, init_speed),
                  "speed of the slider during initialisation"),
    parameter_row(
        "Initialization\\Init Config\\Maximal Init Current", Scope::linear_motor, Kind::value, "%",
        {1.0, 100.0}, {}, 0, offsetof(MotorParameters, maximal_init_current),
        "current at which a stop is considered found; decides how hard the motor presses against the stop"),
    parameter_row("Initialization\\Init Config\\Home Position", Scope::linear_motor, Kind::value, "mm",
                  {-2520.0, 2520.0}, {}, 0, offsetof(MotorParameters, home_position),
                  "value given to the position where the stop/trigger was found"),
    parameter_row(
        "Initialization\\Init Config\\Check Init Position", Scope::linear_motor, Kind::value, "mm",
        {-2520.0, 2520.0}, {}, 0, offsetof(MotorParameters, check_init_position),
        "after Home is defined the drive travels automatically to this position to prove that the stroke is "
        "free; not reaching it gives an error. Set equal to Initial Position to skip the check"),
    parameter_row("Initialization\\Init Config\\Initial Position", Scope::linear_motor, Kind::value, "mm",
                  {-2520.0, 2520.0}, {}, 0, offsetof(MotorParameters, initial_position),
                  "position approached at the end; reaching it completes the initialisation"),
    parameter_row("Set Value Generation\\Run Mode", Scope::linear_motor, Kind::choice, "", kAny,
                  kRunModeOptions, 0, offsetof(MotorParameters, run_mode),
                  "source of the set-point for AT and MT controllers; ASCII motion needs 'Serial' (E66)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Minimal Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive,
                  offsetof(MotorParameters, minimal_position),
                  "lower limit of the allowed actual position range"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Maximal Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive,
                  offsetof(MotorParameters, maximal_position),
                  "upper limit of the allowed actual position range"),
    parameter_row("Set Value Generation\\Set Value Configuration\\0V Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, position_0v),
                  "position for 0 V input in Analog mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\10V Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, position_10v),
                  "position for 10 V input in Analog mode; linear interpolation between"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'0' Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, position_0),
                  "position while the trigger is logic 0 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'1' Position", Scope::linear_motor,
                  Kind::value, "mm", {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, position_1),
                  "position while the trigger is logic 1 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Number", Scope::linear_motor,
                  Kind::whole, "", {0, 63}, {}, kLive, offsetof(MotorParameters, curve_number),
                  "stored curve repeated in Continuous Curve mode; 0 = no curve (commissioning text, 907)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Rise Curve Number", Scope::linear_motor,
                  Kind::whole, "", {0, 63}, {}, kLive, offsetof(MotorParameters, rise_curve_number),
                  "curve run on the rising trigger edge in Trigger Curve mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Fall Curve Number", Scope::linear_motor,
                  Kind::whole, "", {0, 63}, {}, kLive, offsetof(MotorParameters, fall_curve_number),
                  "curve run on the falling trigger edge in Trigger Curve mode"),
    parameter_row(
        "Set Value Generation\\Set Value Configuration\\Curve Pos Offset", Scope::linear_motor, Kind::value,
        "mm", {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, curve_pos_offset),
        "additive position offset of a curve; rewritten by every 'from actual position' curve start"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Amplitude", Scope::linear_motor,
                  Kind::value, "%", {0.0, 100.0}, {}, kLive, offsetof(MotorParameters, curve_amplitude),
                  "scale of a curve"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Speed", Scope::linear_motor,
                  Kind::value, "%", {0.0, 100.0}, {}, kLive, offsetof(MotorParameters, curve_speed),
                  "time scale of a curve; 100 % = as created, smaller values linearly slower"),
    parameter_row(
        "Set Value Generation\\Filter Parameter\\Max Speed", Scope::linear_motor, Kind::value, "m/s",
        {0.0011444091796875, 4.6875}, {}, kLive | kPrinted, offsetof(MotorParameters, max_speed),
        "upper speed limit of the set-point pre-filter (V/A limiter). Not applied while a curve runs"),
    parameter_row("Set Value Generation\\Filter Parameter\\Max Acceleration", Scope::linear_motor,
                  Kind::value, "m/s²", {0.2384185791015625, 366.2109375}, {}, kLive | kPrinted,
                  offsetof(MotorParameters, max_acceleration),
                  "upper acceleration limit of the set-point pre-filter. Not applied while a curve runs"),
    parameter_row("Position Monitoring\\Pos Range Min", Scope::linear_motor, Kind::value, "mm",
                  {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, pos_range_min),
                  "lower edge of the position band; a powered motor below it activates POSITION ERROR OUT"),
    parameter_row("Position Monitoring\\Pos Range Max", Scope::linear_motor, Kind::value, "mm",
                  {-2520.0, 2520.0}, {}, kLive, offsetof(MotorParameters, pos_range_max),
                  "upper edge of the position band; a powered motor above it activates POSITION ERROR OUT"),
    parameter_row(
        "Position Monitoring\\In Position-", Scope::linear_motor, Kind::value, "mm", {0.0, 2520.0}, {}, kLive,
        offsetof(MotorParameters, in_position_minus),
        "lower tolerance round the target for the In Position signal; active only with interfaces MT, ASCII "
        "and PROFIBUS. After a new target or curve start the signal stays 0 until the slider is inside the "
        "window"),
    parameter_row("Position Monitoring\\In Position+", Scope::linear_motor, Kind::value, "mm", {0.0, 2520.0},
                  {}, kLive, offsetof(MotorParameters, in_position_plus),
                  "upper tolerance round the target for In Position"),
    parameter_row(
        "Position Monitoring\\Following Error-", Scope::linear_motor, Kind::value, "mm", {0.0, 2520.0}, {},
        kLive, offsetof(MotorParameters, following_error_minus),
        "negative limit of demand minus actual position; beyond it a warning and/or error is raised as "
        "masked"),
    parameter_row("Position Monitoring\\Following Error+", Scope::linear_motor, Kind::value, "mm",
                  {0.0, 2520.0}, {}, kLive, offsetof(MotorParameters, following_error_plus),
                  "positive limit of demand minus actual position"),
    parameter_row("Control Parameters\\Maximal Current", Scope::linear_motor, Kind::value, "A", {0.0, 6.0},
                  {}, kLive, offsetof(MotorParameters, maximal_current),
                  "largest current the controller may command, hence largest force"),
    parameter_row("Control Parameters\\Current Offset", Scope::linear_motor, Kind::value, "A", {-6.0, 6.0},
                  {}, kLive | kPrinted, offsetof(MotorParameters, current_offset),
                  "constant current to balance a static force (gravity, spring)"),
    parameter_row("Control Parameters\\P", Scope::linear_motor, Kind::value, "A/mm", {0.0, 76.5}, {},
                  kLive | kPrinted, offsetof(MotorParameters, proportional), "current per position error"),
    parameter_row("Control Parameters\\D", Scope::linear_motor, Kind::value, "A/(m/s)", {0.0, 489.6}, {},
                  kLive | kPrinted, offsetof(MotorParameters, derivative),
                  "current per velocity error (demand minus actual velocity)"),
    parameter_row("Control Parameters\\I", Scope::linear_motor, Kind::value, "A/(mm s)", {0.0, 1491.648}, {},
                  kLive | kPrinted, offsetof(MotorParameters, integral),
                  "current per time integral of position error"),
    parameter_row(
        "Control Parameters\\FF Friction", Scope::linear_motor, Kind::value, "A", {0.0, 6.0}, {}, kLive,
        offsetof(MotorParameters, ff_friction),
        "constant feed-forward current whose sign follows the direction of motion, to cancel dry friction"),
    parameter_row("Control Parameters\\FF Acceleration", Scope::linear_motor, Kind::value, "mA/(m/s²)",
                  {0.0, 3264.0}, {}, kLive, offsetof(MotorParameters, ff_acceleration),
                  "feed-forward current proportional to demand acceleration while speeding up"),
    parameter_row(
        "Control Parameters\\FF Deceleration", Scope::linear_motor, Kind::value, "mA/(m/s²)", {0.0, 3264.0},
        {}, kLive, offsetof(MotorParameters, ff_deceleration),
        "feed-forward current for braking: 100 mA/(m/s^2) gives -100 mA per 1 m/s^2 of deceleration"),
    parameter_row(
        "Control Parameters\\Noise Dead Band", Scope::linear_motor, Kind::value, "mm", {0.0, 10.0}, {}, kLive,
        kNowhere,
        "width of a stand-still dead band to quieten the motor. Active once the demand position stops "
        "changing. With I=0: current is frozen until the actual position departs from the mean of the eight "
        "actual positions before activation by more than the band. With I>0: current is frozen until actual "
        "minus demand exceeds the band. Reduces positioning accuracy; use the smallest value that silences "
        "the motor"),
    parameter_row("Control Switches\\Current ( ) 2A (x) 3A", Scope::linear_motor, Kind::on_off, "", kAny, {},
                  0, offsetof(MotorParameters, range_3a), "selects a 3 A instead of a 2 A current range"),
    parameter_row("Advanced\\Commutation", Scope::linear_motor, Kind::choice, "", kAny, kCommutationOptions,
                  0, kNowhere, "how the two phases are energised; affects force ripple, heat loss, dynamics"),
    parameter_row(
        "Error Handling\\Error Mask\\Drive Type Mismatch", Scope::linear_motor, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(MotorParameters, error_mask_drive_type_mismatch),
        "connected motor differs from the configured type or is defective. Selected: condition sends the "
        "controller to ERROR"),
    parameter_row("Error Handling\\Error Mask\\Curve Error", Scope::linear_motor, Kind::on_off, "", kAny, {},
                  kReadOnly, offsetof(MotorParameters, error_mask_curve_error),
                  "a set-point curve cannot be found. Selected: condition sends the controller to ERROR"),
    parameter_row(
        "Error Handling\\Error Mask\\Slider Missing", Scope::linear_motor, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(MotorParameters, error_mask_slider_missing),
        "slider missing or motor wrongly connected. Selected: condition sends the controller to ERROR"),
    parameter_row("Error Handling\\Error Mask\\Init Failed", Scope::linear_motor, Kind::on_off, "", kAny, {},
                  kReadOnly, offsetof(MotorParameters, error_mask_init_failed),
                  "error while initialising. Selected: condition sends the controller to ERROR"),
    parameter_row("Error Handling\\Error Mask\\Drive Following Error", Scope::linear_motor, Kind::on_off, "",
                  kAny, {}, 0, offsetof(MotorParameters, error_mask_drive_following_error),
                  "following error too large. Selected: condition sends the controller to ERROR"),
    parameter_row("Error Handling\\Error Mask\\Drive Too Hot Calculated", Scope::linear_motor, Kind::on_off,
                  "", kAny, {}, 0, offsetof(MotorParameters, error_mask_drive_too_hot_calculated),
                  "short-time overload by calculation. Selected: condition sends the controller to ERROR"),
    parameter_row("Error Handling\\Error Mask\\Drive Too Hot Sensor", Scope::linear_motor, Kind::on_off, "",
                  kAny, {}, kReadOnly, offsetof(MotorParameters, error_mask_drive_too_hot_sensor),
                  "excessive heating measured. Selected: condition sends the controller to ERROR"),
    parameter_row("Error Handling\\Warn Mask\\Slider Missing", Scope::linear_motor, Kind::on_off, "", kAny,
                  {}, 0, offsetof(MotorParameters, warn_mask_slider_missing),
                  "slider missing or motor wrongly connected"),
    parameter_row(
        "Error Handling\\Warn Mask\\Drive Init Not Done", Scope::linear_motor, Kind::on_off, "", kAny, {},
        kReadOnly, offsetof(MotorParameters, warn_mask_drive_init_not_done),
        "motor not (correctly) initialised; stays on until initialised and keeps the controller out of RUN; "
        "cannot be cleared"),
    parameter_row(
        "Error Handling\\Warn Mask\\Pos Range Indicator", Scope::linear_motor, Kind::on_off, "", kAny, {}, 0,
        offsetof(MotorParameters, warn_mask_pos_range_indicator),
        "slider outside Pos Range Min/Max. The output only follows if IO Configuration\\Pos Range (AT) or "
        "Multi Trigger\\Output Configuration\\Output 3 = Pos Range (MT) is set. Choose the range so the "
        "signal is off after initialisation"),
    parameter_row("Error Handling\\Warn Mask\\Drive Following Error", Scope::linear_motor, Kind::on_off, "",
                  kAny, {}, 0, offsetof(MotorParameters, warn_mask_drive_following_error),
                  "following error too large"),
    parameter_row("Error Handling\\Warn Mask\\Drive Too Hot Calculated", Scope::linear_motor, Kind::on_off,
                  "", kAny, {}, 0, offsetof(MotorParameters, warn_mask_drive_too_hot_calculated),
                  "short-time overload by calculation"),
    parameter_row("Error Handling\\Warn Mask\\Drive Hot Sensor", Scope::linear_motor, Kind::on_off, "", kAny,
                  {}, 0, offsetof(MotorParameters, warn_mask_drive_hot_sensor), "excessive heating measured"),
    parameter_row(
        "Error Handling\\Warn Mask\\In Position", Scope::linear_motor, Kind::on_off, "", kAny, {}, 0,
        offsetof(MotorParameters, warn_mask_in_position),
        "motor reached its demand position; drives MSG output only when Msg Output and Msg Mask\\In Position "
        "are set"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Stop Mode", Scope::linear_motor, Kind::choice,
                  "", kAny, kEmergencyStopModeOptions, 0, offsetof(MotorParameters, emergency_stop_mode),
                  "reaction of the motor to the STOP input"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Stop Position",
                  Scope::linear_motor, Kind::value, "mm", {-2520.0, 2520.0}, {}, 0,
                  offsetof(MotorParameters, stop_position),
                  "target for Emergency Stop Mode = Goto Position; approached at once when STOP is "
                  "activated; the motor "
                  "stays in operation"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Max Speed", Scope::linear_motor,
                  Kind::value, "m/s", {0.0011444091796875, 4.6875}, {}, 0,
                  offsetof(MotorParameters, emergency_max_speed), "speed limit of the emergency motion"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Max Acceleration",
                  Scope::linear_motor, Kind::value, "m/s²", {0.2384185791015625, 366.2109375}, {}, 0,
                  offsetof(MotorParameters, emergency_max_acceleration),
                  "acceleration/braking limit of the emergency motion"),
    parameter_row("Advanced\\Master / Booster", Scope::stepper, Kind::choice, "", kAny,
                  kStepperMasterBoosterOptions, 0, kNowhere,
                  "must be Master; groups are not supported with steppers"),
    parameter_row("Initialization\\Init Mode", Scope::stepper, Kind::choice, "", kAny,
                  kStepperInitModeOptions, 0, kNowhere, "how the zero of the stepper is found"),
    parameter_row("Initialization\\Init Switches\\Init Once", Scope::stepper, Kind::on_off, "", kAny, {}, 0,
                  kNowhere,
                  "on: initialise only the first time DRIVE INIT is entered. Off: at every change from "
                  "DISABLE to DRIVE "
                  "INIT"),
    parameter_row("Initialization\\Init Config\\Init Speed", Scope::stepper, Kind::value, "steps/s", kAny, {},
                  0, kNowhere, "speed during initialisation"),
    parameter_row("Initialization\\Init Config\\Home Position", Scope::stepper, Kind::value, "steps", kAny,
                  {}, 0, kNowhere, "value given to the reference position"),
    parameter_row("Initialization\\Init Config\\Initial Position", Scope::stepper, Kind::value, "steps", kAny,
                  {}, 0, kNowhere, "position approached at the end of initialisation"),
    parameter_row("Set Value Generation\\Run Mode", Scope::stepper, Kind::choice, "", kAny, kRunModeOptions,
                  0, kNowhere,
                  "source of the set-point for AT and MT controllers; ASCII motion needs 'Serial' (E66)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Minimal Position", Scope::stepper,
                  Kind::value, "steps", kAny, {}, kLive, kNowhere,
                  "lower limit of the allowed actual position range. (printed 'Miminal Position')"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Maximal Position", Scope::stepper,
                  Kind::value, "steps", kAny, {}, kLive, kNowhere,
                  "upper limit of the allowed actual position range"),
    parameter_row("Set Value Generation\\Set Value Configuration\\0V Position", Scope::stepper, Kind::value,
                  "steps", kAny, {}, kLive, kNowhere, "position for 0 V input in Analog mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\10V Position", Scope::stepper, Kind::value,
                  "steps", kAny, {}, kLive, kNowhere,
                  "position for 10 V input in Analog mode; linear interpolation between"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'0' Position", Scope::stepper, Kind::value,
                  "steps", kAny, {}, kLive, kNowhere,
                  "position while the trigger is logic 0 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'1' Position", Scope::stepper, Kind::value,
                  "steps", kAny, {}, kLive, kNowhere,
                  "position while the trigger is logic 1 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Number", Scope::stepper, Kind::whole,
                  "", {0, 63}, {}, kLive, kNowhere,
                  "stored curve repeated in Continuous Curve mode; 0 = no curve (commissioning text, 907)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Rise Curve Number", Scope::stepper,
                  Kind::whole, "", {0, 63}, {}, kLive, kNowhere,
                  "curve run on the rising trigger edge in Trigger Curve mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Fall Curve Number", Scope::stepper,
                  Kind::whole, "", {0, 63}, {}, kLive, kNowhere,
                  "curve run on the falling trigger edge in Trigger Curve mode"),
    parameter_row(
        "Set Value Generation\\Set Value Configuration\\Curve Pos Offset", Scope::stepper, Kind::value,
        "steps", kAny, {}, kLive, kNowhere,
        "additive position offset of a curve; rewritten by every 'from actual position' curve start"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Amplitude", Scope::stepper,
                  Kind::value, "%", {0.0, 100.0}, {}, kLive, kNowhere, "scale of a curve"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Speed", Scope::stepper, Kind::value,
                  "%", {0.0, 100.0}, {}, kLive, kNowhere,
                  "time scale of a curve; 100 % = as created, smaller values linearly slower"),
    parameter_row("Set Value Generation\\Filter Parameter\\Max Speed", Scope::stepper, Kind::value, "steps/s",
                  kAny, {}, kLive | kPrinted, kNowhere,
                  "upper speed limit of the pre-filter; ignored for curves"),
    parameter_row("Set Value Generation\\Filter Parameter\\Max Acceleration", Scope::stepper, Kind::value,
                  "steps/s²", kAny, {}, kLive | kPrinted, kNowhere,
                  "upper acceleration limit of the pre-filter; ignored for curves"),
    parameter_row(
        "Position Monitoring\\Pos Range Min", Scope::stepper, Kind::value, "steps", kAny, {}, kLive, kNowhere,
        "lower edge of the position band (POSITION ERROR OUT). No following-error supervision for steppers "
        "(no feedback)"),
    parameter_row(
        "Position Monitoring\\Pos Range Max", Scope::stepper, Kind::value, "steps", kAny, {}, kLive, kNowhere,
        "upper edge of the position band. No following-error supervision for steppers (no feedback)"),
    parameter_row(
        "Position Monitoring\\In Position -", Scope::stepper, Kind::value, "steps", kAny, {}, kLive, kNowhere,
        "lower tolerance for In Position. No following-error supervision for steppers (no feedback)"),
    parameter_row(
        "Position Monitoring\\In Position +", Scope::stepper, Kind::value, "steps", kAny, {}, kLive, kNowhere,
        "upper tolerance for In Position. No following-error supervision for steppers (no feedback)"),
    parameter_row("Control Parameters\\Maximal Current", Scope::stepper, Kind::value, "A", {0.0, 6.0}, {}, 0,
                  kNowhere,
                  "operating phase current; automatically halved 200 ms after the rotor stands still"),
    parameter_row("Control Switches\\Current ( ) 2A (x) 3A", Scope::stepper, Kind::on_off, "", kAny, {}, 0,
                  kNowhere, "3 A instead of 2 A range"),
    parameter_row("Advanced\\Commutation", Scope::stepper, Kind::choice, "", kAny, kStepperCommutationOptions,
                  0, kNowhere, "phase pattern; affects resolution, smoothness and top speed"),
    parameter_row("Error Handling\\Error Mask\\Drive Type Mismatch", Scope::stepper, Kind::on_off, "", kAny,
                  {}, kReadOnly, kNowhere, "wrong or defective motor"),
    parameter_row("Error Handling\\Error Mask\\Curve Error", Scope::stepper, Kind::on_off, "", kAny, {},
                  kReadOnly, kNowhere, "curve not found"),
    parameter_row("Error Handling\\Warn Mask\\Drive Init Not Done", Scope::stepper, Kind::on_off, "", kAny,
                  {}, kReadOnly, kNowhere,
                  "motor not (correctly) initialised; cannot be deselected, blocks RUN"),
    parameter_row("Error Handling\\Warn Mask\\Pos Range Indicator", Scope::stepper, Kind::on_off, "", kAny,
                  {}, 0, kNowhere, "outside Pos Range; output conditions as for the linear motor"),
    parameter_row("Error Handling\\Warn Mask\\In Position", Scope::stepper, Kind::on_off, "", kAny, {}, 0,
                  kNowhere, "demand position reached; MSG output conditions as for the linear motor"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Stop Mode", Scope::stepper, Kind::choice, "",
                  kAny, kEmergencyStopModeOptions, 0, kNowhere, "reaction of the motor to the STOP input"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Stop Position", Scope::stepper,
                  Kind::value, "steps", kAny, {}, 0, kNowhere,
                  "target for Emergency Stop Mode = Goto Position; approached at once when STOP is "
                  "activated; the motor "
                  "stays in operation"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Max Speed", Scope::stepper,
                  Kind::value, "steps/s", kAny, {}, 0, kNowhere, "speed limit of the emergency motion"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Max Acceleration", Scope::stepper,
                  Kind::value, "steps/s²", kAny, {}, 0, kNowhere,
                  "acceleration/braking limit of the emergency motion"),
    parameter_row("Advanced\\Master / Booster", Scope::magnet, Kind::choice, "", kAny,
                  kStepperMasterBoosterOptions, 0, kNowhere, "must be Master"),
    parameter_row("Set Value Generation\\Run Mode", Scope::magnet, Kind::choice, "", kAny, kRunModeOptions, 0,
                  kNowhere,
                  "source of the set-point for AT and MT controllers; ASCII motion needs 'Serial' (E66)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Minimal Current", Scope::magnet,
                  Kind::value, "A", {0.0, 6.0}, {}, 0, kNowhere,
                  "lower limit of the allowed actual current range"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Maximal Current", Scope::magnet,
                  Kind::value, "A", {0.0, 6.0}, {}, 0, kNowhere,
                  "upper limit of the allowed actual current range"),
    parameter_row("Set Value Generation\\Set Value Configuration\\0V Current", Scope::magnet, Kind::value,
                  "A", {0.0, 6.0}, {}, 0, kNowhere, "current for 0 V input in Analog mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\10V Current", Scope::magnet, Kind::value,
                  "A", {0.0, 6.0}, {}, 0, kNowhere,
                  "current for 10 V input in Analog mode; linear interpolation between"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'0' Current", Scope::magnet, Kind::value,
                  "A", {0.0, 6.0}, {}, 0, kNowhere, "current while the trigger is logic 0 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\'1' Current", Scope::magnet, Kind::value,
                  "A", {0.0, 6.0}, {}, 0, kNowhere, "current while the trigger is logic 1 in Two Point mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Number", Scope::magnet, Kind::whole,
                  "", {0, 63}, {}, 0, kNowhere,
                  "stored curve repeated in Continuous Curve mode; 0 = no curve (commissioning text, 907)"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Rise Curve Number", Scope::magnet,
                  Kind::whole, "", {0, 63}, {}, 0, kNowhere,
                  "curve run on the rising trigger edge in Trigger Curve mode"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Fall Curve Number", Scope::magnet,
                  Kind::whole, "", {0, 63}, {}, 0, kNowhere,
                  "curve run on the falling trigger edge in Trigger Curve mode"),
    parameter_row(
        "Set Value Generation\\Set Value Configuration\\Curve Current Offset", Scope::magnet, Kind::value,
        "A", {0.0, 6.0}, {}, 0, kNowhere,
        "additive current offset of a curve; rewritten by every 'from actual position' curve start"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Amplitude", Scope::magnet,
                  Kind::value, "%", {0.0, 100.0}, {}, 0, kNowhere, "scale of a curve"),
    parameter_row("Set Value Generation\\Set Value Configuration\\Curve Speed", Scope::magnet, Kind::value,
                  "%", {0.0, 100.0}, {}, 0, kNowhere,
                  "time scale of a curve; 100 % = as created, smaller values linearly slower"),
    parameter_row("Control Parameters\\Maximal Current", Scope::magnet, Kind::value, "A", {0.0, 6.0}, {}, 0,
                  kNowhere, "largest current the controller may set, hence largest force"),
    parameter_row("Control Switches\\Current ( ) 2A (x) 3A", Scope::magnet, Kind::on_off, "", kAny, {}, 0,
                  kNowhere, "3 A instead of 2 A range"),
    parameter_row("Error Handling\\Error Mask\\Drive Type Mismatch", Scope::magnet, Kind::on_off, "", kAny,
                  {}, kReadOnly, kNowhere, "wrong or defective actuator"),
    parameter_row("Error Handling\\Error Mask\\Curve Error", Scope::magnet, Kind::on_off, "", kAny, {},
                  kReadOnly, kNowhere, "curve not found"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Stop Mode", Scope::magnet, Kind::choice, "",
                  kAny, kMagnetEmergencyStopModeOptions, 0, kNowhere,
                  "reaction of the magnet to an emergency stop"),
    parameter_row("Error Handling\\Emergency Stop\\Emergency Configuration\\Stop Current", Scope::magnet,
                  Kind::value, "A", {0.0, 6.0}, {}, kLive, kNowhere,
                  "current driven after an emergency stop in mode Set Current"),
    parameter_row("Sensor Configuration\\Sensor Period", Scope::position_sensor, Kind::choice, "mm", kAny,
                  kSensorPeriodOptions, 0, kNowhere, "pole pitch of the sensor tape"),
    parameter_row("Sensor Configuration\\Sensor Direction", Scope::position_sensor, Kind::choice, "", kAny,
                  kSensorDirectionOptions, 0, kNowhere, "counting direction of the sensor against the motor"),
    parameter_row("Error Handling\\Error Mask\\Drive Type Mismatch", Scope::position_sensor, Kind::on_off, "",
                  kAny, {}, kReadOnly, kNowhere,
                  "connected sensor differs from the configured one or is defective"),
    parameter_row("Error Handling\\Error Mask\\Slider Missing", Scope::position_sensor, Kind::on_off, "",
                  kAny, {}, kReadOnly, kNowhere, "sensor missing, badly mounted or wrongly connected"),
    parameter_row("Error Handling\\Warn Mask\\Slider Missing", Scope::position_sensor, Kind::on_off, "", kAny,
                  {}, 0, kNowhere, "sensor badly mounted or connected"),
};

}  // namespace lockstep::linmot
