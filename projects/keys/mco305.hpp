/// The keys of an MCO 305.
#pragma once

#include "projects/keys/drive.hpp"
#include "projects/keys/priority.hpp"
#include "tech_objects/mco305/device.hpp"

namespace lockstep::keys {

/// Highest number of a program, and how many internal commands a step may have.
inline constexpr int kHighestProgram = 127;
inline constexpr int kMaximumSteps = 100'000;

inline constexpr auto kNoDrive = key_table<DriveSettings>(
    key::selector("model", "none: the actual position is the set position, as with ENCODERTYPE 9"),
    key::structure<&DriveSettings::signals, &MachineSignals::zero_marks>("zero_marks", kZeroMarks,
                                                                         "zero pulses of the encoder [qc]"),
    key::positions<&DriveSettings::signals, &MachineSignals::reference_cam>(
        "reference_cam", kPlace,
        "positions [qc] in which the home switch is active, where no tag is wired to its input"));
inline constexpr KeyVariant kDeviceDrives[] = {{"simulated", kSimulatedDrive}, {"none", kNoDrive}};

using Markers = mco305::MarkerTrackSettings;
inline constexpr auto kMarkers = key_table<Markers>(
    key::number<&Markers::period>("period", {0.001, kFurthest}, "qc", "from each to the next").needed(),
    key::number<&Markers::position>("position", kPlace, "qc", "of one of them"),
    key::number<&Markers::noise>("noise", kLength, "qc", "by how much one may lie off, to either side"),
    key::integer<&Markers::seed>("seed", {0, 2147483647.0}, "of that"),
    key::number<&Markers::slip>("slip", {-1.0, 0.9}, "",
                                "part of the motion that does not get through to what bears the markers"),
    key::tag<&Markers::slips>("slips", "BOOL tag: while TRUE it slips; none: always"),
    key::tag<&Markers::missing>("missing", "BOOL tag: while TRUE none is seen"),
    key::tag<&Markers::spurious>("spurious", "BOOL tag: while TRUE there is another one between any two"),
    key::tag<&Markers::twice>("twice",
                              "BOOL tag: while TRUE each is seen once more a tenth of the period behind it"));

inline constexpr auto kDeviceMaster = key_table<void>(
    key::object("follows", kLeading,
                "axis, encoder or device whose position the master encoder counts: a setpoint of a virtual "
                "axis, else an actual value"),
    key::number("counts_per_unit", kRatio, "",
                "[qc, units] of what it follows: so many counts for so many user units")
        .list()
        .otherwise_is("[1, 1]"),
    key::tag("signal", "DINT tag that counts, and wraps, in place of what it follows [qc]", Type::DINT),
    key::object("encoder_output_of", static_cast<ObjectKinds>(ObjectKind::MCO_305),
                "device whose virtual master (PULSVEL) it counts, in place of these"),
    key::structure("markers", kMarkers, "that the sensor at input 5 sees [qc of the master encoder]"));

using DeviceFaultTags = mco305::DeviceFaults;
inline constexpr auto kDeviceFaults = key_table<DeviceFaultTags>(
    key::tag<&DeviceFaultTags::supply>("supply",
                                       "BOOL tag: while TRUE the external 24 V are missing (EXTERNAL24V)"),
    key::tag<&DeviceFaultTags::output>("output", "BOOL tag: while TRUE a digital output is overloaded"),
    key::tag<&DeviceFaultTags::master_encoder>(
        "master_encoder", "BOOL tag: while TRUE the master encoder tells nothing (MENCODERMONITORING)"),
    key::tag<&DeviceFaultTags::encoder_counts>(
        "encoder_counts", "DINT tag: is added to what an absolute encoder tells (ENCODERABSTYPE) [qc]",
        Type::DINT),
    key::tag<&DeviceFaultTags::master_encoder_counts>(
        "master_encoder_counts",
        "DINT tag: is added to what an absolute master encoder tells (MENCODERABSTYPE) [qc]", Type::DINT));

inline constexpr auto kDeviceProgram = key_table<void>(
    key::integer("number", {0, kHighestProgram}, "of the program, each once").needed(),
    key::text("file", "program in APOSS beside the project, such as teddy.m"),
    key::text("lines", "the program itself, in place of a file").list(),
    key::boolean("autostart", "it is started when the run begins; one of all").otherwise_is("false"));

inline constexpr Word kFirmware[] = {{"5.00", 1}, {"<5.00", 0}};
inline constexpr Word kTimeInterrupts[] = {{"1ms", 1}, {"20ms", 20}};
inline constexpr auto kMco305 = key_table<void>(
    key::selector("type", "published type"),
    key::word("firmware", kFirmware, "edition whose behaviour it has").otherwise_is("5.00"),
    key::constant(
        "parameters",
        "by mnemonic or number, as printed: \"VELMAX\", \"32-80\", \"1900\"; with \"file\" those of a "
        "file beside the project first")
        .named(),
    key::variants("drive", kDeviceDrives, "drive and machine; places are in qc of the encoder")
        .otherwise_is("none"),
    key::structure("master", kDeviceMaster, "what turns its master encoder; none: its own virtual master"),
    key::structure("markers", kMarkers, "that the sensor at input 6 sees [qc of the encoder]"),
    key::structure("faults", kDeviceFaults, "what goes wrong at it, and when"),
    key::tag("inputs", "BOOL tag that is an input: 1 to 12, 18, 19, 27, 29, 32, 33").named(),
    key::tag("outputs", "BOOL tag that is an output: 1 to 8, 21, 22, 27, 29").named(),
    key::tag("analog_inputs", "LREAL tag that is an analog input: 53, 54 [V], -10 to 10", Type::LREAL)
        .named(),
    key::tag("analog_outputs", "LREAL tag that is the analog output 42 [mA]", Type::LREAL).named(),
    key::number("controller_scale", {1e-6, 1e6}, "", "of the parts of the position controller")
        .otherwise_is("1"),
    key::boolean("write_protected", "SAVE and SAVEPROM are error 190").otherwise_is("false"),
    key::structure("programs", kDeviceProgram, "its programs").list(),
    key::integer("steps_per_ms", {1, kMaximumSteps},
                 "internal commands that a program may carry out in a step")
        .otherwise_is("200"),
    key::integer("priority", {kLowestPriority, kHighestPriority},
                 "of its programs among the Cyclic ones; the higher runs first, of the same one the device")
        .otherwise_is("before all Cyclic programs"),
    key::word("time_interrupts", kTimeInterrupts, "how often ON TIME and ON PERIOD are looked at")
        .otherwise_is("1ms"));

}  // namespace lockstep::keys
